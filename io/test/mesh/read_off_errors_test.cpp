#include <gtest/gtest.h>

#include "halfspace/io/read_mesh.hpp"
#include "mesh/samples.hpp"

namespace halfspace::io {
namespace {

using samples::expect_refused;

TEST(ReadErrors, OfOffAreToTheLetter) {
  using enum ErrorCode;
  const std::string points = "0 0 0\n1 0 0\n0 1 0\n";
  const std::string one = "OFF\n3 1 0\n" + points;
  const std::string start = "line 6: ";
  expect_refused(
      {{"# no more\n", kTruncated, "line 2: the file has no 'OFF'", 2},
       {"4OFF\n", kUnknownFormat, "line 1: '4OFF' has other than 3 dimensions",
        1},
       {"STCN4nOFF\n", kUnknownFormat,
        "line 1: 'STCN4nOFF' has other than 3 dimensions", 1},
       {"nOFF\n", kUnknownFormat, "line 1: 'nOFF' has other than 3 dimensions",
        1},
       {"4\n", kUnknownFormat, "line 1: an OFF file starts with 'OFF', not '4'",
        1},
       {"NCOFF\n", kUnknownFormat,
        "line 1: an OFF file starts with 'OFF', not 'NCOFF'", 1},
       {"OFF BINARY\n", kUnknownFormat, "line 1: binary OFF is not read", 1},
       {"OFFBINARY\n", kUnknownFormat, "line 1: binary OFF is not read", 1},
       {"OFF3 BINARY 0\n", kSyntax, "line 1: 'BINARY' is not an integer", 1},
       {"OFF\n3\n", kTruncated, "line 3: the file ends in count 1 of 3", 3},
       {"OFF\n-1 6 0\n", kOutOfRange, "line 2: there cannot be '-1' vertices",
        2},
       {"OFF\n2147483648 6 0\n", kOutOfRange,
        "line 2: there cannot be '2147483648' vertices", 2},
       {"OFF\n2147483647 2147483648 0\n", kOutOfRange,
        "line 2: there cannot be '2147483648' faces", 2},
       {"OFF\n3 1 -1\n", kOutOfRange, "line 2: there cannot be '-1' edges", 2},
       {"OFF\n2147483647 2147483647 2147483648\n", kTruncated,
        "line 3: the file ends in vertex 0 of 2147483647", 3},
       {"OFF\n3 1 0\\\n0 0 0\n", kSyntax, "line 2: '0\\' is not an integer", 2},
       {"OFF\n3 1 0 0\n", kSyntax, "line 2: there are more than 3 counts", 2},
       {"OFF\n3 1 0\n0 0 0\n1 0\n", kTruncated,
        "line 5: the file ends in vertex 1 of 3", 5},
       {"OFF\n3 1 0\n0 0 0 7\n", kSyntax,
        "line 3: vertex 0 has 1 values more than its coordinates", 3},
       {"STOFF\n3 1 0\n0 0 0 7\n", kSyntax,
        "line 3: vertex 0 has 1 values more than its coordinates", 3},
       {"NOFF\n3 1 0\n0 0 0 0 1\n", kTruncated,
        "line 4: the file ends in vertex 0 of 3", 4},
       {"COFF\n3 1 0\n0 0 0 1 2\n", kSyntax,
        "line 3: a colour has 3 or 4 values, not 2", 3},
       {"COFF\n3 1 0\n0 0 0 1 2 3 4 5\n", kSyntax,
        "line 3: a colour has 3 or 4 values, not 5", 3},
       {"COFF\n3 1 0\n0 0 0 1 2 x\n", kSyntax, "line 3: 'x' is not a number",
        3},
       {one + "-1 0 1 2\n", kOutOfRange, start + "face 0 has '-1' corners", 6},
       {one + "x\n", kSyntax, start + "'x' is not an integer", 6},
       {one + "3 0 1 x\n", kSyntax, start + "'x' is not an integer", 6},
       {one + "3 0 1 3\n", kBadIndex,
        start + "face 0: there is no vertex '3', only 0 to 2", 6},
       {one + "3 0 1 -1\n", kBadIndex,
        start + "face 0: there is no vertex '-1', only 0 to 2", 6},
       {one + "3 0 1\n", kTruncated, "line 7: the file ends in face 0 of 1", 7},
       {one + "3 0 1 2 1 2 256\n", kOutOfRange,
        start + "a colour is 256.000000, which is not from 0 to 255", 6},
       {one + "3 0 1 2 1e0 1 2\n", kOutOfRange,
        start + "a colour is 2.000000, which is not from 0 to 1", 6},
       {one + "3 0 1 2\n\nmore\n", kSyntax,
        "line 8: the file goes on after its last face", 8}},
      Format::kOff);
}

TEST(ReadErrors, OffReadsWhatMayBeLeftOut) {
  const std::string points = "0 0 0\n1 0 0\n0 1 0\n";
  // Faces without corners; colours from the second on, then none.
  const Result<Mesh> mesh = read_mesh(
      "OFF\n3 4\n" + points + "0\n3 0 1 2 1 2 3\n3 2 1 0\n0\n", Format::kOff);
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_TRUE(mesh->decimal);
  EXPECT_EQ(mesh->first_corner, (std::vector<std::uint32_t>{0, 0, 3, 6, 6}));
  ASSERT_EQ(mesh->face_colors.size(), 4u);
  EXPECT_FALSE(mesh->face_colors[0]);
  EXPECT_EQ(mesh->face_colors[1], (Rgb{1, 2, 3}));
  EXPECT_FALSE(mesh->face_colors[2]);
  EXPECT_FALSE(mesh->face_colors[3]);
  EXPECT_TRUE(read_mesh("OFF\n3 1\n" + points + "3 0 1 2\n", Format::kOff)
                  ->face_colors.empty());
}

}  // namespace
}  // namespace halfspace::io
