#pragma once

#include <cstdint>
#include <optional>

#include "intersect/operand.hpp"

namespace halfspace::fast {

/// Decides whether a point off a surface is inside (S6.2), by the winding
/// number along a ray. Where a sign at the point is 0, that at `target` counts:
/// the point is moved towards it by an infinitely small step.
class PointLocator {
 public:
  PointLocator(const Operand& operand, const GeometryTable& table);
  /// Without `blocks` all edges of a face are looked at.
  PointLocator(const Solid& solid, const GeometryTable& table,
               const DynamicBvh* index, const EdgePackets* blocks);
  bool is_inside(std::int32_t vertex, std::int32_t target) const {
    return winding(vertex, target) > 0;
  }
  /// The winding number of the surface round the point. If the point is on the
  /// surface: round one right beside it, along the first axis, by far less
  /// along the last, and by far less still along the second.
  int winding(std::int32_t vertex, std::int32_t target) const;
  /// What one face adds to the winding number, for a ray along `axis`.
  /// Requires: it has edges.
  int ray_contribution(int axis, std::int32_t face, std::int32_t vertex,
                       std::int32_t target) const;

 private:
  template <class Found>
  void find(const Box& ray, Found&& found) const;
  bool is_above(int axis, std::int32_t face, std::int32_t vertex,
                std::int32_t target) const;
  bool is_right(int right, std::int32_t v, std::int32_t vertex,
                std::int32_t target) const;
  bool passes_over(int axis, const Face& face, std::uint32_t first,
                   std::uint32_t last, std::int32_t vertex,
                   std::int32_t target) const;

  const Solid& solid_;
  const GeometryTable& table_;
  const DynamicBvh* index_;
  const EdgePackets* blocks_;
  /// The first few questions are not worth an index of its own.
  mutable std::optional<DynamicBvh> own_;
  mutable int asked_ = 0;
};

}  // namespace halfspace::fast
