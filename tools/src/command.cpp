#include "command.hpp"

#include <unistd.h>

#include <cstdio>

#include "loading.hpp"

namespace halfspace::tools {
namespace {

/// `text` with everything that would break the line, or play tricks with a
/// terminal, made blanks.
std::string one_line(std::string_view text) {
  std::string line;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    line += byte < 0x20 || byte == 0x7f ? ' ' : c;
  }
  return line;
}

}  // namespace

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
  if (sentence.empty() || isatty(STDERR_FILENO) == 0) return;
  std::fprintf(stderr, "halfspace: %s\n", one_line(sentence).c_str());
}

}  // namespace halfspace::tools
