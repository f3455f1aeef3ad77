#pragma once

#include <cstdint>

namespace halfspace::fast {

/// Whether flat stars are looked for: not in a module for the web, for its
/// size.
#if defined(__wasm__)
constexpr bool kHasFlatStars = false;
#else
constexpr bool kHasFlatStars = true;
#endif

/// Bits for the axes.
constexpr std::uint8_t axis_bits(bool x, bool y, bool z) {
  return static_cast<std::uint8_t>(int{x} | int{y} << 1 | int{z} << 2);
}

/// From where a triangle is seen whose normal's components are known to be
/// positive, or negative, along these axes: in the direction of an axis, and
/// three bits higher against it.
constexpr std::uint8_t seen_sides(std::uint8_t positive,
                                  std::uint8_t negative) {
  return static_cast<std::uint8_t>(positive | negative << 3);
}

/// By axis: whether a point comes before another one in the projection along
/// it, by the coordinate after the axis, then by the one after that.
/// Requires: coordinates x, y, z, exact.
template <class Point>
std::uint8_t axes_before(const Point& u, const Point& v) {
  const int less = axis_bits(u.x < v.x, u.y < v.y, u.z < v.z);
  const int equal = axis_bits(u.x == v.x, u.y == v.y, u.z == v.z);
  const int next = (less >> 1 | less << 2) & 0b111;
  const int by_next = less | (equal & next);
  return static_cast<std::uint8_t>((by_next >> 1 | by_next << 2) & 0b111);
}

/// What is known of the triangles round a vertex v of a closed surface.
///
/// Let all of them be seen from one side along some axis, so that in that
/// projection each turns about v by less than half a turn, all in one
/// direction. The surface is closed, so they can be put in rows that lead back
/// to where they began, and each row turns about v a whole number of times.
/// Where rows turn once in all there is one row, and its triangles lie side by
/// side: a flat star. Two of them have the corner in common, or the edge, which
/// no other face has. A row goes from the points less than v to the greater
/// ones, in the lexicographic order of the projection, once for each of its
/// turns. So turns are counted by comparing coordinates.
///
/// Source: that what is seen from one side, and does not cross itself in
///         projection, does not cross itself: VMT94.
class FlatStar {
 public:
  /// Of a triangle: the sides from which it is seen, and axes_before() from v
  /// to its next corner and from the one before to v.
  void add(std::uint8_t sides, std::uint8_t before_next,
           std::uint8_t after_last) {
    const int passes = ~(before_next | after_last) & 0b111;
    seen_from_ = static_cast<std::uint8_t>(seen_from_ & sides);
    twice_ = static_cast<std::uint8_t>(twice_ | (once_ & passes));
    once_ = static_cast<std::uint8_t>(once_ | passes);
  }
  /// It is not known to be flat, whatever else is added.
  void spoil() { seen_from_ = 0; }

  bool is_flat() const {
    return ((seen_from_ | seen_from_ >> 3) & once_ & ~twice_ & 0b111) != 0;
  }

 private:
  std::uint8_t seen_from_ = 0x3f;
  std::uint8_t once_ = 0;   ///< along which one of them passes the vertex
  std::uint8_t twice_ = 0;  ///< along which two do
};

/// The corners of a triangle, ids of those without flat stars complemented, and
/// one more number.
using StarCorners = std::int32_t __attribute__((vector_size(16)));

/// What triangles have in common by their corners.
enum class Common : std::uint8_t {
  kNothing,   ///< no corner
  kFlatStar,  ///< a corner with a flat star: nothing else but an edge there
  kOther,     ///< corners without flat stars
};

inline Common common_of(const StarCorners& a, const StarCorners& b) {
  const StarCorners equal = (a == StarCorners{b[0], b[1], b[2], 0}) |
                            (a == StarCorners{b[1], b[2], b[0], 0}) |
                            (a == StarCorners{b[2], b[0], b[1], 0});
  // Ids of corners with flat stars are not negative, others are.
  const StarCorners flat = equal & (a >= 0);
  if ((flat[0] | flat[1] | flat[2]) != 0) return Common::kFlatStar;
  if ((equal[0] | equal[1] | equal[2]) != 0) return Common::kOther;
  return Common::kNothing;
}

}  // namespace halfspace::fast
