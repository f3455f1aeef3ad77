#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <utility>
#include <vector>

#include "halfspace/fast/boolean.hpp"
#include "halfspace/fast/chain.hpp"
#include "halfspace/fast/to_mesh.hpp"

namespace halfspace::fast {
namespace {

GridSolid box(const GridPoint& low, const GridPoint& high) {
  SceneData data;
  for (int k = 0; k < 8; ++k) {
    data.vertices.push_back({(k & 1) != 0 ? high.x : low.x,
                             (k & 2) != 0 ? high.y : low.y,
                             (k & 4) != 0 ? high.z : low.z});
  }
  data.corners = {0, 4, 6, 2, 1, 3, 7, 5, 0, 1, 5, 4,
                  2, 6, 7, 3, 0, 2, 3, 1, 4, 5, 7, 6};
  for (std::uint32_t f = 1; f <= 6; ++f) data.first_corner.push_back(4 * f);
  data.colors.resize(6);
  return *make_solid(*make_scene(std::move(data)));
}

/// Four plates across the first axis, 4 thick and 16 from each other, with
/// random holes. The faces with many edges come first.
Solid plates(std::mt19937& random) {
  Solid all = to_solid(box({0, 0, 0}, {1, 1, 1}));
  std::vector<Solid> solid, holes;
  for (std::int64_t x = 0; x < 64; x += 16) {
    solid.push_back(to_solid(box({x, 0, 0}, {x + 4, 64, 64}), all));
    for (std::int64_t i = 0; i < 64; ++i) {
      if (random() % 2 == 0) continue;
      const std::int64_t y = 8 * (i / 8) + 2, z = 8 * (i % 8) + 2;
      holes.push_back(to_solid(box({x - 1, y, z}, {x + 5, y + 5, z + 5}), all));
    }
  }
  Solid result = merge_faces(
      boolean(BooleanOp::kDifference, boolean_all(BooleanOp::kUnion, solid),
              boolean_all(BooleanOp::kUnion, holes)),
      Merge::kPlane);
  std::stable_partition(result.faces.begin(), result.faces.end(),
                        [](const Face& face) { return face.edge_count > 9; });
  return result;
}

TEST(FastChain, TellsWhatIsBehindFacesWithManyEdges) {
  // Tools of two boxes: one on a face of the first plate, so that the chain
  // takes some of the plates' faces apart, and one that touches nothing. What
  // that is in is told along a ray through the plates behind it.
  std::mt19937 random(11);
  const auto draw = [&](int count) {
    return static_cast<std::int64_t>(random()) % count;
  };
  std::size_t inside = 0;
  for (int round = 0; round < 30; ++round) {
    Solid plain = plates(random);
    Chain chain(plain);
    for (int step = 0; step < 2; ++step) {
      const auto small = [&](std::int64_t x) {
        const std::int64_t y = 8 * draw(8) + 3, z = 8 * draw(8) + 3;
        return to_solid(box({x, y, z}, {x + 2, y + 1, z + 1}), plain);
      };
      const Solid on_face = small(3);
      const Solid tool =
          boolean(BooleanOp::kUnion, on_face, small(16 * (1 + draw(3)) + 1));
      const std::size_t before = plain.faces.size();
      plain = boolean(BooleanOp::kDifference, plain, tool);
      chain.apply(BooleanOp::kDifference, tool);
      if (plain.faces.size() >= before + 6) ++inside;
      const ExportedMesh a = to_mesh(plain, {.triangles = true});
      const ExportedMesh b = to_mesh(chain.solid(), {.triangles = true});
      ASSERT_EQ(a.vertices, b.vertices) << round << " " << step;
      ASSERT_EQ(a.corners, b.corners) << round << " " << step;
    }
  }
  EXPECT_GT(inside, 10u);
}

/// Likewise, with notches in place of holes: each face is one loop.
Solid combs() {
  Solid all = to_solid(box({0, 0, 0}, {1, 1, 1}));
  std::vector<Solid> solid, notches;
  for (std::int64_t x = 0; x < 64; x += 16) {
    solid.push_back(to_solid(box({x, 0, 0}, {x + 4, 64, 64}), all));
    for (std::int64_t y = 2; y < 64; y += 8) {
      notches.push_back(
          to_solid(box({x - 1, y, 16 + x / 2}, {x + 5, y + 5, 65}), all));
    }
  }
  return merge_faces(
      boolean(BooleanOp::kDifference, boolean_all(BooleanOp::kUnion, solid),
              boolean_all(BooleanOp::kUnion, notches)),
      Merge::kPlane);
}

TEST(FastChain, WhatIsNearAndNotCutKeepsItsOwnEdges) {
  // Bars through plates, many of them through notches; in turn one, and two so
  // far apart that most faces are near and passed on whole, with many edges.
  std::mt19937 random(13);
  const auto draw = [&](int count) {
    return static_cast<std::int64_t>(random()) % count;
  };
  std::size_t passed = 0;
  for (int round = 0; round < 8; ++round) {
    Solid plain = combs();
    Chain chain(plain);
    const auto bar = [&](std::int64_t plate, std::int64_t i, std::int64_t k) {
      const std::int64_t x = 16 * plate, y = 8 * i + 3, z = 8 * k + 3;
      return to_solid(box({x - 1, y, z}, {x + 5, y + 2, z + 2}), plain);
    };
    for (int step = 0; step < 6; ++step) {
      const Solid tool =
          step % 2 == 0 ? boolean(BooleanOp::kUnion, bar(0, draw(2), draw(2)),
                                  bar(3, 6 + draw(2), 6 + draw(2)))
                        : bar(draw(4), draw(8), draw(8));
      const std::size_t before = plain.faces.size();
      plain = boolean(BooleanOp::kDifference, plain, tool);
      chain.apply(BooleanOp::kDifference, tool);
      if (plain.faces.size() == before) ++passed;
      const ExportedMesh a = to_mesh(plain, {.triangles = true});
      const ExportedMesh b = to_mesh(chain.solid(), {.triangles = true});
      ASSERT_EQ(a.vertices, b.vertices) << round << " " << step;
      ASSERT_EQ(a.corners, b.corners) << round << " " << step;
    }
  }
  EXPECT_GT(passed, 10u);
}

}  // namespace
}  // namespace halfspace::fast
