#include <algorithm>
#include <cstddef>
#include <vector>

#include "sah/sah_builder.hpp"

namespace halfspace::fast {

/// Whether all fragments of the list lie in one plane, that of the polygon
/// `splitter`, the lowest of them: then their ids settle their order (S5.3).
bool DisplayWorker::is_flat(const Task& task, PolygonId& splitter) {
  if (task.count < 2) return false;
  const ItemList list = {items_.data() + task.first, task.count};
  splitter = list.items[0].source;
  for (const Item& item : list) splitter = std::min(splitter, item.source);
  const FilterPlane plane = filter_plane(plane_of(work_.scene, splitter));
  const std::size_t corners = job_.tree.corners.size();
  for (const Item& item : list) {
    const Relation relation = builder_.relation(part_of(item), splitter, plane);
    job_.tree.corners.resize(corners);
    if (relation != Relation::kCoincident) return false;
  }
  return true;
}

void DisplayWorker::make_leaf(NodeId id, const Task& task) {
  PolygonId splitter = 0;
  if (is_flat(task, splitter)) {
    Node& node = job_.piece.nodes[static_cast<std::size_t>(id)];
    node.splitter = splitter;
    node.plane = plane_of(work_.scene, splitter);
  }
  coincident_.assign(
      items_.begin() + static_cast<std::ptrdiff_t>(task.first),
      items_.begin() + static_cast<std::ptrdiff_t>(task.first + task.count));
  add_fragments(id, coincident_);
}

std::size_t DisplayWorker::corner_count(const Item& item) const {
  return item.part == kWhole
             ? work_.scene.corners(item.source).size()
             : job_.parts[static_cast<std::size_t>(item.part)].count;
}

/// Gives the node these fragments, in id order; a leaf its triangles first, and
/// then its quadrangles.
void DisplayWorker::add_fragments(NodeId id, std::vector<Item>& items) {
  if (items.empty()) return;
  const auto sort = [](auto from, auto to) {
    std::sort(from, to,
              [](const Item& p, const Item& q) { return p.source < q.source; });
  };
  auto rest = items.begin();
  if (job_.piece.nodes[static_cast<std::size_t>(id)].splitter == kNoPlane) {
    for (const std::size_t corners : {3u, 4u}) {
      const auto first = rest;
      rest = std::partition(first, items.end(), [&](const Item& item) {
        return corner_count(item) == corners;
      });
      sort(first, rest);
    }
  }
  sort(rest, items.end());
  BspTree& piece = job_.piece;
  Node& node = piece.nodes[static_cast<std::size_t>(id)];
  node.first_fragment = static_cast<std::int32_t>(piece.fragments.size());
  for (const Item& item : items) {
    const auto first = static_cast<std::uint32_t>(piece.corners.size());
    if (item.part == kWhole) {
      const auto corners = work_.scene.corners(item.source);
      for (std::size_t k = 0; k < corners.size(); ++k) {
        piece.corners.push_back({static_cast<EdgeCode>(k), corners[k]});
      }
    } else {
      const Part& part = job_.parts[static_cast<std::size_t>(item.part)];
      const auto from = job_.tree.corners.begin() + part.first;
      piece.corners.insert(piece.corners.end(), from, from + part.count);
    }
    const auto count = static_cast<std::uint32_t>(piece.corners.size()) - first;
    const bool turned = node.splitter != kNoPlane &&
                        node.splitter != item.source &&
                        opposed(plane_of(work_.scene, item.source), node.plane);
    piece.fragments.push_back(
        {item.source, first, count & kCountMask, turned ? 1u : 0u,
         static_cast<std::int32_t>(piece.fragments.size()) + 1});
  }
  piece.fragments.back().next = kNoFragment;
}

}  // namespace halfspace::fast
