#pragma once

#include <array>
#include <vector>

#include "halfspace/io/figure.hpp"

/// Shaded regions in parts that formats have words for.
namespace halfspace::io {

using FigureLoops = std::vector<std::vector<FigurePoint>>;

/// A part of a shaded region: of one colour, or with a linear gradient.
struct ShadePart {
  FigureLoops loops;
  Rgb fill;  ///< of its middle
  /// The points of the colours `ends`, between which they change along the
  /// line that joins them; across it they stay.
  std::array<FigurePoint, 2> line{};
  std::array<Rgb, 2> ends;
  bool has_gradient = false;
};

/// Cuts a shaded region until each part's colour, or if `gradients` its linear
/// gradient, is off by at most `levels` in each channel, at all of its points.
///
/// Quotients of affine functions have their extremes over a part at corners of
/// it, which bounds what one colour is off. With a linear colour L the distance
/// is (N - L D) / D for the forms N and D: a quadratic numerator, whose part
/// between corners is bounded by its Hessian, |grad L| |grad D| r^2 for parts
/// in a disc of radius r. Requires: region.shade, levels >= 1.
std::vector<ShadePart> shade_parts(const FigureRegion& region, double levels,
                                   bool gradients);

/// A triangle of a mesh that viewers interpolate.
using ShadeTriangle = std::array<FigurePoint, 3>;

/// Divides a shaded region into triangles in each of which the colour that is
/// interpolated between its corners is off by at most `levels`, as above.
std::vector<ShadeTriangle> shade_triangles(const FigureRegion& region,
                                           double levels);

/// The colour in 8 bits, each channel rounded and within 0 and 255.
Rgb rounded_color(const std::array<double, 3>& channels);

}  // namespace halfspace::io
