#include <gtest/gtest.h>

#include <limits>

#include "halfspace/io/read_mesh.hpp"
#include "mesh/samples.hpp"

namespace halfspace::io {
namespace {

using samples::expect_refused;

TEST(ReadErrors, OfStlTextAreToTheLetter) {
  using enum ErrorCode;
  const std::string facet = "solid a\nfacet normal 0 0 1\n";
  const std::string loop = facet + "outer loop\nvertex 0 0 0\nvertex 1 0 0\n";
  const auto instead = [](const std::string& line, const std::string& wanted,
                          const std::string& found) {
    return "line " + line + ": there should be '" + wanted + "', not '" +
           found + "'";
  };
  const auto ends = [](const std::string& line, const std::string& wanted) {
    return "line " + line + ": the file ends where there should be '" + wanted +
           "'";
  };
  expect_refused(
      {{"solid", kTruncated, ends("2", "endsolid"), 2},
       {"solid\nwhat\n", kSyntax,
        "line 2: there should be 'facet' or 'endsolid', not 'what'", 2},
       {"solid\nfacet\n", kTruncated, ends("3", "normal"), 3},
       {"solid\nfacet abnormal\n", kSyntax, instead("2", "normal", "abnormal"),
        2},
       {"solid\nfacet normal 0 0\n", kTruncated, ends("3", "a normal"), 3},
       {"solid\nfacet normal 0 x 1\n", kSyntax, "line 2: 'x' is not a number",
        2},
       {facet, kTruncated, ends("3", "outer"), 3},
       {facet + "inner\n", kSyntax, instead("3", "outer", "inner"), 3},
       {facet + "outer space\n", kSyntax, instead("3", "loop", "space"), 3},
       {loop + "edge\n", kSyntax, instead("6", "vertex", "edge"), 6},
       {loop + "vertex 0\n", kTruncated, ends("7", "a coordinate"), 7},
       {loop + "vertex 0 1 x\n", kSyntax, "line 6: 'x' is not a number", 6},
       {loop + "vertex 0 1 0\nx\n", kSyntax, instead("7", "endloop", "x"), 7},
       {loop + "vertex 0 1 0\nendloop x\n", kSyntax,
        instead("7", "endfacet", "x"), 7},
       {loop + "vertex 0 1 0\nendloop endfacet\n", kTruncated,
        ends("8", "endsolid"), 8},
       {"solid\nendsolid a\nliquid\n", kSyntax, instead("3", "solid", "liquid"),
        3},
       {" \n", kTruncated, ends("2", "solid"), 2},
       {"\xff\xfe"
        "s",
        kUnknownFormat,
        "the text is in UTF-16 or UTF-32, which is not read; save it as UTF-8",
        0},
       {"\xfe\xff"
        "s",
        kUnknownFormat,
        "the text is in UTF-16 or UTF-32, which is not read; save it as UTF-8",
        0},
       {std::string("solid\0\n", 7), kTruncated,
        "a binary STL has at least 84 bytes, not 7", 7},
       {"solid" + std::string(90, ' ') + '\0', kSyntax,
        "byte 95 is zero, so this is not text (perhaps UTF-16)", 95}},
      Format::kStl);
}

TEST(ReadErrors, OfStlBytesAreToTheLetter) {
  using enum ErrorCode;
  const std::string one =
      samples::binary_stl({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}});
  std::string nan = one;
  samples::put(nan, 84 + 12 + 24 + 8, -std::numeric_limits<float>::infinity());
  std::string two = one;
  samples::put(two, 80, 2u);
  std::string none = one.substr(0, 84);
  samples::put(none, 80, 0u);
  expect_refused(
      {{"nothing", kTruncated, "a binary STL has at least 84 bytes, not 7", 7},
       {std::string(83, 'x'), kTruncated,
        "a binary STL has at least 84 bytes, not 83", 83},
       {one.substr(0, 84), kTruncated, "the file ends in triangle 0 of 1", 0},
       {one.substr(0, 133), kTruncated, "the file ends in triangle 0 of 1", 0},
       {two, kTruncated, "the file ends in triangle 1 of 2", 1},
       {one + "\nx", kSyntax,
        "the file goes on for 2 bytes after what it says it holds", 135},
       {nan, kNotFinite, "triangle 0, corner 2: a coordinate is -inf", 0}},
      Format::kStl);
  // Bytes that start with blanks, or with "solid" and end with a zero.
  for (const std::string& start : {std::string(" \t\r\n"), std::string("solid"),
                                   std::string("\xef\xbb\xbf solid")}) {
    std::string bytes = none;
    bytes.replace(0, start.size(), start);
    const Result<Mesh> mesh = read_mesh(bytes, Format::kStl);
    ASSERT_TRUE(mesh) << mesh.error().message;
    EXPECT_EQ(mesh->face_count(), 0u);
    EXPECT_FALSE(mesh->decimal);
    // The length is not what it says, but no text has a zero there.
    const Result<Mesh> more = read_mesh(bytes + "\n", Format::kStl);
    ASSERT_TRUE(more) << more.error().message;
    EXPECT_FALSE(more->decimal);
  }
}

}  // namespace
}  // namespace halfspace::io
