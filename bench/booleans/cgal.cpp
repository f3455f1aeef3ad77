#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Surface_mesh.h>

#include <map>

#include "booleans/contestant.hpp"

namespace halfspace::bench {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;

Mesh mesh_of(const Triangles& triangles) {
  Mesh mesh;
  std::vector<Mesh::Vertex_index> ids;
  for (const GridPoint& p : triangles.points) {
    ids.push_back(mesh.add_vertex(Point(static_cast<double>(p.x),
                                        static_cast<double>(p.y),
                                        static_cast<double>(p.z))));
  }
  for (const auto& [a, b, c] : triangles.corners) {
    mesh.add_face(ids[static_cast<std::size_t>(a)],
                  ids[static_cast<std::size_t>(b)],
                  ids[static_cast<std::size_t>(c)]);
  }
  return mesh;
}

bool carry_out(BooleanOp operation, Mesh& a, Mesh& b) {
  namespace pmp = CGAL::Polygon_mesh_processing;
  switch (operation) {
    case BooleanOp::kUnion:
      return pmp::corefine_and_compute_union(a, b, a);
    case BooleanOp::kIntersection:
      return pmp::corefine_and_compute_intersection(a, b, a);
    case BooleanOp::kDifference:
      break;
  }
  return pmp::corefine_and_compute_difference(a, b, a);
}

std::optional<Outcome> run(const BooleanCase& task) {
  Outcome outcome;
  const double start = process_ms();
  std::vector<Mesh> meshes;
  for (const Triangles& operand : task.operands)
    meshes.push_back(mesh_of(operand));
  const double imported = process_ms();
  for (std::size_t i = 1; i < meshes.size(); ++i) {
    // It refuses where the result would touch itself.
    if (!carry_out(task.operation, meshes[0], meshes[i])) return {};
  }
  const double done = process_ms();
  Mesh& mesh = meshes[0];
  mesh.collect_garbage();
  std::vector<std::array<double, 3>> points;
  for (const auto v : mesh.vertices()) {
    const Point& p = mesh.point(v);
    points.push_back({CGAL::to_double(p.x()), CGAL::to_double(p.y()),
                      CGAL::to_double(p.z())});
  }
  outcome.output_ms = process_ms() - done;
  outcome.import_ms = imported - start;
  outcome.boolean_ms = done - imported;
  outcome.triangles = mesh.number_of_faces();
  outcome.closed = CGAL::is_closed(mesh);
  for (const auto f : mesh.faces()) {
    std::array<const std::array<double, 3>*, 3> c;
    std::size_t i = 0;
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(f)))
      c[i++] = &points[v.idx()];
    const auto& [p, q, r] = c;
    outcome.volume6 += (*p)[0] * ((*q)[1] * (*r)[2] - (*q)[2] * (*r)[1]) +
                       (*p)[1] * ((*q)[2] * (*r)[0] - (*q)[0] * (*r)[2]) +
                       (*p)[2] * ((*q)[0] * (*r)[1] - (*q)[1] * (*r)[0]);
  }
  return outcome;
}

}  // namespace

Contestant cgal() { return {"CGAL exact", &run}; }

}  // namespace halfspace::bench
