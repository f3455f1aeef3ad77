#include "halfspace/csg/fault.hpp"

#include <gtest/gtest.h>

#include <string>

#include "halfspace/io/import.hpp"
#include "halfspace/io/read_mesh.hpp"

namespace halfspace::csg {
namespace {

/// What is wrong with a tetrahedron with these faces.
std::string wrong_with(int count, const std::string& faces) {
  const auto mesh =
      io::read_mesh("OFF\n4 " + std::to_string(count) +
                        " 0\n0 0 0\n2.5 0 0\n0 2 0\n0 0 2\n" + faces,
                    io::Format::kOff);
  const auto imported = io::import_scene(*mesh, {});
  const Error error = open_error(imported->scene, imported->faces);
  EXPECT_EQ(error.code, ErrorCode::kOpen);
  return error.message;
}

TEST(Fault, NamesAHole) {
  EXPECT_EQ(wrong_with(3, "3 0 2 1\n3 0 1 3\n3 0 3 2\n"),
            "the surface is open: 3 bad edges in 1 place, the first from 0, 0, "
            "2 to 0, 2, 0 at polygon 2, which has no neighbour there; fill the "
            "hole");
}

TEST(Fault, CountsThePolygonsOfTheFile) {
  // The first polygon has no area, so the scene does not have it.
  EXPECT_NE(wrong_with(4, "3 0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n")
                .find("at polygon 3,"),
            std::string::npos);
}

TEST(Fault, NamesPolygonsThatRunTheSameWay) {
  EXPECT_EQ(wrong_with(4, "3 0 2 1\n3 0 1 3\n3 1 3 2\n3 0 3 2\n"),
            "the surface is not consistently oriented: 3 bad edges in 1 place, "
            "the first from 0, 0, 2 to 0, 2, 0, along which polygons 2 and 3 "
            "run the same way; turn one of them round");
}

TEST(Fault, NamesAnEdgeOfManyPolygons) {
  EXPECT_NE(wrong_with(6,
                       "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n3 0 2 1\n"
                       "3 0 2 1\n")
                .find("3 bad edges in 1 place, the first from 0, 0, 0 to 0, 2, "
                      "0, which 4 polygons share, the first polygon 0"),
            std::string::npos);
}

}  // namespace
}  // namespace halfspace::csg
