#pragma once

#include "camera/view.hpp"
#include "halfspace/fast/build.hpp"
#include "raster/kernel/tile_kernel.hpp"

namespace halfspace::fast {

/// Finds the subtrees that can be skipped: those off the screen, behind the eye
/// or the near distance, or where all is lit.
class Culler {
 public:
  Culler(const View& view, const TileKernel& kernel, const TileView& screen);

  /// False only if nothing in the box can light a pixel any more.
  bool can_show(const Box& box) const {
    const BoxVisibility sight = kernel_.box_visibility(screen_, box_view_, box);
    return sight == BoxVisibility::kUnknown ? can_show_slowly(box)
                                            : sight == BoxVisibility::kVisible;
  }

 private:
  bool can_show_slowly(const Box& box) const;

  const View& view_;
  const TileKernel& kernel_;
  const TileView& screen_;
  BoxView box_view_;
};

}  // namespace halfspace::fast
