#pragma once

#include <cstddef>
#include <functional>
#include <utility>

#include "halfspace/result.hpp"

namespace halfspace::io {

/// Says whether to stop. It is asked now and then by the thread that works,
/// which then ends with the error kStopped; nothing: work is never stopped.
using Stop = std::function<bool()>;

/// The error of work that was stopped.
inline Error stopped() { return {ErrorCode::kStopped, "stopped"}; }

/// Asks once in some thousand steps, so that asking costs nothing.
class StopCheck {
 public:
  explicit StopCheck(Stop stop = {}) : stop_(std::move(stop)) {}

  /// Notes a step; whether to stop now.
  bool stops() { return ++steps_ % kSteps == 0 && stop_ && stop_(); }

 private:
  /// Of a reader, about a millisecond.
  static constexpr std::size_t kSteps = 1024;

  Stop stop_;
  std::size_t steps_ = 0;
};

}  // namespace halfspace::io
