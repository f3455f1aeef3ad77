#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "raster/layers/layer_blender.hpp"

namespace halfspace::fast {

/// Numbers of four pixels, as GCC and Clang compile them for any processor.
using Floats4 = float __attribute__((vector_size(16)));
using Ints4 = std::int32_t __attribute__((vector_size(16)));

/// A fragment that is displayed back to front: in a leaf, a layer.
struct Layer {
  const TreeFragment* fragment = nullptr;
  const BlockHead* block = nullptr;  ///< the fragment's, if it is drawn by one
  PixelSource source;
};

/// Which of two layers is nearer (S5.3).
class LayerOrder {
 public:
  /// The layer that is meant from now on. Its depth, as of depth_of().
  virtual DepthDifference start_layer(const Layer& layer) = 0;
  /// ExactFallback::nearer(), for that layer.
  virtual void nearer(std::int32_t other, std::int32_t x, std::int32_t y,
                      std::uint32_t* lit) = 0;

 protected:
  ~LayerOrder() = default;
};

/// What a band shows back to front: fragments whose order is known at once,
/// those of a leaf when all of them are there, tile by tile.
///
/// A tile of a leaf keeps a mask for each layer. Where no pixel has two layers
/// their order does not matter. Else they are sorted by their depth at one
/// pixel; pixels for which that is the order of all layers, as the exact order
/// of each and the one before it tells, are blended layer by layer, the others
/// pixel by pixel.
class LeafLayers {
 public:
  /// So many masks are kept before a leaf is shown in parts: 2.5 MiB, which
  /// stay near.
  static constexpr std::size_t kMostMasks = std::size_t{1} << 16;

  LeafLayers(const Frame& frame, const TileView& screen, LayerOrder& order);

  /// The pixels `bits` (8 words) of the tile with the left top pixel (x, y)
  /// have that layer: shows it, or keeps it if a leaf has begun.
  void add(const Layer& layer, std::int32_t x, std::int32_t y,
           const std::uint32_t* bits);

  /// Begins a leaf, of which `most_masks` are kept.
  void begin(std::size_t most_masks);
  /// Whether the leaf has more masks than are kept.
  bool is_full() const { return is_full_; }
  /// Shows the leaf, and ends it.
  void show();
  /// Ends it without that.
  void clear();

  /// How often a pixel was set.
  std::size_t pixels() const { return pixels_; }
  FilterStats stats() const { return blender_.stats(); }

 private:
  static constexpr std::size_t kWords = kTileHeight;
  using Words = std::array<std::uint32_t, kWords>;
  struct Mask {
    Words lit;
    std::int32_t layer;
    std::int32_t next;  ///< of the same tile
  };
  struct Depth {
    bool is_known = false;
    DepthDifference line;
  };
  /// A layer of the tile that is shown.
  struct Here {
    Words lit;
    std::int32_t layer;
    double depth;        ///< at one of its pixels
    double error;        ///< of that
    std::size_t shades;  ///< where its colours are, if it is smooth
  };

  /// How near a layer is at the pixels of a line, and which of line_ it is.
  struct Keys {
    std::array<Floats4, kTileWidth / 4> depth;
    std::array<Ints4, kTileWidth / 4> layer;

    std::int32_t layer_at(std::size_t i) const { return layer[i / 4][i % 4]; }
  };

  void show_at_once(const Layer& layer, std::int32_t x, std::int32_t y,
                    const Words& bits);
  void show_tile(std::int32_t index);
  bool collect(std::int32_t index);
  const DepthDifference& depth_of(std::int32_t layer);
  void sort_by_depth();
  Words unsorted();
  void show_layers(const Words& left_out);
  void shade_layers(const Words& pixels);
  static bool exchange(Keys& less, Keys& more);
  bool make_keys(std::int32_t j);
  void show_line(std::int32_t r, std::uint32_t pixels);
  std::uint32_t sort_line(std::int32_t j, std::uint32_t pixels);
  void show_sorted(std::int32_t r, std::uint32_t pixels);
  void put_color(const Here& here, std::size_t r, std::size_t i,
                 LineColors& colors) const;
  void show_pixel(std::int32_t r, std::size_t column);
  void sort_pixel(std::int32_t i, std::int32_t j);
  bool is_nearer(const Here& here, const Here& there, std::int32_t i,
                 std::int32_t j);
  const PixelSource& source_of(const Here& here) const {
    return layers_[static_cast<std::size_t>(here.layer)].source;
  }

  const TileView& screen_;
  LayerBlender blender_;
  LayerOrder& order_;
  bool in_leaf_ = false;
  bool is_full_ = false;
  std::size_t most_masks_ = 0;
  std::vector<Layer> layers_;
  std::vector<Depth> depths_;  ///< of the layers
  std::vector<Mask> masks_;
  std::vector<std::int32_t> newest_;   ///< mask of a tile
  std::vector<std::int32_t> touched_;  ///< tiles that have masks
  std::int32_t x_ = 0;  ///< the left top pixel of the tile that is shown
  std::int32_t y_ = 0;
  std::vector<Here> here_;         ///< its layers
  std::vector<const Here*> line_;  ///< those of a line
  std::vector<Keys> keys_;         ///< theirs, in the end the farthest first
  float doubt_ = 0;                ///< of their differences
  std::vector<std::uint32_t> levels_;  ///< pixels with more layers than that
  /// The layers of a pixel, farthest first, and how near they are there.
  struct AtPixel {
    const Here* here;
    double depth;
    double error;
  };
  std::vector<AtPixel> pixel_;
  std::vector<LineColors> shades_;
  std::size_t pixels_ = 0;
};

}  // namespace halfspace::fast
