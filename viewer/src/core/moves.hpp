#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "halfspace/io/view.hpp"
#include "halfspace/result.hpp"
#include "halfspace/scene.hpp"

namespace halfspace::viewer {

/// Moves of a camera. All keep its size in pixels and turn about its target.
/// Units: pixels, where names do not say otherwise; y grows downwards.

/// Right, up and towards the viewer, each of length 1.
struct CameraAxes {
  glm::dvec3 right;
  glm::dvec3 up;
  glm::dvec3 back;
};
CameraAxes axes_of(const io::ViewOptions& camera);

/// The height of what is seen at the target's distance. Units: model units.
double height_at_target(const io::ViewOptions& camera);

/// Turns as a turntable does: sideways about `axis`, and up or down until it is
/// seen from its end. A drag across the height of the image is half a turn.
io::ViewOptions orbited(const io::ViewOptions& camera, glm::dvec2 drag,
                        const glm::dvec3& axis = {0, 0, 1});

/// Turns as a ball under the cursor does, about any axis.
io::ViewOptions rolled(const io::ViewOptions& camera, glm::dvec2 drag);

/// Turns about the direction of view. Units: degrees, counterclockwise.
io::ViewOptions twisted(const io::ViewOptions& camera, double degrees);

/// Moves with the cursor, which keeps its point of the target's plane.
io::ViewOptions panned(const io::ViewOptions& camera, glm::dvec2 drag);

/// Makes what is seen `factor` times as high; the point of the target's plane
/// below the cursor stays there. Requires: factor > 0.
io::ViewOptions zoomed(const io::ViewOptions& camera, double factor,
                       glm::dvec2 cursor);

/// How a point of the model moves that is held by the cursor, across the
/// direction of view. Units: model units.
glm::dvec3 dragged(const io::ViewOptions& camera, const glm::dvec3& point,
                   glm::dvec2 drag);

/// How far it moves where it can move along `axis` alone; where that is seen
/// from its end, by the upward part of the drag. Requires: an axis of length 1.
double dragged_along(const io::ViewOptions& camera, const glm::dvec3& point,
                     const glm::dvec3& axis, glm::dvec2 drag);

/// With parallel rays, or without; at the target the same is seen.
io::ViewOptions with_projection(const io::ViewOptions& camera,
                                bool orthographic);

/// With another field of view; at the target the same is seen.
/// Requires: 0 < fov_deg < 180.
io::ViewOptions with_field(const io::ViewOptions& camera, double fov_deg);

/// Where all is seen from the same side; `to_eye` and `up` name another side.
/// Errors: those of io::automatic_options().
Result<io::ViewOptions> fitted(const Scene& scene,
                               const io::ViewOptions& camera);
Result<io::ViewOptions> fitted(const Scene& scene,
                               const io::ViewOptions& camera,
                               const io::ViewDirection& direction);

/// The way from one camera to another, a share of it done.
io::ViewOptions between(const io::ViewOptions& from, const io::ViewOptions& to,
                        double share);

}  // namespace halfspace::viewer
