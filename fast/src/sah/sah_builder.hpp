#pragma once

#include <atomic>
#include <mutex>
#include <optional>
#include <vector>

#include "halfspace/fast/display_tree.hpp"
#include "sah/polygon_split.hpp"
#include "sah/primitive.hpp"
#include "tree/fragment_splitter.hpp"

namespace halfspace::fast {

/// What all threads of one build share.
class DisplayWork {
 public:
  DisplayWork(const Scene& scene, const DisplayTreeOptions& options);

  /// The box of a polygon as an item.
  Item item_of(PolygonId polygon) const;

  /// Adds to the share that is done.
  void add_done(double share);
  bool is_stopped() const { return stopped_.load(std::memory_order_relaxed); }

  const Scene& scene;
  const DisplayTreeOptions& options;
  GridPoint origin;  ///< the frame of items: the middle of the scene
  /// What the scene's box shows from anywhere, on average; above 0.
  /// Units: squares of grid steps.
  double scene_size = 1;

 private:
  std::mutex mutex_;
  double done_ = 0;
  double told_ = 0;
  std::atomic<bool> stopped_ = false;
};

/// A list to be divided, with all that its items refer to, and what came of it.
struct DisplayJob {
  std::vector<Item> items;
  std::vector<Part> parts;
  Box box = kNoBox;
  double share = 1;
  double allowance = 0;  ///< how many cuts its subtree may make, about
  /// Corners of parts, cut vertices and free planes, those of the splitters
  /// above first.
  BspTree tree;
  std::size_t inherited_planes = 0;

  /// The subtree of the list, or its root; indices count from its own arrays,
  /// free planes from those above on.
  BspTree piece;
  FilterStats stats;
  /// Where the piece is a root alone: the lists of its subtrees.
  DisplayJob* positive = nullptr;
  DisplayJob* negative = nullptr;
};

/// Carries out one job.
class DisplayWorker {
 public:
  DisplayWorker(DisplayWork& work, DisplayJob& job);

  /// Makes the whole subtree.
  void make_subtree();

  /// Makes the root, and the jobs for its subtrees; an empty list needs none.
  struct Divided {
    std::optional<DisplayJob> positive;
    std::optional<DisplayJob> negative;
  };
  Divided divide();

 private:
  /// A list at the top of the stack of items.
  struct Task {
    std::size_t first;
    std::size_t count;
    Box box;
    double share;
    double allowance;
    NodeId parent;
    Side side;
  };
  /// What became of a task's list: the negative side's is left in its place,
  /// the positive side's is in positive_.
  struct Partition {
    std::size_t negative_count = 0;
    Box positive_box = kNoBox;
    Box negative_box = kNoBox;
  };

  NodeId add_node(const Task& task);
  std::optional<Partition> make_node(const Task& task);
  void make_leaf(NodeId id, const Task& task);
  bool is_flat(const Task& task, PolygonId& splitter);
  double contended_by(const Task& task);
  Partition distribute(const Task& task, PlaneId id, const Plane& plane,
                       const AxisSplit* axis);
  void cut_or_send(const Item& item, PlaneId id, const FilterPlane& plane,
                   const AxisSplit* axis, Partition& result,
                   std::size_t& negative_end);
  Item part_item(const Item& whole, const Part& part, int side,
                 const AxisSplit* axis);
  Part part_of(const Item& item);
  std::size_t corner_count(const Item& item) const;
  void add_fragments(NodeId id, std::vector<Item>& items);
  DisplayJob job_of(const Item* items, std::size_t count, const Box& box,
                    double share, double allowance) const;
  double allowance_for_each(const Task& task, const Partition& parts) const;
  Box absolute(const Box& box) const;
  void add_done(double share);

  DisplayWork& work_;
  DisplayJob& job_;
  TreeBuilder builder_;
  std::vector<Item>& items_;
  std::vector<Item> positive_;
  std::vector<Item> coincident_;
  std::size_t coincident_count_ = 0;  ///< of the node that was made last
  std::vector<Task> tasks_;
  std::vector<VertexId> vertices_;
  double done_ = 0;
};

}  // namespace halfspace::fast
