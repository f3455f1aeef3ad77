#pragma once

#include "drawing/hiding.hpp"
#include "halfspace/fast/drawing.hpp"

namespace halfspace::fast {

/// A place in the image, exactly: (x, y) / w, w positive. Bits: a value of the
/// camera's x has 8n + 44, 476, and is multiplied with that of a cut, 656.
struct ExactImagePoint {
  CutProduct x, y, w;
};

/// Where cuts of edges are seen.
class ImagePoints {
 public:
  ImagePoints(const Sight& sight, const Hiding& hiding)
      : sight_(sight), hiding_(hiding) {}

  ExactImagePoint exact(const Line& line, const Cut& cut) const;
  /// The same as nearest doubles.
  DrawingPoint point(const Line& line, const Cut& cut) const;
  /// The share of the edge up to a cut, as the nearest double.
  double share(const Line& line, const Cut& cut) const;

 private:
  const Sight& sight_;
  const Hiding& hiding_;
};

}  // namespace halfspace::fast
