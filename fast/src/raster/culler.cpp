#include "raster/culler.hpp"

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
  const double end = std::floor(high + 0.6);
  return {static_cast<std::int32_t>(
              std::clamp(first, double(within.first), double(within.end))),
          static_cast<std::int32_t>(
              std::clamp(end, double(within.first), double(within.end)))};
}

void to_floats(const Affine3& f, float (&to)[4]) {
  to[0] = static_cast<float>(f.a);
  to[1] = static_cast<float>(f.b);
  to[2] = static_cast<float>(f.c);
  to[3] = static_cast<float>(f.d);
}

}  // namespace

/// A float's rounding is 2^29 times that of a double, so 2^29 times the view's
/// bounds, 16u of the sum of sizes, bound floats: a coefficient, a product and
/// three sums are off by 6u of it.
///
/// With those, D for x and y and d for t, a quotient of size W at most is off
/// by (D + W d) / t, a twentieth where t is 20 (D + W d) or more; its own
/// roundings add 2^-23 W, less than a hundredth. Beyond W, the farthest pixel,
/// it is off by as much of itself over W, and so is beyond W less that.
Culler::Culler(const View& view, const TileKernel& kernel,
               const TileView& screen)
    : view_(view), kernel_(kernel), screen_(screen) {
  to_floats(view.x, box_view_.x);
  to_floats(view.y, box_view_.y);
  const double xy_error = 0x1p29 * view.xy_error;
  double t_error = 0x1p29 * view.t_error;
  double near = 0;
  if (view.perspective) {
    to_floats(view.t, box_view_.t);
    near = view.near + t_error;
  } else {
    // Nothing is divided; where there is a near distance nothing is decided.
    box_view_.t[3] = 1;
    t_error = 0;
    if (std::isfinite(view.near)) near = 2;
  }
  const double farthest = std::max(screen.columns.end, screen.lines.end);
  const double least =
      std::max(near, 20 * (xy_error + (farthest + 1) * t_error));
  box_view_.least = static_cast<float>(least * (1 + 0x1p-20));
}

bool Culler::can_show_slowly(const Box& box) const {
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
  const PixelRange columns = pixels(x_least, x_most, screen_.columns);
  const PixelRange lines = pixels(y_least, y_most, screen_.lines);
  if (columns.first >= columns.end || lines.first >= lines.end) return false;
  return kernel_.any_unlit(screen_, columns, lines);
}

}  // namespace halfspace::fast
