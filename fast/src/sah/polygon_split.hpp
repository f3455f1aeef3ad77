#pragma once

#include <vector>

#include "exact/filter.hpp"
#include "sah/primitive.hpp"
#include "tree/fragment_splitter.hpp"

namespace halfspace::fast {

/// What the vertices of items are read from.
struct ItemReader {
  const Scene& scene;
  const BspTree& tree;
  const std::vector<Part>& parts;

  /// Calls take(x, y, z) for each of the item's vertices, about.
  template <class Take>
  void for_vertices(const Item& item, Take&& take) const {
    if (item.part == kWhole) {
      for (const VertexId v : scene.corners(item.source)) {
        const GridPoint& p = scene.point(v);
        take(static_cast<double>(p.x), static_cast<double>(p.y),
             static_cast<double>(p.z));
      }
      return;
    }
    const Part& part = parts[static_cast<std::size_t>(item.part)];
    const auto vertex_count =
        static_cast<std::int32_t>(scene.data().vertices.size());
    for (std::uint32_t k = 0; k < part.count; ++k) {
      const std::int32_t v = tree.corners[part.first + k].vertex;
      const Vertex p =
          v < vertex_count
              ? to_vertex(scene.point(v))
              : tree.cut_vertices[static_cast<std::size_t>(v - vertex_count)];
      take(p.x, p.y, p.z);
    }
  }
};

/// The chances that a ray through a box meets the parts of it on either side of
/// a plane.
struct Chances {
  double positive = 1;
  double negative = 1;
};

/// `box` is in the coordinates of `plane`.
Chances chances_of(const std::array<double, 3>& low,
                   const std::array<double, 3>& high, const Plane& plane);

/// A polygon's plane.
struct OwnSplit {
  SplitCost cost;
  PolygonId polygon = 0;
};

/// The best of `tried` planes of polygons in the list, and of its largest
/// polygon's, judged by a sample of the list. What lies in a plane is settled.
///
/// Cost: bounded for a given number of planes.
OwnSplit best_own_split(const ItemReader& reader, const ItemList& list,
                        const Box& box, const std::array<double, 3>& origin,
                        std::size_t tried, double cut_weight);

/// How much of the image the list's polygons contend for with each other, seen
/// from anywhere, if they are strewn over the box. Units: squares of grid
/// steps.
///
/// A flat polygon shows half its area on average, a box a quarter of its
/// surface; of areas A strewn over a box that shows B, A A / B overlap.
double overlap_of(const ItemReader& reader, const ItemList& list,
                  const Box& box);

/// How many vertices the list's polygons have, for each corner: 1 where they
/// share none. Those of a mesh share most, and hide each other next to never.
double share_of_own_vertices(const ItemReader& reader, const ItemList& list,
                             std::vector<VertexId>& scratch);

}  // namespace halfspace::fast
