#include "rounding/mesh_index.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include "rounding/file_grid.hpp"
#include "rounding/mesh_contacts.hpp"
#include "rounding/snap.hpp"

namespace halfspace::fast {
namespace {

constexpr int kRing = 24, kRings = 12;

/// Two tori within one another, one inside out, so near and so rough that they
/// cross in places.
GridMesh crossing_tori(std::mt19937_64& random) {
  std::uniform_int_distribution<std::int64_t> noise(-40, 40);
  GridMesh mesh;
  for (int torus = 0; torus < 2; ++torus) {
    const auto first = static_cast<std::int32_t>(mesh.points.size());
    for (int i = 0; i < kRing; ++i) {
      for (int j = 0; j < kRings; ++j) {
        const double u = 2 * 3.14159265358979 * i / kRing;
        const double v = 2 * 3.14159265358979 * j / kRings;
        const double across = 3000 + (800 + 30 * torus) * std::cos(v);
        mesh.points.push_back(
            {std::llround(across * std::cos(u)) + noise(random),
             std::llround(across * std::sin(u)) + noise(random),
             std::llround((800 + 30 * torus) * std::sin(v)) + noise(random)});
      }
    }
    const auto at = [first](int i, int j) {
      return first + (i % kRing) * kRings + j % kRings;
    };
    for (int i = 0; i < kRing; ++i) {
      for (int j = 0; j < kRings; ++j) {
        std::int32_t p = at(i, j), q = at(i + 1, j), r = at(i + 1, j + 1),
                     s = at(i, j + 1);
        if (torus == 1) std::swap(q, s);
        mesh.triangles.push_back({{p, q, r}, 0});
        mesh.triangles.push_back({{p, r, s}, 0});
      }
    }
  }
  mesh.moved.resize(mesh.points.size());
  return mesh;
}

bool have_common(const Box& a, const Box& b) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (a.low[k] > b.high[k] || b.low[k] > a.high[k]) return false;
  }
  return true;
}

/// Whether the index finds all triangles whose boxes overlap that of each, and
/// none twice.
void expect_all_found(const MeshIndex& index, const GridMesh& mesh,
                      const char* when) {
  for (const GridTriangle& t : mesh.triangles) {
    const Box box = box_of(mesh, t);
    std::vector<std::int32_t> found, there;
    index.find(box, [&](std::int32_t other) { found.push_back(other); });
    for (std::size_t other = 0; other < mesh.triangles.size(); ++other) {
      if (have_common(box, box_of(mesh, mesh.triangles[other])))
        there.push_back(static_cast<std::int32_t>(other));
    }
    std::sort(found.begin(), found.end());
    ASSERT_TRUE(std::adjacent_find(found.begin(), found.end()) == found.end())
        << when;
    ASSERT_TRUE(
        std::includes(found.begin(), found.end(), there.begin(), there.end()))
        << when;
  }
}

TEST(FastMeshIndex, FollowsWhatWasCoarsenedAndGoesBackToWhatWasBetter) {
  const FileGrid grid = FileGrid::of_bits(26);
  std::size_t fewest = static_cast<std::size_t>(-1);
  for (unsigned seed = 0; seed < 4; ++seed) {
    std::mt19937_64 random(seed);
    GridMesh start = crossing_tori(random);
    GridMesh marked = start;
    marked.moved.assign(marked.points.size(), 1);
    const MeshContacts contacts = contacts_of(marked, 1);
    ASSERT_FALSE(contacts.pairs.empty());
    MeshIndex index;
    index.keep_up(start);
    expect_all_found(index, start, "to begin with");
    // As rounding does: several widths are tried on copies of one surface, and
    // a copy that was not the last is gone on with.
    std::vector<GridMesh> tried;
    for (const std::int64_t width : {256, 16, 1024}) {
      GridMesh mesh = start;
      coarsened(mesh, contacts, grid, width);
      clean(mesh);
      index.follow(mesh);
      expect_all_found(index, mesh, "coarsened");
      fewest = std::min(fewest, mesh.triangles.size());
      tried.push_back(std::move(mesh));
    }
    for (GridMesh& mesh : tried) {
      index.follow(mesh);
      expect_all_found(index, mesh, "gone back to");
    }
  }
  // Some fell together.
  EXPECT_LT(fewest, std::size_t{4 * kRing * kRings});
}

}  // namespace
}  // namespace halfspace::fast
