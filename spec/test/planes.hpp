#pragma once

#include "halfspace/polygon.hpp"

namespace halfspace {

/// A point of one of six planes along and across the axes, with normals of
/// every kind of sign.
inline GridPoint in_plane(int plane, std::int64_t u, std::int64_t v) {
  switch (plane) {
    case 0:
      return {u, v, 1};
    case 1:
      return {-1, u, v};
    case 2:
      return {v, 0, u};
    case 3:
      return {u, v, -u};
    case 4:
      return {v, -v, u};
    default:
      return {u, v, v};
  }
}

}  // namespace halfspace
