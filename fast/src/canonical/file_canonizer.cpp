#include "canonical/file_canonizer.hpp"

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdlib>
#include <set>
#include <utility>
#include <vector>

#include "canonical/lattice_point.hpp"
#include "halfspace/assert.hpp"
#include "halfspace/big_integer.hpp"

namespace halfspace::fast {
namespace {

/// How far the vertices are from the origin at most, along an axis, in steps.
double reach_of(const Solid& solid, std::span<const std::int32_t> vertices,
                const Unit& unit) {
  double most = 0;
  for (const std::int32_t id : vertices) {
    const Vertex& at = solid.table->vertex(id).approximate;
    most = std::max({most, std::abs(at.x), std::abs(at.y), std::abs(at.z)});
  }
  return most * StepRatio(solid.unit, unit).value();
}

struct PlaneAtVertex {
  std::int32_t vertex = 0;
  std::int32_t plane = 0;
  friend auto operator<=>(const PlaneAtVertex&, const PlaneAtVertex&) = default;
};

}  // namespace

bool grid_reaches(const Solid& solid, std::span<const std::int32_t> vertices,
                  const Unit& unit) {
  return reach_of(solid, vertices, unit) < 0x1p53 * (1 - 0x1p-40);
}

std::optional<Fineness> fineness_of_vertex(const Solid& solid,
                                           std::int32_t vertex) {
  const auto exact = exact_vertex(*solid.table, vertex);
  Fineness need;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto one = fineness_of(exact[k], exact[3], solid.unit);
    if (!one) return std::nullopt;
    need.add(*one);
  }
  return need;
}

void FileCanonizer::find_planes_at_edges() {
  at_edges_.reserve(made_.edges.size());
  for (const Face& face : made_.faces) {
    for (const SolidEdge& edge : edges_of(face)) {
      at_edges_.push_back({std::min(edge.from, edge.to),
                           std::max(edge.from, edge.to), face.plane});
    }
  }
  std::sort(at_edges_.begin(), at_edges_.end());
}

bool FileCanonizer::reaches(const Unit& unit) const {
  return grid_reaches(from_, vertices_, unit);
}

Fineness FileCanonizer::fineness_of_plane(std::int32_t plane) const {
  // One of this grid's points is on it.
  return *fineness_of(offset_of(*from_.table, plane), 1, from_.unit);
}

/// Chooses the unit (F7): one that the faces' planes need, and what they do not
/// name.
void FileCanonizer::choose_unit() {
  if (from_.unit.exponent > 0) {
    set_unit(from_.unit);
    find_first_planes();
    find_other_planes();
  } else {
    const Fineness finest = *fineness_of(1, 1, from_.unit);
    Fineness need;
    for (const std::int32_t plane : planes_) {
      need.add(fineness_of_plane(plane));
      if (need == finest) break;
    }
    set_unit(unit_of(need));
    find_first_planes();
    add_unnamed_vertices(need);
    find_other_planes();
    add_other_planes(need);
    go_to(unit_of(need));
    if (name_planes()) return;
    // Others have taken the place of planes on lines.
    add_other_planes(need);
    go_to(unit_of(need));
  }
  while (!name_planes()) go_to({unit_.base, unit_.exponent - 1});
}

/// Adds what it takes for the table's planes at edges to have points.
void FileCanonizer::add_other_planes(Fineness& need) const {
  for (const std::int32_t plane : other_planes_) {
    if (line_plane(plane) == nullptr) need.add(fineness_of_plane(plane));
  }
}

/// Takes a finer unit, or the one before where that does not reach.
void FileCanonizer::go_to(const Unit& unit) {
  if (unit == unit_) return;
  set_unit(reaches(unit) ? unit : from_.unit);
  find_other_planes();
}

/// Finds the first three planes of faces that meet in each vertex that is not
/// on the grid.
void FileCanonizer::find_first_planes() {
  std::vector<PlaneAtVertex> at_vertices;
  for (const Face& face : made_.faces) {
    for (const SolidEdge& edge : edges_of(face)) {
      if (!is_on_grid(edge.from))
        at_vertices.push_back({edge.from, face.plane});
    }
  }
  std::sort(at_vertices.begin(), at_vertices.end());
  at_vertices.erase(std::unique(at_vertices.begin(), at_vertices.end()),
                    at_vertices.end());
  first_planes_.assign(at_vertices.empty() ? 0 : vertices_.size(),
                       {-1, -1, -1});
  std::vector<std::int32_t> planes;
  for (auto at = at_vertices.begin(); at != at_vertices.end();) {
    const std::int32_t vertex = at->vertex;
    planes.clear();
    for (; at != at_vertices.end() && at->vertex == vertex; ++at)
      planes.push_back(at->plane);
    std::array<std::int32_t, 3>& first =
        first_planes_[static_cast<std::size_t>(vertex)];
    for (std::size_t i = 0; i < planes.size() && first[0] < 0; ++i) {
      for (std::size_t j = i + 1; j < planes.size() && first[0] < 0; ++j) {
        for (std::size_t k = j + 1; k < planes.size() && first[0] < 0; ++k) {
          const auto old = [&](std::size_t which) {
            return planes_[static_cast<std::size_t>(planes[which])];
          };
          if (meet_in_point({old(i), old(j), old(k)}))
            first = {planes[i], planes[j], planes[k]};
        }
      }
    }
  }
}

/// Whether three planes meet in one point.
bool FileCanonizer::meet_in_point(
    const std::array<std::int32_t, 3>& planes) const {
  using Big = boost::multiprecision::int512_t;
  std::array<std::array<Big, 3>, 3> n;
  for (std::size_t i = 0; i < 3; ++i) {
    const LinePlane* line = line_plane(planes[i]);
    const Vector3<Int128> normal =
        line != nullptr ? line->normal : from_.table->normal(planes[i]);
    n[i] = {to_big<Big>(normal.x), to_big<Big>(normal.y),
            to_big<Big>(normal.z)};
  }
  Big determinant = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t u = (k + 1) % 3, v = (k + 2) % 3;
    determinant += n[0][k] * (n[1][u] * n[2][v] - n[1][v] * n[2][u]);
  }
  return determinant != 0;
}

/// Adds what it takes for vertices to be points that the faces' planes do not
/// name, or an edge there: all that some grid holds, if one holds them all.
void FileCanonizer::add_unnamed_vertices(Fineness& need) {
  std::vector<std::int32_t> unnamed;
  for (std::size_t rank = 0; rank < first_planes_.size(); ++rank) {
    if (on_grid_[rank] == 0 && first_planes_[rank][0] < 0)
      unnamed.push_back(static_cast<std::int32_t>(rank));
  }
  for (const Face& face : made_.faces) {
    for (const SolidEdge& edge : edges_of(face)) {
      if (!needs_other(edge, face.plane)) continue;
      for (const std::int32_t end : {edge.from, edge.to}) {
        if (!is_on_grid(end)) unnamed.push_back(end);
      }
    }
  }
  Fineness all = need;
  for (const std::int32_t rank : unnamed) {
    const std::int32_t id = vertices_[static_cast<std::size_t>(rank)];
    const auto its = fineness_of_vertex(from_, id);
    if (!its) continue;
    all.add(*its);
    // It has no planes.
    if (from_.table->vertex(id).is_grid()) need.add(*its);
  }
  if (reaches(unit_of(all))) need = all;
  if (unit_of(need) != unit_) set_unit(unit_of(need));
}

/// The first plane of a face, other than that with the number `own`, that an
/// edge is in; else the one that is given. All are the table's.
std::int32_t FileCanonizer::face_plane_on(const SolidEdge& edge,
                                          std::int32_t own,
                                          std::int32_t other) {
  // What is not found in some seconds is not looked for.
  constexpr std::size_t kMostAsked = std::size_t{1} << 28;
  asked_ += planes_.size();
  if (asked_ > kMostAsked) return other;
  const auto is_on = [&](std::int32_t plane, std::int32_t rank) {
    return from_.table->side(plane,
                             vertices_[static_cast<std::size_t>(rank)]) == 0;
  };
  const std::int32_t own_plane = planes_[static_cast<std::size_t>(own)];
  const auto found =
      std::find_if(planes_.begin(), planes_.end(), [&](std::int32_t plane) {
        return plane != own_plane && is_on(plane, edge.from) &&
               is_on(plane, edge.to);
      });
  return found == planes_.end() ? other : *found;
}

/// What names an edge in the plane of a face where the table's plane `other`
/// did: the plane along an axis, or what takes its place if that is given up.
std::int32_t FileCanonizer::plane_on_line(const SolidEdge& edge,
                                          std::int32_t own) {
  const std::int32_t face = planes_[static_cast<std::size_t>(own)];
  const auto known = on_lines_.find({face, edge.other});
  if (known != on_lines_.end()) return known->second;
  std::optional<LinePlane> line = line_plane_of(*from_.table, face, edge.other);
  std::int32_t name = 0;
  if (line) {
    name = static_cast<std::int32_t>(from_.table->plane_count() +
                                     line_planes_.size());
    line_planes_.push_back(*std::move(line));
  } else {
    name = face_plane_on(edge, own, edge.other);
    on_lines_[{face, name}] = name;
  }
  on_lines_[{face, edge.other}] = name;
  return name;
}

/// Names vertices that planes of faces do not by those and by the planes that
/// name the edges there.
void FileCanonizer::name_by_lines() {
  other_names_.assign(first_planes_.size(), {-1, -1, -1});
  // By vertex the planes of faces, by number, and those of edges, by far ends.
  struct Named {
    std::int32_t vertex, far_end, number, plane;
    auto operator<=>(const Named&) const = default;
  };
  std::vector<Named> named;
  for (const Face& face : made_.faces) {
    const std::int32_t plane = planes_[static_cast<std::size_t>(face.plane)];
    for (const SolidEdge& edge : edges_of(face)) {
      for (const auto& [near, far] :
           {std::pair(edge.from, edge.to), std::pair(edge.to, edge.from)}) {
        const auto rank = static_cast<std::size_t>(near);
        if (is_on_grid(near) || first_planes_[rank][0] >= 0) continue;
        named.push_back({near, -1, face.plane, plane});
        if (needs_other(edge, face.plane))
          named.push_back({near, far, face.plane, edge.other});
      }
    }
  }
  std::sort(named.begin(), named.end());
  named.erase(std::unique(named.begin(), named.end()), named.end());
  for (auto first = named.begin(); first != named.end();) {
    const auto last = std::find_if(first, named.end(), [&](const Named& other) {
      return other.vertex != first->vertex;
    });
    auto& name = other_names_[static_cast<std::size_t>(first->vertex)];
    for (auto i = first; i != last && name[0] < 0; ++i) {
      for (auto j = i + 1; j < last && name[0] < 0; ++j) {
        for (auto k = j + 1; k < last && name[0] < 0; ++k) {
          if (meet_in_point({i->plane, j->plane, k->plane}))
            name = {i->plane, j->plane, k->plane};
        }
      }
    }
    first = last;
  }
}

/// Finds the planes of no face that name vertices and edges.
void FileCanonizer::find_other_planes() {
  other_planes_.clear();
  for (const Face& face : made_.faces) {
    for (SolidEdge& edge : edges_of(face)) {
      if (!needs_other(edge, face.plane)) continue;
      HALFSPACE_ASSERT(edge.other >= 0);
      if (line_plane(edge.other) == nullptr)
        edge.other = plane_on_line(edge, face.plane);
      other_planes_.push_back(edge.other);
    }
  }
  name_by_lines();
  for (std::size_t rank = 0; rank < first_planes_.size(); ++rank) {
    if (on_grid_[rank] != 0 || first_planes_[rank][0] >= 0) continue;
    const auto& planes = other_names_[rank][0] >= 0
                             ? other_names_[rank]
                             : from_.table->vertex(vertices_[rank]).planes;
    other_planes_.insert(other_planes_.end(), planes.begin(), planes.end());
  }
  std::sort(other_planes_.begin(), other_planes_.end());
  other_planes_.erase(std::unique(other_planes_.begin(), other_planes_.end()),
                      other_planes_.end());
}

/// Finds the points that name planes: of a face's plane the first vertex on the
/// grid; of others the point nearest to the origin. Returns false where the
/// grid has none for one of them; planes on lines for which it has none near
/// the solid give way to those of the table.
bool FileCanonizer::name_planes() {
  const GeometryTable& table = *from_.table;
  // A point beyond the solid would take a grid of more bits.
  const double reach = 4 * reach_of(from_, vertices_, unit_);
  const auto is_near = [&](const GridPoint& p) {
    const std::int64_t most =
        std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    return static_cast<double>(most) <= reach;
  };
  const auto nearest = [&](std::int32_t plane) -> std::optional<GridPoint> {
    if (const LinePlane* line = line_plane(plane)) {
      const auto offset = (*ratio_)(line->offset, line->below);
      const auto point =
          offset ? lattice_point(line->normal, *offset) : std::nullopt;
      return point && is_near(*point) ? point : std::nullopt;
    }
    const auto offset = (*ratio_)(offset_of(table, plane));
    const auto point = offset
                           ? lattice_point(table.reduced_normal(plane), *offset)
                           : std::nullopt;
    return point || unit_ != from_.unit ? point : table.plane(plane).origin;
  };
  const std::vector<std::int32_t> first = first_vertices();
  plane_points_.clear();
  for (std::size_t p = 0; p < planes_.size(); ++p) {
    const auto point = first[p] < 0
                           ? nearest(planes_[p])
                           : point_of(static_cast<std::size_t>(first[p]));
    if (!point) return false;
    plane_points_.push_back(*point);
  }
  other_points_.clear();
  std::set<std::int32_t> without;
  for (const std::int32_t plane : other_planes_) {
    const auto point = nearest(plane);
    if (!point && line_plane(plane) == nullptr) return false;
    if (!point) without.insert(plane);
    other_points_.push_back(point.value_or(GridPoint{}));
  }
  if (without.empty()) return true;
  give_up(without);
  return name_planes();
}

/// Lets the table's planes name edges again.
void FileCanonizer::give_up(const std::set<std::int32_t>& lines) {
  std::set<std::int32_t> replaced;
  for (const Face& face : made_.faces) {
    for (SolidEdge& edge : edges_of(face)) {
      if (lines.count(edge.other) == 0) continue;
      const LinePlane& line = *line_plane(edge.other);
      if (replaced.insert(edge.other).second) {
        const std::int32_t name = face_plane_on(edge, face.plane, line.instead);
        on_lines_[{line.face, name}] = name;
        on_lines_[{line.face, line.instead}] = name;
      }
      edge.other = on_lines_.at({line.face, line.instead});
    }
  }
  find_other_planes();
}

}  // namespace halfspace::fast
