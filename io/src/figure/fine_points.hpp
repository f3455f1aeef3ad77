#pragma once

#include <cstddef>
#include <functional>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "halfspace/io/figure.hpp"

namespace halfspace::io {

/// The most decimals of a coordinate: a double of a figure has no more.
constexpr int kMostDecimals = 12;

struct FigurePointHash {
  std::size_t operator()(const FigurePoint& p) const {
    const std::hash<double> hash;
    return hash(p[0]) * 0x9E3779B97F4A7C15u + hash(p[1]);
  }
};

/// The points of a figure that need more decimals than others, so that no loop
/// of a region turns over.
struct FinePoints {
  std::unordered_map<FigurePoint, int, FigurePointHash> decimals;
  /// Loops of the figure that no number of decimals keeps from turning over.
  std::unordered_set<const std::vector<FigurePoint>*> left_out;

  int decimals_at(const FigurePoint& p, int usual) const {
    const auto found = decimals.find(p);
    return found == decimals.end() ? usual : found->second;
  }
};

}  // namespace halfspace::io
