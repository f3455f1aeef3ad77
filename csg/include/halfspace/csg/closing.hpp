#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "halfspace/boolean.hpp"
#include "halfspace/scene.hpp"

namespace halfspace::csg {

/// A scene, how many corners were added to it, and whether edges of it are bad
/// all the same.
struct ClosedScene {
  Scene scene;
  std::size_t added = 0;
  bool is_open = false;
};

/// The scene with straight corners added where vertices lie within polygons'
/// edges, if that closes it: if on every line the edges cancel (S6.1). A
/// polygon without area that import dropped leaves such edges.
///
/// Shape: the scene as it is if it is closed, or is not closed even so.
/// Exact: yes.
/// Cost:  of bad_edges(); k log k for k bad edges, and n log n if there are
///        any.
ClosedScene closed_on_lines(Scene scene);

/// The same whether that closes the scene or not.
ClosedScene split_on_lines(Scene scene);

/// The same, the scene's bad edges being known, in any order. Nothing where no
/// corner is added.
std::optional<ClosedScene> split_on_lines(const Scene& scene,
                                          std::span<const BadEdge> bad);

/// Whether a look at some of the bad edges of a surface tells that no corners
/// on lines close it. Not if this is false.
/// Cost: linear.
bool stays_open_on_lines(std::span<const BadEdge> bad);

}  // namespace halfspace::csg
