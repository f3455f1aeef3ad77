#pragma once

#include <array>
#include <cstdint>
#include <memory_resource>
#include <optional>
#include <unordered_map>
#include <vector>

#include "bounded.hpp"
#include "halfspace/csg/matrix.hpp"
#include "halfspace/csg/surface.hpp"
#include "halfspace/fast/solid.hpp"
#include "node.hpp"

namespace halfspace::detail {

using BoundedPoint = std::array<Bounded, 3>;

/// The vertices of an operand's mesh where a result has the operand: moved, but
/// not rounded. What doubles do not tell is computed when it is first asked
/// for. Units: grid steps.
class PlacedVertices {
 public:
  PlacedVertices(const csg::Matrix& matrix, const Unit& unit,
                 const LeafData& data);

  /// The point of the grid that the vertex certainly is; null where it is none,
  /// or bounds do not tell.
  const GridPoint* on_grid(std::size_t vertex) {
    const Vertex& v = placed_[vertex];
    if (v.state == State::kUnknown) place(vertex);
    return v.state == State::kGrid ? &v.grid : nullptr;
  }
  /// The vertex less a point of the grid.
  BoundedPoint less(std::size_t vertex, const GridPoint& point);
  const csg::ExactPoint& exact(std::size_t vertex);

 private:
  /// mantissa * 2^two * 5^five.
  struct Factor {
    Bounded mantissa;
    std::int32_t two = 0;
    std::int32_t five = 0;
  };
  enum class State : std::uint8_t { kUnknown, kGrid, kBetween };
  struct Vertex {
    State state = State::kUnknown;
    GridPoint grid;
  };

  static Factor factor_of(const io::Number& number);
  static Bounded product_of(const Factor& a, const Factor& b);
  Bounded coordinate(std::size_t vertex, std::size_t axis) const;
  void place_by_doubles();
  void place(std::size_t vertex);

  const csg::Matrix& matrix_;
  const Unit& unit_;
  const std::vector<csg::Numbers3>& from_;
  const LeafData& data_;
  std::array<std::array<Factor, 4>, 3> rows_;  ///< in steps
  /// A row with one factor, +-2^i * 5^j, and nothing to add.
  struct PlainRow {
    std::size_t from = 3;  ///< the coordinate; 3 where there is more to the row
    double factor = 0;     ///< exactly
    bool is_power_of_two = false;
    bool is_for_decimals = false;  ///< see is_whole()
  };
  PlainRow plain_row(const std::array<Factor, 4>& row) const;
  bool is_whole(const PlainRow& row, double from, double& at) const;
  std::array<PlainRow, 3> plain_;
  std::pmr::vector<Vertex> placed_;
  std::unordered_map<std::size_t, csg::ExactPoint> exact_;
};

/// Where three planes of a solid meet, less a point of the grid, which is best
/// near. Units: grid steps.
BoundedPoint meet_less(const fast::Solid& solid,
                       const std::array<std::int32_t, 3>& planes,
                       const GridPoint& point);

}  // namespace halfspace::detail
