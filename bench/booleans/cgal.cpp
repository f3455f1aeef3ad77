#include <CGAL/Polygon_mesh_processing/corefinement.h>

#include "booleans/cgal_mesh.hpp"
#include "timing.hpp"

namespace halfspace::bench {
namespace {

bool carry_out(BooleanOp operation, CgalMesh& a, CgalMesh& b) {
  namespace pmp = CGAL::Polygon_mesh_processing;
  switch (operation) {
    case BooleanOp::kUnion:
      return pmp::corefine_and_compute_union(a, b, a);
    case BooleanOp::kIntersection:
      return pmp::corefine_and_compute_intersection(a, b, a);
    case BooleanOp::kDifference:
      return pmp::corefine_and_compute_difference(a, b, a);
    case BooleanOp::kSymmetricDifference:
      break;
  }
  return false;  // it has no such operation
}

std::optional<Outcome> run(const BooleanCase& task) {
  Outcome outcome;
  const double start = process_ms();
  std::vector<CgalMesh> meshes;
  for (const Triangles& operand : task.operands)
    meshes.push_back(mesh_of(operand));
  const double imported = process_ms();
  for (std::size_t i = 1; i < meshes.size(); ++i) {
    // It refuses where the result would touch itself.
    if (!carry_out(task.operation, meshes[0], meshes[i])) return {};
  }
  const double done = process_ms();
  outcome.import_ms = imported - start;
  outcome.boolean_ms = done - imported;
  meshes[0].collect_garbage();
  add_output(meshes[0], done, outcome);
  return outcome;
}

}  // namespace

Contestant cgal() {
  return {"CGAL exact", &run,
          [](const BooleanCase& task) { return task.for_corefinement; }};
}

}  // namespace halfspace::bench
