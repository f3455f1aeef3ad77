#pragma once

#include <functional>

namespace halfspace {

/// Receives the share of the work that is done, 0 to 1, one call at a time,
/// from any of the threads that work; returns whether to go on. Where it says
/// no, the work stops, with the error kStopped where there is a Result.
using Progress = std::function<bool(double)>;

}  // namespace halfspace
