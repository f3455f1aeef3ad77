#include "cli/command.hpp"

#include <unistd.h>

#include <CLI/App.hpp>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include "cli/loading.hpp"

namespace halfspace::tools {
namespace {

bool quiet = false;
/// Why a write to standard output failed first; 0 if none did.
int output_errno = 0;

}  // namespace

std::string one_line(std::string_view text) {
  std::string line;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    line += byte < 0x20 || byte == 0x7f ? ' ' : c;
  }
  return line;
}

Status fail(std::string_view sentence) {
  std::fprintf(stderr, "halfspace: %s\n", one_line(sentence).c_str());
  return Status::kBadInput;
}

Status stop(std::string_view sentence) {
  fail(sentence);
  return Status::kInterrupted;
}

Status fail(const std::string& file, const Error& error) {
  return fail(io::error_about(file, error).message);
}

void progress(const std::string& sentence) {
  if (sentence.empty() || quiet || isatty(STDERR_FILENO) == 0) return;
  std::fprintf(stderr, "halfspace: %s\n", one_line(sentence).c_str());
}

void add_quiet_option(CLI::App& app) {
  app.add_flag("-q,--quiet", quiet, "Print no summary and no progress");
}

bool is_quiet() { return quiet; }

void print(std::string_view text) {
  const std::size_t written = std::fwrite(text.data(), 1, text.size(), stdout);
  if (written < text.size() && output_errno == 0) output_errno = errno;
}

Result<Done> finish_output() {
  if (std::fflush(stdout) != 0 && output_errno == 0) output_errno = errno;
  if (output_errno == 0 && std::ferror(stdout) == 0) return Done{};
  std::string sentence = "standard output cannot be written";
  if (output_errno != 0)
    sentence += std::string(": ") + std::strerror(output_errno);
  return Error{ErrorCode::kUnwritable, sentence};
}

}  // namespace halfspace::tools
