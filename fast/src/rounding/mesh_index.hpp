#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "box/bvh.hpp"
#include "rounding/grid_mesh.hpp"

namespace halfspace::fast {

Box box_of(const GridMesh& mesh, const GridTriangle& triangle);

/// Finds a mesh's triangles by their boxes, while few of them change: those
/// that did since the tree was made are in a small one of their own.
class MeshIndex {
 public:
  MeshIndex() = default;
  /// Knows the mesh as it is now alone.
  explicit MeshIndex(const GridMesh& mesh);

  bool is_empty() const { return !tree_.has_value(); }
  /// Goes on with a mesh that came from one that it knew: points that are
  /// marked have moved, triangles were dropped, others added with no number.
  /// Does nothing if it is empty.
  void follow(GridMesh& mesh) { follow(mesh, mesh.moved); }
  /// The same, where other marks say which points have moved since.
  void follow(GridMesh& mesh, const std::vector<std::uint8_t>& moved);
  /// Begins anew, with all triangles of a mesh that it followed, if it is empty
  /// or much has changed.
  void keep_up(GridMesh& mesh);

  /// Calls `found(triangle)` for each whose box overlaps `box`.
  template <class Found>
  void find(const Box& box, Found&& found) const {
    tree_->find(box, [&](std::int32_t number) {
      const std::int32_t t = places_[static_cast<std::size_t>(number)];
      if (t >= 0) found(t);
    });
    if (changed_) changed_->find(box, found);
  }

 private:
  std::optional<BoxTree> tree_;
  std::vector<std::int32_t> places_;  ///< by number: the triangle, or -1
  std::optional<BoxTree> changed_;
  std::size_t changed_count_ = 0;
};

}  // namespace halfspace::fast
