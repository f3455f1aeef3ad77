#pragma once

#include <gtest/gtest.h>

#include <cstddef>

#include "halfspace/ref/build.hpp"
#include "halfspace/ref/oracle/painter.hpp"
#include "halfspace/ref/oracle/raycast.hpp"
#include "halfspace/ref/oracle/zbuffer.hpp"
#include "halfspace/ref/render.hpp"
#include "scenes.hpp"

namespace halfspace::ref {

constexpr PolygonId kNone = kBackground;

/// The pixels of the image by every algorithm, which must all agree.
inline Ids image_of(const Scene& scene, const CameraData& data,
                    const ImageOptions& options = {}) {
  const Camera camera = camera_of(data, scene.grid_bits());
  const BspTree tree = build(scene, {});
  const Rendering image = render(scene, tree, camera, options);
  const Rendering others[] = {paint(scene, tree, camera, options),
                              zbuffer(scene, camera, options),
                              raycast(scene, camera, options)};
  const char* names[] = {"painter", "z-buffer", "ray casting"};
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(image.items.pixels, others[k].items.pixels) << names[k];
    EXPECT_EQ(image.colors, others[k].colors) << names[k];
  }
  return image.items.pixels;
}

}  // namespace halfspace::ref
