#include <deque>
#include <numeric>
#include <utility>

#include "base/threads.hpp"
#include "base/tsan.hpp"
#include "halfspace/assert.hpp"
#include "halfspace/fast/display_tree.hpp"
#include "halfspace/threads.hpp"
#include "sah/sah_builder.hpp"
#include "tree/leaf_packets.hpp"

namespace halfspace::fast {
namespace {

/// A list of this size or shorter is one thread's job. Untuned.
constexpr std::size_t kJobSize = 16384;

/// This many regions or fewer are one thread's job. A job for each node of
/// 10,000 regions takes 4.4 kB a region at the most, this 1.6 kB.
/// A module for the web does without, of whose size this is a kilobyte.
#if defined(__wasm__)
constexpr std::size_t kJobRegions = 0;
#else
constexpr std::size_t kJobRegions = 64;
#endif

/// Polygons that a thread reads at a time. Untuned.
constexpr std::size_t kBlock = 4096;

/// Where a piece's arrays begin in the tree's.
struct Placed {
  BuildJob* job;
  std::size_t nodes = 0;
  std::size_t fragments = 0;
  std::size_t corners = 0;
  std::size_t cut_vertices = 0;
  std::size_t free_planes = 0;
  NodeId positive = kNoNode;
  NodeId negative = kNoNode;
  std::vector<std::int32_t> planes;  ///< the tree's ids of inherited ones
};

/// Joins the pieces to one tree, in the order node, positive subtree, negative
/// subtree. Free planes above the root count first, as they do in its piece.
class PieceJoiner {
 public:
  PieceJoiner(const Scene& scene, BspTree& tree, const BuildJob& root)
      : polygon_count_(static_cast<PlaneId>(scene.polygon_count())),
        vertex_count_(static_cast<std::int32_t>(scene.data().vertices.size())),
        inherited_(root.inherited_planes),
        tree_(tree) {}

  /// Returns the leaves that are kept free.
  std::vector<KeptLeaf> join(BuildJob* root, FilterStats& stats) {
    place(root, stats);
    std::vector<KeptLeaf> cells;
    for (const Placed& at : pieces_) {
      for (const KeptLeaf& leaf : at.job->cells)
        cells.push_back(
            {leaf.region, leaf.node + static_cast<NodeId>(at.nodes)});
    }
    tree_.nodes.resize(end_.nodes);
    tree_.fragments.resize(end_.fragments);
    tree_.corners.resize(end_.corners);
    tree_.cut_vertices.resize(end_.cut_vertices);
    tree_.free_planes.resize(end_.free_planes);
    tree_.boxes.resize(end_.nodes);
    const TsanForkJoin shared;
    threads::for_each_index(pieces_.size(), [&](std::size_t i) {
      shared.task([&] { copy(pieces_[i]); });
    });
    return cells;
  }

 private:
  void place(BuildJob* root, FilterStats& stats) {
    struct Subtree {
      BuildJob* job;
      std::size_t parent;
      Side side;
      std::vector<std::int32_t> planes;
    };
    std::vector<Subtree> steps;
    steps.push_back(
        {root, 0, Side::kOn, std::vector<std::int32_t>(inherited_)});
    std::iota(steps[0].planes.begin(), steps[0].planes.end(), 0);
    while (!steps.empty()) {
      Subtree step = std::move(steps.back());
      steps.pop_back();
      const BspTree& piece = step.job->piece;
      stats.add(step.job->stats);
      Placed at = end_;
      at.job = step.job;
      at.planes = std::move(step.planes);
      const auto id = static_cast<NodeId>(at.nodes);
      if (step.side == Side::kPositive) pieces_[step.parent].positive = id;
      if (step.side == Side::kNegative) pieces_[step.parent].negative = id;
      std::vector<std::int32_t> below = at.planes;
      const std::size_t new_planes = piece.free_planes.size();
      for (std::size_t k = 0; k < new_planes; ++k) {
        below.push_back(
            static_cast<std::int32_t>(inherited_ + at.free_planes + k));
      }
      end_.nodes += piece.nodes.size();
      end_.fragments += piece.fragments.size();
      end_.corners += piece.corners.size();
      end_.cut_vertices += piece.cut_vertices.size();
      end_.free_planes += new_planes;
      const std::size_t index = pieces_.size();
      pieces_.push_back(std::move(at));
      if (BuildJob* child = step.job->negative) {
        steps.push_back({child, index, Side::kNegative, below});
      }
      if (BuildJob* child = step.job->positive) {
        steps.push_back({child, index, Side::kPositive, std::move(below)});
      }
    }
  }

  PlaneId plane_of(const Placed& at, PlaneId plane) const {
    if (plane < polygon_count_) return plane;
    const auto local = static_cast<std::size_t>(plane - polygon_count_);
    const std::size_t inherited = at.planes.size();
    if (local < inherited) return polygon_count_ + at.planes[local];
    return polygon_count_ + static_cast<PlaneId>(inherited_ + at.free_planes +
                                                 local - inherited);
  }

  void copy(const Placed& at) {
    BspTree& piece = at.job->piece;
    HALFSPACE_ASSERT(at.planes.size() == at.job->inherited_planes);
    HALFSPACE_ASSERT(piece.boxes.size() == piece.nodes.size());
    const auto moved = [](std::int32_t index, std::size_t by) {
      return index < 0 ? index : index + static_cast<std::int32_t>(by);
    };
    for (std::size_t k = 0; k < piece.nodes.size(); ++k) {
      Node node = piece.nodes[k];
      node.splitter = plane_of(at, node.splitter);
      node.positive = moved(node.positive, at.nodes);
      node.negative = moved(node.negative, at.nodes);
      node.first_fragment = moved(node.first_fragment, at.fragments);
      if (at.positive != kNoNode) node.positive = at.positive;
      if (at.negative != kNoNode) node.negative = at.negative;
      tree_.nodes[at.nodes + k] = node;
      tree_.boxes[at.nodes + k] = piece.boxes[k];
    }
    for (std::size_t k = 0; k < piece.fragments.size(); ++k) {
      TreeFragment fragment = piece.fragments[k];
      fragment.first_corner += static_cast<std::uint32_t>(at.corners);
      fragment.next = moved(fragment.next, at.fragments);
      tree_.fragments[at.fragments + k] = fragment;
    }
    for (std::size_t k = 0; k < piece.corners.size(); ++k) {
      Corner corner = piece.corners[k];
      if (!is_source(corner.edge)) {
        corner.edge = splitter_edge(plane_of(at, splitter_of(corner.edge)));
      }
      if (corner.vertex >= vertex_count_) {
        corner.vertex += static_cast<std::int32_t>(at.cut_vertices);
      }
      tree_.corners[at.corners + k] = corner;
    }
    std::copy(piece.cut_vertices.begin(), piece.cut_vertices.end(),
              tree_.cut_vertices.begin() +
                  static_cast<std::ptrdiff_t>(at.cut_vertices));
    std::copy(piece.free_planes.begin(), piece.free_planes.end(),
              tree_.free_planes.begin() +
                  static_cast<std::ptrdiff_t>(at.free_planes));
    piece = {};
  }

  PlaneId polygon_count_;
  std::int32_t vertex_count_;
  std::size_t inherited_;
  BspTree& tree_;
  Placed end_{nullptr, 0, 0, 0, 0, 0, kNoNode, kNoNode, {}};
  std::vector<Placed> pieces_;
};

/// Carries out the jobs of a build.
class JobRunner {
 public:
  explicit JobRunner(BuildState& state) : state_(state) {}

  /// The root's job, with those of its subtrees.
  BuildJob* run() {
    BuildJob* root = add(root_job());
    start(root);
    group_.wait();
    for (const BuildJob& job : jobs_) tsan_acquire(&job);
    return root;
  }

 private:
  BuildJob root_job() const {
    BuildJob job;
    if (state_.cells) job.tree->slanted = state_.cells->slanted();
    job.primitives.resize(state_.scene.polygon_count());
    {
      const TsanForkJoin shared;
      const auto read = [&](std::size_t first, std::size_t end) {
        shared.task([&] {
          for (std::size_t p = first; p < end; ++p) {
            job.primitives[p] = state_.primitive_of(static_cast<PolygonId>(p));
          }
        });
      };
      threads::for_ranges(job.primitives.size(), kBlock, read);
    }
    for (const Primitive& p : job.primitives) extend(job.box, p);
    for (std::size_t r = 0; state_.cells && r < state_.cells->count(); ++r)
      job.regions.push_back(static_cast<std::int32_t>(r));
    job.cut_budget = kFreeCuts + state_.options.most_cuts *
                                     static_cast<double>(job.primitives.size());
    return job;
  }

  BuildJob* add(BuildJob job) {
    const Lock lock(mutex_);
    return &jobs_.emplace_back(std::move(job));
  }

  void start(BuildJob* job) {
    tsan_release(job);
    group_.run([this, job] {
      tsan_acquire(job);
      carry_out(*job);
      tsan_release(job);
    });
  }

  void carry_out(BuildJob& job) {
    if (state_.is_stopped()) return;
    if (job.primitives.size() <= kJobSize &&
        job.regions.size() <= kJobRegions) {
      if (job.regions.empty()) {
        SahBuilder(state_, job).build_subtree();
      } else if constexpr (kJobRegions > 0) {
        build_region_subtree(job);
      }
    } else {
      SahBuilder::Subtrees subtrees = build_root(job);
      const auto started = [&](std::optional<BuildJob>& subtree) {
        if (!subtree) return static_cast<BuildJob*>(nullptr);
        BuildJob* child = add(std::move(*subtree));
        start(child);
        return child;
      };
      job.negative = started(subtrees.negative);
      job.positive = started(subtrees.positive);
    }
    free_input(job);
  }

  SahBuilder::Subtrees build_root(BuildJob& job) {
    SahBuilder builder(state_, job);
    return job.regions.empty() ? builder.build_root()
                               : builder.build_region_root();
  }

  /// Makes one piece of a job that has few regions: a job for each node would
  /// take more memory than the node.
  void build_region_subtree(BuildJob& root) {
    std::deque<BuildJob> below;  // entries stay where they are
    std::vector<BuildJob*> left = {&root};
    while (!left.empty()) {
      if (state_.is_stopped()) return;
      BuildJob& job = *left.back();
      left.pop_back();
      if (job.regions.empty()) {
        SahBuilder(state_, job).build_subtree();
      } else {
        SahBuilder::Subtrees subtrees = build_root(job);
        const auto add_below = [&](std::optional<BuildJob>& subtree) {
          if (!subtree) return static_cast<BuildJob*>(nullptr);
          left.push_back(&below.emplace_back(*std::move(subtree)));
          return left.back();
        };
        job.negative = add_below(subtrees.negative);
        job.positive = add_below(subtrees.positive);
      }
      free_input(job);
    }
    BspTree piece;
    FilterStats stats;
    std::vector<KeptLeaf> cells =
        PieceJoiner(state_.scene, piece, root).join(&root, stats);
    root.piece = std::move(piece);
    root.stats = stats;
    root.cells = std::move(cells);
    root.negative = root.positive = nullptr;
  }

  static void free_input(BuildJob& job) {
    // `= {}` would keep the memory.
    job.primitives = std::vector<Primitive>();
    job.parts = std::vector<FragmentRef>();
    job.regions = std::vector<std::int32_t>();
    job.tree.reset();
  }

  BuildState& state_;
  threads::TaskGroup group_;
  Mutex mutex_;
  std::deque<BuildJob> jobs_;  // entries stay where they are
};

template <class T>
std::size_t bytes_of(const std::vector<T>& values) {
  return values.capacity() * sizeof(T);
}

}  // namespace

BspTree build_display_tree(const Scene& scene,
                           const DisplayTreeOptions& options) {
  FilterStats stats;
  return build_display_tree(scene, options, stats);
}

BspTree build_display_tree(const Scene& scene,
                           const DisplayTreeOptions& options,
                           FilterStats& stats) {
  const std::vector<MovingObject> none;
  KeptCells cells(none, false);
  return build_cell_tree(scene, cells, options, stats).tree;
}

KeptTree build_cell_tree(const Scene& scene, KeptCells& cells,
                         const DisplayTreeOptions& options,
                         FilterStats& stats) {
  HALFSPACE_ASSERT(options.leaf_size >= 1);
  HALFSPACE_ASSERT(options.threads >= 0);
  KeptTree result;
  BspTree& tree = result.tree;
  result.node_of_object.assign(cells.count(), kNoNode);
  if (scene.polygon_count() == 0 && cells.count() == 0) return result;
  threads::in_arena(options.threads, [&] {
    BuildState state(scene, options, &cells);
    JobRunner runner(state);
    tree.slanted = cells.slanted();
    BuildJob* root = runner.run();
    if (!state.is_stopped()) {
      for (const KeptLeaf& leaf :
           PieceJoiner(scene, tree, *root).join(root, stats)) {
        result.node_of_object[static_cast<std::size_t>(leaf.region)] =
            leaf.node;
      }
      add_blocks(tree, scene);
    }
  });
  return result;
}

TreeBytes bytes_by_array(const BspTree& tree) {
  return {bytes_of(tree.nodes),
          bytes_of(tree.boxes),
          bytes_of(tree.fragments),
          bytes_of(tree.corners),
          bytes_of(tree.cut_vertices),
          bytes_of(tree.free_planes),
          bytes_of(tree.triangles) + bytes_of(tree.quadrangles) +
              bytes_of(tree.first_blocks)};
}

std::size_t bytes_of(const BspTree& tree) {
  return bytes_by_array(tree).total();
}

}  // namespace halfspace::fast
