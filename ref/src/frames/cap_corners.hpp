#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "halfspace/clip.hpp"
#include "halfspace/ref/predicate.hpp"

/// Where the caps of two clip planes meet (S9.8).
namespace halfspace::ref {

/// The line in which two planes meet, from end to end of the box round the
/// corners of polygons, one grid step larger on all sides; nothing where it
/// does not pass through that.
std::optional<std::pair<Point, Point>> corner_line(
    const std::vector<Fragment>& polygons, const ClipPlane& first,
    const ClipPlane& second);

/// Whether the caps of planes `first` and `second` of `clips` meet at a point
/// of their line. Requires: no polygon's plane that crosses the line passes
/// through it there.
bool do_caps_meet(const std::vector<Fragment>& polygons,
                  const std::vector<ClipPlane>& clips, std::size_t first,
                  std::size_t second, const Point& p);

}  // namespace halfspace::ref
