#include "raster/polygon_rasterizer.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "raster/layers/layer_colors.hpp"

namespace halfspace::fast {
namespace {

/// Outlines whose corners are known no better than this go line by line: what
/// the kernel derives needs errors far below a pixel.
constexpr double kMostError = 0x1p-10;

/// Beyond this, too: differences of coordinates shall stay finite and small
/// enough for 32 bits.
constexpr double kFarthest = 0x1p30;

}  // namespace

template <int kBits>
PolygonRasterizer<kBits>::PolygonRasterizer(const Frame& frame,
                                            TileView& screen)
    : frame_(frame),
      screen_(screen),
      scan_(frame.reader, exact_camera<kBits>(frame), frame.clips,
            frame.view.samples),
      shader_(frame.reader.scene(), frame.camera, frame.view, frame.moved),
      late_shader_(frame.reader.scene(), frame.camera, frame.view, frame.moved),
      gouraud_(frame.image.shading == Shading::kGouraud &&
               !frame.reader.scene().data().corner_colors.empty()),
      // None has less than three.
      triangles_(frame.reader.scene().data().corners.size() ==
                 3 * frame.reader.scene().polygon_count()),
      clipper_(frame.clips, frame.reader),
      depth_(frame, screen) {
  screen.exact = this;
}

template <int kBits>
void PolygonRasterizer<kBits>::prefetch(const Run& run, std::int32_t from,
                                        std::int32_t count) const {
  const SceneData& scene = frame_.reader.scene().data();
  const TreeFragment* fragments = frame_.reader.tree().fragments.data();
  const std::int32_t end = std::min(run.end, run.first + from + count);
  for (std::int32_t f = run.first + from; f < end; ++f) {
    const TreeFragment& fragment = fragments[f];
    const auto source = static_cast<std::size_t>(fragment.source);
    if (!gouraud_) {
      __builtin_prefetch(scene.colors.data() + source);
    } else if (!triangles_) {
      __builtin_prefetch(scene.first_corner.data() + source);
    } else {
      __builtin_prefetch(scene.corners.data() + 3 * source);
      __builtin_prefetch(scene.corner_colors.data() + 3 * source);
    }
  }
}

/// The second step to colours at corners: prefetch() asked for the first.
template <int kBits>
void PolygonRasterizer<kBits>::prefetch_colors(const Run& run,
                                               std::int32_t from,
                                               std::int32_t count) const {
  if (!gouraud_) return;
  const SceneData& scene = frame_.reader.scene().data();
  const TreeFragment* fragments = frame_.reader.tree().fragments.data();
  const std::int32_t end = std::min(run.end, run.first + from + count);
  for (std::int32_t f = run.first + from; f < end; ++f) {
    const auto source = static_cast<std::size_t>(fragments[f].source);
    if (triangles_) {
      // Corners that were cut off are in the scene alone.
      if (fragments[f].corner_count == 3) continue;
      for (std::size_t k = 3 * source; k < 3 * source + 3; ++k) {
        __builtin_prefetch(scene.vertices.data() + scene.corners[k]);
      }
      continue;
    }
    const std::size_t first = scene.first_corner[source];
    __builtin_prefetch(scene.corners.data() + first);
    __builtin_prefetch(scene.corner_colors.data() + first);
  }
}

template <int kBits>
void PolygonRasterizer<kBits>::prefetch(const Node& leaf) const {
  const Blocks blocks = frame_.reader.blocks(leaf);
  if (!blocks.triangles.empty()) prefetch_block(blocks.triangles.front());
  if (!blocks.quadrangles.empty()) prefetch_block(blocks.quadrangles.front());
  const TreeFragment* fragments = frame_.reader.tree().fragments.data();
  const std::int32_t end = std::min(blocks.end, leaf.first_fragment + kAhead);
  for (std::int32_t f = leaf.first_fragment; f < end; f += 4) {
    __builtin_prefetch(fragments + f);
  }
  int count = 0;
  for_fragments(frame_.reader.tree(), blocks.rest,
                [&](const TreeFragment& fragment) {
                  for (const Corner& c : frame_.reader.corners(fragment)) {
                    __builtin_prefetch(frame_.reader.address(c.vertex));
                  }
                  return ++count < kAhead / 2;
                });
}

/// The last step: what prefetch() asked for long before may have left the
/// nearest memory again.
template <int kBits>
void PolygonRasterizer<kBits>::fetch(
    [[maybe_unused]] std::uint32_t some) const {
#if !defined(__wasm__)
  const SceneData& scene = frame_.reader.scene().data();
  const TreeFragment* fragments = frame_.reader.fragments_of(*block_);
  if (gouraud_ && !triangles_) return;
  for (; some != 0; some &= some - 1) {
    const TreeFragment& fragment = fragments[std::countr_zero(some)];
    const auto source = static_cast<std::size_t>(fragment.source);
    if (!gouraud_) {
      __builtin_prefetch(scene.colors.data() + source);
      continue;
    }
    __builtin_prefetch(scene.corner_colors.data() + 3 * source);
    if (fragment.corner_count == 3 &&
        ((block_of<3>(*block_).whole >> std::countr_zero(some)) & 1u) != 0)
      continue;
    for (std::size_t k = 3 * source; k < 3 * source + 3; ++k)
      __builtin_prefetch(scene.vertices.data() + scene.corners[k]);
  }
#endif
}

template <int kBits>
PixelSource PolygonRasterizer<kBits>::begin(std::int32_t k, std::int32_t turn) {
  cuts_ = 0;
  return start(frame_.reader.fragments_of(*block_)[k],
               -frame_.view.orientation * turn);
}

/// Projects the corners, with a bound on their error.
///
/// With X, t and their errors a, b: X / t - X' / t' = (a - b x) / t' for the
/// true X', t', so x is off by (a + b |x|) / (t - b); the reciprocal and the
/// product add 2u |x|, 4u with a margin for the bound's own roundings.
template <int kBits>
template <class VertexAt>
typename PolygonRasterizer<kBits>::Projection PolygonRasterizer<kBits>::project(
    std::size_t count, VertexAt&& vertex_at) {
  const View& view = frame_.view;
  corner_count_ = count;
  if (count > kMostCorners) return Projection::kLines;
  bool all_behind = true;
  bool some_in_doubt = false;
  double error = 0;
  std::size_t k = 0;
  for (std::size_t corner = 0; corner < count; ++corner) {
    const Vertex v = vertex_at(corner);
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
  if (all_behind) return Projection::kUnseen;
  error_ = error * (1 + 0x1p-40);
  return some_in_doubt || !(error_ < kMostError) ? Projection::kLines
                                                 : Projection::kOutline;
}

template <int kBits>
typename PolygonRasterizer<kBits>::Projection PolygonRasterizer<kBits>::project(
    const TreeFragment& fragment) {
  cuts_ = 0;
  if (clip_mask_ != 0) {
    const ClippedFragment left = clipper_.clip(fragment, clip_mask_);
    if (left.is_gone) return Projection::kUnseen;
    cuts_ = left.cuts;
    if (cuts_ != 0 && left.corners.empty()) return Projection::kLines;
    if (cuts_ != 0) {
      return project(left.corners.size(),
                     [&](std::size_t k) { return left.corners[k]; });
    }
  }
  const auto corners = frame_.reader.corners(fragment);
  return project(corners.size(), [&](std::size_t k) {
    return frame_.reader.vertex(corners[k].vertex);
  });
}

template <int kBits>
void PolygonRasterizer<kBits>::draw(const TreeFragment& fragment,
                                    int eye_sign) {
  if (frame_.image.cull && eye_sign < 0) return;
  const Projection projection = project(fragment);
  if (projection != Projection::kUnseen)
    draw_projected(fragment, projection, eye_sign);
}

/// The way the outline turns, or 0 where its area is too small to decide it.
///
/// With D the largest difference to the first corner, d the corners' error: a
/// difference is off by 2d + u D, so each of the fan's triangles, two products,
/// by 8 (D + d) d + 4u D^2, and by 4u D^2 for its own rounding; the fan's sums,
/// for at most 30 triangles, add 58u D^2 for each. 9 (D + d)(d + 8u D) bounds
/// that.
template <int kBits>
int PolygonRasterizer<kBits>::turn(std::size_t count) const {
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
  const double doubt = static_cast<double>(count - 2) * 9 * (extent + error_) *
                       (error_ + 8 * kRounding * extent);
  return (area > doubt) - (area < -doubt);
}

/// The fragment that is meant from now on, and its colour.
template <int kBits>
PixelSource PolygonRasterizer<kBits>::start(const TreeFragment& fragment,
                                            int eye_sign) {
  scan_.start(fragment, eye_sign, cuts_);
  depth_.start(fragment, eye_sign, block_);
  const Scene& scene = frame_.reader.scene();
  const std::span<const Rgb> colors =
      gouraud_ ? corner_colors(fragment.source) : std::span<const Rgb>();
  const bool smooth = has_gradient(colors);
  screen_.corner_colors = nullptr;
  if (smooth) start_shader(fragment, eye_sign);
  const Rgb color = gouraud_ ? colors[0] : scene.color(fragment.source);
  PixelSource source = {
      frame_.first_id + fragment.source,
      smooth ? PixelSource::kSmooth : packed_color(color.r, color.g, color.b),
      eye_sign, 0};
  if (frame_.colors != nullptr)
    source.color = frame_.colors->color_of(fragment.source);
  layer_ = {&fragment, block_, source};
  return source;
}

/// A whole triangle's corners are in its block: the scene's are far from here.
template <int kBits>
void PolygonRasterizer<kBits>::start_shader(const TreeFragment& fragment,
                                            int eye_sign) {
  if (block_ != nullptr && fragment.corner_count == 3) {
    const auto& block = block_of<3>(*block_);
    const auto k =
        static_cast<std::size_t>(&fragment - frame_.reader.fragments_of(block));
    if (((block.whole >> k) & 1u) != 0) {
      screen_.corner_colors = reinterpret_cast<const std::uint8_t*>(
          corner_colors(fragment.source).data());
      shader_.start(fragment.source, eye_sign,
                    {corner_of(block, 0, k), corner_of(block, 1, k),
                     corner_of(block, 2, k)});
      return;
    }
  }
  shader_.start(fragment.source, eye_sign);
}

template <int kBits>
void PolygonRasterizer<kBits>::draw_projected(const TreeFragment& fragment,
                                              Projection projection,
                                              int eye_sign) {
  ++fragments_;
  const PixelSource source = start(fragment, eye_sign);
  if (projection == Projection::kLines) {
    const std::int64_t pixels =
        frame_.kernel.draw_lines(screen_, screen_.lines, source);
    if (!blends) pixels_ += static_cast<std::size_t>(pixels);
    return;
  }
  const Outline outline = {x_, y_, static_cast<std::int32_t>(corner_count_),
                           error_, -frame_.view.orientation * eye_sign};
  const std::int64_t pixels = frame_.kernel.draw(screen_, outline, source);
  if (!blends) pixels_ += static_cast<std::size_t>(pixels);
}

template <int kBits>
PixelRange PolygonRasterizer<kBits>::exact_line(std::int32_t j,
                                                PixelRange range) {
  ++stats_.exact;
  return scan_.line(j, range);
}

template <int kBits>
void PolygonRasterizer<kBits>::shade(const PixelSource& source, std::int32_t x,
                                     std::int32_t y, std::uint32_t bits,
                                     std::uint8_t* colors, std::int64_t at) {
  // A tile is written when others have been drawn since.
  if (late_ != source.id) {
    late_ = source.id;
    late_shader_.start(source.id - frame_.first_id, source.eye_sign);
  }
  stats_.exact +=
      static_cast<std::uint64_t>(late_shader_.shade(x, y, bits, colors, at));
}

template <int kBits>
void PolygonRasterizer<kBits>::blend(std::int32_t x, std::int32_t y,
                                     const std::uint32_t* bits) {
  layers_->add(layer_, x, y, bits);
}

template class PolygonRasterizer<kMovedGrid>;
template class PolygonRasterizer<26>;
template class PolygonRasterizer<40>;
template class PolygonRasterizer<54>;

}  // namespace halfspace::fast
