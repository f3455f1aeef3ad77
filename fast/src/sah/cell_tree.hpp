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

/// Regions that no splitter of a tree may cut (S12.4), and what their build
/// finds.
class KeptCells {
 public:
  KeptCells(const std::vector<MovingObject>& objects, bool cut);

  const ObjectRegion& region(std::int32_t object) const {
    return objects_[static_cast<std::size_t>(object)].region;
  }
  std::size_t count() const { return objects_.size(); }
  /// The slanted faces of all regions, those of each one after another, and
  /// then planes between two that no plane across an axis parts.
  const SlantedFaces& slanted() const { return slanted_; }
  const std::vector<std::pair<std::int32_t, std::int32_t>>& pairs() const {
    return pairs_;
  }
  std::int64_t plane_of_pair(std::size_t pair) const {
    return first_slanted_.back() + static_cast<std::int64_t>(pair);
  }
  std::int64_t first_slanted(std::int32_t object) const {
    return first_slanted_[static_cast<std::size_t>(object)];
  }
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
  SlantedFaces slanted_;
  std::vector<std::int64_t> first_slanted_;  ///< by object, and the pairs'
  std::vector<std::pair<std::int32_t, std::int32_t>> pairs_;
  Mutex mutex_;
  std::optional<std::pair<std::int32_t, PolygonId>> filled_;
  std::optional<std::int32_t> locked_;
};

/// A plane that cuts none of the regions, and those on its positive side.
struct CellSplit {
  FreePlane plane;
  std::vector<std::int32_t> positive;
  std::vector<std::int32_t> negative;
};

/// The plane across an axis that divides these regions most evenly; where each
/// cuts one, the slanted face of one of them, or a plane between two; nothing
/// if each of those does.
///
/// Exact: yes.
/// Cost:  n log n, where planes across axes divide them; else n for each face.
std::optional<CellSplit> balanced_split(
    const KeptCells& cells, const std::vector<std::int32_t>& regions);

/// A face of the object's region, of those that `used` has no bit for, beyond
/// which most primitives lie; then any that one reaches; then, if there are
/// primitives at all, any. `index` is 2 axis, and one more for the greater
/// coordinate, or 6 and the number of a slanted face.
struct FaceChoice {
  std::uint32_t index = 0;
  CellSplit split;
};
std::optional<FaceChoice> best_face(const KeptCells& cells, std::int32_t object,
                                    std::uint64_t used,
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
