#include <gtest/gtest.h>

#include "halfspace/io/read_mesh.hpp"
#include "mesh/samples.hpp"

namespace halfspace::io {
namespace {

using samples::expect_refused;

TEST(ReadErrors, OfObjAreToTheLetter) {
  using enum ErrorCode;
  const std::string three = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  const std::string zero = "an index is 0, but indices count from 1";
  expect_refused(
      {{"v 0 0\n", kSyntax, "line 1: a vertex has 3 coordinates, not 2 values",
        1},
       {"v x 0 0\n", kSyntax, "line 1: 'x' is not a number", 1},
       {"v 0 0 0 0 0\n", kSyntax,
        "line 1: a vertex has 3 coordinates, not 5 values", 1},
       {"v 0 0 0 0 0 0 0 0\n", kSyntax,
        "line 1: a vertex has 3 coordinates, not 8 values", 1},
       {"v 0 0 0 2\n", kOutOfRange,
        "line 1: the vertex has the weight '2', but only 1 is read", 1},
       {"v 0 0 0 1 1 7\n", kOutOfRange,
        "line 1: a colour is 7.000000, which is not from 0 to 1", 1},
       {"v 0 0 0 7 1 1 -1\n", kOutOfRange,
        "line 1: a colour is -1.000000, which is not from 0 to 1", 1},
       {three + "f 1 2\n", kTooFewVertices, "line 4: a face has 2 corners", 4},
       {three + "f 1 2", kTruncated,
        "line 4: a face has 2 corners, and the file ends there", 4},
       {three + "f 1 2 0\n", kBadIndex, "line 4: " + zero, 4},
       {three + "f 1 2 3/0\n", kBadIndex, "line 4: " + zero, 4},
       {three + "f 1 2 3/1/0\n", kBadIndex, "line 4: " + zero, 4},
       {three + "f 1 2 3//0\n", kBadIndex, "line 4: " + zero, 4},
       {three + "f 1 2 3/1/x\n", kSyntax, "line 4: 'x' is not an integer", 4},
       {three + "f 1 2 3/1/1/1\n", kSyntax, "line 4: '1/1' is not an integer",
        4},
       {three + "f 1 2 3/x\n", kSyntax, "line 4: 'x' is not an integer", 4},
       {three + "f 1 2 /1\n", kSyntax, "line 4: '' is not an integer", 4},
       {three + "f 1 2 -4\n", kBadIndex,
        "line 4: there is no vertex '-4', only 3 so far", 4},
       {three + "f 1 2 2147483648\n", kBadIndex,
        "line 4: there is no vertex '2147483648', only 3 so far", 4},
       {three + "f 1 2 2147483647\n", kBadIndex,
        "line 4: there is no vertex 2147483647, only 3 in the file", 4},
       {three + "f 1 2 3\nf 1 4 5\nv 1 1 1\n\n", kBadIndex,
        "line 5: there is no vertex 5, only 4 in the file", 5},
       {"cstype bezier\n", kUnknownFormat,
        "line 1: free-form curves and surfaces ('cstype') are not read", 1},
       {"hello\n", kSyntax, "line 1: 'hello' is no OBJ statement", 1}},
      Format::kObj);
}

TEST(ReadErrors, ObjPassesOverReferencesAndWeights) {
  const Result<Mesh> mesh = read_mesh(
      "v 0 0 0\nv 1 0 0 1\nv 0 1 0 1 1 0 1\nv 5 5 5\n"
      "f 1/7 2/-7/9 3//8\nfo 1/ 2/ 3/5/\nf -4 2 -1\nf 1 2 4\n",
      Format::kObj);
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_EQ(mesh->corners,
            (std::vector<VertexId>{0, 1, 2, 0, 1, 2, 0, 1, 3, 0, 1, 3}));
  EXPECT_EQ(to_double(mesh->vertices[3][0]), 5);
  ASSERT_EQ(mesh->vertex_colors.size(), 4u);
  EXPECT_FALSE(mesh->vertex_colors[0]);
  EXPECT_FALSE(mesh->vertex_colors[1]);
  EXPECT_EQ(mesh->vertex_colors[2], (Rgb{255, 0, 255}));
  EXPECT_FALSE(mesh->vertex_colors[3]);
  EXPECT_TRUE(read_mesh("v 0 0 0\n", Format::kObj)->vertex_colors.empty());
}

}  // namespace
}  // namespace halfspace::io
