#include <algorithm>
#include <utility>
#include <vector>

#include "booleans/contestant.hpp"
#include "halfspace/fast/boolean.hpp"
#include "halfspace/fast/chain.hpp"
#include "halfspace/fast/check_operand.hpp"
#include "halfspace/fast/to_mesh.hpp"
#include "timing.hpp"

namespace halfspace::bench {
namespace {

double volume6_of(const fast::ExportedMesh& mesh) {
  double sum = 0;
  for (std::size_t t = 0; t < mesh.faces.size(); ++t) {
    const auto at = [&](std::size_t i) {
      return mesh.vertices[static_cast<std::size_t>(mesh.corners[3 * t + i])];
    };
    const auto p = at(0), q = at(1), r = at(2);
    sum += p[0] * (q[1] * r[2] - q[2] * r[1]) +
           p[1] * (q[2] * r[0] - q[0] * r[2]) +
           p[2] * (q[0] * r[1] - q[1] * r[0]);
  }
  return sum;
}

/// The solid with coplanar triangles merged, where that saves at least a
/// quarter of the faces.
fast::Solid lean(fast::Solid solid) {
  const auto [low, high] = std::minmax_element(
      solid.faces.begin(), solid.faces.end(),
      [](const auto& f, const auto& g) { return f.plane < g.plane; });
  const std::int32_t first = low->plane;
  std::vector<std::uint8_t> seen(static_cast<std::size_t>(high->plane - first) +
                                 1);
  std::size_t count = 0;
  for (const fast::Face& face : solid.faces) {
    std::uint8_t& is_seen = seen[static_cast<std::size_t>(face.plane - first)];
    count += is_seen == 0 ? 1 : 0;
    is_seen = 1;
  }
  if (4 * count > 3 * solid.faces.size()) return solid;
  return fast::merge_faces(std::move(solid), fast::Merge::kColor);
}

template <class Evaluate>
std::optional<Outcome> timed(const BooleanCase& task, Evaluate&& evaluate,
                             bool is_checked = false) {
  Outcome outcome;
  const double start = process_ms();
  std::vector<fast::Solid> solids;
  for (const Triangles& operand : task.operands) {
    const GridSolid solid = solid_of(operand);
    const auto part = static_cast<std::int32_t>(solids.size());
    fast::Solid made = solids.empty() ? fast::to_solid(solid)
                                      : fast::to_solid(solid, solids[0], part);
    if (is_checked && !fast::check_operand(made)) return {};
    solids.push_back(lean(std::move(made)));
  }
  const double imported = process_ms();
  fast::Solid result = evaluate(std::move(solids));
  const double done = process_ms();
  result = fast::merge_faces(std::move(result), fast::Merge::kPlane);
  const fast::ExportedMesh mesh = fast::to_mesh(result, {.triangles = true});
  outcome.output_ms = process_ms() - done;
  outcome.import_ms = imported - start;
  outcome.boolean_ms = done - imported;
  outcome.triangles = mesh.faces.size();
  outcome.closed = fast::bad_edges(result).empty();
  outcome.volume6 = volume6_of(mesh);
  return outcome;
}

template <bool kIsChecked>
std::optional<Outcome> in_turn(const BooleanCase& task) {
  return timed(
      task,
      [&](std::vector<fast::Solid> solids) {
        if (solids.size() == 2)
          return fast::boolean(task.operation, solids[0], solids[1]);
        fast::Chain chain(std::move(solids[0]));
        for (std::size_t i = 1; i < solids.size(); ++i)
          chain.apply(task.operation, solids[i]);
        return std::move(chain).solid();
      },
      kIsChecked);
}

template <bool kIsChecked>
std::optional<Outcome> at_once(const BooleanCase& task) {
  return timed(
      task,
      [&](const std::vector<fast::Solid>& solids) {
        return fast::boolean_all(task.operation, solids);
      },
      kIsChecked);
}

bool takes_any(const BooleanCase&) { return true; }
bool takes_many(const BooleanCase& task) { return task.operands.size() > 2; }

}  // namespace

Contestant ours_in_turn() { return {"Halfspace", &in_turn<false>, &takes_any}; }

Contestant ours_checked() {
  return {"Halfspace, checked", &in_turn<true>, &takes_any};
}

Contestant ours_at_once() {
  return {"Halfspace, at once", &at_once<false>, &takes_many};
}

Contestant ours_at_once_checked() {
  return {"Halfspace, at once, checked", &at_once<true>, &takes_many};
}

}  // namespace halfspace::bench
