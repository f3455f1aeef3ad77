#include "cli/long_work.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <string>
#include <utility>

#include "cli/command.hpp"
#include "halfspace/io/file.hpp"

namespace halfspace::tools {
namespace {

/// Work that takes less than this is not shown.
constexpr std::chrono::milliseconds kPatience(500);
constexpr std::chrono::milliseconds kPause(100);

volatile std::sig_atomic_t interrupt_seen = 0;

// A signal handler may read nothing that allocates.
constexpr std::size_t kMostParts = 8;
constexpr std::size_t kLongestPart = 4096;
std::array<std::array<char, kLongestPart>, kMostParts> part_names{};
std::size_t next_part = 0;

void end_now() {
  for (const auto& part : part_names) {
    if (part[0] != '\0') ::unlink(part.data());
  }
  constexpr char kSentence[] = "\nhalfspace: interrupted\n";
  const bool on_terminal = ::isatty(STDERR_FILENO) != 0;
  const char* const text = kSentence + (on_terminal ? 0 : 1);
  const auto ignored =
      ::write(STDERR_FILENO, text, std::char_traits<char>::length(text));
  static_cast<void>(ignored);
  ::_exit(static_cast<int>(Status::kInterrupted));
}

void handle(int signal) {
  if (signal == SIGALRM || interrupt_seen != 0) end_now();
  interrupt_seen = 1;
  ::alarm(1);
}

}  // namespace

void catch_interrupts() {
  struct sigaction before {};
  sigaction(SIGINT, nullptr, &before);
  if (before.sa_handler == SIG_IGN) return;
  struct sigaction action {};
  action.sa_handler = handle;
  sigemptyset(&action.sa_mask);
  // Reads and writes go on until the second has passed.
  action.sa_flags = SA_RESTART;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGALRM, &action, nullptr);
}

void note_part(const std::string& path) {
  const std::string name = io::part_name(path).string();
  if (name.size() >= kLongestPart) return;
  auto& part = part_names[next_part++ % kMostParts];
  part[0] = '\0';
  std::copy(name.begin() + 1, name.end(), part.begin() + 1);
  part[name.size()] = '\0';
  part[0] = name[0];
}

LongWork::LongWork(std::string name)
    : name_(std::move(name)),
      is_shown_(!is_quiet() && isatty(STDERR_FILENO) != 0),
      next_(Clock::now() + kPatience) {}

LongWork::~LongWork() {
  if (shown_) std::fprintf(stderr, "\r%*s\r", 60, "");
}

bool LongWork::report(double share) {
  if (is_shown_ && Clock::now() >= next_) {
    next_ = Clock::now() + kPause;
    shown_ = true;
    std::fprintf(stderr, "\rhalfspace: %.30s %3.0f %%", name_.c_str(),
                 std::floor(100 * share));
    std::fflush(stderr);
  }
  return !interrupted();
}

bool LongWork::interrupted() { return interrupt_seen != 0; }

}  // namespace halfspace::tools
