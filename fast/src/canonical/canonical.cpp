#include <algorithm>
#include <optional>
#include <vector>

#include "canonical/canonizer.hpp"
#include "canonical/file_canonizer.hpp"
#include "canonical/own_grid.hpp"
#include "halfspace/fast/solid/canonical_solid.hpp"

namespace halfspace::fast {
namespace {

bool is_bounded(const Solid& solid) {
  return !solid.unbounded &&
         std::all_of(solid.faces.begin(), solid.faces.end(),
                     [](const Face& face) { return face.edge_count > 0; });
}

}  // namespace

Solid canonical(const Solid& solid) {
  if (!is_bounded(solid) || solid.faces.empty()) return solid;
  return Canonizer(solid).run();
}

Solid canonical_for_file(const Solid& solid) {
  if (!is_bounded(solid)) return solid;
  if (!solid.faces.empty()) return FileCanonizer(solid).run();
  Solid empty = solid;
  empty.unit = unit_of({});
  empty.table = TableLease::of_new(kGridBits[0]).shared();
  return empty;
}

std::optional<Solid> on_points(const Solid& solid) {
  // Most that are on no grid here are on none, and one of them is enough.
  const auto off_grid = std::find_if(
      solid.edges.begin(), solid.edges.end(), [&](const SolidEdge& edge) {
        return !solid.table->vertex(edge.from).is_grid();
      });
  if (off_grid != solid.edges.end() &&
      !fineness_of_vertex(solid, off_grid->from))
    return std::nullopt;
  std::vector<std::int32_t> vertices;
  for (const SolidEdge& edge : solid.edges) vertices.push_back(edge.from);
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  // Most that are on no grid here are on none.
  std::partition(vertices.begin(), vertices.end(), [&](std::int32_t id) {
    return !solid.table->vertex(id).is_grid();
  });
  Fineness need;
  for (const std::int32_t id : vertices) {
    const auto its = fineness_of_vertex(solid, id);
    if (!its) return std::nullopt;
    need.add(*its);
  }
  if (!grid_reaches(solid, vertices, unit_of(need))) return std::nullopt;
  return Canonizer(solid).run_on(unit_of(need));
}

}  // namespace halfspace::fast
