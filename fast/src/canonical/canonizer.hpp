#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/id_map.hpp"
#include "canonical/line_plane.hpp"
#include "canonical/own_grid.hpp"
#include "halfspace/fast/solid/canonical_solid.hpp"
#include "solid/loops.hpp"
#include "solid/move_to_table.hpp"

namespace halfspace::fast {

/// A plane at an end, or at both ends, of an edge.
struct PlaneAtEdge {
  std::int32_t low = 0;
  std::int32_t high = 0;
  std::int32_t plane = 0;
  friend auto operator<=>(const PlaneAtEdge&, const PlaneAtEdge&) = default;
};
/// Gives a solid an order of its own: of vertices, loops, faces, planes.
class Canonizer {
 public:
  explicit Canonizer(const Solid& solid) : from_(solid), made_(solid) {
    pack_edges(made_);
  }
  Solid run() {
    put_in_order();
    // Nobody else may extend a table that is copied.
    if (const auto lease = TableLease::of(from_.table)) {
      if (is_most_of_table()) return copied();
    }
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
  bool is_most_of_table() const;
  Solid copied();
  void set_unit(const Unit& unit);
  std::vector<std::int32_t> first_vertices();
  const LinePlane* line_plane(std::int32_t old) const;
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
  // By rank, of those that have no three such planes: others, as before, or -1.
  std::vector<std::array<std::int32_t, 3>> other_names_;
  // What names edges between faces in one plane; their ids go on from those of
  // the table's planes.
  std::vector<LinePlane> line_planes_;
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

}  // namespace halfspace::fast
