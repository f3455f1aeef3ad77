#pragma once

#include <cstddef>
#include <cstdint>

#include "halfspace/polygon.hpp"

namespace halfspace::fast {

struct GridPointHash {
  std::size_t operator()(const GridPoint& p) const {
    std::uint64_t hash = 0;
    for (const std::int64_t c : {p.x, p.y, p.z}) {
      hash = (hash ^ static_cast<std::uint64_t>(c)) * 0x9e3779b97f4a7c15u;
      hash ^= hash >> 29;
    }
    return hash;
  }
};

}  // namespace halfspace::fast
