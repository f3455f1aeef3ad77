#include "halfspace/fast/area_image.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "exact/big_rational.hpp"
#include "halfspace/fast/display_tree.hpp"

/// Floors to the horizon, whose images have closed forms.
namespace halfspace::fast {
namespace {

constexpr std::int32_t kImageWidth = 64;
constexpr std::int32_t kImageHeight = 256;
constexpr std::uint8_t kLight = 200;
constexpr std::uint8_t kSky = 90;

// A floor's point at depth Y is seen kReach / Y pixels below the middle row.
constexpr std::int64_t kReach = 1024;
constexpr std::int64_t kSide = 8;       // of a square, in grid steps
constexpr std::int64_t kFarthest = 65;  // squares from the eye

/// The eye is 16 steps above the floor z = 0, and looks along y.
Camera over_the_floor(const Scene& scene) {
  constexpr Int128 kStep = 16;
  CameraData data;
  data.eye = {0, 0, 256 * 16};
  data.s0 = {-kStep * kImageWidth / 2, 256 * 4,
             256 * 16 + kStep * kImageHeight / 2};
  data.sx = {kStep, 0, 0};
  data.sy = {0, 0, -kStep};
  data.width_px = kImageWidth;
  data.height_px = kImageHeight;
  return *make_camera(data, scene.grid_bits());
}

/// The floor in columns of squares, dark ones and light ones in turn.
Scene floor_of(
    const std::vector<std::pair<std::int64_t, std::int64_t>>& columns) {
  SceneData data;
  for (std::int64_t row = 1; row < kFarthest; ++row) {
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const auto [left, right] = columns[c];
      const auto first = static_cast<VertexId>(data.vertices.size());
      const std::int64_t near = kSide * row;
      const std::int64_t far = near + kSide;
      data.vertices.insert(data.vertices.end(), {GridPoint{left, near, 0},
                                                 {right, near, 0},
                                                 {right, far, 0},
                                                 {left, far, 0}});
      for (VertexId k = 0; k < 4; ++k) data.corners.push_back(first + k);
      data.first_corner.push_back(
          static_cast<std::uint32_t>(data.corners.size()));
      const bool is_light = (row + static_cast<std::int64_t>(c)) % 2 == 0;
      const std::uint8_t level = is_light ? kLight : 0;
      data.colors.push_back({level, level, level});
    }
  }
  Result<Scene> scene = make_scene(std::move(data));
  EXPECT_TRUE(scene.has_value());
  return std::move(*scene);
}

ColorImage image_of(const Scene& scene) {
  DisplayTreeOptions display;
  display.threads = 1;
  BspTree tree = build_display_tree(scene, display);
  divide_leaves(tree, scene);
  ImageOptions options;
  options.background = {kSky, kSky, kSky};
  return render_area(scene, tree, over_the_floor(scene), options, 1).colors;
}

/// Stripes across: their borders are rows of height kReach / Y.
TEST(AreaImage, StripesToTheHorizonHaveTheirClosedForm) {
  const ColorImage image = image_of(floor_of({{-65536, 65536}}));
  const auto border = [](std::int64_t row) {
    return BigRational(kReach, kSide * row);
  };
  std::size_t mixed = 0;
  for (std::int32_t j = 0; j < kImageHeight; ++j) {
    const BigRational top = j - kImageHeight / 2;
    const BigRational bottom = top + 1;
    const auto overlap = [&](const BigRational& low, const BigRational& high) {
      const BigRational from = std::max(low, top);
      const BigRational to = std::min(high, bottom);
      return to > from ? BigRational(to - from) : BigRational(0);
    };
    BigRational sum = kSky * overlap(-kImageHeight, border(kFarthest));
    for (std::int64_t row = 1; row < kFarthest; ++row) {
      if (row % 2 == 0) sum += kLight * overlap(border(row + 1), border(row));
    }
    sum += kSky * overlap(border(1), kImageHeight);
    const std::uint8_t level = rounded_channel(sum);
    mixed += level != 0 && level != kLight && level != kSky ? 1 : 0;
    for (std::int32_t i = 0; i < kImageWidth; ++i) {
      ASSERT_EQ(image.at(i, j), (Rgb{level, level, level})) << i << " " << j;
    }
  }
  EXPECT_GT(mixed, 10u);
}

/// A chequered floor, to the left of the middle with the colours exchanged of
/// what is to the right: the two pixels of a pair add up to one light one.
TEST(AreaImage, AChequeredFloorIsItsOwnComplement) {
  constexpr std::int64_t kColumns = 160;
  std::vector<std::pair<std::int64_t, std::int64_t>> columns;
  for (std::int64_t c = -kColumns; c < kColumns; ++c)
    columns.emplace_back(kSide * c, kSide * (c + 1));
  const ColorImage image = image_of(floor_of(columns));
  std::size_t mixed = 0;
  const auto horizon = static_cast<std::int32_t>(
      kImageHeight / 2 + kReach / (kSide * kFarthest) + 1);
  for (std::int32_t j = horizon; j < kImageHeight; ++j) {
    for (std::int32_t i = 0; i < kImageWidth / 2; ++i) {
      const int left = image.at(i, j).r;
      const int right = image.at(kImageWidth - 1 - i, j).r;
      // Both are rounded half up.
      ASSERT_TRUE(left + right == kLight || left + right == kLight + 1)
          << i << " " << j << ": " << left << " + " << right;
      mixed += left != 0 && left != kLight ? 1 : 0;
    }
  }
  EXPECT_GT(mixed, 300u);
}

}  // namespace
}  // namespace halfspace::fast
