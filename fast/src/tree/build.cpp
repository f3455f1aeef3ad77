#include "halfspace/fast/build.hpp"

#include <algorithm>
#include <utility>

#include "box/box.hpp"
#include "halfspace/assert.hpp"
#include "halfspace/fast/display_tree.hpp"
#include "tree/choose_root.hpp"
#include "tree/fragment_splitter.hpp"

namespace halfspace::fast {
namespace {

/// A subtree still to be made: of the parts on top of the stack of parts, from
/// `first` on.
struct SubtreeToMake {
  std::size_t first;
  std::uint64_t key;
  double share;  ///< of the work
  NodeId parent;
  Side side;              ///< of the parent
  NodeId node = kNoNode;  ///< its root, where there is one already
};

/// How often progress is told, at least: after so much work, or as many
/// decisions as take some milliseconds.
constexpr double kToldShare = 1.0 / 256;
constexpr std::size_t kToldDecisions = 1 << 18;

/// Tells how far a build is, and remembers that it was stopped.
class Teller {
 public:
  explicit Teller(const Progress& progress) : progress_(progress) {}

  bool is_stopped() const { return stopped_; }

  /// Adds work that is done.
  void add_done(double share) {
    done_ += share;
    tell();
  }

  /// Adds decisions that are about to be taken; whether to take them.
  bool add_decisions(std::size_t count) {
    decisions_ += count;
    tell();
    return !stopped_;
  }

 private:
  void tell() {
    if (!progress_ || stopped_) return;
    if (done_ < told_ + kToldShare && decisions_ < kToldDecisions) return;
    told_ = done_;
    decisions_ = 0;
    stopped_ = !progress_(std::min(done_, 1.0));
  }

  const Progress& progress_;
  double done_ = 0;
  double told_ = 0;
  std::size_t decisions_ = 0;
  bool stopped_ = false;
};

/// Makes `child` the child of `parent`, which may be none, on its `side`.
void attach(BspTree& tree, NodeId parent, Side side, NodeId child) {
  if (parent == kNoNode) return;
  Node& node = tree.nodes[static_cast<std::size_t>(parent)];
  (side == Side::kPositive ? node.positive : node.negative) = child;
}

/// Adds a fragment to the tree's array, in no list yet.
std::int32_t add_fragment(BspTree& tree, const Part& part, bool turned) {
  tree.fragments.push_back({part.source, part.first, part.count & kCountMask,
                            turned ? 1u : 0u, kNoFragment});
  return static_cast<std::int32_t>(tree.fragments.size()) - 1;
}

/// Makes the tree whose splitters are planes of its polygons.
class Autopartition {
 public:
  Autopartition(const Scene& scene, const BuildOptions& options, BspTree& tree,
                FilterStats& stats, const Progress& progress)
      : options_(options),
        tree_(tree),
        teller_(progress),
        builder_(scene, tree, stats),
        table_(intern_planes(scene)) {
    for (std::size_t p = 0; p < scene.polygon_count(); ++p) {
      const auto id = static_cast<PolygonId>(p);
      planes_.push_back(filter_plane(plane_of(scene, id)));
    }
  }

  /// Makes the tree of the whole scene; false where it was stopped.
  bool run() {
    for (std::size_t p = 0; p < planes_.size(); ++p) {
      parts_.push_back(builder_.whole(static_cast<PolygonId>(p)));
    }
    if (parts_.empty()) return true;
    tasks_.push_back({0, root_key(options_.seed), 1, kNoNode, Side::kOn});
    work_off();
    return !teller_.is_stopped();
  }

  /// Makes a leaf the root of a tree of its fragments, whose old entries no
  /// list holds any more.
  void divide(NodeId leaf) {
    Node& node = tree_.nodes[static_cast<std::size_t>(leaf)];
    parts_.clear();
    for (std::int32_t f = node.first_fragment; f != kNoFragment;) {
      const TreeFragment& fragment =
          tree_.fragments[static_cast<std::size_t>(f)];
      parts_.push_back(
          {fragment.source, fragment.first_corner, fragment.corner_count});
      f = fragment.next;
    }
    std::sort(parts_.begin(), parts_.end(),
              [](const Part& p, const Part& q) { return p.source < q.source; });
    node.first_fragment = kNoFragment;
    if (parts_.empty()) {
      // Any plane divides nothing.
      node.splitter = 0;
      node.plane = planes_[0].plane;
      return;
    }
    const auto number = static_cast<std::uint64_t>(leaf);
    tasks_.push_back(
        {0, root_key(options_.seed + number), 1, kNoNode, Side::kOn, leaf});
    work_off();
  }

 private:
  void work_off() {
    while (!tasks_.empty() && !teller_.is_stopped()) {
      const SubtreeToMake task = tasks_.back();
      tasks_.pop_back();
      make_node(task);
    }
  }

  Relation relation(const Part& part, PolygonId splitter) {
    const auto s = static_cast<std::size_t>(splitter);
    const auto p = static_cast<std::size_t>(part.source);
    if (table_.plane_of[s] == table_.plane_of[p]) return Relation::kCoincident;
    return builder_.relation(part, splitter, planes_[s]);
  }

  bool is_turned(PolygonId source, PolygonId splitter) const {
    return table_.same_orientation[static_cast<std::size_t>(source)] !=
           table_.same_orientation[static_cast<std::size_t>(splitter)];
  }

  void make_node(const SubtreeToMake& task) {
    // Step 1: choose the root; its plane is the node's.
    const Part* list = parts_.data() + task.first;
    const std::size_t count = parts_.size() - task.first;
    const std::size_t root = choose_root(
        count, options_, task.key,
        [&](std::size_t i, std::size_t j) {
          return relation(list[j], list[i].source);
        },
        [&] { return teller_.add_decisions(count); });
    const PolygonId splitter = list[root].source;
    NodeId id = task.node;
    if (id == kNoNode) {
      id = static_cast<NodeId>(tree_.nodes.size());
      tree_.nodes.emplace_back();
      attach(tree_, task.parent, task.side, id);
    }
    Node& node = tree_.nodes[static_cast<std::size_t>(id)];
    node.splitter = splitter;
    node.plane = planes_[static_cast<std::size_t>(splitter)].plane;

    // Step 2: the polygons in that plane stay, the others go to its sides;
    // what the plane cuts goes to both.
    distribute(task.first, splitter, node);

    // Step 3: make the subtrees of what is not empty; the last task is next.
    // Its parts are on top of the stack.
    const double share = task.share / static_cast<double>(positive_.size() +
                                                          negative_.size() + 1);
    const auto share_of = [share](const std::vector<Part>& parts) {
      return share * static_cast<double>(parts.size());
    };
    parts_.resize(task.first);
    parts_.insert(parts_.end(), negative_.begin(), negative_.end());
    if (!negative_.empty()) {
      tasks_.push_back({task.first, negative_key(task.key), share_of(negative_),
                        id, Side::kNegative});
    }
    if (!positive_.empty()) {
      tasks_.push_back({parts_.size(), positive_key(task.key),
                        share_of(positive_), id, Side::kPositive});
    }
    teller_.add_done(share);
    parts_.insert(parts_.end(), positive_.begin(), positive_.end());
  }

  void distribute(std::size_t first, PolygonId splitter, Node& node) {
    positive_.clear();
    negative_.clear();
    std::int32_t last = kNoFragment;
    for (std::size_t i = first; i < parts_.size(); ++i) {
      const Part& part = parts_[i];
      switch (relation(part, splitter)) {
        case Relation::kCoincident: {
          const std::int32_t added =
              add_fragment(tree_, part, is_turned(part.source, splitter));
          if (last == kNoFragment) {
            node.first_fragment = added;
          } else {
            tree_.fragments[static_cast<std::size_t>(last)].next = added;
          }
          last = added;
          break;
        }
        case Relation::kPositive:
          positive_.push_back(part);
          break;
        case Relation::kNegative:
          negative_.push_back(part);
          break;
        case Relation::kSpanning: {
          const CutParts cut = builder_.cut(
              part, splitter, planes_[static_cast<std::size_t>(splitter)]);
          positive_.push_back(cut.positive);
          negative_.push_back(cut.negative);
          break;
        }
      }
    }
  }

  BuildOptions options_;
  BspTree& tree_;
  Teller teller_;
  TreeBuilder builder_;
  PlaneTable table_;
  std::vector<FilterPlane> planes_;
  std::vector<Part> parts_;
  std::vector<Part> positive_;
  std::vector<Part> negative_;
  std::vector<SubtreeToMake> tasks_;
};

/// Lays the fragments out node by node, without those of no list.
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
    if (tree.nodes[static_cast<std::size_t>(id)].splitter == kNoPlane) {
      partition.divide(id);
    }
  }
  drop_unused_fragments(tree);
  drop_unused_corners(tree);
  add_boxes(tree, scene);
  tree.triangles = {};
  tree.quadrangles = {};
  tree.first_blocks = {};
}

}  // namespace halfspace::fast
