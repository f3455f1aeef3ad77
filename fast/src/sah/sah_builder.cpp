#include "sah/sah_builder.hpp"

#include <utility>

namespace halfspace::fast {
namespace {

/// A worker gathers so much before it tells of it.
constexpr double kGatheredShare = 1.0 / 1024;

/// The image that trees are made for. Units: pixels.
constexpr double kImagePixels = 1500.0 * 1500.0;

/// What a pixel costs that is decided by depth, in fragments.
constexpr double kContendedPixel = 0.02;

/// A leaf may cost so many fragments on top of its own.
constexpr double kContended = 8;

/// From this share of own vertices on polygons are a mesh.
constexpr double kMeshShare = 0.6;

constexpr Box kNothing = kNoBox;

/// a + b, rounded downwards to a float.
float sum_below(double a, double b) {
  const double sum = a + b;
  const double b_part = sum - a;
  const double error = (a - (sum - b_part)) + (b - b_part);
  return below(
      error < 0 ? std::nextafter(sum, -std::numeric_limits<double>::infinity())
                : sum);
}

std::array<double, 3> to_doubles(const GridPoint& p) {
  return {static_cast<double>(p.x), static_cast<double>(p.y),
          static_cast<double>(p.z)};
}

std::int64_t coordinate_of(const GridPoint& p, std::size_t axis) {
  return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
}

}  // namespace

DisplayWorker::DisplayWorker(DisplayWork& work, DisplayJob& job)
    : work_(work),
      job_(job),
      builder_(work.scene, job.tree, job.stats),
      items_(job.items) {}

void DisplayWorker::make_subtree() {
  tasks_.push_back({0, items_.size(), job_.box, job_.share, job_.allowance,
                    kNoNode, Side::kOn});
  while (!tasks_.empty() && !work_.is_stopped()) {
    const Task task = tasks_.back();
    tasks_.pop_back();
    items_.resize(task.first + task.count);
    const auto id = static_cast<NodeId>(job_.piece.nodes.size());
    const auto parts = make_node(task);
    if (!parts) continue;
    const auto all =
        static_cast<double>(parts->negative_count + positive_.size() + 1);
    const auto share = [&](std::size_t count) {
      return task.share * static_cast<double>(count) / all;
    };
    const double each = allowance_for_each(task, *parts);
    const auto allowance = [each](std::size_t count) {
      return each * static_cast<double>(count);
    };
    add_done(share(1));
    items_.resize(task.first + parts->negative_count);
    if (parts->negative_count > 0) {
      tasks_.push_back({task.first, parts->negative_count, parts->negative_box,
                        share(parts->negative_count),
                        allowance(parts->negative_count), id, Side::kNegative});
    }
    if (!positive_.empty()) {
      tasks_.push_back({items_.size(), positive_.size(), parts->positive_box,
                        share(positive_.size()), allowance(positive_.size()),
                        id, Side::kPositive});
      items_.insert(items_.end(), positive_.begin(), positive_.end());
    }
  }
  job_.piece.cut_vertices = std::move(job_.tree.cut_vertices);
  job_.piece.free_planes = std::move(job_.tree.free_planes);
}

DisplayWorker::Divided DisplayWorker::divide() {
  Divided result;
  const Task root = {0,          items_.size(),  job_.box,
                     job_.share, job_.allowance, kNoNode,
                     Side::kOn};
  const auto parts = make_node(root);
  if (parts) {
    const double share =
        job_.share /
        static_cast<double>(parts->negative_count + positive_.size());
    const double each = allowance_for_each(root, *parts);
    const auto part = [&](const Item* items, std::size_t size, const Box& box) {
      const auto count = static_cast<double>(size);
      return job_of(items, size, box, share * count, each * count);
    };
    if (!positive_.empty()) {
      result.positive =
          part(positive_.data(), positive_.size(), parts->positive_box);
    }
    if (parts->negative_count > 0) {
      result.negative =
          part(items_.data(), parts->negative_count, parts->negative_box);
    }
  }
  if (!job_.piece.fragments.empty()) {
    job_.piece.cut_vertices = std::move(job_.tree.cut_vertices);
  }
  job_.piece.free_planes = std::move(job_.tree.free_planes);
  return result;
}

NodeId DisplayWorker::add_node(const Task& task) {
  BspTree& piece = job_.piece;
  const auto id = static_cast<NodeId>(piece.nodes.size());
  if (task.parent != kNoNode) {
    Node& parent = piece.nodes[static_cast<std::size_t>(task.parent)];
    (task.side == Side::kPositive ? parent.positive : parent.negative) = id;
  }
  piece.nodes.emplace_back();
  piece.boxes.push_back(absolute(task.box));
  return id;
}

/// What is left of the allowance, for each item of both sides.
double DisplayWorker::allowance_for_each(const Task& task,
                                         const Partition& parts) const {
  const auto both =
      static_cast<double>(parts.negative_count + positive_.size());
  const double cuts = both + static_cast<double>(coincident_count_) -
                      static_cast<double>(task.count);
  return std::max(0.0, task.allowance - cuts) / std::max(1.0, both);
}

/// Makes a node of the task's list: a leaf, or nothing is left undone but the
/// subtrees.
std::optional<DisplayWorker::Partition> DisplayWorker::make_node(
    const Task& task) {
  const DisplayTreeOptions& options = work_.options;
  const NodeId id = add_node(task);
  const auto leaf = [&]() -> std::optional<Partition> {
    make_leaf(id, task);
    add_done(task.share);
    return std::nullopt;
  };
  const bool is_short = task.count <= options.leaf_size;
  const double contended = is_short ? contended_by(task) : 0;
  if (is_short && contended <= kContended) return leaf();

  // Step 1: choose a plane.
  const ItemList list = {items_.data() + task.first, task.count};
  const double undivided = static_cast<double>(task.count) + contended;
  const AxisSplit axis = best_axis_split(list, task.box, options.cut_weight);
  OwnSplit own;
  // Where a plane across an axis cuts nothing, no other can cut less.
  if (options.own_planes > 0 &&
      (is_short || !(axis.cost.cuts < 1) || !(axis.cost.cost < undivided))) {
    own = best_own_split({work_.scene, job_.tree, job_.parts}, list, task.box,
                         to_doubles(work_.origin), options.own_planes,
                         options.cut_weight);
  }
  // Step 2: leave the list as it is where dividing costs more than it brings,
  // or more cuts than are left.
  const SplitCost& least =
      axis.cost.cost <= own.cost.cost ? axis.cost : own.cost;
  if (std::max(least.cuts, 1.0) > task.allowance) return leaf();
  const double cost = least.cost;
  if (!(cost < undivided) &&
      (is_short || !(cost < undivided + contended_by(task)))) {
    return leaf();
  }

  // Step 3: divide the list.
  const bool across = axis.cost.cost <= own.cost.cost;
  PlaneId plane = own.polygon;
  if (across) {
    plane = static_cast<PlaneId>(work_.scene.polygon_count() +
                                 job_.tree.free_planes.size());
    job_.tree.free_planes.push_back(
        {static_cast<std::int32_t>(axis.axis),
         static_cast<std::int64_t>(axis.coordinate) +
             coordinate_of(work_.origin, axis.axis)});
  }
  Node& node = job_.piece.nodes[static_cast<std::size_t>(id)];
  node.splitter = plane;
  node.plane = builder_.geometry().plane(plane);
  const Partition parts =
      distribute(task, plane, node.plane, across ? &axis : nullptr);
  coincident_count_ = coincident_.size();
  add_fragments(id, coincident_);
  return parts;
}

/// What deciding by depth costs a leaf of the list, in fragments.
double DisplayWorker::contended_by(const Task& task) {
  if (task.count < 2) return 0;
  const ItemReader reader = {work_.scene, job_.tree, job_.parts};
  const ItemList list = {items_.data() + task.first, task.count};
  const double pixels =
      overlap_of(reader, list, task.box) / work_.scene_size * kImagePixels;
  const double cost = pixels * kContendedPixel;
  if (cost <= kContended) return cost;
  const double own = share_of_own_vertices(reader, list, vertices_);
  return cost * std::clamp((own - kMeshShare) / (1 - kMeshShare), 0.0, 1.0);
}

DisplayWorker::Partition DisplayWorker::distribute(const Task& task, PlaneId id,
                                                   const Plane& plane,
                                                   const AxisSplit* axis) {
  Partition result;
  positive_.clear();
  coincident_.clear();
  const FilterPlane filter = filter_plane(plane);
  std::size_t negative_end = task.first;
  const std::size_t end = task.first + task.count;
  for (std::size_t i = task.first; i < end; ++i) {
    const Item item = items_[i];
    if (axis != nullptr) {
      const float low = item.low[axis->axis];
      const float high = item.high[axis->axis];
      const float at = axis->coordinate;
      // Boxes are rounded outwards: what they say holds.
      if (high < at || (high == at && low < at)) {
        items_[negative_end++] = item;
        include(result.negative_box, item);
        continue;
      }
      if (low > at || (low == at && high > at)) {
        positive_.push_back(item);
        include(result.positive_box, item);
        continue;
      }
    }
    cut_or_send(item, id, filter, axis, result, negative_end);
  }
  result.negative_count = negative_end - task.first;
  return result;
}

/// What the box cannot tell.
void DisplayWorker::cut_or_send(const Item& item, PlaneId id,
                                const FilterPlane& plane, const AxisSplit* axis,
                                Partition& result, std::size_t& negative_end) {
  const auto send = [&](const Item& sent, int side) {
    if (side < 0) {
      items_[negative_end++] = sent;
      include(result.negative_box, sent);
    } else {
      positive_.push_back(sent);
      include(result.positive_box, sent);
    }
  };
  const std::size_t corners = job_.tree.corners.size();
  const Part part = part_of(item);
  const Relation relation = builder_.relation(part, id, plane);
  if (relation == Relation::kSpanning) {
    const CutParts cut = builder_.cut(part, id, plane);
    send(part_item(item, cut.positive, 1, axis), 1);
    send(part_item(item, cut.negative, -1, axis), -1);
    return;
  }
  job_.tree.corners.resize(corners);
  if (relation == Relation::kCoincident) {
    coincident_.push_back(item);
  } else {
    send(item, relation == Relation::kPositive ? 1 : -1);
  }
}

/// The item of a part of `whole`: the box of its vertices, which is within that
/// of the whole, and on its side of the plane.
Item DisplayWorker::part_item(const Item& whole, const Part& part, int side,
                              const AxisSplit* axis) {
  Item item = {kNothing.low, part.source, kNothing.high,
               static_cast<std::int32_t>(job_.parts.size())};
  job_.parts.push_back(part);
  const std::array<double, 3> origin = to_doubles(work_.origin);
  for (std::uint32_t k = 0; k < part.count; ++k) {
    const Vertex v = builder_.vertex(job_.tree.corners[part.first + k].vertex);
    const std::array<double, 3> at = {v.x, v.y, v.z};
    for (std::size_t a = 0; a < 3; ++a) {
      const double away = at[a] - origin[a];
      // The difference is rounded once, as are those of the error.
      const double doubt = v.error + std::abs(away) * 0x1p-51;
      item.low[a] = std::min(item.low[a], below(away - doubt));
      item.high[a] = std::max(item.high[a], above(away + doubt));
    }
  }
  for (std::size_t a = 0; a < 3; ++a) {
    item.low[a] = std::max(item.low[a], whole.low[a]);
    item.high[a] = std::min(item.high[a], whole.high[a]);
  }
  if (axis != nullptr) {
    float& low = item.low[axis->axis];
    float& high = item.high[axis->axis];
    if (side > 0) low = std::max(low, axis->coordinate);
    if (side < 0) high = std::min(high, axis->coordinate);
  }
  return item;
}

Part DisplayWorker::part_of(const Item& item) {
  if (item.part == kWhole) return builder_.whole(item.source);
  return job_.parts[static_cast<std::size_t>(item.part)];
}

Box DisplayWorker::absolute(const Box& box) const {
  const std::array<double, 3> origin = to_doubles(work_.origin);
  Box result;
  for (std::size_t a = 0; a < 3; ++a) {
    result.low[a] = sum_below(origin[a], double{box.low[a]});
    result.high[a] = -sum_below(-origin[a], -double{box.high[a]});
  }
  return result;
}

void DisplayWorker::add_done(double share) {
  if (!work_.options.progress) return;
  done_ += share;
  if (done_ < kGatheredShare) return;
  work_.add_done(done_);
  done_ = 0;
}

}  // namespace halfspace::fast
