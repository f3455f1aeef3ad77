#pragma once

#include <functional>

namespace halfspace::bench {

/// Processor time of this process, all its threads together. Units: ms.
double process_ms();

/// Time on the wall. Units: ms.
double wall_ms();

/// How often something is timed.
struct Repeats {
  int most = 25;            ///< never more than this
  double budget_ms = 1500;  ///< stop when this much time is spent
};

/// The spread of a repeated measurement. Units: ms.
struct Timing {
  double median = 0;
  double least = 0;
  double greatest = 0;
  int count = 0;
};

/// Processor time of `work`: run once to warm up unless that alone spends the
/// budget, then repeated.
Timing processor_time(const std::function<void()>& work,
                      const Repeats& repeats);

/// As processor_time, by the wall: for several threads.
Timing elapsed_time(const std::function<void()>& work, const Repeats& repeats);

}  // namespace halfspace::bench
