#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/id_map.hpp"
#include "halfspace/big_integer.hpp"
#include "halfspace/fast/solid/canonical_solid.hpp"
#include "solid/lattice_point.hpp"
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

class Canonizer {
 public:
  Canonizer(const Solid& solid, bool names)
      : from_(solid),
        made_(solid),
        names_(names),
        lease_(TableLease::of_new(grid_bits_of(solid))) {
    pack_edges(made_);
  }
  Solid run() {
    rank_vertices();
    for (const Face& face : made_.faces) trace(face);
    sort_faces();
    number_planes();
    if (names_) {
      find_planes_at_edges();
      find_planes_at_vertices();
    }
    add_planes();
    add_vertices();
    name_all();
    return std::move(made_);
  }

 private:
  std::span<SolidEdge> edges_of(const Face& face) {
    return {made_.edges.data() + face.first_edge, face.edge_count};
  }
  void rank_vertices();
  void trace(const Face& face);
  void sort_faces();
  void number_planes();
  void find_planes_at_edges();
  void find_planes_at_vertices();
  void add_planes();
  void add_vertices();
  void name_all();
  std::int32_t other_plane(const SolidEdge& edge, std::int32_t own) const;
  bool meet_in_point(const std::array<std::int32_t, 3>& planes) const;
  std::array<std::int32_t, 3> first_planes(std::int32_t vertex);
  /// The new ids of the planes that a vertex was met by.
  std::array<std::int32_t, 3> planes_before(const TableVertex& old) {
    return {plane_id(old.planes[0]), plane_id(old.planes[1]),
            plane_id(old.planes[2])};
  }
  std::int32_t plane_id(std::int32_t old);
  /// What names a plane without a vertex on the grid, through this point.
  GridPoint naming_point(const Vector3<Int128>& normal,
                         const GridPoint& origin) const {
    return names_ ? lattice_point(normal, origin, from_.unit.base,
                                  grid_bits_of(from_))
                  : origin;
  }
  /// Whether both ends are of the grid, so that no plane need be named.
  bool is_on_grid(const SolidEdge& edge) const {
    const auto is_grid = [this](std::int32_t rank) {
      return from_.table->vertex(vertices_[static_cast<std::size_t>(rank)])
          .is_grid();
    };
    return is_grid(edge.from) && is_grid(edge.to);
  }

  const Solid& from_;
  Solid made_;  // edges name vertices by rank, and planes as before
  bool names_;
  TableLease lease_;
  List<std::int32_t> vertices_;  // by rank, as before
  // Planes of faces, by number, as before; the numbers of those before.
  std::vector<std::int32_t> planes_;
  std::optional<Renumbering> plane_numbers_;
  std::vector<PlaneAtEdge> at_edges_;
  std::vector<PlaneAtVertex> at_vertices_;
  std::vector<std::int32_t> new_planes_;    // by number
  std::vector<std::int32_t> new_vertices_;  // by rank
  std::vector<SolidEdge> sorted_;           // of one face
  std::vector<std::uint8_t> used_;
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

void Canonizer::find_planes_at_edges() {
  at_edges_.reserve(made_.edges.size());
  for (const Face& face : made_.faces) {
    for (const SolidEdge& edge : edges_of(face)) {
      at_edges_.push_back({std::min(edge.from, edge.to),
                           std::max(edge.from, edge.to), face.plane});
    }
  }
  std::sort(at_edges_.begin(), at_edges_.end());
}

void Canonizer::find_planes_at_vertices() {
  const GeometryTable& table = *from_.table;
  for (const Face& face : made_.faces) {
    for (const SolidEdge& edge : edges_of(face)) {
      const std::int32_t old = vertices_[static_cast<std::size_t>(edge.from)];
      if (!table.vertex(old).is_grid())
        at_vertices_.push_back({edge.from, face.plane});
    }
  }
  std::sort(at_vertices_.begin(), at_vertices_.end());
  at_vertices_.erase(std::unique(at_vertices_.begin(), at_vertices_.end()),
                     at_vertices_.end());
}

/// Adds the planes of faces, by their first vertices on the grid.
void Canonizer::add_planes() {
  const GeometryTable& table = *from_.table;
  std::vector<std::int32_t> first(planes_.size(), -1);
  for (const Face& face : made_.faces) {
    if (!names_) break;
    std::int32_t& least = first[static_cast<std::size_t>(face.plane)];
    for (const SolidEdge& edge : edges_of(face)) {
      const std::int32_t old = vertices_[static_cast<std::size_t>(edge.from)];
      if (table.vertex(old).is_grid() && (least < 0 || edge.from < least))
        least = edge.from;
    }
  }
  GeometryTable& to = lease_.table();
  to.reserve(vertices_.size(), planes_.size());
  for (std::size_t i = 0; i < planes_.size(); ++i) {
    const Vector3<Int128> normal = table.normal(planes_[i]);
    const GridPoint origin =
        first[i] < 0
            ? naming_point(normal, table.plane(planes_[i]).origin)
            : table.vertex(vertices_[static_cast<std::size_t>(first[i])])
                  .point();
    new_planes_.push_back(to.add_plane(normal, origin).plane);
  }
}

/// The new id of a plane, of a face or not.
std::int32_t Canonizer::plane_id(std::int32_t old) {
  const GeometryTable& table = *from_.table;
  const Vector3<Int128> normal = table.normal(old);
  return lease_.table()
      .add_plane(normal, naming_point(normal, table.plane(old).origin))
      .plane;
}

/// Whether three planes of faces meet in one point.
bool Canonizer::meet_in_point(const std::array<std::int32_t, 3>& planes) const {
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

/// The new ids of the first three planes of faces that meet in the vertex; of
/// those that it was met by, where the faces there have no three.
std::array<std::int32_t, 3> Canonizer::first_planes(std::int32_t vertex) {
  const auto first = std::lower_bound(
      at_vertices_.begin(), at_vertices_.end(), vertex,
      [](const PlaneAtVertex& at, std::int32_t v) { return at.vertex < v; });
  std::vector<std::int32_t> planes;
  for (auto at = first; at != at_vertices_.end() && at->vertex == vertex; ++at)
    planes.push_back(at->plane);
  const auto id = [this](std::int32_t number) {
    return new_planes_[static_cast<std::size_t>(number)];
  };
  for (std::size_t i = 0; i < planes.size(); ++i) {
    for (std::size_t j = i + 1; j < planes.size(); ++j) {
      for (std::size_t k = j + 1; k < planes.size(); ++k) {
        if (meet_in_point({planes[i], planes[j], planes[k]}))
          return {id(planes[i]), id(planes[j]), id(planes[k])};
      }
    }
  }
  return planes_before(
      from_.table->vertex(vertices_[static_cast<std::size_t>(vertex)]));
}

void Canonizer::add_vertices() {
  GeometryTable& to = lease_.table();
  for (std::size_t rank = 0; rank < vertices_.size(); ++rank) {
    const TableVertex& old = from_.table->vertex(vertices_[rank]);
    if (old.is_grid()) {
      new_vertices_.push_back(to.add_point(old.point()));
      continue;
    }
    const auto [p, q, r] = names_
                               ? first_planes(static_cast<std::int32_t>(rank))
                               : planes_before(old);
    new_vertices_.push_back(to.meet(p, q, r));
  }
}

/// The new id of the first plane of another face at the edge.
std::int32_t Canonizer::other_plane(const SolidEdge& edge,
                                    std::int32_t own) const {
  const PlaneAtEdge least{std::min(edge.from, edge.to),
                          std::max(edge.from, edge.to), -1};
  for (auto at = std::lower_bound(at_edges_.begin(), at_edges_.end(), least);
       at != at_edges_.end() && at->low == least.low && at->high == least.high;
       ++at) {
    if (at->plane != own)
      return new_planes_[static_cast<std::size_t>(at->plane)];
  }
  return -1;
}

/// Makes faces and edges name the new planes and vertices.
void Canonizer::name_all() {
  for (std::size_t f = 0; f < made_.faces.size(); ++f) {
    Face& face = made_.faces[f];
    for (SolidEdge& edge : edges_of(face)) {
      std::int32_t other = names_ ? other_plane(edge, face.plane) : -1;
      if (other < 0 && edge.other >= 0 && !(names_ && is_on_grid(edge)))
        other = plane_id(edge.other);
      edge = {new_vertices_[static_cast<std::size_t>(edge.from)],
              new_vertices_[static_cast<std::size_t>(edge.to)], other};
    }
    face.plane = new_planes_[static_cast<std::size_t>(face.plane)];
    face.source = static_cast<PolygonId>(f);
    face.from_first = true;
  }
  made_.table = lease_.shared();
}

}  // namespace

Solid canonical(const Solid& solid, bool names) {
  const bool is_bounded =
      !solid.unbounded &&
      std::all_of(solid.faces.begin(), solid.faces.end(),
                  [](const Face& face) { return face.edge_count > 0; });
  if (!is_bounded || solid.faces.empty()) return solid;
  return Canonizer(solid, names).run();
}

}  // namespace halfspace::fast
