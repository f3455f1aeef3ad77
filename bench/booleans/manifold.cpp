#include <manifold/manifold.h>

#include "booleans/contestant.hpp"
#include "timing.hpp"

namespace halfspace::bench {
namespace {

using manifold::Manifold;
using manifold::OpType;

Manifold solid_of_manifold(const Triangles& triangles) {
  manifold::MeshGL64 mesh;
  mesh.numProp = 3;
  mesh.vertProperties.reserve(3 * triangles.points.size());
  for (const GridPoint& p : triangles.points) {
    for (const std::int64_t x : {p.x, p.y, p.z})
      mesh.vertProperties.push_back(static_cast<double>(x));
  }
  mesh.triVerts.reserve(3 * triangles.corners.size());
  for (const auto& corners : triangles.corners) {
    for (const VertexId corner : corners)
      mesh.triVerts.push_back(static_cast<std::uint64_t>(corner));
  }
  return Manifold(mesh);
}

double volume6_of(const manifold::MeshGL64& mesh) {
  double sum = 0;
  for (std::size_t t = 0; t < mesh.triVerts.size(); t += 3) {
    const auto at = [&](std::size_t i) {
      return mesh.GetVertPos(mesh.triVerts[t + i]);
    };
    sum += linalg::dot(at(0), linalg::cross(at(1), at(2)));
  }
  return sum;
}

OpType type_of(BooleanOp operation) {
  return operation == BooleanOp::kUnion          ? OpType::Add
         : operation == BooleanOp::kIntersection ? OpType::Intersect
                                                 : OpType::Subtract;
}

/// Its symmetric difference would be two of its operations.
bool has_operation(const BooleanCase& task) {
  return task.operation != BooleanOp::kSymmetricDifference;
}

template <class Evaluate>
std::optional<Outcome> timed(const BooleanCase& task, Evaluate&& evaluate) {
  Outcome outcome;
  const double start = process_ms();
  std::vector<Manifold> solids;
  for (const Triangles& operand : task.operands)
    solids.push_back(solid_of_manifold(operand));
  const double imported = process_ms();
  const Manifold result = evaluate(solids, type_of(task.operation));
  // It works when it is asked.
  if (result.Status() != Manifold::Error::NoError) return {};
  const double done = process_ms();
  const manifold::MeshGL64 mesh = result.GetMeshGL64();
  outcome.output_ms = process_ms() - done;
  outcome.import_ms = imported - start;
  outcome.boolean_ms = done - imported;
  outcome.triangles = mesh.NumTri();
  outcome.closed = true;  // what it makes is by construction
  outcome.volume6 = volume6_of(mesh);
  return outcome;
}

std::optional<Outcome> in_turn(const BooleanCase& task) {
  return timed(task, [](const std::vector<Manifold>& solids, OpType type) {
    Manifold all = solids.front();
    for (std::size_t i = 1; i < solids.size(); ++i) {
      all = all.Boolean(solids[i], type);
      // Else it would see the whole expression, and work on it at once.
      if (all.Status() != Manifold::Error::NoError) break;
    }
    return all;
  });
}

std::optional<Outcome> in_batch(const BooleanCase& task) {
  return timed(task, [](const std::vector<Manifold>& solids, OpType type) {
    return Manifold::BatchBoolean(solids, type);
  });
}

}  // namespace

Contestant manifold_in_turn() {
  return {"Manifold", &in_turn, &has_operation, 1e-6};
}

Contestant manifold_in_batch() {
  return {"Manifold, batch", &in_batch,
          [](const BooleanCase& task) {
            return has_operation(task) && task.operands.size() > 2;
          },
          1e-6};
}

}  // namespace halfspace::bench
