#include "rounding/untangle.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "rounding/grid_predicates.hpp"

namespace halfspace::fast {
namespace {

/// How far a point goes at most from where it would be rounded to, in spacings.
constexpr std::int64_t kReach = 2;
/// How often all points are tried.
constexpr std::size_t kSweeps = 8;
/// Corners of more triangles stay: they would take too long.
constexpr std::size_t kMostTriangles = 64;
/// How many pairs of triangles are looked at for each triangle of the mesh, and
/// in any case.
constexpr std::size_t kPairsEach = 64;
constexpr std::size_t kPairsAlways = 1'000'000;

/// A box of grid points.
struct GridBox {
  std::array<std::int64_t, 3> low, high;
};

GridBox grid_box(const GridPoint& a, const GridPoint& b, const GridPoint& c) {
  return {{std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y}),
           std::min({a.z, b.z, c.z})},
          {std::max({a.x, b.x, c.x}), std::max({a.y, b.y, c.y}),
           std::max({a.z, b.z, c.z})}};
}

bool overlap(const GridBox& a, const GridBox& b) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (a.low[k] > b.high[k] || b.low[k] > a.high[k]) return false;
  }
  return true;
}

/// The square of the distance.
double apart(const StepPoint& from, const GridPoint& to) {
  double sum = 0;
  const StepPoint at = step_point(to);
  for (std::size_t k = 0; k < 3; ++k)
    sum += (at[k] - from[k]) * (at[k] - from[k]);
  return sum;
}

class Untangler {
 public:
  Untangler(GridMesh& mesh, const MeshIndex& index, const FileGrid& grid)
      : mesh_(mesh), index_(index), grid_(grid) {
    result_.changed.resize(mesh.points.size());
    is_in_star_.resize(mesh.triangles.size());
    pairs_left_ = kPairsAlways + kPairsEach * mesh.triangles.size();
  }

  Untangled run(const MeshContacts& contacts,
                const std::vector<std::uint8_t>& may,
                const std::vector<LoosePoint>& loose) {
    const std::size_t loose_count = take_corners(may, loose);
    take_stars(contacts);
    std::size_t count = loose_count;
    for (std::size_t sweep = 0; sweep < kSweeps; ++sweep) {
      bool any = false;
      for (std::size_t i = 0; i < count && pairs_left_ > 0; ++i)
        any = improve(corners_[i]) || any;
      if (!any && count == corners_.size()) break;
      count = corners_.size();
    }
    note_farthest();
    return std::move(result_);
  }

 private:
  /// Triangles that may meet, one of them of the corner that is tried.
  struct Pair {
    std::int32_t own;
    std::int32_t other;
  };
  /// A point that may move.
  struct Corner {
    std::int32_t point = 0;
    StepPoint place;                 ///< where it was to be
    std::vector<std::int32_t> star;  ///< its triangles
    std::vector<Pair> met;           ///< of its triangles, in the beginning
    bool was_tried = false;
    bool is_done = false;  ///< when it was last looked at none met any more
  };

  const GridTriangle& triangle(std::int32_t t) const {
    return mesh_.triangles[static_cast<std::size_t>(t)];
  }
  GridBox box(std::int32_t t) const {
    const auto& c = triangle(t).corners;
    return grid_box(mesh_.at(c[0]), mesh_.at(c[1]), mesh_.at(c[2]));
  }

  std::size_t take_corners(std::vector<std::uint8_t> may,
                           const std::vector<LoosePoint>& loose);
  void take_stars(const MeshContacts& contacts);
  void find_pairs(const Corner& corner);
  bool have_areas(const Corner& corner) const;
  std::size_t meetings(std::size_t most);
  std::vector<GridPoint> places_near(const StepPoint& place) const;
  bool pair_meets(const Pair& pair) const;
  bool improve(Corner& corner);
  bool move(const Corner& corner, std::size_t& fewest);
  void note_farthest();

  GridMesh& mesh_;
  const MeshIndex& index_;
  const FileGrid& grid_;
  std::vector<Corner> corners_;
  std::vector<Pair> pairs_;
  std::vector<std::uint8_t> is_in_star_;  ///< by triangle: the corner's
  std::size_t pairs_left_ = 0;
  Untangled result_;
};

/// Takes the points that may move, those that were loose first. Returns how
/// many these are.
std::size_t Untangler::take_corners(std::vector<std::uint8_t> may,
                                    const std::vector<LoosePoint>& loose) {
  for (const LoosePoint& p : loose) {
    if (std::exchange(may[static_cast<std::size_t>(p.point)],
                      std::uint8_t{0}) != 0)
      corners_.push_back({p.point, p.at, {}, {}});
  }
  const std::size_t count = corners_.size();
  for (std::size_t p = 0; p < may.size(); ++p) {
    if (may[p] == 0) continue;
    const auto point = static_cast<std::int32_t>(p);
    corners_.push_back({point, step_point(mesh_.at(point)), {}, {}});
  }
  return count;
}

void Untangler::take_stars(const MeshContacts& contacts) {
  std::vector<std::int32_t> number(mesh_.points.size(), -1);
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    number[static_cast<std::size_t>(corners_[i].point)] =
        static_cast<std::int32_t>(i);
  }
  for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
    for (const std::int32_t c : mesh_.triangles[t].corners) {
      const std::int32_t i = number[static_cast<std::size_t>(c)];
      if (i < 0) continue;
      corners_[static_cast<std::size_t>(i)].star.push_back(
          static_cast<std::int32_t>(t));
    }
  }
  for (const auto& [first, second] : contacts.pairs) {
    for (const std::int32_t t : {first, second}) {
      for (const std::int32_t c : triangle(t).corners) {
        const std::int32_t i = number[static_cast<std::size_t>(c)];
        if (i < 0) continue;
        corners_[static_cast<std::size_t>(i)].met.push_back({first, second});
      }
    }
  }
}

/// The pairs that may meet wherever the corner goes. What the index knows of
/// other triangles may be as old as the first sweep.
void Untangler::find_pairs(const Corner& corner) {
  pairs_.clear();
  for (const std::int32_t t : corner.star)
    is_in_star_[static_cast<std::size_t>(t)] = 1;
  const std::int64_t margin = (2 * kReach + 1) * grid_.spacing();
  for (const std::int32_t t : corner.star) {
    GridBox reach = box(t);
    Box wide;
    for (std::size_t k = 0; k < 3; ++k) {
      reach.low[k] -= margin;
      reach.high[k] += margin;
      wide.low[k] = rounded_down(static_cast<double>(reach.low[k] - margin));
      wide.high[k] = rounded_up(static_cast<double>(reach.high[k] + margin));
    }
    index_.find(wide, [&](std::int32_t other) {
      const bool is_own = is_in_star_[static_cast<std::size_t>(other)] != 0;
      if (is_own ? other > t : overlap(reach, box(other)))
        pairs_.push_back({t, other});
    });
  }
  for (const std::int32_t t : corner.star)
    is_in_star_[static_cast<std::size_t>(t)] = 0;
}

bool Untangler::have_areas(const Corner& corner) const {
  return std::none_of(
      corner.star.begin(), corner.star.end(), [&](std::int32_t t) {
        const auto& c = triangle(t).corners;
        return on_one_line(mesh_.at(c[0]), mesh_.at(c[1]), mesh_.at(c[2]));
      });
}

bool Untangler::pair_meets(const Pair& pair) const {
  return overlap(box(pair.own), box(pair.other)) &&
         triangles_meet(mesh_, triangle(pair.own), triangle(pair.other));
}

/// How many pairs meet; `most` if they are as many or more. The one that made
/// them so is looked at first the next time.
std::size_t Untangler::meetings(std::size_t most) {
  std::size_t count = 0;
  for (Pair& pair : pairs_) {
    if (pairs_left_ > 0) --pairs_left_;
    if (!pair_meets(pair)) continue;
    std::swap(pair, pairs_[count]);
    if (++count == most) break;
  }
  return count;
}

/// Places on the grid, the nearest first.
std::vector<GridPoint> Untangler::places_near(const StepPoint& place) const {
  const std::int64_t step = grid_.spacing();
  const GridPoint middle = grid_.rounded(place, step);
  std::vector<std::pair<double, GridPoint>> places;
  for (std::int64_t x = -kReach; x <= kReach; ++x) {
    for (std::int64_t y = -kReach; y <= kReach; ++y) {
      for (std::int64_t z = -kReach; z <= kReach; ++z) {
        const GridPoint at = {middle.x + x * step, middle.y + y * step,
                              middle.z + z * step};
        // At the ends of the numbers' range there are fewer.
        if (grid_.rounded(step_point(at), step) == at)
          places.emplace_back(apart(place, at), at);
      }
    }
  }
  std::sort(places.begin(), places.end());
  std::vector<GridPoint> result;
  for (const auto& [far, at] : places) result.push_back(at);
  return result;
}

/// Moves a corner, if that helps. Nothing is to be done where what met is apart
/// already: who moves into another one's way tries again.
bool Untangler::improve(Corner& corner) {
  if (corner.is_done || corner.star.size() > kMostTriangles) return false;
  if (!std::exchange(corner.was_tried, true) &&
      std::none_of(corner.met.begin(), corner.met.end(),
                   [&](const Pair& pair) { return pair_meets(pair); })) {
    corner.is_done = true;
    return false;
  }
  find_pairs(corner);
  std::size_t fewest = meetings(pairs_.size() + 1);
  const bool moved = fewest > 0 && move(corner, fewest);
  corner.is_done = fewest == 0;
  return moved;
}

/// Moves a corner to where fewer of its pairs meet, `fewest` so far.
bool Untangler::move(const Corner& corner, std::size_t& fewest) {
  const auto p = static_cast<std::size_t>(corner.point);
  GridPoint& at = mesh_.points[p];
  const GridPoint old = at;
  GridPoint best = old;
  for (const GridPoint& place : places_near(corner.place)) {
    if (place == old) continue;
    at = place;
    const std::size_t count = meetings(fewest);
    if (count >= fewest || !have_areas(corner)) continue;
    fewest = count;
    best = place;
    if (fewest == 0) break;
  }
  at = best;
  if (best == old) return false;
  mesh_.moved[p] = 1;
  result_.changed[p] = 1;
  return true;
}

void Untangler::note_farthest() {
  for (const Corner& corner : corners_) {
    if (result_.changed[static_cast<std::size_t>(corner.point)] == 0) continue;
    const GridPoint& at = mesh_.at(corner.point);
    const double far = distance(corner.place, at);
    if (far > result_.farthest.distance) result_.farthest = {far, at};
  }
}

}  // namespace

Untangled untangle(GridMesh& mesh, const MeshContacts& contacts,
                   const std::vector<std::uint8_t>& may,
                   const std::vector<LoosePoint>& loose, const MeshIndex& index,
                   const FileGrid& grid) {
  return Untangler(mesh, index, grid).run(contacts, may, loose);
}

}  // namespace halfspace::fast
