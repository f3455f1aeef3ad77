#include "booleans/face.hpp"

#include <utility>

#include "halfspace/halfspace.hpp"
#include "timing.hpp"

namespace halfspace::bench {
namespace {

/// Not for other numbers than whole ones.
Mesh mesh_of(const Triangles& triangles) {
  Mesh mesh;
  for (const GridPoint& p : triangles.points) {
    mesh.vertices.push_back({static_cast<double>(p.x), static_cast<double>(p.y),
                             static_cast<double>(p.z)});
  }
  for (const auto& corners : triangles.corners) mesh.add(corners);
  return mesh;
}

Solid combined(BooleanOp operation, const std::vector<Solid>& solids) {
  switch (operation) {
    case BooleanOp::kUnion:
      return Solid::union_of(solids);
    case BooleanOp::kIntersection:
      return Solid::intersection_of(solids);
    default:
      break;
  }
  Solid all = solids.front();
  for (std::size_t i = 1; i < solids.size(); ++i) {
    if (operation == BooleanOp::kDifference) {
      all -= solids[i];
    } else {
      all ^= solids[i];
    }
  }
  return all;
}

double volume6_of(const Mesh& mesh) {
  double sum = 0;
  for (std::size_t t = 0; t < mesh.polygon_count(); ++t) {
    const auto corners = mesh.corners_of(t);
    const auto at = [&](std::size_t i) {
      return mesh.vertices[static_cast<std::size_t>(corners[i])];
    };
    const Point p = at(0), q = at(1), r = at(2);
    sum += p.x * (q.y * r.z - q.z * r.y) + p.y * (q.z * r.x - q.x * r.z) +
           p.z * (q.x * r.y - q.y * r.x);
  }
  return sum;
}

}  // namespace

std::optional<Outcome> through_the_face(const BooleanCase& task) {
  std::vector<Solid> solids;
  for (const Triangles& operand : task.operands) {
    solids.push_back(Solid::from_mesh(mesh_of(operand)));
    if (!solids.back().evaluate({.threads = 1})) return std::nullopt;
  }
  const double start = process_ms();
  const Solid made = combined(task.operation, solids);
  if (!made.evaluate({.threads = 1})) return std::nullopt;
  const double done = process_ms();
  const auto mesh =
      made.mesh({.merge = MergeFaces::kPlane, .triangles = true, .threads = 1});
  if (!mesh) return std::nullopt;
  Outcome outcome;
  outcome.output_ms = process_ms() - done;
  outcome.boolean_ms = done - start;
  outcome.triangles = mesh->polygon_count();
  // What is not closed has no mesh.
  outcome.closed = true;
  outcome.volume6 = volume6_of(*mesh);
  return outcome;
}

FieldTimes time_with_fields(int triangles, std::size_t fields) {
  const BooleanCase task = two_spheres(triangles, 0);
  std::vector<Mesh> meshes;
  for (const Triangles& operand : task.operands) {
    Mesh mesh = mesh_of(operand);
    mesh.field_count = fields;
    for (const std::int32_t corner : mesh.corners) {
      const Point& p = mesh.vertices[static_cast<std::size_t>(corner)];
      for (std::size_t k = 0; k < fields; ++k) {
        const auto a = static_cast<double>(k);
        mesh.fields.push_back(p.x + a * p.y - 2 * p.z + 1);
      }
    }
    meshes.push_back(std::move(mesh));
  }
  const double start = process_ms();
  const Solid a = Solid::from_mesh(std::move(meshes[0]));
  const Solid b = Solid::from_mesh(std::move(meshes[1]));
  // Reads and checks them.
  const bool are_solids =
      a.evaluate({.threads = 1}) && b.evaluate({.threads = 1});
  const double read = process_ms();
  const auto mesh = (a - b).mesh({.threads = 1});
  const double done = process_ms();
  if (!are_solids || !mesh || mesh->field_count != fields) return {};
  return {done - start, done - read};
}

}  // namespace halfspace::bench
