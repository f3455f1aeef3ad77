#include "halfspace/csg/primitives.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "halfspace/csg/matrix.hpp"
#include "halfspace/csg/turned.hpp"
#include "numbers.hpp"

namespace halfspace::csg {
namespace {

using io::Number;

/// A multiple of 10^exponent.
Number rounded(double value, std::int32_t exponent) {
  const double steps = std::round(value / std::pow(10.0, exponent));
  Number number = io::number_of(steps);
  return io::normalised(number.mantissa, number.two + exponent,
                        number.five + exponent);
}

/// The exponent of the last digit of what is rounded.
std::int32_t last_digit_of(double greatest, std::uint32_t segments) {
  // Neighbours on the least parallel of a ball of n segments are about 39 / n^2
  // of its radius apart. The last of seven digits is at most 1e-6 of it, so
  // that is 39 of it or more up to 1,000 segments; with eleven, 90 at 65,536.
  const std::int32_t digits = segments <= 1000 ? 7 : 11;
  return static_cast<std::int32_t>(std::floor(std::log10(greatest))) + 1 -
         digits;
}

using NumberPair = std::array<Number, 2>;

/// Cosine and sine of the steps of a circle.
std::vector<NumberPair> unit_circle(std::uint32_t segments) {
  std::vector<NumberPair> points;
  for (std::uint32_t i = 0; i < segments; ++i) {
    const Number degrees = io::number_of(360.0 * i / segments);
    points.push_back({cosine(degrees), sine(degrees)});
  }
  return points;
}

/// The points of a circle, with exact quarters.
std::vector<NumberPair> circle(const Number& radius,
                               const std::vector<NumberPair>& unit,
                               std::int32_t last_digit) {
  const double r = io::to_double(radius);
  const auto at = [&](const Number& factor) {
    const bool is_whole = factor.mantissa == 0 || abs(factor.mantissa) == 1;
    return is_whole && factor.two == 0
               ? product(radius, factor)
               : rounded(r * io::to_double(factor), last_digit);
  };
  std::vector<NumberPair> points;
  for (const auto& [c, s] : unit) points.push_back({at(c), at(s)});
  return points;
}

/// An outline of points (r, z) turned about the z axis.
io::Mesh turned_mesh(const std::vector<NumberPair>& outline,
                     std::uint32_t segments, std::int32_t last_digit) {
  const std::vector<NumberPair> unit = unit_circle(segments);
  std::vector<TurnedPoint> points;
  std::vector<std::vector<NumberPair>> circles;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const auto& next = outline[(i + 1) % outline.size()];
    points.push_back({outline[i][0].mantissa == 0, outline[i][1] == next[1]});
    circles.push_back(points.back().is_on_axis
                          ? std::vector{NumberPair{}}
                          : circle(outline[i][0], unit, last_digit));
  }
  TurnedFaces turned = turned_faces(points, segments);
  io::Mesh mesh;
  mesh.decimal = true;
  for (const auto& [point, step] : turned.vertices) {
    const auto& [x, y] = circles[point][step];
    mesh.vertices.push_back({x, y, outline[point][1]});
  }
  mesh.first_corner = std::move(turned.faces.first_corner);
  mesh.corners = std::move(turned.faces.corners);
  return mesh;
}

}  // namespace

io::Mesh box_mesh(const std::array<Number, 3>& least,
                  const std::array<Number, 3>& most) {
  return prism_mesh({{least[0], least[1]},
                     {most[0], least[1]},
                     {most[0], most[1]},
                     {least[0], most[1]}},
                    least[2], most[2]);
}

io::Mesh sphere_mesh(const Number& radius, std::uint32_t segments) {
  const double r = io::to_double(radius);
  const std::int32_t digit = last_digit_of(r, segments);
  const std::uint32_t parallels = std::max(segments / 2, 2u) - 1;
  std::vector<std::array<Number, 2>> outline = {{Number{}, negative(radius)}};
  for (std::uint32_t k = 1; k <= parallels; ++k) {
    if (2 * k == parallels + 1) {
      outline.push_back({radius, Number{}});
      continue;
    }
    const double angle = std::numbers::pi * k / (parallels + 1);
    outline.push_back({rounded(r * std::sin(angle), digit),
                       rounded(-r * std::cos(angle), digit)});
  }
  outline.push_back({Number{}, radius});
  return turned_mesh(outline, segments, digit);
}

io::Mesh ringed_ball_mesh(const Number& radius, std::uint32_t segments) {
  const double r = io::to_double(radius);
  const std::int32_t digit = last_digit_of(r, segments);
  const std::uint32_t rings = (segments + 1) / 2;
  std::vector<std::array<Number, 2>> outline;
  for (std::uint32_t k = 0; k < rings; ++k) {
    const double angle = std::numbers::pi * (k + 0.5) / rings;
    outline.push_back({rounded(r * std::sin(angle), digit),
                       rounded(-r * std::cos(angle), digit)});
  }
  const Number low = outline.front()[1], high = outline.back()[1];
  outline.insert(outline.begin(), {Number{}, low});
  outline.push_back({Number{}, high});
  return turned_mesh(outline, segments, digit);
}

std::vector<std::array<Number, 2>> circle_points(const Number& radius,
                                                 std::uint32_t segments) {
  return circle(radius, unit_circle(segments),
                last_digit_of(io::to_double(radius), segments));
}

io::Mesh prism_mesh(std::vector<std::array<Number, 2>> points,
                    const Number& bottom, const Number& top) {
  Number doubled_area;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto& p = points[i];
    const auto& q = points[(i + 1) % points.size()];
    doubled_area = sum(doubled_area,
                       sum(product(p[0], q[1]), negative(product(p[1], q[0]))));
  }
  if (doubled_area.mantissa < 0) std::reverse(points.begin(), points.end());
  io::Mesh mesh;
  mesh.decimal = true;
  for (const Number* z : {&bottom, &top}) {
    for (const auto& [x, y] : points) mesh.vertices.push_back({x, y, *z});
  }
  Faces faces = prism_faces(static_cast<std::uint32_t>(points.size()));
  mesh.first_corner = std::move(faces.first_corner);
  mesh.corners = std::move(faces.corners);
  return mesh;
}

io::Mesh frustum_mesh(const Number& bottom_radius, const Number& top_radius,
                      const Number& bottom, const Number& top,
                      std::uint32_t segments) {
  std::vector<std::array<Number, 2>> outline = {{Number{}, bottom}};
  if (bottom_radius.mantissa != 0) outline.push_back({bottom_radius, bottom});
  if (top_radius.mantissa != 0) outline.push_back({top_radius, top});
  outline.push_back({Number{}, top});
  return turned_mesh(outline, segments,
                     last_digit_of(std::max(io::to_double(bottom_radius),
                                            io::to_double(top_radius)),
                                   segments));
}

io::Mesh torus_mesh(const Number& radius, const Number& tube_radius,
                    std::uint32_t segments, std::uint32_t tube_segments) {
  const std::int32_t digit =
      last_digit_of(io::to_double(radius) + io::to_double(tube_radius),
                    std::max(segments, tube_segments));
  std::vector<NumberPair> outline =
      circle(tube_radius, unit_circle(tube_segments), digit);
  for (NumberPair& point : outline) point[0] = sum(radius, point[0]);
  return turned_mesh(outline, segments, digit);
}

io::Mesh revolved_mesh(const std::vector<NumberPair>& outline,
                       std::uint32_t segments) {
  double greatest = 0;
  for (const NumberPair& point : outline)
    greatest = std::max(greatest, io::to_double(point[0]));
  return turned_mesh(outline, segments, last_digit_of(greatest, segments));
}

}  // namespace halfspace::csg
