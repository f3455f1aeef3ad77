#include "tree/fragment_splitter.hpp"

#include <utility>

#include "tree/split_walk.hpp"

namespace halfspace::fast {

Part TreeBuilder::whole(PolygonId polygon) {
  const auto corners = geometry_.scene().corners(polygon);
  const Part part{polygon, static_cast<std::uint32_t>(tree_.corners.size()),
                  static_cast<std::uint32_t>(corners.size())};
  for (std::size_t k = 0; k < corners.size(); ++k) {
    tree_.corners.push_back({static_cast<EdgeCode>(k), corners[k]});
  }
  return part;
}

Relation TreeBuilder::relation(const Part& part, PlaneId id,
                               const FilterPlane& plane) {
  const Corner* corners = tree_.corners.data() + part.first;
  signs_.resize(part.count);
  values_.resize(part.count);
  bool some_positive = false;
  bool some_negative = false;
  for (std::size_t k = 0; k < part.count; ++k) {
    values_[k] =
        value_at(plane, vertex(corners[k].vertex), geometry_.rounding());
    int found = known_sign(values_[k]);
    if (found != 0) {
      ++stats_.filtered;
    } else {
      const Corner& before = corners[k == 0 ? part.count - 1 : k - 1];
      found =
          geometry_.exact_sign(part.source, before.edge, corners[k].edge, id);
      ++stats_.exact;
      stats_.zero += found == 0 ? 1 : 0;
    }
    signs_[k] = static_cast<std::int8_t>(found);
    some_positive = some_positive || found > 0;
    some_negative = some_negative || found < 0;
  }
  return relation_of(some_positive, some_negative);
}

CutParts TreeBuilder::cut(const Part& part, PlaneId id,
                          const FilterPlane& plane) {
  std::int32_t crossing_vertex = 0;
  bool crossing_is_new = true;
  new_corners_[0].clear();
  new_corners_[1].clear();
  walk_cut(signs_, [&](int to, std::size_t k, bool crossing, bool cut) {
    const Corner* corners = tree_.corners.data() + part.first;
    std::int32_t index = corners[k].vertex;
    if (crossing) {
      // Told twice in a row: both parts share the vertex.
      if (crossing_is_new) {
        const std::size_t next = k + 1 == part.count ? 0 : k + 1;
        crossing_vertex = vertex_count_ +
                          static_cast<std::int32_t>(tree_.cut_vertices.size());
        const Vertex from_source =
            geometry_.crossing(part.source, corners[k].edge, plane);
        const Vertex from_ends =
            meet(vertex(index), values_[k], vertex(corners[next].vertex),
                 values_[next], geometry_.rounding());
        tree_.cut_vertices.push_back(
            from_source.error <= from_ends.error ? from_source : from_ends);
      }
      crossing_is_new = !crossing_is_new;
      index = crossing_vertex;
    }
    new_corners_[to > 0 ? 0 : 1].push_back(
        {cut ? splitter_edge(id) : corners[k].edge, index});
  });
  const auto add = [&](const std::vector<Corner>& corners) {
    const Part added{part.source,
                     static_cast<std::uint32_t>(tree_.corners.size()),
                     static_cast<std::uint32_t>(corners.size())};
    tree_.corners.insert(tree_.corners.end(), corners.begin(), corners.end());
    return added;
  };
  const Part positive = add(new_corners_[0]);
  return {positive, add(new_corners_[1])};
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
