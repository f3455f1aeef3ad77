#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "halfspace/fast/display_tree.hpp"
#include "halfspace/moving.hpp"
#include "halfspace/threads.hpp"
#include "sah/primitive.hpp"

namespace halfspace::fast {

/// Boxes that no splitter of a tree may cut (S12.4), and what their build
/// finds.
class KeptCells {
 public:
  KeptCells(const std::vector<MovingObject>& objects, bool cut)
      : objects_(objects), cut_(cut) {}

  const Region& region(std::int32_t object) const {
    return objects_[static_cast<std::size_t>(object)].region;
  }
  std::size_t count() const { return objects_.size(); }
  bool cuts() const { return cut_; }

  /// Notes a polygon in a region. The lowest region counts, then the lowest
  /// polygon. Called from any thread.
  void note_polygon(std::int32_t object, PolygonId polygon);
  /// Notes regions that no plane divides without cutting one of them.
  void note_locked(std::int32_t object);

  const std::optional<std::pair<std::int32_t, PolygonId>>& filled() const {
    return filled_;
  }
  std::optional<std::int32_t> locked() const { return locked_; }

 private:
  const std::vector<MovingObject>& objects_;
  bool cut_;
  Mutex mutex_;
  std::optional<std::pair<std::int32_t, PolygonId>> filled_;
  std::optional<std::int32_t> locked_;
};

/// A plane across an axis that cuts none of the boxes.
struct CellSplit {
  std::int32_t axis = 0;
  std::int64_t coordinate = 0;
};

/// The plane that divides these regions most evenly; nothing if each cuts one.
///
/// Cost: n log n.
std::optional<CellSplit> balanced_split(
    const KeptCells& cells, const std::vector<std::int32_t>& regions);

/// A face of a region, of those that `used` has no bit for, beyond which most
/// primitives lie; then any that one reaches; then, if there are primitives at
/// all, any. `index` is 2 axis, and one more for the greater coordinate.
struct FaceChoice {
  std::uint32_t index = 0;
  CellSplit plane;
};
std::optional<FaceChoice> best_face(const Region& region, std::uint32_t used,
                                    const PrimitiveList& list,
                                    const GridPoint& origin);

/// A display tree in which each region of `cells` is a leaf without fragments,
/// and which node that is.
struct KeptTree {
  BspTree tree;
  std::vector<NodeId> node_of_object;  ///< kNoNode where the build stopped
};
KeptTree build_cell_tree(const Scene& scene, KeptCells& cells,
                         const DisplayTreeOptions& options, FilterStats& stats);

}  // namespace halfspace::fast
