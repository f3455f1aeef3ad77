#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "box/box.hpp"
#include "exact/exact_plane.hpp"
#include "rounding/grid_mesh.hpp"
#include "rounding/mesh_index.hpp"

namespace halfspace::fast {

/// A ray from the middle of a triangle, along an axis.
class TriangleRay {
 public:
  /// Requires: the triangle's normal has a component along the axis.
  TriangleRay(const GridMesh& mesh, std::int32_t triangle, std::size_t axis);

  /// Holds the triangles that the ray may pass.
  const Box& box() const { return box_; }
  /// Counts another triangle, if the ray passes it.
  void pass(std::int32_t other);
  /// The winding number in front of the triangle, when all others are counted;
  /// nothing if one of them has the middle on it.
  std::optional<int> winding_in_front() const {
    if (!is_sure_) return std::nullopt;
    return faces_along_ ? winding_ : winding_ - 1;
  }

 private:
  Vector3<std::int64_t> from_middle(std::int32_t p) const;

  const GridMesh& mesh_;
  std::int32_t own_;
  std::size_t axis_;
  bool faces_along_;
  std::array<std::int64_t, 3> middle_{};  ///< three times as large
  Box box_;
  bool is_sure_ = true;
  int winding_ = 0;
};

/// The axis along which a triangle's normal has about the largest component.
struct FacingTriangle {
  std::int32_t triangle = 0;
  std::size_t axis = 0;
};

/// A triangle of each part that is as large as any, seen along an axis. By
/// their parts' least triangles.
///
/// `part`: by triangle, the least one of its part; or -1: it has none.
std::vector<FacingTriangle> facing_triangles(
    const GridMesh& mesh, const std::vector<std::int32_t>& part);

/// The winding numbers in front of some triangles; `found(i, winding)` gets
/// them. An empty index: each ray looks at all triangles.
template <class Found>
void for_windings(const GridMesh& mesh, const MeshIndex& index,
                  const std::vector<FacingTriangle>& triangles, Found&& found) {
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    TriangleRay ray(mesh, triangles[i].triangle, triangles[i].axis);
    if (index.is_empty()) {
      for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        ray.pass(static_cast<std::int32_t>(t));
    } else {
      index.find(ray.box(), [&](std::int32_t other) { ray.pass(other); });
    }
    found(i, ray.winding_in_front());
  }
}

}  // namespace halfspace::fast
