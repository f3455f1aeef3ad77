#include "cli/outputs.hpp"

#include <unistd.h>

#include <filesystem>

#include "cli/command.hpp"
#include "cli/long_work.hpp"
#include "halfspace/io/file.hpp"

namespace halfspace::tools {
namespace {

bool is_same_file(const std::string& a, const std::string& b) {
  if (a == "-" || b == "-") return a == b;
  std::error_code error;
  if (std::filesystem::exists(a, error) &&
      !std::filesystem::is_regular_file(a, error))
    return false;
  if (std::filesystem::equivalent(a, b, error)) return true;
  const auto resolved = [&error](const std::string& path) {
    return std::filesystem::weakly_canonical(std::filesystem::absolute(path),
                                             error);
  };
  const std::filesystem::path first = resolved(a);
  return !error && first == resolved(b) && !error;
}

}  // namespace

std::string complaint(std::span<const NamedFile> inputs,
                      std::span<const NamedFile> outputs) {
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const auto& [option, path] = outputs[i];
    if (path.empty()) continue;
    for (const NamedFile& input : inputs) {
      if (input.path.empty() || path == "-") continue;
      if (is_same_file(path, input.path))
        return fmt::format("{}: {} would overwrite an input", path, option);
    }
    for (const NamedFile& other : outputs.first(i)) {
      if (!other.path.empty() && is_same_file(path, other.path)) {
        return fmt::format("{}: {} and {} would both write it", path,
                           other.option, option);
      }
    }
  }
  return {};
}

Result<Done> write_through(
    const std::string& extension,
    const std::function<Result<Done>(const std::string& path)>& write) {
  std::error_code error;
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path(error);
  const std::string path =
      (folder / ("halfspace-" + std::to_string(::getpid()) + extension))
          .string();
  const Result<Done> written = write(path);
  if (!written) return written;
  const Result<std::string> bytes = io::read_file(path);
  std::filesystem::remove(path, error);
  if (!bytes) return bytes.error();
  print(*bytes);
  return Done{};
}

Result<Done> write_output(const std::string& path, std::string_view bytes) {
  if (path != "-") {
    note_part(path);
    return io::write_file(path, bytes);
  }
  print(bytes);
  return Done{};
}

}  // namespace halfspace::tools
