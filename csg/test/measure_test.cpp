#include "halfspace/csg/measure.hpp"

#include <gtest/gtest.h>

#include <string>

#include "halfspace/io/import.hpp"
#include "halfspace/io/read_mesh.hpp"

namespace halfspace::csg {
namespace {

Scene scene_of(const std::string& off) {
  const auto mesh = io::read_mesh(off, io::Format::kOff);
  return io::import_scene(*mesh, {})->scene;
}

/// Boxes as OFF: from and to, one after another.
Scene boxes(std::initializer_list<std::array<int, 6>> all,
            const std::string& more = "", int more_faces = 0) {
  std::string vertices, faces;
  int first = 0;
  for (const auto& b : all) {
    for (const int z : {b[2], b[5]}) {
      for (const int y : {b[1], b[4]}) {
        for (const int x : {b[0], b[3]}) {
          vertices += std::to_string(x) + " " + std::to_string(y) + " " +
                      std::to_string(z) + "\n";
        }
      }
    }
    for (const auto& face : {std::array{0, 2, 3, 1}, std::array{4, 5, 7, 6},
                             std::array{0, 1, 5, 4}, std::array{2, 6, 7, 3},
                             std::array{0, 4, 6, 2}, std::array{1, 3, 7, 5}}) {
      faces += "4";
      for (const int corner : face)
        faces += " " + std::to_string(first + corner);
      faces += "\n";
    }
    first += 8;
  }
  const auto count = static_cast<int>(all.size());
  return scene_of("OFF\n" + std::to_string(8 * count) + " " +
                  std::to_string(6 * count + more_faces) + " 0\n" + vertices +
                  faces + more);
}

TEST(Measure, TellsABoxFromTwo) {
  const Measures one = measures_of(boxes({{10, 20, 30, 12, 23, 34}}));
  EXPECT_DOUBLE_EQ(one.volume, 24);
  EXPECT_DOUBLE_EQ(one.area, 52);
  EXPECT_EQ(one.least, (std::array<double, 3>{10, 20, 30}));
  EXPECT_EQ(one.most, (std::array<double, 3>{12, 23, 34}));
  EXPECT_DOUBLE_EQ(one.centre[0], 11);
  EXPECT_DOUBLE_EQ(one.centre[1], 21.5);
  EXPECT_DOUBLE_EQ(one.centre[2], 32);
  ASSERT_EQ(one.components.size(), 1u);
  EXPECT_EQ(one.components[0].genus, 0);
  // Two that have a vertex in common are two.
  const Measures two =
      measures_of(boxes({{0, 0, 0, 1, 1, 1}, {1, 1, 1, 3, 3, 3}}));
  ASSERT_EQ(two.components.size(), 2u);
  EXPECT_EQ(two.components[1].polygons, 6u);
  EXPECT_DOUBLE_EQ(two.components[0].volume, 1);
  EXPECT_DOUBLE_EQ(two.components[1].volume, 8);
  EXPECT_EQ(two.components[0].genus, 0);
  EXPECT_EQ(two.components[1].genus, 0);
  // The edge that these have in common has four polygons.
  const Measures edge =
      measures_of(boxes({{0, 0, 0, 1, 1, 1}, {1, 1, 0, 2, 2, 1}}));
  EXPECT_FALSE(edge.components[0].genus);
}

TEST(Measure, CountsHandles) {
  // A frame: a square ring of 8 columns of vertices, 16 polygons.
  std::string text = "OFF\n16 16 0\n";
  for (const int z : {0, 1}) {
    for (const int r : {3, 1}) {
      for (const auto& [x, y] : {std::pair{-r, -r}, {r, -r}, {r, r}, {-r, r}}) {
        text += std::to_string(x) + " " + std::to_string(y) + " " +
                std::to_string(z) + "\n";
      }
    }
  }
  const auto quad = [&text](int a, int b, int c, int d) {
    for (const int corner : {4, a, b, c, d})
      text += std::to_string(corner) + " ";
    text += "\n";
  };
  for (int i = 0; i < 4; ++i) {
    const int j = (i + 1) % 4;
    quad(i, j, 8 + j, 8 + i);            // outer
    quad(4 + j, 4 + i, 12 + i, 12 + j);  // inner
    quad(8 + i, 8 + j, 12 + j, 12 + i);  // above
    quad(j, i, 4 + i, 4 + j);            // below
  }
  const Measures ring = measures_of(scene_of(text));
  ASSERT_EQ(ring.components.size(), 1u);
  EXPECT_EQ(ring.components[0].genus, 1);
  EXPECT_DOUBLE_EQ(ring.volume, 32);
}

TEST(Measure, HasNoGenusForWhatIsOpen) {
  const Measures open =
      measures_of(scene_of("OFF\n3 1 0\n0 0 0\n3 0 0\n0 4 0\n3 0 1 2\n"));
  ASSERT_EQ(open.components.size(), 1u);
  EXPECT_FALSE(open.components[0].genus);
  EXPECT_DOUBLE_EQ(open.area, 6);
  EXPECT_DOUBLE_EQ(open.centre[0], 1);
  EXPECT_TRUE(measures_of(Scene()).components.empty());
}

}  // namespace
}  // namespace halfspace::csg
