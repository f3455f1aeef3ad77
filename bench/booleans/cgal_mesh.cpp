#include "booleans/cgal_mesh.hpp"

#include <CGAL/boost/graph/helpers.h>

#include <array>
#include <vector>

#include "timing.hpp"

namespace halfspace::bench {

CgalMesh mesh_of(const Triangles& triangles) {
  CgalMesh mesh;
  const auto vertices =
      static_cast<CgalMesh::size_type>(triangles.points.size());
  const auto faces = static_cast<CgalMesh::size_type>(triangles.corners.size());
  mesh.reserve(vertices, vertices + faces, faces);
  std::vector<CgalMesh::Vertex_index> ids;
  for (const GridPoint& p : triangles.points) {
    ids.push_back(
        mesh.add_vertex({static_cast<double>(p.x), static_cast<double>(p.y),
                         static_cast<double>(p.z)}));
  }
  for (const auto& [a, b, c] : triangles.corners) {
    mesh.add_face(ids[static_cast<std::size_t>(a)],
                  ids[static_cast<std::size_t>(b)],
                  ids[static_cast<std::size_t>(c)]);
  }
  return mesh;
}

void add_output(const CgalMesh& mesh, double start, Outcome& outcome) {
  std::vector<std::array<double, 3>> points;
  for (const auto v : mesh.vertices()) {
    const auto& p = mesh.point(v);
    points.push_back({CGAL::to_double(p.x()), CGAL::to_double(p.y()),
                      CGAL::to_double(p.z())});
  }
  outcome.output_ms = process_ms() - start;
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
}

}  // namespace halfspace::bench
