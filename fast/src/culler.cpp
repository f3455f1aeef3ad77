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

/// The function at the corners of a box, from its share along each axis.
void at_corners(const Affine3& f, const Box& box, double (&values)[8]) {
  const double x[2] = {f.a * double(box.low[0]), f.a * double(box.high[0])};
  const double y[2] = {f.b * double(box.low[1]), f.b * double(box.high[1])};
  const double z[2] = {f.c * double(box.low[2]) + f.d,
                       f.c * double(box.high[2]) + f.d};
  for (std::size_t k = 0; k < 8; ++k) {
    values[k] = x[k % 2] + y[k / 2 % 2] + z[k / 4];
  }
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
    double xs[8], ys[8], ts[8];
    at_corners(view_.x, box, xs);
    at_corners(view_.y, box, ys);
    at_corners(view_.t, box, ts);
    for (std::size_t k = 0; k < 8; ++k) {
      const double reciprocal = 1 / ts[k];
      xs[k] *= reciprocal;
      ys[k] *= reciprocal;
    }
    x_least = x_most = xs[0];
    y_least = y_most = ys[0];
    for (std::size_t k = 1; k < 8; ++k) {
      x_least = std::min(x_least, xs[k]);
      x_most = std::max(x_most, xs[k]);
      y_least = std::min(y_least, ys[k]);
      y_most = std::max(y_most, ys[k]);
    }
  }
  const PixelRange columns = pixels(x_least, x_most, canvas_.columns);
  const PixelRange lines = pixels(y_least, y_most, canvas_.lines);
  if (columns.first >= columns.end || lines.first >= lines.end) return false;
  return kernel_.any_unlit(canvas_, columns, lines);
}

}  // namespace halfspace::fast
