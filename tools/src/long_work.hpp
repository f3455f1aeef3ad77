#pragma once

#include <chrono>
#include <csignal>
#include <string>

namespace halfspace::tools {

/// Work that someone waits for: while it lives, standard error tells how far it
/// is, where that is a terminal, and Ctrl-C asks it to stop. A second Ctrl-C
/// ends the program at once.
///
/// One at a time. Where the program was started with interrupts ignored, they
/// stay ignored.
class LongWork {
 public:
  explicit LongWork(std::string name);
  ~LongWork();
  LongWork(const LongWork&) = delete;
  LongWork& operator=(const LongWork&) = delete;

  /// Notes the share that is done, from 0 to 1; whether to go on.
  bool report(double share);

  /// Whether Ctrl-C was pressed.
  static bool interrupted();

 private:
  using Clock = std::chrono::steady_clock;

  std::string name_;
  bool on_terminal_;
  bool shown_ = false;
  Clock::time_point next_;  ///< when to tell again
  struct sigaction before_ {};
};

}  // namespace halfspace::tools
