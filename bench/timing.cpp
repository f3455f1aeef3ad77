#include "timing.hpp"

#include <algorithm>
#include <ctime>
#include <vector>

namespace halfspace::bench {
namespace {

double now_ms(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return static_cast<double>(time.tv_sec) * 1e3 +
         static_cast<double>(time.tv_nsec) * 1e-6;
}

Timing repeat(const std::function<void()>& work, const Repeats& repeats,
              double (*now)()) {
  const double start = now();
  work();
  const double first = now() - start;
  std::vector<double> times;
  if (first > repeats.budget_ms) times.push_back(first);
  while (static_cast<int>(times.size()) < repeats.most &&
         now() - start <= repeats.budget_ms) {
    const double before = now();
    work();
    times.push_back(now() - before);
  }
  if (times.empty()) times.push_back(first);
  std::sort(times.begin(), times.end());
  return {times[times.size() / 2], times.front(), times.back(),
          static_cast<int>(times.size())};
}

}  // namespace

double process_ms() { return now_ms(CLOCK_PROCESS_CPUTIME_ID); }

double wall_ms() { return now_ms(CLOCK_MONOTONIC); }

Timing processor_time(const std::function<void()>& work,
                      const Repeats& repeats) {
  return repeat(work, repeats, &process_ms);
}

Timing elapsed_time(const std::function<void()>& work, const Repeats& repeats) {
  return repeat(work, repeats, &wall_ms);
}

}  // namespace halfspace::bench
