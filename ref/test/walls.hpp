#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "halfspace/ref/build.hpp"
#include "scenes.hpp"

namespace halfspace::ref {

/// A wall from y = 0 to 9 in the plane x = `at`, from z = `from` to `to`; its
/// positive side is where x is greater.
inline std::vector<GridPoint> wall_x(std::int64_t at, std::int64_t from,
                                     std::int64_t to) {
  return {{at, 0, from}, {at, 9, from}, {at, 9, to}, {at, 0, to}};
}

/// A wall from y = 0 to 9 in the plane z = `at`, from x = `from` to `to`; its
/// positive side is where z is greater.
inline std::vector<GridPoint> wall_z(std::int64_t at, std::int64_t from,
                                     std::int64_t to) {
  return {{from, 0, at}, {to, 0, at}, {to, 9, at}, {from, 9, at}};
}

inline std::vector<GridPoint> turned_over(std::vector<GridPoint> polygon) {
  return {polygon.rbegin(), polygon.rend()};
}

/// `count` nodes below each other, always on the positive side: walls x = 0,
/// 1, 2, ...
inline BspTree chain(std::int32_t count) {
  BspTree tree;
  for (std::int32_t i = 0; i < count; ++i) {
    Fragment fragment = whole(scene_of({wall_x(i, 0, 1)}), 0);
    fragment.source = i;
    const Plane plane = plane_of(fragment.vertices);
    tree.nodes.push_back({i, plane, {}, i + 1 < count ? i + 1 : kNoNode});
    tree.nodes.back().coincident.push_back(std::move(fragment));
  }
  return tree;
}

}  // namespace halfspace::ref
