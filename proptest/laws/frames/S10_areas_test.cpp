#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <vector>

#include "adapters/both.hpp"
#include "generate/clip_planes.hpp"
#include "halfspace/cap_parts.hpp"
#include "halfspace/fast/area_image.hpp"
#include "halfspace/fast/visible_map.hpp"
#include "halfspace/ref/area_image.hpp"
#include "halfspace/ref/visible_map.hpp"
#include "halfspace/splitmix.hpp"
#include "laws/frames/cap_looks.hpp"
#include "laws/law.hpp"
#include "laws/map/map_arcs.hpp"

/// Laws of exact areas of sections, and of their maps (S10.5).
namespace halfspace {
namespace {

constexpr int kAreaViews = 160;

/// What the reference's map takes up to a second for.
constexpr std::size_t kMostPolygons = 18;

/// Where one coordinate is `at`; what is beyond that is kept if `side` is 1.
struct AxisCut {
  std::size_t axis = 0;
  std::int64_t at = 0;
  std::int64_t side = 1;
};

using Coordinates = std::array<std::int64_t, 3>;

Coordinates of_point(const GridPoint& p) { return {p.x, p.y, p.z}; }

/// Polygons under way to a scene.
struct Pieces {
  SceneData data;
  std::map<Coordinates, VertexId> known;

  void corner(const Coordinates& p) {
    const auto next = static_cast<VertexId>(data.vertices.size());
    const auto [found, is_new] = known.try_emplace(p, next);
    if (is_new) data.vertices.push_back({p[0], p[1], p[2]});
    data.corners.push_back(found->second);
  }
  void close(const Rgb& color) {
    data.first_corner.push_back(
        static_cast<std::uint32_t>(data.corners.size()));
    data.colors.push_back(color);
  }
};

/// Adds what the cut leaves of a polygon; false if that is not on the grid.
bool add_cut(const Scene& scene, PolygonId id, const AxisCut& cut,
             Pieces& pieces) {
  std::vector<Coordinates> left;
  bool some_kept = false;
  const auto corners = scene.corners(id);
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Coordinates p = of_point(scene.point(corners[k]));
    const Coordinates q =
        of_point(scene.point(corners[(k + 1) % corners.size()]));
    const std::int64_t at_p = cut.side * (p[cut.axis] - cut.at);
    const std::int64_t at_q = cut.side * (q[cut.axis] - cut.at);
    if (at_p >= 0) left.push_back(p);
    some_kept = some_kept || at_p > 0;
    if ((at_p < 0 && at_q > 0) || (at_p > 0 && at_q < 0)) {
      Coordinates between{};
      for (std::size_t a = 0; a < 3; ++a) {
        const auto above = Int128{at_p} * q[a] - Int128{at_q} * p[a];
        const auto below = Int128{at_p} - at_q;
        if (above % below != 0) return false;
        between[a] = static_cast<std::int64_t>(above / below);
      }
      left.push_back(between);
    }
  }
  if (!some_kept) return true;
  for (const Coordinates& p : left) pieces.corner(p);
  pieces.close(scene.color(id));
  return true;
}

/// Adds the cap: the rectangles between all coordinates of the scene in which
/// the winding number is positive, facing what is removed.
void add_cap(const Scene& scene, const AxisCut& cut, const Rgb& color,
             Pieces& pieces) {
  const std::size_t u = (cut.axis + 1) % 3;
  const std::size_t v = (cut.axis + 2) % 3;
  std::array<std::vector<std::int64_t>, 3> at;
  for (const GridPoint& p : scene.data().vertices) {
    for (std::size_t a = 0; a < 3; ++a) at[a].push_back(of_point(p)[a]);
  }
  for (auto& list : at) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  std::vector<definition::Facet> facets;
  for (const PolygonId id : ids_of(scene))
    facets.push_back(definition::facet_of(scene, definition::whole(scene, id)));
  for (std::size_t i = 0; i + 1 < at[u].size(); ++i) {
    for (std::size_t j = 0; j + 1 < at[v].size(); ++j) {
      std::array<definition::Integer, 3> middle;
      middle[u] = 2 * (definition::Integer(at[u][i]) + at[u][i + 1]);
      middle[v] = 2 * (definition::Integer(at[v][j]) + at[v][j + 1]);
      middle[cut.axis] = 4 * definition::Integer(cut.at) + cut.side;
      if (definition::winding(facets, {middle[0], middle[1], middle[2], 4}) <=
          0)
        continue;
      // Counterclockwise seen from above the axis, or from below.
      std::array<std::array<std::size_t, 2>, 4> ring = {
          {{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
      if (cut.side > 0) std::reverse(ring.begin(), ring.end());
      for (const auto& [a, b] : ring) {
        Coordinates p{};
        p[cut.axis] = cut.at;
        p[u] = at[u][i + a];
        p[v] = at[v][j + b];
        pieces.corner(p);
      }
      pieces.close(color);
    }
  }
}

/// Boxes are closed scenes whose cuts across axes are on the grid.
bool is_of_boxes(const Scene& scene) {
  for (const PolygonId id : ids_of(scene)) {
    const auto corners = scene.corners(id);
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Coordinates p = of_point(scene.point(corners[k]));
      const Coordinates q =
          of_point(scene.point(corners[(k + 1) % corners.size()]));
      const auto same =
          int{p[0] == q[0]} + int{p[1] == q[1]} + int{p[2] == q[2]};
      if (same != 2) return false;
    }
  }
  return scene.polygon_count() != 0 && bad_edges(scene).empty();
}

std::uint64_t section_number_of(const SceneFile& view) {
  std::uint64_t number = 0;
  for (const GridPoint& p : view.scene.data().vertices)
    number = mix(number + static_cast<std::uint64_t>(p.x + 3 * p.y + 7 * p.z));
  return number;
}

/// A cut across an axis at a coordinate of the scene, or next to one.
AxisCut cut_of(const SceneFile& view) {
  const std::uint64_t number = section_number_of(view);
  const auto& vertices = view.scene.data().vertices;
  AxisCut cut;
  cut.axis = number % 3;
  cut.side = number / 3 % 2 == 0 ? 1 : -1;
  const auto k = mix(number) % vertices.size();
  cut.at = of_point(vertices[k])[cut.axis] +
           static_cast<std::int64_t>(mix(number + 1) % 3) - 1;
  return cut;
}

ClipPlane clip_of(const AxisCut& cut) {
  ClipPlane clip;
  (cut.axis == 0 ? clip.a : cut.axis == 1 ? clip.b : clip.c) = cut.side;
  clip.d = -Int128{cut.side} * cut.at;
  return clip;
}

ColorImage fast_areas(const SceneFile& view) {
  return fast::render_area(view.scene, fast::build(view.scene, {}),
                           *view.camera, view.options,
                           1 + static_cast<int>(section_number_of(view) % 3))
      .colors;
}

struct RefSectionAreas {
  static ColorImage areas(const SceneFile& view) {
    return ref::render_area(view.scene, *view.camera, view.options);
  }
};
struct FastSectionAreas {
  static ColorImage areas(const SceneFile& view) { return fast_areas(view); }
};

template <class Impl>
class S10Areas : public ::testing::Test {};
using AreaImplementations = ::testing::Types<RefSectionAreas, FastSectionAreas>;
TYPED_TEST_SUITE(S10Areas, AreaImplementations);

generate::Views solid_views() {
  return rc::gen::oneOf(generate::nested_solids(), generate::touching_solids());
}

TYPED_TEST(S10Areas, L6AreasAreThoseOfTheSceneCutBeforehand) {
  std::size_t capped = 0;
  law::for_all(solid_views(), kAreaViews, [&](const SceneFile& whole) {
    if (!is_of_boxes(whole.scene)) return;
    SceneFile view = whole;
    view.options.shading = Shading::kFlat;
    const AxisCut cut = cut_of(view);
    const CapStyle style{{9, 208, 77}, std::nullopt};
    Pieces pieces;
    pieces.data.unit = view.scene.unit();
    pieces.data.grid_bits = view.scene.grid_bits();
    for (const PolygonId id : ids_of(view.scene)) {
      if (!add_cut(view.scene, id, cut, pieces)) return;
    }
    const std::size_t open = pieces.data.colors.size();
    add_cap(view.scene, cut, style.color, pieces);
    const bool has_cap = pieces.data.colors.size() > open;
    const auto made = make_scene(std::move(pieces.data));
    if (!made) return;  // a part is too thin for the grid
    SceneFile beforehand = view;
    beforehand.scene = *made;
    view.options.clips = {clip_of(cut)};
    view.options.caps = style;
    HALFSPACE_LAW(TypeParam::areas(view) == fast_areas(beforehand));
    capped += has_cap ? 1u : 0u;
  });
  EXPECT_GT(capped, 15u);
}

/// The view with planes that cut it, and caps in three of four; nothing of
/// scenes that are open, empty or too large.
std::optional<SceneFile> section_of(const SceneFile& whole,
                                    std::size_t most_polygons) {
  if (whole.scene.polygon_count() == 0 ||
      whole.scene.polygon_count() > most_polygons ||
      !bad_edges(whole.scene).empty())
    return std::nullopt;
  SceneFile view = whole;
  const std::uint64_t number = section_number_of(view);
  view.options.clips =
      generate::clip_planes(view.scene, number, 1 + number % 3);
  if (view.options.clips.empty()) return std::nullopt;
  if (number % 4 != 0)
    view.options.caps = CapStyle{{9, 208, 77}, Rgb{200, 1, 100}};
  if (number % 4 == 2) tell_parts_apart(view);
  return view;
}

class S10AreasAgree : public ::testing::Test {};

TEST_F(S10AreasAgree, L6BothLibrariesGiveOneImage) {
  std::size_t changed = 0;
  law::for_all(solid_views(), 2 * kAreaViews, [&](const SceneFile& whole) {
    const std::optional<SceneFile> view = section_of(whole, kMostPolygons);
    if (!view) return;
    const ColorImage image = fast_areas(*view);
    HALFSPACE_LAW(image ==
                  ref::render_area(view->scene, *view->camera, view->options));
    SceneFile open = *view;
    open.options.caps = std::nullopt;
    changed += image != fast_areas(open) ? 1u : 0u;
  });
  EXPECT_GT(changed, 8u);
}

TEST_F(S10AreasAgree, L6BothLibrariesTellPartsApart) {
  std::size_t of_several = 0;
  for (std::uint64_t number = 0; number < 5; ++number) {
    SceneFile view = cut_boxes(number, 2, 6, 5);
    tell_parts_apart(view);
    const ColorImage image = fast_areas(view);
    ASSERT_EQ(image.pixels,
              ref::render_area(view.scene, *view.camera, view.options).pixels)
        << number;
    const ItemImage items =
        oracle::zbuffer(view.scene, *view.camera, view.options).items;
    const auto several =
        static_cast<PolygonId>(view.scene.polygon_count() + 32);
    of_several += static_cast<std::size_t>(
        std::count(items.pixels.begin(), items.pixels.end(), several));
  }
  EXPECT_GT(of_several, 2u);
}

struct RefSectionMap {
  static constexpr std::size_t kMost = kMostPolygons;
  static map_arcs::Arcs arcs_of(const SceneFile& view) {
    return map_arcs::exact_arcs(
        ref::section_map(view.scene, *view.camera, view.options));
  }
};
struct FastSectionMap {
  static constexpr std::size_t kMost = 1000;
  static map_arcs::Arcs arcs_of(const SceneFile& view) {
    const auto map =
        fast::section_map(view.scene, fast::build(view.scene, {}), *view.camera,
                          {view.options.cull, {}}, view.options);
    HALFSPACE_LAW(map.has_value());
    return map_arcs::exact_arcs(*map);
  }
};

template <class Impl>
class S10SectionMap : public ::testing::Test {};
using SectionMaps = ::testing::Types<RefSectionMap, FastSectionMap>;
TYPED_TEST_SUITE(S10SectionMap, SectionMaps);

TYPED_TEST(S10SectionMap, L7SamplesLieInTheRegionOfTheirItem) {
  std::size_t capped = 0;
  std::size_t hatched = 0;
  law::for_all(solid_views(), 2 * kAreaViews, [&](const SceneFile& whole) {
    const auto view = section_of(whole, TypeParam::kMost);
    if (!view) return;
    const auto arcs = TypeParam::arcs_of(*view);
    const Image image =
        oracle::zbuffer(view->scene, *view->camera, view->options);
    const auto count = static_cast<PolygonId>(view->scene.polygon_count());
    for (std::int32_t j = 0; j < image.items.height_px; ++j) {
      for (std::int32_t i = 0; i < image.items.width_px; ++i) {
        PolygonId key = image.items.at(i, j);
        if (key >= count) {
          ++capped;
          const auto beyond = static_cast<std::size_t>(key - count);
          const Rgb color = stripe_color(view->options, beyond, i, j, 1);
          const CapItem cap = cap_item(beyond);
          const auto& hatch = style_of(view->options, cap).hatch;
          if (color == hatch) {
            ++hatched;
            key += PolygonId{kMostClipPlanes};
          }
        }
        HALFSPACE_LAW(map_arcs::key_at(arcs, i, j) == key);
      }
    }
  });
  EXPECT_GT(hatched, 4u);
  EXPECT_GT(capped, 2 * hatched);
}

}  // namespace
}  // namespace halfspace
