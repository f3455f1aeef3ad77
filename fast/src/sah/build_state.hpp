#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cmath>

#include "halfspace/fast/display_tree.hpp"
#include "halfspace/threads.hpp"
#include "sah/cell_division.hpp"
#include "sah/cell_tree.hpp"
#include "sah/primitive.hpp"

namespace halfspace::fast {

/// This many cuts are always allowed in a tree: they take some megabytes.
constexpr double kFreeCuts = 100'000;

inline std::array<double, 3> to_doubles(const GridPoint& p) {
  return {static_cast<double>(p.x), static_cast<double>(p.y),
          static_cast<double>(p.z)};
}

/// The state that all threads of one build share.
class BuildState {
 public:
  BuildState(const Scene& scene, const DisplayTreeOptions& options,
             KeptCells* cells = nullptr);
  /// In the frame of another state, whose options it has.
  BuildState(const Scene& scene, const BuildState& frame);

  /// The whole polygon as a primitive.
  Primitive primitive_of(PolygonId polygon) const;

  /// Adds to the share of the work that is done, and reports it.
  void add_done(double share);
  bool is_stopped() const { return stopped_.load(std::memory_order_relaxed); }

  const Scene& scene;
  const DisplayTreeOptions& options;
  KeptCells* cells;  ///< boxes that no splitter cuts, or null
  GridRange range;   ///< of the scene's vertices
  GridPoint origin;  ///< of the primitives' frame: the middle of the scene
  /// Bounds the sizes of the coordinates of vertices and of free planes: all of
  /// the grid, where polygons may have moved.
  double most = std::ldexp(1.0, scene.grid_bits() - 1);
  /// The area of the scene's box as seen from a random direction, on average;
  /// above 0. Units: squares of grid steps.
  double scene_size = 1;

 private:
  Mutex mutex_;
  double done_ = 0;
  double reported_ = 0;
  std::chrono::steady_clock::time_point reported_at_;
  std::atomic<bool> stopped_ = false;
};

}  // namespace halfspace::fast
