#include "polygon/ear_clipping.hpp"

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <numeric>

#include "halfspace/int128.hpp"
#include "polygon/chain_boxes.hpp"

namespace halfspace::io {
namespace {

using Int256 = boost::multiprecision::int256_t;

/// A difference of grid points is at most 2^54, and a component of a cross
/// product of two, twice the area of a triangle in a square of that side, at
/// most 2^108; so a sum of 2^17 such, of all corners, is at most 2^125.
struct Vector {
  Int128 x = 0;
  Int128 y = 0;
  Int128 z = 0;
};

Vector difference(const GridPoint& p, const GridPoint& q) {
  return {Int128{p.x} - q.x, Int128{p.y} - q.y, Int128{p.z} - q.z};
}

Vector cross(const Vector& u, const Vector& v) {
  return {u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
}

bool is_zero(const Vector& u) { return u.x == 0 && u.y == 0 && u.z == 0; }

Int128 size(Int128 value) { return value < 0 ? -value : value; }

bool is_on_plane(const Vector& normal, const Vector& from_plane) {
  return Int256(normal.x) * Int256(from_plane.x) +
             Int256(normal.y) * Int256(from_plane.y) +
             Int256(normal.z) * Int256(from_plane.z) ==
         0;
}

/// Whether no corner turns against `normal`, and all turns together make one.
/// Then no point is visited twice, nor does any corner turn straight back: that
/// is half a turn, and the other half only leads back along the same line.
///
/// Requires: the corners lie in one plane with that normal, not on one line.
bool turns_once(std::span<const GridPoint> corners, const Vector& normal) {
  const std::size_t count = corners.size();
  int changes = 0;  // of the edges' lexicographic direction
  bool was_up = corners[count - 1] < corners[0];
  for (std::size_t i = 0; i < count; ++i) {
    const GridPoint& p = corners[i];
    const GridPoint& q = corners[(i + 1) % count];
    const GridPoint& r = corners[(i + 2) % count];
    const Vector turn = cross(difference(q, p), difference(r, q));
    // The turn is a multiple of the normal: one component tells which.
    const Int128 turned = normal.x != 0   ? turn.x
                          : normal.y != 0 ? turn.y
                                          : turn.z;
    const Int128 along = normal.x != 0   ? normal.x
                         : normal.y != 0 ? normal.y
                                         : normal.z;
    if (turned != 0 && (turned < 0) != (along < 0)) return false;
    const bool up = p < q;
    changes += up != was_up ? 1 : 0;
    was_up = up;
  }
  return changes == 2;
}

/// Along the greatest component of the normal, so that the polygon's area
/// comes out positive.
std::vector<Flat> projected(std::span<const GridPoint> corners) {
  // Newell: the sum of the triangles from one corner. It is zero for a figure
  // of eight; then the first corner that is not straight stands in.
  Vector normal;
  Vector first;
  const std::size_t count = corners.size();
  for (std::size_t i = 0; i < count; ++i) {
    const Vector part = cross(difference(corners[i], corners[0]),
                              difference(corners[(i + 1) % count], corners[0]));
    normal = {normal.x + part.x, normal.y + part.y, normal.z + part.z};
    if (is_zero(first)) first = part;
  }
  if (is_zero(normal)) normal = first;
  const Int128 x = size(normal.x);
  const Int128 y = size(normal.y);
  const Int128 z = size(normal.z);
  std::vector<Flat> flat(count);
  for (std::size_t i = 0; i < count; ++i) {
    const GridPoint& p = corners[i];
    if (z >= x && z >= y) {
      flat[i] = normal.z > 0 ? Flat{p.x, p.y} : Flat{p.y, p.x};
    } else if (y >= x) {
      flat[i] = normal.y > 0 ? Flat{p.z, p.x} : Flat{p.x, p.z};
    } else {
      flat[i] = normal.x > 0 ? Flat{p.y, p.z} : Flat{p.z, p.y};
    }
  }
  return flat;
}

/// The heights by which ears are told apart: 2^-10 of the polygon's size, 2^-14
/// and so on, and 0. The corners of a lower one may have been on one line,
/// before they were rounded: it need not face where the polygon does. What is
/// higher goes in turn, for the sides to get near each other evenly.
constexpr std::size_t kHeights = 12;
constexpr std::size_t kFirstShift = 10;
constexpr std::size_t kNextShift = 4;

class EarClipper {
 public:
  explicit EarClipper(std::span<const GridPoint> corners)
      : corners_(corners),
        flat_(projected(corners)),
        next_(corners.size()),
        previous_(corners.size()),
        levels_(corners.size(), kNone),
        boxes_(corners.size()),
        left_(corners.size()),
        // A simple polygon needs two and a half times the square of its
        // corners: all against all edges, then three each time one is clipped.
        budget_(4 * corners.size() * corners.size() + 10'000'000) {
    std::iota(next_.begin(), next_.end(), std::size_t{1});
    next_.back() = 0;
    std::iota(previous_.begin() + 1, previous_.end(), std::size_t{0});
    previous_.front() = corners.size() - 1;
    for (std::size_t i = 0; i < corners.size(); ++i)
      boxes_.set(i, flat_[i], flat_[next_[i]]);
    for (const Flat& p : flat_)
      extent_ = std::max(
          {extent_, std::abs(p.u - flat_[0].u), std::abs(p.v - flat_[0].v)});
  }

  std::vector<std::array<std::size_t, 3>> clip();

 private:
  /// How much of an ear must hold.
  enum class Demand : std::uint8_t {
    kEar,     ///< no edge inside the triangle, no corner on its new edge
    kInside,  ///< no edge inside the triangle
  };

  static constexpr std::size_t kNone = SIZE_MAX;

  bool enters(std::size_t edge, const std::array<Flat, 3>& triangle) const;
  bool is_beside(const Flat& p, const Flat& from, const Flat& to,
                 std::int64_t height) const;
  std::int64_t height_at(std::size_t level) const {
    return level + 1 < kHeights ? extent_ >> (kFirstShift + kNextShift * level)
                                : 0;
  }
  std::size_t ear_level(std::size_t corner, Demand demand);
  bool look_at(std::size_t corner, Demand demand);
  std::size_t take_ear();
  bool scan(Demand demand);
  void clip_any();
  void emit(std::size_t corner);
  void remove(std::size_t corner);
  void remove_spikes(std::size_t corner);
  void clip_at(std::size_t corner);
  Int128 turn_at(std::size_t corner) const {
    return turn(flat_[previous_[corner]], flat_[corner], flat_[next_[corner]]);
  }

  std::span<const GridPoint> corners_;
  std::vector<Flat> flat_;
  std::vector<std::size_t> next_;
  std::vector<std::size_t> previous_;
  std::vector<std::size_t> levels_;  ///< by corner: the ear's height, or kNone
  ChainBoxes boxes_;                 ///< of the edges that leave the corners
  std::size_t left_;
  std::size_t budget_;
  std::int64_t extent_ = 0;
  /// By height the ears, as they were found, and how many of those are gone.
  std::array<std::vector<std::size_t>, kHeights> known_;
  std::array<std::size_t, kHeights> taken_{};
  std::size_t current_ = 0;
  std::vector<std::array<std::size_t, 3>> triangles_;
};

/// Whether the edge that leaves corner `edge` meets the inside of a triangle
/// that turns left: no edge of either separates them.
bool EarClipper::enters(std::size_t edge,
                        const std::array<Flat, 3>& triangle) const {
  const Flat& p = flat_[edge];
  const Flat& q = flat_[next_[edge]];
  const auto [a, b, c] = triangle;
  if (std::max(p.u, q.u) <= std::min({a.u, b.u, c.u}) ||
      std::min(p.u, q.u) >= std::max({a.u, b.u, c.u}) ||
      std::max(p.v, q.v) <= std::min({a.v, b.v, c.v}) ||
      std::min(p.v, q.v) >= std::max({a.v, b.v, c.v})) {
    return false;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const Flat& from = triangle[i];
    const Flat& to = triangle[(i + 1) % 3];
    if (turn(from, to, p) <= 0 && turn(from, to, q) <= 0) return false;
  }
  const Int128 sides[] = {turn(p, q, a), turn(p, q, b), turn(p, q, c)};
  const auto [least, most] = std::minmax_element(sides, sides + 3);
  return *least < 0 && *most > 0;
}

std::int64_t length(const Flat& from, const Flat& to) {
  return std::abs(to.u - from.u) + std::abs(to.v - from.v);
}

/// Whether a point is on an edge, but at neither end, or so near it that it is
/// no higher above it.
bool EarClipper::is_beside(const Flat& p, const Flat& from, const Flat& to,
                           std::int64_t height) const {
  return std::min(from.u, to.u) - height <= p.u &&
         p.u <= std::max(from.u, to.u) + height &&
         std::min(from.v, to.v) - height <= p.v &&
         p.v <= std::max(from.v, to.v) + height && p != from && p != to &&
         size(turn(from, to, p)) <= Int128{height} * length(from, to);
}

/// Whether a corner can be clipped: the first of the heights that the triangle
/// is higher than, and each corner above the edge that it leaves; kNone if not.
/// Without budget, any that turns left can.
std::size_t EarClipper::ear_level(std::size_t corner, Demand demand) {
  const std::size_t before = previous_[corner];
  const std::size_t after = next_[corner];
  const Flat a = flat_[before];
  const Flat b = flat_[corner];
  const Flat c = flat_[after];
  const Int128 area = turn(a, b, c);
  if (area <= 0) return kNone;
  const std::int64_t longest =
      std::max({length(a, b), length(b, c), length(c, a)});
  std::size_t level = 0;
  while (area <= Int128{height_at(level)} * longest) ++level;
  if (budget_ < left_) return level;
  budget_ -= left_;
  std::int64_t height = height_at(level);
  const std::array<Flat, 3> triangle = {a, b, c};
  const auto spoils = [&](std::size_t i) {
    if (i == before || i == corner) return false;
    if (enters(i, triangle)) return true;
    if (demand == Demand::kInside) return false;
    while (is_beside(flat_[i], a, c, height)) {
      if (level + 1 == kHeights) return true;
      height = height_at(++level);
    }
    return false;
  };
  return boxes_.any(triangle, height, spoils) ? kNone : level;
}

/// Tells anew whether a corner is an ear.
bool EarClipper::look_at(std::size_t corner, Demand demand) {
  const std::size_t level = ear_level(corner, demand);
  levels_[corner] = level;
  if (level != kNone) known_[level].push_back(corner);
  return level != kNone;
}

void EarClipper::remove(std::size_t corner) {
  next_[previous_[corner]] = next_[corner];
  previous_[next_[corner]] = previous_[corner];
  boxes_.remove(corner);
  boxes_.set(previous_[corner], flat_[previous_[corner]], flat_[next_[corner]]);
  if (current_ == corner) current_ = next_[corner];
  levels_[corner] = kNone;
  --left_;
}

/// Adds the triangle at a corner, if it has area (seen along the projection it
/// may have none).
void EarClipper::emit(std::size_t corner) {
  const std::size_t before = previous_[corner];
  const std::size_t after = next_[corner];
  const Vector in = difference(corners_[corner], corners_[before]);
  const Vector out = difference(corners_[after], corners_[corner]);
  if (!is_zero(cross(in, out))) triangles_.push_back({before, corner, after});
}

/// Removes what goes to a point and straight back, from a corner on: the two
/// edges cancel.
void EarClipper::remove_spikes(std::size_t corner) {
  while (left_ >= 3) {
    const std::size_t before = previous_[corner];
    const std::size_t after = next_[corner];
    if (corners_[before] == corners_[corner]) {
      remove(before);
    } else if (corners_[before] == corners_[after]) {
      remove(after);
      remove(corner);
      corner = before;
    } else {
      return;
    }
  }
}

void EarClipper::clip_at(std::size_t corner) {
  const std::size_t before = previous_[corner];
  emit(corner);
  remove(corner);
  current_ = before;
  remove_spikes(before);
  if (left_ >= 3) remove_spikes(next_[current_]);
  if (left_ < 3) return;
  for (const std::size_t i : {previous_[current_], current_, next_[current_]})
    look_at(i, Demand::kEar);
}

/// One of the fattest ears that are known, the first to have been found; kNone
/// if there is none.
std::size_t EarClipper::take_ear() {
  for (std::size_t level = 0; level < known_.size(); ++level) {
    while (taken_[level] < known_[level].size()) {
      const std::size_t corner = known_[level][taken_[level]++];
      if (levels_[corner] == level) return corner;
    }
  }
  return kNone;
}

/// Tells anew which corners are ears; says whether any is.
bool EarClipper::scan(Demand demand) {
  bool any = false;
  std::size_t corner = current_;
  for (std::size_t i = 0; i < left_; ++i, corner = next_[corner]) {
    any = look_at(corner, demand) || any;
    if (any && demand == Demand::kInside) break;  // one is enough
  }
  return any;
}

/// Clips where there is no ear: no weakly simple polygon comes here, but the
/// program has to end on the others too. Straight corners first, then left
/// turns, then the next.
void EarClipper::clip_any() {
  std::size_t best = current_;
  int best_rank = 0;
  std::size_t corner = current_;
  for (std::size_t i = 0; i < left_; ++i, corner = next_[corner]) {
    const Int128 turned = turn_at(corner);
    const int rank = turned == 0 ? 2 : turned > 0 ? 1 : 0;
    if (rank > best_rank) {
      best = corner;
      best_rank = rank;
    }
  }
  clip_at(best);
}

std::vector<std::array<std::size_t, 3>> EarClipper::clip() {
  for (std::size_t i = 0; i < corners_.size() && left_ >= 3; ++i) {
    if (next_[previous_[i]] == i) remove_spikes(i);
  }
  scan(Demand::kEar);
  while (left_ >= 3) {
    const std::size_t ear = take_ear();
    if (ear != kNone)
      clip_at(ear);
    else if (!scan(Demand::kEar) && !scan(Demand::kInside))
      clip_any();
  }
  return std::move(triangles_);
}

}  // namespace

Shape shape_of(std::span<const GridPoint> corners) {
  const std::size_t count = corners.size();
  if (count < 3) return Shape::kNoArea;
  Vector normal;
  for (std::size_t i = 0; i < count && is_zero(normal); ++i) {
    normal =
        cross(difference(corners[(i + 1) % count], corners[i]),
              difference(corners[(i + 2) % count], corners[(i + 1) % count]));
  }
  if (is_zero(normal)) return Shape::kNoArea;
  if (count == 3) return Shape::kConvex;
  for (const GridPoint& corner : corners) {
    if (!is_on_plane(normal, difference(corner, corners[0]))) {
      return Shape::kOther;
    }
  }
  return turns_once(corners, normal) ? Shape::kConvex : Shape::kOther;
}

std::vector<std::array<std::size_t, 3>> triangulate(
    std::span<const GridPoint> corners) {
  return EarClipper(corners).clip();
}

}  // namespace halfspace::io
