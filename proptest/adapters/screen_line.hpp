#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "halfspace/fast/screen.hpp"
#include "halfspace/span.hpp"

namespace halfspace {

/// The instruction sets that the fast library's loops are compiled for.
inline constexpr std::array kSimdLevels = {fast::SimdLevel::kPortable,
                                           fast::SimdLevel::kAvx2,
                                           fast::SimdLevel::kAvx512};
constexpr const char* level_name(fast::SimdLevel level) {
  constexpr std::array kNames = {"portable", "AVX2", "AVX-512", "best"};
  return kNames[static_cast<std::size_t>(level)];
}

/// A line of the fast library's dynamic screen, whatever pixels of it are
/// unlit: F2B's Merge by the loops that render() merges with.
///
/// The line lies in the middle of a screen, so that it crosses tiles.
class ScreenLine {
 public:
  /// What became lit, and what is still unlit.
  struct Merged {
    std::vector<Span> lit;
    std::vector<Span> unlit;
    friend bool operator==(const Merged&, const Merged&) = default;
  };

  explicit ScreenLine(std::int32_t width_px,
                      fast::SimdLevel simd = fast::SimdLevel::kBest)
      : width_(width_px), screen_(kShift + width_px, kLine + 2, simd) {}

  /// Merges the objects into the unlit segments, as the reference does: the
  /// screen knows pixels, so its runs are cut where an unlit segment ends.
  /// Requires: either list sorted, without overlap, and within the line.
  const Merged& merge(const std::vector<Span>& objects,
                      const std::vector<Span>& unlit) {
    screen_.clear();
    light_all_but(unlit);
    merged_.lit.clear();
    merged_.unlit.clear();
    std::size_t at = 0;
    for (const Span& object : objects) {
      for (const fast::ObjectSegment& lit : light(object)) {
        add_cut(moved(lit.span), unlit, at, merged_.lit);
      }
    }
    at = 0;
    for (const Span& left : screen_.unlit(kLine)) {
      add_cut(moved(left), unlit, at, merged_.unlit);
    }
    return merged_;
  }

 private:
  static constexpr std::int32_t kLine = 11;
  static constexpr std::int32_t kShift = 21;

  static Span moved(Span span) {
    return {span.first - kShift, span.last - kShift};
  }
  /// Adds a run, in parts that lie in one unlit segment each, from segment `at`
  /// on.
  static void add_cut(Span run, const std::vector<Span>& unlit, std::size_t& at,
                      std::vector<Span>& to) {
    for (; at < unlit.size() && unlit[at].last < run.last; ++at) {
      if (unlit[at].last < run.first) continue;
      to.push_back({run.first, unlit[at].last});
      run.first = unlit[at].last + 1;
    }
    to.push_back(run);
  }

  std::span<const fast::ObjectSegment> light(Span span) {
    const fast::ObjectSegment object = {
        kLine, {span.first + kShift, span.last + kShift}};
    return screen_.light({&object, 1});
  }
  void light_all_but(const std::vector<Span>& unlit) {
    std::int32_t next = -kShift;
    for (const Span& span : unlit) {
      light({next, span.first - 1});
      next = span.last + 1;
    }
    light({next, width_ - 1});
  }

  std::int32_t width_;
  fast::DynamicScreen screen_;
  Merged merged_;
};

}  // namespace halfspace
