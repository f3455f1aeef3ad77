#pragma once

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "adapters/answers.hpp"
#include "adapters/both_fast.hpp"
#include "adapters/both_solid.hpp"
#include "adapters/scenes.hpp"
#include "definition/definition.hpp"
#include "halfspace/boolean.hpp"
#include "halfspace/bsp_tree.hpp"
#include "halfspace/ref/boolean.hpp"
#include "halfspace/ref/build.hpp"
#include "halfspace/ref/classify.hpp"
#include "halfspace/ref/oracle/painter.hpp"
#include "halfspace/ref/oracle/raycast.hpp"
#include "halfspace/ref/oracle/zbuffer.hpp"
#include "halfspace/ref/render.hpp"
#include "halfspace/ref/scan.hpp"
#include "halfspace/ref/screen.hpp"
#include "halfspace/ref/split.hpp"
#include "halfspace/ref/traverse.hpp"
#include "halfspace/ref/winding.hpp"
#include "halfspace/scene.hpp"

/// The implementations, as the laws see them: each function under its own name,
/// planes by the polygons they come from, answers in the words of spec/.
namespace halfspace {

/// A part of a solid's polygon, and its class against another solid.
struct ClassifiedPart {
  std::vector<definition::Point> vertices;
  SolidClass solid_class;
};

struct Ref {
  using Solid = ref::Solid;
  using Fragment = ref::Fragment;
  using Tree = ref::BspTree;
  using DynamicScreen = ref::DynamicScreen;

  // S1
  static Side side_of(const Scene& scene, PolygonId plane,
                      const GridPoint& point) {
    return ref::side_of(plane_of(scene, plane), ref::to_point(point));
  }
  static Side side_of_eye(const Scene& scene, PolygonId plane,
                          const Camera& camera) {
    return ref::side_of_eye(plane_of(scene, plane), camera);
  }

  // S2
  static Fragment whole(const Scene& scene, PolygonId polygon) {
    return ref::whole(scene, polygon);
  }
  static FragmentName name_of(const Fragment& fragment) {
    return ref::name_of(fragment);
  }
  static Relation relation(const Scene& scene, const Fragment& fragment,
                           PolygonId splitter) {
    return ref::relation(fragment, plane_of(scene, splitter));
  }
  static std::pair<Fragment, Fragment> split(const Scene& scene,
                                             const Fragment& fragment,
                                             PolygonId splitter) {
    auto parts = ref::split(fragment, plane_of(scene, splitter), splitter);
    return {std::move(parts.positive), std::move(parts.negative)};
  }

  // S3
  static Tree build(const Scene& scene, const BuildOptions& options) {
    return ref::build(scene, options);
  }
  static void insert(Tree& tree, const Scene& scene, PolygonId polygon) {
    ref::insert(tree, ref::whole(scene, polygon), plane_of(scene, polygon));
  }
  static void remove(Tree& tree, const std::vector<PolygonId>& polygons) {
    ref::remove(tree, polygons);
  }
  static TreeStats stats(const Tree& tree) { return ref::stats(tree); }
  static TreeName name_of(const Tree& tree) { return ref::name_of(tree); }

  /// The fragments displayed until `limit` of them have been.
  static std::vector<FragmentName> back_to_front(const Tree& tree,
                                                 const Camera& camera,
                                                 std::size_t limit = kNoLimit) {
    std::vector<FragmentName> shown;
    ref::back_to_front(tree, camera, collect(shown, limit));
    return shown;
  }
  static std::vector<FragmentName> front_to_back(const Tree& tree,
                                                 const Camera& camera,
                                                 std::size_t limit = kNoLimit) {
    std::vector<FragmentName> shown;
    ref::front_to_back(tree, camera, collect(shown, limit));
    return shown;
  }

  // S4
  static std::vector<LineSpan> scan_convert(const Scene&,
                                            const Fragment& fragment,
                                            const Camera& camera) {
    std::vector<LineSpan> lines;
    for (const auto& segment :
         ref::scan_convert(fragment, ref::projection_of(camera)))
      lines.push_back({segment.line, segment.span});
    return lines;
  }
  static MergeCase merge_case(Span object, Span unlit) {
    return ref::merge_case(object, unlit);
  }
  /// What is lit now, and what is unlit still.
  static std::pair<std::vector<Span>, std::vector<Span>> merge(
      const std::vector<Span>& objects, const std::vector<Span>& unlit) {
    auto merged = ref::merge(objects, unlit);
    return {std::move(merged.lit), std::move(merged.unlit)};
  }

  // S5
  static Image render(const Scene& scene, const Tree& tree,
                      const Camera& camera, const ImageOptions& options) {
    return image_of(ref::render(scene, tree, camera, options));
  }
  static Image render_samples(const Scene& scene, const Tree& tree,
                              const Camera& camera, const ImageOptions& options,
                              std::int32_t samples) {
    return image_of(ref::render_samples(scene, tree, camera, options, samples));
  }
  static Image blend(const Scene& scene, const Tree& tree, const Camera& camera,
                     const ImageOptions& options, std::uint8_t alpha) {
    return image_of(ref::blend(scene, tree, camera, options, alpha));
  }

  // S6
  static Solid to_solid(const GridSolid& solid) { return ref::to_solid(solid); }
  /// What is outside of a solid that is not empty: polygons turned over.
  static Solid complement_of(const GridSolid& solid) {
    return ref::to_solid(*make_solid(reversed(solid.scene())));
  }
  static Solid boolean(BooleanOp operation, const Solid& a, const Solid& b,
                       const BuildOptions& options = {}) {
    return ref::boolean(operation, a, b, options);
  }
  static bool is_solid(const Solid& solid) { return ref::is_solid(solid); }
  static Solid resolve(const Solid& solid) { return ref::resolve(solid); }
  static std::vector<std::vector<definition::Point>> polygons_of(
      const Solid& solid) {
    std::vector<std::vector<definition::Point>> polygons;
    for (const ref::Face& face : solid.faces)
      polygons.push_back(points_of(face.vertices));
    return polygons;
  }
  static bool is_closed(const Solid& solid) {
    return ref::bad_edges(solid).empty();
  }
  static definition::Fraction volume6(const Solid& solid) {
    const definition::Point p =
        point_of({ref::volume6(solid), ref::Rational(0), ref::Rational(0)});
    return definition::Fraction(p.x, p.w);
  }
  /// The parts of polygon `id` of `solid`, classified against `other`.
  static std::vector<ClassifiedPart> classify(const Solid& solid, PolygonId id,
                                              const Solid& other,
                                              const BuildOptions& options) {
    std::vector<ClassifiedPart> parts;
    const auto& face = solid.faces[static_cast<std::size_t>(id)];
    for (const auto& part : ref::classify(ref::build(other, options),
                                          ref::whole(solid, id), face.plane))
      parts.push_back({points_of(part.fragment.vertices), part.solid_class});
    return parts;
  }

  static Image image_of(ref::Rendering rendering) {
    return {std::move(rendering.items), std::move(rendering.colors),
            rendering.pixels_painted};
  }

 private:
  static definition::Point point_of(const ref::Point& p) {
    const auto over = [](const ref::Rational& value) {
      const auto big = value.big();
      return std::pair(definition::Integer(numerator(big).str()),
                       definition::Integer(denominator(big).str()));
    };
    const auto [x, u] = over(p.x);
    const auto [y, v] = over(p.y);
    const auto [z, w] = over(p.z);
    return {x * v * w, y * u * w, z * u * v, u * v * w};
  }
  static std::vector<definition::Point> points_of(
      const std::vector<ref::Point>& vertices) {
    std::vector<definition::Point> points;
    for (const ref::Point& p : vertices) points.push_back(point_of(p));
    return points;
  }

  static constexpr std::size_t kNoLimit = static_cast<std::size_t>(-1);

  static ref::Plane plane_of(const Scene& scene, PolygonId polygon) {
    return ref::plane_of(ref::whole(scene, polygon).vertices);
  }
  static ref::Visitor collect(std::vector<FragmentName>& shown,
                              std::size_t limit) {
    return [&shown, limit](const ref::Node&, const ref::Fragment& fragment) {
      shown.push_back(ref::name_of(fragment));
      return shown.size() < limit;
    };
  }
};

/// The algorithms that no implementation but the reference has (S5.5).
namespace oracle {

inline Image paint(const Scene& scene, const Camera& camera,
                   const ImageOptions& options, const BuildOptions& build) {
  return Ref::image_of(
      ref::paint(scene, ref::build(scene, build), camera, options));
}
inline Image zbuffer(const Scene& scene, const Camera& camera,
                     const ImageOptions& options) {
  return Ref::image_of(ref::zbuffer(scene, camera, options));
}
inline Image raycast(const Scene& scene, const Camera& camera,
                     const ImageOptions& options) {
  return Ref::image_of(ref::raycast(scene, camera, options));
}

}  // namespace oracle

using Implementations = ::testing::Types<Ref, Fast>;

/// Those of booleans (S6).
using BooleanImplementations = ::testing::Types<Ref, FastSolids>;

/// Those that show their trees and classes, too.
using ClassifyImplementations = ::testing::Types<Ref>;

}  // namespace halfspace
