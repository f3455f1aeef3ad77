#include "tree/fragment_splitter.hpp"

#include <utility>

#include "halfspace/assert.hpp"
#include "tree/split_walk.hpp"

namespace halfspace::fast {

FragmentRef FragmentSplitter::whole(PolygonId polygon) {
  const auto corners = planes_.scene().corners(polygon);
  const FragmentRef fragment{polygon,
                             static_cast<std::uint32_t>(tree_.corners.size()),
                             static_cast<std::uint32_t>(corners.size())};
  for (std::size_t k = 0; k < corners.size(); ++k) {
    tree_.corners.push_back({static_cast<EdgeCode>(k), corners[k]});
  }
  return fragment;
}

int FragmentSplitter::exact_sign(const FragmentRef& fragment, std::size_t k,
                                 PlaneId id) {
  const Corner* corners = tree_.corners.data() + fragment.first;
  const Corner& before = corners[k == 0 ? fragment.count - 1 : k - 1];
  const int sign =
      planes_.exact_sign(fragment.source, before.edge, corners[k].edge, id);
  ++stats_.exact;
  stats_.zero += sign == 0 ? 1 : 0;
  return sign;
}

Relation FragmentSplitter::relation(const FragmentRef& fragment, PlaneId id,
                                    const FilterPlane& plane) {
  const Corner* corners = tree_.corners.data() + fragment.first;
  signs_.resize(fragment.count);
  values_.resize(fragment.count);
  bool some_positive = false;
  bool some_negative = false;
  for (std::size_t k = 0; k < fragment.count; ++k) {
    values_[k] = value_at(plane, vertex(corners[k].vertex), planes_.rounding());
    int sign = filtered_sign(values_[k]);
    if (sign != 0) {
      ++stats_.filtered;
    } else {
      sign = exact_sign(fragment, k, id);
    }
    signs_[k] = static_cast<std::int8_t>(sign);
    some_positive = some_positive || sign > 0;
    some_negative = some_negative || sign < 0;
  }
  return relation_of(some_positive, some_negative);
}

FragmentPair FragmentSplitter::split(const FragmentRef& fragment, PlaneId id,
                                     const FilterPlane& plane) {
  HALFSPACE_ASSERT(signs_.size() == fragment.count);
  std::int32_t crossing_vertex = 0;
  bool crossing_is_new = true;
  new_corners_[0].clear();
  new_corners_[1].clear();
  walk_split(signs_, [&](int side, std::size_t k, bool crossing, bool cut) {
    Corner corner = tree_.corners[fragment.first + k];
    if (crossing) {
      // Both fragments share the vertex: their calls follow each other.
      if (crossing_is_new) crossing_vertex = add_crossing(fragment, k, plane);
      crossing_is_new = !crossing_is_new;
      corner.vertex = crossing_vertex;
    }
    if (cut) corner.edge = splitter_edge(id);
    new_corners_[side > 0 ? 0 : 1].push_back(corner);
  });
  HALFSPACE_ASSERT(new_corners_[0].size() >= 3);
  HALFSPACE_ASSERT(new_corners_[1].size() >= 3);
  const FragmentRef positive = add(fragment.source, new_corners_[0]);
  return {positive, add(fragment.source, new_corners_[1])};
}

/// Adds the point in which the plane passes through edge `k`: computed from the
/// edge's ends or from the source's corners, whichever is known better.
std::int32_t FragmentSplitter::add_crossing(const FragmentRef& fragment,
                                            std::size_t k,
                                            const FilterPlane& plane) {
  const Corner* corners = tree_.corners.data() + fragment.first;
  const std::size_t next = k + 1 == fragment.count ? 0 : k + 1;
  const Vertex from_source =
      planes_.crossing(fragment.source, corners[k].edge, plane);
  const Vertex from_ends =
      meet(vertex(corners[k].vertex), values_[k], vertex(corners[next].vertex),
           values_[next], planes_.rounding());
  tree_.cut_vertices.push_back(
      from_source.error <= from_ends.error ? from_source : from_ends);
  return vertex_count_ + static_cast<std::int32_t>(tree_.cut_vertices.size()) -
         1;
}

FragmentRef FragmentSplitter::add(PolygonId source,
                                  const std::vector<Corner>& corners) {
  const FragmentRef added{source,
                          static_cast<std::uint32_t>(tree_.corners.size()),
                          static_cast<std::uint32_t>(corners.size())};
  tree_.corners.insert(tree_.corners.end(), corners.begin(), corners.end());
  return added;
}

StandaloneFragment::StandaloneFragment(const Scene& scene,
                                       const Fragment& fragment,
                                       FilterStats& stats)
    : splitter_(scene, tree_, stats),
      ref_{fragment.source, 0,
           static_cast<std::uint32_t>(fragment.edges.size())} {
  HALFSPACE_ASSERT(fragment.edges.size() == fragment.vertices.size());
  tree_.cut_vertices = fragment.vertices;
  auto vertex = static_cast<std::int32_t>(scene.data().vertices.size());
  for (const EdgeName& edge : fragment.edges) {
    tree_.corners.push_back({code_of(edge), vertex++});
  }
}

Fragment StandaloneFragment::fragment_of(const FragmentRef& ref) const {
  Fragment fragment{ref.source, {}, {}};
  for (std::size_t k = 0; k < ref.count; ++k) {
    const Corner& corner = tree_.corners[ref.first + k];
    fragment.edges.push_back(name_of(corner.edge));
    fragment.vertices.push_back(splitter_.vertex(corner.vertex));
  }
  return fragment;
}

void drop_unused_corners(BspTree& tree) {
  std::vector<Corner> kept;
  for (TreeFragment& fragment : tree.fragments) {
    const auto from = tree.corners.begin() + fragment.first_corner;
    fragment.first_corner = static_cast<std::uint32_t>(kept.size());
    kept.insert(kept.end(), from, from + fragment.corner_count);
  }
  kept.shrink_to_fit();
  tree.corners = std::move(kept);
}

}  // namespace halfspace::fast
