#include "sah/sah_builder.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "halfspace/assert.hpp"
#include "tree/tree_access.hpp"

namespace halfspace::fast {
namespace {

/// A builder gathers this share of the work, or that of so many nodes, before
/// it takes the lock to add it. Untuned.
constexpr double kGatheredShare = 1.0 / 1024;
constexpr int kGatheredNodes = 256;

/// The image for which trees are built. Units: pixels.
constexpr double kImagePixels = 1500.0 * 1500.0;

/// The cost of a pixel that is decided by depth, in fragments. Untuned.
constexpr double kOverdrawnPixel = 0.02;

/// A leaf may cost this many fragments on top of its own. Untuned.
constexpr double kMostOverdraw = 8;

/// From this ratio of distinct vertices on overdraw counts: polygons that share
/// more vertices are a mesh. Untuned.
constexpr double kMeshRatio = 0.6;

/// a + b, rounded downwards to a float.
float sum_below(double a, double b) {
  const double sum = a + b;
  const double b_part = sum - a;
  const double error = (a - (sum - b_part)) + (b - b_part);
  return float_below(
      error < 0 ? std::nextafter(sum, -std::numeric_limits<double>::infinity())
                : sum);
}

std::int64_t coordinate_of(const GridPoint& p, std::size_t axis) {
  return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
}

void sort_by_source(std::vector<Primitive>::iterator first,
                    std::vector<Primitive>::iterator last) {
  std::sort(first, last, [](const Primitive& p, const Primitive& q) {
    return p.source < q.source;
  });
}

}  // namespace

SahBuilder::SahBuilder(BuildState& state, BuildJob& job)
    : state_(state),
      job_(job),
      splitter_(state.scene, *job.tree, job.stats, state.most),
      primitives_(job.primitives) {}

void SahBuilder::build_subtree() {
  tasks_.push_back({0, primitives_.size(), job_.box, job_.share,
                    job_.cut_budget, kNoNode, Side::kOn});
  while (!tasks_.empty() && !state_.is_stopped()) {
    const Task task = tasks_.back();
    tasks_.pop_back();
    primitives_.resize(task.first + task.count);
    const auto id = static_cast<NodeId>(job_.piece.nodes.size());
    const auto parts = build_node(task);
    if (!parts) continue;
    const auto all =
        static_cast<double>(parts->negative_count + positive_.size() + 1);
    const double each = cut_budget_for_each(task, *parts);
    const auto push = [&](std::size_t first, std::size_t size, const Box& box,
                          Side side) {
      const auto count = static_cast<double>(size);
      if (size > 0) {
        tasks_.push_back({first, size, box, task.share * count / all,
                          each * count, id, side});
      }
    };
    add_done(task.share / all);
    primitives_.resize(task.first + parts->negative_count);
    push(task.first, parts->negative_count, parts->negative_box,
         Side::kNegative);
    push(primitives_.size(), positive_.size(), parts->positive_box,
         Side::kPositive);
    primitives_.insert(primitives_.end(), positive_.begin(), positive_.end());
  }
  job_.piece.cut_vertices = std::move(job_.tree->cut_vertices);
  take_free_planes();
}

SahBuilder::Subtrees SahBuilder::build_root() {
  Subtrees result;
  const Task root = {0,          primitives_.size(), job_.box,
                     job_.share, job_.cut_budget,    kNoNode,
                     Side::kOn};
  if (const auto parts = build_node(root)) {
    const double share =
        job_.share /
        static_cast<double>(parts->negative_count + positive_.size());
    const double each = cut_budget_for_each(root, *parts);
    const auto subtree = [&](const Primitive* first, std::size_t size,
                             const Box& box) -> std::optional<BuildJob> {
      const auto count = static_cast<double>(size);
      if (size == 0) return std::nullopt;
      return job_of({first, size}, box, share * count, each * count);
    };
    result.positive =
        subtree(positive_.data(), positive_.size(), parts->positive_box);
    result.negative =
        subtree(primitives_.data(), parts->negative_count, parts->negative_box);
  }
  if (!job_.piece.fragments.empty()) {
    job_.piece.cut_vertices = std::move(job_.tree->cut_vertices);
  }
  take_free_planes();
  return result;
}

/// The region's box, rounded outwards, relative to the frame's origin.
Box SahBuilder::box_of(const ObjectRegion& region) const {
  Box box;
  for (std::size_t a = 0; a < 3; ++a) {
    const std::int64_t origin = coordinate_of(state_.origin, a);
    box.low[a] =
        float_below(static_cast<double>(coordinate_of(region.low, a) - origin));
    box.high[a] = float_above(
        static_cast<double>(coordinate_of(region.high, a) - origin));
  }
  return box;
}

/// Leaves the job's region empty: what is left in it goes, if it may be cut.
void SahBuilder::keep_cell(const Task& task, std::int32_t region) {
  for (const Primitive& primitive : list_of(task))
    state_.cells->note_polygon(region, primitive.source);
  job_.cells.push_back({region, 0});
  add_done(task.share);
  take_free_planes();
}

SahBuilder::Subtrees SahBuilder::build_region_root() {
  const KeptCells& cells = *state_.cells;
  Task root = {0,          primitives_.size(), job_.box,
               job_.share, job_.cut_budget,    kNoNode,
               Side::kOn};
  for (const std::int32_t r : job_.regions) {
    const Box box = box_of(cells.region(r));
    for (std::size_t a = 0; a < 3; ++a) {
      root.box.low[a] = std::min(root.box.low[a], box.low[a]);
      root.box.high[a] = std::max(root.box.high[a], box.high[a]);
    }
  }
  const NodeId id = add_node(root);
  // Step 1: choose a plane that cuts no region.
  std::optional<CellSplit> split;
  std::uint64_t used = 0;
  if (job_.regions.size() > 1) {
    split = balanced_split(cells, job_.regions);
    if (!split) state_.cells->note_locked(job_.regions.front());
  } else {
    auto face = best_face(cells, job_.regions[0], job_.used_faces,
                          list_of(root), state_.origin);
    if (face) used = job_.used_faces | std::uint64_t{1} << face->index;
    if (face) split = std::move(face->split);
  }
  if (!split) {
    keep_cell(root, job_.regions[0]);
    return {};
  }
  // Step 2: divide the list, and the regions.
  job_.tree->free_planes.push_back(split->plane);
  const auto splitter = static_cast<PlaneId>(state_.scene.polygon_count() +
                                             job_.tree->free_planes.size() - 1);
  Node& node = node_at(job_.piece, id);
  node.splitter = splitter;
  node.plane = splitter_.planes().plane(splitter);
  const Partition parts =
      distribute(root, {splitter, filter_plane(node.plane), nullptr});
  coincident_count_ = coincident_.size();
  add_fragments(id, coincident_);
  // Step 3: the jobs of both sides.
  const double each = cut_budget_for_each(root, parts);
  const double share = job_.share / static_cast<double>(parts.negative_count +
                                                        positive_.size() + 1);
  const auto subtree =
      [&](const Primitive* first, std::size_t size, const Box& box,
          std::vector<std::int32_t>& regions) -> std::optional<BuildJob> {
    if (size == 0 && regions.empty()) return std::nullopt;
    const auto count = static_cast<double>(size);
    BuildJob job = job_of({first, size}, box, share * count, each * count);
    job.regions = std::move(regions);
    job.used_faces = used;
    return job;
  };
  Subtrees result;
  result.positive = subtree(positive_.data(), positive_.size(),
                            parts.positive_box, split->positive);
  result.negative = subtree(primitives_.data(), parts.negative_count,
                            parts.negative_box, split->negative);
  if (!job_.piece.fragments.empty())
    job_.piece.cut_vertices = std::move(job_.tree->cut_vertices);
  take_free_planes();
  return result;
}

/// Those of the splitters above stay with the pieces that made them.
void SahBuilder::take_free_planes() {
  const auto& planes = job_.tree->free_planes;
  job_.piece.free_planes.assign(
      planes.begin() + static_cast<std::ptrdiff_t>(job_.inherited_planes),
      planes.end());
}

NodeId SahBuilder::add_node(const Task& task) {
  BspTree& piece = job_.piece;
  const auto id = static_cast<NodeId>(piece.nodes.size());
  if (task.parent != kNoNode) set_child(piece, task.parent, task.side, id);
  piece.nodes.emplace_back();
  piece.boxes.push_back(absolute(task.box));
  return id;
}

/// The rest of the cut budget, for each primitive of both sides.
double SahBuilder::cut_budget_for_each(const Task& task,
                                       const Partition& parts) const {
  const auto both =
      static_cast<double>(parts.negative_count + positive_.size());
  const double cuts = both + static_cast<double>(coincident_count_) -
                      static_cast<double>(task.count);
  return std::max(0.0, task.cut_budget - cuts) / std::max(1.0, both);
}

/// Builds a leaf of the task's list, or a node; the subtrees are still to be
/// built then.
std::optional<SahBuilder::Partition> SahBuilder::build_node(const Task& task) {
  HALFSPACE_ASSERT(task.count > 0);
  const DisplayTreeOptions& options = state_.options;
  const NodeId id = add_node(task);
  const auto leaf = [&]() -> std::optional<Partition> {
    make_leaf(id, task);
    add_done(task.share);
    return std::nullopt;
  };
  const bool is_short = task.count <= options.leaf_size;
  const double overdraw = is_short ? overdraw_cost(task) : 0;
  if (is_short && overdraw <= kMostOverdraw) return leaf();

  // Step 1: choose a plane.
  const PrimitiveList list = list_of(task);
  const double undivided = static_cast<double>(task.count) + overdraw;
  const AxisSplit axis = best_axis_split(list, task.box, options.cut_weight);
  PolygonSplit polygon;
  // Where a plane across an axis cuts nothing, no other can cut less.
  if (options.own_planes > 0 &&
      (is_short || !(axis.cost.cuts < 1) || !(axis.cost.cost < undivided))) {
    polygon = best_polygon_split({state_.scene, *job_.tree, job_.parts}, list,
                                 task.box, to_doubles(state_.origin),
                                 options.own_planes, options.cut_weight);
  }
  // Step 2: leave the list as it is where dividing costs more than it saves, or
  // makes more cuts than the budget allows.
  const bool across = axis.cost.cost <= polygon.cost.cost;
  const SplitCost& least = across ? axis.cost : polygon.cost;
  if (std::max(least.cuts, 1.0) > task.cut_budget) return leaf();
  if (!(least.cost < undivided) &&
      (is_short || !(least.cost < undivided + overdraw_cost(task)))) {
    return leaf();
  }

  // Step 3: divide the list.
  const PlaneId plane = across ? add_free_plane(axis) : polygon.polygon;
  Node& node = node_at(job_.piece, id);
  node.splitter = plane;
  node.plane = splitter_.planes().plane(plane);
  const Partition parts = distribute(
      task, {plane, filter_plane(node.plane), across ? &axis : nullptr});
  HALFSPACE_ASSERT(parts.negative_count + positive_.size() +
                       coincident_.size() >=
                   task.count);
  coincident_count_ = coincident_.size();
  add_fragments(id, coincident_);
  return parts;
}

PlaneId SahBuilder::add_free_plane(const AxisSplit& split) {
  job_.tree->free_planes.push_back(
      {static_cast<std::int32_t>(split.axis),
       static_cast<std::int64_t>(split.coordinate) +
           coordinate_of(state_.origin, split.axis)});
  return static_cast<PlaneId>(state_.scene.polygon_count() +
                              job_.tree->free_planes.size() - 1);
}

/// The cost of deciding by depth in a leaf of the list, in fragments.
double SahBuilder::overdraw_cost(const Task& task) {
  if (task.count < 2) return 0;
  const PrimitiveReader reader = {state_.scene, *job_.tree, job_.parts};
  const PrimitiveList list = list_of(task);
  const double pixels =
      overdraw_of(reader, list, task.box) / state_.scene_size * kImagePixels;
  const double cost = pixels * kOverdrawnPixel;
  if (cost <= kMostOverdraw) return cost;
  const double ratio = distinct_vertex_ratio(reader, list, vertices_);
  return cost * std::clamp((ratio - kMeshRatio) / (1 - kMeshRatio), 0.0, 1.0);
}

SahBuilder::Partition SahBuilder::distribute(const Task& task,
                                             const Splitter& splitter) {
  Partition result;
  positive_.clear();
  coincident_.clear();
  std::size_t negative_end = task.first;
  const std::size_t end = task.first + task.count;
  for (std::size_t i = task.first; i < end; ++i) {
    const Primitive primitive = primitives_[i];
    if (splitter.axis != nullptr) {
      // Boxes are rounded outwards, so a box on one side decides.
      const float low = primitive.low[splitter.axis->axis];
      const float high = primitive.high[splitter.axis->axis];
      const float at = splitter.axis->coordinate;
      const bool below = high < at || (high == at && low < at);
      if (below || low > at || (low == at && high > at)) {
        send(primitive, below ? -1 : 1, result, negative_end);
        continue;
      }
    }
    split_or_send(primitive, splitter, result, negative_end);
  }
  result.negative_count = negative_end - task.first;
  return result;
}

inline void SahBuilder::send(const Primitive& primitive, int side,
                             Partition& result, std::size_t& negative_end) {
  if (side < 0) {
    primitives_[negative_end++] = primitive;
    extend(result.negative_box, primitive);
  } else {
    positive_.push_back(primitive);
    extend(result.positive_box, primitive);
  }
}

/// Decides where a primitive goes by its vertices.
void SahBuilder::split_or_send(const Primitive& primitive,
                               const Splitter& splitter, Partition& result,
                               std::size_t& negative_end) {
  const std::size_t corners = job_.tree->corners.size();
  const FragmentRef part = fragment_of(primitive);
  const Relation relation =
      splitter_.relation(part, splitter.id, splitter.plane);
  if (relation == Relation::kSpanning) {
    const FragmentPair pair =
        splitter_.split(part, splitter.id, splitter.plane);
    send(primitive_of(primitive, pair.positive, 1, splitter.axis), 1, result,
         negative_end);
    send(primitive_of(primitive, pair.negative, -1, splitter.axis), -1, result,
         negative_end);
    return;
  }
  job_.tree->corners.resize(corners);
  if (relation == Relation::kCoincident) {
    coincident_.push_back(primitive);
  } else {
    send(primitive, relation == Relation::kPositive ? 1 : -1, result,
         negative_end);
  }
}

/// The primitive of a part of `whole`. Its box is that of its vertices, cut
/// down to the box of the whole and to its side of the plane.
Primitive SahBuilder::primitive_of(const Primitive& whole,
                                   const FragmentRef& part, int side,
                                   const AxisSplit* axis) {
  Primitive primitive = {kEmptyBox.low, part.source, kEmptyBox.high,
                         static_cast<std::int32_t>(job_.parts.size())};
  job_.parts.push_back(part);
  const std::array<double, 3> origin = to_doubles(state_.origin);
  for (std::uint32_t k = 0; k < part.count; ++k) {
    const Vertex v =
        splitter_.vertex(job_.tree->corners[part.first + k].vertex);
    const std::array<double, 3> at = {v.x, v.y, v.z};
    for (std::size_t a = 0; a < 3; ++a) {
      const double away = at[a] - origin[a];
      // The difference is rounded once, as are those of the error.
      const double doubt = v.error + std::abs(away) * 0x1p-51;
      primitive.low[a] = std::min(primitive.low[a], float_below(away - doubt));
      primitive.high[a] =
          std::max(primitive.high[a], float_above(away + doubt));
    }
  }
  for (std::size_t a = 0; a < 3; ++a) {
    primitive.low[a] = std::max(primitive.low[a], whole.low[a]);
    primitive.high[a] = std::min(primitive.high[a], whole.high[a]);
  }
  if (axis != nullptr) {
    float& low = primitive.low[axis->axis];
    float& high = primitive.high[axis->axis];
    if (side > 0) low = std::max(low, axis->coordinate);
    if (side < 0) high = std::min(high, axis->coordinate);
  }
  return primitive;
}

FragmentRef SahBuilder::fragment_of(const Primitive& primitive) {
  if (primitive.part == kWholePolygon) return splitter_.whole(primitive.source);
  return job_.parts[static_cast<std::size_t>(primitive.part)];
}

/// Whether all fragments of the list lie in one plane. Then `splitter` is the
/// lowest of their polygons, and their ids decide which is in front (S5.3).
bool SahBuilder::is_flat(const Task& task, PolygonId& splitter) {
  if (task.count < 2) return false;
  const PrimitiveList list = list_of(task);
  splitter = list.primitives[0].source;
  for (const Primitive& primitive : list)
    splitter = std::min(splitter, primitive.source);
  const FilterPlane plane = filter_plane(plane_of(state_.scene, splitter));
  const std::size_t corners = job_.tree->corners.size();
  for (const Primitive& primitive : list) {
    const Relation relation =
        splitter_.relation(fragment_of(primitive), splitter, plane);
    job_.tree->corners.resize(corners);
    if (relation != Relation::kCoincident) return false;
  }
  return true;
}

void SahBuilder::make_leaf(NodeId id, const Task& task) {
  PolygonId splitter = 0;
  if (is_flat(task, splitter)) {
    Node& node = node_at(job_.piece, id);
    node.splitter = splitter;
    node.plane = plane_of(state_.scene, splitter);
  }
  coincident_.assign(
      primitives_.begin() + static_cast<std::ptrdiff_t>(task.first),
      primitives_.begin() +
          static_cast<std::ptrdiff_t>(task.first + task.count));
  add_fragments(id, coincident_);
}

std::size_t SahBuilder::corner_count(const Primitive& primitive) const {
  return primitive.part == kWholePolygon
             ? state_.scene.corners(primitive.source).size()
             : job_.parts[static_cast<std::size_t>(primitive.part)].count;
}

/// Sorts triangles first, then quadrangles, then the others, each by id.
void SahBuilder::sort_for_leaf(std::vector<Primitive>& primitives) const {
  auto rest = primitives.begin();
  for (const std::size_t corners : {3u, 4u}) {
    const auto first = rest;
    rest = std::partition(first, primitives.end(), [&](const Primitive& p) {
      return corner_count(p) == corners;
    });
    sort_by_source(first, rest);
  }
  sort_by_source(rest, primitives.end());
}

/// Gives the node these fragments, in id order; a leaf in that of its packets.
void SahBuilder::add_fragments(NodeId id, std::vector<Primitive>& primitives) {
  if (primitives.empty()) return;
  BspTree& piece = job_.piece;
  Node& node = node_at(piece, id);
  if (node.splitter == kNoPlane) {
    sort_for_leaf(primitives);
  } else {
    sort_by_source(primitives.begin(), primitives.end());
  }
  node.first_fragment = static_cast<std::int32_t>(piece.fragments.size());
  for (const Primitive& primitive : primitives) {
    const auto first = static_cast<std::uint32_t>(piece.corners.size());
    if (primitive.part == kWholePolygon) {
      const auto corners = state_.scene.corners(primitive.source);
      for (std::size_t k = 0; k < corners.size(); ++k) {
        piece.corners.push_back({static_cast<EdgeCode>(k), corners[k]});
      }
    } else {
      const FragmentRef& part =
          job_.parts[static_cast<std::size_t>(primitive.part)];
      const auto from = job_.tree->corners.begin() + part.first;
      piece.corners.insert(piece.corners.end(), from, from + part.count);
    }
    const auto count = static_cast<std::uint32_t>(piece.corners.size()) - first;
    const bool flipped =
        node.splitter != kNoPlane && node.splitter != primitive.source &&
        opposed(plane_of(state_.scene, primitive.source), node.plane);
    piece.fragments.push_back(
        {primitive.source, first, count & kMostCornersOfFragment,
         flipped ? 1u : 0u,
         static_cast<std::int32_t>(piece.fragments.size()) + 1});
  }
  piece.fragments.back().next = kNoFragment;
}

/// A job for some of the primitives, with copies of all that they refer to.
BuildJob SahBuilder::job_of(const PrimitiveList& list, const Box& box,
                            double share, double cut_budget) const {
  BuildJob job;
  job.primitives.assign(list.begin(), list.end());
  job.box = box;
  job.share = share;
  job.cut_budget = cut_budget;
  job.tree->free_planes = job_.tree->free_planes;
  job.tree->slanted = job_.tree->slanted;
  job.inherited_planes = job_.tree->free_planes.size();
  const auto vertex_count =
      static_cast<std::int32_t>(state_.scene.data().vertices.size());
  std::vector<std::int32_t> copies(job_.tree->cut_vertices.size(), -1);
  for (Primitive& primitive : job.primitives) {
    if (primitive.part == kWholePolygon) continue;
    const FragmentRef& part =
        job_.parts[static_cast<std::size_t>(primitive.part)];
    primitive.part = static_cast<std::int32_t>(job.parts.size());
    job.parts.push_back({part.source,
                         static_cast<std::uint32_t>(job.tree->corners.size()),
                         part.count});
    for (std::uint32_t k = 0; k < part.count; ++k) {
      Corner corner = job_.tree->corners[part.first + k];
      if (corner.vertex >= vertex_count) {
        const auto old = static_cast<std::size_t>(corner.vertex - vertex_count);
        if (copies[old] < 0) {
          copies[old] =
              static_cast<std::int32_t>(job.tree->cut_vertices.size());
          job.tree->cut_vertices.push_back(job_.tree->cut_vertices[old]);
        }
        corner.vertex = vertex_count + copies[old];
      }
      job.tree->corners.push_back(corner);
    }
  }
  return job;
}

Box SahBuilder::absolute(const Box& box) const {
  const std::array<double, 3> origin = to_doubles(state_.origin);
  Box result;
  for (std::size_t a = 0; a < 3; ++a) {
    result.low[a] = sum_below(origin[a], double{box.low[a]});
    result.high[a] = -sum_below(-origin[a], -double{box.high[a]});
  }
  return result;
}

void SahBuilder::add_done(double share) {
  if (!state_.options.progress) return;
  done_ += share;
  if (done_ < kGatheredShare && ++gathered_ < kGatheredNodes) return;
  state_.add_done(done_);
  done_ = 0;
  gathered_ = 0;
}

}  // namespace halfspace::fast
