#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "fields.hpp"
#include "files/exact_file.hpp"
#include "halfspace/csg/carry.hpp"
#include "halfspace/csg/exact_measure.hpp"
#include "halfspace/csg/locate.hpp"
#include "halfspace/csg/outcome.hpp"
#include "halfspace/csg/topology.hpp"
#include "halfspace/fast/boolean.hpp"
#include "halfspace/fast/solid/merged_copy.hpp"
#include "halfspace/fast/to_mesh.hpp"
#include "halfspace/io/file.hpp"
#include "halfspace/io/format.hpp"
#include "halfspace/io/load_scene.hpp"
#include "halfspace/io/write_mesh.hpp"
#include "node.hpp"
#include "number.hpp"

namespace halfspace {
namespace {

using detail::Evaluation;
using detail::SolidNode;

/// Nothing where the solid is merged already.
std::optional<fast::Solid> merged_by(const fast::Solid& solid,
                                     MergeFaces merge) {
  switch (merge) {
    case MergeFaces::kOrigin:
      return fast::merged_copy(solid, fast::Merge::kOrigin);
    case MergeFaces::kPlane:
      return fast::merged_copy(solid, fast::Merge::kPlane);
    case MergeFaces::kNone:
      break;
  }
  return std::nullopt;
}

csg::MergeRule rule_of(MergeFaces merge) {
  switch (merge) {
    case MergeFaces::kOrigin:
      return csg::MergeRule::kOrigin;
    case MergeFaces::kPlane:
      return csg::MergeRule::kPlane;
    case MergeFaces::kNone:
      break;
  }
  return csg::MergeRule::kNone;
}

Result<std::shared_ptr<Evaluation>> evaluation_of(
    const Solid& solid, const WorkOptions& options = {}) {
  return SolidNode::of(solid).evaluation(options);
}

/// What `ask` answers about the solid, with nobody else at its table.
template <class Ask>
auto answer(const Solid& solid, const Ask& ask)
    -> Result<decltype(ask(std::declval<const fast::Solid&>()))> {
  const auto evaluation = evaluation_of(solid);
  if (!evaluation) return evaluation.error();
  const Lock lock((*evaluation)->mutex);
  return ask((*evaluation)->solid);
}

/// The same, but for the empty solid, of which it is an error.
template <class Ask>
auto answer_of_some(const Solid& solid, const Ask& ask)
    -> Result<decltype(ask(std::declval<const fast::Solid&>()))> {
  const auto evaluation = evaluation_of(solid);
  if (!evaluation) return evaluation.error();
  const Lock lock((*evaluation)->mutex);
  if ((*evaluation)->solid.faces.empty())
    return Error{ErrorCode::kEmpty, solid.name() + ": it is empty"};
  return ask((*evaluation)->solid);
}

/// The colour of the polygons of a part; nothing where they have none.
std::optional<Rgb> color_of(const Evaluation& evaluation, std::int32_t part,
                            PolygonId polygon) {
  if (part < 0 || static_cast<std::size_t>(part) >= evaluation.uses.size())
    return std::nullopt;
  const detail::LeafData& data =
      *evaluation.uses[static_cast<std::size_t>(part)].node->leaf->data();
  const auto at = static_cast<std::size_t>(polygon);
  if (!data.properties || data.properties->colors.empty()) return std::nullopt;
  const std::vector<bool>& has_color = data.source->has_color;
  if (at < has_color.size() && !has_color[at]) return std::nullopt;
  return data.properties->colors[at];
}

/// What the operands' files say of their faces.
csg::AttributedLeaves attributed_leaves(const Evaluation& evaluation) {
  csg::AttributedLeaves all;
  for (const Evaluation::Use& use : evaluation.uses)
    all.leaves.push_back(
        {use.node->leaf->data()->source->attributed.get(), use.matrix});
  all.planes = evaluation.cuts.size();
  all.max_move = evaluation.rounding.max_move;
  return all;
}

/// The mesh as an exact scene, if its vertices are on the grid; else the mesh.
Result<Done> written(const std::filesystem::path& path,
                     const Evaluation& evaluation,
                     const csg::EvaluateOptions& how, csg::Outcome outcome) {
  for (const csg::Origin& origin : outcome.origins) {
    outcome.color_sources.push_back(
        color_of(evaluation, origin.leaf, origin.polygon)
            ? csg::ColorSource::kGiven
            : csg::ColorSource::kNone);
  }
  std::vector<bool> has_color = csg::has_color(outcome.color_sources);
  outcome.mesh.attributes =
      csg::carried_attributes(attributed_leaves(evaluation), outcome, how);
  if (outcome.scene) {
    const auto report = io::write_scene_mesh(
        path, *outcome.scene, outcome.mesh.attributes.get(), true, has_color);
    if (!report) return report.error();
    return Done{};
  }
  outcome.mesh.has_color = std::move(has_color);
  const auto report = io::write_mesh(path, outcome.mesh);
  if (!report) return report.error();
  return Done{};
}

/// The colours of properties, in the faces.
void color_faces(const Evaluation& evaluation, fast::Solid& solid) {
  for (fast::Face& face : solid.faces)
    face.color = color_of(evaluation, face.part, face.polygon)
                     .value_or(io::kUsualSurface);
}

/// Writes the solid as it is, its faces' origins with it, as the program does.
Result<Done> saved_exactly(const std::filesystem::path& path,
                           const Evaluation& evaluation, fast::Solid solid) {
  if (solid.unbounded) {
    return Error{ErrorCode::kUnbounded,
                 path.string() + ": the solid reaches infinitely far"};
  }
  csg::FileSolid file = detail::for_file(evaluation, std::move(solid));
  for (std::size_t f = 0; f < file.origins.size(); ++f) {
    const auto& [operand, polygon] = file.origins[f];
    SolidData::Face& face = file.data.faces[f];
    face.has_color = color_of(evaluation, operand, polygon).has_value();
    if (!face.has_color) face.color = {};
  }
  return io::write_file(path, write_solid(file.data, SolidForm::kBinary));
}

}  // namespace

Result<Done> Solid::evaluate(const WorkOptions& options) const {
  const auto evaluation = node_->evaluation(options);
  if (!evaluation) return evaluation.error();
  return Done{};
}

Result<Mesh> Solid::mesh(const MeshOptions& options) const {
  const auto evaluation =
      evaluation_of(*this, {options.threads, options.progress});
  if (!evaluation) return evaluation.error();
  const Lock lock((*evaluation)->mutex);
  const std::optional<fast::Solid> merged =
      merged_by((*evaluation)->solid, options.merge);
  const fast::Solid& solid = merged ? *merged : (*evaluation)->solid;
  fast::ExportedMesh exported =
      fast::to_mesh(solid, {options.triangles, options.threads});
  Mesh mesh;
  mesh.vertices.reserve(exported.vertices.size());
  for (const auto& v : exported.vertices)
    mesh.vertices.push_back({v[0], v[1], v[2]});
  detail::carry_properties(**evaluation, solid, exported, mesh);
  mesh.first_corner = std::move(exported.first_corner);
  mesh.corners = std::move(exported.corners);
  return mesh;
}

Result<Done> Solid::save(const std::filesystem::path& path,
                         const MeshOptions& options) const {
  const auto evaluation =
      evaluation_of(*this, {options.threads, options.progress});
  if (!evaluation) return evaluation.error();
  const Lock lock((*evaluation)->mutex);
  fast::Solid solid = (*evaluation)->solid;
  color_faces(**evaluation, solid);
  if (io::is_solid_name(path)) {
    return saved_exactly(path, **evaluation, std::move(solid));
  }
  csg::EvaluateOptions how;
  how.merge = rule_of(options.merge);
  how.triangles = options.triangles;
  how.threads = options.threads;
  const auto format = io::format_of(path);
  if (format && io::has_floats(*format)) {
    how.triangles = true;
    how.number = fast::FileNumber::kFloat;
  }
  auto outcome = csg::outcome_of(std::move(solid), how);
  if (!outcome) return outcome.error();
  return written(path, **evaluation, how, *std::move(outcome));
}

Result<std::vector<Solid>> Solid::operands() const {
  const auto evaluation = evaluation_of(*this);
  if (!evaluation) return evaluation.error();
  std::vector<Solid> solids;
  for (const Evaluation::Use& use : (*evaluation)->uses)
    solids.push_back(SolidNode::solid_of(use.node));
  for (const Evaluation::Cut& cut : (*evaluation)->cuts)
    solids.push_back(SolidNode::solid_of(cut.node));
  return solids;
}

Result<std::map<std::string, std::size_t>> Solid::polygons_by_operand() const {
  const auto made = mesh();
  if (!made) return made.error();
  const std::vector<Solid> from = *operands();
  std::map<std::string, std::size_t> counts;
  for (const Origin& origin : made->origins)
    ++counts[from[origin.operand].name()];
  return counts;
}

Result<RoundingReport> Solid::rounding() const {
  const auto evaluation = evaluation_of(*this);
  if (!evaluation) return evaluation.error();
  return (*evaluation)->rounding;
}

Result<bool> Solid::is_empty() const {
  return answer(*this, [](const fast::Solid& s) { return s.faces.empty(); });
}

Result<double> Solid::volume() const { return answer(*this, csg::volume_of); }

Result<double> Solid::area() const { return answer(*this, csg::area_of); }

Result<std::string> Solid::exact_volume() const {
  return answer(*this, csg::exact_volume_of);
}

Result<std::optional<std::string>> Solid::exact_area() const {
  return answer(*this, csg::exact_area_of);
}

Result<Bounds> Solid::bounds() const {
  return answer_of_some(*this, [](const fast::Solid& solid) {
    const auto [low, high] = csg::bounds_of(solid);
    return Bounds{{low[0], low[1], low[2]}, {high[0], high[1], high[2]}};
  });
}

Result<Point> Solid::centroid() const {
  return answer_of_some(*this, [](const fast::Solid& solid) {
    const auto c = csg::moments_of(solid).centroid;
    return Point{c[0], c[1], c[2]};
  });
}

Result<std::array<std::array<double, 3>, 3>> Solid::inertia() const {
  return answer_of_some(*this, [](const fast::Solid& solid) {
    return csg::moments_of(solid).inertia;
  });
}

Result<std::size_t> Solid::shell_count() const {
  return answer(*this, [](const fast::Solid& solid) {
    return csg::topology_of(solid).shells;
  });
}

Result<std::int64_t> Solid::genus() const {
  return answer(*this, [](const fast::Solid& solid) {
    return csg::topology_of(solid).genus;
  });
}

Result<Location> Solid::locate(Point point) const {
  if (!std::isfinite(point.x) || !std::isfinite(point.y) ||
      !std::isfinite(point.z))
    return Error{ErrorCode::kNotFinite, "the point is not finite"};
  return answer(*this, [&](const fast::Solid& solid) {
    const int side = csg::location_of(
        solid, csg::in_steps(detail::numbers_of(point), solid.unit));
    return side < 0    ? Location::kInside
           : side == 0 ? Location::kOn
                       : Location::kOutside;
  });
}

Result<bool> Solid::overlaps(const Solid& other) const {
  const auto empty = (*this & other).is_empty();
  if (!empty) return empty.error();
  return !*empty;
}

Result<bool> Solid::contains(const Solid& other) const {
  return (other - *this).is_empty();
}

}  // namespace halfspace
