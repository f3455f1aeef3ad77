#include "sah/cell_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <set>

namespace halfspace::fast {
namespace {

std::int64_t coordinate_at(const GridPoint& p, std::size_t axis) {
  return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
}

/// A face's plane in doubles, positive outwards: where most primitives lie is a
/// guess, and need not be exact.
struct Outwards {
  std::array<double, 3> normal{};
  double offset = 0;

  /// The least and the greatest value in a primitive's box.
  std::pair<double, double> range(const Primitive& p) const {
    double least = offset;
    double most = offset;
    for (std::size_t a = 0; a < 3; ++a) {
      const double low = normal[a] * double{p.low[a]};
      const double high = normal[a] * double{p.high[a]};
      least += std::min(low, high);
      most += std::max(low, high);
    }
    return {least, most};
  }
};

Outwards box_face(const ObjectRegion& region, std::uint32_t index,
                  const GridPoint& origin) {
  const std::size_t axis = index / 2;
  const bool is_high = index % 2 == 1;
  const auto at = static_cast<double>(
      coordinate_at(is_high ? region.high : region.low, axis) -
      coordinate_at(origin, axis));
  Outwards face;
  face.normal[axis] = is_high ? 1 : -1;
  face.offset = is_high ? -at : at;
  return face;
}

Outwards slanted_face(const RegionFace& points, const GridPoint& origin) {
  std::array<std::array<double, 3>, 3> p;
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t a = 0; a < 3; ++a) {
      p[k][a] = static_cast<double>(coordinate_at(points[k], a) -
                                    coordinate_at(origin, a));
    }
  }
  Outwards face;
  for (std::size_t a = 0; a < 3; ++a) {
    const std::size_t u = (a + 1) % 3;
    const std::size_t v = (a + 2) % 3;
    face.normal[a] = (p[1][v] - p[0][v]) * (p[2][u] - p[0][u]) -
                     (p[1][u] - p[0][u]) * (p[2][v] - p[0][v]);
    face.offset -= face.normal[a] * p[0][a];
  }
  return face;
}

/// The side of a face that a region is on, or 0 if the face cuts it.
int side_of_region(const RegionFace& face, const ObjectRegion& region) {
  int side = 0;
  for (const GridPoint& p : corners_of(region)) {
    const int here = side_of(face, p);
    if (here != 0 && here == -side) return 0;
    if (here != 0) side = here;
  }
  return side;
}

/// The slanted face, or plane between two, that divides these regions most
/// evenly, of those that cut none.
std::optional<CellSplit> slanted_split(
    const KeptCells& cells, const std::vector<std::int32_t>& regions) {
  std::optional<CellSplit> best;
  std::size_t best_less = 0;
  const auto take = [&](std::int64_t plane) {
    const RegionFace& face =
        (*cells.slanted())[static_cast<std::size_t>(plane)];
    CellSplit split;
    split.plane = {kSlantedFace, plane};
    const bool cuts_none =
        std::all_of(regions.begin(), regions.end(), [&](std::int32_t r) {
          const int side = side_of_region(face, cells.region(r));
          (side > 0 ? split.positive : split.negative).push_back(r);
          return side != 0;
        });
    const std::size_t less =
        std::min(split.positive.size(), split.negative.size());
    if (!cuts_none || less <= best_less) return;
    best_less = less;
    best = std::move(split);
  };
  for (const std::int32_t of : regions) {
    const std::size_t count = cells.region(of).slanted.size();
    for (std::size_t f = 0; f < count; ++f)
      take(cells.first_slanted(of) + static_cast<std::int64_t>(f));
  }
  const std::set<std::int32_t> here(regions.begin(), regions.end());
  for (std::size_t k = 0; k < cells.pairs().size(); ++k) {
    const auto [a, b] = cells.pairs()[k];
    if (here.contains(a) && here.contains(b)) take(cells.plane_of_pair(k));
  }
  return best;
}

/// The pairs of regions whose boxes share space.
std::vector<std::pair<std::int32_t, std::int32_t>> close_pairs(
    const std::vector<MovingObject>& objects) {
  std::vector<std::int32_t> order(objects.size());
  std::iota(order.begin(), order.end(), 0);
  const auto box = [&](std::int32_t k) {
    const ObjectRegion& region = objects[static_cast<std::size_t>(k)].region;
    return ObjectRegion{region.low, region.high};
  };
  std::sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
    return std::pair(box(a).low.x, a) < std::pair(box(b).low.x, b);
  });
  std::vector<std::pair<std::int32_t, std::int32_t>> pairs;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const ObjectRegion first = box(order[i]);
    for (std::size_t j = i + 1; j < order.size(); ++j) {
      const ObjectRegion second = box(order[j]);
      if (second.low.x >= first.high.x) break;
      if (share_space(first, second)) pairs.emplace_back(order[i], order[j]);
    }
  }
  return pairs;
}

}  // namespace

KeptCells::KeptCells(const std::vector<MovingObject>& objects, bool cut)
    : objects_(objects), cut_(cut) {
  std::vector<RegionFace> faces;
  for (const MovingObject& object : objects) {
    first_slanted_.push_back(static_cast<std::int64_t>(faces.size()));
    const auto& slanted = object.region.slanted;
    faces.insert(faces.end(), slanted.begin(), slanted.end());
  }
  first_slanted_.push_back(static_cast<std::int64_t>(faces.size()));
  if (faces.empty()) return;
  for (const auto& [a, b] : close_pairs(objects)) {
    if (const auto plane = parting_plane(region(a), region(b))) {
      faces.push_back(*plane);
      pairs_.emplace_back(a, b);
    }
  }
  slanted_ = std::make_shared<const std::vector<RegionFace>>(std::move(faces));
}

void KeptCells::note_polygon(std::int32_t object, PolygonId polygon) {
  const Lock lock(mutex_);
  const std::pair<std::int32_t, PolygonId> found = {object, polygon};
  if (!filled_ || found < *filled_) filled_ = found;
}

void KeptCells::note_locked(std::int32_t object) {
  const Lock lock(mutex_);
  if (!locked_ || object < *locked_) locked_ = object;
}

std::optional<CellSplit> balanced_split(
    const KeptCells& cells, const std::vector<std::int32_t>& regions) {
  std::optional<FreePlane> best;
  std::size_t best_less = 0;  // regions in the smaller part
  std::vector<std::int32_t> order = regions;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto low = [&](std::int32_t r) {
      return coordinate_at(cells.region(r).low, axis);
    };
    std::sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
      return std::pair(low(a), a) < std::pair(low(b), b);
    });
    std::int64_t end = coordinate_at(cells.region(order[0]).high, axis);
    for (std::size_t k = 1; k < order.size(); ++k) {
      const std::size_t less = std::min(k, order.size() - k);
      if (low(order[k]) >= end && less > best_less) {
        best_less = less;
        // In the middle of the gap, where it serves both.
        const std::int64_t gap = low(order[k]) - end;
        best = FreePlane{static_cast<std::int32_t>(axis), end + gap / 2};
      }
      end = std::max(end, coordinate_at(cells.region(order[k]).high, axis));
    }
  }
  if (!best) return slanted_split(cells, regions);
  CellSplit split = {*best, {}, {}};
  for (const std::int32_t r : regions) {
    const bool is_above =
        coordinate_at(cells.region(r).low,
                      static_cast<std::size_t>(best->axis)) >= best->coordinate;
    (is_above ? split.positive : split.negative).push_back(r);
  }
  return split;
}

std::optional<FaceChoice> best_face(const KeptCells& cells, std::int32_t object,
                                    std::uint64_t used,
                                    const PrimitiveList& list,
                                    const GridPoint& origin) {
  const ObjectRegion& region = cells.region(object);
  const auto count = static_cast<std::uint32_t>(6 + region.slanted.size());
  if (list.count == 0) return std::nullopt;
  std::optional<std::uint32_t> best;
  double best_value = -1;
  for (std::uint32_t index = 0; index < count; ++index) {
    if ((used >> index & 1u) != 0) continue;
    const Outwards face = index < 6
                              ? box_face(region, index, origin)
                              : slanted_face(region.slanted[index - 6], origin);
    std::size_t beyond = 0;
    bool is_reached = false;
    for (const Primitive& p : list) {
      const auto [inner, outer] = face.range(p);
      beyond += inner >= 0 ? 1 : 0;
      is_reached = is_reached || outer >= 0;
    }
    const double value = static_cast<double>(beyond) + (is_reached ? 0.5 : 0.0);
    if (value <= best_value) continue;
    best_value = value;
    best = index;
  }
  if (!best) return std::nullopt;
  if (*best >= 6) {
    return FaceChoice{*best,
                      {{kSlantedFace, cells.first_slanted(object) + *best - 6},
                       {object},
                       {}}};
  }
  const std::size_t axis = *best / 2;
  const bool is_high = *best % 2 == 1;
  FaceChoice choice = {
      *best,
      {{static_cast<std::int32_t>(axis),
        coordinate_at(is_high ? region.high : region.low, axis)},
       {},
       {}}};
  (is_high ? choice.split.negative : choice.split.positive).push_back(object);
  return choice;
}

}  // namespace halfspace::fast
