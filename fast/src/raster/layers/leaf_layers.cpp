#include "raster/layers/leaf_layers.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

namespace halfspace::fast {
namespace {

/// Where there is no layer, as if nearer than all.
constexpr Floats4 kNothing = {std::numeric_limits<float>::infinity(),
                              std::numeric_limits<float>::infinity(),
                              std::numeric_limits<float>::infinity(),
                              std::numeric_limits<float>::infinity()};
constexpr Floats4 kPlaceInFour = {0, 1, 2, 3};
constexpr Ints4 kBitOfFour = {1, 2, 4, 8};

/// Whether the pixels of a line are sorted together: the module for the web is
/// to be small.
#ifdef __wasm__
constexpr bool kSortsLines = false;
#else
constexpr bool kSortsLines = true;
#endif

/// The lines of a tile.
template <class Show>
void for_lines(Show&& show) {
  for (std::size_t r = 0; r < kTileHeight; ++r) show(r);
}

template <class Words>
bool any(const Words& bits) {
  return std::any_of(bits.begin(), bits.end(),
                     [](std::uint32_t line) { return line != 0; });
}

template <class Words>
Words both(const Words& a, const Words& b) {
  Words result;
  for_lines([&](std::size_t r) { result[r] = a[r] & b[r]; });
  return result;
}

template <class Words>
Words without(const Words& a, const Words& b) {
  Words result;
  for_lines([&](std::size_t r) { result[r] = a[r] & ~b[r]; });
  return result;
}

template <class Words>
void add_to(Words& to, const Words& bits) {
  for_lines([&](std::size_t r) { to[r] |= bits[r]; });
}

/// How many bits are set: of all lines at once, byte by byte, for there is no
/// instruction for it in every processor.
template <class Words>
std::size_t count_of(const Words& bits) {
  std::uint32_t bytes = 0;  // at most 64 in each
  for (std::uint32_t line : bits) {
    line -= (line >> 1) & 0x55555555u;
    line = (line & 0x33333333u) + ((line >> 2) & 0x33333333u);
    bytes += (line + (line >> 4)) & 0x0f0f0f0fu;
  }
  const std::uint32_t pairs =
      (bytes & 0x00ff00ffu) + ((bytes >> 8) & 0x00ff00ffu);
  return (pairs & 0xffffu) + (pairs >> 16);
}

}  // namespace

LeafLayers::LeafLayers(const Frame& frame, const TileView& screen,
                       LayerOrder& order)
    : screen_(screen), blender_(frame, screen), order_(order) {
  const std::int64_t rows =
      (screen.lines.end + kTileHeight - 1) / kTileHeight - screen.first_row;
  newest_.assign(static_cast<std::size_t>(rows * screen.tiles_across), kNone);
}

void LeafLayers::show_at_once(const Layer& layer, std::int32_t x,
                              std::int32_t y, const Words& bits) {
  pixels_ += count_of(bits);
  if (blender_.has_items()) {
    blender_.put_item(layer.source.id, x, y, bits.data());
  }
  if (blender_.has_colors()) blender_.blend(layer.source, x, y, bits.data());
}

void LeafLayers::add(const Layer& layer, std::int32_t x, std::int32_t y,
                     const std::uint32_t* bits) {
  Words lit;
  std::copy_n(bits, kWords, lit.begin());
  if (!in_leaf_) {
    show_at_once(layer, x, y, lit);
    return;
  }
  if (masks_.size() == most_masks_) {
    is_full_ = true;
    return;
  }
  if (layers_.empty() || layers_.back().fragment != layer.fragment) {
    layers_.push_back(layer);
  }
  const auto index = static_cast<std::size_t>(
      screen_.tile_at(y / kTileHeight, x / kTileWidth));
  std::int32_t& newest = newest_[index];
  if (newest == kNone) touched_.push_back(static_cast<std::int32_t>(index));
  masks_.push_back(
      {lit, static_cast<std::int32_t>(layers_.size()) - 1,
       std::exchange(newest, static_cast<std::int32_t>(masks_.size()))});
}

void LeafLayers::begin(std::size_t most_masks) {
  in_leaf_ = true;
  is_full_ = false;
  most_masks_ = most_masks;
}

void LeafLayers::clear() {
  for (const std::int32_t tile : touched_) {
    newest_[static_cast<std::size_t>(tile)] = kNone;
  }
  layers_.clear();
  masks_.clear();
  touched_.clear();
  in_leaf_ = false;
}

void LeafLayers::show() {
  depths_.assign(layers_.size(), {});
  for (const std::int32_t tile : touched_) show_tile(tile);
  clear();
}

void LeafLayers::show_tile(std::int32_t index) {
  x_ = index % screen_.tiles_across * kTileWidth;
  y_ = (screen_.first_row + index / screen_.tiles_across) * kTileHeight;
  if (collect(index)) {
    for (const Here& here : here_) {
      show_at_once(layers_[static_cast<std::size_t>(here.layer)], x_, y_,
                   here.lit);
    }
    return;
  }
  sort_by_depth();
  const Words rest = unsorted();
  show_layers(rest);
  if (!any(rest)) return;
  shade_layers(rest);
  for (std::int32_t r = 0; r < kTileHeight; ++r) {
    const std::uint32_t pixels = rest[static_cast<std::size_t>(r)];
    if (pixels != 0) show_line(r, pixels);
  }
}

/// Collects the layers of a tile. Whether no pixel has two of them.
bool LeafLayers::collect(std::int32_t index) {
  here_.clear();
  Words some{};
  bool is_simple = true;
  std::int32_t place = newest_[static_cast<std::size_t>(index)];
  while (place != kNone) {
    const Mask& mask = masks_[static_cast<std::size_t>(place)];
    is_simple = is_simple && !any(both(some, mask.lit));
    add_to(some, mask.lit);
    here_.push_back({mask.lit, mask.layer, 0, 0, 0});
    place = mask.next;
  }
  return is_simple;
}

const DepthDifference& LeafLayers::depth_of(std::int32_t layer) {
  const auto k = static_cast<std::size_t>(layer);
  Depth& depth = depths_[k];
  if (!depth.is_known) depth = {true, order_.start_layer(layers_[k])};
  return depth.line;
}

/// Sorts the tile's layers, the farthest first, by their depths in the middle
/// of what they cover: a guess, which unsorted() looks at.
void LeafLayers::sort_by_depth() {
  for (Here& here : here_) {
    std::uint32_t columns = 0;
    int first = kTileHeight;
    int last = 0;
    for (int r = 0; r < kTileHeight; ++r) {
      const std::uint32_t line = here.lit[static_cast<std::size_t>(r)];
      if (line == 0) continue;
      columns |= line;
      first = std::min(first, r);
      last = r;
    }
    const double i =
        x_ + (std::countr_zero(columns) + 31 - std::countl_zero(columns)) / 2.0;
    const double j = y_ + (first + last) / 2.0;
    const DepthDifference& line = depth_of(here.layer);
    here.depth = line.a * i + (line.b * j + line.c);
    // What is no number has no order.
    if (!(here.depth > -1e300 && here.depth < 1e300)) here.depth = 0;
    here.error = line.error;
  }
  std::sort(here_.begin(), here_.end(), [&](const Here& l, const Here& r) {
    return std::pair(l.depth, l.layer) < std::pair(r.depth, r.layer);
  });
  // Coplanar ones, whose depths differ by what rounding does: the lowest id is
  // the nearest.
  for (std::size_t k = 1; k < here_.size(); ++k) {
    for (std::size_t at = k; at > 0; --at) {
      const Here& far = here_[at - 1];
      const Here& near = here_[at];
      const bool in_doubt = !(near.depth - far.depth > near.error + far.error);
      if (!in_doubt || source_of(far).id > source_of(near).id) break;
      std::swap(here_[at - 1], here_[at]);
    }
  }
}

/// The pixels where a layer is not nearer than the one before it there.
LeafLayers::Words LeafLayers::unsorted() {
  Words result{};
  Words some{};
  for (std::size_t k = 0; k < here_.size(); ++k) {
    Words contested = both(here_[k].lit, some);
    add_to(some, here_[k].lit);
    if (!any(contested)) continue;
    order_.start_layer(layers_[static_cast<std::size_t>(here_[k].layer)]);
    for (std::size_t other = k; any(contested);) {
      const Here& below = here_[--other];
      const Words shared = both(below.lit, contested);
      if (!any(shared)) continue;
      contested = without(contested, shared);
      Words nearer = shared;
      order_.nearer(source_of(below).id, x_, y_, nearer.data());
      add_to(result, without(shared, nearer));
    }
  }
  return result;
}

/// Shows the layers one after the other, but for the pixels `left_out`. Of
/// opaque ones only what nothing hides.
void LeafLayers::show_layers(const Words& left_out) {
  const bool is_opaque = blender_.alpha() == kOpaque;
  for (const Here& here : here_) {
    const Words own = without(here.lit, left_out);
    pixels_ += count_of(own);
    if (blender_.has_colors() && !is_opaque) {
      blender_.blend(source_of(here), x_, y_, own.data());
    }
  }
  if (!blender_.has_items() && !is_opaque) return;
  Words done = left_out;
  for (std::size_t k = here_.size(); k-- > 0;) {
    const Words top = without(here_[k].lit, done);
    if (!any(top)) continue;
    add_to(done, top);
    const PixelSource& source = source_of(here_[k]);
    if (blender_.has_items()) blender_.put_item(source.id, x_, y_, top.data());
    if (blender_.has_colors() && is_opaque) {
      blender_.blend(source, x_, y_, top.data());
    }
  }
}

/// Finds the colours of smooth layers at those pixels, layer by layer: a
/// layer's gradient is made once.
void LeafLayers::shade_layers(const Words& pixels) {
  shades_.clear();
  if (!blender_.has_colors()) return;
  for (Here& here : here_) {
    const Words own = both(here.lit, pixels);
    if (!source_of(here).smooth() || !any(own)) continue;
    here.shades = shades_.size();
    shades_.resize(shades_.size() + kWords);
    for_lines([&](std::size_t r) {
      if (own[r] == 0) return;
      blender_.shade(source_of(here), x_, y_ + static_cast<std::int32_t>(r),
                     own[r], shades_[here.shades + r]);
    });
  }
}

bool LeafLayers::is_nearer(const Here& here, const Here& there, std::int32_t i,
                           std::int32_t j) {
  order_.start_layer(layers_[static_cast<std::size_t>(here.layer)]);
  Words one{};
  one[static_cast<std::size_t>(j - y_)] = std::uint32_t{1} << (i - x_);
  order_.nearer(source_of(there).id, x_, y_, one.data());
  return any(one);
}

/// Sorts the layers of a pixel, the farthest first: by depths in doubles, which
/// are off by their errors (difference_of_depths()), else exactly.
void LeafLayers::sort_pixel(std::int32_t i, std::int32_t j) {
  for (std::size_t k = 1; k < pixel_.size(); ++k) {
    const AtPixel own = pixel_[k];
    std::size_t at = k;
    for (; at > 0; --at) {
      const AtPixel& before = pixel_[at - 1];
      const double difference = own.depth - before.depth;
      const double doubt = (own.error + before.error) * (1 + 0x1p-40);
      const bool is_known = difference > doubt || difference < -doubt;
      if (is_known ? difference > 0
                   : is_nearer(*own.here, *before.here, i, j)) {
        break;
      }
      pixel_[at] = before;
    }
    pixel_[at] = own;
  }
}

/// Finds how near the layers are along line j, as differences to one depth, in
/// floats. False where a float does not hold that.
///
/// Let S bound the size at the first pixel and that of what the line adds. A
/// key is off by its depth's error and 3 2^-24 S: three coefficients and terms,
/// and a sum. A difference of two is off by twice that, and 2 2^-24 S for its
/// own rounding: 2^-20 S is twice as much.
bool LeafLayers::make_keys(std::int32_t j) {
  if (keys_.size() < line_.size()) keys_.resize(line_.size());
  const DepthDifference& first = depth_of(line_[0]->layer);
  const double base = first.a * x_ + (first.b * j + first.c);
  double size = 0;
  double error = 0;
  for (std::size_t k = 0; k < line_.size(); ++k) {
    Keys& keys = keys_[k];
    const Here& here = *line_[k];
    const DepthDifference& depth = depth_of(here.layer);
    const double at_left = depth.a * x_ + (depth.b * j + depth.c) - base;
    const double own_size = std::abs(at_left) + kTileWidth * std::abs(depth.a);
    if (!(own_size < 1e30 && depth.error < 1e30)) return false;
    size = std::max(size, own_size);
    error = std::max(error, depth.error);
    const auto left = static_cast<float>(at_left);
    const auto slope = static_cast<float>(depth.a);
    const std::uint32_t lit = here.lit[static_cast<std::size_t>(j - y_)];
    for (std::size_t v = 0; v < keys.depth.size(); ++v) {
      const auto four = static_cast<std::int32_t>((lit >> (4 * v)) & 15u);
      const Ints4 is_lit = (four & kBitOfFour) != 0;
      const auto column = static_cast<float>(4 * v);
      keys.depth[v] =
          is_lit ? left + slope * (column + kPlaceInFour) : kNothing;
      keys.layer[v] = Ints4{} + static_cast<std::int32_t>(k);
    }
  }
  doubt_ = static_cast<float>((2 * error + 0x1p-20 * size) * (1 + 0x1p-20)) +
           std::numeric_limits<float>::min();
  return true;
}

/// Sorts the layers at the pixels of a line, all pixels at once: by floats.
/// Gives the pixels where these are too close.
std::uint32_t LeafLayers::sort_line(std::int32_t j, std::uint32_t pixels) {
  const std::size_t count = line_.size();
  levels_.assign(count, 0);
  if (!make_keys(j)) return pixels;
  for (std::size_t k = 0; k < count; ++k) {
    // How many pixels have one layer, two, three, and so on.
    std::uint32_t carried =
        line_[k]->lit[static_cast<std::size_t>(j - y_)] & pixels;
    for (std::size_t l = 0; carried != 0; ++l) {
      carried &= std::exchange(levels_[l], levels_[l] | carried);
    }
    for (std::size_t at = k; at > 0; --at) {
      if (!exchange(keys_[at - 1], keys_[at])) break;
    }
  }
  std::array<Ints4, kTileWidth / 4> close{};
  for (std::size_t k = 1; k < count && levels_[k] != 0; ++k) {
    for (std::size_t v = 0; v < close.size(); ++v) {
      const Floats4 depth = keys_[k].depth[v];
      const Ints4 is_close = ~(depth - keys_[k - 1].depth[v] > doubt_);
      close[v] |= is_close & (depth < kNothing);
    }
  }
  std::uint32_t result = 0;
  for (std::size_t i = 0; i < kTileWidth; ++i) {
    result |= std::uint32_t{close[i / 4][i % 4] != 0 ? 1u : 0u} << i;
  }
  return result & pixels;
}

/// Sorts the keys of two, pixel by pixel. Whether that changes any.
bool LeafLayers::exchange(Keys& less, Keys& more) {
  Ints4 changed{};
  for (std::size_t v = 0; v < less.depth.size(); ++v) {
    const Floats4 a = less.depth[v];
    const Floats4 b = more.depth[v];
    const Ints4 p = less.layer[v];
    const Ints4 q = more.layer[v];
    const Ints4 is_wrong = a > b;
    less.depth[v] = is_wrong ? b : a;
    more.depth[v] = is_wrong ? a : b;
    less.layer[v] = is_wrong ? q : p;
    more.layer[v] = is_wrong ? p : q;
    changed |= is_wrong;
  }
  return (changed[0] | changed[1] | changed[2] | changed[3]) != 0;
}

/// Shows line r of the tile in those pixels.
void LeafLayers::show_line(std::int32_t r, std::uint32_t pixels) {
  const std::int32_t j = y_ + r;
  line_.clear();
  for (const Here& here : here_) {
    if ((here.lit[static_cast<std::size_t>(r)] & pixels) != 0)
      line_.push_back(&here);
  }
  std::uint32_t close = pixels;
  if constexpr (kSortsLines) close = sort_line(j, pixels);
  for (std::uint32_t rest = close; rest != 0; rest &= rest - 1) {
    show_pixel(r, static_cast<std::size_t>(std::countr_zero(rest)));
  }
  if constexpr (kSortsLines) show_sorted(r, pixels & ~close);
}

/// Shows the pixels of a line that is sorted.
void LeafLayers::show_sorted(std::int32_t r, std::uint32_t pixels) {
  const std::int32_t j = y_ + r;
  LineColors over;
  for (std::size_t l = 0; l < levels_.size(); ++l) {
    const std::uint32_t own = levels_[l] & pixels;
    if (own == 0) break;
    const std::uint32_t above = l + 1 < levels_.size() ? levels_[l + 1] : 0;
    for (std::uint32_t rest = own; rest != 0; rest &= rest - 1) {
      ++pixels_;
      const auto i = static_cast<std::size_t>(std::countr_zero(rest));
      const Here& here = *line_[static_cast<std::size_t>(keys_[l].layer_at(i))];
      put_color(here, static_cast<std::size_t>(r), i, over);
      if (blender_.has_items() && ((above >> i) & 1u) == 0)
        *blender_.item_at(x_ + static_cast<std::int32_t>(i), j) =
            source_of(here).id;
    }
    if (blender_.has_colors()) blender_.blend_line(over, own, x_, j);
  }
}

/// Writes a layer's colour at a pixel of line r of the tile.
void LeafLayers::put_color(const Here& here, std::size_t r, std::size_t i,
                           LineColors& colors) const {
  const PixelSource& source = source_of(here);
  if (source.smooth()) {
    if (shades_.empty()) return;
    std::memcpy(&colors[3 * i], &shades_[here.shades + r][3 * i], 3);
    return;
  }
  for (std::size_t c = 0; c < 3; ++c) {
    colors[3 * i + c] = static_cast<std::uint8_t>(source.color >> (8 * c));
  }
}

/// Shows one pixel, whose layers' order takes more than floats.
void LeafLayers::show_pixel(std::int32_t r, std::size_t column) {
  const std::int32_t i = x_ + static_cast<std::int32_t>(column);
  const std::int32_t j = y_ + r;
  const auto line = static_cast<std::size_t>(r);
  pixel_.clear();
  for (const Here* here : line_) {
    if (((here->lit[line] >> column) & 1u) == 0) continue;
    const DepthDifference& depth = depth_of(here->layer);
    pixel_.push_back(
        {here, depth.a * i + (depth.b * j + depth.c), depth.error});
  }
  sort_pixel(i, j);
  pixels_ += pixel_.size();
  if (blender_.has_items())
    *blender_.item_at(i, j) = source_of(*pixel_.back().here).id;
  if (!blender_.has_colors()) return;
  LineColors over;
  for (const AtPixel& at : pixel_) {
    put_color(*at.here, line, column, over);
    blender_.blend_line(over, std::uint32_t{1} << column, x_, j);
  }
}

}  // namespace halfspace::fast
