#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "camera/view.hpp"
#include "no_fallback.hpp"
#include "raster/kernel/tile_kernel.hpp"
#include "raster/tile_buffer.hpp"

/// What tiles show of rectangles with corners between pixels, drawn one after
/// another: so many that a tile takes more masks than it keeps.
namespace halfspace::fast {
namespace {

constexpr std::int32_t kWidth = 100;
constexpr std::int32_t kHeight = 60;
constexpr Rgb kGrey = {9, 9, 9};

Rgb color_of(PolygonId id) {
  if (id == kBackground) return kGrey;
  const auto level = static_cast<std::uint8_t>(id);
  return {level, 1, 2};
}

PixelSource source_of(PolygonId id) {
  const Rgb color = color_of(id);
  return {id, packed_color(color.r, color.g, color.b), 1, 0};
}

/// In leaves the lowest id is nearest.
struct LowestIsNearest : NoFallback {
  PixelSource begin(std::int32_t, std::int32_t) override {
    return source_of(id);
  }
  void nearer(std::int32_t other, std::int32_t, std::int32_t,
              std::uint32_t* lit) override {
    if (other < id) std::fill_n(lit, kTileHeight, 0u);
  }
  PolygonId id = 0;  ///< of the polygon that is drawn
};

class Random {
 public:
  std::int32_t below(std::int32_t end) {
    return static_cast<std::int32_t>(engine_() %
                                     static_cast<std::uint64_t>(end));
  }
  Rectangle rectangle(bool small) {
    const std::int32_t left = below(kWidth);
    const std::int32_t top = below(kHeight);
    return {left, top, left + 1 + below(small ? 8 : 90),
            top + 1 + below(small ? 4 : 40)};
  }

 private:
  std::mt19937_64 engine_{17};
};

/// The part of an image that is wanted, drawn by a kernel and pixel by pixel.
class Both {
 public:
  Both(const TileKernel& kernel, const Rectangle& wanted, bool items)
      : kernel_(kernel),
        wanted_(wanted),
        expected_(wanted.right - wanted.left, wanted.bottom - wanted.top,
                  kBackground),
        result_(blank(expected_, items)),
        buffer_(wanted, {wanted.top, wanted.bottom}, result_, true) {
    buffer_.view().exact = &exact_;
  }

  void enter_leaf(std::int32_t most_masks) {
    buffer_.enter_leaf();
    buffer_.view().most_masks = most_masks;
    before_ = expected_;
    in_leaf_ = true;
  }

  void leave_leaf() {
    kernel_.leave_leaf(buffer_.view());
    in_leaf_ = false;
  }

  void draw(const Rectangle& r, PolygonId id) {
    exact_.id = id;
    draw_somehow(r, id);
    for (std::int32_t j = std::max(r.top, wanted_.top);
         j < std::min(r.bottom, wanted_.bottom); ++j) {
      for (std::int32_t i = std::max(r.left, wanted_.left);
           i < std::min(r.right, wanted_.right); ++i) {
        light(i - wanted_.left, j - wanted_.top, id);
      }
    }
  }

  /// Every other one by the loops for small polygons, if they take it.
  void draw_somehow(const Rectangle& r, PolygonId id) {
    const double x[4] = {double(r.left), double(r.right), double(r.right),
                         double(r.left)};
    const double y[4] = {double(r.top), double(r.top), double(r.bottom),
                         double(r.bottom)};
    if (in_leaf_ && id % 2 == 0) {
      FragmentBlock<4> block;
      for (std::size_t c = 0; c < 4; ++c) {
        block.x[c].fill(static_cast<float>(x[c]));
        block.y[c].fill(static_cast<float>(y[c]));
      }
      block.count = 1;
      View view;
      view.perspective = false;
      view.x.a = view.y.b = 1;
      view.near = -1;
      view.xy_error = 0x1p-20;
      const BlockDrawn drawn =
          kernel_.draw_quadrangles(buffer_.view(), view, false, block);
      small_ += static_cast<std::size_t>(drawn.displayed);
      if (drawn.left == 0) return;
    }
    kernel_.draw(buffer_.view(), {x, y, 4, 0x1p-20, 1}, source_of(id));
  }

  /// Out of leaves: whether the kernel finds an unlit pixel in the rectangle
  /// where one is.
  void expect_unlit_found(const Rectangle& r) {
    const PixelRange columns = {std::max(r.left, wanted_.left),
                                std::min(r.right, wanted_.right)};
    const PixelRange lines = {std::max(r.top, wanted_.top),
                              std::min(r.bottom, wanted_.bottom)};
    if (columns.first >= columns.end || lines.first >= lines.end) return;
    bool expected = false;
    for (std::int32_t j = lines.first; j < lines.end; ++j) {
      for (std::int32_t i = columns.first; i < columns.end; ++i) {
        expected = expected || expected_.at(i - wanted_.left,
                                            j - wanted_.top) == kBackground;
      }
    }
    ASSERT_EQ(kernel_.any_unlit(buffer_.view(), columns, lines), expected);
    const Box box = {{float(r.left), float(r.top), 0},
                     {float(r.right), float(r.bottom), 0}};
    const BoxView view = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 0, 1}, 0.5f};
    const BoxVisibility sight =
        kernel_.box_visibility(buffer_.view(), view, box);
    if (sight != BoxVisibility::kUnknown) {
      ASSERT_EQ(sight == BoxVisibility::kVisible, expected);
    }
    (expected ? found_ : not_found_) += 1;
  }

  void expect_same() {
    const std::int64_t unlit =
        kernel_.fill_rest(buffer_.view(), source_of(kBackground));
    ASSERT_EQ(unlit, std::count(expected_.pixels.begin(),
                                expected_.pixels.end(), kBackground));
    if (!result_.items.pixels.empty()) {
      ASSERT_EQ(result_.items, expected_);
    }
    for (std::size_t k = 0; k < expected_.pixels.size(); ++k) {
      ASSERT_EQ(result_.colors.pixels[k], color_of(expected_.pixels[k])) << k;
    }
  }

  std::size_t small() const { return small_; }
  std::size_t contested() const { return contested_; }
  std::size_t found() const { return found_; }
  std::size_t not_found() const { return not_found_; }

 private:
  static Rendering blank(const ItemImage& like, bool items) {
    Rendering result;
    if (items) result.items = ItemImage(like.width_px, like.height_px, -7);
    result.colors = ColorImage(like.width_px, like.height_px, Rgb{7, 7, 7});
    return result;
  }

  void light(std::int32_t i, std::int32_t j, PolygonId id) {
    PolygonId& shown = expected_.at(i, j);
    const bool contested =
        in_leaf_ && shown != kBackground && before_.at(i, j) == kBackground;
    contested_ += contested ? 1 : 0;
    if (shown == kBackground || (contested && id < shown)) shown = id;
  }

  const TileKernel& kernel_;
  Rectangle wanted_;
  ItemImage expected_;
  ItemImage before_;
  Rendering result_;
  TileBuffer buffer_;
  LowestIsNearest exact_;
  bool in_leaf_ = false;
  std::size_t small_ = 0;
  std::size_t contested_ = 0;
  std::size_t found_ = 0;
  std::size_t not_found_ = 0;
};

TEST(KernelTiles, TheyShowWhatWasLitFirstOrInALeafIsNearest) {
  const TileKernel* const kernels[] = {
      &kPortableKernel, &best_kernel(SimdLevel::kAvx2), &best_kernel()};
  Random random;
  std::size_t small = 0;
  std::size_t contested = 0;
  std::size_t found = 0;
  std::size_t not_found = 0;
  for (int round = 0; round < 200; ++round) {
    SCOPED_TRACE(round);
    Both both(*kernels[round / 16 % 3],
              {random.below(40), random.below(12), kWidth - random.below(10),
               kHeight - random.below(20)},
              round % 16 < 8);
    for (std::int32_t k = 0; k < 150; ++k) {
      // Leaves of ten, every other time; ids mixed within them.
      const bool leaf = round % 4 < 2 && k / 10 % 2 == 1;
      if (leaf && k % 10 == 0) {
        both.enter_leaf(round % 8 < 4 ? 1 : kMostMasks);
      }
      both.draw(random.rectangle(round % 3 == 0),
                leaf ? k / 10 * 10 + k * 7 % 10 : k);
      if (leaf && k % 10 == 9) both.leave_leaf();
      // A leaf's tiles are closed when it ends.
      if (!leaf || k % 10 == 9) {
        both.expect_unlit_found(random.rectangle(k % 3 != 0));
      }
    }
    both.expect_same();
    if (HasFatalFailure()) return;
    small += both.small();
    contested += both.contested();
    found += both.found();
    not_found += both.not_found();
  }
  if (&best_kernel() != &kPortableKernel) {
    EXPECT_GT(small, 500u);
  }
  EXPECT_GT(contested, 1000u);
  EXPECT_GT(found, 1000u);
  EXPECT_GT(not_found, 1000u);
}

}  // namespace
}  // namespace halfspace::fast
