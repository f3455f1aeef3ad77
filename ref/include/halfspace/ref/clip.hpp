#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "halfspace/camera.hpp"
#include "halfspace/clip.hpp"
#include "halfspace/image.hpp"
#include "halfspace/ref/predicate.hpp"
#include "halfspace/scene.hpp"

namespace halfspace::ref {

/// The function of a clip plane (S10.1).
Plane function_of(const ClipPlane& clip);

/// Whether polygons of this plane are there at all: with caps not those that
/// lie in a clip plane (S10.3).
bool is_there(const Plane& plane, const ImageOptions& options);

/// What the clip planes leave of a fragment (S10.2); nothing if that has no
/// area. The names of the edges that clipping makes mean nothing.
///
/// Exact: yes.
std::optional<Fragment> clipped(Fragment fragment, const ImageOptions& options);

/// Puts the caps into an item image of the clipped scene (S10.3).
///
/// Every pixel's ray is followed to each clip plane and on: the winding number
/// there is what the polygons behind it add up to.
/// Shape:    the items are those of samples, so many a pixel each way (S5.7).
///           With `eye` only caps of planes that the eye is on that side of.
/// Requires: a closed scene where the options have caps; else nothing is done.
/// Exact:    yes.
void add_caps(const Scene& scene, const Camera& camera,
              const ImageOptions& options, ItemImage& items,
              std::int32_t samples = 1, std::optional<Side> eye = std::nullopt);

/// The same for polygons that are no scene's, with planes: `count` is beyond
/// all their ids, and the id of the first cap.
///
/// Requires: polygons that are closed together, each whole.
void add_caps_of(std::span<const Fragment> polygons, std::size_t count,
                 const Camera& camera, const ImageOptions& options,
                 ItemImage& items);

/// What pixel (i, j) of the clipped scene shows, caps too, where polygons alone
/// show `seen` there.
///
/// Requires: as add_caps(); `ids` are all polygons that cover the pixel's
/// sample
///           where nothing is clipped or culled, and maybe others.
/// Exact:    yes.
PolygonId with_caps_at(const Scene& scene, const Camera& camera,
                       const ImageOptions& options, std::int32_t i,
                       std::int32_t j, PolygonId seen,
                       std::span<const PolygonId> ids);

}  // namespace halfspace::ref
