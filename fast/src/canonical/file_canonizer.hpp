#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <utility>

#include "canonical/canonizer.hpp"

namespace halfspace::fast {

/// Whether a grid of 54 bits of that unit reaches as far as the vertices.
bool grid_reaches(const Solid& solid, std::span<const std::int32_t> vertices,
                  const Unit& unit);

/// What it takes for the vertex to be a point; nothing if no grid has it.
std::optional<Fineness> fineness_of_vertex(const Solid& solid,
                                           std::int32_t vertex);

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
  std::int32_t face_plane_on(const SolidEdge& edge, std::int32_t own,
                             std::int32_t other);
  std::int32_t plane_on_line(const SolidEdge& edge, std::int32_t own);
  void name_by_lines();
  void add_unnamed_vertices(Fineness& need);
  void add_other_planes(Fineness& need) const;
  void find_other_planes();
  bool name_planes();
  void give_up(const std::set<std::int32_t>& lines);

  // Which plane stands for another at edges in the plane of a face.
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> on_lines_;
  std::size_t asked_ = 0;  // planes, for such edges
};

}  // namespace halfspace::fast
