#include "cli/measuring.hpp"

#include <algorithm>
#include <ctime>

#if defined(HALFSPACE_ADDRESS_SANITIZER)
// A function of the sanitizer's runtime, whose headers GCC does not bring.
extern "C" std::size_t __sanitizer_get_current_allocated_bytes();
#elif defined(__GLIBC__)
#include <malloc.h>
#endif

namespace halfspace::tools {

double Stopwatch::now_ms() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return 1e3 * static_cast<double>(time.tv_sec) +
         1e-6 * static_cast<double>(time.tv_nsec);
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  if (values.size() % 2 == 1) return values[middle];
  return (values[middle - 1] + values[middle]) / 2;
}

std::size_t allocated_bytes() {
#if defined(HALFSPACE_ADDRESS_SANITIZER)
  // The sanitizer's allocator stands in for the C library's.
  return __sanitizer_get_current_allocated_bytes();
#elif defined(__GLIBC__)
  const struct mallinfo2 info = mallinfo2();
  return info.uordblks + info.hblkhd;
#else
  return 0;
#endif
}

}  // namespace halfspace::tools
