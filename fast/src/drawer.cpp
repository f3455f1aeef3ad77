#include "drawer.hpp"

#include <algorithm>
#include <cmath>

namespace halfspace::fast {
namespace {

/// Outlines whose corners are known no better than this go line by line: what
/// the kernel derives needs errors far below a pixel.
constexpr double kMostError = 0x1p-10;

/// Beyond this, too: differences of coordinates shall stay finite and small
/// enough for 32 bits.
constexpr double kFarthest = 0x1p30;

/// Of a channel the share `alpha` / 255 of `over` and the rest of `under`,
/// rounded half up (S5.6): the quotient by 255 and a half, over 510.
constexpr std::uint8_t blended(std::uint32_t over, std::uint32_t under,
                               std::uint32_t alpha) {
  return static_cast<std::uint8_t>(
      (2 * (alpha * over + (kOpaque - alpha) * under) + kOpaque) / 510);
}

}  // namespace

template <int kBits>
Drawer<kBits>::Drawer(const Frame& frame, Canvas& canvas)
    : frame_(frame),
      canvas_(canvas),
      scan_(frame.reader, frame.camera),
      shader_(frame.reader.scene(), frame.camera, frame.view),
      gouraud_(frame.image.shading == Shading::kGouraud &&
               !frame.reader.scene().data().corner_colors.empty()) {}

/// Projects the corners, with a bound on their error.
///
/// With X, t and their errors a, b: X / t - X' / t' = (a - b x) / t' for the
/// true X', t', so x is off by (a + b |x|) / (t - b); the reciprocal and the
/// product add 2u |x|, 4u with a margin for the bound's own roundings.
template <int kBits>
typename Drawer<kBits>::Fate Drawer<kBits>::project(
    const TreeFragment& fragment) {
  const View& view = frame_.view;
  const auto corners = frame_.reader.corners(fragment);
  if (corners.size() > kMostCorners) return Fate::kLines;
  bool all_behind = true;
  bool some_in_doubt = false;
  double error = 0;
  std::size_t k = 0;
  for (const Corner& corner : corners) {
    const Vertex v = frame_.reader.vertex(corner.vertex);
    const double t = view.t.at(v.x, v.y, v.z);
    const double t_error =
        (view.t_error + view.t_growth * v.error) * (1 + 0x1p-48);
    all_behind = all_behind && t + t_error < view.near;
    // In perspective `near` is 0 at least, so the quotients are finite.
    if (!(t - t_error > view.near)) {
      some_in_doubt = true;
      continue;
    }
    double x = view.x.at(v.x, v.y, v.z);
    double y = view.y.at(v.x, v.y, v.z);
    double doubt = view.xy_error + view.xy_growth * v.error;
    if (view.perspective) {
      const double reciprocal = 1 / t;
      x *= reciprocal;
      y *= reciprocal;
      doubt = (doubt + t_error * std::max(std::abs(x), std::abs(y))) /
              (t - t_error);
    }
    const double size = std::max(std::abs(x), std::abs(y));
    error = std::max(error, doubt + 4 * kRounding * size);
    some_in_doubt = some_in_doubt || !(size < kFarthest);
    x_[k] = x;
    y_[k] = y;
    ++k;
  }
  if (all_behind) return Fate::kUnseen;
  error_ = error * (1 + 0x1p-40);
  return some_in_doubt || !(error_ < kMostError) ? Fate::kLines
                                                 : Fate::kOutline;
}

template <int kBits>
void Drawer<kBits>::draw(const TreeFragment& fragment, int eye_sign) {
  if (frame_.image.cull && eye_sign < 0) return;
  const Fate fate = project(fragment);
  if (fate != Fate::kUnseen) draw_projected(fragment, fate, eye_sign);
}

/// The way the outline turns, or 0 where its area is too small to tell.
///
/// With D the largest difference to the first corner, d the corners' error:
/// each of a triangle's two products is off by 2D (2d + 2uD) + (2d)^2 and
/// rounding, 3u D^2 for both and their difference: 16 (D + d)(d + u D) bounds
/// that, for each of the fan's triangles and its sum.
template <int kBits>
int Drawer<kBits>::turn(std::size_t count) const {
  double area = 0;
  double extent = 0;
  double x = x_[1] - x_[0];
  double y = y_[1] - y_[0];
  extent = std::max(std::abs(x), std::abs(y));
  for (std::size_t k = 2; k < count; ++k) {
    const double next_x = x_[k] - x_[0];
    const double next_y = y_[k] - y_[0];
    area += x * next_y - y * next_x;
    extent = std::max({extent, std::abs(next_x), std::abs(next_y)});
    x = next_x;
    y = next_y;
  }
  const double doubt = static_cast<double>(count) * 16 * (extent + error_) *
                       (error_ + 4 * kRounding * extent);
  return (area > doubt) - (area < -doubt);
}

template <int kBits>
void Drawer<kBits>::draw_projected(const TreeFragment& fragment, Fate fate,
                                   int eye_sign) {
  ++fragments_;
  fragment_ = &fragment;
  eye_sign_ = eye_sign;
  scan_.start(fragment, eye_sign);
  seen_ready_ = false;

  const Scene& scene = frame_.reader.scene();
  color_ = scene.color(fragment.source);
  shaded_ = gouraud_ && has_gradient(scene, fragment.source);
  if (shaded_) {
    shader_.start(fragment.source, eye_sign);
  } else if (gouraud_) {
    color_ = scene.corner_colors(fragment.source)[0];
  }
  const Ink ink = {fragment.source, {color_.r, color_.g, color_.b}};
  Decider decider = {exact_line, nearer, shaded_ ? shade : nullptr, this};
  if (frame_.alpha != kOpaque) decider.shade = blend;
  if (fate == Fate::kLines) {
    pixels_ += static_cast<std::size_t>(
        frame_.kernel.draw_lines(canvas_, canvas_.lines, ink, decider));
    return;
  }
  const Outline outline = {x_, y_,
                           static_cast<std::int32_t>(fragment.corner_count),
                           error_, -frame_.view.orientation * eye_sign};
  pixels_ += static_cast<std::size_t>(
      frame_.kernel.draw(canvas_, outline, ink, decider));
}

template <int kBits>
PixelRange Drawer<kBits>::exact_line(void* self, std::int32_t j,
                                     PixelRange range) {
  auto& drawer = *static_cast<Drawer*>(self);
  ++drawer.stats_.exact;
  return drawer.scan_.line(j, range);
}

template <int kBits>
void Drawer<kBits>::shade(void* self, std::int32_t x, std::int32_t y,
                          const std::uint32_t* lit) {
  auto& drawer = *static_cast<Drawer*>(self);
  const Canvas& canvas = drawer.canvas_;
  for (std::int32_t r = 0; r < kTileHeight; ++r) {
    if (lit[r] == 0) continue;
    std::uint8_t* line =
        canvas.colors + (y + r) * canvas.colors_stride + std::int64_t{3} * x;
    drawer.stats_.exact += static_cast<std::uint64_t>(
        drawer.shader_.shade(x, y + r, lit[r], line));
  }
}

/// Lays the fragment at hand over what is there (S5.6).
template <int kBits>
void Drawer<kBits>::blend(void* self, std::int32_t x, std::int32_t y,
                          const std::uint32_t* lit) {
  auto& drawer = *static_cast<Drawer*>(self);
  const Canvas& canvas = drawer.canvas_;
  std::uint8_t over[3 * kTileWidth];
  for (std::int32_t k = 0; k < kTileWidth; ++k) {
    over[3 * k] = drawer.color_.r;
    over[3 * k + 1] = drawer.color_.g;
    over[3 * k + 2] = drawer.color_.b;
  }
  for (std::int32_t r = 0; r < kTileHeight; ++r) {
    if (lit[r] == 0) continue;
    if (drawer.shaded_) {
      drawer.stats_.exact += static_cast<std::uint64_t>(
          drawer.shader_.shade(x, y + r, lit[r], over));
    }
    std::uint8_t* line =
        canvas.colors + (y + r) * canvas.colors_stride + std::int64_t{3} * x;
    for (std::uint32_t bits = lit[r]; bits != 0; bits &= bits - 1) {
      const int first = 3 * __builtin_ctz(bits);
      for (int c = first; c < first + 3; ++c) {
        line[c] = blended(over[c], line[c], drawer.frame_.alpha);
      }
    }
  }
}

/// Whether the fragment at hand is nearer than `other` at the sample (S5.3),
/// exactly: the planes' order along the ray is the sign of the line they meet
/// in.
template <int kBits>
bool Drawer<kBits>::is_nearer(PolygonId other, std::int32_t i, std::int32_t j) {
  ++stats_.exact;
  const Geometry& geometry = frame_.reader.geometry();
  const auto here =
      see(geometry.exact<kBits>(fragment_->source), frame_.camera);
  const auto there = see(geometry.exact<kBits>(other), frame_.camera);
  const int order = meet_line<kBits>(here, there).sign_at_sample(i, j) *
                    eye_sign_ * sign(there.eye);
  return order > 0 || (order == 0 && fragment_->source < other);
}

template <int kBits>
const typename Drawer<kBits>::Rival& Drawer<kBits>::rival(PolygonId other) {
  const Geometry& geometry = frame_.reader.geometry();
  if (!seen_ready_) {
    seen_ready_ = true;
    seen_ = see_approximately(geometry.plane(fragment_->source), frame_.view);
    rivals_.fill({});
  }
  Rival& entry = rivals_[static_cast<std::size_t>(other) % rivals_.size()];
  if (entry.polygon == other) return entry;
  const SeenApproximately there =
      see_approximately(geometry.plane(other), frame_.view);
  entry = {other, order_line(seen_, there)};
  // Read against the sides that the eye is on; where the other's is in doubt,
  // so is all of this.
  const int there_sign = known_sign(there.eye);
  if (there_sign == 0) entry.line.error = 1e300;
  if (there_sign * eye_sign_ < 0) {
    entry.line = {-entry.line.a, -entry.line.b, -entry.line.c,
                  entry.line.error};
  }
  return entry;
}

template <int kBits>
void Drawer<kBits>::nearer(void* self, std::int32_t x, std::int32_t y,
                           std::uint32_t* lit) {
  auto& drawer = *static_cast<Drawer*>(self);
  const Canvas& canvas = drawer.canvas_;
  for (std::int32_t r = 0; r < kTileHeight; ++r) {
    const std::int32_t j = y + r;
    const std::int32_t* items = canvas.items + j * canvas.items_stride + x;
    const Rival* rival = nullptr;
    double level = 0;
    for (std::uint32_t bits = lit[r]; bits != 0; bits &= bits - 1) {
      const int k = __builtin_ctz(bits);
      if (rival == nullptr || rival->polygon != items[k]) {
        rival = &drawer.rival(items[k]);
        level = rival->line.b * j + rival->line.c;
      }
      const double order = rival->line.a * (x + k) + level;
      const bool is_nearer = std::abs(order) > rival->line.error
                                 ? order > 0
                                 : drawer.is_nearer(rival->polygon, x + k, j);
      if (!is_nearer) lit[r] &= ~(std::uint32_t{1} << k);
    }
  }
}

template class Drawer<26>;
template class Drawer<40>;
template class Drawer<54>;

}  // namespace halfspace::fast
