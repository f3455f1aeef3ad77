#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "peers/soup.hpp"

namespace halfspace::bench {

/// A vertex as a graphics library takes it.
struct SharedVertex {
  std::array<float, 3> position;
  Pixel color;
  Pixel id;
};

/// Triangles as vertices and three indices each, every vertex transformed once
/// a frame: the best form for programs that transform vertices.
struct SharedVertices {
  std::vector<SharedVertex> vertices;
  std::vector<std::uint32_t> indices;
};

/// Corners that agree in place and corner colour are one vertex.
SharedVertices shared_for_smooth(const Soup& soup,
                                 const std::vector<std::uint32_t>& order);

/// Corners that agree in place are one vertex, except that the last corner of
/// each triangle, which names its flat colour, is its own: turned so that it
/// is a corner no other triangle needs as its last, where there is one.
SharedVertices shared_for_flat(const Soup& soup,
                               const std::vector<std::uint32_t>& order);

}  // namespace halfspace::bench
