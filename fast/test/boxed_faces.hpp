#pragma once

#include <cstdint>
#include <random>
#include <set>
#include <vector>

#include "box/bvh.hpp"
#include "halfspace/fast/solid.hpp"

namespace halfspace::fast {

/// A solid of nothing but faces with boxes, of up to this size.
inline Solid boxed_faces(std::mt19937_64& random, std::size_t count, int size) {
  Solid solid;
  const auto number = [&](int most) {
    return static_cast<float>(random() % static_cast<std::uint64_t>(most));
  };
  for (std::size_t i = 0; i < count; ++i) {
    Face face;
    for (std::size_t k = 0; k < 3; ++k) {
      face.box.low[k] = number(1000) - 300;
      face.box.high[k] = face.box.low[k] + number(size);
    }
    solid.faces.push_back(face);
  }
  return solid;
}

inline std::vector<std::int32_t> all_of(const Solid& solid) {
  std::vector<std::int32_t> faces;
  for (std::size_t f = 0; f < solid.faces.size(); ++f)
    faces.push_back(static_cast<std::int32_t>(f));
  return faces;
}

/// The faces whose boxes overlap `box`, without those that are gone.
inline std::vector<std::int32_t> overlapping(
    const Solid& solid, const Box& box,
    const std::set<std::int32_t>& gone = {}) {
  std::vector<std::int32_t> found;
  for (const std::int32_t f : all_of(solid)) {
    if (gone.count(f) == 0 &&
        overlap(solid.faces[static_cast<std::size_t>(f)].box, box))
      found.push_back(f);
  }
  return found;
}

/// Boxes to look for: of faces, and that of all of space.
inline std::vector<Box> boxes_of(const Solid& solid) {
  std::vector<Box> boxes{{kEmptyBox.high, kEmptyBox.low}};
  for (const Face& face : solid.faces) boxes.push_back(face.box);
  return boxes;
}

}  // namespace halfspace::fast
