#pragma once

#include "camera/view.hpp"
#include "halfspace/fast/build.hpp"
#include "raster/kernel/kernel.hpp"

namespace halfspace::fast {

/// Tells which subtrees can be skipped: those off the screen, behind the eye
/// or the near distance, or where all is lit.
class Culler {
 public:
  Culler(const View& view, const Kernel& kernel, const Canvas& canvas);

  /// False only if nothing in the box can light a pixel any more.
  bool can_show(const Box& box) const {
    const Sight sight = kernel_.see_box(canvas_, box_view_, box);
    return sight == Sight::kUntold ? can_show_slowly(box)
                                   : sight == Sight::kShown;
  }

 private:
  bool can_show_slowly(const Box& box) const;

  const View& view_;
  const Kernel& kernel_;
  const Canvas& canvas_;
  BoxView box_view_;
};

}  // namespace halfspace::fast
