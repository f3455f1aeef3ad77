#include "rounding/drop_corners.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <span>
#include <utility>

namespace halfspace::fast {
namespace {

using Ring = std::vector<std::int32_t>;

StepPoint difference_of(const StepPoint& from, const StepPoint& to) {
  return {to[0] - from[0], to[1] - from[1], to[2] - from[2]};
}
StepPoint cross_of(const StepPoint& u, const StepPoint& v) {
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
          u[0] * v[1] - u[1] * v[0]};
}
double product_of(const StepPoint& u, const StepPoint& v) {
  return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}
double length_of(const StepPoint& u) { return std::sqrt(product_of(u, u)); }

class CornerDropper {
 public:
  CornerDropper(GridMesh& mesh, std::vector<LoosePoint>& loose,
                std::span<const std::uint64_t> kind, double most)
      : mesh_(mesh), loose_(loose), kind_(kind), most_(most) {
    const std::size_t count = mesh.points.size();
    is_loose_.resize(count);
    places_.resize(count);
    changed_.resize(count, -1);
    moves_.resize(mesh.triangles.size());
    for (std::size_t p = 0; p < count; ++p) {
      const GridPoint& at = mesh.points[p];
      places_[p] = {static_cast<double>(at.x), static_cast<double>(at.y),
                    static_cast<double>(at.z)};
    }
    for (const LoosePoint& p : loose) {
      is_loose_[index(p.point)] = 1;
      places_[index(p.point)] = p.at;
    }
    first_.resize(count + 1);
    for_loose_corners([&](std::size_t c, std::int32_t) { ++first_[c + 1]; });
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    uses_.resize(first_.back());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for_loose_corners(
        [&](std::size_t c, std::int32_t t) { uses_[next[c]++] = t; });
  }

  double run() {
    std::vector<std::int32_t> todo;
    for (const LoosePoint& p : loose_) todo.push_back(p.point);
    bool any = false;
    for (const std::int32_t p : todo) any = drop(p) || any;
    if (any) renumber();
    return moved_;
  }

 private:
  static std::size_t index(std::int32_t i) {
    return static_cast<std::size_t>(i);
  }
  template <class Call>
  void for_loose_corners(Call&& call) const {
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      for (const std::int32_t c : mesh_.triangles[t].corners) {
        if (is_loose_[index(c)] != 0)
          call(index(c), static_cast<std::int32_t>(t));
      }
    }
  }
  /// The triangles at a loose corner.
  std::span<const std::int32_t> star_of(std::int32_t corner) const {
    const std::int32_t list = changed_[index(corner)];
    if (list >= 0) return lists_[index(list)];
    const std::size_t first = first_[index(corner)];
    return std::span(uses_).subspan(first, first_[index(corner) + 1] - first);
  }
  /// The same to change. Valid until another one is asked for.
  std::vector<std::int32_t>& own_star(std::int32_t corner) {
    std::int32_t& list = changed_[index(corner)];
    if (list < 0) {
      const auto star = star_of(corner);
      list = static_cast<std::int32_t>(lists_.size());
      lists_.emplace_back(star.begin(), star.end());
    }
    return lists_[index(list)];
  }
  const StepPoint& at(std::int32_t p) const { return places_[index(p)]; }
  std::array<std::int32_t, 3>& corners(std::int32_t t) {
    return mesh_.triangles[index(t)].corners;
  }
  const std::array<std::int32_t, 3>& corners(std::int32_t t) const {
    return mesh_.triangles[index(t)].corners;
  }

  StepPoint normal_of(std::int32_t a, std::int32_t b, std::int32_t c) const {
    return cross_of(difference_of(at(a), at(b)), difference_of(at(a), at(c)));
  }
  double height_of(std::int32_t a, std::int32_t b, std::int32_t c) const {
    const double longest = std::max({length_of(difference_of(at(a), at(b))),
                                     length_of(difference_of(at(b), at(c))),
                                     length_of(difference_of(at(c), at(a)))});
    return longest > 0 ? length_of(normal_of(a, b, c)) / longest : 0;
  }

  /// The neighbours round a corner, in the order of its triangles; `star` then
  /// has those in the same order. Empty where they are not one cycle. Valid
  /// until the next one.
  const Ring& ring_of(std::int32_t corner, std::vector<std::int32_t>& star) {
    auto& steps = steps_;
    steps.clear();
    for (const std::int32_t t : star) {
      const auto& c = corners(t);
      const auto i = index(static_cast<std::int32_t>(
          std::find(c.begin(), c.end(), corner) - c.begin()));
      steps.push_back({c[(i + 1) % 3], c[(i + 2) % 3], t});
    }
    std::sort(steps.begin(), steps.end());
    Ring& ring = ring_;
    ring.clear();
    star.clear();
    std::int32_t next = steps.front()[0];
    for (std::size_t n = 0; n < steps.size(); ++n) {
      const auto place =
          std::lower_bound(steps.begin(), steps.end(),
                           std::array<std::int32_t, 3>{next, -1, -1});
      const bool goes_on = place != steps.end() && (*place)[0] == next;
      if (!goes_on || (place + 1 != steps.end() && (*(place + 1))[0] == next) ||
          (n > 0 && next == steps.front()[0])) {
        ring.clear();
        return ring;
      }
      ring.push_back(next);
      star.push_back((*place)[2]);
      next = (*place)[1];
    }
    if (next != steps.front()[0]) ring.clear();
    return ring;
  }

  /// Whether the triangles on either side of the edge to ring[i] are not nearly
  /// in one plane, or of two kinds.
  bool is_sharp(std::int32_t corner, const Ring& ring,
                const std::vector<std::int32_t>& star, std::size_t i) const {
    const std::size_t n = ring.size();
    if (kind_[index(star[i])] != kind_[index(star[(i + n - 1) % n])])
      return true;
    const std::int32_t before = ring[(i + n - 1) % n];
    const std::int32_t on = ring[i], after = ring[(i + 1) % n];
    const StepPoint u = normal_of(corner, before, on);
    const StepPoint v = normal_of(corner, on, after);
    if (product_of(u, v) <= 0) return true;
    return off_plane(u, corner, after) > most_ &&
           off_plane(v, corner, before) > most_;
  }
  /// How far a point is from the plane through another.
  double off_plane(const StepPoint& normal, std::int32_t through,
                   std::int32_t point) const {
    const double length = length_of(normal);
    if (length == 0) return 0;
    return std::abs(product_of(normal, difference_of(at(through), at(point)))) /
           length;
  }
  double off_line(std::int32_t p, std::int32_t q, std::int32_t point) const {
    const double length = length_of(difference_of(at(p), at(q)));
    return length > 0 ? length_of(normal_of(p, q, point)) / length : most_ + 1;
  }

  bool drop(std::int32_t corner);
  bool try_onto(std::int32_t corner, const Ring& ring,
                const std::vector<std::int32_t>& star, std::size_t p,
                std::size_t q);
  double side_move(std::int32_t corner, const Ring& ring, std::size_t first,
                   std::size_t count, std::int32_t onto) const;
  bool has_other_common_neighbours(std::int32_t onto, const Ring& ring,
                                   std::size_t p) const;
  void renumber();

  GridMesh& mesh_;
  std::vector<LoosePoint>& loose_;
  std::span<const std::uint64_t> kind_;
  double most_;
  double moved_ = 0;
  std::vector<std::uint8_t> is_loose_;
  std::vector<StepPoint> places_;
  // Of loose corners: the triangles at them, one corner's after the other's,
  // and lists of those where that changed.
  std::vector<std::uint32_t> first_;
  std::vector<std::int32_t> uses_;
  std::vector<std::int32_t> changed_;  ///< which list, or -1
  std::vector<std::vector<std::int32_t>> lists_;
  /// For ring_of(): from, to, triangle.
  std::vector<std::array<std::int32_t, 3>> steps_;
  std::vector<std::int32_t> star_;  ///< for drop()
  Ring ring_;                       ///< for ring_of()
  /// By triangle: how far it is from the surface that was, at most.
  std::vector<double> moves_;
};

/// Whether the corner was dropped.
bool CornerDropper::drop(std::int32_t corner) {
  std::vector<std::int32_t>& star = star_;
  const auto found = star_of(corner);
  star.assign(found.begin(), found.end());
  if (star.size() < 3) return false;
  const Ring& ring = ring_of(corner, star);
  if (ring.empty()) return false;
  std::array<std::size_t, 2> sharp;
  std::size_t count = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    if (!is_sharp(corner, ring, star, i)) continue;
    if (count == 2) return false;
    sharp[count++] = i;
  }
  if (count != 2) return false;
  if (product_of(difference_of(at(corner), at(ring[sharp[0]])),
                 difference_of(at(corner), at(ring[sharp[1]]))) >= 0)
    return false;
  for (const auto& [p, q] :
       {std::pair(sharp[0], sharp[1]), std::pair(sharp[1], sharp[0])}) {
    if (is_loose_[index(ring[p])] != 0 && try_onto(corner, ring, star, p, q))
      return true;
  }
  return false;
}

/// How far the `count` triangles from ring[first] on, which have the corner,
/// are from those that have `onto` in its place; more than allowed where these
/// would turn over or be thin.
double CornerDropper::side_move(std::int32_t corner, const Ring& ring,
                                std::size_t first, std::size_t count,
                                std::int32_t onto) const {
  const std::size_t n = ring.size();
  const auto on = [&](std::size_t i) { return ring[(first + i) % n]; };
  StepPoint normal{};
  double largest = -1, height = 16 * most_;
  for (std::size_t i = 0; i < count; ++i) {
    const StepPoint of = normal_of(corner, on(i), on(i + 1));
    height = std::min(height, height_of(corner, on(i), on(i + 1)));
    if (length_of(of) <= largest) continue;
    largest = length_of(of);
    normal = of;
  }
  double move = 0;
  for (std::size_t i = 0; i <= count; ++i)
    move = std::max(move, off_plane(normal, corner, on(i)));
  for (std::size_t i = 0; i < count; ++i) {
    if (on(i) == onto || on(i + 1) == onto) continue;
    if (product_of(normal_of(onto, on(i), on(i + 1)), normal) <= 0 ||
        height_of(onto, on(i), on(i + 1)) < height)
      return 2 * most_;
  }
  return 2 * move;
}

/// Whether more of a corner's neighbours than those beside ring[p] are
/// neighbours of ring[p], too: then an edge would be there twice.
bool CornerDropper::has_other_common_neighbours(std::int32_t onto,
                                                const Ring& ring,
                                                std::size_t p) const {
  Ring near;
  for (const std::int32_t t : star_of(onto))
    near.insert(near.end(), corners(t).begin(), corners(t).end());
  std::sort(near.begin(), near.end());
  for (std::size_t i = 2; i + 1 < ring.size(); ++i) {
    if (std::binary_search(near.begin(), near.end(),
                           ring[(p + i) % ring.size()]))
      return true;
  }
  return false;
}

/// Puts ring[p] in the corner's place, where the crease goes on to ring[q].
bool CornerDropper::try_onto(std::int32_t corner, const Ring& ring,
                             const std::vector<std::int32_t>& star,
                             std::size_t p, std::size_t q) {
  const std::size_t n = ring.size();
  const std::int32_t onto = ring[p];
  if (n < 4 || has_other_common_neighbours(onto, ring, p)) return false;
  const std::size_t first = (q + n - p) % n;
  const double own = std::max({side_move(corner, ring, p, first, onto),
                               side_move(corner, ring, q, n - first, onto),
                               2 * off_line(onto, ring[q], corner)});
  double before = 0;
  for (const std::int32_t t : star) before = std::max(before, moves_[index(t)]);
  if (before + own > most_) return false;
  moved_ = std::max(moved_, before + own);
  for (std::size_t i = 0; i < n; ++i) {
    const std::int32_t t = star[i];
    moves_[index(t)] = before + own;
    const bool goes = i == p || (i + 1) % n == p;
    for (std::int32_t& c : corners(t)) {
      if (is_loose_[index(c)] != 0 && goes && c != corner)
        std::erase(own_star(c), t);
    }
    if (goes) {
      corners(t) = {-1, -1, -1};
      continue;
    }
    std::replace(corners(t).begin(), corners(t).end(), corner, onto);
    own_star(onto).push_back(t);
  }
  own_star(corner).clear();
  return true;
}

/// Drops the triangles that went, and the points that none has any more.
void CornerDropper::renumber() {
  std::erase_if(mesh_.triangles,
                [](const GridTriangle& t) { return t.corners[0] < 0; });
  std::vector<std::int32_t> number(mesh_.points.size(), -1);
  for (const GridTriangle& t : mesh_.triangles) {
    for (const std::int32_t c : t.corners) number[index(c)] = 0;
  }
  std::int32_t count = 0;
  for (std::int32_t& n : number) {
    if (n == 0) n = count++;
  }
  std::erase_if(
      loose_, [&](const LoosePoint& p) { return number[index(p.point)] < 0; });
  for (LoosePoint& p : loose_) p.point = number[index(p.point)];
  drop_unused_points(mesh_);
}

}  // namespace

double drop_straight_corners(GridMesh& mesh, std::vector<LoosePoint>& loose,
                             std::span<const std::uint64_t> kind, double most) {
  if (loose.empty() || most <= 0) return 0;
  return CornerDropper(mesh, loose, kind, most).run();
}

}  // namespace halfspace::fast
