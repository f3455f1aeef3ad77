#pragma once

#include <vector>

#include "exact/filter.hpp"
#include "sah/primitive.hpp"
#include "tree/fragment_splitter.hpp"

namespace halfspace::fast {

/// Reads the vertices of primitives.
struct PrimitiveReader {
  const Scene& scene;
  const BspTree& tree;
  const std::vector<FragmentRef>& parts;

  /// Calls take(x, y, z) for each of the primitive's vertices, rounded.
  template <class Take>
  void for_vertices(const Primitive& primitive, Take&& take) const {
    if (primitive.part == kWholePolygon) {
      for (const VertexId v : scene.corners(primitive.source)) {
        const GridPoint& p = scene.point(v);
        take(static_cast<double>(p.x), static_cast<double>(p.y),
             static_cast<double>(p.z));
      }
      return;
    }
    const FragmentRef& part = parts[static_cast<std::size_t>(primitive.part)];
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

/// A polygon's plane as a splitter.
struct PolygonSplit {
  SplitCost cost;
  PolygonId polygon = 0;
};

/// The best of `tried` planes of polygons in the list, and of its largest
/// polygon's, judged by a sample of the list. Polygons in the plane cost
/// nothing.
///
/// Cost: bounded for a given number of planes.
PolygonSplit best_polygon_split(const PrimitiveReader& reader,
                                const PrimitiveList& list, const Box& box,
                                const std::array<double, 3>& origin,
                                std::size_t tried, double cut_weight);

/// The overdraw of the list: the area of the image on which its polygons cover
/// each other, seen from a random direction, if they are spread evenly over the
/// box. Units: squares of grid steps.
///
/// A flat polygon shows half its area on average, a box a quarter of its
/// surface (Cauchy); areas A spread over a box that shows B overlap in A A / B.
double overdraw_of(const PrimitiveReader& reader, const PrimitiveList& list,
                   const Box& box);

/// The number of different vertices of the list's polygons, divided by that of
/// their corners: 1 where they share none. The polygons of a mesh share most of
/// their vertices, and hardly hide each other.
double distinct_vertex_ratio(const PrimitiveReader& reader,
                             const PrimitiveList& list,
                             std::vector<VertexId>& scratch);

}  // namespace halfspace::fast
