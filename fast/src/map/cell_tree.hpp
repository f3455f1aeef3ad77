#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "camera/view.hpp"
#include "map/convex_cutter.hpp"
#include "map/line_table.hpp"

namespace halfspace::fast {

/// A cell: `edges[first_edge]` and the `edge_count - 1` after it.
struct Cell {
  PolygonId item = kBackground;
  std::size_t first_edge = 0;
  std::uint32_t edge_count = 0;
};

/// A rectangle in twice the image's coordinates.
struct CellBox {
  double left = 0;
  double top = 0;
  double right = 0;
  double bottom = 0;
};

/// A rectangle of the image, divided by a 2-D BSP tree into convex cells, each
/// lit by one polygon or unlit (S7.2; FAQ, "two dimensional BSP tree").
class CellTree {
 public:
  /// `depth`: how often the rectangle is halved beforehand, across x and y in
  /// turn, so that the tree stays shallow.
  /// Requires: the rectangle is that of the table.
  CellTree(LineTable& lines, const Rectangle& rectangle, int depth);

  /// Lights the unlit parts of the intersection of the half-planes.
  void light(std::span<const HalfPlane> sides, PolygonId item);

  /// What becomes of a cell's item.
  using Change = std::function<PolygonId(PolygonId)>;
  /// Changes the items of the cells in the intersection of the half-planes,
  /// lit or not, which it divides where it ends.
  void cover(std::span<const HalfPlane> sides, const Change& change);

  /// Whether a cell that may meet the box is unlit.
  bool any_unlit(const CellBox& box);
  bool full() const { return nodes_[0].full; }

  std::size_t cell_count() const { return cell_count_; }
  CellNodeId node_count() const {
    return static_cast<CellNodeId>(nodes_.size());
  }
  LineId line_of(CellNodeId node) const { return nodes_[at(node)].line; }
  /// Calls visit(cell) for every cell; its edges are `edges()[first_edge]` and
  /// those after it. Some of edges() are of no cell.
  template <class Visit>
  void for_cells(Visit&& visit) const {
    for (const Node& node : nodes_) {
      if (node.cell >= 0) visit(cells_[at(node.cell)]);
    }
  }
  const std::vector<CellEdge>& edges() const { return edges_; }

 private:
  struct Node {
    LineId line = -1;
    std::int32_t positive = -1;
    std::int32_t negative = -1;
    std::int32_t parent = -1;
    std::int32_t cell = -1;  ///< of a leaf, else -1
    bool full = false;       ///< no cell in it is unlit
  };
  /// What is left of a fragment at a node, in `work_`.
  struct Step {
    CellNodeId node = 0;
    std::size_t first = 0;
    std::size_t count = 0;
  };

  static std::size_t at(std::int32_t index) {
    return static_cast<std::size_t>(index);
  }
  CellNodeId add_node(CellNodeId parent);
  void add_cell(CellNodeId node, std::span<const CellEdge> polygon,
                PolygonId item);
  void drop_cell(CellNodeId node);
  /// Gives a node without a cell two children without cells.
  void divide(CellNodeId node, LineId line);
  std::vector<CellEdge> polygon_of(CellNodeId leaf) const;
  void grid(const Rectangle& rectangle, int depth);
  /// The intersection of the half-planes with the rectangle, into `polygon_`;
  /// false if there is none.
  bool clip(std::span<const HalfPlane> sides);
  /// Down the tree with what is in `polygon_`, cut where it divides: calls
  /// at_leaf(leaf, part). Passes by what enter(node) says no to.
  template <class Enter, class AtLeaf>
  void spread(const Enter& enter, const AtLeaf& at_leaf);
  /// Gives a part of a leaf's cell an item, which is bounded by the cell's own
  /// lines and those of `part` that are marked as the fragment's. Returns the
  /// part's leaf.
  CellNodeId set_item(CellNodeId leaf, std::span<const CellEdge> part,
                      PolygonId item);
  void mark_full(CellNodeId node);

  LineTable& lines_;
  ConvexCutter cutter_;
  std::vector<Node> nodes_;
  std::vector<Cell> cells_;
  std::vector<CellEdge> edges_;
  std::size_t cell_count_ = 0;
  /// Where edges of cells that are gone stood, by their count, and such cells.
  std::vector<std::vector<std::size_t>> free_edges_;
  std::vector<std::int32_t> free_cells_;
  // Scratch.
  std::vector<CellEdge> work_;
  std::vector<CellEdge> positive_;
  std::vector<CellEdge> negative_;
  std::vector<CellEdge> polygon_;
  std::vector<Step> steps_;
  std::vector<CellNodeId> visits_;
};

/// The node of the edges of a fragment that are not on a node's line yet.
constexpr CellNodeId kOwnEdge = -5;

}  // namespace halfspace::fast
