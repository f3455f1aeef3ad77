#include <CGAL/Nef_polyhedron_3.h>
#include <CGAL/boost/graph/convert_nef_polyhedron_to_polygon_mesh.h>

#include "booleans/cgal_mesh.hpp"
#include "timing.hpp"

namespace halfspace::bench {
namespace {

using Nef = CGAL::Nef_polyhedron_3<CgalKernel>;

void carry_out(BooleanOp operation, Nef& a, const Nef& b) {
  switch (operation) {
    case BooleanOp::kUnion:
      a += b;
      return;
    case BooleanOp::kIntersection:
      a *= b;
      return;
    case BooleanOp::kDifference:
      a -= b;
      return;
    case BooleanOp::kSymmetricDifference:
      a ^= b;
      return;
  }
}

std::optional<Outcome> run(const BooleanCase& task) {
  Outcome outcome;
  const double start = process_ms();
  std::vector<Nef> solids;
  for (const Triangles& operand : task.operands)
    solids.emplace_back(mesh_of(operand));
  const double imported = process_ms();
  for (std::size_t i = 1; i < solids.size(); ++i)
    carry_out(task.operation, solids[0], solids[i]);
  const double done = process_ms();
  outcome.import_ms = imported - start;
  outcome.boolean_ms = done - imported;
  // No mesh of theirs can touch itself.
  if (!solids[0].is_simple()) return {};
  CgalMesh mesh;
  CGAL::convert_nef_polyhedron_to_polygon_mesh(solids[0], mesh, true);
  add_output(mesh, done, outcome);
  return outcome;
}

}  // namespace

Contestant cgal_nef() {
  return {"CGAL Nef", &run,
          [](const BooleanCase& task) { return task.for_nef; }};
}

}  // namespace halfspace::bench
