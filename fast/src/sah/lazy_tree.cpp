#include "halfspace/fast/image/lazy_tree.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "base/parallel.hpp"
#include "halfspace/assert.hpp"
#include "sah/lazy_cells.hpp"
#include "sah/sah_builder.hpp"
#include "tree/leaf_packets.hpp"
#include "tree/tree_access.hpp"

namespace halfspace::fast {
namespace {

/// Divisions in divisions: each is of a grid of 16 bins and more along an axis,
/// so this is beyond what any grid of a scene has steps for.
constexpr int kMostDivisions = 16;

/// How many polygons the cells of a list of `count` may name, which is in
/// divisions of that depth: the product of all depths is bounded.
std::size_t most_named(double most_listed, std::size_t count, int depth) {
  return static_cast<std::size_t>(static_cast<double>(count) *
                                  (1 + std::ldexp(most_listed - 1, -depth)));
}

/// Gives each polygon to the cells' states.
std::unique_ptr<LazyCell[]> cells_of(std::vector<CellList> lists, int depth) {
  auto cells = std::make_unique<LazyCell[]>(lists.size());
  for (std::size_t c = 0; c < lists.size(); ++c) {
    cells[c].list = std::move(lists[c]);
    cells[c].depth = depth;
  }
  return cells;
}

/// Leaves no room for more: pieces are small, and many.
void fit(BspTree& tree) {
  tree.nodes.shrink_to_fit();
  tree.boxes.shrink_to_fit();
  tree.fragments.shrink_to_fit();
  tree.corners.shrink_to_fit();
  tree.cut_vertices.shrink_to_fit();
}

}  // namespace

LazyTree::State::State(const Scene& a_scene, const LazyTreeOptions& the_options)
    : scene(&a_scene), options(the_options) {
  build_state.emplace(a_scene, options.tree);
  HALFSPACE_ASSERT(options.tree.leaf_size >= 1);
  HALFSPACE_ASSERT(options.cell_size >= 1 && options.most_in_cell >= 1);
  HALFSPACE_ASSERT(options.tree.threads >= 0);
  HALFSPACE_ASSERT(1 <= options.most_listed && options.most_listed <= 64);
  options.tree.progress = {};
  if (scene->polygon_count() == 0) return;
  CellList all;
  all.range = build_state->range;
  const std::size_t count = scene->polygon_count();
  if (auto divided =
          divide_into_cells(*scene, all, options.cell_size,
                            most_named(options.most_listed, count, 0),
                            thread_count(options.tree.threads))) {
    root = parts_of(*std::move(divided), 0);
    return;
  }
  // One cell that has everything.
  DividedCells one;
  one.tree.nodes.resize(1);
  one.tree.boxes.push_back(box_of(all.range));
  one.cell_of_node = {0};
  all.polygons.resize(count);
  std::iota(all.polygons.begin(), all.polygons.end(), 0);
  one.cells.push_back(std::move(all));
  root = parts_of(std::move(one), kMostDivisions);
}

LazyPart LazyTree::State::parts_of(DividedCells divided, int depth) const {
  LazyPart part;
  part.tree = std::move(divided.tree);
  part.cell_of_node = std::move(divided.cell_of_node);
  part.cell_count = divided.cells.size();
  part.cells = cells_of(std::move(divided.cells), depth);
  return part;
}

const LazyPart& LazyTree::State::build(LazyCell& cell) const {
  const Lock lock(cell.mutex);
  // Another thread may have built it meanwhile.
  if (const LazyPart* built = cell.part.load(std::memory_order_relaxed))
    return *built;
  cell.owner = std::make_unique<LazyPart>(made(cell));
  // Lists of trees are needed where polygons move.
  if (cell.owner->has_cells()) cell.list.polygons = std::vector<PolygonId>();
  cell.part.store(cell.owner.get(), std::memory_order_release);
  return *cell.owner;
}

/// In the calling thread alone: it holds a lock, and a task of oneTBB that
/// waits for others may take up one that waits for the lock.
LazyPart LazyTree::State::made(LazyCell& cell) const {
  const CellList& list = cell.list;
  if (list.polygons.size() > options.most_in_cell &&
      cell.depth < kMostDivisions) {
    const int depth = cell.depth + 1;
    if (auto divided = divide_into_cells(
            *scene, list, options.cell_size,
            most_named(options.most_listed, list.polygons.size(), depth), 1))
      return parts_of(*std::move(divided), depth);
  }
  BuildJob job;
  job.primitives.reserve(list.polygons.size());
  for (const PolygonId polygon : list.polygons)
    job.primitives.push_back(build_state->primitive_of(polygon));
  job.cut_budget = static_cast<double>(list.polygons.size()) *
                   (options.tree.most_cuts +
                    kFreeCuts / static_cast<double>(scene->polygon_count()));
  SahBuilder builder(*build_state, job);
  builder.cut_to(list.region);
  LazyPart part;
  if (job.primitives.empty()) return part;
  builder.build_subtree();
  part.tree = std::move(job.piece);
  part.tree.free_planes = std::move(job.tree->free_planes);
  fit(part.tree);
  add_blocks(part.tree, *scene, 1);
  return part;
}

void LazyCell::drop() {
  part.store(nullptr, std::memory_order_relaxed);
  owner.reset();
}

namespace {

/// What a polygon does to the cells that its box reaches, and to the boxes
/// above them: it leaves them, or comes to them.
class PolygonMove {
 public:
  PolygonMove(PolygonId polygon, std::size_t polygon_count, bool comes)
      : polygon_(polygon), polygon_count_(polygon_count), comes_(comes) {}

  /// `range` is that of the polygon's box in the part. Goes down by the rule of
  /// CellRegion; recurses into cells that were divided again.
  void apply(LazyPart& part, const GridRange& range) const {
    if (part.tree.nodes.empty()) return;
    std::vector<std::pair<NodeId, GridRange>> left = {{0, range}};
    while (!left.empty()) {
      const auto [id, here] = left.back();
      left.pop_back();
      const auto n = static_cast<std::size_t>(id);
      if (comes_) extend(part.tree.boxes[n], here);
      const Node& node = part.tree.nodes[n];
      if (node.splitter == kNoPlane) {
        apply(part.cells[static_cast<std::size_t>(part.cell_of_node[n])], here);
        continue;
      }
      const FreePlane& plane =
          part.tree.free_planes[static_cast<std::size_t>(node.splitter) -
                                polygon_count_];
      const auto a = static_cast<std::size_t>(plane.axis);
      const std::int64_t at = plane.coordinate;
      if (here.low[a] < at) {
        left.push_back({node.negative, here});
        GridRange& below = left.back().second;
        below.high[a] = std::min(below.high[a], at);
      }
      if (here.high[a] > at || here.low[a] >= at) {
        left.push_back({node.positive, here});
        GridRange& above = left.back().second;
        above.low[a] = std::max(above.low[a], at);
      }
    }
  }

 private:
  static void extend(Box& box, const GridRange& range) {
    const Box other = box_of(range);
    for (std::size_t a = 0; a < 3; ++a) {
      box.low[a] = std::min(box.low[a], other.low[a]);
      box.high[a] = std::max(box.high[a], other.high[a]);
    }
  }

  void apply(LazyCell& cell, const GridRange& range) const {
    for (std::size_t a = 0; comes_ && a < 3; ++a) {
      cell.list.range.low[a] = std::min(cell.list.range.low[a], range.low[a]);
      cell.list.range.high[a] =
          std::max(cell.list.range.high[a], range.high[a]);
    }
    if (cell.owner && cell.owner->has_cells()) {
      apply(*cell.owner, range);
      return;
    }
    std::vector<PolygonId>& list = cell.list.polygons;
    const auto at = std::lower_bound(list.begin(), list.end(), polygon_);
    const bool is_there = at != list.end() && *at == polygon_;
    if (comes_ && !is_there) list.insert(at, polygon_);
    if (!comes_ && is_there) list.erase(at);
    cell.drop();
  }

  PolygonId polygon_;
  std::size_t polygon_count_;
  bool comes_;
};

}  // namespace

void LazyTree::State::move_to(const Scene& next,
                              std::span<const PolygonId> polygons) {
  const std::size_t count = scene->polygon_count();
  HALFSPACE_ASSERT(next.polygon_count() == count);
  HALFSPACE_ASSERT(next.grid_bits() == scene->grid_bits());
  HALFSPACE_ASSERT(next.data().vertices.size() ==
                   scene->data().vertices.size());
  for (const PolygonId polygon : polygons) {
    PolygonMove(polygon, count, false).apply(root, range_of(*scene, polygon));
    PolygonMove(polygon, count, true).apply(root, range_of(next, polygon));
  }
  // BuildState has a mutex, and is made in its place.
  const BuildState before(*scene, *build_state);
  build_state.emplace(next, before);
  scene = &next;
}

void LazyTree::move_to(const Scene& scene,
                       std::span<const PolygonId> polygons) {
  state_->move_to(scene, polygons);
}

LazyTree::LazyTree(const Scene& scene, const LazyTreeOptions& options)
    : state_(std::make_unique<State>(scene, options)) {}
LazyTree::LazyTree(LazyTree&&) noexcept = default;
LazyTree& LazyTree::operator=(LazyTree&&) noexcept = default;
LazyTree::~LazyTree() = default;

const Scene& LazyTree::scene() const { return *state_->scene; }

LazyTreeStats LazyTree::stats() const {
  LazyTreeStats stats;
  std::vector<bool> is_built(state_->scene->polygon_count());
  std::vector<const LazyPart*> left = {&state_->root};
  while (!left.empty()) {
    const LazyPart& part = *left.back();
    left.pop_back();
    stats.bytes += bytes_of(part.tree) +
                   part.cell_of_node.capacity() * sizeof(std::int32_t) +
                   part.cell_count * sizeof(LazyCell);
    stats.fragments += part.tree.fragments.size();
    for (const TreeFragment& fragment : part.tree.fragments)
      is_built[static_cast<std::size_t>(fragment.source)] = true;
    for (std::size_t c = 0; c < part.cell_count; ++c) {
      const LazyCell& cell = part.cells[c];
      const LazyPart* built = cell.part.load(std::memory_order_acquire);
      stats.bytes += cell.list.polygons.capacity() * sizeof(PolygonId);
      // One that was divided again is its parts.
      if (built == nullptr || !built->has_cells()) ++stats.cells;
      if (built == nullptr) continue;
      if (!built->has_cells()) ++stats.cells_built;
      left.push_back(built);
    }
  }
  stats.polygons_built = static_cast<std::size_t>(
      std::count(is_built.begin(), is_built.end(), true));
  return stats;
}

}  // namespace halfspace::fast
