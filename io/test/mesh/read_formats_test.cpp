#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "halfspace/io/read_mesh.hpp"
#include "mesh/samples.hpp"

namespace halfspace::io {
namespace {

using CornerLists = std::vector<std::vector<VertexId>>;

CornerLists faces_of(const Mesh& mesh) {
  CornerLists faces;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    faces.emplace_back(mesh.corners.begin() + mesh.first_corner[f],
                       mesh.corners.begin() + mesh.first_corner[f + 1]);
  }
  return faces;
}

Mesh mesh_of(const std::string& bytes, Format format) {
  const Result<Mesh> mesh = read_mesh(bytes, format);
  EXPECT_TRUE(mesh) << mesh.error().message << "\n" << bytes;
  return mesh ? *mesh : Mesh{};
}

std::array<double, 3> point(const Mesh& mesh, std::size_t vertex) {
  return {to_double(mesh.vertices[vertex][0]),
          to_double(mesh.vertices[vertex][1]),
          to_double(mesh.vertices[vertex][2])};
}

/// A bad file: what is wrong with it, and what the message must name.
struct Bad {
  std::string bytes;
  ErrorCode code;
  std::string named;
};

void expect_errors(const std::vector<Bad>& cases, Format format) {
  for (const auto& [bytes, code, named] : cases) {
    const Result<Mesh> mesh = read_mesh(bytes, format);
    ASSERT_FALSE(mesh) << bytes;
    EXPECT_EQ(mesh.error().code, code) << bytes << mesh.error().message;
    EXPECT_NE(mesh.error().message.find(named), std::string::npos)
        << mesh.error().message << " does not name " << named;
  }
}

TEST(ReadObj, ReadsEveryFormOfFace) {
  const Mesh mesh = mesh_of(
      "# comment\r\nmtllib a.mtl\no thing\n"
      "v 0 0 0\nv 1 0 0 # here too\nv  1\t1 0 1\nv 0 1 0\n"
      "vt 0 0\nvn 0 0 1\ng group\ns off\nusemtl red\n"
      "f 1 2 3 4\r\n"
      "f 1/1 2/1 3/1\n"
      "f 1//1 2//1 3//1\n"
      "f 1/1/1 2/1/1 \\\n 3/1/1 \\\r\n4/1/1\n"
      "f -4 -3 -2\nl 1 2\np 1\n",
      Format::kObj);
  EXPECT_EQ(mesh.vertices.size(), 4u);
  EXPECT_TRUE(mesh.decimal);
  EXPECT_EQ(faces_of(mesh),
            (CornerLists{
                {0, 1, 2, 3}, {0, 1, 2}, {0, 1, 2}, {0, 1, 2, 3}, {0, 1, 2}}));
}

TEST(ReadObj, CountsNegativeIndicesFromWhereTheyStand) {
  const Mesh mesh =
      mesh_of("v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 0 0 1\nf -4 -2 -1\n",
              Format::kObj);
  EXPECT_EQ(faces_of(mesh), (CornerLists{{0, 1, 2}, {0, 2, 3}}));
}

TEST(ReadObj, LetsFacesStandBeforeTheirVertices) {
  EXPECT_EQ(
      faces_of(mesh_of("f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n", Format::kObj)),
      (CornerLists{{0, 1, 2}}));
}

TEST(ReadObj, ReadsVertexColours) {
  const Mesh mesh = mesh_of(
      "v 0 0 0\nv 1 0 0 1 0.5 0\nv 0 1 0 1.0 0 0 1\nf 1 2 3\n", Format::kObj);
  ASSERT_EQ(mesh.vertex_colors.size(), 3u);
  EXPECT_FALSE(mesh.vertex_colors[0]);
  EXPECT_EQ(mesh.vertex_colors[1], (Rgb{255, 128, 0}));
  EXPECT_EQ(mesh.vertex_colors[2], (Rgb{0, 0, 255}));
}

TEST(ReadObj, NamesLineAndValueOfAnError) {
  const std::string three = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  expect_errors(
      {{three + "f 1 2 4\n", ErrorCode::kBadIndex,
        "line 4: there is no vertex "
        "4"},
       {three + "f 1 2 0\n", ErrorCode::kBadIndex, "line 4"},
       {three + "f 1 2 -4\n", ErrorCode::kBadIndex, "'-4'"},
       {three + "f 1 2 3/0\n", ErrorCode::kBadIndex, "line 4"},
       {three + "f 1 2\n", ErrorCode::kTooFewVertices, "2 corners"},
       {three + "f 1 2 x\n", ErrorCode::kSyntax, "'x'"},
       {three + "f 1 2 3.0\n", ErrorCode::kSyntax, "'3.0'"},
       {three + "f 1 2 99999999999999999999\n", ErrorCode::kOutOfRange,
        "'99999999999999999999'"},
       {three + "f 1 2", ErrorCode::kTruncated, "file ends"},
       {"v 0 0\n", ErrorCode::kSyntax, "line 1"},
       {"v 0 0 0 2\n", ErrorCode::kOutOfRange, "weight"},
       {"v 0 0 0 1 1\n", ErrorCode::kSyntax, "5 values"},
       {"v 0 0 0 1 1 7\n", ErrorCode::kOutOfRange, "7"},
       {"\n\nv 0 nan 0\n", ErrorCode::kNotFinite, "line 3: 'nan'"},
       {"v 0 1e5000 0\n", ErrorCode::kOutOfRange, "'1e5000'"},
       {"v 0 3.1+e2 0\n", ErrorCode::kSyntax, "'3.1+e2'"},
       {"hello\n", ErrorCode::kSyntax, "'hello'"},
       {"cstype bezier\n", ErrorCode::kUnknownFormat, "free-form"},
       {std::string("v 0 0 0\0\n", 9), ErrorCode::kSyntax, "byte 7"},
       {std::string("\xfe\xff\0v", 4), ErrorCode::kUnknownFormat, "UTF-16"},
       {std::string("\xff\xfev\0", 4), ErrorCode::kUnknownFormat, "UTF-16"},
       {"", ErrorCode::kEmpty, "empty"}},
      Format::kObj);
}

TEST(ReadStl, ReadsTextOfSeveralSolids) {
  const std::string one =
      "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
      "vertex 0 0.1 0\nendloop\nendfacet\n";
  const Mesh mesh = mesh_of("solid a name\n" + one + "endsolid a name\n" +
                                "SOLID\n" + one + one + "EndSolid x y\n",
                            Format::kStl);
  EXPECT_EQ(mesh.vertices.size(), 3u);
  EXPECT_EQ(faces_of(mesh), (CornerLists{{0, 1, 2}, {0, 1, 2}, {0, 1, 2}}));
  EXPECT_EQ(mesh.vertices[2][1], (Number{1, -1, -1}));
  EXPECT_TRUE(mesh.decimal);
}

TEST(ReadStl, ReadsBinaryEvenIfItStartsLikeText) {
  for (const char* start : {"binary", "solid of bytes"}) {
    std::string bytes =
        samples::binary_stl({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                             {{1, 0, 0}, {0, 1, 0}, {-0.f, 0, 1}}});
    bytes.replace(0, std::strlen(start), start);
    const Mesh mesh = mesh_of(bytes, Format::kStl);
    EXPECT_EQ(mesh.vertices.size(), 4u);
    EXPECT_EQ(faces_of(mesh), (CornerLists{{0, 1, 2}, {1, 2, 3}}));
    EXPECT_FALSE(mesh.decimal);
  }
}

TEST(ReadStl, WeldsEqualPointsOnly) {
  const float next = std::nextafter(1.f, 2.f);
  const Mesh mesh =
      mesh_of(samples::binary_stl({{{0.f, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                                   {{-0.f, 0, 0}, {0, 1, 0}, {next, 0, 0}}}),
              Format::kStl);
  EXPECT_EQ(faces_of(mesh), (CornerLists{{0, 1, 2}, {0, 2, 3}}));
}

TEST(ReadStl, PassesOverNormalsThatAreNoNumbers) {
  EXPECT_EQ(mesh_of("solid\nfacet normal nan inf -nan\nouter loop\n"
                    "vertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
                    "endfacet\nendsolid\n",
                    Format::kStl)
                .face_count(),
            1u);
}

TEST(ReadStl, NamesPlaceAndValueOfAnError) {
  const std::string good =
      samples::binary_stl({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}});
  std::string infinite = good;
  samples::put(infinite, 84 + 12 + 16, std::numeric_limits<float>::infinity());
  std::string absurd = good;
  samples::put(absurd, 80, std::uint32_t{4294967295u});
  const std::string facet = "solid\nfacet normal 0 0 1\nouter loop\n";
  expect_errors(
      {{infinite, ErrorCode::kNotFinite, "triangle 0, corner 1"},
       {absurd, ErrorCode::kTruncated, "triangle 1 of 4294967295"},
       {good + "x", ErrorCode::kSyntax, "goes on"},
       {facet + "vertex 0 0 x\n", ErrorCode::kSyntax, "line 4: 'x'"},
       {facet + "vertex 0 0 inf\n", ErrorCode::kNotFinite, "line 4"},
       {facet + "vertex 0 0 0\nendloop\n", ErrorCode::kSyntax, "'vertex'"},
       {"solid\nfacet abnormal\n", ErrorCode::kSyntax, "'abnormal'"},
       {"solid\nendsolid\nfoo\n", ErrorCode::kSyntax, "'foo'"},
       {"solid\nfacet normal 0 0 x\n", ErrorCode::kSyntax, "'x'"},
       {"nothing", ErrorCode::kTruncated, "84 bytes"}},
      Format::kStl);
}

TEST(ReadPly, ReadsTextWithOtherElementsAndProperties) {
  const Mesh mesh = mesh_of(
      "ply\nformat ascii 1.0\ncomment here\nobj_info there\n"
      "element material 1\nproperty list uchar float values\n"
      "element vertex 4\nproperty float x\nproperty list uchar int extra\n"
      "property float y\nproperty float z\nproperty uchar red\n"
      "property uchar green\nproperty uchar blue\nproperty uchar alpha\n"
      "element face 2\nproperty float quality\n"
      "property list uchar int vertex_index\nelement edge 1\n"
      "property int vertex1\nend_header\n"
      "2 0.5 nan\n0 0 0 0 1 2 3 4\n1 3 7 8 9 0 0 5 6 7 8\n0.1 0 1 0 9 9 9 9\n"
      "0 0 0 1 255 0 0 0\n1.5 3 0 1 2\n2.5 4 0 1 2 3\n5\n",
      Format::kPly);
  EXPECT_EQ(mesh.vertices.size(), 4u);
  EXPECT_EQ(mesh.vertices[2][0], (Number{1, -1, -1}));
  EXPECT_EQ(faces_of(mesh), (CornerLists{{0, 1, 2}, {0, 1, 2, 3}}));
  EXPECT_EQ(mesh.vertex_colors[1], (Rgb{5, 6, 7}));
  EXPECT_TRUE(mesh.decimal);
}

TEST(ReadPly, ReadsBinaryOfEitherOrderTheSame) {
  for (const bool big : {false, true}) {
    const Mesh mesh = mesh_of(samples::binary_ply(big), Format::kPly);
    EXPECT_EQ(mesh.vertices.size(), 4u);
    EXPECT_EQ(point(mesh, 1), (std::array<double, 3>{1.5, 0, -2.25}));
    EXPECT_EQ(mesh.vertices[2][0], number_of(0.1));
    EXPECT_EQ(faces_of(mesh), (CornerLists{{0, 1, 2}, {3, 2, 1, 0}}));
    EXPECT_EQ(mesh.face_colors[1], (Rgb{40, 50, 60}));
    EXPECT_FALSE(mesh.decimal);
  }
}

TEST(ReadPly, ReadsColoursOfFloatsAndOfWords) {
  const std::string text =
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\n"
      "property float y\nproperty float z\nproperty float red\n"
      "property float green\nproperty ushort blue\nend_header\n"
      "0 0 0 1 0.5 1\n";
  EXPECT_EQ(mesh_of(text, Format::kPly).vertex_colors[0], (Rgb{255, 128, 255}));
}

TEST(ReadPly, NamesPlaceAndValueOfAnError) {
  const auto with = [](const std::string& header, const std::string& body) {
    return "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
           "property float y\nproperty float z\n" +
           header + "end_header\n" + body;
  };
  const std::string faces =
      "element face 1\nproperty list char int vertex_indices\n";
  const std::string points = "0 0 0\n1 0 0\n0 1 0\n";
  std::string infinite = samples::binary_ply(false);
  samples::put(infinite, infinite.find("end_header\n") + 11 + 24 + 8,
               -std::numeric_limits<double>::infinity());
  expect_errors(
      {{with(faces, points + "3 0 1 3\n"), ErrorCode::kBadIndex,
        "face 0 of 1: there is no vertex 3"},
       {with(faces, points + "3 0 1 -1\n"), ErrorCode::kBadIndex, "-1"},
       {with(faces, points + "-3 0 1 2\n"), ErrorCode::kOutOfRange, "-3"},
       {with(faces, points + "3 0 1 x\n"), ErrorCode::kSyntax, "'x'"},
       {with(faces, points + "3 0 1 2\nmore\n"), ErrorCode::kSyntax, "goes on"},
       {with(faces, "0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n"), ErrorCode::kNotFinite,
        "vertex 1 of 3: line 11: 'nan'"},
       {with("element face 99999999999\nproperty list uchar int "
             "vertex_indices\n",
             points),
        ErrorCode::kTruncated, "99999999999"},
       {with("element face 1\nproperty int a\n", points + "1\n"),
        ErrorCode::kSyntax, "vertex_indices"},
       {with("element face 9000000000000000000\n", points), ErrorCode::kSyntax,
        "no properties"},
       {with("property float x\n", points), ErrorCode::kSyntax, "second"},
       {with("property foo w\n", points), ErrorCode::kSyntax, "'foo'"},
       {with("property list float int w\n", points), ErrorCode::kSyntax,
        "integer"},
       {with("element tristrips 1\nproperty list int int vertex_indices\n", ""),
        ErrorCode::kUnknownFormat, "strips"},
       {with("property list uchar uint vertex_indices\n", points),
        ErrorCode::kSyntax, "element face"},
       {with("wrong\n", points), ErrorCode::kSyntax, "line 7: 'wrong'"},
       {infinite, ErrorCode::kNotFinite, "vertex 1 of 4"},
       {samples::binary_ply(false) + "x", ErrorCode::kSyntax, "goes on"},
       {"ply\nformat ascii 2.0\n", ErrorCode::kUnknownFormat, "'2.0'"},
       {"ply\nformat utf 1.0\n", ErrorCode::kUnknownFormat, "'utf'"},
       {"ply\nelement vertex x\n", ErrorCode::kSyntax, "'x'"},
       {"ply\nproperty int x\n", ErrorCode::kSyntax, "before any element"},
       {"ply\nformat ascii 1.0\nend_header\n", ErrorCode::kSyntax, "'vertex'"},
       {"OFF\n", ErrorCode::kUnknownFormat, "'ply'"}},
      Format::kPly);
}

TEST(ReadOff, ReadsCountsWhereverTheyStand) {
  const std::string body = "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  for (const char* header :
       {"OFF\n3 1 0\n", "OFF 3 1 0\n", "OFF3 1 0 # glued\n", "  OFF\n\n3 1\n",
        "# first\nOFF # word\n# between\n3 1 3\n"}) {
    const Mesh mesh = mesh_of(header + body, Format::kOff);
    EXPECT_EQ(mesh.vertices.size(), 3u) << header;
    EXPECT_EQ(faces_of(mesh), (CornerLists{{0, 1, 2}})) << header;
  }
}

TEST(ReadOff, ReadsWhatThePrefixesAdd) {
  const Mesh mesh = mesh_of(
      "STCNOFF\n3 1 0\n0 0 0 0 0 1 255 0 10 0.5 0.5\n"
      "1 0 0 0 0 1 0.5 0.0 1.0 1.0 0.5 0.5\n0 1 0 0 0 1 1 2 3 4 0.5 0.5\n"
      "3 0 1 2\n",
      Format::kOff);
  EXPECT_EQ(mesh.vertex_colors[0], (Rgb{255, 0, 10}));
  EXPECT_EQ(mesh.vertex_colors[1], (Rgb{128, 0, 255}));
  EXPECT_EQ(mesh.vertex_colors[2], (Rgb{1, 2, 3}));
  EXPECT_EQ(point(mesh, 2), (std::array<double, 3>{0, 1, 0}));
}

TEST(ReadOff, ReadsFaceColoursWhereThereAreAny) {
  const Mesh mesh = mesh_of(
      "OFF\n3 4 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 1 2 7\n"
      "3 0 1 2 1 2 3\n3 0 1 2 1.0 0 0 1\n",
      Format::kOff);
  ASSERT_EQ(mesh.face_colors.size(), 4u);
  EXPECT_FALSE(mesh.face_colors[0]);
  EXPECT_FALSE(mesh.face_colors[1]);
  EXPECT_EQ(mesh.face_colors[2], (Rgb{1, 2, 3}));
  EXPECT_EQ(mesh.face_colors[3], (Rgb{255, 0, 0}));
}

TEST(ReadOff, NamesLineAndValueOfAnError) {
  const std::string points = "0 0 0\n1 0 0\n0 1 0\n";
  expect_errors(
      {{"OFF\n3 1 0\n" + points + "3 0 1 3\n", ErrorCode::kBadIndex,
        "line 6: face 0: there is no vertex '3'"},
       {"OFF\n3 1 0\n" + points + "3 0 1 -1\n", ErrorCode::kBadIndex, "'-1'"},
       {"OFF\n3 1 0\n" + points + "-3 0 1 2\n", ErrorCode::kOutOfRange, "-3"},
       {"OFF\n3 2 0\n" + points + "3 0 1 2\n", ErrorCode::kTruncated,
        "face 1 of 2"},
       {"OFF\n3 1 0\n" + points + "3 0 1 2\nmore\n", ErrorCode::kSyntax,
        "goes on"},
       {"OFF\n3 1 0\n" + points + "3 0 1 2 5 6\n", ErrorCode::kSyntax, "2"},
       {"OFF\n3 1 0\n" + points + "3 0 1 2 5 6 256\n", ErrorCode::kOutOfRange,
        "256"},
       {"OFF\n3 1 0\n0 0 0 1 2 3\n", ErrorCode::kSyntax, "vertex 0 has 3"},
       {"OFF\n3 1 0\n0 0 inf\n", ErrorCode::kNotFinite, "line 3"},
       {"OFF\n353535235358 6 0\n", ErrorCode::kOutOfRange, "353535235358"},
       {"OFF\n2000000000 2000000000 0\n0 0 0\n", ErrorCode::kTruncated,
        "vertex 1 of 2000000000"},
       {"OFF\n-1 6 0\n", ErrorCode::kOutOfRange, "'-1'"},
       {"OFF\n1 2 3 4\n", ErrorCode::kSyntax, "counts"},
       {"OFF BINARY\n", ErrorCode::kUnknownFormat, "binary"},
       {"4OFF\n", ErrorCode::kUnknownFormat, "'4OFF'"},
       {"nOFF\n", ErrorCode::kUnknownFormat, "'nOFF'"},
       {"ply\n", ErrorCode::kUnknownFormat, "'ply'"}},
      Format::kOff);
}

}  // namespace
}  // namespace halfspace::io
