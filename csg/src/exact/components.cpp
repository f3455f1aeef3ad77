#include "halfspace/csg/components.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>

#include "halfspace/csg/exact_measure.hpp"
#include "halfspace/csg/locate.hpp"
#include "halfspace/csg/surface.hpp"
#include "halfspace/csg/topology.hpp"
#include "halfspace/fast/boolean.hpp"
#include "halfspace/fast/to_mesh.hpp"

namespace halfspace::csg {
namespace {

constexpr std::size_t kNone = SIZE_MAX;

Integer power_of_two(unsigned exponent) {
  Integer power = 1;
  power <<= exponent;
  return power;
}

/// Finds the shell of each edge.
class Shells {
 public:
  explicit Shells(const fast::Solid& solid)
      : solid_(solid),
        surface_(solid),
        mesh_(fast::to_mesh(solid, {.triangles = true, .threads = 1})),
        triangle_shells_(shells_of(solid, mesh_)),
        face_triangles_(solid.faces.size()) {
    for (std::size_t t = 0; t < mesh_.faces.size(); ++t)
      face_triangles_[static_cast<std::size_t>(mesh_.faces[t])].push_back(t);
  }
  std::size_t count() const {
    return triangle_shells_.empty()
               ? 0
               : 1 + *std::max_element(triangle_shells_.begin(),
                                       triangle_shells_.end());
  }
  /// By edge.
  std::vector<std::size_t> of_edges();

 private:
  std::size_t shell_of(const std::vector<std::size_t>& triangles,
                       const fast::SolidEdge& edge);

  const fast::Solid& solid_;
  ExactSurface surface_;
  fast::ExportedMesh mesh_;
  std::vector<std::size_t> triangle_shells_;
  std::vector<std::vector<std::size_t>> face_triangles_;
};

/// That of the triangle which has the beginning of the edge as an edge.
std::size_t Shells::shell_of(const std::vector<std::size_t>& triangles,
                             const fast::SolidEdge& edge) {
  const ExactPoint from = surface_.point(edge.from);
  const auto direction = [&](std::int32_t to) {
    const ExactPoint& p = surface_.point(to);
    Integers3 d;
    for (std::size_t i = 0; i < 3; ++i)
      d[i] = p.at[i] * from.below - from.at[i] * p.below;
    return d;
  };
  const Integers3 along = direction(edge.to);
  const auto point = [&](std::size_t corner) {
    return mesh_.points[static_cast<std::size_t>(mesh_.corners[corner])];
  };
  for (const std::size_t t : triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (point(3 * t + k) != edge.from) continue;
      const Integers3 side = direction(point(3 * t + (k + 1) % 3));
      if (cross(along, side) == Integers3{} && dot(along, side) > 0)
        return triangle_shells_[t];
    }
  }
  return triangle_shells_[triangles.front()];
}

std::vector<std::size_t> Shells::of_edges() {
  std::vector<std::size_t> shells(solid_.edges.size(), kNone);
  for (std::size_t f = 0; f < solid_.faces.size(); ++f) {
    const fast::Face& face = solid_.faces[f];
    const std::vector<std::size_t>& triangles = face_triangles_[f];
    if (triangles.empty()) continue;
    const bool is_one =
        std::all_of(triangles.begin(), triangles.end(), [&](std::size_t t) {
          return triangle_shells_[t] == triangle_shells_[triangles.front()];
        });
    for (std::size_t i = 0; i < face.edge_count; ++i) {
      const std::size_t edge = face.first_edge + i;
      shells[edge] = is_one ? triangle_shells_[triangles.front()]
                            : shell_of(triangles, solid_.edges[edge]);
    }
  }
  return shells;
}

/// The solid's edges by part, as solids.
std::vector<fast::Solid> parted(const fast::Solid& solid,
                                const std::vector<std::size_t>& part_of_edge,
                                std::size_t count) {
  std::vector<fast::Solid> parts(count);
  for (fast::Solid& part : parts) {
    part.unit = solid.unit;
    part.table = solid.table;
    part.is_conforming = solid.is_conforming;
  }
  std::vector<std::size_t> met;  // parts of one face
  for (const fast::Face& face : solid.faces) {
    met.clear();
    for (std::size_t i = 0; i < face.edge_count; ++i) {
      const std::size_t edge = face.first_edge + i;
      const std::size_t p = part_of_edge[edge];
      if (p == kNone) continue;
      fast::Solid& part = parts[p];
      if (std::find(met.begin(), met.end(), p) == met.end()) {
        met.push_back(p);
        fast::Face copy = face;
        copy.first_edge = static_cast<std::uint32_t>(part.edges.size());
        copy.edge_count = 0;
        part.faces.push_back(copy);
      }
      part.edges.push_back(solid.edges[edge]);
      ++part.faces.back().edge_count;
    }
  }
  return parts;
}

using Box = std::array<std::array<double, 3>, 2>;

/// Whether the inner box may be within the outer one, whose corners are to the
/// nearest doubles, too: rounding keeps their order.
bool may_hold(const Box& outer, const Box& inner) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (outer[0][i] > inner[0][i] || outer[1][i] < inner[1][i]) return false;
  }
  return true;
}

/// The least of the shells `outer` that `hole`, which faces inwards, is within.
/// Requires: it is within one of them.
std::size_t shell_around(const fast::Solid& hole,
                         const std::vector<std::size_t>& outer,
                         const std::vector<fast::Solid>& shells) {
  if (outer.size() == 1) return outer.front();
  fast::Solid around = hole;
  around.unbounded = true;
  const fast::Solid cavity = fast::complement(std::move(around));
  std::size_t least = kNone;
  // Shells do not cross: of those that are larger, the ones that have a part of
  // the cavity have all of it, and the least of them is next to it.
  for (const std::size_t o : outer) {
    if (compare_volumes(shells[o], cavity) <= 0) continue;
    if (least != kNone && compare_volumes(shells[o], shells[least]) >= 0)
      continue;
    const bool has_it =
        !fast::boolean(BooleanOp::kIntersection, shells[o], cavity)
             .faces.empty();
    if (has_it) least = o;
  }
  return least;
}

/// By shell, the one on the outside of the part that it bounds.
std::vector<std::size_t> outsides_of(const std::vector<fast::Solid>& shells) {
  std::vector<std::size_t> outsides(shells.size(), kNone), outer;
  const fast::Solid nothing;
  for (std::size_t s = 0; s < shells.size(); ++s) {
    if (compare_volumes(shells[s], nothing) <= 0) continue;
    outsides[s] = s;
    outer.push_back(s);
  }
  if (outer.size() == shells.size()) return outsides;
  std::vector<Box> boxes;
  for (const fast::Solid& shell : shells) boxes.push_back(bounds_of(shell));
  for (std::size_t s = 0; s < shells.size(); ++s) {
    if (outsides[s] != kNone) continue;
    std::vector<std::size_t> around;
    for (const std::size_t o : outer) {
      if (may_hold(boxes[o], boxes[s])) around.push_back(o);
    }
    outsides[s] = shell_around(shells[s], around, shells);
  }
  return outsides;
}

/// A point of the face, away from its edges: the middle of a triangle.
ExactPoint middle_of(const fast::Solid& solid, ExactSurface& surface) {
  const fast::ExportedMesh mesh =
      fast::to_mesh(solid, {.triangles = true, .threads = 1});
  ExactPoint sum{{0, 0, 0}, 1};
  for (std::size_t k = 0; k < 3; ++k) {
    const ExactPoint& p =
        surface.point(mesh.points[static_cast<std::size_t>(mesh.corners[k])]);
    for (std::size_t i = 0; i < 3; ++i)
      sum.at[i] = sum.at[i] * p.below + p.at[i] * sum.below;
    sum.below *= p.below;
  }
  sum.below *= 3;
  return sum;
}

}  // namespace

std::vector<fast::Solid> components_of(const fast::Solid& solid) {
  if (solid.faces.empty()) return {};
  Shells finder(solid);
  std::vector<std::size_t> part_of_edge = finder.of_edges();
  const std::vector<std::size_t> outsides =
      outsides_of(parted(solid, part_of_edge, finder.count()));
  std::map<std::size_t, std::size_t> numbers;  // of parts, by outer shell
  for (std::size_t& part : part_of_edge) {
    if (part == kNone) continue;
    part = numbers.try_emplace(outsides[part], numbers.size()).first->second;
  }
  return parted(solid, part_of_edge, numbers.size());
}

Numbers3 point_within(const fast::Solid& solid) {
  ExactSurface surface(solid);
  const ExactPoint on = middle_of(solid, surface);
  // Nearer and nearer to it, on the finer and finer grids of 2^bits to a step.
  for (int bits = -56;; ++bits) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const int way : {-1, 1}) {
        const unsigned fine = static_cast<unsigned>(std::max(bits + 12, 0));
        ExactPoint p{{0, 0, 0}, power_of_two(fine)};
        for (std::size_t i = 0; i < 3; ++i)
          p.at[i] = Integer((on.at[i] << fine) / on.below);
        const int by = static_cast<int>(fine) - bits;
        Integer step = way;
        step *= power_of_two(static_cast<unsigned>(by));
        p.at[axis] += step;
        if (location_of(solid, p) >= 0) continue;
        Numbers3 point;
        const Unit unit = solid.unit;
        for (std::size_t i = 0; i < 3; ++i) {
          point[i] =
              io::normalised(p.at[i], unit.exponent - static_cast<int>(fine),
                             unit.base == 10 ? unit.exponent : 0);
        }
        return point;
      }
    }
  }
}

fast::Solid component_at(const fast::Solid& solid, const Numbers3& point) {
  const ExactPoint at = in_steps(point, solid.unit);
  for (fast::Solid& component : components_of(solid)) {
    if (location_of(component, at) < 0) return std::move(component);
  }
  fast::Solid nothing;
  nothing.unit = solid.unit;
  nothing.table = solid.table;
  return nothing;
}

}  // namespace halfspace::csg
