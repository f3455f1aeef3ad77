#pragma once

#include <array>
#include <span>
#include <vector>

namespace halfspace::python {

/// A point of the image, and how near it is: greater is nearer, and it is
/// affine over the image of a plane (the inverse of the depth in perspective).
using ImagePoint = std::array<double, 3>;
using ImageTriangle = std::array<ImagePoint, 3>;
using ImageSegment = std::array<ImagePoint, 2>;

/// A part of a segment: its number, and where it begins and ends, 0 to 1.
struct VisiblePart {
  double segment = 0;
  double begin = 0;
  double end = 0;
};

/// The parts of segments that no triangle hides, for lines and markers over a
/// visible map. What lies in a triangle, or behind it by up to `tolerance`, is
/// seen. A segment whose ends are one point is a point.
///
/// Exact:  no: in doubles, for lines are drawn, not filled.
/// Cost:   a segment meets the triangles of its tiles of the image.
std::vector<VisiblePart> visible_parts(std::span<const ImageTriangle> triangles,
                                       std::span<const ImageSegment> segments,
                                       double tolerance);

}  // namespace halfspace::python
