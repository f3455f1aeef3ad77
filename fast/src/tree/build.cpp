#include "halfspace/fast/build.hpp"

#include <algorithm>
#include <utility>

#include "halfspace/assert.hpp"
#include "tree/choose_root.hpp"
#include "tree/fragment_splitter.hpp"
#include "tree/node_boxes.hpp"
#include "tree/tree_access.hpp"

namespace halfspace::fast {
namespace {

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

/// Bounds the sizes of the vertices' coordinates.
double largest_coordinate(const Scene& scene) {
  std::int64_t most = 0;
  for (const GridPoint& p : scene.data().vertices)
    most = std::max({most, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  return static_cast<double>(most);
}

/// Makes the tree whose splitters are planes of its polygons.
class Autopartition {
 public:
  Autopartition(const Scene& scene, const BuildOptions& options, BspTree& tree,
                FilterStats& stats, const Progress& progress)
      : options_(options),
        tree_(tree),
        reporter_(progress),
        splitter_(scene, tree, stats, largest_coordinate(scene)),
        table_(intern_planes(scene)) {
    for (std::size_t p = 0; p < scene.polygon_count(); ++p) {
      const auto id = static_cast<PolygonId>(p);
      planes_.push_back(filter_plane(plane_of(scene, id)));
    }
  }

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

  /// Makes a leaf the root of a tree of its fragments. Their old entries are in
  /// no list then.
  void divide(NodeId leaf) {
    Node& node = node_at(tree_, leaf);
    fragments_.clear();
    for_fragments(tree_, node, [this](const TreeFragment& listed) {
      fragments_.push_back(
          {listed.source, listed.first_corner, listed.corner_count});
      return true;
    });
    std::sort(fragments_.begin(), fragments_.end(),
              [](const FragmentRef& p, const FragmentRef& q) {
                return p.source < q.source;
              });
    node.first_fragment = kNoFragment;
    if (fragments_.empty()) {
      // Any plane will do.
      node.splitter = 0;
      node.plane = planes_[0].plane;
      return;
    }
    const auto number = static_cast<std::uint64_t>(leaf);
    tasks_.push_back(
        {0, root_key(options_.seed + number), 1, kNoNode, Side::kOn, leaf});
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
    const auto s = static_cast<std::size_t>(splitter);
    const auto p = static_cast<std::size_t>(fragment.source);
    if (table_.plane_of[s] == table_.plane_of[p]) return Relation::kCoincident;
    return splitter_.relation(fragment, splitter, planes_[s]);
  }

  bool is_flipped(PolygonId source, PolygonId splitter) const {
    return table_.same_orientation[static_cast<std::size_t>(source)] !=
           table_.same_orientation[static_cast<std::size_t>(splitter)];
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
    node.plane = planes_[static_cast<std::size_t>(splitter)].plane;

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
              tree_, fragment, is_flipped(fragment.source, splitter));
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
          const FragmentPair pair = splitter_.split(
              fragment, splitter, planes_[static_cast<std::size_t>(splitter)]);
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
  PlaneTable table_;
  std::vector<FilterPlane> planes_;
  std::vector<FragmentRef> fragments_;
  std::vector<FragmentRef> positive_;
  std::vector<FragmentRef> negative_;
  std::vector<BuildTask> tasks_;
};

/// Lays the fragments out node by node, without those in no list.
void drop_unused_fragments(BspTree& tree) {
  std::vector<TreeFragment> kept;
  for (Node& node : tree.nodes) {
    std::int32_t f = node.first_fragment;
    if (f != kNoFragment) {
      node.first_fragment = static_cast<std::int32_t>(kept.size());
    }
    while (f != kNoFragment) {
      kept.push_back(tree.fragments[static_cast<std::size_t>(f)]);
      f = kept.back().next;
      const auto next = static_cast<std::int32_t>(kept.size());
      kept.back().next = f == kNoFragment ? kNoFragment : next;
    }
  }
  kept.shrink_to_fit();
  tree.fragments = std::move(kept);
}

}  // namespace

BspTree build(const Scene& scene, const BuildOptions& options) {
  FilterStats stats;
  return build(scene, options, stats);
}

BspTree build(const Scene& scene, const BuildOptions& options,
              FilterStats& stats) {
  return build(scene, options, stats, nullptr);
}

BspTree build(const Scene& scene, const BuildOptions& options,
              FilterStats& stats, const Progress& progress) {
  HALFSPACE_ASSERT(options.candidates >= 1);
  BspTree tree;
  if (!Autopartition(scene, options, tree, stats, progress).run()) return {};
  drop_unused_corners(tree);
  tree.nodes.shrink_to_fit();
  tree.fragments.shrink_to_fit();
  tree.cut_vertices.shrink_to_fit();
  add_boxes(tree, scene);
  return tree;
}

bool has_leaves(const BspTree& tree) {
  return std::any_of(
      tree.nodes.begin(), tree.nodes.end(),
      [](const Node& node) { return node.splitter == kNoPlane; });
}

void divide_leaves(BspTree& tree, const Scene& scene) {
  if (!has_leaves(tree)) return;
  if (scene.polygon_count() == 0) {
    tree = {};
    return;
  }
  FilterStats stats;
  const Progress silent;
  Autopartition partition(scene, {.rule = RootRule::kRandom, .candidates = 5},
                          tree, stats, silent);
  const auto count = static_cast<NodeId>(tree.nodes.size());
  for (NodeId id = 0; id < count; ++id) {
    if (node_at(tree, id).splitter == kNoPlane) partition.divide(id);
  }
  drop_unused_fragments(tree);
  drop_unused_corners(tree);
  add_boxes(tree, scene);
  // `= {}` would keep the memory.
  tree.triangles = std::vector<FragmentBlock<3>>();
  tree.quadrangles = std::vector<FragmentBlock<4>>();
  tree.first_blocks = std::vector<FirstBlocks>();
}

}  // namespace halfspace::fast
