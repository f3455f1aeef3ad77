#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "halfspace/io/mesh.hpp"

namespace halfspace::csg {

/// Solids as meshes, faces outwards: those of scripts and of the library.
/// Circles are regular polygons inscribed in them, with the first corner along
/// x; coordinates that are no decimals are rounded to seven digits of the
/// greatest radius, to eleven where circles have more than 1,000 segments.

/// The box between two corners. Exact: yes.
/// Requires: the first has the lesser coordinates.
io::Mesh box_mesh(const std::array<io::Number, 3>& least,
                  const std::array<io::Number, 3>& most);

/// The ball about the origin, by meridians and half as many parallels.
/// Requires: radius > 0; 3 <= segments.
io::Mesh sphere_mesh(const io::Number& radius, std::uint32_t segments);

/// The ball of OpenSCAD: parallels half a step from the poles, and flat there.
/// Requires: radius > 0; 3 <= segments.
io::Mesh ringed_ball_mesh(const io::Number& radius, std::uint32_t segments);

/// The corners of a circle, from its right.
std::vector<std::array<io::Number, 2>> circle_points(const io::Number& radius,
                                                     std::uint32_t segments);

/// The polygon, of either orientation, between z = bottom and z = top.
/// Requires: 3 points or more; bottom < top.
io::Mesh prism_mesh(std::vector<std::array<io::Number, 2>> points,
                    const io::Number& bottom, const io::Number& top);

/// The frustum along z between z = bottom and z = top; a cone where one radius
/// is 0, a cylinder where they are equal. Sides that are not planar are left to
/// the import to cut.
/// Requires: radii >= 0, not both 0; bottom < top; 3 <= segments.
io::Mesh frustum_mesh(const io::Number& bottom_radius,
                      const io::Number& top_radius, const io::Number& bottom,
                      const io::Number& top, std::uint32_t segments);

/// The ring about the z axis whose tube has its middle on a circle.
/// Requires: 0 < tube_radius < radius; both numbers of segments 3 or more.
io::Mesh torus_mesh(const io::Number& radius, const io::Number& tube_radius,
                    std::uint32_t segments, std::uint32_t tube_segments);

/// The outline of points (r, z), counterclockwise with r to the right and z
/// upwards, turned about the z axis.
/// Requires: 3 points or more; each r >= 0, not all 0; 3 <= segments.
io::Mesh revolved_mesh(const std::vector<std::array<io::Number, 2>>& outline,
                       std::uint32_t segments);

}  // namespace halfspace::csg
