#include "tree/leaf_packets.hpp"

#include <cmath>
#include <limits>

#include "base/threads.hpp"
#include "base/tsan.hpp"
#include "box/box.hpp"
#include "tree/tree_reader.hpp"

namespace halfspace::fast {
namespace {

constexpr std::int32_t kEach = 8;

/// A shorter run is drawn faster one by one. Untuned.
constexpr std::int32_t kShortestRun = 4;

/// The runs at the beginning of a node's list that are long enough.
struct Runs {
  std::int32_t triangles = 0;
  std::int32_t quadrangles = 0;
};

Runs runs_of(const BspTree& tree, const Node& node) {
  Runs runs;
  if (node.splitter != kNoPlane) return runs;
  std::int32_t expected = node.first_fragment;
  for (std::int32_t f = expected; f != kNoFragment && f == expected;) {
    const TreeFragment& fragment = tree.fragments[static_cast<std::size_t>(f)];
    if (fragment.corner_count == 3 && runs.quadrangles == 0) {
      ++runs.triangles;
    } else if (fragment.corner_count == 4) {
      ++runs.quadrangles;
    } else {
      break;
    }
    ++expected;
    f = fragment.next;
  }
  if (runs.triangles > 0 && runs.triangles < kShortestRun) return {};
  if (runs.quadrangles < kShortestRun) runs.quadrangles = 0;
  return runs;
}

constexpr std::int32_t blocks_for(std::int32_t count) {
  return (count + kEach - 1) / kEach;
}

/// Copies fragments into blocks.
class BlockMaker {
 public:
  explicit BlockMaker(const TreeReader& reader) : reader_(reader) {}

  template <std::size_t kCorners>
  void fill(std::vector<FragmentBlock<kCorners>>& blocks, std::int32_t at,
            std::int32_t first, std::int32_t count) const {
    for (; count > 0; count -= kEach, first += kEach) {
      blocks[static_cast<std::size_t>(at++)] =
          block_of<kCorners>(first, std::min(count, kEach));
    }
  }

 private:
  template <std::size_t kCorners>
  FragmentBlock<kCorners> block_of(std::int32_t first,
                                   std::int32_t count) const {
    FragmentBlock<kCorners> block;
    block.first_fragment = first;
    block.count = count;
    std::array<std::array<Vertex, kCorners>, kEach> corners;
    std::array<double, 3> low;
    low.fill(std::numeric_limits<double>::max());
    for (std::int32_t k = 0; k < count; ++k) {
      const TreeFragment& fragment =
          reader_.tree().fragments[static_cast<std::size_t>(first + k)];
      std::size_t c = 0;
      for (const Corner& corner : reader_.corners(fragment)) {
        Vertex& v = corners[static_cast<std::size_t>(k)][c++];
        v = reader_.vertex(corner.vertex);
        low = {std::min(low[0], v.x), std::min(low[1], v.y),
               std::min(low[2], v.z)};
      }
    }
    for (std::size_t a = 0; a < 3; ++a) {
      block.origin[a] = std::floor(rounded_down(low[a]));
    }
    for (std::size_t k = 0; k < kEach; ++k) {
      // Lanes without a fragment repeat the first.
      const auto& from = corners[k < static_cast<std::size_t>(count) ? k : 0];
      double error = 0;
      for (std::size_t c = 0; c < kCorners; ++c) {
        const Vertex& v = from[c];
        double off = v.error;
        off += put(block.x[c][k], v.x, block.origin[0]);
        off += put(block.y[c][k], v.y, block.origin[1]);
        off += put(block.z[c][k], v.z, block.origin[2]);
        error = std::max(error, off);
      }
      block.error[k] = error == 0 ? 0 : rounded_up(error);
      if (error == 0 && k < static_cast<std::size_t>(count) &&
          is_whole(first + static_cast<std::int32_t>(k))) {
        block.whole |= 1u << k;
      }
    }
    return block;
  }

  bool is_whole(std::int32_t f) const {
    const TreeFragment& fragment =
        reader_.tree().fragments[static_cast<std::size_t>(f)];
    EdgeCode expected = 0;
    for (const Corner& corner : reader_.corners(fragment)) {
      if (corner.edge != expected++) return false;
    }
    return reader_.scene().corners(fragment.source).size() ==
           fragment.corner_count;
  }

  /// Writes v - origin. Returns the error of the sum of both.
  static double put(float& to, double v, float origin) {
    to = static_cast<float>(v - double{origin});
    const double again = double{to} + double{origin};
    return again == v ? 0 : std::abs(again - v) * (1 + 0x1p-50);
  }

  const TreeReader& reader_;
};

}  // namespace

void add_blocks(BspTree& tree, const Scene& scene, int threads) {
  FirstBlocks end;
  std::vector<FirstBlocks> first_blocks = {end};
  for (const Node& node : tree.nodes) {
    const Runs runs = runs_of(tree, node);
    end.triangles += blocks_for(runs.triangles);
    end.quadrangles += blocks_for(runs.quadrangles);
    first_blocks.push_back(end);
  }
  tree.triangles.resize(static_cast<std::size_t>(end.triangles));
  tree.quadrangles.resize(static_cast<std::size_t>(end.quadrangles));
  tree.first_blocks = std::move(first_blocks);
  const TreeReader reader(scene, tree);
  const BlockMaker maker(reader);
  const auto fill = [&](std::size_t n) {
    const FirstBlocks& at = tree.first_blocks[n];
    if (at == tree.first_blocks[n + 1]) return;
    const Node& node = tree.nodes[n];
    const Runs runs = runs_of(tree, node);
    maker.fill(tree.triangles, at.triangles, node.first_fragment,
               runs.triangles);
    maker.fill(tree.quadrangles, at.quadrangles,
               node.first_fragment + runs.triangles, runs.quadrangles);
  };
  if (threads == 1) {
    for (std::size_t n = 0; n < tree.nodes.size(); ++n) fill(n);
    return;
  }
  const TsanForkJoin shared;
  threads::for_each_index(
      tree.nodes.size(), [&](std::size_t n) { shared.task([&] { fill(n); }); });
}

}  // namespace halfspace::fast
