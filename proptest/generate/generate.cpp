#include "generate/generate.hpp"

#include <array>
#include <tuple>
#include <utility>

#include "generate/shapes.hpp"
#include "generate/viewpoints.hpp"
#include "halfspace/assert.hpp"

namespace halfspace {

void showValue(const SceneFile& view, std::ostream& out) {
  out << write_scene(view);
}

namespace generate {
namespace {

namespace gen = rc::gen;
using enum ShapeKind;

/// A small integer of either sign; shrinks to 0.
rc::Gen<int> small_number() {
  return gen::map(gen::inRange(0, 9),
                  [](int k) { return k % 2 == 0 ? k / 2 : -(k + 1) / 2; });
}

/// 0 to count - 1, all as likely whatever the size.
rc::Gen<int> one_of(int count) {
  return gen::resize(rc::kNominalSize, gen::inRange(0, count));
}

template <class T>
rc::Gen<T> one_of(std::vector<T> values) {
  const auto count = static_cast<int>(values.size());
  return gen::map(one_of(count), [values = std::move(values)](int k) {
    return values[static_cast<std::size_t>(k)];
  });
}

rc::Gen<bool> a_bool() { return one_of(std::vector<bool>{false, true}); }

rc::Gen<std::vector<int>> numbers(std::size_t count) {
  return gen::resize(rc::kNominalSize,
                     gen::container<std::vector<int>>(count, small_number()));
}

rc::Gen<Shape> shape(std::vector<ShapeKind> kinds) {
  return gen::map(gen::tuple(one_of(std::move(kinds)), one_of(24), numbers(9)),
                  [](auto drawn) {
                    auto [kind, other, values] = std::move(drawn);
                    return Shape{kind, other, std::move(values)};
                  });
}

/// Up to `count` shapes of these kinds.
rc::Gen<std::vector<Shape>> shapes(int count, std::vector<ShapeKind> kinds) {
  return gen::resize(
      count, gen::container<std::vector<Shape>>(shape(std::move(kinds))));
}

const std::vector<ShapeKind> kAnyPolygon = {
    kTriangle, kTriangle, kParallelogram, kStraightCorner, kCopy,
    kInPlane,  kOnEdge,   kOnEdge,        kSliver};

/// What a generator narrows down; the rest is drawn freely.
struct Kinds {
  int count = 10;
  std::vector<ShapeKind> shapes = kAnyPolygon;
  std::vector<Stretch> stretches = {
      Stretch::kNone, Stretch::kNone, Stretch::kNone, Stretch::kNone,
      Stretch::kNone, Stretch::k26,   Stretch::k40,   Stretch::k54};
  std::vector<EyeKind> eyes = {EyeKind::kFree,       EyeKind::kFree,
                               EyeKind::kOnSplitter, EyeKind::kOnEdge,
                               EyeKind::kAtVertex,   EyeKind::kInside};
  std::vector<AimKind> aims = {
      AimKind::kTarget,    AimKind::kTarget,       AimKind::kVertexOnCentre,
      AimKind::kEdgeOnRow, AimKind::kEdgeOnColumn, AimKind::kEdgeOnDiagonal};
  std::vector<NearKind> nears = {NearKind::kNone, NearKind::kNone,
                                 NearKind::kFree, NearKind::kThroughImage};
  std::vector<bool> perspectives = {true, true, false};
};

rc::Gen<MadeScene> scenes(const Kinds& kinds) {
  return gen::map(
      gen::tuple(shapes(kinds.count, kinds.shapes), one_of(kinds.stretches),
                 a_bool(), a_bool()),
      [](auto drawn) {
        auto [list, stretch, jitter, colors] = std::move(drawn);
        return make(SceneRecipe{std::move(list), stretch, jitter, colors});
      });
}

rc::Gen<ViewRecipe> view_recipes(const Kinds& kinds) {
  return gen::map(
      gen::tuple(one_of(kinds.eyes), one_of(kinds.aims), one_of(kinds.nears),
                 one_of(kinds.perspectives),
                 one_of(std::vector<bool>{false, false, true}), a_bool(),
                 one_of(24), one_of(12), one_of(16), one_of(12), numbers(12)),
      [](auto drawn) {
        auto [eye, aim, near, perspective, cull, gouraud, other, edge, width,
              height, values] = std::move(drawn);
        return ViewRecipe{
            eye,  aim,       near,       perspective,      cull, gouraud, other,
            edge, width + 1, height + 1, std::move(values)};
      });
}

Views views_of(const Kinds& kinds) {
  return gen::map(gen::tuple(scenes(kinds), view_recipes(kinds)),
                  [](const std::tuple<MadeScene, ViewRecipe>& drawn) {
                    return make(std::get<0>(drawn), std::get<1>(drawn));
                  });
}

}  // namespace

Views coincident_polygons() {
  Kinds kinds;
  kinds.shapes = {kTriangle, kParallelogram, kCopy, kInPlane, kInPlane};
  return views_of(kinds);
}

Views shared_edges() {
  Kinds kinds;
  kinds.shapes = {kTriangle, kParallelogram, kOnEdge, kOnEdge, kOnEdge};
  return views_of(kinds);
}

Views slivers() {
  Kinds kinds;
  kinds.shapes = {kSliver, kSliver, kTriangle, kInPlane};
  return views_of(kinds);
}

Views nested_solids() {
  Kinds kinds;
  kinds.count = 3;
  kinds.shapes = {kBox, kTetrahedron};
  return views_of(kinds);
}

Views touching_solids() {
  Kinds kinds;
  kinds.count = 2;
  kinds.shapes = {kCubes, kBox};
  return views_of(kinds);
}

Views cyclic_overlaps() {
  Kinds kinds;
  kinds.count = 1;
  kinds.shapes = {kPinwheel, kPinwheel, kRings};
  kinds.eyes = {EyeKind::kFree};
  kinds.aims = {AimKind::kTarget};
  kinds.nears = {NearKind::kNone};
  return views_of(kinds);
}

Views grid_extremes() {
  Kinds kinds;
  kinds.stretches = {Stretch::k26, Stretch::k40, Stretch::k54};
  return views_of(kinds);
}

Views eye_on_splitter() {
  Kinds kinds;
  kinds.eyes = {EyeKind::kOnSplitter, EyeKind::kInPolygon};
  return views_of(kinds);
}

Views eye_on_edge() {
  Kinds kinds;
  kinds.eyes = {EyeKind::kOnEdge};
  return views_of(kinds);
}

Views eye_at_vertex() {
  Kinds kinds;
  kinds.eyes = {EyeKind::kAtVertex};
  kinds.perspectives = {true};
  return views_of(kinds);
}

Views eye_inside() {
  Kinds kinds;
  kinds.eyes = {EyeKind::kInside};
  kinds.shapes.push_back(kBox);
  kinds.perspectives = {true};
  return views_of(kinds);
}

Views vertex_on_pixel_centre() {
  Kinds kinds;
  kinds.aims = {AimKind::kVertexOnCentre};
  return views_of(kinds);
}

Views edge_through_pixel_centres() {
  Kinds kinds;
  kinds.aims = {AimKind::kEdgeOnRow, AimKind::kEdgeOnColumn,
                AimKind::kEdgeOnDiagonal};
  return views_of(kinds);
}

Views polygons_behind_the_eye() {
  Kinds kinds;
  kinds.eyes = {EyeKind::kInside, EyeKind::kOnSplitter};
  kinds.nears = {NearKind::kNone};
  kinds.perspectives = {true};
  return views_of(kinds);
}

Views near_through_polygon() {
  Kinds kinds;
  kinds.nears = {NearKind::kFree, NearKind::kThroughImage};
  return views_of(kinds);
}

Views views() {
  return gen::oneOf(coincident_polygons(), shared_edges(), slivers(),
                    nested_solids(), touching_solids(), cyclic_overlaps(),
                    grid_extremes(), eye_on_splitter(), eye_on_edge(),
                    eye_at_vertex(), eye_inside(), vertex_on_pixel_centre(),
                    edge_through_pixel_centres(), polygons_behind_the_eye(),
                    near_through_polygon());
}

}  // namespace generate
}  // namespace halfspace
