#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "halfspace/camera.hpp"
#include "halfspace/scene.hpp"

namespace halfspace::bench {

/// From where a scene is looked at: along an axis, or from a corner of its
/// box, or from somewhere that nothing is aligned with.
enum class View {
  kFront,
  kBack,
  kLeft,
  kRight,
  kTop,
  kBottom,
  kCorner,
  kAskew
};

inline constexpr std::array kViews = {View::kFront,  View::kBack, View::kLeft,
                                      View::kRight,  View::kTop,  View::kBottom,
                                      View::kCorner, View::kAskew};

/// The names of the views, in their order.
inline constexpr std::array<std::string_view, 8> kViewNames = {
    "front", "back", "left", "right", "top", "bottom", "corner", "askew"};

/// The view of that name, if there is one.
std::optional<View> view_named(std::string_view name);

/// A perspective camera outside the universe (scenes.hpp), looking at its
/// centre from twice its side away; the image is 1.33 sides wide there, which
/// shows the whole of it. Front looks along z, so that parallel triangles are
/// parallel to the screen.
Camera universe_camera(View view, std::int32_t size_px);
/// The same for a scene of in_floats().
Camera universe_camera(const Scene& scene, View view, std::int32_t size_px);

/// A perspective camera that just shows the sphere around the scene, centred
/// in the middle of its box, from three of the sphere's radii away.
/// Requires: the scene has a vertex.
Camera scene_camera(const Scene& scene, View view, std::int32_t size_px);

}  // namespace halfspace::bench
