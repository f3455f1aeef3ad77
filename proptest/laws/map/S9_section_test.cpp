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
#include "generate/random_scenes.hpp"
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

/// Whether the caps of two planes meet somewhere in a drawing.
bool have_corners(const SceneFile& view, const DrawingOptions& options) {
  const auto drawing = fast::draw(view.scene, *view.camera, options);
  HALFSPACE_LAW(drawing.has_value());
  return std::any_of(
      drawing->intervals.begin(), drawing->intervals.end(),
      [&](const fast::EdgeInterval& i) {
        const auto& edge = drawing->edges[static_cast<std::size_t>(i.edge)];
        return edge.edge_class == EdgeClass::kSection && edge.polygon < 0;
      });
}

std::uint64_t number_of(const SceneFile& view) {
  std::uint64_t sum = 11;
  for (const GridPoint& p : view.scene.data().vertices)
    sum = 31 * sum + static_cast<std::uint64_t>(p.x + 3 * p.y + 7 * p.z);
  return mix(sum);
}

/// Turns planes over that the eye is on the positive side of, so that it looks
/// at their caps.
void turn_to_eye(const CameraData& camera, std::vector<ClipPlane>& planes) {
  for (ClipPlane& plane : planes) {
    const auto along = [](Int128 a, Int128 b) {
      return static_cast<double>(a) * static_cast<double>(b);
    };
    const double value =
        along(plane.a, camera.eye.x) + along(plane.b, camera.eye.y) +
        along(plane.c, camera.eye.z) +
        (camera.perspective ? along(plane.d, 1 << kLatticeBits) : 0);
    if (value > 0) plane = {-plane.a, -plane.b, -plane.c, -plane.d};
  }
}

/// Moves planes so that they pass through one corner.
void move_to(const GridPoint& p, int grid_bits,
             std::vector<ClipPlane>& planes) {
  for (ClipPlane& plane : planes)
    plane.d = -(plane.a * p.x + plane.b * p.y + plane.c * p.z);
  auto made = make_clips(planes, grid_bits);
  HALFSPACE_LAW(made.has_value());
  planes = std::move(*made);
}

/// The view with planes through corners or beside them, and caps where they
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
  view.options.clips = generate::clip_planes(scene, number, 1 + number / 4 % 3);
  if (number / 32 % 2 == 0)
    move_to(scene.data().vertices[number / 64 % scene.data().vertices.size()],
            scene.grid_bits(), view.options.clips);
  if (view.options.clips.empty()) return std::nullopt;
  if (number / 16 % 2 == 0)
    turn_to_eye(view.camera->data(), view.options.clips);
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

/// A cube from -10 to 10, of which three planes through its centre leave the
/// eighth that is farthest from a parallel eye.
SceneFile cut_cube() {
  SceneData data;
  for (const std::int64_t z : {-10, 10}) {
    for (const std::int64_t y : {-10, 10}) {
      for (const std::int64_t x : {-10, 10}) data.vertices.push_back({x, y, z});
    }
  }
  data.corners = {0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4,
                  2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5};
  for (std::uint32_t k = 1; k <= 6; ++k) {
    data.first_corner.push_back(4 * k);
    data.colors.push_back({1, 2, 3});
  }
  SceneFile view;
  view.scene = *make_scene(std::move(data));
  CameraData camera;
  camera.perspective = false;
  camera.eye = {256, 256, 256};
  camera.sx = {64, -64, 0};
  camera.sy = {32, 32, -64};
  camera.s0 = {-32 * 96, 32 * 32, 32 * 64};
  camera.width_px = 64;
  camera.height_px = 64;
  view.camera = *make_camera(camera, view.scene.grid_bits());
  view.options.clips = {{-1, 0, 0, 0}, {0, -1, 0, 0}, {0, 0, -1, 0}};
  view.options.caps = CapStyle{{9, 208, 77}, std::nullopt};
  return view;
}

TYPED_TEST(S9Sections, ThreeCapsMeetInThreeEdges) {
  const SceneFile view = cut_cube();
  const Parts parts = TypeParam::draw(view, options_of(view));
  const std::array<double, 2> middle = {32, 32};
  std::size_t sections = 0;
  for (const Part& stroke : parts.strokes)
    if (std::get<4>(stroke) == EdgeClass::kSection) ++sections;
  EXPECT_EQ(sections, 9u);
  // The images of (-10, 0, 0), (0, -10, 0) and (0, 0, -10).
  const std::array<std::array<double, 2>, 3> ends = {
      {{12, 32 - 40.0 / 3}, {52, 32 - 40.0 / 3}, {32, 32 + 80.0 / 3}}};
  for (const std::array<double, 2>& end : ends) {
    EXPECT_TRUE(std::any_of(
        parts.strokes.begin(), parts.strokes.end(), [&](const Part& s) {
          return std::get<4>(s) == EdgeClass::kSection && std::get<5>(s) == 0 &&
                 distance(middle, s) < 1e-9 && distance(end, s) < 1e-9 &&
                 std::hypot(std::get<2>(s) - std::get<0>(s),
                            std::get<3>(s) - std::get<1>(s)) < 27;
        }));
  }
}

TYPED_TEST(S9Sections, AThirdPlaneThroughTheLineOfTwoTakesAllOrNothing) {
  SceneFile view = cut_cube();
  view.options.clips = {{-1, 0, 0, 0}, {0, -1, 0, 0}};
  const Parts of_two = TypeParam::draw(view, options_of(view));
  view.options.clips = {{-1, 0, 0, 0}, {-1, -1, 0, 0}, {0, -1, 0, 0}};
  EXPECT_EQ(TypeParam::draw(view, options_of(view)).strokes, of_two.strokes);
  view.options.clips = {{-1, 0, 0, 0}, {0, -1, 0, 0}, {1, 1, 0, 0}};
  EXPECT_TRUE(TypeParam::draw(view, options_of(view)).intervals.empty());
}

/// Two tetrahedra with corners all over the widest grid, facing outwards.
SceneFile wide_solids(agree::Draws& draws) {
  constexpr std::int64_t kSize = (std::int64_t{1} << 53) - 1;
  SceneData data;
  data.grid_bits = 54;
  const auto draw = [&] { return draws.from_to(-kSize, kSize); };
  for (VertexId first = 0; first < 8; first += 4) {
    std::array<GridPoint, 4> p;
    for (GridPoint& q : p) q = {draw(), draw(), draw()};
    const auto along = [&](std::size_t k) {
      return std::array{static_cast<double>(p[k].x - p[0].x),
                        static_cast<double>(p[k].y - p[0].y),
                        static_cast<double>(p[k].z - p[0].z)};
    };
    const auto [a, b, c] = std::tuple{along(1), along(2), along(3)};
    const double volume = a[0] * (b[1] * c[2] - b[2] * c[1]) +
                          a[1] * (b[2] * c[0] - b[0] * c[2]) +
                          a[2] * (b[0] * c[1] - b[1] * c[0]);
    if (volume > 0) std::swap(p[2], p[3]);
    data.vertices.insert(data.vertices.end(), p.begin(), p.end());
    for (const VertexId v : {0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2})
      data.corners.push_back(first + v);
    for (int k = 0; k < 4; ++k) {
      data.first_corner.push_back(data.first_corner.back() + 3);
      data.colors.push_back({1, 2, 3});
    }
  }
  SceneFile view;
  auto scene = make_scene(std::move(data));
  HALFSPACE_LAW(scene.has_value());
  view.scene = std::move(*scene);
  view.camera =
      agree::random_camera(agree::Kind::kWide, view.scene, 24, 16, draws);
  view.options.clips =
      generate::clip_planes(view.scene, draws.next(), 2 + draws.next() % 2);
  view.options.caps = CapStyle{{9, 208, 77}, std::nullopt};
  turn_to_eye(view.camera->data(), view.options.clips);
  view.options.cull = draws.one_in(3);
  return view;
}

TEST(S9SectionsAgree, RefAndFastDrawTheSameSectionsOfTheWidestGrid) {
  std::size_t with_corners = 0;
  law::check(kSections, [&] {
    agree::Draws draws(*rc::gen::arbitrary<std::uint64_t>());
    const SceneFile view = wide_solids(draws);
    const DrawingOptions options = options_of(view);
    HALFSPACE_LAW(FastSections::draw(view, options) ==
                  RefSections::draw(view, options));
    if (have_corners(view, options)) ++with_corners;
  });
  EXPECT_GT(with_corners, 10u);
}

/// Planes through the centre or a corner of a cube, steep or along diagonals of
/// its faces: their lines pass through corners, edges and faces of it.
TEST(S9SectionsAgree, RefAndFastDrawTheSameCornersOfCaps) {
  std::size_t with_corners = 0;
  law::check(3 * kSections, [&] {
    agree::Draws draws(*rc::gen::arbitrary<std::uint64_t>());
    SceneFile view = cut_cube();
    std::vector<ClipPlane> planes;
    const GridPoint p =
        draws.one_in(2) ? GridPoint{0, 0, 0} : GridPoint{10, 10, -10};
    for (std::int64_t k = draws.from_to(2, 3); k > 0; --k) {
      const auto entry = [&] { return Int128{draws.from_to(-1, 1)}; };
      ClipPlane plane{entry(), entry(), entry(), 0};
      if (plane.a == 0 && plane.b == 0) plane.c = 1;
      plane.d = -(plane.a * p.x + plane.b * p.y + plane.c * p.z);
      planes.push_back(plane);
    }
    auto made = make_clips(planes, view.scene.grid_bits());
    HALFSPACE_LAW(made.has_value());
    view.options.clips = std::move(*made);
    const DrawingOptions options = options_of(view);
    HALFSPACE_LAW(FastSections::draw(view, options) ==
                  RefSections::draw(view, options));
    if (have_corners(view, options)) ++with_corners;
  });
  EXPECT_GT(with_corners, 100u);
}

TEST(S9SectionsAgree, RefAndFastDrawTheSameSections) {
  std::size_t hidden_by_caps = 0;
  std::size_t with_corners = 0;
  law::for_all(section_views(), 4 * kSections, [&](const SceneFile& whole) {
    const auto view = section_of(whole);
    if (!view) return;
    DrawingOptions options = options_of(*view);
    const auto& vertices = view->scene.data().vertices;
    options.lines.push_back({vertices.front(), vertices.back()});
    const Parts f = FastSections::draw(*view, options);
    HALFSPACE_LAW(f == RefSections::draw(*view, options));
    if (have_corners(*view, options)) ++with_corners;
    options.caps = false;
    if (view->options.caps &&
        f.intervals != FastSections::draw(*view, options).intervals)
      ++hidden_by_caps;
  });
  EXPECT_GT(hidden_by_caps, 10u);
  EXPECT_GT(with_corners, 10u);
}

}  // namespace
}  // namespace halfspace::section_drawings
