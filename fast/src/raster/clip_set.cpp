#include "raster/clip_set.hpp"

#include <algorithm>
#include <cmath>

#include "raster/render_pass.hpp"
#include "tree/tree_access.hpp"

namespace halfspace::fast {

/// With M = 2^(n-1), u = 2^-53 and N the sum of the normal's sizes, a value at
/// a point of the scene is off by u of each of the four coefficients' shares,
/// u for each product and 3u for the sums: 5u (N M + |d|), 8u with room for a
/// new vertex and for the bound's own roundings.
ClipSet::ClipSet(const std::vector<ClipPlane>& planes, bool has_caps,
                 int grid_bits)
    : exact_(&planes),
      has_caps_(has_caps && !planes.empty()),
      rounding_(rounding_of_values(grid_bits)) {
  for (const ClipPlane& clip : planes) add_filter(rounded(clip), grid_bits);
}

void ClipSet::add_filter(const Plane& coefficients, int grid_bits) {
  const double limit = std::ldexp(1.0, grid_bits - 1);
  const FilterPlane plane = filter_plane(coefficients);
  planes_.push_back(
      {plane, 8 * kRounding * (plane.size * limit + std::abs(plane.plane.d))});
}

ClipSet ClipSet::moved(const ObjectMap& to_world, int grid_bits) const {
  ClipSet result = *this;
  result.planes_.clear();
  result.rounding_ = rounding_of_values(grid_bits);
  for (const ClipPlane& clip : *exact_) {
    result.moved_.emplace_back(clip, to_world);
    result.add_filter(rounded(result.moved_.back()), grid_bits);
  }
  return result;
}

int ClipSet::sign_at(std::size_t k, const GridPoint& p) const {
  return moved_.empty() ? fast::sign_at((*exact_)[k], p) : moved_[k].sign_at(p);
}

ClipState ClipSet::classify(const Box& box) const {
  ClipState state;
  for (std::size_t k = 0; k < planes_.size(); ++k) {
    const auto& [plane, error] = planes_[k];
    const double n[3] = {plane.plane.a, plane.plane.b, plane.plane.c};
    double least = plane.plane.d;
    double most = plane.plane.d;
    for (std::size_t a = 0; a < 3; ++a) {
      const double l = n[a] * double{box.low[a]};
      const double h = n[a] * double{box.high[a]};
      least += std::min(l, h);
      most += std::max(l, h);
    }
    // A box reaches beyond the grid by a few of its own roundings at most.
    if (filtered_sign({most, 2 * error}) < 0) return {true, 0};
    if (filtered_sign({least, 2 * error}) <= 0) state.mask |= ClipMask{1} << k;
  }
  return state;
}

namespace {

/// Those that have a corner in front of the plane, and one that is not.
std::vector<PolygonId> crossing_polygons(const Scene& scene,
                                         const ClipPlane& plane) {
  std::vector<PolygonId> found;
  const auto count = static_cast<PolygonId>(scene.polygon_count());
  for (PolygonId polygon = 0; polygon < count; ++polygon) {
    bool is_before = false;
    bool is_behind = false;
    for (const VertexId corner : scene.corners(polygon)) {
      const bool is_positive = sign_at(plane, scene.point(corner)) > 0;
      is_before = is_before || is_positive;
      is_behind = is_behind || !is_positive;
    }
    if (is_before && is_behind) found.push_back(polygon);
  }
  return found;
}

}  // namespace

std::vector<PolygonId> crossing_polygons(const TreeReader& reader,
                                         const ClipPlane& plane) {
  // The root of a lazy tree has no fragments, only cells; and what covers no
  // pixel bounds caps, too.
  const BspTree& tree = reader.tree();
  if (tree.is_list || (kLazyTrees && tree.fragments.empty()))
    return crossing_polygons(reader.scene(), plane);
  const std::vector<ClipPlane> one = {plane};
  return crossing_polygons(reader,
                           ClipSet(one, false, reader.scene().grid_bits()));
}

std::vector<PolygonId> crossing_polygons(const TreeReader& reader,
                                         const ClipSet& clip) {
  const BspTree& tree = reader.tree();
  const bool has_boxes = tree.boxes.size() == tree.nodes.size();
  std::vector<PolygonId> found;
  std::vector<NodeId> ahead;
  if (!tree.nodes.empty()) ahead.push_back(0);
  while (!ahead.empty()) {
    const NodeId id = ahead.back();
    ahead.pop_back();
    if (has_boxes) {
      const ClipState state =
          clip.classify(tree.boxes[static_cast<std::size_t>(id)]);
      if (state.is_gone || state.mask == 0) continue;
    }
    const Node& node = node_at(tree, id);
    for_fragments(tree, node, [&](const TreeFragment& fragment) {
      found.push_back(fragment.source);
      return true;
    });
    for (const NodeId child : {node.positive, node.negative}) {
      if (child != kNoNode) ahead.push_back(child);
    }
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

int FragmentClipper::sign_at_corner(std::size_t plane, const At& at,
                                    const Bounded& value) {
  const int known = filtered_sign(value);
  if (known != 0 || at.index < 0) return known;
  return set_.sign_at(plane, reader_.scene().point(at.index));
}

FragmentClipper::Cut FragmentClipper::cut(std::size_t plane) {
  const ClipSet::Filter& filter = set_.planes_[plane];
  values_.clear();
  signs_.clear();
  bool some_positive = false;
  bool some_negative = false;
  bool in_doubt = false;
  for (const At& at : corners_) {
    const Plane& p = filter.plane.plane;
    const Vertex& v = at.vertex;
    const Bounded value = {
        p.a * v.x + p.b * v.y + p.c * v.z + p.d,
        filter.plane.size * v.error * (1 + 0x1p-40) + filter.error};
    const int sign = sign_at_corner(plane, at, value);
    // 0 of a corner of the scene is exact.
    in_doubt = in_doubt || (sign == 0 && at.index < 0);
    some_positive = some_positive || sign > 0;
    some_negative = some_negative || sign < 0;
    values_.push_back(value);
    signs_.push_back(static_cast<std::int8_t>(sign));
  }
  if (in_doubt) return Cut::kDoubt;
  if (!some_negative) {
    const bool lies_in_it = !some_positive;
    return lies_in_it && set_.has_caps() ? Cut::kGone : Cut::kWhole;
  }
  if (!some_positive) return Cut::kGone;
  next_.clear();
  for (std::size_t k = 0; k < corners_.size(); ++k) {
    const std::size_t l = k + 1 == corners_.size() ? 0 : k + 1;
    if (signs_[k] >= 0) next_.push_back(corners_[k]);
    if (signs_[k] * signs_[l] < 0) {
      next_.push_back({meet(corners_[k].vertex, values_[k], corners_[l].vertex,
                            values_[l], set_.rounding_),
                       -1});
    }
  }
  corners_.swap(next_);
  return Cut::kCut;
}

ClippedFragment FragmentClipper::clip(const TreeFragment& fragment,
                                      ClipMask mask) {
  corners_.clear();
  const auto count =
      static_cast<std::int32_t>(reader_.scene().data().vertices.size());
  for (const Corner& corner : reader_.corners(fragment)) {
    corners_.push_back({reader_.vertex(corner.vertex),
                        corner.vertex < count ? corner.vertex : -1});
  }
  ClippedFragment result;
  bool in_doubt = false;
  for (std::size_t k = 0; mask >> k != 0; ++k) {
    if ((mask >> k & 1u) == 0) continue;
    const Cut found = cut(k);
    if (found == Cut::kGone) return {true, 0, {}};
    if (found == Cut::kWhole) continue;
    result.cuts |= ClipMask{1} << k;
    in_doubt = in_doubt || found == Cut::kDoubt;
  }
  if (in_doubt) return result;
  result_.clear();
  for (const At& at : corners_) result_.push_back(at.vertex);
  result.corners = result_;
  return result;
}

}  // namespace halfspace::fast
