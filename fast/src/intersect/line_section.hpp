#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "halfspace/fast/solid.hpp"
#include "table/shared_table.hpp"

namespace halfspace::fast {

/// Where a face's edge meets the line in which the face's plane and `across`
/// meet. `from`, `to`: the sides of `across` that its ends are on.
/// Requires: the sides differ.
std::int32_t line_crossing(const Face& face, const SolidEdge& edge, int from,
                           int to, std::int32_t across, GeometryTable& table);

/// The intersection of a face with a line in its plane: points, and parts of
/// the line.
class LineFaceSection {
 public:
  explicit LineFaceSection(GeometryTable& table) : table_(table) {}

  /// With the line along `axis` in the face's plane and another one, `across`.
  void find(const Face& face, std::span<const SolidEdge> edges,
            std::int32_t across, int axis);
  /// From a lower point to a higher one, or a point twice. In no order; they
  /// may overlap.
  std::span<const std::pair<std::int32_t, std::int32_t>> parts() const {
    return parts_;
  }

 private:
  /// Where an edge meets the line, and on which sides of it the face begins or
  /// ends there.
  struct Turn {
    std::int32_t vertex;
    bool positive;
    bool negative;
  };

  void add(const Face& face, const SolidEdge& edge, std::int32_t across);

  GeometryTable& table_;
  std::vector<std::pair<std::int32_t, std::int32_t>> parts_;
  std::vector<Turn> turns_;
};

}  // namespace halfspace::fast
