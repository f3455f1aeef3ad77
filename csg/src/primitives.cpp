#include "primitives.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <numbers>

#include "halfspace/csg/matrix.hpp"
#include "numbers.hpp"

namespace halfspace::csg {
namespace {

using io::Number;

void add_face(io::Mesh& mesh, std::initializer_list<std::uint32_t> corners) {
  for (const std::uint32_t corner : corners)
    mesh.corners.push_back(static_cast<VertexId>(corner));
  mesh.first_corner.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
}

/// A multiple of 10^exponent.
Number rounded(double value, std::int32_t exponent) {
  const double steps = std::round(value / std::pow(10.0, exponent));
  Number number = io::number_of(steps);
  return io::normalised(number.mantissa, number.two + exponent,
                        number.five + exponent);
}

/// The exponent of the last of seven digits.
std::int32_t last_digit_of(double greatest) {
  constexpr std::int32_t kDigits = 7;
  return static_cast<std::int32_t>(std::floor(std::log10(greatest))) + 1 -
         kDigits;
}

/// The points of a circle, with exact quarters.
std::vector<std::array<Number, 2>> circle(const Number& radius,
                                          std::uint32_t segments,
                                          std::int32_t last_digit) {
  std::vector<std::array<Number, 2>> points;
  for (std::uint32_t i = 0; i < segments; ++i) {
    const Number degrees = io::number_of(360.0 * i / segments);
    const auto at = [&](const Number& factor) {
      const bool is_whole = factor.mantissa == 0 || abs(factor.mantissa) == 1;
      return is_whole && factor.two == 0
                 ? product(radius, factor)
                 : rounded(io::to_double(radius) * io::to_double(factor),
                           last_digit);
    };
    points.push_back({at(cosine(degrees)), at(sine(degrees))});
  }
  return points;
}

/// The same in the plane z.
void add_circle(io::Mesh& mesh, const Number& radius, const Number& z,
                std::uint32_t segments, std::int32_t last_digit) {
  for (const auto& [x, y] : circle(radius, segments, last_digit))
    mesh.vertices.push_back({x, y, z});
}

/// The quads, or triangles at a pole, between two rings.
void add_band(io::Mesh& mesh, std::uint32_t low, std::uint32_t high,
              bool low_is_point, bool high_is_point, std::uint32_t segments) {
  for (std::uint32_t i = 0; i < segments; ++i) {
    const std::uint32_t j = (i + 1) % segments;
    if (low_is_point)
      add_face(mesh, {low, high + j, high + i});
    else if (high_is_point)
      add_face(mesh, {low + i, low + j, high});
    else
      add_face(mesh, {low + i, low + j, high + j, high + i});
  }
}

/// The polygon of a ring, facing down or up.
void add_cap(io::Mesh& mesh, std::uint32_t first, std::uint32_t segments,
             bool up) {
  for (std::uint32_t i = 0; i < segments; ++i) {
    mesh.corners.push_back(
        static_cast<VertexId>(first + (up ? i : segments - 1 - i)));
  }
  mesh.first_corner.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
}

}  // namespace

io::Mesh box_mesh(const std::array<Number, 3>& least,
                  const std::array<Number, 3>& most) {
  io::Mesh mesh;
  mesh.decimal = true;
  for (unsigned i = 0; i < 8; ++i) {
    mesh.vertices.push_back({(i & 1u) != 0 ? most[0] : least[0],
                             (i & 2u) != 0 ? most[1] : least[1],
                             (i & 4u) != 0 ? most[2] : least[2]});
  }
  add_face(mesh, {0, 2, 3, 1});
  add_face(mesh, {4, 5, 7, 6});
  add_face(mesh, {0, 1, 5, 4});
  add_face(mesh, {2, 6, 7, 3});
  add_face(mesh, {0, 4, 6, 2});
  add_face(mesh, {1, 3, 7, 5});
  return mesh;
}

io::Mesh sphere_mesh(const Number& radius, std::uint32_t segments) {
  io::Mesh mesh;
  mesh.decimal = true;
  const double r = io::to_double(radius);
  const std::int32_t digit = last_digit_of(r);
  const std::uint32_t parallels = std::max(segments / 2, 2u) - 1;
  mesh.vertices.push_back({Number{}, Number{}, negative(radius)});
  for (std::uint32_t k = 1; k <= parallels; ++k) {
    const double angle = std::numbers::pi * k / (parallels + 1);
    const Number z = 2 * k == parallels + 1
                         ? Number{}
                         : rounded(-r * std::cos(angle), digit);
    const Number ring =
        2 * k == parallels + 1 ? radius : rounded(r * std::sin(angle), digit);
    add_circle(mesh, ring, z, segments, digit);
  }
  const auto top = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.push_back({Number{}, Number{}, radius});
  add_band(mesh, 0, 1, true, false, segments);
  for (std::uint32_t k = 1; k < parallels; ++k)
    add_band(mesh, 1 + (k - 1) * segments, 1 + k * segments, false, false,
             segments);
  add_band(mesh, 1 + (parallels - 1) * segments, top, false, true, segments);
  return mesh;
}

io::Mesh ringed_ball_mesh(const Number& radius, std::uint32_t segments) {
  io::Mesh mesh;
  mesh.decimal = true;
  const double r = io::to_double(radius);
  const std::int32_t digit = last_digit_of(r);
  const std::uint32_t rings = (segments + 1) / 2;
  for (std::uint32_t k = 0; k < rings; ++k) {
    const double angle = std::numbers::pi * (k + 0.5) / rings;
    add_circle(mesh, rounded(r * std::sin(angle), digit),
               rounded(-r * std::cos(angle), digit), segments, digit);
  }
  for (std::uint32_t k = 0; k + 1 < rings; ++k)
    add_band(mesh, k * segments, (k + 1) * segments, false, false, segments);
  add_cap(mesh, 0, segments, false);
  add_cap(mesh, (rings - 1) * segments, segments, true);
  return mesh;
}

std::vector<std::array<Number, 2>> circle_points(const Number& radius,
                                                 std::uint32_t segments) {
  return circle(radius, segments, last_digit_of(io::to_double(radius)));
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
  const auto count = static_cast<std::uint32_t>(points.size());
  add_band(mesh, 0, count, false, false, count);
  add_cap(mesh, 0, count, false);
  add_cap(mesh, count, count, true);
  return mesh;
}

io::Mesh frustum_mesh(const Number& bottom_radius, const Number& top_radius,
                      const Number& bottom, const Number& top,
                      std::uint32_t segments) {
  io::Mesh mesh;
  mesh.decimal = true;
  const bool low_is_point = bottom_radius.mantissa == 0;
  const bool high_is_point = top_radius.mantissa == 0;
  const std::int32_t digit = last_digit_of(
      std::max(io::to_double(bottom_radius), io::to_double(top_radius)));
  const auto add_ring = [&](const Number& radius, const Number& z,
                            bool is_point) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    if (is_point)
      mesh.vertices.push_back({Number{}, Number{}, z});
    else
      add_circle(mesh, radius, z, segments, digit);
    return first;
  };
  const std::uint32_t low = add_ring(bottom_radius, bottom, low_is_point);
  const std::uint32_t high = add_ring(top_radius, top, high_is_point);
  add_band(mesh, low, high, low_is_point, high_is_point, segments);
  if (!low_is_point) add_cap(mesh, low, segments, false);
  if (!high_is_point) add_cap(mesh, high, segments, true);
  return mesh;
}

}  // namespace halfspace::csg
