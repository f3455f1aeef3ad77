#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "halfspace/fast/image/lazy_tree.hpp"
#include "halfspace/threads.hpp"
#include "sah/build_state.hpp"
#include "sah/cell_division.hpp"

namespace halfspace::fast {

struct LazyPart;

/// A cell, and what was built of it.
struct LazyCell {
  CellList list;
  int depth = 0;  ///< how many divisions it is in
  Mutex mutex;    ///< held by who builds it
  /// Null before; then it stays as it is.
  std::atomic<const LazyPart*> part = nullptr;
  std::unique_ptr<LazyPart> owner;  ///< of that

  /// Forgets what was built.
  void drop();
};

/// A part of a lazy tree: planes whose leaves are cells, or without cells a
/// tree as any other.
struct LazyPart {
  BspTree tree;
  std::vector<std::int32_t> cell_of_node;  ///< -1 where it is no cell
  std::unique_ptr<LazyCell[]> cells;
  std::size_t cell_count = 0;

  bool has_cells() const { return cell_count > 0; }
};

struct LazyTree::State {
  State(const Scene& scene, const LazyTreeOptions& options);

  /// The part of the cell at a leaf of `part`, which is built if it is not
  /// there. Any thread may ask.
  const LazyPart& part_at(const LazyPart& part, NodeId leaf) const {
    LazyCell& cell = part.cells[static_cast<std::size_t>(
        part.cell_of_node[static_cast<std::size_t>(leaf)])];
    const LazyPart* built = cell.part.load(std::memory_order_acquire);
    return built != nullptr ? *built : build(cell);
  }
  const LazyPart& build(LazyCell& cell) const;
  void move_to(const Scene& next, std::span<const PolygonId> polygons);

  const Scene* scene;
  LazyTreeOptions options;
  mutable std::optional<BuildState> build_state;
  LazyPart root;

 private:
  LazyPart made(LazyCell& cell) const;
  LazyPart parts_of(DividedCells divided, int depth) const;
};

}  // namespace halfspace::fast
