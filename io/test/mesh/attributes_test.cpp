#include "halfspace/io/attributes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>

#include "halfspace/io/import.hpp"
#include "halfspace/io/write_mesh.hpp"
#include "mesh/samples.hpp"

namespace halfspace::io {
namespace {

using samples::TemporaryFile;

/// A tetrahedron with all that a file can say, and a fan of one quad.
constexpr const char* kPaintedObj =
    "mtllib paint.mtl\n"
    "v 0 0 0\nv 4 0 0\nv 0 4 0\nv 0 0 4\n"
    "vt 0 0\nvt 0.25 0.5\nvt 1 1\nvn 0 0 -1\nvn -0.6 0 -0.8\n"
    "o body\ng left side\nusemtl glossy red\n"
    "f 1/1/1 3/2/1 2/3/2\nf 1//1 2//1 4//2\n"
    "g default\nusemtl glass\nf 2 3 4\nusemtl none\nf -2/3 -4/1 -1/2\n";

Mesh painted_mesh(const std::filesystem::path& folder) {
  samples::write(folder / "paint.obj", kPaintedObj);
  samples::write(folder / "paint.mtl",
                 "newmtl glossy red\nKd 0.8 0.1 0.02\nmap_Kd -s 1 1 1 a b.png\n"
                 "newmtl glass\nKd 0.5\nd 0.25\nNs x\n");
  const Result<Mesh> mesh = read_mesh(folder / "paint.obj");
  EXPECT_TRUE(mesh) << mesh.error().message;
  return mesh ? *mesh : Mesh();
}

/// What is compared after a way through a file: NaN is NaN.
void expect_same(const Attributes& a, const Attributes& b) {
  EXPECT_EQ(a.materials, b.materials);
  EXPECT_EQ(a.face_materials, b.face_materials);
  EXPECT_EQ(a.objects, b.objects);
  EXPECT_EQ(a.groups, b.groups);
  ASSERT_EQ(a.corners.size(), b.corners.size());
  for (const Channel& channel : a.corners) {
    const Channel* other = channel_named(b.corners, channel.name);
    ASSERT_NE(other, nullptr) << channel.name;
    EXPECT_EQ(channel.kind, other->kind);
    ASSERT_EQ(channel.width, other->width);
    ASSERT_EQ(channel.values.size(), other->values.size());
    for (std::size_t i = 0; i < channel.values.size(); ++i) {
      if (std::isnan(channel.values[i])) {
        EXPECT_TRUE(std::isnan(other->values[i])) << channel.name << i;
      } else {
        EXPECT_EQ(channel.values[i], other->values[i]) << channel.name << i;
      }
    }
  }
}

OutputMesh output_of(const Mesh& mesh) {
  OutputMesh output;
  for (const auto& [x, y, z] : mesh.vertices)
    output.vertices.push_back({to_double(x), to_double(y), to_double(z)});
  output.first_corner = mesh.first_corner;
  output.corners = mesh.corners;
  output.attributes =
      std::make_shared<const Attributes>(attributed_faces(mesh).attributes);
  return output;
}

TEST(AttributesInFiles, AnObjHasNamesMaterialsAndReferences) {
  const TemporaryFile file("paint.obj");
  const Mesh mesh = painted_mesh(file.path().parent_path());
  const Attributes& made = mesh.attributes;
  ASSERT_EQ(made.materials.size(), 2u);
  EXPECT_EQ(made.materials[0],
            (Material{"glossy red", Rgb{204, 26, 5}, 1, "b.png"}));
  EXPECT_EQ(made.materials[1], (Material{"glass", Rgb{128, 128, 128}, 0.25}));
  EXPECT_EQ(made.face_materials, (std::vector<std::int32_t>{0, 0, 1, -1}));
  EXPECT_EQ(made.groups.names, std::vector<std::string>{"left side"});
  EXPECT_EQ(made.groups.of_face, (std::vector<std::int32_t>{0, 0, -1, -1}));
  EXPECT_EQ(made.objects.of_face, (std::vector<std::int32_t>{0, 0, 0, 0}));
  const Channel* uv = channel_named(made.corners, "uv");
  ASSERT_NE(uv, nullptr);
  EXPECT_EQ(uv->at(1)[1], 0.5);
  EXPECT_TRUE(std::isnan(uv->at(3)[0]));
  EXPECT_EQ(uv->at(9)[0], 1);
  EXPECT_EQ(made.files.size(), 1u);
  EXPECT_TRUE(made.notes.empty());
  // A polygon without a colour of its own has its material's.
  const Result<Imported> imported = import_scene(mesh, {});
  ASSERT_TRUE(imported);
  EXPECT_EQ(imported->scene.color(0), (Rgb{204, 26, 5}));
}

TEST(AttributesInFiles, WhatIsWrongWithMaterialsIsNoted) {
  const TemporaryFile file("a.obj");
  samples::write(file.path(),
                 std::string(kPaintedObj) + "mtllib c:\\b\\c.mtl\n");
  samples::write(file.path().parent_path() / "paint.mtl",
                 "newmtl glass\nKd 1 2 3\n");
  const Result<Mesh> mesh = read_mesh(file.path());
  ASSERT_TRUE(mesh) << mesh.error().message;
  ASSERT_EQ(mesh->attributes.notes.size(), 2u);
  EXPECT_NE(mesh->attributes.notes[0].find("paint.mtl: line 2: Kd"),
            std::string::npos);
  EXPECT_NE(mesh->attributes.notes[1].find("c.mtl"), std::string::npos);
}

TEST(AttributesInFiles, ObjAndPlyHoldThem) {
  const TemporaryFile file("paint.obj");
  const Mesh mesh = painted_mesh(file.path().parent_path());
  for (const char* name : {"out.obj", "out.ply"}) {
    const auto path = file.path().parent_path() / name;
    const auto report = write_mesh(path, output_of(mesh));
    ASSERT_TRUE(report) << report.error().message;
    EXPECT_TRUE(report->lost.empty()) << name;
    const Result<Mesh> again = read_mesh(path);
    ASSERT_TRUE(again) << again.error().message;
    expect_same(mesh.attributes, again->attributes);
  }
}

TEST(AttributesInFiles, PlyHasAnyNumberOfVerticesAndFaces) {
  const std::string text =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
      "property float y\nproperty float z\nproperty float heat\n"
      "property float nx\nproperty float ny\nproperty float nz\n"
      "element face 2\nproperty list uchar int vertex_indices\n"
      "property int part\nproperty list uchar float texcoord\nend_header\n"
      "0 0 0 1.5 0 0 1\n1 0 0 nan 0 0 1\n0 1 0 -3 0 1 0\n"
      "3 0 1 2 7 6 0 0 1 0 0 1\n3 0 2 1 -8 0\n";
  const Result<Mesh> mesh = read_mesh(text, Format::kPly);
  ASSERT_TRUE(mesh) << mesh.error().message;
  const Channel* heat = channel_named(mesh->attributes.corners, "heat");
  ASSERT_NE(heat, nullptr);
  EXPECT_EQ(heat->values[0], 1.5);
  EXPECT_TRUE(std::isnan(heat->values[1]));
  EXPECT_EQ(heat->values[4], -3);
  const Channel* uv = channel_named(mesh->attributes.corners, "uv");
  ASSERT_NE(uv, nullptr);
  ASSERT_EQ(uv->values.size(), 12u);
  EXPECT_EQ(uv->values[2], 1);
  EXPECT_TRUE(std::isnan(uv->values[6]));
  const Channel* part = channel_named(mesh->attributes.faces, "part");
  ASSERT_NE(part, nullptr);
  EXPECT_TRUE(part->is_integer);
  EXPECT_EQ(part->values, (std::vector<double>{7, -8}));
  const TemporaryFile file("a.ply");
  ASSERT_TRUE(write_mesh(file.path(), output_of(*mesh)));
  const Result<Mesh> again = read_mesh(file.path());
  ASSERT_TRUE(again);
  expect_same(mesh->attributes, again->attributes);
  EXPECT_EQ(again->attributes.faces[0].values, part->values);
}

TEST(AttributesInFiles, WhatIsLostIsNamed) {
  const TemporaryFile file("paint.obj");
  const Mesh mesh = painted_mesh(file.path().parent_path());
  const auto path = file.path().parent_path() / "out.off";
  const auto report = write_mesh(path, output_of(mesh));
  ASSERT_TRUE(report);
  EXPECT_EQ(report->lost,
            (std::vector<std::string>{"materials", "names of objects", "groups",
                                      "texture points", "normals"}));
  const auto alone =
      write_mesh(file.path().parent_path() / "no.obj", output_of(mesh), false);
  ASSERT_TRUE(alone);
  EXPECT_EQ(alone->lost, std::vector<std::string>{"materials"});
  EXPECT_FALSE(std::filesystem::exists(file.path().parent_path() / "no.mtl"));
  OutputMesh wrong = output_of(mesh);
  auto shape = std::make_shared<Attributes>(*wrong.attributes);
  shape->face_materials[0] = 2;
  wrong.attributes = shape;
  EXPECT_EQ(write_mesh(path, wrong).error().code, ErrorCode::kBadIndex);
}

}  // namespace
}  // namespace halfspace::io
