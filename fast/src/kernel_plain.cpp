#include "kernel.hpp"

namespace halfspace::fast {
namespace {

/// An outline has at most this many corners; others go line by line.
constexpr std::int32_t kMostBounds = 32;

/// One number for each of 8 lines.
struct Doubles8 {
  double lines[8];
};
/// One word for each of 8 lines.
struct Words8 {
  std::uint32_t lines[8];
};

template <class Of>
inline Doubles8 doubles(Of&& of) {
  Doubles8 result;
  for (int r = 0; r < 8; ++r) result.lines[r] = of(r);
  return result;
}
template <class Of>
inline Words8 words(Of&& of) {
  Words8 result;
  for (int r = 0; r < 8; ++r) result.lines[r] = of(r);
  return result;
}

inline Doubles8 all_lines(double v) {
  return doubles([&](int) { return v; });
}
inline Doubles8 lines_from(double top) {
  return doubles([&](int r) { return top + r; });
}
inline Doubles8 operator+(const Doubles8& a, const Doubles8& b) {
  return doubles([&](int r) { return a.lines[r] + b.lines[r]; });
}
inline Doubles8 operator-(const Doubles8& a, const Doubles8& b) {
  return doubles([&](int r) { return a.lines[r] - b.lines[r]; });
}
inline Doubles8 operator*(const Doubles8& a, const Doubles8& b) {
  return doubles([&](int r) { return a.lines[r] * b.lines[r]; });
}
inline Doubles8 greater(const Doubles8& a, const Doubles8& b) {
  return doubles(
      [&](int r) { return a.lines[r] > b.lines[r] ? a.lines[r] : b.lines[r]; });
}
inline Doubles8 smaller(const Doubles8& a, const Doubles8& b) {
  return doubles(
      [&](int r) { return a.lines[r] < b.lines[r] ? a.lines[r] : b.lines[r]; });
}

/// The first pixel whose centre is not left of `x`, within the columns.
inline std::int32_t to_column(double x, std::int32_t from, std::int32_t to) {
  const double v = x - 0.5;
  if (!(v > from)) return from;
  if (!(v < to)) return to;
  const auto k = static_cast<std::int32_t>(v);
  return k + (v > k ? 1 : 0);
}

inline std::uint32_t columns_of(const Doubles8& left_low,
                                const Doubles8& left_high,
                                const Doubles8& right_low,
                                const Doubles8& right_high, std::int32_t from,
                                std::int32_t to, std::int32_t* first,
                                std::int32_t* end) {
  std::uint32_t doubt = 0;
  for (int r = 0; r < 8; ++r) {
    first[r] = to_column(left_low.lines[r], from, to);
    end[r] = to_column(right_high.lines[r], from, to);
    const bool told = first[r] == to_column(left_high.lines[r], from, to) &&
                      end[r] == to_column(right_low.lines[r], from, to);
    // Where even the widest reading is empty there is nothing to tell.
    if (!told && end[r] > first[r]) doubt |= 1u << r;
  }
  return doubt;
}

inline Words8 load(const std::uint32_t* p) {
  return words([&](int r) { return p[r]; });
}
inline Words8 load_columns(const std::int32_t* p) {
  return words([&](int r) { return static_cast<std::uint32_t>(p[r]); });
}
inline void store(std::uint32_t* p, const Words8& v) {
  for (int r = 0; r < 8; ++r) p[r] = v.lines[r];
}
inline Words8 operator&(const Words8& a, const Words8& b) {
  return words([&](int r) { return a.lines[r] & b.lines[r]; });
}
inline Words8 operator|(const Words8& a, const Words8& b) {
  return words([&](int r) { return a.lines[r] | b.lines[r]; });
}
/// a without b.
inline Words8 and_not(const Words8& a, const Words8& b) {
  return words([&](int r) { return a.lines[r] & ~b.lines[r]; });
}
inline bool any(const Words8& a) {
  std::uint32_t some = 0;
  for (int r = 0; r < 8; ++r) some |= a.lines[r];
  return some != 0;
}
inline bool all(const Words8& a) {
  std::uint32_t every = ~std::uint32_t{0};
  for (int r = 0; r < 8; ++r) every &= a.lines[r];
  return every == ~std::uint32_t{0};
}

/// The pixels from `first` up to `end` of each line, of the 32 from `x` on.
inline Words8 cover_of(const Words8& first, const Words8& end, std::int32_t x) {
  const auto from = [x](std::uint32_t column) -> std::uint32_t {
    const std::int32_t shift = static_cast<std::int32_t>(column) - x;
    if (shift >= 32) return 0;
    return ~std::uint32_t{0} << (shift > 0 ? shift : 0);
  };
  return words(
      [&](int r) { return from(first.lines[r]) & ~from(end.lines[r]); });
}

inline void store_items(std::int32_t* line, std::uint32_t bits,
                        std::int32_t id) {
  for (int k = 0; bits != 0; ++k, bits >>= 1) {
    if ((bits & 1u) != 0) line[k] = id;
  }
}

inline void store_colors(std::uint8_t* out, int count,
                         const std::uint8_t* rgb) {
  for (; count > 0; --count, out += 3) {
    out[0] = rgb[0];
    out[1] = rgb[1];
    out[2] = rgb[2];
  }
}

#include "kernel.inc"

}  // namespace

const Kernel kPlainKernel = {draw, draw_lines, any_open, fill_rest};

const Kernel& best_kernel() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) return kAvx2Kernel;
#endif
  return kPlainKernel;
}

}  // namespace halfspace::fast
