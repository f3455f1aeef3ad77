#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

#include "halfspace/cap_parts.hpp"
#include "halfspace/scene_file.hpp"
#include "halfspace/splitmix.hpp"

/// Views of boxes that are cut, with caps, and caps told apart by parts.
namespace halfspace {

/// Tells the caps of connected parts apart: of two parts in three, and where
/// several are, with hatching.
inline void tell_parts_apart(SceneFile& view) {
  CapParts parts = *told_apart(connected_parts(view.scene), {});
  for (std::size_t k = 0; k < parts.styles.size(); ++k) {
    const auto shade = static_cast<std::uint8_t>(3 * k + 1);
    parts.styles[k].color = {shade, 0, 0};
    if (k % 3 != 1) parts.styles[k].hatch = Rgb{0, shade, 0};
  }
  parts.styles.back().hatch = Rgb{0, 0, 255};
  view.options.parts = std::make_shared<const CapParts>(std::move(parts));
}

/// Some boxes that overlap more often than not, cut by a plane near their
/// middle, seen from anywhere in so many pixels.
inline SceneFile cut_boxes(std::uint64_t number, int boxes, std::int32_t width,
                           std::int32_t height) {
  std::uint64_t drawn = mix(number);
  const auto within = [&drawn](std::int64_t low, std::int64_t high) {
    drawn = mix(drawn + 1);
    return low + static_cast<std::int64_t>(
                     drawn % static_cast<std::uint64_t>(high - low + 1));
  };
  SceneData data;
  for (int box = 0; box < boxes; ++box) {
    const GridPoint low = {within(-6, 1), within(-6, 1), within(-6, 1)};
    const GridPoint size = {within(3, 8), within(3, 8), within(3, 8)};
    const auto first = static_cast<VertexId>(data.vertices.size());
    for (int k = 0; k < 8; ++k) {
      data.vertices.push_back({low.x + (k & 1) * size.x,
                               low.y + (k >> 1 & 1) * size.y,
                               low.z + (k >> 2) * size.z});
    }
    for (const auto& face : {std::array{0, 2, 3, 1},
                             {4, 5, 7, 6},
                             {0, 1, 5, 4},
                             {2, 6, 7, 3},
                             {0, 4, 6, 2},
                             {1, 3, 7, 5}}) {
      for (const int corner : face) data.corners.push_back(first + corner);
      data.first_corner.push_back(
          static_cast<std::uint32_t>(data.corners.size()));
      data.colors.push_back({static_cast<std::uint8_t>(50 * box), 100, 200});
    }
  }
  SceneFile view;
  view.scene = *make_scene(std::move(data));
  // Columns and rows across the direction to the eye, some ten steps or more in
  // all.
  const std::int64_t a = within(-3, 3), b = within(-3, 3), c = within(1, 4);
  const std::int64_t step = 5120 / width / 8;
  CameraData camera;
  camera.perspective = number % 2 == 0;
  const std::int64_t away = camera.perspective ? 6 * 256 : 256;
  camera.eye = {away * a, away * b, away * c};
  camera.sx = {step * c, 0, -step * a};
  camera.sy = {0, step * c, -step * b};
  camera.s0 = {-width * step * c / 2, -height * step * c / 2,
               (width * step * a + height * step * b) / 2};
  camera.width_px = width;
  camera.height_px = height;
  view.camera = *make_camera(camera, view.scene.grid_bits());
  // What is left is mostly below, so that its caps are seen.
  const ClipPlane plane = {within(-2, 2), within(-2, 2),
                           number % 4 == 3 ? 1 : -within(1, 3), within(-3, 3)};
  view.options.clips = *make_clips({plane}, view.scene.grid_bits());
  view.options.caps = CapStyle{{9, 8, 7}, Rgb{1, 2, 3}};
  return view;
}

}  // namespace halfspace
