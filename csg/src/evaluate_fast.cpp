#include <algorithm>
#include <utility>

#include "exact/by_low_end.hpp"
#include "exact/origin_parts.hpp"
#include "halfspace/csg/carry.hpp"
#include "halfspace/csg/components.hpp"
#include "halfspace/csg/evaluate.hpp"
#include "halfspace/csg/outcome.hpp"
#include "halfspace/csg/volume.hpp"
#include "halfspace/fast/boolean.hpp"
#include "halfspace/fast/chain.hpp"
#include "halfspace/fast/check_operand.hpp"
#include "halfspace/fast/resolve.hpp"
#include "halfspace/fast/rounded_mesh.hpp"
#include "halfspace/fast/solid.hpp"
#include "halfspace/fast/solid/canonical_solid.hpp"
#include "halfspace/fast/solid_data.hpp"
#include "halfspace/fast/to_mesh.hpp"
#include "halfspace/io/load_scene.hpp"

namespace halfspace::csg {
namespace {

/// The fast library's solids, all in one table of planes and points. The parts
/// are the plan's leaves, and then its planes.
class FastAlgebra {
 public:
  using Value = fast::Solid;

  FastAlgebra(const Plan& plan, Operands& operands,
              const EvaluateOptions& options)
      : operands_(operands),
        threads_(options.threads),
        combine_(options.combine),
        nothing_(fast::to_solid(operands.nothing())),
        leaf_count_(static_cast<std::int32_t>(plan.leaves.size())) {}

  Result<Value> leaf(std::int32_t id) {
    Result<Value> made = unresolved(id);
    if (!made) return made;
    Value value = *std::move(made);
    if (operands_.to_merge(id))
      value = fast::merge_faces(std::move(value), fast::Merge::kColor);
    if (!operands_.to_repair(id)) return value;
    fast::Resolved resolved = fast::resolve(value);
    if (resolved.solid.faces.empty()) return operands_.nothing_left(id);
    repairs_.push_back({id, resolved.self_intersections.size(),
                        resolved.faces_cut, resolved.faces_dropped});
    return std::move(resolved.solid);
  }

  Result<Value> plane(std::int32_t id) {
    const auto points = operands_.plane(id);
    if (!points) return points.error();
    Value half = fast::half_space(*points, nothing_);
    half.faces.front().color = io::kUsualSurface;
    half.faces.front().part = leaf_count_ + id;
    return half;
  }

  const std::vector<Repair>& repairs() const { return repairs_; }

  Value complement(Value value) { return fast::complement(std::move(value)); }

  Result<Value> component(const Value& value, const Numbers3& point) {
    Value part = component_at(value, point);
    if (!part.faces.empty()) return part;
    return Error{ErrorCode::kOutOfRange,
                 "a part of a solid is gone, for a transform rounds it away; "
                 "move the whole, and take it apart then"};
  }

  Value combine(NodeKind kind, const Value& a, const Value& b) {
    if (combine_ && !is_half_space(a) && !is_half_space(b))
      return combine_(boolean_op(kind), a, b);
    return fast::boolean(boolean_op(kind), a, b, threads_);
  }

  /// Whether many values are better combined at once.
  bool takes_all(NodeKind kind) const {
    return !combine_ &&
           (kind == NodeKind::kUnion || kind == NodeKind::kIntersection);
  }
  Value combine_all(NodeKind kind, const std::vector<Value>& values) {
    return fast::boolean_all(boolean_op(kind), values, threads_);
  }

 private:
  /// The leaf as its file has it.
  Result<Value> unresolved(std::int32_t id) {
    if (operands_.is_exact(id)) return operands_.exact_leaf(id, nothing_);
    const auto solid = operands_.leaf(id);
    if (!solid) return solid.error();
    return numbered(fast::to_solid(**solid, nothing_, id),
                    operands_.polygons_of(id));
  }

  static bool is_half_space(const Value& value) {
    return std::any_of(
        value.faces.begin(), value.faces.end(),
        [](const fast::Face& face) { return face.edge_count == 0; });
  }

  Operands& operands_;
  int threads_;
  const Combine& combine_;
  fast::Solid nothing_;
  std::int32_t leaf_count_;
  std::vector<Repair> repairs_;
};

fast::Solid merged_by(fast::Solid solid, MergeRule rule) {
  switch (rule) {
    case MergeRule::kOrigin:
      return fast::merge_faces(std::move(solid), fast::Merge::kOrigin);
    case MergeRule::kColor:
      return fast::merge_faces(std::move(solid), fast::Merge::kColor);
    case MergeRule::kPlane:
      return fast::merge_faces(std::move(solid), fast::Merge::kPlane);
    case MergeRule::kNone:
      break;
  }
  return solid;
}

/// The solid in an order that decides which of several origins merged faces
/// have, where there may be several.
fast::Solid in_order_for(MergeRule rule, fast::Solid solid) {
  return rule == MergeRule::kColor || rule == MergeRule::kPlane
             ? fast::canonical(solid)
             : std::move(solid);
}

/// The mesh as a scene, its vertices being in steps of the unit: exactly, or
/// nothing if doubles or no grid hold them.
std::optional<Scene> scene_of(const fast::ExportedMesh& mesh, Unit unit) {
  if (mesh.moved > 0) return std::nullopt;
  io::Mesh exact;
  bool any_two = false, any_five = false;
  for (const auto& vertex : mesh.vertices) {
    std::array<io::Number, 3> at;
    for (std::size_t k = 0; k < 3; ++k) {
      at[k] = io::number_of(vertex[k]);
      if (at[k].mantissa == 0) continue;
      at[k].two += unit.exponent;
      at[k].five += unit.base == 10 ? unit.exponent : 0;
      at[k] = io::normalised(at[k].mantissa, at[k].two, at[k].five);
      any_five = any_five || at[k].five < 0;
      any_two = any_two || at[k].two < 0;
    }
    exact.vertices.push_back(at);
  }
  exact.first_corner = mesh.first_corner;
  exact.corners = mesh.corners;
  exact.face_colors.assign(mesh.colors.begin(), mesh.colors.end());
  // Whichever the operands were (S1.7): halves are no decimals.
  exact.decimal = any_five || !any_two;
  Result<io::Imported> imported = io::import_scene(exact, {});
  if (!imported || imported->report.moved > 0 ||
      imported->scene.polygon_count() != mesh.faces.size())
    return std::nullopt;
  return std::move(imported->scene);
}

/// How many edges the polygons do not use equally often in each direction.
template <class Mesh>
std::size_t bad_edges_of(const Mesh& mesh) {
  struct Use {
    VertexId low;
    VertexId high;
    int sign;
  };
  std::vector<Use> uses;
  uses.reserve(mesh.corners.size());
  for (std::size_t p = 0; p < mesh.faces.size(); ++p) {
    const std::size_t first = mesh.first_corner[p];
    const std::size_t end = mesh.first_corner[p + 1];
    for (std::size_t i = first; i < end; ++i) {
      const VertexId from = mesh.corners[i];
      const VertexId to = mesh.corners[i + 1 < end ? i + 1 : first];
      uses.push_back(
          {std::min(from, to), std::max(from, to), from < to ? 1 : -1});
    }
  }
  sort_by_low_end(
      uses, mesh.vertices.size(), [](const Use& use) { return use.low; },
      [](const Use& a, const Use& b) { return a.high < b.high; });
  std::size_t bad = 0;
  int sum = 0;
  for (std::size_t i = 0; i < uses.size(); ++i) {
    sum += uses[i].sign;
    const bool is_last = i + 1 == uses.size() ||
                         uses[i + 1].low != uses[i].low ||
                         uses[i + 1].high != uses[i].high;
    if (!is_last) continue;
    bad += sum != 0 ? 1 : 0;
    sum = 0;
  }
  return bad;
}

bool is_on_grid(const fast::Solid& solid) {
  return std::all_of(solid.edges.begin(), solid.edges.end(),
                     [&](const fast::SolidEdge& edge) {
                       return fast::vertex_at(solid, edge.from).is_grid;
                     });
}

/// Takes what the polygons of a mesh are, whichever it is.
template <class Mesh>
void take_polygons(const fast::Solid& solid, const Mesh& mesh, Unit unit,
                   Outcome& result) {
  result.polygons = mesh.faces.size();
  result.bad_edges = bad_edges_of(mesh);
  result.volume = {about_volume(mesh.vertices, mesh.first_corner, mesh.corners),
                   unit, 3};
  result.origins.clear();
  for (const std::int32_t f : mesh.faces) {
    const fast::Face& face = solid.faces[static_cast<std::size_t>(f)];
    result.origins.push_back({face.part, face.polygon});
  }
}

/// The result as an exact scene, if some grid holds it, which need not be that
/// of the operands.
std::optional<Scene> exact_scene(fast::Solid& result_solid,
                                 const EvaluateOptions& options,
                                 Outcome& result) {
  if (options.number == fast::FileNumber::kFloat) return std::nullopt;
  std::optional<fast::Solid> moved;
  if (!is_on_grid(result_solid)) {
    moved = fast::on_points(result_solid);
    if (!moved) return std::nullopt;
  }
  fast::Solid& solid = moved ? *moved : result_solid;
  const Unit unit = solid.unit;
  // In steps, doubles hold every point of the grid.
  solid.unit = {2, 0};
  const fast::ExportedMesh mesh =
      fast::to_mesh(solid, {.triangles = options.triangles,
                            .threads = options.threads,
                            .straight_corners = false});
  solid.unit = unit;
  take_polygons(solid, mesh, unit, result);
  return scene_of(mesh, unit);
}

}  // namespace

std::vector<bool> has_color(const std::vector<ColorSource>& sources) {
  std::vector<bool> has(sources.size());
  std::transform(
      sources.begin(), sources.end(), has.begin(),
      [](ColorSource source) { return source != ColorSource::kNone; });
  return has;
}

BooleanOp boolean_op(NodeKind kind) {
  switch (kind) {
    case NodeKind::kIntersection:
      return BooleanOp::kIntersection;
    case NodeKind::kDifference:
      return BooleanOp::kDifference;
    case NodeKind::kSymmetricDifference:
      return BooleanOp::kSymmetricDifference;
    default:
      return BooleanOp::kUnion;
  }
}

namespace {

/// Notes where the colours are from, by the origins.
void note_color_sources(const Operands& operands, Outcome& result) {
  result.color_sources.clear();
  for (const Origin& origin : result.origins)
    result.color_sources.push_back(
        operands.color_source(origin.leaf, origin.polygon));
}

/// Whether the solid is closed: only of closed faces can there be polygons.
bool note_closed(const fast::Solid& made, Outcome& result) {
  result.bad_edges =
      std::max(fast::bad_edges(made).size(), fast::open_faces(made).size());
  return result.bad_edges == 0;
}

/// The solid, its faces' parts being those of the file, in the order and with
/// the names of the file.
fast::Solid named_for_file(fast::Solid solid, const OriginParts& parts,
                           MergeRule merge) {
  parts.expand(solid);
  // What has no face conforms, whatever was known of that on the way.
  solid.is_conforming = solid.is_conforming || solid.faces.empty();
  return fast::canonical_for_file(
      merged_by(in_order_for(merge, std::move(solid)), merge));
}

/// The solid, by its own faces.
FileSolid file_solid(const fast::Solid& solid, const OriginParts& parts) {
  FileSolid file;
  for (const fast::Face& face : solid.faces)
    file.origins.push_back(parts.of_operand({face.part, face.polygon}));
  file.data = in_least_grid(fast::data_of(solid, parts.names()));
  return file;
}

}  // namespace

FileSolid for_file(fast::Solid solid, std::span<const OperandPart> operands) {
  const OriginParts parts(operands);
  return file_solid(named_for_file(std::move(solid), parts, MergeRule::kOrigin),
                    parts);
}

Outcome exact_outcome(fast::Solid solid, const Plan& plan,
                      const Operands& operands,
                      const EvaluateOptions& options) {
  Outcome result;
  if (!note_closed(solid, result)) return result;
  const OriginParts parts(plan, operands);
  solid = named_for_file(std::move(solid), parts, options.merge);
  if (!note_closed(solid, result)) return result;
  result.faces = solid.faces.size();
  const Unit unit = solid.unit;
  // In steps, for the volume: doubles need not hold the coordinates.
  solid.unit = {2, 0};
  const fast::ExportedMesh mesh =
      fast::to_mesh(solid, {.triangles = false, .threads = options.threads});
  solid.unit = unit;
  take_polygons(solid, mesh, unit, result);
  result.polygons = result.faces;
  result.bad_edges = 0;
  FileSolid file = file_solid(solid, parts);
  result.origins = std::move(file.origins);
  note_color_sources(operands, result);
  result.data = std::move(file.data);
  for (std::size_t f = 0; f < result.data->faces.size(); ++f) {
    if (result.color_sources[f] != ColorSource::kNone) continue;
    result.data->faces[f].has_color = false;
    result.data->faces[f].color = {};
  }
  return result;
}

Result<Outcome> outcome_of(fast::Solid solid, const EvaluateOptions& options) {
  Outcome result;
  const auto is_closed = [&result](const fast::Solid& made) {
    return note_closed(made, result);
  };
  if (!is_closed(solid)) return result;
  solid = fast::canonical(
      merged_by(in_order_for(options.merge, std::move(solid)), options.merge));
  result.faces = solid.faces.size();
  if (!is_closed(solid)) return result;
  result.scene = exact_scene(solid, options, result);
  if (result.scene) return result;
  Result<fast::RoundedMesh> mesh =
      fast::rounded_mesh(solid, {.number = options.number,
                                 .triangles = options.triangles,
                                 .threads = options.threads,
                                 .max_move = options.max_move,
                                 .keep_corners = options.keep_corners});
  if (!mesh) {
    return options.output.empty()
               ? mesh.error()
               : io::error_about(options.output, mesh.error());
  }
  take_polygons(solid, *mesh, {2, 0}, result);
  result.moved = mesh->moved;
  result.max_move = mesh->max_move;
  result.rounding = {mesh->spacing,    mesh->rounds,       mesh->crossings,
                     mesh->faces_lost, mesh->parts_before, mesh->parts_after};
  result.mesh = {std::move(mesh->vertices), std::move(mesh->first_corner),
                 std::move(mesh->corners), std::move(mesh->colors), true};
  return result;
}

Result<std::optional<fast::Solid>> evaluate_solid(
    const Plan& plan, Operands& operands, const EvaluateOptions& options) {
  FastAlgebra algebra(plan, operands, options);
  return Evaluator<FastAlgebra>(plan, algebra, options.progress).result();
}

namespace {

/// The outcome for a file of polygons.
Result<Outcome> mesh_outcome(fast::Solid solid, const Plan& plan,
                             const Operands& operands,
                             const EvaluateOptions& options) {
  const OriginParts parts(plan, operands);
  parts.expand(solid);
  Result<Outcome> result = outcome_of(std::move(solid), options);
  if (!result) return result;
  for (Origin& origin : result->origins) origin = parts.of_operand(origin);
  return result;
}

}  // namespace

Result<std::optional<Outcome>> evaluate_fast(const Plan& plan,
                                             Operands& operands,
                                             const EvaluateOptions& options) {
  FastAlgebra algebra(plan, operands, options);
  Evaluator<FastAlgebra> evaluator(plan, algebra, options.progress);
  Result<std::optional<fast::Solid>> solid = evaluator.result();
  if (!solid) return solid.error();
  if (!*solid) return std::optional<Outcome>();
  Result<Outcome> result =
      options.exact_data
          ? exact_outcome(**std::move(solid), plan, operands, options)
          : mesh_outcome(**std::move(solid), plan, operands, options);
  if (!result) return result.error();
  result->repairs = algebra.repairs();
  note_color_sources(operands, *result);
  result->mesh.has_color = has_color(result->color_sources);
  result->attributes =
      carried_attributes(attributed_leaves(plan, operands), *result, options);
  result->mesh.attributes = result->attributes;
  result->mesh.threads = options.threads;
  return std::optional<Outcome>(*std::move(result));
}

}  // namespace halfspace::csg
