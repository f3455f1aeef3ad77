#include <algorithm>
#include <map>
#include <utility>

#include "halfspace/csg/evaluate.hpp"
#include "halfspace/csg/outcome.hpp"
#include "halfspace/ref/boolean.hpp"
#include "halfspace/ref/winding.hpp"

namespace halfspace::csg {
namespace {

/// The reference's solids. It has no complement of nothing, so that is apart.
class RefAlgebra {
 public:
  struct Value {
    ref::Solid solid;
    bool is_all = false;  ///< all of space; then the solid is empty
  };

  RefAlgebra(Operands& operands, const BuildOptions& options)
      : operands_(operands), options_(options) {}

  Result<Value> leaf(std::int32_t id) {
    if (operands_.is_exact(id)) {
      return Error{ErrorCode::kUnknownFormat,
                   operands_.path_of(id) +
                       ": the reference takes no exact solids; the fast "
                       "library does",
                   -1};
    }
    const auto solid = operands_.leaf(id);
    if (!solid) return solid.error();
    Value value{ref::to_solid(**solid), false};
    if (!operands_.to_repair(id)) return value;
    ref::Solid resolved = ref::resolve(value.solid, options_);
    if (resolved.faces.empty()) return operands_.nothing_left(id);
    std::vector<std::size_t> parts(value.solid.faces.size());
    for (const ref::Face& face : resolved.faces)
      ++parts[static_cast<std::size_t>(face.source)];
    const auto faces_with = [&](auto&& count_is) {
      return static_cast<std::size_t>(
          std::count_if(parts.begin(), parts.end(), count_is));
    };
    repairs_.push_back({id,
                        {},
                        faces_with([](std::size_t n) { return n > 1; }),
                        faces_with([](std::size_t n) { return n == 0; })});
    return Value{std::move(resolved), false};
  }

  const std::vector<Repair>& repairs() const { return repairs_; }

  Result<Value> plane(std::int32_t) {
    return Error{ErrorCode::kUnknownFormat,
                 "the reference has no half-spaces; the fast library has", -1};
  }

  Result<Value> component(const Value&, const Numbers3&) {
    return Error{ErrorCode::kUnknownFormat,
                 "the reference takes no solid apart; the fast library does",
                 -1};
  }

  Value complement(Value value) {
    if (value.is_all) return {};
    if (value.solid.faces.empty()) return {{}, true};
    for (ref::Face& face : value.solid.faces) {
      face.plane = {-face.plane.a, -face.plane.b, -face.plane.c, -face.plane.d};
      std::reverse(face.vertices.begin(), face.vertices.end());
    }
    return value;
  }

  Value combine(NodeKind kind, const Value& a, const Value& b) {
    switch (kind) {
      case NodeKind::kIntersection:
        if (a.is_all) return b;
        if (b.is_all) return a;
        return of(BooleanOp::kIntersection, a, b);
      case NodeKind::kDifference:
        if (b.is_all) return {};
        if (a.is_all) return complement(b);
        return of(BooleanOp::kDifference, a, b);
      case NodeKind::kSymmetricDifference:
        if (a.is_all) return complement(b);
        if (b.is_all) return complement(a);
        return of(BooleanOp::kSymmetricDifference, a, b);
      default:
        if (a.is_all || b.is_all) return {{}, true};
        return of(BooleanOp::kUnion, a, b);
    }
  }

 private:
  Value of(BooleanOp operation, const Value& a, const Value& b) {
    return {ref::boolean(operation, a.solid, b.solid, options_), false};
  }

  Operands& operands_;
  BuildOptions options_;
  std::vector<Repair> repairs_;
};

/// The coordinate in grid steps, if it is one of the widest grid's.
std::optional<std::int64_t> on_grid(const ref::Rational& coordinate) {
  const std::int64_t limit = std::int64_t{1} << (kGridBits[2] - 1);
  if (floor(coordinate) != coordinate || coordinate < ref::Rational(-limit) ||
      !(coordinate < ref::Rational(limit))) {
    return std::nullopt;
  }
  return coordinate.to_int64();
}

std::optional<GridPoint> on_grid(const ref::Point& point) {
  const auto x = on_grid(point.x);
  const auto y = on_grid(point.y);
  const auto z = on_grid(point.z);
  if (!x || !y || !z) return std::nullopt;
  return GridPoint{*x, *y, *z};
}

/// The solid as a scene, if all its vertices lie on the grid.
std::optional<Scene> scene_of(const ref::Solid& solid, Unit unit) {
  SceneData data;
  data.unit = unit;
  std::map<GridPoint, VertexId> ids;
  for (const ref::Face& face : solid.faces) {
    for (const ref::Point& vertex : face.vertices) {
      const std::optional<GridPoint> point = on_grid(vertex);
      if (!point) return std::nullopt;
      const auto next = static_cast<VertexId>(data.vertices.size());
      const auto [place, is_new] = ids.try_emplace(*point, next);
      if (is_new) data.vertices.push_back(*point);
      data.corners.push_back(place->second);
    }
    data.first_corner.push_back(
        static_cast<std::uint32_t>(data.corners.size()));
    data.colors.push_back(face.color);
  }
  data.grid_bits = grid_bits_for(data.vertices);
  Result<Scene> scene = make_scene(std::move(data));
  if (!scene) return std::nullopt;
  return *std::move(scene);
}

Scaled volume_of(const ref::Solid& solid, const Unit& unit) {
  return {volume6(solid).big().convert_to<double>() / 6, unit, 3};
}

}  // namespace

Result<std::optional<Outcome>> evaluate_ref(const Plan& plan,
                                            Operands& operands,
                                            const EvaluateOptions& options) {
  RefAlgebra algebra(operands, options.build);
  Evaluator<RefAlgebra> evaluator(plan, algebra, options.progress);
  Result<std::optional<RefAlgebra::Value>> value = evaluator.result();
  if (!value) return value.error();
  if (!*value) return std::optional<Outcome>();
  const ref::Solid& solid = (*value)->solid;
  const Unit unit = operands.report().unit;
  ref::RoundedSolid rounded = ref::rounded(solid, unit);
  Outcome result;
  result.scene = scene_of(solid, unit);
  result.mesh = {std::move(rounded.vertices), std::move(rounded.first_corner),
                 std::move(rounded.corners), std::move(rounded.colors)};
  // Where faces come from is not known, but what has a colour has another one.
  for (const ref::Face& face : solid.faces) {
    result.color_sources.push_back(face.color == io::kUsualSurface
                                       ? ColorSource::kNone
                                       : ColorSource::kGiven);
  }
  result.mesh.has_color = has_color(result.color_sources);
  result.moved = rounded.moved;
  result.max_move = rounded.max_move;
  result.faces = result.polygons = solid.faces.size();
  result.bad_edges = ref::bad_edges(solid).size();
  result.volume = volume_of(solid, unit);
  result.repairs = algebra.repairs();
  return std::optional<Outcome>(std::move(result));
}

}  // namespace halfspace::csg
