#include "models.hpp"

#include <gtest/gtest.h>

#include "halfspace/boolean.hpp"

namespace halfspace::models {
namespace {

std::size_t polygons(std::string_view name, const ModelOptions& options = {}) {
  const Result<Scene> scene = make_model(name, options);
  EXPECT_TRUE(scene) << name;
  return scene ? scene->polygon_count() : 0;
}

TEST(Models, HaveTheNumbersOfPolygonsOfThePapers) {
  EXPECT_EQ(polygons("interlocking-cubes"), 216u);
  EXPECT_EQ(polygons("klein-bottle"), 450u);
  EXPECT_EQ(polygons("ribbons"), 368u);
  EXPECT_EQ(polygons("theorem1", {.count = 30}), 30u);
  EXPECT_EQ(polygons("random", {.count = 100, .size = 50}), 100u);
  EXPECT_EQ(polygons("parallel", {.count = 2000}), 2000u);
}

TEST(Models, SolidsAreClosedAndFaceOutwards) {
  for (const char* name :
       {"cube", "interlocking-cubes", "pinwheel", "stairs", "sphere"}) {
    const Result<Scene> scene = make_model(name, {});
    ASSERT_TRUE(scene) << name;
    EXPECT_TRUE(bad_edges(*scene).empty()) << name;
    // Six times the volume, by the divergence theorem over fan triangles.
    double volume = 0;
    for (PolygonId p = 0; p < static_cast<PolygonId>(scene->polygon_count());
         ++p) {
      const auto corners = scene->corners(p);
      for (std::size_t k = 2; k < corners.size(); ++k) {
        const auto at = [&](std::size_t i) { return scene->point(corners[i]); };
        const auto [ax, ay, az] = at(0);
        const auto [bx, by, bz] = at(k - 1);
        const auto [cx, cy, cz] = at(k);
        volume +=
            static_cast<double>(ax) * static_cast<double>(by * cz - bz * cy) +
            static_cast<double>(ay) * static_cast<double>(bz * cx - bx * cz) +
            static_cast<double>(az) * static_cast<double>(bx * cy - by * cx);
      }
    }
    EXPECT_GT(volume, 0) << name;
  }
}

TEST(Models, TheKleinBottleHasOneSide) {
  const Result<Scene> bottle = make_model("klein-bottle", {});
  ASSERT_TRUE(bottle);
  EXPECT_FALSE(bad_edges(*bottle).empty());
}

TEST(Models, AreTheSameForTheSameSeed) {
  const ModelOptions one = {.count = 20, .seed = 1};
  const ModelOptions two = {.count = 20, .seed = 2};
  EXPECT_TRUE(*make_model("random", one) == *make_model("random", one));
  EXPECT_FALSE(*make_model("random", one) == *make_model("random", two));
}

TEST(Models, RefuseWhatTheyCannotBe) {
  EXPECT_FALSE(make_model("teapot", {}));
  EXPECT_FALSE(make_model("theorem1", {.count = 7}));
  EXPECT_FALSE(make_model("random", {.size = 0}));
  EXPECT_FALSE(make_model("sphere", {.count = 2}));
  EXPECT_FALSE(make_model("random", {.count = -1}));
}

}  // namespace
}  // namespace halfspace::models
