#include "builder.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace halfspace::models {
namespace {

std::uint8_t channel(double value) {
  return static_cast<std::uint8_t>(
      std::lround(255 * std::clamp(value, 0.0, 1.0)));
}

/// `color` lit by a directional light: between half and full intensity.
Rgb lit(Rgb color, std::span<const GridPoint> corners) {
  constexpr std::array<double, 3> kLight = {0.37, -0.56, 0.74};
  const GridPoint u = corners[1] - corners[0];
  const GridPoint v = corners[2] - corners[0];
  const std::array<double, 3> normal = {
      static_cast<double>(u.y) * static_cast<double>(v.z) -
          static_cast<double>(u.z) * static_cast<double>(v.y),
      static_cast<double>(u.z) * static_cast<double>(v.x) -
          static_cast<double>(u.x) * static_cast<double>(v.z),
      static_cast<double>(u.x) * static_cast<double>(v.y) -
          static_cast<double>(u.y) * static_cast<double>(v.x)};
  const double length = std::hypot(normal[0], normal[1], normal[2]);
  double cosine = 0;
  for (std::size_t i = 0; i < 3; ++i) cosine += normal[i] * kLight[i] / length;
  const auto scaled = [cosine](std::uint8_t value) {
    return channel((0.75 + 0.25 * cosine) * value / 255);
  };
  return {scaled(color.r), scaled(color.g), scaled(color.b)};
}

}  // namespace

void Builder::add(std::span<const GridPoint> corners, Rgb color) {
  for (const GridPoint& corner : corners) {
    const auto next = static_cast<VertexId>(data_.vertices.size());
    const auto [place, is_new] = vertices_.try_emplace(corner, next);
    if (is_new) data_.vertices.push_back(corner);
    data_.corners.push_back(place->second);
  }
  data_.first_corner.push_back(
      static_cast<std::uint32_t>(data_.corners.size()));
  data_.colors.push_back(lit(color, corners));
}

void Builder::add_face(const GridPoint& origin, const GridPoint& u,
                       const GridPoint& v, std::int64_t parts_u,
                       std::int64_t parts_v, Rgb color) {
  const GridPoint du = {u.x / parts_u, u.y / parts_u, u.z / parts_u};
  const GridPoint dv = {v.x / parts_v, v.y / parts_v, v.z / parts_v};
  for (std::int64_t i = 0; i < parts_u; ++i) {
    for (std::int64_t j = 0; j < parts_v; ++j) {
      const GridPoint p = origin + i * du + j * dv;
      add({p, p + du, p + du + dv, p + dv}, color);
    }
  }
}

void Builder::add_box(const GridPoint& origin, const GridPoint& u,
                      const GridPoint& v, const GridPoint& w, Rgb color,
                      std::int64_t parts_u, std::int64_t parts_v,
                      std::int64_t parts_w) {
  add_face(origin, v, u, parts_v, parts_u, color);
  add_face(origin + w, u, v, parts_u, parts_v, color);
  add_face(origin, u, w, parts_u, parts_w, color);
  add_face(origin + v, w, u, parts_w, parts_u, color);
  add_face(origin, w, v, parts_w, parts_v, color);
  add_face(origin + u, v, w, parts_v, parts_w, color);
}

void Builder::color_corners_by_height() {
  std::int64_t low = data_.vertices.front().z;
  std::int64_t high = low;
  for (const GridPoint& vertex : data_.vertices) {
    low = std::min(low, vertex.z);
    high = std::max(high, vertex.z);
  }
  const double range =
      static_cast<double>(std::max<std::int64_t>(high - low, 1));
  data_.corner_colors.clear();
  for (const VertexId corner : data_.corners) {
    const GridPoint& vertex = data_.vertices[static_cast<std::size_t>(corner)];
    data_.corner_colors.push_back(
        heat(static_cast<double>(vertex.z - low) / range));
  }
}

Result<Scene> Builder::scene(int exponent) && {
  data_.unit = {.base = 2, .exponent = exponent};
  data_.grid_bits = grid_bits_for(data_.vertices);
  return make_scene(std::move(data_));
}

Rgb palette(std::size_t index) {
  constexpr std::array<Rgb, 8> kColors = {{{204, 80, 62},
                                           {56, 125, 186},
                                           {237, 173, 8},
                                           {15, 133, 84},
                                           {111, 64, 112},
                                           {225, 124, 5},
                                           {29, 105, 150},
                                           {115, 175, 72}}};
  return kColors[index % kColors.size()];
}

Rgb heat(double share) {
  return {channel(1.5 * share), channel(1 - std::abs(2 * share - 1)),
          channel(1.5 * (1 - share))};
}

}  // namespace halfspace::models
