#include "rounding/untangle.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include "rounding/file_grid.hpp"

namespace halfspace::fast {
namespace {

constexpr int kSide = 12;
constexpr double kCell = 400;

/// Two sheets that have their border in common, parallel to a slanted plane and
/// 0.8 steps apart, with corners at different places; not yet rounded.
class Pillow {
 public:
  explicit Pillow(unsigned seed) : random_(seed) {
    slope_ = {shift_(random_), shift_(random_)};
    for (const bool is_upper : {false, true}) {
      for (int i = 0; i <= kSide; ++i) {
        for (int j = 0; j <= kSide; ++j) add_corner(i, j, is_upper);
      }
    }
    for (int i = 0; i < kSide; ++i) {
      for (int j = 0; j < kSide; ++j) {
        const int a = lower_[at(i, j)], b = lower_[at(i + 1, j)];
        const int c = lower_[at(i + 1, j + 1)], d = lower_[at(i, j + 1)];
        add({a, c, b});
        add({a, d, c});
        const int e = upper_[at(i, j)], f = upper_[at(i + 1, j)];
        const int g = upper_[at(i + 1, j + 1)], h = upper_[at(i, j + 1)];
        add({e, f, h});
        add({f, g, h});
      }
    }
    mesh.moved.resize(mesh.points.size());
  }

  GridMesh mesh;
  std::vector<LoosePoint> loose;

 private:
  static std::size_t at(int i, int j) {
    return static_cast<std::size_t>(i * (kSide + 1) + j);
  }
  static bool is_border(int i) { return i == 0 || i == kSide; }

  void add_corner(int i, int j, bool is_upper) {
    std::vector<int>& of = is_upper ? upper_ : lower_;
    const bool border = is_border(i) || is_border(j);
    if (is_upper && border) {
      of.push_back(lower_[at(i, j)]);
      return;
    }
    of.push_back(static_cast<int>(mesh.points.size()));
    const double x = kCell * (i + (border ? 0 : shift_(random_)));
    const double y = kCell * (j + (border ? 0 : shift_(random_)));
    const double z = slope_[0] * x + slope_[1] * y + (is_upper ? 0.8 : 0);
    loose.push_back({of.back(), {x, y, z}});
    mesh.points.push_back({});
  }
  void add(const std::array<std::int32_t, 3>& corners) {
    mesh.triangles.push_back({corners, 0});
  }

  std::mt19937_64 random_;
  std::uniform_real_distribution<double> shift_{-0.3, 0.3};
  std::array<double, 2> slope_{};
  std::vector<int> lower_, upper_;
};

std::vector<std::uint8_t> corners_of(const MeshContacts& contacts,
                                     const GridMesh& mesh) {
  std::vector<std::uint8_t> corners(mesh.points.size());
  contacts.for_triangles([&](std::int32_t t) {
    for (const std::int32_t c :
         mesh.triangles[static_cast<std::size_t>(t)].corners)
      corners[static_cast<std::size_t>(c)] = 1;
  });
  return corners;
}

std::vector<std::pair<std::int32_t, std::int32_t>> all_pairs(GridMesh mesh) {
  mesh.moved.assign(mesh.points.size(), 1);
  return contacts_of(mesh, 1).pairs;
}

TEST(FastUntangle, SheetsThatRoundingMadeMeetArePutApart) {
  const FileGrid grid = FileGrid::of_bits(26);
  std::size_t before = 0, after = 0;
  for (unsigned seed = 0; seed < 20; ++seed) {
    Pillow pillow(seed);
    GridMesh& mesh = pillow.mesh;
    snap(mesh, pillow.loose, grid);
    clean(mesh);
    const std::vector<GridPoint> rounded = mesh.points;
    const MeshContacts contacts = contacts_of(mesh, 1);
    ASSERT_FALSE(contacts.pairs.empty());
    MeshIndex index;
    index.keep_up(mesh);
    const Untangled done = untangle(mesh, contacts, corners_of(contacts, mesh),
                                    pillow.loose, index, grid);
    index.follow(mesh, done.changed);
    const MeshContacts left =
        contacts_after(contacts, mesh, done.changed, 1, index);
    EXPECT_EQ(left.pairs, all_pairs(mesh));
    EXPECT_LE(left.pairs.size(), contacts.pairs.size());
    before += contacts.pairs.size();
    after += left.pairs.size();
    EXPECT_LE(done.farthest.distance, 2.5);
    for (std::size_t p = 0; p < rounded.size(); ++p) {
      EXPECT_EQ(done.changed[p] != 0, mesh.points[p] != rounded[p]);
      const auto id = static_cast<std::int32_t>(p);
      EXPECT_LE(done.changed[p], mesh.is_moved(id) ? 1 : 0);
    }
  }
  EXPECT_GT(before, 400u);
  EXPECT_LT(20 * after, before);
}

TEST(FastUntangle, OnlyWhatMayMoveAndMeetsOthersMoves) {
  const FileGrid grid = FileGrid::of_bits(26);
  Pillow pillow(1);
  GridMesh& mesh = pillow.mesh;
  snap(mesh, pillow.loose, grid);
  clean(mesh);
  const std::vector<GridPoint> rounded = mesh.points;
  const MeshContacts contacts = contacts_of(mesh, 1);
  const std::vector<std::uint8_t> meets = corners_of(contacts, mesh);
  MeshIndex index;
  index.keep_up(mesh);
  std::vector<std::uint8_t> may(mesh.points.size());
  EXPECT_EQ(untangle(mesh, contacts, may, pillow.loose, index, grid).changed,
            may);
  EXPECT_EQ(mesh.points, rounded);
  may.assign(may.size(), 1);
  const Untangled done =
      untangle(mesh, contacts, may, pillow.loose, index, grid);
  std::size_t moved = 0;
  for (std::size_t p = 0; p < may.size(); ++p) {
    EXPECT_LE(done.changed[p], meets[p]);
    moved += done.changed[p];
  }
  EXPECT_GT(moved, 0u);
}

}  // namespace
}  // namespace halfspace::fast
