#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "papers/chart.hpp"
#include "papers/table.hpp"

namespace halfspace::bench {

/// A chart and the stem of its file's name.
struct Figure {
  std::string name;
  Chart chart;
};

/// One experiment of a paper, done again.
struct Report {
  std::string name;   ///< the stem of its file's name
  std::string title;  ///< which figure or table of which paper
  Table table;        ///< one row a measurement, the paper's number beside
  std::vector<Figure> figures;
};

/// How much of it is done.
struct Effort {
  std::uint64_t seed = 1;
  std::size_t trees = 11;  ///< of which the median, least and greatest count
  std::int32_t size_px = 1500;
  std::int64_t most_parallel = 100'000;      ///< of F2B fig. 15 and 16
  std::vector<std::filesystem::path> scans;  ///< mesh files, as models too
};

}  // namespace halfspace::bench
