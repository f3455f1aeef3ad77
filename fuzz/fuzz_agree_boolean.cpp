#include <array>
#include <map>
#include <utility>

#include "adapters/both_solid.hpp"
#include "definition/definition.hpp"
#include "fuzz.hpp"
#include "generate/shapes.hpp"
#include "halfspace/fast/check_operand.hpp"
#include "halfspace/fast/resolve.hpp"
#include "halfspace/fast/rounded_mesh.hpp"
#include "halfspace/io/import.hpp"
#include "halfspace/ref/boolean.hpp"
#include "halfspace/ref/winding.hpp"

namespace halfspace {
namespace {

using definition::Integer;

/// A solid that the bytes mean: a box, a heap of cubes or a tetrahedron.
generate::Polygons solid_of(fuzz::Bytes& bytes) {
  using enum generate::ShapeKind;
  constexpr generate::ShapeKind kKinds[] = {kBox, kCubes, kTetrahedron};
  generate::Polygons polygons;
  const auto kind = kKinds[bytes.below(3)];
  const int other = bytes.below(2);
  generate::add({kind, other, bytes.numbers(9)}, polygons);
  return polygons;
}

GridSolid made(const generate::Polygons& polygons) {
  auto solid = make_solid(generate::scene_of(polygons, {}));
  HALFSPACE_FUZZ_EXPECT(solid.has_value());
  return *solid;
}

definition::Point point_of(const ref::Point& p) {
  const auto x = p.x.big(), y = p.y.big(), z = p.z.big();
  const auto integer = [](const auto& value) {
    constexpr std::int64_t kMost = std::int64_t{1} << 62;
    return -kMost < value && value < kMost
               ? Integer(value.template convert_to<std::int64_t>())
               : Integer(value.str());
  };
  const Integer u = integer(denominator(x)), v = integer(denominator(y)),
                w = integer(denominator(z));
  return {integer(numerator(x)) * v * w, integer(numerator(y)) * u * w,
          integer(numerator(z)) * u * v, u * v * w};
}

std::vector<std::vector<definition::Point>> polygons_of(
    const ref::Solid& solid) {
  std::vector<std::vector<definition::Point>> polygons;
  for (const ref::Face& face : solid.faces) {
    polygons.emplace_back();
    for (const ref::Point& p : face.vertices)
      polygons.back().push_back(point_of(p));
  }
  return polygons;
}

/// A solid by both libraries, and six times its volume.
struct Pair {
  ref::Solid reference;
  fast::Solid fast;
  definition::Fraction volume;
};

Pair pair_of(const GridSolid& solid) {
  const ref::Solid reference = ref::to_solid(solid);
  return {reference, fast::to_solid(solid),
          definition::volume6(polygons_of(reference))};
}

/// Twice the area in every plane, by which way it faces: the planes, and how
/// much there is in each, do not depend on how a surface is cut up.
using Areas = std::map<std::array<Integer, 4>, definition::Area>;

Areas areas_of(const std::vector<std::vector<definition::Point>>& polygons) {
  Areas areas;
  for (const auto& polygon : polygons) {
    const definition::Plane p = definition::facet_of(polygon).support;
    const Integer common = gcd(gcd(p.a, p.b), gcd(p.c, p.d));
    definition::Area& area =
        areas[{p.a / common, p.b / common, p.c / common, p.d / common}];
    area = area + definition::area_of(polygon);
  }
  return areas;
}

/// The boolean; it must be closed, by any account, and the same surface.
Pair closed(BooleanOp operation, const Pair& a, const Pair& b,
            const BuildOptions& options) {
  Pair result = {ref::boolean(operation, a.reference, b.reference, options),
                 fast::boolean(operation, a.fast, b.fast), 0};
  HALFSPACE_FUZZ_EXPECT(ref::bad_edges(result.reference).empty());
  HALFSPACE_FUZZ_EXPECT(fast::bad_edges(result.fast).empty());
  const auto polygons = polygons_of(result.reference);
  HALFSPACE_FUZZ_EXPECT(definition::is_closed(polygons));
  result.volume = definition::volume6(polygons);
  HALFSPACE_FUZZ_EXPECT(volume6_of(result.fast) == result.volume);
  HALFSPACE_FUZZ_EXPECT(areas_of(halfspace::polygons_of(result.fast)) ==
                        areas_of(polygons));
  return result;
}

/// What volumes say of the booleans of two solids.
void expect_volumes(const Pair& a, const Pair& b, const BuildOptions& options) {
  using enum BooleanOp;
  const auto both = closed(kIntersection, a, b, options).volume;
  HALFSPACE_FUZZ_EXPECT(both >= 0 && both <= a.volume && both <= b.volume);
  HALFSPACE_FUZZ_EXPECT(closed(kUnion, a, b, options).volume + both ==
                        a.volume + b.volume);
  HALFSPACE_FUZZ_EXPECT(closed(kDifference, a, b, options).volume + both ==
                        a.volume);
  HALFSPACE_FUZZ_EXPECT(closed(kSymmetricDifference, a, b, options).volume +
                            both + both ==
                        a.volume + b.volume);
  HALFSPACE_FUZZ_EXPECT(closed(kDifference, b, a, options).volume + both ==
                        b.volume);
}

/// What both libraries say of the two surfaces as one: whether it is that of a
/// solid, and what it is resolved to (S6.6, S6.7).
void expect_resolved(generate::Polygons polygons,
                     const generate::Polygons& more) {
  polygons.insert(polygons.end(), more.begin(), more.end());
  const auto soup = made(polygons);
  const ref::Solid reference = ref::to_solid(soup);
  const fast::Solid fast = fast::to_solid(soup);
  HALFSPACE_FUZZ_EXPECT(fast::check_operand(fast).has_value() ==
                        ref::is_solid(reference));
  const fast::Solid resolved = fast::resolve(fast).solid;
  const auto expected = polygons_of(ref::resolve(reference));
  HALFSPACE_FUZZ_EXPECT(fast::bad_edges(resolved).empty());
  HALFSPACE_FUZZ_EXPECT(fast::check_operand(resolved).has_value());
  HALFSPACE_FUZZ_EXPECT(volume6_of(resolved) == definition::volume6(expected));
  HALFSPACE_FUZZ_EXPECT(areas_of(halfspace::polygons_of(resolved)) ==
                        areas_of(expected));
}

/// Far out, where floats are as far apart as the solids' corners: rounding
/// makes faces meet.
generate::Polygons far_out(generate::Polygons polygons) {
  for (auto& polygon : polygons) {
    for (GridPoint& p : polygon) p.x += std::int64_t{1} << 23;
  }
  return polygons;
}

/// A difference rounded to floats is a solid as it stands (S6.8).
void expect_rounded(const generate::Polygons& first,
                    const generate::Polygons& second) {
  const fast::Solid a = fast::to_solid(made(far_out(first)));
  const fast::Solid b = fast::to_solid(made(far_out(second)), a);
  const auto mesh =
      fast::rounded_mesh(fast::boolean(BooleanOp::kDifference, a, b),
                         {.number = fast::FileNumber::kFloat});
  HALFSPACE_FUZZ_EXPECT(mesh.has_value());
  if (mesh->faces.empty()) return;
  io::Mesh file;
  for (const auto& v : mesh->vertices) {
    for (const double c : v)
      HALFSPACE_FUZZ_EXPECT(double{static_cast<float>(c)} == c);
    file.vertices.push_back(
        {io::number_of(v[0]), io::number_of(v[1]), io::number_of(v[2])});
  }
  file.first_corner = mesh->first_corner;
  file.corners = mesh->corners;
  const auto again = io::import_scene(file, {});
  HALFSPACE_FUZZ_EXPECT(again.has_value());
  HALFSPACE_FUZZ_EXPECT(again->report.moved == 0 &&
                        again->report.dropped == 0 &&
                        again->report.triangulated == 0);
  const auto solid = make_solid(again->scene);
  HALFSPACE_FUZZ_EXPECT(solid.has_value());
  HALFSPACE_FUZZ_EXPECT(
      fast::check_operand(fast::to_solid(*solid)).has_value());
}

}  // namespace
}  // namespace halfspace

/// Booleans of small solids, and of their results with a third, are closed,
/// have the same surface by reference and fast library, and the volumes of
/// sets. Two of them in one scene are resolved to the same surface by both. Far
/// out, a difference in floats is a solid.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  using namespace halfspace;
  using enum BooleanOp;
  fuzz::Bytes bytes(data, size);
  BuildOptions options;
  options.rule = static_cast<RootRule>(bytes.below(9));
  options.candidates = 1 + static_cast<std::uint32_t>(bytes.below(6));
  options.seed = bytes.next();
  const auto operation = kBooleanOps[static_cast<std::size_t>(bytes.below(4))];
  const auto first = solid_of(bytes);
  const auto second = solid_of(bytes);
  expect_rounded(first, second);
  const auto a = pair_of(made(first));
  const auto b = pair_of(made(second));
  if (bytes.empty()) {
    expect_resolved(first, second);
    expect_volumes(a, b, options);
    return 0;
  }
  const auto c = pair_of(made(solid_of(bytes)));
  expect_volumes(closed(operation, a, b, options), c, options);
  return 0;
}
