// Calls the functions that README.md, docs/guide.md and the pages of docs/site
// show: their blocks are compiled as they stand, into a source of its own.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "halfspace/camera.hpp"
#include "halfspace/csg/script.hpp"
#include "halfspace/fast/display_tree.hpp"
#include "halfspace/fast/render.hpp"
#include "halfspace/fast/to_mesh.hpp"
#include "halfspace/io/view.hpp"
#include "halfspace/io/write_mesh.hpp"
#include "halfspace/result.hpp"
#include "halfspace/scene.hpp"
#include "halfspace/solid.hpp"
#include "models.hpp"

// README.md
halfspace::Result<halfspace::Done> drill_and_show(const char* mesh_file,
                                                  const char* png_file);
// docs/guide.md
halfspace::Result<std::string> drilled_plate(const char* file);
halfspace::Result<halfspace::Scene> triangle();
halfspace::PolygonId polygon_at(const halfspace::Scene& scene,
                                const halfspace::Camera& camera, std::int32_t i,
                                std::int32_t j);
std::vector<halfspace::PolygonId> line_of_two_polygons();
halfspace::Result<halfspace::fast::ExportedMesh> drilled(
    const halfspace::Scene& plate_scene, const halfspace::Scene& drill_scene);
halfspace::Result<double> volume_of(
    const char* expression, const std::vector<halfspace::csg::Binding>& names);
halfspace::fast::Rendering checked(const halfspace::Scene& scene,
                                   const halfspace::fast::BspTree& tree,
                                   const halfspace::Camera& camera,
                                   std::size_t& wrong_pixels);
// docs/site
bool make_cup(const char* mesh, const char* picture);
halfspace::Solid plate_with_one_hole();
halfspace::Solid plate_with_two_holes();
bool convert(const char* in, const char* out);
bool write_figure(const halfspace::Solid& solid, const char* svg);

namespace halfspace {
namespace {

/// The cube from `low` to `low + edge` on every axis.
Scene cube_at(std::int64_t low, std::int64_t edge) {
  SceneData data;
  for (int i = 0; i < 8; ++i) {
    data.vertices.push_back({low + edge * (i & 1), low + edge * (i >> 1 & 1),
                             low + edge * (i >> 2 & 1)});
  }
  data.corners = {0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4,
                  2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5};
  data.first_corner = {0, 4, 8, 12, 16, 20, 24};
  data.colors.assign(6, {200, 80, 40});
  return *make_scene(std::move(data));
}

TEST(Documents, TheReadmesProgramMakesAPartAndAPicture) {
  const auto done = drill_and_show("documents.off", "documents.png");
  EXPECT_TRUE(done) << done.error().message;
  EXPECT_GT(std::filesystem::file_size("documents.off"), 100u);
  EXPECT_GT(std::filesystem::file_size("documents.png"), 100u);
  EXPECT_FALSE(drill_and_show("missing/documents.off", "documents.png"));
}

TEST(Documents, TheGuidesPlateIsDrilled) {
  const auto volume = drilled_plate("documents_plate.off");
  ASSERT_TRUE(volume) << volume.error().message;
  EXPECT_GT(std::stod(*volume), 120000 - 3.15 * 64 * 20);
  EXPECT_LT(std::stod(*volume), 120000 - 3.1 * 64 * 20);
  EXPECT_GT(std::filesystem::file_size("documents_plate.off"), 100u);
}

TEST(Documents, TheGuidesSceneIsATriangle) {
  const auto scene = triangle();
  ASSERT_TRUE(scene);
  EXPECT_EQ(scene->polygon_count(), 1u);
}

TEST(Documents, TheGuidesImageShowsAPolygon) {
  const Scene cube = cube_at(0, 2);
  const auto view = io::automatic_view(cube, 32, 32);
  ASSERT_TRUE(view);
  EXPECT_GE(polygon_at(cube, view->camera, 16, 16), 0);
  EXPECT_EQ(polygon_at(cube, view->camera, 0, 0), kBackground);
}

TEST(Documents, TheGuidesLineShowsTheFrontPolygon) {
  EXPECT_EQ(line_of_two_polygons(),
            (std::vector<PolygonId>{-1, 2, 2, 1, 1, 1, 2, 2, -1, -1}));
}

TEST(Documents, TheGuidesBooleanIsExact) {
  const auto mesh = drilled(cube_at(0, 2), cube_at(1, 2));
  ASSERT_TRUE(mesh);
  EXPECT_EQ(mesh->vertices.size(), 14u);  // 7 corners left, 7 new ones
  EXPECT_EQ(mesh->moved, 0u);
  EXPECT_FALSE(drilled(*triangle(), cube_at(0, 2)));
}

TEST(Documents, TheGuidesExpressionHasTheVolume) {
  ASSERT_TRUE(io::write_scene_mesh("documents.off", cube_at(0, 2)));
  const auto volume =
      volume_of("A - translate(A, 1, 1, 1)", {{"A", "documents.off"}});
  ASSERT_TRUE(volume) << volume.error().message;
  EXPECT_EQ(*volume, 7);
}

TEST(Documents, TheSitesProgramsDoWhatTheySay) {
  EXPECT_TRUE(make_cup("documents_cup.stl", "documents_cup.png"));
  EXPECT_FALSE(make_cup("missing/documents_cup.stl", "documents_cup.png"));
  EXPECT_GT(std::filesystem::file_size("documents_cup.png"), 100u);
  EXPECT_EQ(*plate_with_one_hole().genus(), 1);
  EXPECT_EQ(*plate_with_two_holes().genus(), 2);
  EXPECT_TRUE(convert("documents_cup.stl", "documents_cup.off"));
  EXPECT_FALSE(convert("missing.off", "documents_cup.off"));
  EXPECT_TRUE(write_figure(plate_with_one_hole(), "documents_plate.svg"));
  EXPECT_GT(std::filesystem::file_size("documents_plate.svg"), 100u);
}

TEST(Documents, TheGuidesShadowFindsNothingWrong) {
  const auto model = models::make_model("interlocking-cubes", {});
  ASSERT_TRUE(model);
  const auto view = io::automatic_view(*model, 64, 48);
  ASSERT_TRUE(view);
  std::size_t wrong_pixels = 1;
  const auto image = checked(*model, fast::build_display_tree(*model),
                             view->camera, wrong_pixels);
  EXPECT_EQ(wrong_pixels, 0u);
  EXPECT_GT(image.pixels_painted, 0u);
}

}  // namespace
}  // namespace halfspace
