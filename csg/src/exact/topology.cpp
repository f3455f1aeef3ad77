#include "halfspace/csg/topology.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>
#include <vector>

#include "halfspace/csg/surface.hpp"
#include "halfspace/fast/to_mesh.hpp"

namespace halfspace::csg {
namespace {

class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  std::size_t find(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::size_t i, std::size_t j) { parent_[find(i)] = find(j); }
  std::size_t count() const {
    std::size_t roots = 0;
    for (std::size_t i = 0; i < parent_.size(); ++i)
      roots += parent_[i] == i ? 1u : 0u;
    return roots;
  }

 private:
  std::vector<std::size_t> parent_;
};

/// The use of an edge by a triangle: corner `corner` is its start.
struct Use {
  std::int32_t low = 0;
  std::int32_t high = 0;
  std::size_t corner = 0;
  bool up = false;  ///< it goes from the low end to the high one
};

class Surface {
 public:
  Surface(const fast::Solid& solid, const fast::ExportedMesh& mesh)
      : exact_(solid),
        mesh_(mesh),
        parts_(mesh.faces.size()),
        fans_(mesh.corners.size()) {}
  Topology topology();
  std::vector<std::size_t> shells();

 private:
  std::vector<Use> join_all();
  static std::size_t next(std::size_t corner) {
    return corner % 3 == 2 ? corner - 2 : corner + 1;
  }
  const ExactPoint& point(std::size_t corner) {
    return exact_.point(
        mesh_.points[static_cast<std::size_t>(mesh_.corners[corner])]);
  }
  void join(const Use& a, const Use& b);
  void join_around(std::vector<Use> uses);

  ExactSurface exact_;
  const fast::ExportedMesh& mesh_;
  DisjointSets parts_;  // of triangles
  DisjointSets fans_;   // of corners: those at one vertex of the surface
};

void Surface::join(const Use& a, const Use& b) {
  parts_.join(a.corner / 3, b.corner / 3);
  fans_.join(a.corner, next(b.corner));
  fans_.join(next(a.corner), b.corner);
}

/// Joins the uses of one edge: each that goes down with the next one that goes
/// up, counterclockwise as seen from the edge's high end, for the solid is
/// between those.
void Surface::join_around(std::vector<Use> uses) {
  if (uses.size() == 2) return join(uses[0], uses[1]);
  const Use& first = uses.front();
  const std::size_t from = first.up ? first.corner : next(first.corner);
  const ExactPoint low = point(from);
  const auto less = [&low](const ExactPoint& p) {
    Integers3 d;
    for (std::size_t i = 0; i < 3; ++i)
      d[i] = p.at[i] * low.below - low.at[i] * p.below;
    return d;
  };
  const Integers3 along =
      less(point(first.up ? next(first.corner) : first.corner));
  const auto apart = [&](const Use& use) {
    return less(point(next(next(use.corner))));
  };
  // Directions by the half turn that they are in from the first one on.
  const Integers3 start = apart(first);
  const Integers3 across = cross(along, start);
  const auto half_of = [&](const Integers3& d) {
    const int side = dot(across, d).sign();
    if (side != 0) return side > 0 ? 0 : 1;
    return dot(cross(across, along), d) > 0 ? 0 : 1;
  };
  std::stable_sort(uses.begin(), uses.end(), [&](const Use& a, const Use& b) {
    const Integers3 da = apart(a), db = apart(b);
    if (half_of(da) != half_of(db)) return half_of(da) < half_of(db);
    return dot(along, cross(da, db)) > 0;
  });
  for (std::size_t i = 0; i < uses.size(); ++i) {
    const Use& other = uses[(i + 1) % uses.size()];
    if (!uses[i].up && other.up) join(uses[i], other);
  }
}

/// Joins all that goes on into each other; the uses of edges in order.
std::vector<Use> Surface::join_all() {
  std::vector<Use> uses;
  for (std::size_t c = 0; c < mesh_.corners.size(); ++c) {
    const std::int32_t from = mesh_.corners[c], to = mesh_.corners[next(c)];
    uses.push_back({std::min(from, to), std::max(from, to), c, from < to});
  }
  std::sort(uses.begin(), uses.end(), [](const Use& a, const Use& b) {
    return std::tie(a.low, a.high, a.corner) <
           std::tie(b.low, b.high, b.corner);
  });
  for (auto i = uses.begin(); i != uses.end();) {
    const auto end = std::find_if(i, uses.end(), [&](const Use& use) {
      return use.low != i->low || use.high != i->high;
    });
    join_around({i, end});
    i = end;
  }
  return uses;
}

std::vector<std::size_t> Surface::shells() {
  join_all();
  std::map<std::size_t, std::size_t> numbers;
  std::vector<std::size_t> result(mesh_.faces.size());
  for (std::size_t t = 0; t < result.size(); ++t) {
    const auto number = numbers.try_emplace(parts_.find(t), numbers.size());
    result[t] = number.first->second;
  }
  return result;
}

Topology Surface::topology() {
  const std::vector<Use> uses = join_all();
  Topology result;
  result.shells = parts_.count();
  const auto edges = static_cast<std::int64_t>(uses.size() / 2);
  const std::int64_t euler = static_cast<std::int64_t>(fans_.count()) - edges +
                             static_cast<std::int64_t>(mesh_.faces.size());
  result.genus = static_cast<std::int64_t>(result.shells) - euler / 2;
  return result;
}

}  // namespace

Topology topology_of(const fast::Solid& solid) {
  const fast::ExportedMesh mesh =
      fast::to_mesh(solid, {.triangles = true, .threads = 1});
  return Surface(solid, mesh).topology();
}

std::vector<std::size_t> shells_of(const fast::Solid& solid,
                                   const fast::ExportedMesh& triangles) {
  return Surface(solid, triangles).shells();
}

}  // namespace halfspace::csg
