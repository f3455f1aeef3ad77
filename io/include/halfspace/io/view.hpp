#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>

#include "halfspace/camera.hpp"
#include "halfspace/result.hpp"
#include "halfspace/scene.hpp"

namespace halfspace::io {

/// A camera in the terms in which one is usually described. Units: model units.
struct ViewOptions {
  glm::dvec3 eye{1, -2, 1};
  glm::dvec3 target{0, 0, 0};  ///< seen in the middle of the image
  glm::dvec3 up{0, 0, 1};      ///< points upwards in the image
  double fov_deg = 40;         ///< of perspective views, from top to bottom
  bool orthographic = false;
  double ortho_height = 2;  ///< of orthographic views, from top to bottom
  /// What is not farther than this from the eye, along the direction of view,
  /// is not seen. Nothing: all that is in front of the eye in perspective, all
  /// in orthographic views.
  std::optional<double> near;
  std::int32_t width_px = 640;
  std::int32_t height_px = 480;
};

/// A camera, and how far rounding moved it (S4.1).
struct Viewed {
  Camera camera;
  /// The greatest distance that a coordinate of the eye or of a corner of the
  /// image moved. Units: grid steps. In perspective the image plane is far
  /// beyond the scene, so at the scene's place it is much less.
  double max_move = 0;
  ViewOptions options;  ///< what the camera was made from
};

/// The camera for a scene that sees what the options say, rounded once to the
/// lattice (S4.1). The image's y grows downwards, against `up`.
///
/// In perspective the image plane is as far from the eye as the lattice allows,
/// so that its vectors have as many bits as there are; with `near` it is at
/// near * 2^j for the greatest j, so that the near distance is exact.
/// Orthographic: the image plane passes through `eye`.
///
/// Errors: kNotFinite; kBadCamera (eye is target, or up runs along the
///         direction of view, or a field of view not inside 0 to 180 degrees,
///         or a height not above 0, or a pixel is less than the lattice tells);
///         those of make_camera.
Result<Viewed> look_at(const Scene& scene, const ViewOptions& options);

/// From where the whole of a scene is seen.
struct ViewDirection {
  glm::dvec3 to_eye{0.45, -0.78, 0.42};  ///< from the scene, of any length
  glm::dvec3 up{0, 0, 1};                ///< points upwards in the image
};

/// The direction turned so that `up` is where z was, by the least turn.
/// Requires: up is finite and not zero.
ViewDirection turned(const ViewDirection& direction, const glm::dvec3& up);

/// A view in which the scene just fits, in the middle of the image.
///
/// Errors: kEmpty (no polygons); kBadCamera (up is zero or along to_eye).
Result<ViewOptions> automatic_options(const Scene& scene,
                                      const ViewDirection& direction,
                                      std::int32_t width_px,
                                      std::int32_t height_px,
                                      bool orthographic = false);

/// The view turned about the line through its target along `axis`,
/// counterclockwise as seen from the axis's end, as a model on a turntable is
/// seen; by an angle of 0 the view itself.
/// Requires: an axis of length 1. Units: radians.
ViewOptions turned_about(const ViewOptions& view, const glm::dvec3& axis,
                         double angle);

/// The same for a camera that is there already, about that point of the middle
/// ray of its image which is next to the middle of the scene. It is rounded to
/// the lattice; by an angle of 0 it is the camera itself.
///
/// Errors: those of make_camera().
Result<Camera> turned_about(const Scene& scene, const Camera& camera,
                            const glm::dvec3& axis, double angle);

/// The middle of the box round the scene's polygons. Units: model units.
/// Requires: there are polygons.
glm::dvec3 middle_of(const Scene& scene);

/// The perspective view from above and to one side, z upwards.
///
/// Errors: those of automatic_options() and look_at().
Result<Viewed> automatic_view(const Scene& scene, std::int32_t width_px,
                              std::int32_t height_px);

}  // namespace halfspace::io
