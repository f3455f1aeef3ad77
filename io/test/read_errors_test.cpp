#include <gtest/gtest.h>
#include <zlib.h>

#include <limits>

#include "halfspace/io/read_mesh.hpp"
#include "samples.hpp"

namespace halfspace::io {
namespace {

using samples::expect_error;

/// A bad file, and all that is said of it.
struct Refused {
  std::string bytes;
  ErrorCode code;
  std::string message;
  std::int64_t index;
};

void expect_refused(const std::vector<Refused>& cases, Format format) {
  for (const Refused& bad : cases) {
    SCOPED_TRACE(bad.bytes);
    expect_error(read_mesh(bad.bytes, format), bad.code, bad.message,
                 bad.index);
  }
}

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

TEST(ReadErrors, OfGzippedFilesAreToTheLetter) {
  using enum ErrorCode;
  const samples::TemporaryFile file("a.off.gz");
  const auto pack = [&](const std::string& bytes) {
    gzFile packed = gzopen(file.path().c_str(), "wb");
    gzwrite(packed, bytes.data(), static_cast<unsigned>(bytes.size()));
    gzclose(packed);
    return *samples::raw_bytes(file.path());
  };
  // More than is unpacked at once, in two members.
  const std::string comment = "#" + std::string(3 << 20, 'x') + "\n";
  const std::string first = pack("OFF\n" + comment + "3 1\n0 0 0\n1 0");
  const std::string second = pack(" 0\n0 1 0\n" + comment + "3 0 1 2\n");
  samples::write(file.path(), first + second + "padding");
  const Result<std::string> text = read_file(file.path());
  ASSERT_TRUE(text) << text.error().message;
  EXPECT_EQ(*text, "OFF\n" + comment + "3 1\n0 0 0\n1 0 0\n0 1 0\n" + comment +
                       "3 0 1 2\n");
  const std::string name = file.path().string() + ": ";
  samples::write(file.path(), first + second.substr(0, 10));
  expect_error(read_file(file.path()), kTruncated,
               name + "the gzipped data ends too early",
               static_cast<std::int64_t>(comment.size()) + 17);
  std::string damaged = pack("OFF\n");
  damaged[10] = '\7';  // a block of a kind that is none
  samples::write(file.path(), damaged);
  expect_error(read_file(file.path()), kSyntax,
               name + "the gzipped data is damaged: invalid block type", 0);
  expect_error(read_mesh(file.path()), kSyntax,
               name + "the gzipped data is damaged: invalid block type", 0);
}

TEST(ReadErrors, OfFilesAreToTheLetter) {
  using enum ErrorCode;
  const samples::TemporaryFile file("A.OFF");
  const std::string name = file.path().string() + ": ";
  expect_error(read_mesh(file.path()), kUnreadable,
               name + "cannot be read: No such file or directory");
  samples::write(file.path(), "");
  expect_error(read_mesh(file.path()), kEmpty, name + "the file is empty", 0);
  std::filesystem::remove(file.path());
  std::filesystem::create_directory(file.path());
  expect_error(read_mesh(file.path()), kUnreadable,
               name + "cannot be read: Is a directory");
  expect_error(read_mesh("/a/b.glb"), kUnknownFormat,
               "/a/b.glb: a mesh file ends in .obj, .stl, .ply or .off, "
               "perhaps with .gz after it");
  expect_error(read_mesh("x", static_cast<Format>(99)), kUnknownFormat,
               "the format is unknown");
  // A file of as much as is read at once, and of more.
  for (const std::size_t size : {std::size_t{1} << 20, std::size_t{2500000}}) {
    const samples::TemporaryFile large("large");
    std::string bytes(size, '\0');
    for (std::size_t i = 0; i < size; ++i)
      bytes[i] = static_cast<char>(i % 251);
    samples::write(large.path(), bytes);
    const Result<std::string> back = read_file(large.path());
    ASSERT_TRUE(back);
    EXPECT_TRUE(*back == bytes);
  }
  for (const char* known : {"a.AZ", "a.off.Z"}) EXPECT_FALSE(format_of(known));
}

}  // namespace
}  // namespace halfspace::io
