#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "ours.hpp"
#include "peers/measure.hpp"
#include "timing.hpp"
#include "workloads.hpp"

namespace halfspace::bench {

/// The fast library's costs for a workload. Units: ms of processor time in one
/// thread, except the two elapsed times.
struct OurCosts {
  double flat = 0;
  double smooth = 0;
  std::optional<double> painter_flat;  ///< back to front, a tree by rule
  std::optional<double> painter_smooth;
  double flat_share = 0;    ///< exact decisions over pixels
  double smooth_share = 0;  ///< the same
  std::size_t fragments_displayed = 0;
  std::size_t tiles_touched = 0;
  double elapsed_one = 0;  ///< flat, by the wall
  double elapsed_two = 0;  ///< the same with two threads
  double build = 0;
  std::size_t build_peak_bytes = 0;  ///< of the whole process
  std::size_t tree_bytes = 0;
  TreeStats stats;
};

/// The measurements to make.
struct Plan {
  View view = View::kFront;
  std::int32_t size_px = 1500;
  Repeats repeats;
  fast::SimdLevel simd = fast::SimdLevel::kBest;
  bool peers = true;          ///< else the fast library alone
  bool back_to_front = true;  ///< the fast library's painter, too
};

/// One workload, measured.
struct Row {
  std::string name;
  std::size_t polygons = 0;
  double overdraw = 0;
  std::size_t visible = 0;  ///< polygons that are seen somewhere
  OurCosts ours;
  PeerCosts peers;
  std::vector<WrongPicture> wrong_pictures;
};

/// Measures the workload with all programs, and checks every picture: those of
/// two threads and of the painter must be identical, the peers' nearly so.
Row measure_row(const Workload& workload, const Scene& scene, const Plan& plan);

}  // namespace halfspace::bench
