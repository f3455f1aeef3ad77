#pragma once

#include <cstddef>
#include <cstdint>

namespace halfspace::fast {
namespace {

/// Eight doubles in as many registers as that takes: one for each of 8 lines,
/// or of 8 polygons.
template <class Lanes>
struct EightDoubles {
  static constexpr int kParts = 8 / Lanes::kCount;
  Lanes part[std::size_t{kParts}];

  /// What `of(p)` gives for each part.
  template <class Of>
  static EightDoubles parts(Of&& of) {
    EightDoubles result;
    for (int p = 0; p < kParts; ++p) result.part[p] = of(p);
    return result;
  }
};
template <class Lanes>
inline EightDoubles<Lanes> operator+(const EightDoubles<Lanes>& a,
                                     const EightDoubles<Lanes>& b) {
  return a.parts([&](int p) { return a.part[p] + b.part[p]; });
}
template <class Lanes>
inline EightDoubles<Lanes> operator-(const EightDoubles<Lanes>& a,
                                     const EightDoubles<Lanes>& b) {
  return a.parts([&](int p) { return a.part[p] - b.part[p]; });
}
template <class Lanes>
inline EightDoubles<Lanes> operator*(const EightDoubles<Lanes>& a,
                                     const EightDoubles<Lanes>& b) {
  return a.parts([&](int p) { return a.part[p] * b.part[p]; });
}

/// Registers with what follows from their lanes, whatever their width: loops
/// over eight doubles.
template <class Narrow>
struct WithEightDoubles : Narrow {
  using Narrow::ceiling;
  using Narrow::greater;
  using Narrow::lanes;
  using Narrow::smaller;
  using typename Narrow::Doubles8;
  using typename Narrow::LaneMask;
  using typename Narrow::Lanes;
  using typename Narrow::Words8;
  static constexpr int kLanes = Lanes::kCount;
  static constexpr int kParts = Doubles8::kParts;

  /// An outline has at most this many corners; others go line by line.
  static constexpr std::int32_t kMostBounds = 32;
  template <class Of>
  static Doubles8 doubles(Of&& of) {
    return Doubles8::parts(of);
  }
  static Doubles8 all_lines(double v) {
    return doubles([v](int) { return lanes(v); });
  }
  static Doubles8 lines_from(double top) {
    return doubles(
        [top](int p) { return Narrow::count_from(top + kLanes * p); });
  }
  static Doubles8 greater(const Doubles8& a, const Doubles8& b) {
    return doubles([&](int p) { return greater(a.part[p], b.part[p]); });
  }
  static Doubles8 smaller(const Doubles8& a, const Doubles8& b) {
    return doubles([&](int p) { return smaller(a.part[p], b.part[p]); });
  }

  /// The pixels of 8 lines from `first` up to `end`, but on lines in doubt.
  struct Spans {
    Words8 first;
    Words8 end;
    std::uint32_t doubt;
  };

  /// The pixels between the left and the right x of 8 lines, which are off by
  /// at most the errors: where that matters there is doubt.
  static Spans columns_of(const Doubles8& left, double left_error,
                          const Doubles8& right, double right_error,
                          std::int32_t from, std::int32_t to) {
    const Lanes error = lanes(left_error);
    const Lanes end_error = lanes(right_error);
    const Lanes half = lanes(0.5);
    const auto within = [low = lanes(from), high = lanes(to)](Lanes v) {
      return smaller(greater(v, low), high);
    };
    Doubles8 first, end;
    std::uint32_t doubt = 0;
    for (int p = 0; p < kParts; ++p) {
      // The first pixel whose centre is not left of the x is this for every
      // reading, unless its centre is left of the greatest; and so the end.
      const Lanes least = ceiling(left.part[p] - error - half);
      const Lanes greatest = ceiling(right.part[p] + end_error - half);
      const LaneMask unsure =
          (least < left.part[p] + error - half) |
          Narrow::not_less(greatest - lanes(1),
                           right.part[p] - end_error - half);
      first.part[p] = within(least);
      end.part[p] = within(greatest);
      // Where even the widest reading is empty there is nothing to decide.
      const LaneMask some = first.part[p] < end.part[p];
      doubt |= Narrow::bits_of(unsure & some) << (kLanes * p);
    }
    return {Narrow::to_integers(first), Narrow::to_integers(end), doubt};
  }
};

}  // namespace
}  // namespace halfspace::fast
