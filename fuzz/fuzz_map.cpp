#include <cmath>

#include "fuzz.hpp"
#include "halfspace/boolean.hpp"
#include "halfspace/cap_parts.hpp"
#include "halfspace/fast/area_image.hpp"
#include "halfspace/fast/build.hpp"
#include "halfspace/fast/display_tree.hpp"
#include "halfspace/fast/image/seen_areas.hpp"
#include "halfspace/fast/image/transparent_map.hpp"
#include "halfspace/fast/visible_map.hpp"
#include "halfspace/ref/area_image.hpp"
#include "halfspace/ref/seen_areas.hpp"
#include "halfspace/ref/visible_map.hpp"
#include "views.hpp"

namespace halfspace {
namespace {

/// The reference cuts all lines by all lines: beyond so many polygons that
/// takes too long, and two trees of the fast library are compared alone.
constexpr std::size_t kMostPolygonsOfRef = 9;

void expect_same(const fast::VisibleMap& map,
                 const std::vector<ref::MapArc>& arcs,
                 const std::string& text) {
  HALFSPACE_FUZZ_EXPECT(map.arcs.size() == arcs.size(), text);
  const auto key_of = [&](std::int32_t region) {
    return region < 0 ? kOutsideKey
                      : map.regions[static_cast<std::size_t>(region)].key;
  };
  for (std::size_t k = 0; k < arcs.size(); ++k) {
    const auto is_at = [&](std::int32_t v, const ref::ImagePoint& p) {
      const fast::MapVertex& vertex = map.vertices[static_cast<std::size_t>(v)];
      return vertex.x == nearest_double(p.x) && vertex.y == nearest_double(p.y);
    };
    HALFSPACE_FUZZ_EXPECT(is_at(map.arcs[k].from, arcs[k].from), text);
    HALFSPACE_FUZZ_EXPECT(is_at(map.arcs[k].to, arcs[k].to), text);
    HALFSPACE_FUZZ_EXPECT(key_of(map.arcs[k].left) == arcs[k].left, text);
    HALFSPACE_FUZZ_EXPECT(key_of(map.arcs[k].right) == arcs[k].right, text);
  }
}

void expect_same_areas(const std::vector<fast::SeenArea>& areas,
                       const std::vector<ref::SeenArea>& expected,
                       const std::string& text) {
  HALFSPACE_FUZZ_EXPECT(areas.size() == expected.size(), text);
  for (std::size_t k = 0; k < areas.size(); ++k) {
    HALFSPACE_FUZZ_EXPECT(areas[k].key == expected[k].key, text);
    HALFSPACE_FUZZ_EXPECT(
        areas[k].area_px == nearest_double(expected[k].area_px), text);
    HALFSPACE_FUZZ_EXPECT(
        std::abs(areas[k].solid_angle - expected[k].solid_angle) < 1e-14, text);
  }
}

/// One alpha a polygon, by a number.
TransparentOptions own_alphas(const SceneFile& view, std::size_t number) {
  TransparentOptions options = {view.options.cull, kOpaque,
                                view.options.background};
  for (std::size_t p = 0; p < view.scene.polygon_count(); ++p)
    options.alphas.push_back(
        static_cast<std::uint8_t>(67 * (p + 1) * (number + 1)));
  return options;
}

}  // namespace
}  // namespace halfspace

/// The visible map is the same by the reference and over trees of two kinds:
/// arcs, keys and the nearest doubles to its vertices.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  using namespace halfspace;
  fuzz::Bytes bytes(data, size);
  const BuildOptions build = fuzz::build_options_of(bytes);
  const SceneFile view = fuzz::view_of(bytes);
  const std::string text = write_scene(view);
  const MapOptions options = {view.options.cull, {}};
  const auto map = fast::visible_map(view.scene, fast::build(view.scene, build),
                                     *view.camera, options);
  HALFSPACE_FUZZ_EXPECT(map.has_value(), text);
  fast::DisplayTreeOptions display;
  display.leaf_size = build.candidates;
  display.threads = 1;
  const fast::BspTree leaves = fast::build_display_tree(view.scene, display);
  const auto other =
      fast::visible_map(view.scene, leaves, *view.camera, options);
  HALFSPACE_FUZZ_EXPECT(other.has_value(), text);
  HALFSPACE_FUZZ_EXPECT(map->arcs == other->arcs, text);
  HALFSPACE_FUZZ_EXPECT(map->regions == other->regions, text);
  HALFSPACE_FUZZ_EXPECT(map->corners == other->corners, text);
  if (view.scene.polygon_count() <= kMostPolygonsOfRef) {
    const auto arcs = ref::visible_map(view.scene, *view.camera, options);
    expect_same(*map, arcs, text);
    expect_same_areas(fast::seen_areas(*map, *view.camera),
                      ref::seen_areas(arcs, *view.camera), text);
    const auto areas =
        fast::render_area(view.scene, leaves, *view.camera, view.options, 2);
    HALFSPACE_FUZZ_EXPECT(
        areas.colors ==
            ref::render_area(view.scene, *view.camera, view.options),
        text);
    fast::BspTree divided = leaves;
    fast::divide_leaves(divided, view.scene);
    const TransparentOptions glass = own_alphas(view, size);
    const auto composed =
        fast::transparent_map(view.scene, divided, *view.camera, glass);
    HALFSPACE_FUZZ_EXPECT(composed.has_value(), text);
    expect_same(*composed,
                ref::transparent_map(view.scene, *view.camera, glass), text);
    SceneFile cut = view;
    cut.options.clips = *make_clips({fuzz::plane_at_a_corner(view, size)},
                                    view.scene.grid_bits());
    if (bad_edges(cut.scene).empty()) {
      cut.options.caps =
          CapStyle{{200, 80, 40},
                   size % 2 == 0 ? std::optional(Rgb{1, 2, 3}) : std::nullopt};
      if (size % 4 < 2) {
        cut.options.parts =
            told_apart(connected_parts(cut.scene), *cut.options.caps);
      }
    }
    const auto left =
        fast::render_area(cut.scene, divided, *cut.camera, cut.options);
    const auto section = fast::section_map(cut.scene, divided, *cut.camera,
                                           options, cut.options);
    HALFSPACE_FUZZ_EXPECT(section.has_value(), write_scene(cut));
    expect_same(*section, ref::section_map(cut.scene, *cut.camera, cut.options),
                write_scene(cut));
    const auto cut_glass = fast::transparent_section(
        cut.scene, divided, *cut.camera, glass, cut.options);
    HALFSPACE_FUZZ_EXPECT(cut_glass.has_value(), write_scene(cut));
    expect_same(
        *cut_glass,
        ref::transparent_section(cut.scene, *cut.camera, glass, cut.options),
        write_scene(cut));
    HALFSPACE_FUZZ_EXPECT(
        left.colors == ref::render_area(cut.scene, *cut.camera, cut.options),
        write_scene(cut));
  }
  return 0;
}
