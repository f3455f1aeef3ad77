#pragma once

#include <cstdint>
#include <random>
#include <utility>

#include "scenes.hpp"

namespace halfspace::fast {

/// `count` triangles that cross each other, within 100 of the origin.
inline Scene crossing_triangles(int count) {
  std::mt19937_64 random(7);
  const auto coordinate = [&random] {
    return static_cast<std::int64_t>(random() % 201) - 100;
  };
  SceneData data;
  while (data.colors.size() < static_cast<std::size_t>(count)) {
    const GridPoint p = {coordinate(), coordinate(), coordinate()};
    // Corners on no line: they differ in x and in y in turn.
    add_polygon(
        data,
        {p, {p.x + 60, p.y, coordinate()}, {p.x, p.y + 60, coordinate()}});
  }
  return made(std::move(data));
}

}  // namespace halfspace::fast
