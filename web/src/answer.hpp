#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "halfspace/result.hpp"

/// What the functions that JavaScript calls have in common.
///
/// A function that asks returns 0, or the error's code plus 1; what it found is
/// then in the answer, which the next question overwrites. Handles are
/// addresses of objects, which JavaScript gives back by the free function of
/// their kind.

/// Exports a function under its own name.
#define HALFSPACE_EXPORT(name) \
  extern "C" __attribute__((export_name(#name), visibility("default")))

namespace halfspace::web {

/// What the last question found: numbers, handles, and bytes.
struct Answer {
  std::vector<double> numbers;
  std::vector<std::int32_t> integers;
  std::string bytes;
  Error error{};
};

/// The one answer: there is one thread.
Answer& answer();

/// Empties the answer.
void begin_answer();

/// Puts an error into the answer.
int fail_with(Error error);

/// Calls `use` with the value of the result, or fails.
template <class T, class Use>
int answered(Result<T> result, Use use) {
  begin_answer();
  if (!result) return fail_with(result.error());
  use(*std::move(result));
  return 0;
}

/// The work's progress, which JavaScript hears of: whether it goes on.
bool goes_on(double share);

/// A handle.
template <class T>
std::int32_t handle_of(T* object) {
  return static_cast<std::int32_t>(reinterpret_cast<std::intptr_t>(object));
}

}  // namespace halfspace::web
