#include <array>
#include <cmath>
#include <utility>

#include "builder.hpp"
#include "halfspace/bsp_tree.hpp"
#include "shapes.hpp"

namespace halfspace::models {
namespace {

/// 2^8 grid steps to one of F2B's units.
constexpr std::int64_t kFine = 256;

/// The side of F2B's universe.
constexpr std::int64_t kUniverse = 1000 * kFine;

/// A stream of pseudorandom numbers (S3.4).
class Draws {
 public:
  explicit Draws(std::uint64_t seed) : key_(root_key(seed)) {}

  /// One of the integers from 0 to `range` - 1.
  std::int64_t below(std::int64_t range) {
    return static_cast<std::int64_t>(
        draw(key_, number_++, static_cast<std::uint64_t>(range)));
  }
  /// A point of the cube of this side about the origin.
  GridPoint within(std::int64_t side) {
    const std::int64_t x = below(side) - side / 2;
    const std::int64_t y = below(side) - side / 2;
    const std::int64_t z = below(side) - side / 2;
    return {x, y, z};
  }

 private:
  std::uint64_t key_;
  std::uint64_t number_ = 0;
};

bool on_one_line(const GridPoint& a, const GridPoint& b, const GridPoint& c) {
  const GridPoint u = b - a;
  const GridPoint v = c - a;
  return u.y * v.z == u.z * v.y && u.z * v.x == u.x * v.z &&
         u.x * v.y == u.y * v.x;
}

Result<Scene> scattered(const ModelOptions& options, int usual_count,
                        bool parallel) {
  if (options.size < 1 || options.size > 1000) {
    return Error{ErrorCode::kOutOfRange,
                 "the size of random triangles is from 1 to 1000"};
  }
  const int count = options.count == 0 ? usual_count : options.count;
  Draws draws(options.seed);
  Builder builder;
  for (int i = 0; i < count;) {
    const GridPoint centre = draws.within(kUniverse);
    std::array<GridPoint, 3> corners;
    for (GridPoint& corner : corners) {
      corner = centre + draws.within(options.size * kFine);
      // Layers of one grid step: as many planes as triangles.
      if (parallel) corner.z = std::int64_t{i} * kUniverse / count;
    }
    if (on_one_line(corners[0], corners[1], corners[2])) continue;
    builder.add(corners, palette(static_cast<std::size_t>(draws.below(8))));
    ++i;
  }
  builder.color_corners_by_height();
  return std::move(builder).scene(-8);
}

}  // namespace

Result<Scene> random_triangles(const ModelOptions& options) {
  return scattered(options, 500, false);
}

Result<Scene> parallel_triangles(const ModelOptions& options) {
  if (options.count > kUniverse) {
    return Error{ErrorCode::kOutOfRange,
                 "there are at most 256000 parallel triangles"};
  }
  return scattered(options, 1000, true);
}

Result<Scene> theorem1(const ModelOptions& options) {
  const std::int64_t n = options.count == 0 ? 20 : options.count;
  if (n % 2 != 0) {
    return Error{ErrorCode::kOutOfRange,
                 "Theorem 1 of HEUR needs an even number of polygons"};
  }
  Builder builder;
  for (std::int64_t i = 0; i < n / 2; ++i) {
    const std::int64_t z = i + 1;
    builder.add({{0, 0, z}, {1, 0, z}, {1, n / 2 + 2, z}, {0, n / 2 + 2, z}},
                palette(0));
  }
  for (std::int64_t j = 0; j < n / 2; ++j) {
    const std::int64_t y = j + 1;
    builder.add({{2, y, 0}, {3, y, 0}, {3, y, n / 2 + 1}, {2, y, n / 2 + 1}},
                palette(1));
  }
  return std::move(builder).scene();
}

Result<Scene> ribbons(const ModelOptions& options) {
  constexpr int kParts = 23;
  constexpr std::int64_t kLength = 400;
  constexpr std::int64_t kWidth = 500;
  const int count = options.count == 0 ? 16 : options.count;
  const auto height = [](int ribbon, int part) {
    const double x = 0.4 * part;
    return std::llround(1500 * std::sin(x + 0.35 * ribbon) *
                        std::exp(-0.05 * x));
  };
  Builder builder;
  for (int i = 0; i < count; ++i) {
    const std::int64_t y = 2 * kWidth * i;
    for (int j = 0; j < kParts; ++j) {
      const GridPoint a = {kLength * j, y, height(i, j)};
      const GridPoint b = {kLength * (j + 1), y, height(i, j + 1)};
      const GridPoint across = {0, kWidth, 0};
      builder.add({a, b, b + across, a + across},
                  palette(static_cast<std::size_t>(i)));
    }
  }
  return std::move(builder).scene();
}

}  // namespace halfspace::models
