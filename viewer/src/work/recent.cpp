#include "work/recent.hpp"

#include <algorithm>
#include <cstdlib>
#include <sstream>

#include "halfspace/io/file.hpp"

namespace halfspace::viewer {
namespace {

constexpr std::size_t kMostRecent = 12;

}  // namespace

std::filesystem::path recent_file() {
  const char* state = std::getenv("XDG_STATE_HOME");
  const char* home = std::getenv("HOME");
  if (state != nullptr && *state == '/')
    return std::filesystem::path(state) / "halfspace/recent";
  if (home != nullptr && *home == '/')
    return std::filesystem::path(home) / ".local/state/halfspace/recent";
  return {};
}

std::vector<std::string> read_recent(const std::filesystem::path& file) {
  constexpr std::uint64_t kMostBytes = 1 << 16;
  std::vector<std::string> names;
  if (file.empty()) return names;
  const auto text = io::read_file(file, kMostBytes);
  if (!text) return names;
  std::istringstream lines(*text);
  for (std::string line; std::getline(lines, line);) {
    if (!line.empty() && names.size() < kMostRecent) names.push_back(line);
  }
  return names;
}

void note_recent(const std::filesystem::path& file, const std::string& path) {
  // A name with an end of line in it is two names in the file.
  if (file.empty() || path.find('\n') != std::string::npos) return;
  std::error_code code;
  const std::string full = std::filesystem::absolute(path, code).string();
  if (code) return;
  std::vector<std::string> names = read_recent(file);
  std::erase(names, full);
  names.insert(names.begin(), full);
  if (names.size() > kMostRecent) names.resize(kMostRecent);
  std::string text;
  for (const std::string& name : names) text += name + '\n';
  std::filesystem::create_directories(file.parent_path(), code);
  const auto ignored = io::write_file(file, text);
  static_cast<void>(ignored);
}

}  // namespace halfspace::viewer
