#pragma once

#include <optional>
#include <string>
#include <vector>

#include "papers/table.hpp"
#include "peers/row.hpp"

namespace halfspace::bench {

/// An aim: the number wanted, and the number measured.
struct Aim {
  int number;        ///< the aim it belongs to, 1 to 8
  std::string what;  ///< for example "W2 S500 N100000: llvmpipe z / ours"
  bool at_least;     ///< or at most
  double wanted;
  double got;
  bool reached() const { return at_least ? got >= wanted : got <= wanted; }
};

/// The eight aims of docs/performance.md, those that the rows have data for.
std::vector<Aim> aims_of(const std::vector<Row>& rows);

/// Costs of all programs, a row a workload. Units: ms.
Table cost_table(const std::vector<Row>& rows);

/// How many times longer the peers take than the fast library.
Table ratio_table(const std::vector<Row>& rows);

/// What a frame took: fragments displayed for each polygon seen, and exact
/// decisions for each pixel.
Table work_table(const std::vector<Row>& rows);

/// Trees: size, growth, memory, build time against Embree's.
Table tree_table(const std::vector<Row>& rows);

Table aim_table(const std::vector<Aim>& aims);

}  // namespace halfspace::bench
