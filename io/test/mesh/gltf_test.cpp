#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "halfspace/io/write_mesh.hpp"
#include "mesh/glb/base64.hpp"
#include "mesh/samples.hpp"

/// glTF as JSON, with its bytes in it or beside it.
namespace halfspace::io {
namespace {

using samples::expect_error;
using samples::TemporaryFile;

/// A tetrahedron's points with normals, and its triangles.
std::string tetrahedron_bytes() {
  std::string bytes;
  for (const float value :
       {0.f, 0.f, 0.f, 4.f, 0.f, 0.f, 0.f, 4.f, 0.f, 0.f, 0.f, 4.f})
    samples::append(bytes, value);
  for (const float value :
       {-1.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f})
    samples::append(bytes, value);
  for (const int value : {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3})
    samples::append(bytes, static_cast<std::uint16_t>(value));
  return bytes;
}

/// The file of a node that has `placing`, and of a buffer.
std::string gltf_of(const std::string& placing, const std::string& buffer) {
  return R"({"asset": {"version": "2.0"}, "nodes": [{"mesh": 0)" + placing +
         R"(}], "meshes": [{"primitives": [{"attributes":
         {"POSITION": 0, "NORMAL": 1}, "indices": 2}]}],
         "accessors": [
         {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
         {"bufferView": 0, "byteOffset": 48, "componentType": 5126,
          "count": 4, "type": "VEC3"},
         {"bufferView": 1, "componentType": 5123, "count": 12,
          "type": "SCALAR"}],
         "bufferViews": [
         {"buffer": 0, "byteLength": 96},
         {"buffer": 0, "byteOffset": 96, "byteLength": 24}],
         "buffers": [)" +
         buffer + "]}";
}

std::string embedded(const std::string& placing) {
  return gltf_of(placing, R"({"byteLength": 120, "uri": "data:;base64,)" +
                              base64_of(tetrahedron_bytes()) + R"("})");
}

TEST(Gltf, BytesAreLettersAndBack) {
  EXPECT_EQ(base64_of("any carnal pleas"), "YW55IGNhcm5hbCBwbGVhcw==");
  std::string bytes;
  for (int i = 0; i < 260; ++i) {
    EXPECT_EQ(bytes_of_base64(base64_of(bytes)), bytes);
    bytes += static_cast<char>(i * 7);
  }
  EXPECT_EQ(bytes_of_base64("YQ"), "a");
  EXPECT_FALSE(bytes_of_base64("YW55I"));
  EXPECT_FALSE(bytes_of_base64("YW 5"));
  EXPECT_FALSE(bytes_of_base64("Y==="));
}

TEST(Gltf, ItsBytesAreInItOrBesideIt) {
  const TemporaryFile file("a b.gltf");
  const auto folder = file.path().parent_path();
  samples::write(folder / "the bytes.bin", tetrahedron_bytes());
  samples::write(
      file.path(),
      gltf_of("", R"({"byteLength": 120, "uri": "the%20bytes.bin"})"));
  const Result<Mesh> beside = read_mesh(file.path());
  ASSERT_TRUE(beside) << beside.error().message;
  EXPECT_EQ(beside->face_count(), 4u);
  EXPECT_EQ(beside->vertices.size(), 4u);
  EXPECT_EQ(beside->attributes.files,
            std::vector<std::filesystem::path>{folder / "the bytes.bin"});
  const Result<Mesh> within = read_mesh(embedded(""), Format::kGltf);
  ASSERT_TRUE(within) << within.error().message;
  EXPECT_EQ(within->vertices, beside->vertices);
  EXPECT_EQ(within->corners, beside->corners);
}

/// A node that mirrors turns triangles round; normals stay on their outside.
TEST(Gltf, NormalsOfMirroredNodesPointOutwards) {
  for (const char* placing :
       {"", R"(, "scale": [-1, 1, 1])", R"(, "scale": [2, 3, -4])",
        R"(, "matrix": [0,1,0,0, 1,0,0,0, 0,0,1,0, 5,6,7,1])",
        R"(, "scale": [-1, -1, 2])"}) {
    SCOPED_TRACE(placing);
    const Result<Mesh> mesh = read_mesh(embedded(placing), Format::kGltf);
    ASSERT_TRUE(mesh) << mesh.error().message;
    const Channel* normals = channel_named(mesh->attributes.corners, "normal");
    ASSERT_NE(normals, nullptr);
    const auto faces = attributed_faces(*mesh);
    std::array<double, 3> middle{};
    for (const auto& p : faces.vertices) {
      for (std::size_t k = 0; k < 3; ++k) middle[k] += p[k] / 4;
    }
    double volume = 0;
    for (std::size_t i = 0; i < faces.corners.size(); ++i) {
      const auto at = [&](std::size_t corner) {
        return faces.vertices[static_cast<std::size_t>(faces.corners[corner])];
      };
      // Away from the middle, as they were before.
      double outwards = 0;
      for (std::size_t k = 0; k < 3; ++k)
        outwards += normals->at(i)[k] * (at(i)[k] - middle[k]);
      EXPECT_GT(outwards, 0) << i;
      if (i % 3 != 0) continue;
      const auto a = at(i), b = at(i + 1), c = at(i + 2);
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t u = (k + 1) % 3, v = (k + 2) % 3;
        volume +=
            (a[k] - middle[k]) * ((b[u] - middle[u]) * (c[v] - middle[v]) -
                                  (b[v] - middle[v]) * (c[u] - middle[u]));
      }
    }
    EXPECT_GT(volume, 0);
  }
}

TEST(Gltf, WhatIsWrongHasAPlace) {
  const auto read = [](const std::string& buffer) {
    return read_mesh(gltf_of("", buffer), Format::kGltf);
  };
  expect_error(read(R"({"byteLength": 120, "uri": "a.bin"})"),
               ErrorCode::kUnreadable,
               "buffers[0] is in 'a.bin', which is not read without the "
               "folder: name the file");
  expect_error(read(R"({"byteLength": 120, "uri": "https://x/a.bin"})"),
               ErrorCode::kUnreadable,
               "buffers[0] is in 'https://x/a.bin', which is not read from "
               "there: put it beside the file or below");
  expect_error(read(R"({"byteLength": 120, "uri": "data:;base64,!"})"),
               ErrorCode::kSyntax, "buffers[0].uri is no base64");
  expect_error(read(R"({"byteLength": 120, "uri": "data:;base64,YWJj"})"),
               ErrorCode::kTruncated, "buffers[0] has 3 of 120 bytes");
  expect_error(read(R"({"byteLength": 120})"), ErrorCode::kSyntax,
               "buffers[0] has neither bytes nor a uri");
  expect_error(read(R"({"byteLength": 3, "uri": "data:;base64,YWJj"})"),
               ErrorCode::kTruncated, "bufferViews[0] reaches to byte 96 of 3");
  expect_error(read(""), ErrorCode::kBadIndex,
               "bufferViews[0]: there is no buffers[0], only 0");
  expect_error(read_mesh("{\"asset\": 1,}", Format::kGltf), ErrorCode::kSyntax,
               "byte 13 is no JSON", 13);
  expect_error(read_mesh("[1, 2]", Format::kGltf), ErrorCode::kUnknownFormat,
               "a GLB begins with glTF, and a .gltf with {", 0);
  const TemporaryFile file("a.gltf");
  samples::write(file.path(),
                 gltf_of("", R"({"byteLength": 1, "uri": "b/../c.bin"})"));
  expect_error(read_mesh(file.path()), ErrorCode::kUnreadable,
               file.path().string() + ": buffers[0]: there is no file " +
                   (file.path().parent_path() / "b/../c.bin").string());
}

TEST(Gltf, BuffersOutsideOfItsFolderAreNotRead) {
  const TemporaryFile file("a.gltf"), there("there.bin");
  samples::write(there.path(), std::string(120, '\0'));
  const std::string name = there.path().filename().string();
  const std::string folder = file.path().parent_path().filename().string();
  for (const std::string& uri :
       {"../" + folder + "/" + name, "%2E%2e/" + folder + "/" + name,
        "./x/../../" + folder + "/" + name, "..%2f" + folder + "%2F" + name,
        there.path().string(), "%2f" + there.path().string().substr(1)}) {
    samples::write(file.path(), gltf_of("", R"({"byteLength": 120, "uri": ")" +
                                                uri + R"("})"));
    expect_error(read_mesh(file.path()), ErrorCode::kUnreadable,
                 file.path().string() + ": buffers[0] is in '" + uri +
                     "', which is not read from there: put it beside the file "
                     "or below");
  }
  samples::write(
      file.path(),
      gltf_of("", R"({"byteLength": 120, "uri": "./x/../)" + name + R"("})"));
  const Result<Mesh> mesh = read_mesh(file.path());
  EXPECT_TRUE(mesh ||
              mesh.error().message.find("not read") == std::string::npos);
}

/// The file with a material whose image is this.
std::string textured(const std::string& image, const std::string& use) {
  std::string file = embedded("");
  file.insert(file.size() - 1, R"(, "materials": [{"name": "m",
         "pbrMetallicRoughness": {"baseColorTexture": {"index": 0)" +
                                   use + R"(}}}],
         "textures": [{"source": 0}], "images": [)" +
                                   image + "]");
  return file;
}

TEST(Gltf, ImagesAreInItOrNoted) {
  const std::string png = "\x89PNG\r\n\x1a\n and more";
  const std::string uri = R"({"name": "wood", "uri": "data:image/png;base64,)" +
                          base64_of(png) + R"("})";
  const auto read = [](const std::string& image, const std::string& use = "") {
    return read_mesh(textured(image, use), Format::kGltf);
  };
  const Result<Mesh> mesh = read(uri);
  ASSERT_TRUE(mesh) << mesh.error().message;
  ASSERT_EQ(mesh->attributes.materials.size(), 1u);
  const Material& material = mesh->attributes.materials[0];
  EXPECT_EQ(material.texture, "wood");
  ASSERT_TRUE(material.image);
  EXPECT_EQ(material.image->bytes, png);
  // Without a factor it is a metal.
  EXPECT_EQ(material.metallic, 1.0);

  const Result<Mesh> second = read(uri, R"(, "texCoord": 1)");
  ASSERT_TRUE(second) << second.error().message;
  EXPECT_FALSE(second->attributes.materials[0].image);
  EXPECT_EQ(second->attributes.notes,
            std::vector<std::string>{"the image of 'm' has texture points of "
                                     "its own, and is passed over"});
  const Result<Mesh> other = read(R"({"uri": "data:;base64,YWJj"})");
  ASSERT_TRUE(other) << other.error().message;
  EXPECT_EQ(other->attributes.notes,
            std::vector<std::string>{"the image of 'm' is neither a PNG nor a "
                                     "JPEG, and is passed over"});
  const Result<Mesh> outside = read(R"({"uri": "some%20wood.png"})");
  ASSERT_TRUE(outside) << outside.error().message;
  EXPECT_EQ(outside->attributes.materials[0].texture, "some wood.png");
  EXPECT_FALSE(outside->attributes.materials[0].image);

  expect_error(read(R"({"uri": "data:;base64,!"})"), ErrorCode::kSyntax,
               "materials[0]: an image is no base64");
  expect_error(read(R"({"bufferView": 7})"), ErrorCode::kBadIndex,
               "materials[0]: there is no bufferViews[7], only 2");
  expect_error(read("3"), ErrorCode::kSyntax, "images[0] is no object");
}

TEST(Gltf, WhatIsWrittenIsReadAgain) {
  const TemporaryFile file("a.gltf");
  const Result<Mesh> mesh = read_mesh(embedded(""), Format::kGltf);
  ASSERT_TRUE(mesh);
  OutputMesh output;
  output.vertices = attributed_faces(*mesh).vertices;
  output.first_corner = mesh->first_corner;
  output.corners = mesh->corners;
  ASSERT_TRUE(write_mesh(file.path(), output));
  const Result<Mesh> again = read_mesh(file.path());
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(again->vertices, mesh->vertices);
  EXPECT_EQ(again->corners, mesh->corners);
}

}  // namespace
}  // namespace halfspace::io
