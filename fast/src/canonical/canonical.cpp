#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/id_map.hpp"
#include "canonical/lattice_point.hpp"
#include "canonical/own_grid.hpp"
#include "halfspace/assert.hpp"
#include "halfspace/big_integer.hpp"
#include "halfspace/fast/solid/canonical_solid.hpp"
#include "solid/loops.hpp"
#include "solid/move_to_table.hpp"
#include "solid/vertex_order.hpp"

namespace halfspace::fast {
namespace {

/// Ids that are given in the order in which they are asked for.
class Renumbering {
 public:
  explicit Renumbering(const IdRange& extent)
      : map_(extent), ids_(map_.size(), -1) {}
  /// -1 where there is none yet.
  std::int32_t& at(std::int32_t old) { return ids_[map_(old)]; }

 private:
  IdMap map_;
  std::vector<std::int32_t> ids_;
};

/// A plane at an end, or at both ends, of an edge.
struct PlaneAtEdge {
  std::int32_t low = 0;
  std::int32_t high = 0;
  std::int32_t plane = 0;
  friend auto operator<=>(const PlaneAtEdge&, const PlaneAtEdge&) = default;
};
struct PlaneAtVertex {
  std::int32_t vertex = 0;
  std::int32_t plane = 0;
  friend auto operator<=>(const PlaneAtVertex&, const PlaneAtVertex&) = default;
};

/// Whether a grid of 54 bits of that unit reaches as far as the vertices.
bool holds(const Solid& solid, std::span<const std::int32_t> vertices,
           const Unit& unit) {
  double most = 0;
  for (const std::int32_t id : vertices) {
    const Vertex& at = solid.table->vertex(id).approximate;
    most = std::max({most, std::abs(at.x), std::abs(at.y), std::abs(at.z)});
  }
  return most * StepRatio(solid.unit, unit).value() < 0x1p53 * (1 - 0x1p-40);
}

/// What it takes for the vertex to be a point; nothing if no grid has it.
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

class Canonizer {
 public:
  explicit Canonizer(const Solid& solid) : from_(solid), made_(solid) {
    pack_edges(made_);
  }
  Solid run() {
    put_in_order();
    set_unit(from_.unit);
    keeps_others_ = true;
    for (const std::int32_t plane : planes_)
      plane_points_.push_back(from_.table->plane(plane).origin);
    return made();
  }
  /// On a grid that has all vertices.
  Solid run_on(const Unit& unit) {
    put_in_order();
    set_unit(unit);
    for (const std::int32_t vertex : first_vertices())
      plane_points_.push_back(*point_of(static_cast<std::size_t>(vertex)));
    return made();
  }

 protected:
  std::span<SolidEdge> edges_of(const Face& face) {
    return {made_.edges.data() + face.first_edge, face.edge_count};
  }
  void put_in_order() {
    rank_vertices();
    for (const Face& face : made_.faces) trace(face);
    sort_faces();
    number_planes();
  }
  Solid made() {
    add_planes();
    add_vertices();
    name_all();
    return std::move(made_);
  }
  void set_unit(const Unit& unit);
  std::vector<std::int32_t> first_vertices();
  std::int32_t other_number(const SolidEdge& edge, std::int32_t own) const;
  bool needs_other(const SolidEdge& edge, std::int32_t own) const;
  std::optional<GridPoint> point_of(std::size_t rank) const;
  bool is_on_grid(std::int32_t rank) const {
    return on_grid_[static_cast<std::size_t>(rank)] != 0;
  }

  const Solid& from_;
  Solid made_;  // edges name vertices by rank, and planes as before
  List<std::int32_t> vertices_;  // by rank, as before
  // Planes of faces, by number, as before; the numbers of those before.
  std::vector<std::int32_t> planes_;
  std::optional<Renumbering> plane_numbers_;
  std::vector<PlaneAtEdge> at_edges_;
  // The unit of the result, and which vertices are on its grid, by rank.
  Unit unit_;
  std::optional<StepRatio> ratio_;
  std::vector<std::uint8_t> on_grid_;
  // By rank, of those that are not on the grid of the faces' planes: the first
  // three numbers of planes that meet there, or -1.
  std::vector<std::array<std::int32_t, 3>> first_planes_;
  // What names planes: those of faces, by number, and others, as before.
  std::vector<GridPoint> plane_points_;
  std::vector<std::int32_t> other_planes_;
  std::vector<GridPoint> other_points_;

 private:
  void rank_vertices();
  void trace(const Face& face);
  void sort_faces();
  void number_planes();
  void add_planes();
  void add_vertices();
  void name_all();
  std::int32_t plane_id(std::int32_t old);

  bool keeps_others_ = false;  // edges keep planes that are no face's
  std::optional<TableLease> lease_;
  std::vector<std::int32_t> new_planes_;    // by number
  std::vector<std::int32_t> new_vertices_;  // by rank
  std::vector<SolidEdge> sorted_;           // of one face
  std::vector<std::uint8_t> used_;
};

/// Gives a solid the unit and the names that it has in a file.
class FileCanonizer : public Canonizer {
 public:
  using Canonizer::Canonizer;
  Solid run() {
    put_in_order();
    find_planes_at_edges();
    choose_unit();
    return made();
  }

 private:
  void find_planes_at_edges();
  void choose_unit();
  void go_to(const Unit& unit);
  bool reaches(const Unit& unit) const;
  Fineness fineness_of_plane(std::int32_t plane) const;
  void find_first_planes();
  bool meet_in_point(const std::array<std::int32_t, 3>& planes) const;
  void add_unnamed_vertices(Fineness& need);
  void find_other_planes();
  bool name_planes();
};

void Canonizer::rank_vertices() {
  IdRange extent;
  for (const SolidEdge& edge : made_.edges) extent.add(edge.from);
  Renumbering ranks(extent);
  List<std::int32_t> named;
  for (const SolidEdge& edge : made_.edges) {
    if (ranks.at(edge.from) >= 0) continue;
    ranks.at(edge.from) = 0;
    named.push_back(edge.from);
  }
  vertices_ = vertices_in_order(named, *from_.table);
  for (std::size_t i = 0; i < vertices_.size(); ++i)
    ranks.at(vertices_[i]) = static_cast<std::int32_t>(i);
  for (SolidEdge& edge : made_.edges)
    edge = {ranks.at(edge.from), ranks.at(edge.to), edge.other};
}

/// Puts a face's edges loop by loop, each from its first vertex on. At a vertex
/// that loops touch, each goes on to the first that is left, and not back.
void Canonizer::trace(const Face& face) {
  const std::span<SolidEdge> edges = edges_of(face);
  const auto before = [](const SolidEdge& x, const SolidEdge& y) {
    return x.from != y.from ? x.from < y.from : x.to < y.to;
  };
  if (edges.size() == 3) {
    // Any three edges go round.
    if (edges[0].to != edges[1].from) std::swap(edges[1], edges[2]);
    std::rotate(edges.begin(),
                std::min_element(edges.begin(), edges.end(), before),
                edges.end());
    return;
  }
  std::vector<SolidEdge>& sorted = sorted_;
  std::vector<std::uint8_t>& used = used_;
  sorted.assign(edges.begin(), edges.end());
  std::sort(sorted.begin(), sorted.end(), before);
  used.assign(sorted.size(), 0);
  const auto next = [&](const SolidEdge& last) {
    std::size_t back = sorted.size();
    for (auto i = static_cast<std::size_t>(
             std::lower_bound(
                 sorted.begin(), sorted.end(), last.to,
                 [](const SolidEdge&e, std::int32_t v) { return e.from < v; }) -
             sorted.begin());
         i < sorted.size() && sorted[i].from == last.to; ++i) {
      if (used[i] != 0) continue;
      if (sorted[i].to != last.from) return i;
      back = i;
    }
    return back;
  };
  std::size_t count = 0;
  for (std::size_t start = 0; start < sorted.size(); ++start) {
    if (used[start] != 0) continue;
    for (std::size_t at = start; at < sorted.size();) {
      used[at] = 1;
      edges[count++] = sorted[at];
      if (sorted[at].to == sorted[start].from) break;
      at = next(sorted[at]);
    }
  }
}

void Canonizer::sort_faces() {
  const auto before = [this](const Face& x, const Face& y) {
    if (x.part != y.part) return x.part < y.part;
    if (x.polygon != y.polygon) return x.polygon < y.polygon;
    const auto a = edges_of(x), b = edges_of(y);
    return std::lexicographical_compare(
        a.begin(), a.end(), b.begin(), b.end(),
        [](const SolidEdge& e, const SolidEdge& f) {
          return e.from != f.from ? e.from < f.from : e.to < f.to;
        });
  };
  if (!std::is_sorted(made_.faces.begin(), made_.faces.end(), before))
    std::sort(made_.faces.begin(), made_.faces.end(), before);
  List<SolidEdge> row;
  row.reserve(made_.edges.size());
  for (Face& face : made_.faces) {
    const std::span<SolidEdge> edges = edges_of(face);
    face.first_edge = static_cast<std::uint32_t>(row.size());
    row.insert(row.end(), edges.begin(), edges.end());
  }
  made_.edges = std::move(row);
}

/// Numbers the planes as faces name them.
void Canonizer::number_planes() {
  IdRange extent;
  for (const Face& face : made_.faces) extent.add(face.plane);
  plane_numbers_.emplace(extent);
  for (Face& face : made_.faces) {
    std::int32_t& number = plane_numbers_->at(face.plane);
    if (number < 0) {
      number = static_cast<std::int32_t>(planes_.size());
      planes_.push_back(face.plane);
    }
    face.plane = number;
  }
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

/// Sets the unit, and finds which vertices are on its grid.
void Canonizer::set_unit(const Unit& unit) {
  unit_ = unit;
  ratio_.emplace(from_.unit, unit);
  on_grid_.resize(vertices_.size());
  for (std::size_t rank = 0; rank < vertices_.size(); ++rank) {
    on_grid_[rank] = ratio_->is_one()
                         ? from_.table->vertex(vertices_[rank]).is_grid()
                         : point_of(rank).has_value();
  }
}

/// The vertex in steps of the unit, if it is on the grid.
std::optional<GridPoint> Canonizer::point_of(std::size_t rank) const {
  const std::int32_t id = vertices_[rank];
  const TableVertex& old = from_.table->vertex(id);
  if (old.is_grid()) return (*ratio_)(old.point());
  if (ratio_->is_whole()) return std::nullopt;
  return (*ratio_)(exact_vertex(*from_.table, id));
}

bool FileCanonizer::reaches(const Unit& unit) const {
  return holds(from_, vertices_, unit);
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
    for (const std::int32_t plane : other_planes_)
      need.add(fineness_of_plane(plane));
    go_to(unit_of(need));
  }
  while (!name_planes()) go_to({unit_.base, unit_.exponent - 1});
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
          if (meet_in_point({planes[i], planes[j], planes[k]}))
            first = {planes[i], planes[j], planes[k]};
        }
      }
    }
  }
}

/// Whether three planes of faces meet in one point.
bool FileCanonizer::meet_in_point(
    const std::array<std::int32_t, 3>& planes) const {
  using Big = boost::multiprecision::int512_t;
  std::array<std::array<Big, 3>, 3> n;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3<Int128> normal =
        from_.table->normal(planes_[static_cast<std::size_t>(planes[i])]);
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

/// Whether an edge of a face needs a plane that is no other face's there.
bool Canonizer::needs_other(const SolidEdge& edge, std::int32_t own) const {
  return !(is_on_grid(edge.from) && is_on_grid(edge.to)) &&
         other_number(edge, own) < 0;
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

/// Finds the planes of no face that name vertices and edges.
void FileCanonizer::find_other_planes() {
  other_planes_.clear();
  for (std::size_t rank = 0; rank < first_planes_.size(); ++rank) {
    if (on_grid_[rank] != 0 || first_planes_[rank][0] >= 0) continue;
    const auto& planes = from_.table->vertex(vertices_[rank]).planes;
    other_planes_.insert(other_planes_.end(), planes.begin(), planes.end());
  }
  for (const Face& face : made_.faces) {
    for (const SolidEdge& edge : edges_of(face)) {
      if (needs_other(edge, face.plane)) other_planes_.push_back(edge.other);
    }
  }
  std::sort(other_planes_.begin(), other_planes_.end());
  other_planes_.erase(std::unique(other_planes_.begin(), other_planes_.end()),
                      other_planes_.end());
  HALFSPACE_ASSERT(other_planes_.empty() || other_planes_.front() >= 0);
}

/// Finds the points that name planes: of a face's plane the first vertex on the
/// grid; of others the point nearest to the origin. Returns false where the
/// grid has none for one of them.
bool FileCanonizer::name_planes() {
  const GeometryTable& table = *from_.table;
  const auto nearest = [&](std::int32_t plane) -> std::optional<GridPoint> {
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
  for (const std::int32_t plane : other_planes_) {
    const auto point = nearest(plane);
    if (!point) return false;
    other_points_.push_back(*point);
  }
  return true;
}

/// By number of a face's plane the first vertex on the grid that is on it, or
/// -1.
std::vector<std::int32_t> Canonizer::first_vertices() {
  std::vector<std::int32_t> first(planes_.size(), -1);
  for (const Face& face : made_.faces) {
    std::int32_t& least = first[static_cast<std::size_t>(face.plane)];
    for (const SolidEdge& edge : edges_of(face)) {
      if (is_on_grid(edge.from) && (least < 0 || edge.from < least))
        least = edge.from;
    }
  }
  return first;
}

/// Adds the planes of faces to a new table.
void Canonizer::add_planes() {
  const GeometryTable& table = *from_.table;
  int bits = table.grid_bits();
  const auto is_held = [bits](const GridPoint& p) {
    return fits(p.x, bits) && fits(p.y, bits) && fits(p.z, bits);
  };
  if (!ratio_->is_whole() ||
      !std::all_of(plane_points_.begin(), plane_points_.end(), is_held) ||
      !std::all_of(other_points_.begin(), other_points_.end(), is_held))
    bits = 54;
  lease_.emplace(TableLease::of_new(bits));
  GeometryTable& to = lease_->table();
  to.reserve(vertices_.size(), planes_.size());
  for (std::size_t p = 0; p < planes_.size(); ++p) {
    new_planes_.push_back(
        to.add_plane(table.normal(planes_[p]), plane_points_[p]).plane);
  }
}

/// The new id of a plane, of a face or not.
std::int32_t Canonizer::plane_id(std::int32_t old) {
  const GeometryTable& table = *from_.table;
  const auto at =
      std::lower_bound(other_planes_.begin(), other_planes_.end(), old);
  const GridPoint& point =
      at == other_planes_.end()
          ? table.plane(old).origin
          : other_points_[static_cast<std::size_t>(at - other_planes_.begin())];
  return lease_->table().add_plane(table.normal(old), point).plane;
}

/// A vertex that is not on the grid is the meet of the first three planes of
/// faces there; of those that it was met by, where the faces have no three.
void Canonizer::add_vertices() {
  GeometryTable& to = lease_->table();
  for (std::size_t rank = 0; rank < vertices_.size(); ++rank) {
    if (on_grid_[rank] != 0) {
      new_vertices_.push_back(to.add_point(*point_of(rank)));
      continue;
    }
    std::array<std::int32_t, 3> planes{};
    const bool is_named = !first_planes_.empty() && first_planes_[rank][0] >= 0;
    for (std::size_t i = 0; i < 3; ++i) {
      planes[i] =
          is_named
              ? new_planes_[static_cast<std::size_t>(first_planes_[rank][i])]
              : plane_id(from_.table->vertex(vertices_[rank]).planes[i]);
    }
    new_vertices_.push_back(to.meet(planes[0], planes[1], planes[2]));
  }
}

/// The number of the first plane of another face at the edge, or -1.
std::int32_t Canonizer::other_number(const SolidEdge& edge,
                                     std::int32_t own) const {
  const PlaneAtEdge least{std::min(edge.from, edge.to),
                          std::max(edge.from, edge.to), -1};
  for (auto at = std::lower_bound(at_edges_.begin(), at_edges_.end(), least);
       at != at_edges_.end() && at->low == least.low && at->high == least.high;
       ++at) {
    if (at->plane != own) return at->plane;
  }
  return -1;
}

/// Makes faces and edges name the new planes and vertices.
void Canonizer::name_all() {
  for (std::size_t f = 0; f < made_.faces.size(); ++f) {
    Face& face = made_.faces[f];
    for (SolidEdge& edge : edges_of(face)) {
      const std::int32_t number = other_number(edge, face.plane);
      std::int32_t other = -1;
      if (number >= 0) {
        other = new_planes_[static_cast<std::size_t>(number)];
      } else if (edge.other >= 0 &&
                 (keeps_others_ || needs_other(edge, face.plane))) {
        other = plane_id(edge.other);
      }
      edge = {new_vertices_[static_cast<std::size_t>(edge.from)],
              new_vertices_[static_cast<std::size_t>(edge.to)], other};
    }
    face.plane = new_planes_[static_cast<std::size_t>(face.plane)];
    face.source = static_cast<PolygonId>(f);
    face.from_first = true;
  }
  made_.unit = unit_;
  made_.table = lease_->shared();
}

}  // namespace

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
  if (!holds(solid, vertices, unit_of(need))) return std::nullopt;
  return Canonizer(solid).run_on(unit_of(need));
}

}  // namespace halfspace::fast
