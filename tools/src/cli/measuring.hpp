#pragma once

#include <chrono>
#include <cstddef>
#include <vector>

namespace halfspace::tools {

/// Processor time, of all threads, since a moment.
class Stopwatch {
 public:
  Stopwatch() : start_(now_ms()) {}
  /// Units: milliseconds.
  double elapsed_ms() const { return now_ms() - start_; }

 private:
  static double now_ms();
  double start_;
};

/// Time as it passes, since a moment.
class WallClock {
 public:
  WallClock() : start_(std::chrono::steady_clock::now()) {}
  /// Units: milliseconds.
  double elapsed_ms() const {
    const std::chrono::duration<double, std::milli> passed =
        std::chrono::steady_clock::now() - start_;
    return passed.count();
  }

 private:
  std::chrono::steady_clock::time_point start_;
};

/// The middle one of the values, or the mean of the middle two.
/// Requires: not empty.
double median(std::vector<double> values);

/// How much memory the program has asked for and not given back. Units: bytes;
/// 0 where the C library does not tell.
std::size_t allocated_bytes();

}  // namespace halfspace::tools
