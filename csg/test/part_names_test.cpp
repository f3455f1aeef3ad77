#include "halfspace/csg/part_names.hpp"

#include <gtest/gtest.h>

#include <random>

#include "numbers.hpp"

namespace halfspace::csg {
namespace {

using io::Number;

/// A map with entries of a few binary or decimal digits, some of them negative.
Matrix some_matrix(std::mt19937_64& random) {
  Matrix matrix;
  for (auto& row : matrix.rows) {
    for (Number& entry : row) {
      const auto value = static_cast<std::int64_t>(random() % 2001) - 1000;
      const auto places = static_cast<std::int32_t>(random() % 6);
      entry = value == 0 ? Number{}
                         : io::normalised(value, -places,
                                          random() % 2 == 0 ? -places : places);
    }
  }
  return matrix;
}

TEST(PartNames, SayNothingOfWhatStandsWhereItWas) {
  EXPECT_EQ(placed_name("a.off", identity_matrix()), "a.off");
  EXPECT_EQ(placed_name("", identity_matrix()), "");
}

TEST(PartNames, AreThoseOfTheProduct) {
  std::mt19937_64 random(3);
  std::size_t mirrored = 0;
  for (int i = 0; i < 400; ++i) {
    const Matrix first = some_matrix(random), second = some_matrix(random);
    const auto both = product(second, first);
    ASSERT_TRUE(both);
    for (const std::string name : {"a.off", "a @ 1 2.off", ""}) {
      EXPECT_EQ(placed_name(placed_name(name, first), second),
                placed_name(name, *both));
    }
    if (determinant_sign(first) == 0 || determinant_sign(second) == 0) continue;
    mirrored += determinant_sign(first) < 0 ? 1u : 0u;
    const Matrix points = some_matrix(random);
    const HalfSpace half = {image_of(points, {}), image_of(first, {}),
                            image_of(second, {})};
    EXPECT_EQ(placed_name(placed_name(half_name(half), first), second),
              placed_name(half_name(half), *both));
  }
  EXPECT_GT(mirrored, 100u);
}

TEST(PartNames, ComeBackWithTheInverse) {
  const auto number = [](const char* text) { return *io::parse_number(text); };
  const Matrix there = translation({number("1"), number("-2.5"), number("0")});
  const Matrix back = translation({number("-1"), number("2.5"), number("0")});
  EXPECT_EQ(placed_name("a.off", there),
            "a.off @ 1 0 0 1 0 1 0 -25e-1 0 0 1 0");
  EXPECT_EQ(placed_name(placed_name("a.off", there), back), "a.off");
  const HalfSpace half = {Numbers3{number("2"), {}, {}},
                          Numbers3{number("2"), number("1"), {}},
                          Numbers3{number("2"), {}, number("1")}};
  EXPECT_EQ(half_name(half), "half @ 2 0 0 2 1 0 2 0 1");
  EXPECT_EQ(placed_name(half_name(half),
                        scaling({number("-1"), number("1"), number("1")})),
            "half @ -2 0 1 -2 1 0 -2 0 0");
}

TEST(PartNames, OfPrimitivesGoByTheirMeshes) {
  io::Mesh mesh;
  mesh.vertices = {{Number{}, Number{1, 0, 0}, Number{3, -1, 2}}};
  mesh.corners = {0, 0, 0};
  const std::string name = primitive_name("box", mesh);
  EXPECT_EQ(name.size(), std::string("box #01234567").size());
  EXPECT_EQ(primitive_name("box", mesh), name);
  mesh.vertices[0][2] = {3, -1, 1};
  EXPECT_NE(primitive_name("box", mesh), name);
}

}  // namespace
}  // namespace halfspace::csg
