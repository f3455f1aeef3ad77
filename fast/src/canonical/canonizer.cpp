#include "canonical/canonizer.hpp"

#include <algorithm>
#include <utility>

#include "halfspace/assert.hpp"
#include "solid/vertex_order.hpp"

namespace halfspace::fast {

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

/// Whether the solid has enough of what is in its table for a copy of that, for
/// which all of it is read once, to take less time than making it anew.
bool Canonizer::is_most_of_table() const {
  constexpr std::size_t kShare = 8;  // untuned
  return from_.table->plane_count() <= kShare * made_.faces.size() &&
         from_.table->vertex_count() <= kShare * vertices_.size();
}

/// The solid on the grid that it is on, in a table with copies of its planes
/// and points: made() without computing any.
Solid Canonizer::copied() {
  const GeometryTable& from = *from_.table;
  const auto is_meet = [&](std::int32_t v) {
    return !from.vertex(v).is_grid();
  };
  IdRange extent;
  for (const std::int32_t p : planes_) extent.add(p);
  for (const std::int32_t v : vertices_) {
    if (!is_meet(v)) continue;
    for (const std::int32_t p : from.vertex(v).planes) extent.add(p);
  }
  for (const SolidEdge& edge : made_.edges) {
    if (edge.other >= 0) extent.add(edge.other);
  }
  Renumbering ids(extent);
  std::vector<std::int32_t> planes;
  const auto id_of = [&](std::int32_t p) {
    std::int32_t& id = ids.at(p);
    if (id < 0) {
      id = static_cast<std::int32_t>(planes.size());
      planes.push_back(p);
    }
    return id;
  };
  // In made()'s order: those of faces have their numbers as ids.
  for (const std::int32_t p : planes_) id_of(p);
  for (const std::int32_t v : vertices_) {
    if (!is_meet(v)) continue;
    for (const std::int32_t p : from.vertex(v).planes) id_of(p);
  }
  for (SolidEdge& edge : made_.edges) {
    if (edge.other >= 0) edge.other = id_of(edge.other);
  }
  for (std::size_t f = 0; f < made_.faces.size(); ++f) {
    made_.faces[f].source = static_cast<PolygonId>(f);
    made_.faces[f].from_first = true;
  }
  TableLease lease = TableLease::of_new(from.grid_bits());
  lease.table().copy(from, planes, vertices_);
  made_.table = lease.shared();
  return std::move(made_);
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

/// Whether an edge of a face needs a plane that is no other face's there.
bool Canonizer::needs_other(const SolidEdge& edge, std::int32_t own) const {
  return !(is_on_grid(edge.from) && is_on_grid(edge.to)) &&
         other_number(edge, own) < 0;
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

/// The plane of that id, if it is not the table's.
const LinePlane* Canonizer::line_plane(std::int32_t old) const {
  const auto count = static_cast<std::int32_t>(from_.table->plane_count());
  return old < count ? nullptr
                     : &line_planes_[static_cast<std::size_t>(old - count)];
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
  const LinePlane* line = line_plane(old);
  return lease_->table()
      .add_plane(line != nullptr ? line->normal : table.normal(old), point)
      .plane;
}

/// A vertex that is not on the grid is the meet of the first three planes of
/// faces there; where the faces have no three, of others that name it, or of
/// those that it was met by.
void Canonizer::add_vertices() {
  GeometryTable& to = lease_->table();
  for (std::size_t rank = 0; rank < vertices_.size(); ++rank) {
    if (on_grid_[rank] != 0) {
      new_vertices_.push_back(to.add_point(*point_of(rank)));
      continue;
    }
    std::array<std::int32_t, 3> planes{};
    const bool is_named = !first_planes_.empty() && first_planes_[rank][0] >= 0;
    const bool has_others = !other_names_.empty() && other_names_[rank][0] >= 0;
    const auto& others = has_others
                             ? other_names_[rank]
                             : from_.table->vertex(vertices_[rank]).planes;
    for (std::size_t i = 0; i < 3; ++i) {
      planes[i] =
          is_named
              ? new_planes_[static_cast<std::size_t>(first_planes_[rank][i])]
              : plane_id(others[i]);
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

}  // namespace halfspace::fast
