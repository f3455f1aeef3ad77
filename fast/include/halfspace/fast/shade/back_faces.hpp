#pragma once

#include "halfspace/camera.hpp"
#include "halfspace/image.hpp"
#include "halfspace/scene.hpp"

namespace halfspace::fast {

/// Colours what is seen from behind by a mark, in its own light (S5.8).
///
/// It is made after the image, from the items alone, so no image without a mark
/// takes longer for it.
/// Requires: colours of these items, which are of the scene and the camera; the
///           items may be a part of an image. threads >= 1.
/// Exact:    yes.
/// Cost:     that of the pixels; a side test where the next pixel of a row
///           shows another polygon.
void mark_back_faces(const Scene& scene, const Camera& camera,
                     const ItemImage& items, const Rgb& mark, int threads,
                     ColorImage& colors);

}  // namespace halfspace::fast
