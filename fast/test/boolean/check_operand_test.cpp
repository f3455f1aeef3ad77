#include "halfspace/fast/check_operand.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <initializer_list>
#include <string>
#include <utility>

#include "boolean/shells.hpp"
#include "halfspace/bsp_tree.hpp"
#include "halfspace/fast/chain.hpp"
#include "halfspace/fast/resolve.hpp"

namespace halfspace::fast {
namespace {

/// What check_operand() says, or that nothing is wrong.
std::string said_of(const Solid& solid) {
  const Result<Done> fine = check_operand(solid);
  return fine ? "fine" : fine.error().message;
}

TEST(CheckOperand, IsRefusedWithThePlace) {
  Solid solid =
      merge_faces(to_solid(lattice::surface(block(0, 4, 4))), Merge::kPlane);
  EXPECT_EQ(said_of(solid), "fine");
  EXPECT_TRUE(open_faces(solid).empty());
  // The edges of two faces change places: all edges together are as before.
  Solid torn = solid;
  std::swap(torn.edges[torn.faces[1].first_edge],
            torn.edges[torn.faces[4].first_edge]);
  EXPECT_TRUE(bad_edges(torn).empty());
  EXPECT_EQ(open_faces(torn), (std::vector<std::int32_t>{1, 4}));
  EXPECT_NE(said_of(torn).find("make no loops"), std::string::npos);
  EXPECT_EQ(check_operand(torn).error().index, 1);
  // A face is missing.
  Solid open = solid;
  open.faces.pop_back();
  open.edges.resize(open.edges.size() - 4);
  EXPECT_NE(said_of(open).find("4 bad edges"), std::string::npos);
  // Blocks through each other, and a wall of no thickness.
  const Solid crossed = both_surfaces(block(0, 4, 4), block(2, 6, 6));
  EXPECT_NE(said_of(crossed).find(" cross near "), std::string::npos);
  Solid wall = solid;
  Solid back = complement(solid);
  wall.faces.resize(1);
  wall.faces.push_back(back.faces[0]);
  wall.faces[1].first_edge += static_cast<std::uint32_t>(wall.edges.size());
  wall.edges.insert(wall.edges.end(), back.edges.begin(), back.edges.end());
  wall.edges.resize(wall.faces[1].first_edge + 4u);
  wall.edges.erase(wall.edges.begin() + 4,
                   wall.edges.begin() + wall.faces[1].first_edge);
  wall.faces[1].first_edge = 4;
  EXPECT_TRUE(bad_edges(wall).empty());
  EXPECT_NE(said_of(wall), "fine");
}

TEST(CheckOperand, WindsRoundPlacesOnceOrNotAtAll) {
  const auto said = [](std::initializer_list<std::pair<Cubes, bool>> shells,
                       bool in_least_faces) {
    Solid solid = to_solid(lattice::surface(Cubes{}));
    for (const auto& [cubes, turned] : shells)
      add_surface(cubes, turned, in_least_faces, solid);
    solid.unbounded = false;
    return said_of(solid);
  };
  const Cubes large = block(0, 6, 6), small = block(1, 4, 4);
  const Cubes tiny = block(2, 3, 3), corner = block(4, 8, 8);
  for (const bool least : {true, false}) {
    // A cavity, and a solid in it; solids side by side.
    EXPECT_EQ(said({{large, false}, {small, true}, {tiny, false}}, least),
              "fine");
    EXPECT_EQ(said({{small, false}, {block(4, 6, 6), false}}, least), "fine");
    EXPECT_EQ(said({{large, true}}, least).find("the surface is inside out"),
              0u);
    const std::string twice =
        said({{large, false}, {small, false}, {tiny, false}}, least);
    EXPECT_EQ(twice.find("the surface winds round a place twice"), 0u);
    EXPECT_NE(twice.find("1 other part "), std::string::npos);
    // A solid less what it does not have.
    EXPECT_NE(said({{small, false}, {block(6, 8, 8), true}}, least)
                  .find("inside out"),
              std::string::npos);
    // Cut into unit squares, these have only edges in common.
    EXPECT_NE(said({{large, false}, {corner, false}}, least).find("crosses"),
              std::string::npos);
  }
}

}  // namespace
}  // namespace halfspace::fast
