#include <gtest/gtest.h>

#include <limits>

#include "halfspace/io/read_mesh.hpp"
#include "mesh/samples.hpp"

namespace halfspace::io {
namespace {

using samples::expect_error;
using samples::expect_refused;

TEST(ReadErrors, OfPlyHeadersAreToTheLetter) {
  using enum ErrorCode;
  const std::string format = "ply\nformat ascii 1.0\n";
  const std::string vertex =
      format +
      "element vertex 0\nproperty int x\nproperty int y\nproperty int z\n";
  const std::string no_list =
      "the faces have no list of integers 'vertex_indices'";
  expect_refused(
      {{"OFF\n", kUnknownFormat, "line 1: a PLY file starts with a line 'ply'",
        1},
       {"\n\n", kUnknownFormat, "line 3: a PLY file starts with a line 'ply'",
        3},
       {"ply x\n", kUnknownFormat,
        "line 1: a PLY file starts with a line 'ply'", 1},
       {"ply\nformat ascii\n", kSyntax,
        "line 2: there should be one 'format' of two words", 2},
       {format + "format ascii 1.0\n", kSyntax,
        "line 3: there should be one 'format' of two words", 3},
       {"ply\nformat ascii 2.0\n", kUnknownFormat,
        "line 2: PLY version '2.0' is not read", 2},
       {"ply\nformat utf 1.0\n", kUnknownFormat,
        "line 2: PLY format 'utf' is not read", 2},
       {"ply\nelement vertex\n", kSyntax,
        "line 2: an element has a name and a count", 2},
       {"ply\nelement vertex 3 3\n", kSyntax,
        "line 2: an element has a name and a count", 2},
       {"ply\nelement vertex x\n", kSyntax, "line 2: 'x' is not an integer", 2},
       {"ply\nelement vertex -1\n", kOutOfRange,
        "line 2: the count '-1' is negative", 2},
       {vertex + "element vertex 1\n", kSyntax,
        "line 7: there is a second element 'vertex'", 7},
       {"ply\nproperty int x\n", kSyntax,
        "line 2: a property stands before any element", 2},
       {vertex + "property\n", kSyntax,
        "line 7: a property has a type and a name", 7},
       {vertex + "property list\n", kSyntax,
        "line 7: a property has a type and a name", 7},
       {vertex + "property list uchar int\n", kSyntax,
        "line 7: a property has a type and a name", 7},
       {vertex + "property int a b c\n", kSyntax,
        "line 7: a property has a type and a name", 7},
       {vertex + "property foo a\n", kSyntax, "line 7: 'foo' is no type of PLY",
        7},
       {vertex + "property list foo int a\n", kSyntax,
        "line 7: 'foo' is no type of PLY", 7},
       {vertex + "property list int foo a\n", kSyntax,
        "line 7: 'foo' is no type of PLY", 7},
       {vertex + "property list double int a\n", kSyntax,
        "line 7: the length of a list is no integer", 7},
       {vertex + "property int x\n", kSyntax,
        "line 7: there is a second property 'x'", 7},
       {vertex + "wrong\n", kSyntax,
        "line 7: 'wrong' is no line of a PLY header", 7},
       {vertex + "end_header x\n", kSyntax,
        "line 7: 'end_header' is no line of a PLY header", 7},
       {vertex + "end_header", kTruncated,
        "line 7: 'end_header' is no line of a PLY header, and the file ends "
        "there",
        7},
       {vertex, kTruncated, "line 7: the header has no end", 7},
       {"ply\nend_header\n", kSyntax, "line 2: the header has no 'format'", 2},
       {format + "end_header\n", kSyntax,
        "line 3: the header has no element 'vertex'", 3},
       {vertex + "element edge 1\nend_header\n", kSyntax,
        "line 8: element 'edge' has no properties", 8},
       {vertex + "element tristrips 0\nend_header\n", kUnknownFormat,
        "line 8: triangle strips are not read", 8},
       {vertex + "element face 1\nproperty int a\nend_header\n", kSyntax,
        "line 9: " + no_list, 9},
       {vertex + "element face 1\nproperty int vertex_index\nend_header\n",
        kSyntax, "line 9: " + no_list, 9},
       {vertex + "element face 1\nproperty list int float vertex_index\n"
                 "end_header\n",
        kSyntax, "line 9: " + no_list, 9},
       {format + "element vertex 0\nproperty list int int vertex_indices\n"
                 "end_header\n",
        kSyntax,
        "line 5: the vertices have a list 'vertex_indices'; a line 'element "
        "face' is missing",
        5},
       {format +
            "element vertex 0\nproperty int x\nproperty int z\nend_header\n",
        kSyntax, "line 6: the vertices have no number 'y'", 6},
       {format + "element vertex 0\nproperty list int int x\nproperty int y\n"
                 "property int z\nend_header\n",
        kSyntax, "line 7: the vertices have no number 'x'", 7},
       {std::string("ply\n\0format", 11), kSyntax,
        "byte 4 is zero, so this is not text (perhaps UTF-16)", 4},
       {std::string("ply\nform\0at", 11), kTruncated,
        "line 2: 'form?at' is no line of a PLY header, and the file ends there",
        2}},
      Format::kPly);
}

TEST(ReadErrors, OfPlyTextAreToTheLetter) {
  using enum ErrorCode;
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
      "property float y\nproperty float z\nelement face 1\n"
      "property list char int vertex_indices\nend_header\n";
  const std::string points = "0 0 0\n1 0 0\n0 1 0\n";
  expect_refused(
      {{head + "0 0 0\n1 0 0\n0 1000\n", kTruncated,
        "vertex 2 of 3: line 13: the file ends", 13},
       {head + "0 0 0\n1 0 0\n0\n", kTruncated,
        "the header claims 3 of element 'vertex', but the file has room for 2 "
        "at most",
        2},
       {head + points, kTruncated,
        "the header claims 1 of element 'face', but the file has room for 0 at "
        "most",
        0},
       {head + points + "3 0 1\n", kTruncated,
        "face 0 of 1: line 14: the file ends", 14},
       {head + points + "3 0 1 3\n", kBadIndex,
        "face 0 of 1: there is no vertex 3, only 0 to 2", 0},
       {head + points + "3 0 1 -1\n", kBadIndex,
        "face 0 of 1: there is no vertex -1, only 0 to 2", 0},
       {head + points + "-1 0 1 2\n", kOutOfRange,
        "face 0 of 1: a list has the length -1", 0},
       {head + points + "3 0 1 x\n", kSyntax,
        "face 0 of 1: line 13: 'x' is not an integer", 13},
       {head + points + "3 0 1 2\n4\n", kSyntax,
        "line 14: the file goes on after its last element", 14}},
      Format::kPly);
  const std::string zero = head + points + "3 0 1 2";
  expect_error(read_mesh(zero + '\0', Format::kPly), kSyntax,
               "byte " + std::to_string(zero.size()) +
                   " is zero, so this is not text (perhaps UTF-16)",
               static_cast<std::int64_t>(zero.size()));
  // As short as it can be.
  EXPECT_TRUE(
      read_mesh("ply\nformat ascii 1.0\nelement vertex 3\n"
                "property int x\nproperty int y\nproperty int z\n"
                "end_header\n0 0 0\n1 0 0\n0 1 0",
                Format::kPly));
}

/// A header of bytes with these lines for three vertices and what follows.
std::string binary_head(const std::string& type, const std::string& more) {
  return "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty " +
         type + " x\nproperty " + type + " y\nproperty " + type + " z\n" +
         more + "end_header\n";
}

template <class T>
void expect_type(const std::string& name, T a, T b) {
  for (const bool is_big : {false, true}) {
    std::string bytes = binary_head(
        name,
        "element face 1\nproperty list uchar " +
            std::string(name[0] == 'f' || name[0] == 'd' ? "char" : name) +
            " vertex_index\n");
    if (is_big) bytes.replace(bytes.find("little"), 6, "big");
    const std::vector<T> values = {a, b, 0, 1, 2, 3, 4, 5, 6};
    for (const T value : values) samples::append(bytes, value, is_big);
    bytes += '\3';
    for (const int corner : {2, 1, 0}) {
      if constexpr (std::is_integral_v<T>) {
        samples::append(bytes, static_cast<T>(corner), is_big);
      } else {
        samples::append(bytes, static_cast<std::int8_t>(corner));
      }
    }
    const Result<Mesh> mesh = read_mesh(bytes, Format::kPly);
    ASSERT_TRUE(mesh) << name << mesh.error().message;
    ASSERT_EQ(mesh->vertices.size(), 3u);
    for (std::size_t i = 0; i < 9; ++i) {
      EXPECT_EQ(mesh->vertices[i / 3][i % 3],
                number_of(static_cast<double>(values[i])))
          << name << i;
    }
    EXPECT_EQ(mesh->corners, (std::vector<VertexId>{2, 1, 0}));
    EXPECT_EQ(mesh->first_corner, (std::vector<std::uint32_t>{0, 3}));
    // One byte less is an error.
    EXPECT_FALSE(read_mesh(bytes.substr(0, bytes.size() - 1), Format::kPly));
  }
}

template <class T>
void expect_limits(const std::string& name) {
  expect_type<T>(name, std::numeric_limits<T>::lowest(),
                 std::numeric_limits<T>::max());
}

TEST(ReadErrors, PlyReadsEveryType) {
  for (const bool is_old : {false, true}) {
    expect_limits<std::int8_t>(is_old ? "char" : "int8");
    expect_limits<std::uint8_t>(is_old ? "uchar" : "uint8");
    expect_limits<std::int16_t>(is_old ? "short" : "int16");
    expect_limits<std::uint16_t>(is_old ? "ushort" : "uint16");
    expect_limits<std::int32_t>(is_old ? "int" : "int32");
    expect_limits<std::uint32_t>(is_old ? "uint" : "uint32");
    expect_limits<float>(is_old ? "float" : "float32");
    expect_limits<double>(is_old ? "double" : "float64");
  }
}

TEST(ReadErrors, OfPlyBytesAreToTheLetter) {
  using enum ErrorCode;
  const std::string head = binary_head("float", "");
  std::string nine;
  for (int i = 0; i < 9; ++i) samples::append(nine, 1.f);
  std::string infinite = nine;
  samples::put(infinite, 16, -std::numeric_limits<float>::infinity());
  const std::string lists =
      binary_head("float",
                  "element face 1\nproperty list char short a\n"
                  "property list uchar uint vertex_index\n");
  const std::string three("\3aabbcc", 7);
  expect_refused(
      {{head + nine.substr(0, 35), kTruncated,
        "the header claims 3 of element 'vertex', but the file has room for 2 "
        "at most",
        2},
       {head + infinite, kNotFinite,
        "vertex 1 of 3: -inf is not finite (byte 20 after the header)", 1},
       {head + nine + "\nx", kSyntax,
        "the file goes on for 2 bytes after what it says it holds", 37},
       {lists + nine + "x", kTruncated,
        "the header claims 1 of element 'face', but the file has room for 0 at "
        "most",
        0},
       {lists + nine + three.substr(0, 6), kTruncated,
        "face 0 of 1: the file ends (byte 37 after the header)", 0},
       {lists + nine + three, kTruncated,
        "face 0 of 1: the file ends (byte 43 after the header)", 0},
       {lists + nine + "\xff" + "a", kOutOfRange,
        "face 0 of 1: a list has the length -1", 0},
       {lists + nine + three + std::string("\1\3\0\0\0", 5), kBadIndex,
        "face 0 of 1: there is no vertex 3, only 0 to 2", 0},
       {lists + nine + three + std::string("\1\2\0\0", 4), kTruncated,
        "face 0 of 1: the file ends (byte 44 after the header)", 0}},
      Format::kPly);
  const Result<Mesh> mesh =
      read_mesh(lists + nine + three + std::string("\1\2\0\0\0 \r\n\t\0", 10),
                Format::kPly);
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_EQ(mesh->corners, (std::vector<VertexId>{2}));
}

TEST(ReadErrors, PlyTakesColoursOfVerticesAndFacesOnly) {
  const auto mesh_of = [](const std::string& more, const std::string& body) {
    const Result<Mesh> mesh = read_mesh(
        "ply\nformat ascii 1.0\nelement vertex 1\nproperty int x\n"
        "property int y\nproperty int z\n" +
            more + "end_header\n" + body,
        Format::kPly);
    EXPECT_TRUE(mesh) << mesh.error().message;
    return mesh ? *mesh : Mesh{};
  };
  const std::string rgb =
      "property uchar r\nproperty uchar g\nproperty uchar b\n";
  EXPECT_EQ(mesh_of(rgb, "7 8 9 1 2 3\n").vertex_colors[0], (Rgb{1, 2, 3}));
  EXPECT_EQ(mesh_of("property ushort red\nproperty ushort green\n"
                    "property ushort blue\n",
                    "7 8 9 65535 32767 65407\n")
                .vertex_colors[0],
            (Rgb{255, 127, 255}));
  EXPECT_EQ(mesh_of(rgb, "7 8 9 0 127 254\n").vertex_colors[0],
            (Rgb{0, 127, 254}));
  // What is passed over need not be a number.
  EXPECT_EQ(
      mesh_of("element edge 1\nproperty int a\n" + rgb, "7 8 9\nx x x x\n")
          .vertices.size(),
      1u);
  EXPECT_EQ(mesh_of("element face 1\nproperty list uchar int vertex_index\n"
                    "property uchar r\nproperty uchar g\n",
                    "7 8 9\n0 x x\n")
                .first_corner,
            (std::vector<std::uint32_t>{0, 0}));
  // There are no faces, so they need no list.
  EXPECT_EQ(mesh_of("element face 0\n", "7 8 9\n").face_count(), 0u);
  EXPECT_EQ(mesh_of("property uchar diffuse_blue\nproperty ushort diffuse_red\n"
                    "property float diffuse_green\n",
                    "7 8 9 65535 65535 0\n")
                .vertex_colors.size(),
            1u);
  // A part is missing, or is a list.
  EXPECT_TRUE(mesh_of("property uchar red\nproperty uchar green\n", "7 8 9 1 2")
                  .vertex_colors.empty());
  EXPECT_TRUE(mesh_of("property uchar red\nproperty uchar green\n"
                      "property list uchar uchar blue\n",
                      "7 8 9 1 2 1 3")
                  .vertex_colors.empty());
  EXPECT_TRUE(mesh_of("element edge 1\n" + rgb, "7 8 9\n1 2 3\n")
                  .vertex_colors.empty());
}

}  // namespace
}  // namespace halfspace::io
