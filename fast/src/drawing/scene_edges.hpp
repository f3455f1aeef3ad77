#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "halfspace/scene.hpp"

namespace halfspace::fast {

/// A polygon at an edge.
struct EdgeSide {
  PolygonId polygon = 0;
  std::int32_t direction = 1;  ///< -1: its side passes the edge backwards
};

/// An edge of a scene (S9.1).
struct SceneEdge {
  VertexId from = 0;
  VertexId to = 0;
  std::uint32_t first_side = 0;
  std::uint32_t side_count = 0;
};

/// The edges of a scene, with the polygons at each.
class SceneEdges {
 public:
  /// Polygons that are not `present` make none.
  SceneEdges(const Scene& scene, const std::vector<bool>& present);

  const std::vector<SceneEdge>& edges() const { return edges_; }
  std::span<const EdgeSide> sides(const SceneEdge& edge) const {
    return {sides_.data() + edge.first_side, edge.side_count};
  }
  /// The lowest vertex with the same coordinates.
  VertexId first_of(VertexId vertex) const {
    return first_[static_cast<std::size_t>(vertex)];
  }

 private:
  /// A side of a polygon, from the lower vertex to the higher.
  struct Side {
    VertexId from = 0;
    VertexId to = 0;
    EdgeSide side;
  };
  void join_vertices(const Scene& scene);
  void add(VertexId from, VertexId to, std::span<const Side> sides,
           int direction);
  void divide_lines(const Scene& scene, const std::vector<Side>& sides);

  std::vector<VertexId> first_;
  std::vector<SceneEdge> edges_;
  std::vector<EdgeSide> sides_;
};

}  // namespace halfspace::fast
