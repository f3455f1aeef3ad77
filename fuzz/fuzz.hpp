#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

/// What every fuzz target has: the entry that libFuzzer, or main.cpp, calls.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size);

namespace halfspace::fuzz {

/// Whether inputs are only replayed: then a target tries all that it can.
#ifdef HALFSPACE_FUZZ_REPLAYS
constexpr bool kReplays = true;
#else
constexpr bool kReplays = false;
#endif

/// Stops the program, which is how a fuzzer learns of a failure, unless the
/// condition holds; says which one, and what else there is to know.
#define HALFSPACE_FUZZ_EXPECT(condition, ...)                             \
  do {                                                                    \
    if (!(condition)) {                                                   \
      std::fprintf(stderr, "%s:%d: not so: %s\n%s\n", __FILE__, __LINE__, \
                   #condition, std::string(__VA_ARGS__).c_str());         \
      std::abort();                                                       \
    }                                                                     \
  } while (false)

/// Reads numbers from a fuzzer's bytes; 0 for ever when they are used up.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size)
      : data_(data), size_(size) {}

  bool empty() const { return at_ == size_; }

  std::uint8_t next() { return empty() ? std::uint8_t{0} : data_[at_++]; }

  /// 0 to count - 1. Requires: 0 < count <= 256.
  int below(int count) { return next() % count; }

  std::uint64_t word() {
    std::uint64_t value = 0;
    for (int k = 0; k < 8; ++k) value = value << 8 | next();
    return value;
  }

  /// Small integers, from -4 to 4.
  std::vector<int> numbers(std::size_t count) {
    std::vector<int> values;
    for (std::size_t k = 0; k < count; ++k) values.push_back(below(9) - 4);
    return values;
  }

 private:
  const std::uint8_t* data_;
  std::size_t size_;
  std::size_t at_ = 0;
};

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

}  // namespace halfspace::fuzz
