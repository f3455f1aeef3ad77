#include "halfspace/io/load_scene.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace halfspace::io {
namespace {

std::string written(const std::string& name, const std::string& text) {
  const auto path =
      std::filesystem::temp_directory_path() / ("halfspace_load_scene_" + name);
  std::ofstream(path, std::ios::binary) << text;
  return path.string();
}

constexpr const char* kTriangle = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

TEST(LoadScene, AMeshIsImported) {
  const auto loaded = load_scene(written("a.off", kTriangle), {});
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(loaded->file.scene.polygon_count(), 1u);
  EXPECT_EQ(loaded->polygons, std::vector<PolygonId>{0});
  EXPECT_FALSE(loaded->is_scene_file);
}

TEST(LoadScene, ASceneKeepsItsGrid) {
  const auto mesh = load_scene(written("b.off", kTriangle), {});
  ASSERT_TRUE(mesh);
  const std::string path = written("b.SCENE", write_scene(mesh->file));
  const auto scene = load_scene(path, {});
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_TRUE(scene->is_scene_file);
  EXPECT_EQ(scene->report.moved, 0u);
  const auto other = load_scene(path, {.grid_bits = 54});
  ASSERT_FALSE(other);
  EXPECT_EQ(other.error().code, ErrorCode::kOutOfRange);
  EXPECT_TRUE(other.error().message.starts_with(path + ": "));
}

TEST(LoadScene, SeveralFilesAreReadAsEachAlone) {
  const std::vector<std::string> paths = {
      written("c.off", kTriangle), written("d.off", "OFF\n3 1 0\n0 0\n"),
      "no/such.off",
      written("e.off", "OFF\n3 1 0\n0 0 0\n2 0 0\n0 3 0\n3 0 1 2\n")};
  for (const int threads : {0, 1, 2, 9}) {
    const auto loaded = load_scenes(paths, {}, threads);
    ASSERT_EQ(loaded.size(), paths.size());
    for (std::size_t i = 0; i < paths.size(); ++i) {
      const auto alone = load_scene(paths[i], {});
      ASSERT_EQ(loaded[i].has_value(), alone.has_value()) << paths[i];
      if (alone)
        EXPECT_EQ(write_scene(loaded[i]->file), write_scene(alone->file));
      else
        EXPECT_EQ(loaded[i].error().message, alone.error().message);
    }
  }
  EXPECT_TRUE(load_scenes({}, {}, 2).empty());
}

TEST(LoadScene, ErrorsNameTheFileOnce) {
  const auto none = load_scene("", {});
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, ErrorCode::kUnreadable);
  EXPECT_EQ(error_about("a.off", {ErrorCode::kSyntax, "bad"}).message,
            "a.off: bad");
  EXPECT_EQ(error_about("a.off", {ErrorCode::kSyntax, "a.off: bad"}).message,
            "a.off: bad");
}

TEST(LoadScene, ExtensionsAreKnownInEitherCase) {
  EXPECT_TRUE(has_extension("x.PNG", ".png"));
  EXPECT_FALSE(has_extension("png", ".png"));
  EXPECT_TRUE(is_scene_name("a.scene"));
  EXPECT_FALSE(is_scene_name("scene.off"));
}

}  // namespace
}  // namespace halfspace::io
