#include "answer.hpp"

#include <cstdlib>
#include <utility>

#include "halfspace/io/memory_files.hpp"
#include "halfspace/version.hpp"

namespace halfspace::web {

extern "C"
    __attribute__((import_module("halfspace"), import_name("progress"))) int
    halfspace_web_progress(double share);

Answer& answer() {
  static auto* const one = new Answer;
  return *one;
}

void begin_answer() {
  Answer& now = answer();
  now.numbers.clear();
  now.integers.clear();
  now.bytes.clear();
}

int fail_with(Error error) {
  begin_answer();
  answer().error = std::move(error);
  return static_cast<int>(answer().error.code) + 1;
}

bool goes_on(double share) { return halfspace_web_progress(share) != 0; }

HALFSPACE_EXPORT(hs_alloc) void* hs_alloc(std::uint32_t bytes) {
  return std::malloc(bytes);
}
HALFSPACE_EXPORT(hs_free) void hs_free(void* memory) { std::free(memory); }

HALFSPACE_EXPORT(hs_numbers) const double* hs_numbers() {
  return answer().numbers.data();
}
HALFSPACE_EXPORT(hs_number_count) std::uint32_t hs_number_count() {
  return answer().numbers.size();
}
HALFSPACE_EXPORT(hs_integers) const std::int32_t* hs_integers() {
  return answer().integers.data();
}
HALFSPACE_EXPORT(hs_integer_count) std::uint32_t hs_integer_count() {
  return answer().integers.size();
}
HALFSPACE_EXPORT(hs_bytes) const char* hs_bytes() {
  return answer().bytes.data();
}
HALFSPACE_EXPORT(hs_byte_count) std::uint32_t hs_byte_count() {
  return answer().bytes.size();
}

/// The error: its sentence as bytes; the index as a number.
HALFSPACE_EXPORT(hs_error) void hs_error() {
  begin_answer();
  Answer& now = answer();
  now.bytes = now.error.message;
  now.numbers = {static_cast<double>(now.error.index)};
}
/// The few words for a code.
HALFSPACE_EXPORT(hs_code_words) void hs_code_words(int code) {
  begin_answer();
  answer().bytes = to_string(static_cast<ErrorCode>(code));
}
HALFSPACE_EXPORT(hs_version) void hs_version() {
  begin_answer();
  answer().bytes = HALFSPACE_VERSION;
}

/// Files in memory, for reading and from writing.
HALFSPACE_EXPORT(hs_put_file)
void hs_put_file(const char* name, std::uint32_t name_size, const char* bytes,
                 std::uint32_t size) {
  io::put_file({name, name_size}, {bytes, size});
}
HALFSPACE_EXPORT(hs_take_file)
int hs_take_file(const char* name, std::uint32_t name_size) {
  begin_answer();
  auto bytes = io::take_file({name, name_size});
  if (!bytes) return 0;
  answer().bytes = *std::move(bytes);
  return 1;
}
/// Lets go of the memory of a large answer.
HALFSPACE_EXPORT(hs_forget) void hs_forget() { answer() = {}; }

}  // namespace halfspace::web
