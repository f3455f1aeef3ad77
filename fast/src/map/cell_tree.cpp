#include "map/cell_tree.hpp"

#include <algorithm>
#include <cmath>

#include "halfspace/assert.hpp"

namespace halfspace::fast {

CellTree::CellTree(LineTable& lines, const Rectangle& rectangle, int depth)
    : lines_(lines), cutter_(lines) {
  add_cell(add_node(-1), cutter_.rectangle(), kBackground);
  grid(rectangle, depth);
}

CellNodeId CellTree::add_node(CellNodeId parent) {
  Node node;
  node.parent = parent;
  nodes_.push_back(node);
  return static_cast<CellNodeId>(nodes_.size() - 1);
}

void CellTree::add_cell(CellNodeId node, std::span<const CellEdge> polygon,
                        PolygonId item) {
  Cell cell;
  cell.item = item;
  cell.edge_count = static_cast<std::uint32_t>(polygon.size());
  if (free_edges_.size() > polygon.size() &&
      !free_edges_[polygon.size()].empty()) {
    auto& free = free_edges_[polygon.size()];
    cell.first_edge = free.back();
    free.pop_back();
    std::copy(polygon.begin(), polygon.end(),
              edges_.begin() + static_cast<std::ptrdiff_t>(cell.first_edge));
  } else {
    cell.first_edge = edges_.size();
    edges_.insert(edges_.end(), polygon.begin(), polygon.end());
  }
  if (free_cells_.empty()) {
    nodes_[at(node)].cell = static_cast<std::int32_t>(cells_.size());
    cells_.push_back(cell);
  } else {
    nodes_[at(node)].cell = free_cells_.back();
    free_cells_.pop_back();
    cells_[at(nodes_[at(node)].cell)] = cell;
  }
  ++cell_count_;
}

void CellTree::divide(CellNodeId node, LineId line) {
  const CellNodeId positive = add_node(node);
  const CellNodeId negative = add_node(node);
  Node& divided = nodes_[at(node)];
  divided.line = line;
  divided.positive = positive;
  divided.negative = negative;
}

void CellTree::drop_cell(CellNodeId node) {
  const std::int32_t number = nodes_[at(node)].cell;
  const Cell& cell = cells_[at(number)];
  if (free_edges_.size() <= cell.edge_count)
    free_edges_.resize(std::size_t{cell.edge_count} + 1);
  free_edges_[cell.edge_count].push_back(cell.first_edge);
  free_cells_.push_back(number);
  nodes_[at(node)].cell = -1;
  --cell_count_;
}

void CellTree::grid(const Rectangle& rectangle, int depth) {
  struct Block {
    CellNodeId leaf;
    std::int32_t left, top, right, bottom;
    int depth;
  };
  std::vector<Block> blocks = {{0, rectangle.left, rectangle.top,
                                rectangle.right, rectangle.bottom, depth}};
  while (!blocks.empty()) {
    const Block block = blocks.back();
    blocks.pop_back();
    const std::int32_t across = block.right - block.left;
    const std::int32_t down = block.bottom - block.top;
    if (block.depth == 0 || std::max(across, down) < 2) continue;
    const bool is_column = across >= down;
    const std::int32_t middle = is_column ? (block.left + block.right) / 2
                                          : (block.top + block.bottom) / 2;
    const LineId line =
        is_column ? lines_.upright(middle) : lines_.level(middle);
    polygon_ = polygon_of(block.leaf);
    cutter_.classify(polygon_, line);
    positive_.clear();
    negative_.clear();
    cutter_.cut(polygon_, line, block.leaf, positive_, negative_);
    drop_cell(block.leaf);
    divide(block.leaf, line);
    add_cell(nodes_[at(block.leaf)].positive, positive_, kBackground);
    add_cell(nodes_[at(block.leaf)].negative, negative_, kBackground);
    Block high = block;
    Block low = block;
    high.leaf = nodes_[at(block.leaf)].positive;
    low.leaf = nodes_[at(block.leaf)].negative;
    (is_column ? high.left : high.top) = middle;
    (is_column ? low.right : low.bottom) = middle;
    high.depth = low.depth = block.depth - 1;
    blocks.push_back(high);
    blocks.push_back(low);
  }
}

bool CellTree::clip(std::span<const HalfPlane> sides) {
  polygon_ = cutter_.rectangle();
  for (const HalfPlane& side : sides) {
    if (!cutter_.clip(polygon_, side, kOwnEdge)) return false;
  }
  return true;
}

template <class Enter, class AtLeaf>
void CellTree::spread(const Enter& enter, const AtLeaf& at_leaf) {
  work_.assign(polygon_.begin(), polygon_.end());
  steps_.assign(1, {0, 0, work_.size()});
  while (!steps_.empty()) {
    const Step step = steps_.back();
    steps_.pop_back();
    work_.resize(step.first + step.count);
    if (!enter(nodes_[at(step.node)])) continue;
    polygon_.assign(work_.begin() + static_cast<std::ptrdiff_t>(step.first),
                    work_.end());
    const Node node = nodes_[at(step.node)];
    if (node.cell >= 0) {
      at_leaf(step.node, polygon_);
      continue;
    }
    const int found = cutter_.classify(polygon_, node.line);
    if (found == kSomePositive) {
      steps_.push_back({node.positive, step.first, step.count});
    } else if (found == kSomeNegative) {
      steps_.push_back({node.negative, step.first, step.count});
    } else {
      positive_.clear();
      negative_.clear();
      cutter_.cut(polygon_, node.line, -1, positive_, negative_);
      work_.resize(step.first);
      work_.insert(work_.end(), positive_.begin(), positive_.end());
      work_.insert(work_.end(), negative_.begin(), negative_.end());
      steps_.push_back({node.positive, step.first, positive_.size()});
      steps_.push_back(
          {node.negative, step.first + positive_.size(), negative_.size()});
    }
  }
}

void CellTree::light(std::span<const HalfPlane> sides, PolygonId item) {
  if (!clip(sides)) return;
  spread([](const Node& node) { return !node.full; },
         [&](CellNodeId leaf, std::span<const CellEdge> part) {
           mark_full(set_item(leaf, part, item));
         });
}

void CellTree::cover(std::span<const HalfPlane> sides, const Change& change) {
  if (!clip(sides)) return;
  spread([](const Node&) { return true; },
         [&](CellNodeId leaf, std::span<const CellEdge> part) {
           set_item(leaf, part, change(cells_[at(nodes_[at(leaf)].cell)].item));
         });
}

std::vector<CellEdge> CellTree::polygon_of(CellNodeId leaf) const {
  const Cell& cell = cells_[at(nodes_[at(leaf)].cell)];
  const CellEdge* first = edges_.data() + cell.first_edge;
  return {first, first + cell.edge_count};
}

CellNodeId CellTree::set_item(CellNodeId leaf, std::span<const CellEdge> part,
                              PolygonId item) {
  const PolygonId before = cells_[at(nodes_[at(leaf)].cell)].item;
  std::vector<CellEdge> inside = polygon_of(leaf);
  CellNodeId node = leaf;
  for (const CellEdge& edge : part) {
    if (edge.node != kOwnEdge) continue;
    if (cutter_.classify(inside, edge.line) != (kSomeNegative | kSomePositive))
      continue;
    positive_.clear();
    negative_.clear();
    cutter_.cut(inside, edge.line, node, positive_, negative_);
    if (node == leaf) drop_cell(leaf);
    divide(node, edge.line);
    const Node& divided = nodes_[at(node)];
    const bool is_positive = edge.side > 0;
    const CellNodeId outside =
        is_positive ? divided.negative : divided.positive;
    node = is_positive ? divided.positive : divided.negative;
    add_cell(outside, is_positive ? negative_ : positive_, before);
    inside.swap(is_positive ? positive_ : negative_);
  }
  if (node == leaf) {
    cells_[at(nodes_[at(leaf)].cell)].item = item;
  } else {
    add_cell(node, inside, item);
  }
  return node;
}

void CellTree::mark_full(CellNodeId node) {
  nodes_[at(node)].full = true;
  for (CellNodeId up = nodes_[at(node)].parent; up >= 0;
       up = nodes_[at(up)].parent) {
    Node& parent = nodes_[at(up)];
    if (!nodes_[at(parent.positive)].full || !nodes_[at(parent.negative)].full)
      return;
    parent.full = true;
  }
}

bool CellTree::any_unlit(const CellBox& box) {
  visits_.assign(1, 0);
  const double x = (box.left + box.right) / 2;
  const double y = (box.top + box.bottom) / 2;
  const double across = (box.right - box.left) / 2;
  const double down = (box.bottom - box.top) / 2;
  while (!visits_.empty()) {
    const Node& node = nodes_[at(visits_.back())];
    visits_.pop_back();
    if (node.full) continue;
    if (node.cell >= 0) return true;
    const double a = lines_.slope_x(node.line);
    const double b = lines_.slope_y(node.line);
    const double c = lines_.offset(node.line);
    const double value = a * x + b * y + c;
    // What rounding adds is far below the margin of 2^-30.
    const double reach =
        std::abs(a) * across + std::abs(b) * down +
        0x1p-30 * (std::abs(a * x) + std::abs(b * y) + std::abs(c));
    if (value >= -reach) visits_.push_back(node.positive);
    if (value <= reach) visits_.push_back(node.negative);
  }
  return false;
}

}  // namespace halfspace::fast
