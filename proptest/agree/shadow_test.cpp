#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "generate/clip_planes.hpp"
#include "generate/cut_boxes.hpp"
#include "generate/random_scenes.hpp"
#include "halfspace/ref/oracle/raycast.hpp"
#include "halfspace/scene_file.hpp"
#include "halfspace/shadow/check.hpp"
#include "halfspace/shadow/render.hpp"

namespace halfspace::agree {
namespace {

struct View {
  Scene scene;
  Camera camera;
  ImageOptions options;
};

View random_view(Kind kind, int grid_bits, Draws& draws) {
  View view;
  view.scene = random_scene(kind, grid_bits, 12, draws, draws.one_in(2));
  view.camera = random_camera(kind, view.scene, 31, 23, draws);
  view.options.cull = draws.one_in(3);
  view.options.shading = draws.one_in(2) ? Shading::kGouraud : Shading::kFlat;
  if (draws.one_in(3)) {
    view.options.clips =
        generate::clip_planes(view.scene, draws.next(),
                              static_cast<std::uint64_t>(draws.from_to(1, 3)));
  }
  return view;
}

/// Boxes that are cut, with caps, which may be told apart by parts.
View capped_view(Draws& draws) {
  SceneFile file = cut_boxes(draws.next(), 3, 24, 16);
  if (draws.one_in(2)) {
    file.options.clips =
        generate::clip_planes(file.scene, draws.next(),
                              static_cast<std::uint64_t>(draws.from_to(1, 3)));
  }
  if (draws.one_in(2)) tell_parts_apart(file);
  file.options.cull = draws.one_in(3);
  return {std::move(file.scene), std::move(*file.camera),
          std::move(file.options)};
}

template <class Check>
void for_all_views(int rounds, const Check& check) {
  Draws draws(2);
  for (int round = 0; round < rounds; ++round) {
    for (const Kind kind : kKinds) {
      for (const int bits : kGridBits) {
        SCOPED_TRACE(std::string(name_of(kind)) + ", " + std::to_string(bits) +
                     " bits, round " + std::to_string(round));
        check(random_view(kind, bits, draws), draws);
        if (::testing::Test::HasFatalFailure()) return;
      }
    }
    for (int number = 0; number < 8; ++number) {
      SCOPED_TRACE("caps, round " + std::to_string(round));
      check(capped_view(draws), draws);
      if (::testing::Test::HasFatalFailure()) return;
    }
  }
}

TEST(AgreeShadow, ARightImageHasNoMismatch) {
  shadow::Report doubles, rays;
  for_all_views(4, [&](const View& view, Draws& draws) {
    const fast::BspTree tree = fast::build(view.scene, {});
    shadow::Options how;
    how.share = 1;
    fast::Rendering image;
    doubles.add(shadow::render(view.scene, tree, view.camera, view.options, {},
                               image, how));
    ASSERT_EQ(doubles.mismatches, 0u)
        << shadow::to_string(doubles.first.front());
    how.by_reference_only = true;
    how.share = 0.2;
    how.seed = draws.next();
    rays.add(shadow::check(view.scene, view.camera, view.options,
                           {image.items, image.colors}, how));
    ASSERT_EQ(rays.mismatches, 0u);
  });
  EXPECT_GE(rays.by_reference, rays.pixels);
  // Most pixels need no rays, and some do, on these scenes.
  EXPECT_LT(doubles.by_reference, doubles.pixels / 2);
  EXPECT_GT(doubles.by_reference, 1000u);
}

TEST(AgreeShadow, EveryWrongPixelIsFound) {
  std::set<PolygonId> planted;
  for_all_views(2, [&](const View& view, Draws& draws) {
    const ref::Rendering right =
        ref::raycast(view.scene, view.camera, view.options);
    ItemImage items = right.items;
    ColorImage colors = right.colors;
    std::vector<shadow::Mismatch> expected;
    const auto last = static_cast<std::int64_t>(view.scene.polygon_count()) -
                      1 + (view.options.caps ? 40 : 0);
    for (std::int32_t j = 0; j < items.height_px; ++j) {
      for (std::int32_t i = 0; i < items.width_px; ++i) {
        if (!draws.one_in(9)) continue;
        PolygonId& id = items.at(i, j);
        Rgb& color = colors.at(i, j);
        if (draws.one_in(2)) {
          color.g = static_cast<std::uint8_t>(color.g + 1);
        } else if (draws.one_in(9)) {
          id = draws.one_in(2) ? -7 : 1000000;
        } else {
          id = static_cast<PolygonId>(draws.from_to(kBackground, last));
        }
        if (id == right.items.at(i, j) && color == right.colors.at(i, j))
          continue;
        planted.insert(id);
        expected.push_back(
            {i, j, id, right.items.at(i, j), color, right.colors.at(i, j)});
      }
    }
    for (const bool by_reference_only : {false, true}) {
      const shadow::Options how{1, 1, items.pixels.size(), by_reference_only};
      const shadow::Report found = shadow::check(
          view.scene, view.camera, view.options, {items, colors}, how);
      ASSERT_EQ(found.mismatches, expected.size());
      ASSERT_EQ(found.first, expected);
      if (!draws.one_in(8)) break;  // rays alone take their time
    }
  });
  EXPECT_GT(planted.size(), 8u);
}

/// A rectangle at a height, seen from above by pixels of 4 by 4 grid steps.
void add_rectangle(SceneData& data, std::int64_t left, std::int64_t top,
                   std::int64_t right, std::int64_t bottom, std::int64_t z) {
  const auto first = static_cast<VertexId>(data.vertices.size());
  data.vertices.insert(
      data.vertices.end(),
      {{left, top, z}, {right, top, z}, {right, bottom, z}, {left, bottom, z}});
  for (VertexId k = 0; k < 4; ++k) data.corners.push_back(first + k);
  data.first_corner.push_back(static_cast<std::uint32_t>(data.corners.size()));
  data.colors.push_back({});
}

TEST(AgreeShadow, WhatIsLeftOutIsFoundWhereverItIs) {
  CameraData from_above;
  from_above.perspective = false;
  from_above.eye = {0, 0, 256};
  from_above.sx = {4 * 256, 0, 0};
  from_above.sy = {0, 4 * 256, 0};
  from_above.width_px = 24;
  from_above.height_px = 16;
  const Camera camera = *make_camera(from_above, 26);
  std::size_t all = 0;
  for (const std::int64_t size : {4, 8, 20, 60}) {
    for (std::int64_t x = 0; x < 96; x += 4) {
      for (std::int64_t y = 0; y < 64; y += 12) {
        // The ground, what was left out, and what is nearer on its left.
        SceneData data;
        add_rectangle(data, 0, 0, 96, 64, 0);
        add_rectangle(data, x, y, x + size, y + size, 1);
        add_rectangle(data, -4, 0, x + size - 4, 64, 2);
        const Scene scene = *make_scene(std::move(data));
        // One column of the second is seen, and shows the ground.
        const auto column = static_cast<std::int32_t>((x + size) / 4 - 1);
        ItemImage items(24, 16, 0);
        for (std::int32_t j = 0; j < 16; ++j) {
          for (std::int32_t i = 0; i < std::min(column, 24); ++i)
            items.at(i, j) = 2;
        }
        const std::int64_t rows =
            std::min(y + size, std::int64_t{64}) / 4 - y / 4;
        const auto wrong = static_cast<std::size_t>(column < 24 ? rows : 0);
        const shadow::Report found = shadow::check(
            scene, camera, {}, {items, ColorImage()}, {1, 1, 1000});
        ASSERT_EQ(found.mismatches, wrong) << x << " " << y << " " << size;
        for (const shadow::Mismatch& m : found.first) {
          EXPECT_EQ(m.i, column);
          EXPECT_EQ(m.expected, 1);
        }
        all += wrong;
      }
    }
  }
  EXPECT_GT(all, 1000u);
}

TEST(AgreeShadow, AShareIsSpreadEvenlyOverThePartThatIsShown) {
  Draws draws(3);
  const View view = random_view(Kind::kSmall, 26, draws);
  const fast::BspTree tree = fast::build(view.scene, {});
  std::set<std::pair<std::int32_t, std::int32_t>> met;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    fast::RenderOptions part;
    part.rectangle = {3, 5, 28, 19};
    fast::Rendering image;
    const shadow::Options how{0.05, seed, 1000};
    const shadow::Report right = shadow::render(view.scene, tree, view.camera,
                                                view.options, part, image, how);
    ASSERT_EQ(right.mismatches, 0u);
    ASSERT_EQ(right.pixels, 18u);  // 25 by 14, by twenties
    // All wrong: so those that are chosen are told.
    for (PolygonId& id : image.items.pixels) id = 999;
    const shadow::Report wrong =
        shadow::check(view.scene, view.camera, view.options,
                      {image.items, ColorImage(), 3, 5}, how);
    ASSERT_EQ(wrong.first.size(), 18u);
    std::int32_t block = 0;
    for (const shadow::Mismatch& m : wrong.first) {
      ASSERT_EQ(((m.j - 5) * 25 + m.i - 3) / 20, block++);
      met.insert({m.i, m.j});
    }
  }
  EXPECT_EQ(met.size(), 25u * 14u);
}

TEST(AgreeShadow, AReproducerIsASceneFile) {
  Draws draws(4);
  const View view = random_view(Kind::kFaces, 40, draws);
  ref::Rendering image = ref::raycast(view.scene, view.camera, view.options);
  image.items.at(7, 9) = 1 + image.items.at(7, 9);
  shadow::Options how;
  how.share = 1;
  const shadow::Report found = shadow::check(
      view.scene, view.camera, view.options, {image.items, image.colors}, how);
  const std::string text =
      shadow::reproducer(view.scene, view.camera, view.options, found);
  EXPECT_EQ(text.rfind("# pixel 7 9: shown polygon ", 0), 0u);
  const auto file = read_scene(text);
  ASSERT_TRUE(file);
  EXPECT_EQ(*file, (SceneFile{view.scene, view.camera, view.options}));
}

}  // namespace
}  // namespace halfspace::agree
