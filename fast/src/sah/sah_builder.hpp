#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "sah/build_state.hpp"
#include "sah/cell_division.hpp"
#include "sah/polygon_split.hpp"
#include "sah/primitive.hpp"
#include "tree/fragment_splitter.hpp"

namespace halfspace::fast {

/// A leaf without fragments, by its node in a piece.
struct KeptLeaf {
  std::int32_t region;
  NodeId node;
};

/// A list to be divided, with all that its primitives refer to, and the result.
struct BuildJob {
  std::vector<Primitive> primitives;
  std::vector<FragmentRef> parts;
  Box box = kEmptyBox;
  double share = 1;       ///< of the work
  double cut_budget = 0;  ///< how many cuts the subtree may make, about
  /// Corners of parts, cut vertices and free planes, those of the splitters
  /// above first.
  std::unique_ptr<BspTree> tree = std::make_unique<BspTree>();
  std::size_t inherited_planes = 0;
  /// Regions in it that are still to be kept apart (S12.4): if it is one, the
  /// faces of it that are splitters already, a bit each.
  std::vector<std::int32_t> regions;
  std::uint64_t used_faces = 0;

  /// The subtree of the list, or its root. Indices are those of its own arrays,
  /// but free planes of the splitters above, which it does not hold, count
  /// first.
  BspTree piece;
  FilterStats stats;
  /// Its leaves that are kept free.
  std::vector<KeptLeaf> cells;
  /// If the piece is a root alone: the jobs of its subtrees.
  BuildJob* positive = nullptr;
  BuildJob* negative = nullptr;
};

/// Carries out one job: divides lists of primitives by the planes of least
/// cost.
class SahBuilder {
 public:
  SahBuilder(BuildState& state, BuildJob& job);

  /// Leaves in the job what is of its polygons in the region, whose faces are
  /// the splitters above. Requires: whole polygons, a part of each box in it.
  void cut_to(const CellRegion& region);

  /// Builds the whole subtree.
  void build_subtree();

  /// Builds the root, and the jobs of its subtrees, of those that are not
  /// empty.
  struct Subtrees {
    std::optional<BuildJob> positive;
    std::optional<BuildJob> negative;
  };
  Subtrees build_root();
  /// The same where the job has regions: divides between them, or along a face
  /// of the only one.
  Subtrees build_region_root();

 private:
  /// A list on top of the stack of primitives.
  struct Task {
    std::size_t first;
    std::size_t count;
    Box box;
    double share;
    double cut_budget;
    NodeId parent;
    Side side;
  };
  /// The lists into which a task's was divided: the negative side's takes its
  /// place, the positive side's is in positive_.
  struct Partition {
    std::size_t negative_count = 0;
    Box positive_box = kEmptyBox;
    Box negative_box = kEmptyBox;
  };
  /// A splitter: a plane across an axis, or that of a polygon.
  struct Splitter {
    PlaneId id;
    FilterPlane plane;
    const AxisSplit* axis;  ///< or none
  };

  void take_free_planes();
  NodeId add_node(const Task& task);
  std::optional<Partition> build_node(const Task& task);
  PrimitiveList list_of(const Task& task) const {
    return {primitives_.data() + task.first, task.count};
  }
  PlaneId add_free_plane(const AxisSplit& split);
  double overdraw_cost(const Task& task);
  double cut_budget_for_each(const Task& task, const Partition& parts) const;

  Partition distribute(const Task& task, const Splitter& splitter);
  void split_or_send(const Primitive& primitive, const Splitter& splitter,
                     Partition& result, std::size_t& negative_end);
  void send(const Primitive& primitive, int side, Partition& result,
            std::size_t& negative_end);
  Primitive primitive_of(const Primitive& whole, const FragmentRef& part,
                         int side, const AxisSplit* axis);
  FragmentRef fragment_of(const Primitive& primitive);
  bool keep_side(Primitive& primitive, const Splitter& splitter, int side);

  Box box_of(const ObjectRegion& region) const;
  void keep_cell(const Task& task, std::int32_t region);
  void make_leaf(NodeId id, const Task& task);
  bool is_flat(const Task& task, PolygonId& splitter);
  std::size_t corner_count(const Primitive& primitive) const;
  void sort_for_leaf(std::vector<Primitive>& primitives) const;
  void add_fragments(NodeId id, std::vector<Primitive>& primitives);

  BuildJob job_of(const PrimitiveList& list, const Box& box, double share,
                  double cut_budget) const;
  Box absolute(const Box& box) const;
  void add_done(double share);

  BuildState& state_;
  BuildJob& job_;
  FragmentSplitter splitter_;
  std::vector<Primitive>& primitives_;
  std::vector<Primitive> positive_;
  std::vector<Primitive> coincident_;
  std::size_t coincident_count_ = 0;  ///< of the node that was built last
  std::vector<Task> tasks_;
  std::vector<VertexId> vertices_;
  double done_ = 0;
  int gathered_ = 0;  ///< nodes that are done
};

}  // namespace halfspace::fast
