#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "halfspace/assert.hpp"
#include "halfspace/fast/build.hpp"
#include "tree/choose_root.hpp"
#include "tree/fragment_splitter.hpp"
#include "tree/tree_access.hpp"

namespace halfspace::fast {

/// A subtree to build, of the fragments on top of the stack from `first` on.
struct BuildTask {
  std::size_t first;
  std::uint64_t key;
  double share;  ///< of the work
  NodeId parent;
  Side side;              ///< of the parent
  NodeId node = kNoNode;  ///< the root, if it exists already
};

/// Progress is reported after this share of the work or this many decisions,
/// which take some milliseconds. Untuned.
constexpr double kReportedShare = 1.0 / 256;
constexpr std::size_t kReportedDecisions = 1 << 18;

/// Reports the progress of a build, and remembers that it was stopped.
class ProgressReporter {
 public:
  explicit ProgressReporter(const Progress& progress) : progress_(progress) {}

  bool is_stopped() const { return stopped_; }

  /// Adds work that is done.
  void add_done(double share) {
    done_ += share;
    report();
  }

  /// Adds decisions that are about to be taken; false if the build was stopped.
  bool add_decisions(std::size_t count) {
    decisions_ += count;
    report();
    return !stopped_;
  }

 private:
  void report() {
    if (!progress_ || stopped_) return;
    if (done_ < reported_ + kReportedShare && decisions_ < kReportedDecisions)
      return;
    reported_ = done_;
    decisions_ = 0;
    stopped_ = !progress_(std::min(done_, 1.0));
  }

  const Progress& progress_;
  double done_ = 0;
  double reported_ = 0;
  std::size_t decisions_ = 0;
  bool stopped_ = false;
};

/// The planes of all polygons, worked out once: which are one, too.
class ScenePlaneTable {
 public:
  explicit ScenePlaneTable(const Scene& scene) : table_(intern_planes(scene)) {
    for (std::size_t p = 0; p < scene.polygon_count(); ++p) {
      const auto id = static_cast<PolygonId>(p);
      planes_.push_back(filter_plane(plane_of(scene, id)));
    }
  }

  std::size_t size() const { return planes_.size(); }
  const FilterPlane& at(PolygonId id) const {
    return planes_[static_cast<std::size_t>(id)];
  }
  bool are_one(PolygonId p, PolygonId q) const {
    return table_.plane_of[static_cast<std::size_t>(p)] ==
           table_.plane_of[static_cast<std::size_t>(q)];
  }
  /// Requires: the planes are one.
  bool are_opposed(PolygonId p, PolygonId q) const {
    return table_.same_orientation[static_cast<std::size_t>(p)] !=
           table_.same_orientation[static_cast<std::size_t>(q)];
  }

 private:
  PlaneTable table_;
  std::vector<FilterPlane> planes_;
};

/// Planes that are worked out when they are asked for, for a few of a scene's
/// polygons. That two are one shows when their polygons are compared.
class PlanesByNeed {
 public:
  explicit PlanesByNeed(const Scene& scene) : scene_(scene) {}

  const FilterPlane& at(PolygonId id) {
    Known& known = known_[static_cast<std::size_t>(id) % known_.size()];
    if (known.id != id) known = {id, filter_plane(plane_of(scene_, id))};
    return known.plane;
  }
  bool are_one(PolygonId p, PolygonId q) const { return p == q; }
  bool are_opposed(PolygonId p, PolygonId q) const {
    return opposed(plane_of(scene_, p), plane_of(scene_, q));
  }

 private:
  struct Known {
    PolygonId id = -1;
    FilterPlane plane;
  };
  const Scene& scene_;
  std::array<Known, 64> known_;  ///< some of those asked for
};

/// Makes trees whose splitters are planes of their polygons, which `Planes`
/// knows.
template <class Planes>
class Autopartition {
 public:
  Autopartition(const Scene& scene, const BuildOptions& options, BspTree& tree,
                FilterStats& stats, const Progress& progress)
      : options_(options),
        tree_(tree),
        reporter_(progress),
        splitter_(scene, tree, stats, largest_coordinate(scene)),
        planes_(scene) {}

  /// Makes the tree of the whole scene; false where it was stopped.
  bool run() {
    for (std::size_t p = 0; p < planes_.size(); ++p) {
      fragments_.push_back(splitter_.whole(static_cast<PolygonId>(p)));
    }
    if (fragments_.empty()) return true;
    tasks_.push_back({0, root_key(options_.seed), 1, kNoNode, Side::kOn});
    run_tasks();
    HALFSPACE_ASSERT(reporter_.is_stopped() || fragments_.empty());
    HALFSPACE_ASSERT(reporter_.is_stopped() ||
                     tree_.fragments.size() >= planes_.size());
    return !reporter_.is_stopped();
  }

  /// Makes a node the root of a tree of fragments that are in no list.
  /// Requires: some fragments, the lowest ids first.
  void divide(NodeId node, std::span<const FragmentRef> fragments,
              std::uint64_t seed) {
    HALFSPACE_ASSERT(!fragments.empty());
    fragments_.assign(fragments.begin(), fragments.end());
    tasks_.push_back({0, root_key(seed), 1, kNoNode, Side::kOn, node});
    run_tasks();
  }

 private:
  void run_tasks() {
    while (!tasks_.empty() && !reporter_.is_stopped()) {
      const BuildTask task = tasks_.back();
      tasks_.pop_back();
      make_node(task);
    }
  }

  Relation relation(const FragmentRef& fragment, PolygonId splitter) {
    if (planes_.are_one(splitter, fragment.source))
      return Relation::kCoincident;
    return splitter_.relation(fragment, splitter, planes_.at(splitter));
  }

  void make_node(const BuildTask& task) {
    // Step 1: choose the root; its plane is the node's.
    const FragmentRef* list = fragments_.data() + task.first;
    const std::size_t count = fragments_.size() - task.first;
    const std::size_t root = choose_root(
        count, options_, task.key,
        [&](std::size_t i, std::size_t j) {
          return relation(list[j], list[i].source);
        },
        [&] { return reporter_.add_decisions(count); });
    HALFSPACE_ASSERT(root < count);
    const PolygonId splitter = list[root].source;
    NodeId id = task.node;
    if (id == kNoNode) {
      id = static_cast<NodeId>(tree_.nodes.size());
      tree_.nodes.emplace_back();
      if (task.parent != kNoNode) set_child(tree_, task.parent, task.side, id);
    }
    Node& node = node_at(tree_, id);
    node.splitter = splitter;
    node.plane = planes_.at(splitter).plane;

    // Step 2: the polygons in that plane stay, the others go to its sides; the
    // parts of those that it cuts go to both.
    distribute(task.first, splitter, node);

    // Step 3: make the subtrees of the sides that are not empty; the last task
    // is next. Its fragments are on top of the stack.
    const double share = task.share / static_cast<double>(positive_.size() +
                                                          negative_.size() + 1);
    const auto share_of = [share](const std::vector<FragmentRef>& fragments) {
      return share * static_cast<double>(fragments.size());
    };
    fragments_.resize(task.first);
    fragments_.insert(fragments_.end(), negative_.begin(), negative_.end());
    if (!negative_.empty()) {
      tasks_.push_back({task.first, negative_key(task.key), share_of(negative_),
                        id, Side::kNegative});
    }
    if (!positive_.empty()) {
      tasks_.push_back({fragments_.size(), positive_key(task.key),
                        share_of(positive_), id, Side::kPositive});
    }
    reporter_.add_done(share);
    fragments_.insert(fragments_.end(), positive_.begin(), positive_.end());
  }

  void distribute(std::size_t first, PolygonId splitter, Node& node) {
    positive_.clear();
    negative_.clear();
    std::int32_t last = kNoFragment;
    for (std::size_t i = first; i < fragments_.size(); ++i) {
      const FragmentRef& fragment = fragments_[i];
      switch (relation(fragment, splitter)) {
        case Relation::kCoincident: {
          const std::int32_t added = add_fragment(
              tree_, fragment, planes_.are_opposed(fragment.source, splitter));
          if (last == kNoFragment) {
            node.first_fragment = added;
          } else {
            tree_.fragments[static_cast<std::size_t>(last)].next = added;
          }
          last = added;
          break;
        }
        case Relation::kPositive:
          positive_.push_back(fragment);
          break;
        case Relation::kNegative:
          negative_.push_back(fragment);
          break;
        case Relation::kSpanning: {
          const FragmentPair pair =
              splitter_.split(fragment, splitter, planes_.at(splitter));
          positive_.push_back(pair.positive);
          negative_.push_back(pair.negative);
          break;
        }
      }
    }
  }

  BuildOptions options_;
  BspTree& tree_;
  ProgressReporter reporter_;
  FragmentSplitter splitter_;
  Planes planes_;
  std::vector<FragmentRef> fragments_;
  std::vector<FragmentRef> positive_;
  std::vector<FragmentRef> negative_;
  std::vector<BuildTask> tasks_;
};

}  // namespace halfspace::fast
