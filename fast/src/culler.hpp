#pragma once

#include "halfspace/fast/build.hpp"
#include "kernel.hpp"
#include "view.hpp"

namespace halfspace::fast {

/// Tells which subtrees can be skipped: those off the screen, behind the eye
/// or the near distance, or where all is lit.
class Culler {
 public:
  Culler(const View& view, const Kernel& kernel, const Canvas& canvas)
      : view_(view), kernel_(kernel), canvas_(canvas) {}

  /// False only if nothing in the box can light a pixel any more.
  bool can_show(const Box& box) const;

 private:
  const View& view_;
  const Kernel& kernel_;
  const Canvas& canvas_;
};

}  // namespace halfspace::fast
