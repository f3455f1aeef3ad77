#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

#include "rounding/grid_mesh.hpp"

namespace halfspace::fast {

/// A triangle at one of its edges.
struct MeshEdgeUse {
  std::int32_t high = 0;  ///< the greater end
  std::int32_t triangle = 0;
  bool forward = false;  ///< it goes there
};

/// All uses of edges, those of one edge in a row.
class MeshEdges {
 public:
  explicit MeshEdges(const GridMesh& mesh) {
    first_.resize(mesh.points.size() + 1);
    for_each(mesh, [&](std::int32_t low, const MeshEdgeUse&) {
      ++first_[static_cast<std::size_t>(low) + 1];
    });
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    uses_.resize(first_.back());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for_each(mesh, [&](std::int32_t low, const MeshEdgeUse& use) {
      uses_[next[static_cast<std::size_t>(low)]++] = use;
    });
    for (std::size_t p = 0; p + 1 < first_.size(); ++p) {
      std::sort(uses_.begin() + first_[p], uses_.begin() + first_[p + 1],
                [](const MeshEdgeUse& x, const MeshEdgeUse& y) {
                  return x.high != y.high ? x.high < y.high
                                          : x.triangle < y.triangle;
                });
    }
  }

  /// Calls `found(low, first use, use after the last)` for each edge.
  template <class Found>
  void for_edges(Found&& found) const {
    for (std::size_t p = 0; p + 1 < first_.size(); ++p) {
      for (std::size_t i = first_[p]; i < first_[p + 1];) {
        std::size_t end = i + 1;
        while (end < first_[p + 1] && uses_[end].high == uses_[i].high) ++end;
        found(static_cast<std::int32_t>(p), uses_.data() + i,
              uses_.data() + end);
        i = end;
      }
    }
  }

 private:
  template <class Found>
  static void for_each(const GridMesh& mesh, Found&& found) {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto& c = mesh.triangles[t].corners;
      for (std::size_t i = 0; i < 3; ++i) {
        const std::int32_t from = c[i], to = c[(i + 1) % 3];
        found(std::min(from, to),
              MeshEdgeUse{std::max(from, to), static_cast<std::int32_t>(t),
                          from < to});
      }
    }
  }

  std::vector<std::uint32_t> first_;
  std::vector<MeshEdgeUse> uses_;
};

}  // namespace halfspace::fast
