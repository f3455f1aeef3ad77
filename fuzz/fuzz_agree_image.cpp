#include "definition/definition.hpp"
#include "fuzz.hpp"
#include "halfspace/boolean.hpp"
#include "halfspace/cap_parts.hpp"
#include "halfspace/fast/display_tree.hpp"
#include "halfspace/fast/image/depth_sort.hpp"
#include "halfspace/fast/image/lazy_tree.hpp"
#include "halfspace/fast/image/screens.hpp"
#include "halfspace/fast/painter.hpp"
#include "halfspace/fast/render.hpp"
#include "halfspace/fast/shade/back_faces.hpp"
#include "halfspace/fast/shade/look.hpp"
#include "halfspace/fast/shade/scalars.hpp"
#include "halfspace/ref/depth_sort.hpp"
#include "halfspace/ref/oracle/look.hpp"
#include "halfspace/ref/oracle/painter.hpp"
#include "halfspace/ref/oracle/raycast.hpp"
#include "halfspace/ref/oracle/zbuffer.hpp"
#include "halfspace/ref/render.hpp"
#include "halfspace/ref/scalars.hpp"
#include "halfspace/ref/screens.hpp"
#include "halfspace/ref/shade.hpp"
#include "views.hpp"

namespace {

using namespace halfspace;

/// Numbers at corners, or one a polygon, on steps of the scale and between.
void expect_scalars(const SceneFile& view, const ItemImage& items,
                    const ItemImage& fine, std::int32_t samples,
                    std::uint64_t seed, const std::string& text) {
  ScalarField field;
  field.at_corners = seed % 3 != 0;
  for (std::size_t p = 0; p < view.scene.polygon_count(); ++p) {
    const auto id = static_cast<PolygonId>(p);
    const std::size_t count = view.scene.corners(id).size();
    for (std::size_t k = 0; k < (field.at_corners ? count : 1); ++k) {
      const std::uint64_t number = seed / 3 + 5 * p + (count == 3 ? 11 * k : 0);
      field.values.push_back(
          number % 17 == 0 ? kNoData : 0.25 * static_cast<double>(number % 13));
    }
  }
  ColorScale scale;
  scale.steps = {0.5, 0.75, 1 + 0x1p-40, 2};
  scale.colors = {
      {255, 0, 0}, {0, 255, 9}, {3, 3, 250}, {99, 98, 97}, {254, 253, 1}};
  if (seed % 2 == 0) scale.limits = ScaleLimits{0.25, 2.5, {1, 2, 3}};
  const auto prepared = fast::prepare_scalars(view.scene, field, scale);
  fast::ScalarOptions how;
  HALFSPACE_FUZZ_EXPECT(
      ref::color_scalars(view.scene, *view.camera, view.options, items, field,
                         scale) == fast::color_scalars(view.scene, *view.camera,
                                                       view.options, items,
                                                       prepared, how),
      text);
  how.samples = samples;
  HALFSPACE_FUZZ_EXPECT(
      ref::color_scalars(view.scene, *view.camera, view.options, fine, field,
                         scale, samples) ==
          fast::color_scalars(view.scene, *view.camera, view.options, fine,
                              prepared, how),
      text);
  // Blended in these colours: what covers a pixel is asked for all of them.
  Look look = {static_cast<std::uint8_t>(seed * 37 % 256)};
  if (seed % 2 == 0) look.samples = samples;
  HALFSPACE_FUZZ_EXPECT(
      ref::render_look(view.scene, ref::build(view.scene, {}), *view.camera,
                       view.options, look, field, scale)
              .colors ==
          fast::render_look(view.scene,
                            fast::build_display_tree(view.scene, {}),
                            *view.camera, view.options, look, {}, &prepared)
              .colors,
      text);
}

/// What is seen from behind, in a mark's colour.
void expect_marks(const SceneFile& view, const ItemImage& items,
                  const ColorImage& colors, std::uint64_t seed,
                  const std::string& text) {
  const Rgb mark = {static_cast<std::uint8_t>(seed),
                    static_cast<std::uint8_t>(seed * 7 + 3), 201};
  ColorImage marked = colors, fast_marked = colors;
  ref::mark_back_faces(view.scene, *view.camera, items, mark, marked);
  fast::mark_back_faces(view.scene, *view.camera, items, mark, 1, fast_marked);
  HALFSPACE_FUZZ_EXPECT(marked == fast_marked, text);
  const Look look = {static_cast<std::uint8_t>(seed % 3 == 0 ? 255 : seed * 91),
                     seed % 2 == 0 ? 1 : 2, mark};
  const auto expected = ref::render_look(view.scene, ref::build(view.scene, {}),
                                         *view.camera, view.options, look);
  const auto found =
      fast::render_look(view.scene, fast::build_display_tree(view.scene, {}),
                        *view.camera, view.options, look);
  HALFSPACE_FUZZ_EXPECT(found.items == expected.items, text);
  HALFSPACE_FUZZ_EXPECT(found.colors == expected.colors, text);
}

/// A view, its trees and its picture, which these agree on: spans of the
/// reference, spans and the painter of the fast library over two kinds of
/// trees, and the definition read pixel by pixel.
struct Tried {
  const BuildOptions options;
  const SceneFile view;
  const std::string text = write_scene(view);
  const ref::BspTree tree = ref::build(view.scene, options);
  const fast::BspTree other = fast::build(view.scene, options);
  fast::DisplayTreeOptions display;
  fast::RenderOptions portable;
  ItemImage items;
  ColorImage colors;

  Tried(const BuildOptions& the_options, SceneFile the_view)
      : options(the_options), view(std::move(the_view)) {
    display.leaf_size = options.candidates;
    display.own_planes = static_cast<std::size_t>(options.seed % 4);
    display.threads = 1;
    portable.simd = options.seed % 2 == 0 ? fast::SimdLevel::kPortable
                                          : fast::SimdLevel::kAvx2;
    expect_pictures();
  }

  void expect(const auto& rendering) const {
    HALFSPACE_FUZZ_EXPECT(rendering.items == items, text);
    HALFSPACE_FUZZ_EXPECT(rendering.colors == colors, text);
  }

 private:
  void expect_pictures();
};

void Tried::expect_pictures() {
  const auto span = ref::render(view.scene, tree, *view.camera, view.options);
  items = definition::item_image(view.scene, *view.camera, view.options);
  colors = definition::color_image(view.scene, *view.camera, view.options);
  expect(span);
  expect(fast::render(view.scene, other, *view.camera, view.options));
  expect(fast::paint(view.scene, other, *view.camera, view.options));
  expect(fast::render(view.scene, fast::build_display_tree(view.scene, display),
                      *view.camera, view.options, portable));
}

/// By the other three algorithms of the reference.
void expect_oracles(const Tried& tried) {
  const SceneFile& view = tried.view;
  tried.expect(ref::paint(view.scene, tried.tree, *view.camera, view.options));
  tried.expect(ref::zbuffer(view.scene, *view.camera, view.options));
  tried.expect(ref::raycast(view.scene, *view.camera, view.options));
}

/// Over a tree whose cells are made when they are looked at, and on screens of
/// other kinds.
void expect_feeds(const Tried& tried) {
  fast::LazyTreeOptions lazy;
  lazy.tree = tried.display;
  lazy.cell_size = 1 + static_cast<std::size_t>(tried.options.seed % 3);
  lazy.most_in_cell = 1 + static_cast<std::size_t>(tried.options.seed % 5);
  lazy.most_listed = 4;
  const fast::LazyTree opened(tried.view.scene, lazy);
  tried.expect(fast::render(opened, *tried.view.camera, tried.view.options,
                            tried.portable));
  tried.expect(fast::paint(opened, *tried.view.camera, tried.view.options));
  const auto screen = static_cast<ScreenKind>(tried.options.seed % 4);
  tried.expect(fast::render_on(tried.view.scene, tried.other,
                               *tried.view.camera, tried.view.options, screen));
  HALFSPACE_FUZZ_EXPECT(
      ref::render_on(tried.view.scene, tried.tree, *tried.view.camera,
                     tried.view.options, screen)
              .items == tried.items,
      tried.text);
}

/// By depth sort, of both libraries.
void expect_depth_sort(const Tried& tried) {
  const fast::BspTree list =
      fast::depth_sort(tried.view.scene, *tried.view.camera).list;
  tried.expect(fast::render(tried.view.scene, list, *tried.view.camera,
                            tried.view.options));
  tried.expect(fast::paint(tried.view.scene, list, *tried.view.camera,
                           tried.view.options));
  HALFSPACE_FUZZ_EXPECT(
      ref::render(tried.view.scene,
                  ref::depth_sort(tried.view.scene, *tried.view.camera).list,
                  *tried.view.camera, tried.view.options)
              .items == tried.items,
      tried.text);
}

/// Means of samples, colours of numbers and marks.
void expect_samples(const Tried& tried) {
  const std::int32_t samples = 2 << (tried.options.seed % 3);
  const auto means =
      ref::render_samples(tried.view.scene, tried.tree, *tried.view.camera,
                          tried.view.options, samples);
  const auto fast_means =
      fast::render_samples(tried.view.scene, tried.other, *tried.view.camera,
                           tried.view.options, samples, tried.portable);
  HALFSPACE_FUZZ_EXPECT(means.items == fast_means.items, tried.text);
  HALFSPACE_FUZZ_EXPECT(means.colors == fast_means.colors, tried.text);
  expect_scalars(tried.view, tried.items, means.items, samples,
                 tried.options.seed, tried.text);
  expect_marks(tried.view, tried.items, tried.colors, tried.options.seed,
               tried.text);
}

/// The same with clip planes, in planes of polygons and through corners.
void expect_sections(const Tried& tried, std::size_t size) {
  SceneFile cut = tried.view;
  for (std::size_t k = 0;
       k <= tried.options.seed % 3 && !tried.view.scene.data().vertices.empty();
       ++k) {
    const auto number = tried.options.seed * 7 + k * 5 + size;
    const auto& vertices = tried.view.scene.data().vertices;
    const GridPoint& p = vertices[number % vertices.size()];
    const Int128 normal[] = {static_cast<Int128>(number % 3) - 1,
                             static_cast<Int128>(number / 3 % 5) - 2,
                             static_cast<Int128>(number / 15 % 3) + (k % 2)};
    cut.options.clips.push_back(
        {normal[0], normal[1], normal[2] + 1,
         -(normal[0] * p.x + normal[1] * p.y + (normal[2] + 1) * p.z)});
  }
  cut.options.clips =
      *make_clips(cut.options.clips, tried.view.scene.grid_bits());
  if (bad_edges(cut.scene).empty()) {
    cut.options.caps = CapStyle{};
    if (cut.scene.polygon_count() % 2 == 0)
      cut.options.parts = told_apart(connected_parts(cut.scene), CapStyle{});
  }
  const std::string cut_text = write_scene(cut);
  const auto section = ref::zbuffer(cut.scene, *cut.camera, cut.options);
  const auto expect_section = [&](const auto& rendering) {
    HALFSPACE_FUZZ_EXPECT(rendering.items == section.items, cut_text);
    HALFSPACE_FUZZ_EXPECT(rendering.colors == section.colors, cut_text);
  };
  expect_section(ref::render(cut.scene, tried.tree, *cut.camera, cut.options));
  expect_section(
      fast::render(cut.scene, tried.other, *cut.camera, cut.options));
  expect_section(fast::paint(cut.scene, tried.other, *cut.camera, cut.options));
  expect_section(fast::render(
      cut.scene, fast::build_display_tree(cut.scene, tried.display),
      *cut.camera, cut.options, tried.portable));
  const std::int32_t samples = 2 << (tried.options.seed % 3);
  const auto cut_means = ref::render_samples(cut.scene, tried.tree, *cut.camera,
                                             cut.options, samples);
  const auto fast_cut_means =
      fast::render_samples(cut.scene, tried.other, *cut.camera, cut.options,
                           samples, tried.portable);
  HALFSPACE_FUZZ_EXPECT(cut_means.items == fast_cut_means.items, cut_text);
  HALFSPACE_FUZZ_EXPECT(cut_means.colors == fast_cut_means.colors, cut_text);
  const auto cut_read = read_scene(cut_text);
  HALFSPACE_FUZZ_EXPECT(cut_read.has_value() && *cut_read == cut, cut_text);
}

}  // namespace

/// What Tried is, and one of five others: a corpus is replayed with all.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  using namespace halfspace;
  fuzz::Bytes bytes(data, size);
  const BuildOptions options = fuzz::build_options_of(bytes);
  const Tried tried(options, fuzz::view_of(bytes));
  // What the number decides by its remainders comes up with each of these.
  const auto part = options.seed / 12 % 5;
  if (fuzz::kReplays || part == 0) expect_feeds(tried);
  if (fuzz::kReplays || part == 1) expect_samples(tried);
  if (fuzz::kReplays || part == 2) expect_sections(tried, size);
  if (fuzz::kReplays || part == 3) expect_oracles(tried);
  if (fuzz::kReplays || part == 4) expect_depth_sort(tried);
  // The scene file says it all: what it holds gives the image again.
  const auto read = read_scene(tried.text);
  HALFSPACE_FUZZ_EXPECT(read.has_value() && *read == tried.view, tried.text);
  return 0;
}
