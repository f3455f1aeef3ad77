#include "long_work.hpp"

#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <utility>

namespace halfspace::tools {
namespace {

/// What takes less than this is not worth a word.
constexpr std::chrono::milliseconds kPatience(500);
constexpr std::chrono::milliseconds kPause(100);

volatile std::sig_atomic_t interrupt_seen = 0;

void note_interrupt(int) { interrupt_seen = 1; }

}  // namespace

LongWork::LongWork(std::string name)
    : name_(std::move(name)),
      on_terminal_(isatty(STDERR_FILENO) != 0),
      next_(Clock::now() + kPatience) {
  interrupt_seen = 0;
  sigaction(SIGINT, nullptr, &before_);
  if (before_.sa_handler == SIG_IGN) return;
  struct sigaction action {};
  action.sa_handler = note_interrupt;
  sigemptyset(&action.sa_mask);
  // The second time the signal does what it always does.
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigaction(SIGINT, &action, nullptr);
}

LongWork::~LongWork() {
  sigaction(SIGINT, &before_, nullptr);
  if (shown_) std::fprintf(stderr, "\r%*s\r", 60, "");
}

bool LongWork::report(double share) {
  if (on_terminal_ && Clock::now() >= next_) {
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
