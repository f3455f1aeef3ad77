#pragma once

#include <chrono>
#include <string>

namespace halfspace::tools {

/// Makes Ctrl-C end the program with status 130: work that asks
/// LongWork::report() stops in an orderly way, and all other work is ended
/// after a second, or at the next Ctrl-C. Files that are being written are
/// removed. Where the program was started with interrupts ignored, they stay
/// ignored.
void catch_interrupts();

/// Names a file that is being written, to be removed where Ctrl-C ends the
/// program at once. A few are kept.
void note_part(const std::string& path);

/// Work that someone waits for: while it lives, standard error shows the share
/// that is done, where that is a terminal.
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
  bool is_shown_;
  bool shown_ = false;
  Clock::time_point next_;  ///< when to show it again
};

}  // namespace halfspace::tools
