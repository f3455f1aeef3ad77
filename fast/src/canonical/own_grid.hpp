#pragma once

#include <array>
#include <optional>

#include "exact/big_rational.hpp"
#include "halfspace/scene.hpp"
#include "table/geometry_table.hpp"

/// The unit that a solid has by itself (F7), whichever grid it was made on.
namespace halfspace::fast {

/// The step that numbers need: they are multiples of 2^-two 5^-five model
/// units.
struct Fineness {
  int two = 0;
  int five = 0;
  void add(const Fineness& other);
  friend bool operator==(const Fineness&, const Fineness&) = default;
};

/// What numerator / denominator steps of a unit need, with powers of at most 0;
/// nothing where no power of ten is fine enough. Requires: denominator != 0.
std::optional<Fineness> fineness_of(BigInteger numerator,
                                    BigInteger denominator, const Unit& unit);

/// The coarsest unit of at most 1 that is fine enough: where it is less than 1,
/// a power of two if one will do, and else of ten, which 1 is, too.
Unit unit_of(const Fineness& need);

/// Steps of one unit in steps of another.
class StepRatio {
 public:
  StepRatio(const Unit& from, const Unit& to);
  bool is_one() const { return times_ == 1 && by_ == 1; }
  /// Whether a step of the second is a whole number of the first's.
  bool is_whole() const { return times_ == 1; }
  double value() const { return value_; }
  /// So many steps, divided by `below`; nothing where they are no integer.
  std::optional<BigInteger> operator()(const BigInteger& steps,
                                       const BigInteger& below = 1) const;
  /// Nothing where it is on no grid of 54 bits.
  std::optional<GridPoint> operator()(const GridPoint& point) const;
  std::optional<GridPoint> operator()(
      const std::array<BigInteger, 4>& vertex) const;

 private:
  BigInteger times_ = 1, by_ = 1;
  double value_ = 1;
};

/// The value of the reduced normal on the plane: its product with each point.
BigInteger offset_of(const GeometryTable& table, std::int32_t plane);

/// A vertex exactly: three coordinates, and what they are divided by, above 0.
std::array<BigInteger, 4> exact_vertex(const GeometryTable& table,
                                       std::int32_t vertex);

}  // namespace halfspace::fast
