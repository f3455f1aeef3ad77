#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>
#include <vector>

#include "adapters/both.hpp"
#include "adapters/scenes.hpp"
#include "generate/clip_planes.hpp"
#include "halfspace/boolean.hpp"
#include "halfspace/fast/drawing.hpp"
#include "halfspace/ref/drawing.hpp"
#include "halfspace/ref/visible_map.hpp"
#include "halfspace/splitmix.hpp"
#include "laws/law.hpp"

/// Laws of drawings of sections (S9.8).
namespace halfspace::section_drawings {
namespace {

constexpr int kSections = 200;

/// What the reference's drawing takes up to a second for.
constexpr std::size_t kMostPolygons = 18;

/// A part of a drawing, with the nearest doubles to its ends, the lower one
/// first.
using Part = std::tuple<double, double, double, double, EdgeClass, int>;

Part part_of(EdgeClass edge_class, std::int32_t layers,
             std::array<double, 2> from, std::array<double, 2> to) {
  if (to < from) std::swap(from, to);
  return {from[0], from[1], to[0], to[1], edge_class, layers};
}

struct Parts {
  std::vector<Part> intervals;
  std::vector<Part> strokes;
  std::vector<std::pair<double, double>> shares;
  void sort() {
    std::sort(intervals.begin(), intervals.end());
    std::sort(strokes.begin(), strokes.end());
    std::sort(shares.begin(), shares.end());
  }
  friend bool operator==(const Parts&, const Parts&) = default;
};

struct RefSections {
  static Parts draw(const SceneFile& view, const DrawingOptions& options) {
    const auto spot = [](const ref::ImagePoint& p) {
      return std::array{nearest_double(p.x), nearest_double(p.y)};
    };
    const ref::Drawing drawing = ref::draw(view.scene, *view.camera, options);
    Parts parts;
    for (const ref::DrawnInterval& i : drawing.intervals) {
      parts.intervals.push_back(
          part_of(i.edge_class, i.layers, spot(i.from), spot(i.to)));
      if (i.edge_class != EdgeClass::kIntersection)
        parts.shares.emplace_back(nearest_double(i.from_share),
                                  nearest_double(i.to_share));
    }
    for (const ref::DrawnStroke& s : drawing.strokes)
      parts.strokes.push_back(
          part_of(s.edge_class, s.layers, spot(s.from), spot(s.to)));
    parts.sort();
    return parts;
  }
};

struct FastSections {
  static Parts draw(const SceneFile& view, const DrawingOptions& options) {
    const auto drawing = fast::draw(view.scene, *view.camera, options);
    HALFSPACE_LAW(drawing.has_value());
    const auto spot = [](const fast::DrawingPoint& p) {
      return std::array{p.x, p.y};
    };
    Parts parts;
    for (const fast::EdgeInterval& i : drawing->intervals) {
      const EdgeClass edge_class =
          drawing->edges[static_cast<std::size_t>(i.edge)].edge_class;
      parts.intervals.push_back(
          part_of(edge_class, i.layers, spot(i.from), spot(i.to)));
      if (edge_class != EdgeClass::kIntersection)
        parts.shares.emplace_back(i.from_share, i.to_share);
    }
    for (const fast::Stroke& s : drawing->strokes)
      parts.strokes.push_back(
          part_of(s.edge_class, s.layers, spot(s.from), spot(s.to)));
    parts.sort();
    return parts;
  }
};

std::uint64_t number_of(const SceneFile& view) {
  std::uint64_t sum = 11;
  for (const GridPoint& p : view.scene.data().vertices)
    sum = 31 * sum + static_cast<std::uint64_t>(p.x + 3 * p.y + 7 * p.z);
  return mix(sum);
}

/// The view with planes through corners or beside them, and a cap where that
/// can be. Nothing of scenes that are empty or too large.
std::optional<SceneFile> section_of(const SceneFile& whole) {
  const Scene& scene = whole.scene;
  if (scene.polygon_count() == 0 || scene.polygon_count() > kMostPolygons)
    return std::nullopt;
  const std::uint64_t number = number_of(whole);
  SceneFile view = whole;
  view.options.caps = std::nullopt;
  if (bad_edges(scene).empty() && number % 4 != 0)
    view.options.caps = CapStyle{{9, 208, 77}, std::nullopt};
  view.options.clips = generate::clip_planes(
      scene, number, view.options.caps ? 1 : 1 + number % 2);
  if (view.options.clips.empty()) return std::nullopt;
  return view;
}

DrawingOptions options_of(const SceneFile& view) {
  DrawingOptions options;
  options.cull = view.options.cull;
  options.clips = view.options.clips;
  options.caps = view.options.caps.has_value();
  return options;
}

generate::Views section_views() {
  return rc::gen::oneOf(generate::views(), generate::nested_solids(),
                        generate::touching_solids());
}

template <class Impl>
class S9Sections : public ::testing::Test {};
using SectionDrawings = ::testing::Types<RefSections, FastSections>;
TYPED_TEST_SUITE(S9Sections, SectionDrawings);

double distance(const std::array<double, 2>& p, const Part& s) {
  const auto& [x0, y0, x1, y1, edge_class, layers] = s;
  const double length = std::hypot(x1 - x0, y1 - y0);
  if (length == 0) return std::hypot(p[0] - x0, p[1] - y0);
  const double along = std::clamp(
      ((p[0] - x0) * (x1 - x0) + (p[1] - y0) * (y1 - y0)) / (length * length),
      0.0, 1.0);
  return std::hypot(p[0] - x0 - along * (x1 - x0),
                    p[1] - y0 - along * (y1 - y0));
}

TYPED_TEST(S9Sections, L7BordersOfTheSectionsMapAreDrawn) {
  constexpr double kNear = 1e-6;  // pixels: far more than doubles move a spot
  std::size_t arcs = 0;
  std::size_t capped = 0;
  law::for_all(section_views(), 3 * kSections / 4, [&](const SceneFile& whole) {
    const auto view = section_of(whole);
    if (!view || (*view->camera)->near) return;
    const auto planes = fast::intern_planes(view->scene).plane_of;
    const auto count = static_cast<std::int32_t>(planes.size());
    const auto plane_of = [&](std::int32_t key) {
      return key < 0 || key >= count ? -1 - key
                                     : planes[static_cast<std::size_t>(key)];
    };
    const Parts parts = TypeParam::draw(*view, options_of(*view));
    for (const ref::MapArc& arc :
         ref::section_map(view->scene, *view->camera, view->options)) {
      if (arc.left == kOutsideKey || arc.right == kOutsideKey ||
          plane_of(arc.left) == plane_of(arc.right))
        continue;
      const std::array<double, 2> from = {nearest_double(arc.from.x),
                                          nearest_double(arc.from.y)};
      const std::array<double, 2> to = {nearest_double(arc.to.x),
                                        nearest_double(arc.to.y)};
      for (const double share : {0.21, 0.5, 0.83}) {
        const std::array<double, 2> p = {from[0] + share * (to[0] - from[0]),
                                         from[1] + share * (to[1] - from[1])};
        HALFSPACE_LAW(std::any_of(
            parts.strokes.begin(), parts.strokes.end(), [&](const Part& s) {
              return std::get<5>(s) == 0 && distance(p, s) < kNear;
            }));
      }
      ++arcs;
      if (arc.left >= count || arc.right >= count) ++capped;
    }
  });
  EXPECT_GT(arcs, 100u);
  EXPECT_GT(capped, 4u);
}

TEST(S9SectionsAgree, RefAndFastDrawTheSameSections) {
  std::size_t hidden_by_caps = 0;
  law::for_all(section_views(), 4 * kSections, [&](const SceneFile& whole) {
    const auto view = section_of(whole);
    if (!view) return;
    DrawingOptions options = options_of(*view);
    const auto& vertices = view->scene.data().vertices;
    options.lines.push_back({vertices.front(), vertices.back()});
    const Parts f = FastSections::draw(*view, options);
    HALFSPACE_LAW(f == RefSections::draw(*view, options));
    options.caps = false;
    if (view->options.caps &&
        f.intervals != FastSections::draw(*view, options).intervals)
      ++hidden_by_caps;
  });
  EXPECT_GT(hidden_by_caps, 10u);
}

}  // namespace
}  // namespace halfspace::section_drawings
