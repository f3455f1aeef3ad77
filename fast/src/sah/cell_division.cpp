#include "sah/cell_division.hpp"

#include <algorithm>
#include <atomic>
#include <bit>
#include <utility>

#include "base/parallel.hpp"
#include "box/box.hpp"
#include "halfspace/assert.hpp"
#include "sah/primitive.hpp"
#include "tree/scene_planes.hpp"

namespace halfspace::fast {
namespace {

/// Polygons that a thread reads at a time. Untuned.
constexpr std::size_t kListBlock = 16384;

/// A bin is divided into up to 2^8 steps for the boxes of cells, so that codes
/// of 64 bins have 15 bits.
constexpr int kStepBits = 8;

/// Nodes on a way down: each takes a bin at least, of 64 along an axis.
constexpr std::size_t kMostDepth = std::size_t{3} * 64;

/// In so few bins cells are looked for bin by bin; untuned.
constexpr std::int64_t kBinsApart = 16;

std::array<std::int64_t, 3> coordinates(const GridPoint& p) {
  return {p.x, p.y, p.z};
}

/// A box in codes, from the least to the greatest: 2 q on a step's border, 2 q
/// + 1 within the step after it. Codes keep the order of coordinates, and tell
/// which are on a border.
struct CodeRange {
  std::array<std::uint16_t, 3> low;
  std::array<std::uint16_t, 3> high;
};

/// Bins `first` up to but not including `end` along each axis.
struct BinBox {
  std::array<std::int32_t, 3> first{};
  std::array<std::int32_t, 3> end{};
};

/// A grid of 2^bits bins along each axis over a box. A bin's size is a power of
/// two, so all borders are integers.
class BinGrid {
 public:
  BinGrid(const GridRange& range, int bits) : range_(range), bits_(bits) {
    for (std::size_t a = 0; a < 3; ++a) {
      const auto size =
          static_cast<std::uint64_t>(range.high[a] - range.low[a]);
      bin_bits_[a] = std::max(0, static_cast<int>(std::bit_width(size)) - bits);
      step_bits_[a] = std::min(bin_bits_[a], kStepBits);
    }
  }

  std::int32_t width() const { return 1 << bits_; }
  std::size_t bin_count() const { return std::size_t{1} << (3 * bits_); }
  BinBox all() const { return {{0, 0, 0}, {width(), width(), width()}}; }
  std::size_t index(std::int32_t x, std::int32_t y, std::int32_t z) const {
    return static_cast<std::size_t>((((z << bits_) | y) << bits_) | x);
  }

  /// What is beyond the range counts as on its faces.
  CodeRange codes(const GridRange& box) const {
    CodeRange result;
    for (std::size_t a = 0; a < 3; ++a) {
      result.low[a] = code(a, box.low[a]);
      result.high[a] = code(a, box.high[a]);
    }
    return result;
  }

  /// The bins that a box reaches: one that ends at a border stays below it, and
  /// one in a border is above it, as CellRegion says.
  BinBox bins(const CodeRange& box) const {
    BinBox result;
    for (std::size_t a = 0; a < 3; ++a) {
      const std::int32_t low = box.low[a];
      const std::int32_t high = box.high[a];
      result.first[a] = low >> shift(a);
      result.end[a] = (std::max(low, high - 1) >> shift(a)) + 1;
    }
    return result;
  }
  /// That of its middle, one of those.
  std::size_t middle_bin(const CodeRange& box) const {
    const auto at = [&](std::size_t a) {
      return ((std::int32_t{box.low[a]} + box.high[a]) >> 1) >> shift(a);
    };
    return index(at(0), at(1), at(2));
  }

  std::int64_t border(std::size_t axis, std::int32_t bin) const {
    return range_.low[axis] + (std::int64_t{bin} << bin_bits_[axis]);
  }
  /// Coordinates that hold what has these codes.
  std::int64_t low_of(std::size_t axis, std::int32_t code) const {
    return range_.low[axis] +
           (std::int64_t{code >> 1} << (bin_bits_[axis] - step_bits_[axis]));
  }
  std::int64_t high_of(std::size_t axis, std::int32_t code) const {
    return std::min(range_.high[axis], low_of(axis, code + 1));
  }
  double bin_size(std::size_t axis) const {
    return static_cast<double>(std::int64_t{1} << bin_bits_[axis]);
  }

 private:
  int shift(std::size_t axis) const { return step_bits_[axis] + 1; }
  std::uint16_t code(std::size_t axis, std::int64_t coordinate) const {
    const std::int64_t away =
        std::clamp(coordinate, range_.low[axis], range_.high[axis]) -
        range_.low[axis];
    const int bits = bin_bits_[axis] - step_bits_[axis];
    const std::int64_t step = away >> bits;
    const bool within = (step << bits) != away;
    return static_cast<std::uint16_t>(2 * step + (within ? 1 : 0));
  }

  GridRange range_;
  int bits_;
  std::array<int, 3> bin_bits_{};   ///< of a bin's size
  std::array<int, 3> step_bits_{};  ///< of its number of steps
};

/// A node of the division: a border, or a cell.
struct Division {
  std::size_t axis = 0;
  std::int32_t border = 0;
  std::int32_t positive = -1;
  std::int32_t negative = -1;
  std::int32_t cell = -1;
  BinBox box;
};

/// Divides the bins into boxes.
class BinDivider {
 public:
  BinDivider(const BinGrid& grid, const std::vector<std::uint32_t>& counts,
             std::size_t cell_size)
      : grid_(grid), counts_(counts), cell_size_(cell_size) {}

  /// Nodes come before their children.
  std::vector<Division> divide() {
    std::vector<Division> nodes(1);
    nodes[0].box = grid_.all();
    std::int32_t cells = 0;
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      const BinBox box = nodes[n].box;
      const auto [axis, border] = best_border(box);
      if (border < 0) {
        nodes[n].cell = cells++;
        continue;
      }
      Division positive;
      Division negative;
      positive.box = negative.box = box;
      positive.box.first[axis] = negative.box.end[axis] = border;
      nodes[n].axis = axis;
      nodes[n].border = border;
      nodes[n].positive = static_cast<std::int32_t>(nodes.size());
      nodes[n].negative = nodes[n].positive + 1;
      nodes.push_back(positive);
      nodes.push_back(negative);
    }
    return nodes;
  }

 private:
  /// The border of least cost by the surface area heuristic, both sides of
  /// which have polygons; -1 where there are few, or none does.
  std::pair<std::size_t, std::int32_t> best_border(const BinBox& box) {
    const std::size_t total = count(box);
    std::pair<std::size_t, std::int32_t> best = {0, -1};
    if (total <= cell_size_) return best;
    std::array<double, 3> size{};
    BinBox filled = box;
    for (std::size_t a = 0; a < 3; ++a) {
      const auto& sums = sums_[a];
      while (sums[at(filled.first[a])] == 0) ++filled.first[a];
      while (sums[at(filled.end[a] - 1)] == 0) --filled.end[a];
      size[a] = (filled.end[a] - filled.first[a]) * grid_.bin_size(a);
    }
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t a = 0; a < 3; ++a) {
      const double y = size[(a + 1) % 3];
      const double z = size[(a + 2) % 3];
      std::size_t below = 0;
      for (std::int32_t b = filled.first[a] + 1; b < filled.end[a]; ++b) {
        below += sums_[a][at(b - 1)];
        const double x = (b - filled.first[a]) * grid_.bin_size(a);
        const double cost = static_cast<double>(below) * half_surface(x, y, z) +
                            static_cast<double>(total - below) *
                                half_surface(size[a] - x, y, z);
        if (cost < least) {
          least = cost;
          best = {a, b};
        }
      }
    }
    return best;
  }

  /// Counts the polygons of a box, by its bins along each axis.
  std::size_t count(const BinBox& box) {
    for (auto& sums : sums_) sums.fill(0);
    std::size_t total = 0;
    for (std::int32_t z = box.first[2]; z < box.end[2]; ++z) {
      std::uint32_t of_z = 0;
      for (std::int32_t y = box.first[1]; y < box.end[1]; ++y) {
        const std::uint32_t* row = counts_.data() + grid_.index(0, y, z);
        std::uint32_t of_y = 0;
        for (std::int32_t x = box.first[0]; x < box.end[0]; ++x) {
          sums_[0][at(x)] += row[x];
          of_y += row[x];
        }
        sums_[1][at(y)] += of_y;
        of_z += of_y;
      }
      sums_[2][at(z)] += of_z;
      total += of_z;
    }
    return total;
  }
  static std::size_t at(std::int32_t bin) {
    return static_cast<std::size_t>(bin);
  }

  const BinGrid& grid_;
  const std::vector<std::uint32_t>& counts_;
  std::size_t cell_size_;
  std::array<std::array<std::uint32_t, 64>, 3> sums_{};
};

/// Bins along an axis, by the length of the list: of some ten polygons on
/// surfaces.
int bits_for(std::size_t count) {
  return count < 4096 ? 4 : count < 65536 ? 5 : 6;
}

/// Names the polygons of the cells.
class CellFiller {
 public:
  CellFiller(const CellList& list, const BinGrid& grid,
             const std::vector<CodeRange>& codes,
             const std::vector<Division>& nodes, std::size_t most_named,
             int threads)
      : list_(list),
        grid_(grid),
        codes_(codes),
        nodes_(nodes),
        most_named_(most_named),
        threads_(threads),
        cell_count_(nodes.size() / 2 + 1),
        cell_of_bin_(grid.bin_count()) {
    for (const Division& node : nodes) {
      if (node.cell < 0) continue;
      for_bins(node.box,
               [&](std::size_t bin) { cell_of_bin_[bin] = node.cell; });
    }
  }

  std::size_t cell_count() const { return cell_count_; }

  /// Counts what each block names of each cell; false where that is too much.
  bool count() {
    const std::size_t blocks = (codes_.size() + kListBlock - 1) / kListBlock;
    counts_.assign(blocks * cell_count_, 0);
    std::atomic<std::size_t> named = 0;
    for_blocks(threads_, codes_.size(), kListBlock,
               [&](std::size_t block, std::size_t first, std::size_t end) {
                 std::uint32_t* counts = counts_.data() + block * cell_count_;
                 std::size_t own = 0;
                 for (std::size_t k = first; k < end && own <= most_named_;
                      ++k) {
                   for_cells(codes_[k], [&](std::int32_t cell) {
                     ++counts[cell];
                     ++own;
                   });
                 }
                 named += own;
               });
    return named <= most_named_;
  }

  void fill(std::vector<CellList>& cells) {
    const std::size_t blocks = counts_.size() / cell_count_;
    for (std::size_t c = 0; c < cell_count_; ++c) {
      std::uint32_t sum = 0;
      for (std::size_t b = 0; b < blocks; ++b)
        sum += std::exchange(counts_[b * cell_count_ + c], sum);
      cells[c].polygons.resize(sum);
    }
    for_blocks(
        threads_, codes_.size(), kListBlock,
        [&](std::size_t block, std::size_t first, std::size_t end) {
          std::uint32_t* next = counts_.data() + block * cell_count_;
          for (std::size_t k = first; k < end; ++k) {
            for_cells(codes_[k], [&](std::int32_t cell) {
              cells[static_cast<std::size_t>(cell)].polygons[next[cell]++] =
                  static_cast<PolygonId>(k);
            });
          }
        });
    std::vector<const Division*> leaves(cell_count_);
    for (const Division& node : nodes_) {
      if (node.cell >= 0) leaves[static_cast<std::size_t>(node.cell)] = &node;
    }
    for_blocks(threads_, cell_count_, 64,
               [&](std::size_t, std::size_t first, std::size_t end) {
                 for (std::size_t c = first; c < end; ++c)
                   finish(cells[c], leaves[c]->box);
               });
  }

 private:
  /// Calls show(cell) for the cells that a box reaches.
  template <class Show>
  void for_cells(const CodeRange& box, Show&& show) const {
    const BinBox bins = grid_.bins(box);
    const std::int32_t first =
        cell_of_bin_[grid_.index(bins.first[0], bins.first[1], bins.first[2])];
    // Cells are boxes: what has both ends of a diagonal has all.
    if (first == cell_of_bin_[grid_.index(bins.end[0] - 1, bins.end[1] - 1,
                                          bins.end[2] - 1)]) {
      show(first);
      return;
    }
    if (volume(bins) <= kBinsApart) {
      std::array<std::int32_t, kBinsApart> found;
      std::size_t count = 0;
      for_bins(bins, [&](std::size_t bin) {
        const std::int32_t cell = cell_of_bin_[bin];
        std::size_t k = 0;
        while (k < count && found[k] != cell) ++k;
        if (k < count) return;
        found[count++] = cell;
        show(cell);
      });
      return;
    }
    std::array<std::int32_t, kMostDepth> left;
    std::size_t count = 0;
    left[count++] = 0;
    while (count > 0) {
      const Division& node = nodes_[static_cast<std::size_t>(left[--count])];
      if (node.cell >= 0) {
        show(node.cell);
        continue;
      }
      if (bins.first[node.axis] < node.border) left[count++] = node.negative;
      if (bins.end[node.axis] > node.border) left[count++] = node.positive;
    }
  }

  static std::int64_t volume(const BinBox& box) {
    std::int64_t volume = 1;
    for (std::size_t a = 0; a < 3; ++a) volume *= box.end[a] - box.first[a];
    return volume;
  }
  template <class Show>
  void for_bins(const BinBox& box, Show&& show) const {
    for (std::int32_t z = box.first[2]; z < box.end[2]; ++z)
      for (std::int32_t y = box.first[1]; y < box.end[1]; ++y)
        for (std::int32_t x = box.first[0]; x < box.end[0]; ++x)
          show(grid_.index(x, y, z));
  }

  /// Finds the box of a cell's polygons, within the cell, and gives them ids.
  void finish(CellList& cell, const BinBox& box) const {
    std::array<std::int32_t, 3> low;
    std::array<std::int32_t, 3> high;
    low.fill(std::numeric_limits<std::int32_t>::max());
    high.fill(0);
    for (PolygonId& polygon : cell.polygons) {
      const auto k = static_cast<std::size_t>(polygon);
      const CodeRange& codes = codes_[k];
      for (std::size_t a = 0; a < 3; ++a) {
        low[a] = std::min<std::int32_t>(low[a], codes.low[a]);
        high[a] = std::max<std::int32_t>(high[a], codes.high[a]);
      }
      if (!list_.polygons.empty()) polygon = list_.polygons[k];
    }
    for (std::size_t a = 0; a < 3; ++a) {
      cell.range.low[a] =
          std::max(grid_.low_of(a, low[a]), grid_.border(a, box.first[a]));
      cell.range.high[a] =
          std::min(grid_.high_of(a, high[a]), grid_.border(a, box.end[a]));
    }
  }

  const CellList& list_;
  const BinGrid& grid_;
  const std::vector<CodeRange>& codes_;
  const std::vector<Division>& nodes_;
  std::size_t most_named_;
  int threads_;
  std::size_t cell_count_;
  std::vector<std::int32_t> cell_of_bin_;
  std::vector<std::uint32_t> counts_;  ///< by block, then cell
};

/// The division as a tree. A division's region is that of the planes above it.
class TreeMaker {
 public:
  TreeMaker(const Scene& scene, const CellList& list, const BinGrid& grid,
            const std::vector<Division>& nodes)
      : scene_(scene), list_(list), grid_(grid), nodes_(nodes) {}

  void set_regions(std::vector<CellList>& cells) const {
    std::vector<CellRegion> regions(nodes_.size());
    regions[0] = list_.region;
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
      const Division& node = nodes_[n];
      if (node.cell >= 0) {
        cells[static_cast<std::size_t>(node.cell)].region = regions[n];
        continue;
      }
      const std::int64_t border = grid_.border(node.axis, node.border);
      CellRegion& positive = regions[static_cast<std::size_t>(node.positive)];
      CellRegion& negative = regions[static_cast<std::size_t>(node.negative)];
      positive = negative = regions[n];
      positive.low[node.axis] = negative.high[node.axis] = border;
    }
  }

  BspTree tree(const std::vector<CellList>& cells) const {
    BspTree tree;
    tree.nodes.resize(nodes_.size());
    tree.boxes.assign(nodes_.size(), kEmptyBox);
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
      const Division& from = nodes_[n];
      if (from.cell >= 0) continue;
      Node& node = tree.nodes[n];
      node.splitter = static_cast<PlaneId>(scene_.polygon_count() +
                                           tree.free_planes.size());
      tree.free_planes.push_back({static_cast<std::int32_t>(from.axis),
                                  grid_.border(from.axis, from.border)});
      node.plane = ScenePlanes(scene_, tree).plane(node.splitter);
      node.positive = from.positive;
      node.negative = from.negative;
    }
    // Children come after their parents.
    for (std::size_t n = nodes_.size(); n-- > 0;) {
      Box& box = tree.boxes[n];
      if (nodes_[n].cell >= 0) {
        box = box_of(cells[static_cast<std::size_t>(nodes_[n].cell)].range);
        continue;
      }
      for (const NodeId child : {nodes_[n].positive, nodes_[n].negative}) {
        const Box& part = tree.boxes[static_cast<std::size_t>(child)];
        for (std::size_t a = 0; a < 3; ++a) {
          box.low[a] = std::min(box.low[a], part.low[a]);
          box.high[a] = std::max(box.high[a], part.high[a]);
        }
      }
    }
    return tree;
  }

 private:
  const Scene& scene_;
  const CellList& list_;
  const BinGrid& grid_;
  const std::vector<Division>& nodes_;
};

}  // namespace

GridRange range_of(const Scene& scene, PolygonId polygon) {
  GridRange range;
  const auto corners = scene.corners(polygon);
  range.low = range.high = coordinates(scene.point(corners[0]));
  for (const VertexId v : corners.subspan(1)) {
    const auto p = coordinates(scene.point(v));
    for (std::size_t a = 0; a < 3; ++a) {
      range.low[a] = std::min(range.low[a], p[a]);
      range.high[a] = std::max(range.high[a], p[a]);
    }
  }
  return range;
}

/// Coordinates have 54 bits at most, which doubles hold.
Box box_of(const GridRange& range) {
  Box box;
  for (std::size_t a = 0; a < 3; ++a) {
    box.low[a] = float_below(static_cast<double>(range.low[a]));
    box.high[a] = float_above(static_cast<double>(range.high[a]));
  }
  return box;
}

std::optional<DividedCells> divide_into_cells(const Scene& scene,
                                              const CellList& list,
                                              std::size_t cell_size,
                                              std::size_t most_named,
                                              int threads) {
  HALFSPACE_ASSERT(cell_size >= 1);
  const bool all = list.polygons.empty();
  const std::size_t count = all ? scene.polygon_count() : list.polygons.size();
  if (count <= cell_size) return std::nullopt;

  // Step 1: the box of each polygon, and where its middle is.
  const BinGrid grid(list.range, bits_for(count));
  std::vector<CodeRange> codes(count);
  for_blocks(threads, count, kListBlock,
             [&](std::size_t, std::size_t first, std::size_t end) {
               for (std::size_t k = first; k < end; ++k) {
                 codes[k] =
                     grid.codes(range_of(scene, all ? static_cast<PolygonId>(k)
                                                    : list.polygons[k]));
               }
             });
  std::vector<std::uint32_t> counts(grid.bin_count());
  for (const CodeRange& box : codes) ++counts[grid.middle_bin(box)];

  // Step 2: divide the bins, into fewer cells where polygons reach many.
  for (; cell_size < count; cell_size *= 4) {
    const std::vector<Division> nodes =
        BinDivider(grid, counts, cell_size).divide();
    if (nodes.size() == 1) return std::nullopt;
    CellFiller filler(list, grid, codes, nodes, most_named, threads);
    if (!filler.count()) continue;

    // Step 3: name the polygons of each cell.
    DividedCells result;
    result.cells.resize(filler.cell_count());
    filler.fill(result.cells);
    const TreeMaker maker(scene, list, grid, nodes);
    maker.set_regions(result.cells);
    result.tree = maker.tree(result.cells);
    for (const Division& node : nodes) result.cell_of_node.push_back(node.cell);
    return result;
  }
  return std::nullopt;
}

}  // namespace halfspace::fast
