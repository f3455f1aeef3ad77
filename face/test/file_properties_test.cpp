#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <vector>

#include "halfspace/halfspace.hpp"
#include "halfspace/io/mesh.hpp"
#include "halfspace/io/read_mesh.hpp"

namespace halfspace {
namespace {

/// A cube from (0, 0, 0) to (4, 4, 4) in two materials, in triangles. Texture
/// coordinates of its top are x / 4 and y / 4.
void write_cube(const std::string& path) {
  std::ofstream(std::filesystem::path(path).replace_extension("mtl"))
      << "newmtl red\nKd 1 0 0\nnewmtl green\nKd 0 1 0\n";
  std::ofstream(path) << "mtllib "
                      << std::filesystem::path(path).stem().string()
                      << ".mtl\n"
                         "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\n"
                         "v 0 0 4\nv 4 0 4\nv 4 4 4\nv 0 4 4\n"
                         "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
                         "usemtl red\n"
                         "f 5/1 6/2 7/3\nf 5/1 7/3 8/4\n"
                         "f 4 3 2\nf 4 2 1\n"
                         "usemtl green\n"
                         "f 1 2 6\nf 1 6 5\nf 2 3 7\nf 2 7 6\n"
                         "f 3 4 8\nf 3 8 7\nf 4 1 5\nf 4 5 8\n";
}

std::string material_of(const io::Mesh& mesh, std::size_t face) {
  const io::Attributes& attributes = mesh.attributes;
  if (attributes.face_materials.empty()) return "";
  const std::int32_t at = attributes.face_materials[face];
  return at < 0 ? "" : attributes.materials[static_cast<std::size_t>(at)].name;
}

std::array<double, 3> point_of(const io::Mesh& mesh, std::size_t corner) {
  const auto& at =
      mesh.vertices[static_cast<std::size_t>(mesh.corners[corner])];
  return {io::to_double(at[0]), io::to_double(at[1]), io::to_double(at[2])};
}

/// What is cut off a cube of two materials: corners that no face had.
Solid part_of(const std::string& path) {
  return Solid::from_file(path) -
         Solid::box({1, 1, 3}, {9, 2, 9}).named("slot");
}

TEST(FaceFiles, MaterialsAndTextureCoordinatesComeThrough) {
  write_cube("face_two.obj");
  for (const std::string name : {"face_two_cut.obj", "face_two_cut.glb"}) {
    ASSERT_TRUE(part_of("face_two.obj").save(name)) << name;
    const auto mesh = io::read_mesh(name);
    ASSERT_TRUE(mesh) << name << ": " << mesh.error().message;
    const io::Channel* uv = io::channel_named(mesh->attributes.corners, "uv");
    ASSERT_NE(uv, nullptr) << name;
    std::set<std::string> seen;
    std::size_t on_top = 0;
    for (std::size_t f = 0; f < mesh->face_count(); ++f) {
      bool is_top = true;
      const std::size_t first = mesh->first_corner[f];
      const std::size_t end = mesh->first_corner[f + 1];
      for (std::size_t c = first; c < end; ++c)
        is_top = is_top && point_of(*mesh, c)[2] == 4;
      seen.insert(material_of(*mesh, f));
      if (!is_top) continue;
      ++on_top;
      EXPECT_EQ(material_of(*mesh, f), "red") << name;
      for (std::size_t c = first; c < end; ++c) {
        EXPECT_EQ(uv->at(c)[0], point_of(*mesh, c)[0] / 4) << name;
        EXPECT_EQ(uv->at(c)[1], point_of(*mesh, c)[1] / 4) << name;
      }
    }
    EXPECT_GT(on_top, 2u) << name;
    // Of the slot nothing is said.
    EXPECT_EQ(seen, (std::set<std::string>{"", "green", "red"})) << name;
  }
}

TEST(FaceFiles, ColorsOfMaterialsAreColorsOfPolygons) {
  write_cube("face_colors.obj");
  const Mesh mesh = *part_of("face_colors.obj").mesh();
  ASSERT_EQ(mesh.colors.size(), mesh.polygon_count());
  std::size_t red = 0, green = 0;
  for (std::size_t p = 0; p < mesh.polygon_count(); ++p) {
    if (mesh.origins[p].operand != 0) continue;
    bool is_level = true;
    const auto corners = mesh.corners_of(p);
    for (const std::int32_t v : corners)
      is_level =
          is_level && mesh.vertices[static_cast<std::size_t>(v)].z ==
                          mesh.vertices[static_cast<std::size_t>(corners[0])].z;
    EXPECT_EQ(mesh.colors[p], is_level ? (Rgb{255, 0, 0}) : (Rgb{0, 255, 0}));
    ++(is_level ? red : green);
  }
  EXPECT_GT(red, 1u);
  EXPECT_GT(green, 3u);
}

TEST(FaceFiles, FacesOfOneMaterialMergeAndOthersDoNot) {
  // Coplanar halves of one colour, and of two materials of that colour.
  for (const bool is_one : {true, false}) {
    const std::string path = is_one ? "face_one.obj" : "face_halves.obj";
    std::ofstream("face_halves.mtl")
        << "newmtl a\nKd 1 1 0\nnewmtl b\nKd 1 1 0\n";
    std::ofstream(path) << "mtllib face_halves.mtl\n"
                           "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\n"
                           "v 0 0 4\nv 4 0 4\nv 4 4 4\nv 0 4 4\n"
                           "usemtl a\n"
                           "f 4 3 2 1\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\n"
                           "f 4 1 5 8\nf 5 6 7\n"
                        << (is_one ? "" : "usemtl b\n") << "f 5 7 8\n";
    EXPECT_EQ(Solid::from_file(path).mesh()->polygon_count(), is_one ? 6u : 7u);
  }
}

}  // namespace
}  // namespace halfspace
