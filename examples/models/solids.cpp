#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "builder.hpp"
#include "shapes.hpp"

namespace halfspace::models {
namespace {

/// `value` rounded to the grid: halves go away from zero.
std::int64_t rounded(double value) { return std::llround(value); }

/// One quadrilateral of a curved surface, as two triangles.
void add_two_triangles(Builder& builder, const GridPoint& a, const GridPoint& b,
                       const GridPoint& c, const GridPoint& d, Rgb color) {
  builder.add({a, b, c}, color);
  builder.add({a, c, d}, color);
}

GridPoint on_sphere(int meridian, int meridians, int circle, int circles) {
  constexpr double kRadius = 1 << 20;
  const double longitude = 2 * std::numbers::pi * meridian / meridians;
  const double latitude = std::numbers::pi * circle / circles;
  return {rounded(kRadius * std::sin(latitude) * std::cos(longitude)),
          rounded(kRadius * std::sin(latitude) * std::sin(longitude)),
          rounded(kRadius * std::cos(latitude))};
}

/// A figure of eight that turns by half a turn on its way round a circle.
GridPoint on_klein_bottle(double u, double v) {
  constexpr double kStep = 1 << 18;
  const double across =
      std::cos(u / 2) * std::sin(v) - std::sin(u / 2) * std::sin(2 * v);
  const double up =
      std::sin(u / 2) * std::sin(v) + std::cos(u / 2) * std::sin(2 * v);
  return {rounded(kStep * (2.5 + across) * std::cos(u)),
          rounded(kStep * (2.5 + across) * std::sin(u)), rounded(kStep * up)};
}

}  // namespace

Result<Scene> cube(const ModelOptions&) {
  Builder builder;
  const auto face = [&](const GridPoint& origin, const GridPoint& u,
                        const GridPoint& v, std::size_t color) {
    builder.add({origin, origin + u, origin + u + v, origin + v},
                palette(color));
  };
  const GridPoint low = {-100, -100, -100};
  const GridPoint x = {200, 0, 0};
  const GridPoint y = {0, 200, 0};
  const GridPoint z = {0, 0, 200};
  face(low, y, x, 0);
  face(low + z, x, y, 1);
  face(low, x, z, 2);
  face(low + y, z, x, 3);
  face(low, z, y, 4);
  face(low + x, y, z, 5);
  return std::move(builder).scene();
}

Result<Scene> interlocking_cubes(const ModelOptions& options) {
  // Edges of length 150, each axis cut into 2, 3 and 6: 2(6 + 18 + 12) = 72.
  constexpr std::int64_t k = 30;
  struct Axes {
    GridPoint u, v, w;
  };
  constexpr std::array<Axes, 3> kTurns = {
      {{{5 * k, 0, 0}, {0, 5 * k, 0}, {0, 0, 5 * k}},
       {{4 * k, 3 * k, 0}, {-3 * k, 4 * k, 0}, {0, 0, 5 * k}},
       {{5 * k, 0, 0}, {0, 4 * k, 3 * k}, {0, -3 * k, 4 * k}}}};
  Builder builder;
  const int count = options.count == 0 ? 3 : options.count;
  for (int i = 0; i < count; ++i) {
    const auto& [u, v, w] = kTurns[static_cast<std::size_t>(i % 3)];
    const GridPoint sum = u + v + w;
    const GridPoint centre = {70 * i, 43 * i, 31 * i};
    const GridPoint origin =
        centre - GridPoint{sum.x / 2, sum.y / 2, sum.z / 2};
    builder.add_box(origin, u, v, w, palette(static_cast<std::size_t>(i)), 2, 3,
                    6);
  }
  return std::move(builder).scene();
}

Result<Scene> pinwheel(const ModelOptions&) {
  Builder builder;
  GridPoint origin = {-300, -200, 0};
  GridPoint along = {500, 0, 60};
  GridPoint across = {0, 80, 0};
  for (std::size_t i = 0; i < 4; ++i) {
    builder.add_box(origin, along, across, {0, 0, 24}, palette(i));
    // A quarter turn about the z axis.
    for (GridPoint* p : {&origin, &along, &across})
      *p = GridPoint{-p->y, p->x, p->z};
  }
  return std::move(builder).scene();
}

Result<Scene> stairs(const ModelOptions& options) {
  const int steps = options.count == 0 ? 5 : options.count;
  const GridPoint x = {100, 0, 0};
  const GridPoint y = {0, 400, 0};
  const GridPoint z = {0, 0, 60};
  Builder builder;
  // Step 1: the two sides, in cells, so that every edge has its opposite.
  for (int i = 0; i < steps; ++i) {
    for (int j = 0; j <= i; ++j) {
      const GridPoint p = i * x + j * z;
      builder.add({p, p + x, p + x + z, p + z}, palette(0));
      const GridPoint q = p + y;
      builder.add({q, q + z, q + z + x, q + x}, palette(1));
    }
  }
  // Step 2: tread, riser, floor and back of each step.
  for (int i = 0; i < steps; ++i) {
    const GridPoint low = i * x;
    const GridPoint foot = i * x + i * z;
    const GridPoint top = foot + z;
    const GridPoint back = steps * x + i * z;
    builder.add({top, top + x, top + x + y, top + y}, palette(2));
    builder.add({foot, top, top + y, foot + y}, palette(3));
    builder.add({low, low + y, low + y + x, low + x}, palette(4));
    builder.add({back, back + y, back + y + z, back + z}, palette(5));
  }
  return std::move(builder).scene();
}

Result<Scene> sphere(const ModelOptions& options) {
  const int meridians = options.count == 0 ? 24 : options.count;
  if (meridians < 3) {
    return Error{ErrorCode::kOutOfRange, "a sphere needs 3 meridians or more"};
  }
  const int circles = std::max(2, meridians / 2);
  Builder builder;
  for (int i = 0; i < circles; ++i) {
    for (int j = 0; j < meridians; ++j) {
      const int next = (j + 1) % meridians;
      const GridPoint a = on_sphere(j, meridians, i, circles);
      const GridPoint b = on_sphere(j, meridians, i + 1, circles);
      const GridPoint c = on_sphere(next, meridians, i + 1, circles);
      const GridPoint d = on_sphere(next, meridians, i, circles);
      if (b != c) builder.add({a, b, c}, palette(0));
      if (a != d) builder.add({a, c, d}, palette(0));
    }
  }
  builder.color_corners_by_height();
  return std::move(builder).scene(-20);
}

Result<Scene> klein_bottle(const ModelOptions&) {
  // 15 by 15 quadrilaterals; after one round the figure of eight meets itself
  // upside down.
  constexpr int kParts = 15;
  const auto point = [](int i, int j) {
    if (i == kParts)
      return on_klein_bottle(
          0, 2 * std::numbers::pi * ((kParts - j) % kParts) / kParts);
    return on_klein_bottle(2 * std::numbers::pi * i / kParts,
                           2 * std::numbers::pi * (j % kParts) / kParts);
  };
  Builder builder;
  for (int i = 0; i < kParts; ++i) {
    for (int j = 0; j < kParts; ++j) {
      add_two_triangles(builder, point(i, j), point(i + 1, j),
                        point(i + 1, j + 1), point(i, j + 1),
                        heat(static_cast<double>(j) / (kParts - 1)));
    }
  }
  builder.color_corners_by_height();
  return std::move(builder).scene(-18);
}

}  // namespace halfspace::models
