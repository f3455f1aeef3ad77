#include "culler.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace halfspace::fast {
namespace {

/// The range of an affine function over a box.
struct Extremes {
  double least;
  double most;
};

Extremes over(const Affine3& f, const Box& box) {
  Extremes e{f.d, f.d};
  const double n[3] = {f.a, f.b, f.c};
  for (std::size_t a = 0; a < 3; ++a) {
    const double l = n[a] * static_cast<double>(box.low[a]);
    const double h = n[a] * static_cast<double>(box.high[a]);
    e.least += std::min(l, h);
    e.most += std::max(l, h);
  }
  return e;
}

/// The pixels whose centres may lie from `low` to `high`.
PixelRange pixels(double low, double high, PixelRange within) {
  // A tenth of a pixel outweighs what rounding adds to coordinates that matter.
  const double first = std::ceil(low - 0.6);
  const double end = std::ceil(high + 0.6);
  return {static_cast<std::int32_t>(
              std::clamp(first, double(within.first), double(within.end))),
          static_cast<std::int32_t>(
              std::clamp(end, double(within.first), double(within.end)))};
}

}  // namespace

bool Culler::can_show(const Box& box) const {
  const Extremes t = over(view_.t, box);
  if (t.most + view_.t_error < view_.near) return false;
  double x_least, x_most, y_least, y_most;
  if (!view_.perspective) {
    const Extremes x = over(view_.x, box);
    const Extremes y = over(view_.y, box);
    if (!(view_.xy_error < 0.01)) return true;
    x_least = x.least;
    x_most = x.most;
    y_least = y.least;
    y_most = y.most;
  } else {
    // Close to the eye's own plane quotients say nothing.
    const double margin = 1e-3 * (t.most - t.least) + 1e6 * view_.t_error;
    if (!(t.least > margin)) return true;
    if (!(view_.xy_error / t.least < 0.01)) return true;
    x_least = y_least = 1e300;
    x_most = y_most = -1e300;
    for (int corner = 0; corner < 8; ++corner) {
      const double px =
          (corner & 1) != 0 ? double(box.high[0]) : double(box.low[0]);
      const double py =
          (corner & 2) != 0 ? double(box.high[1]) : double(box.low[1]);
      const double pz =
          (corner & 4) != 0 ? double(box.high[2]) : double(box.low[2]);
      const double reciprocal = 1 / view_.t.at(px, py, pz);
      const double x = view_.x.at(px, py, pz) * reciprocal;
      const double y = view_.y.at(px, py, pz) * reciprocal;
      x_least = std::min(x_least, x);
      x_most = std::max(x_most, x);
      y_least = std::min(y_least, y);
      y_most = std::max(y_most, y);
    }
  }
  const PixelRange columns = pixels(x_least, x_most, canvas_.columns);
  const PixelRange lines = pixels(y_least, y_most, canvas_.lines);
  if (columns.first >= columns.end || lines.first >= lines.end) return false;
  return kernel_.any_open(canvas_, columns, lines);
}

}  // namespace halfspace::fast
