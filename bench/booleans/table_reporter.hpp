#pragma once

#include <benchmark/benchmark.h>

#include <string>
#include <vector>

namespace halfspace::bench {

/// Prints one Markdown table at the end: a row for each benchmark, named
/// "case/who", with its fastest repetition and the ratio to the first benchmark
/// of the same case. The counters `import`, `booleans`, `output` (Units: ms)
/// and `triangles` are columns. A second table has, by each of ours and each of
/// the others, in how many cases both were right, the geometric mean of the
/// other's time over ours, and the least ratio.
class TableReporter : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context&) override { return true; }
  void ReportRuns(const std::vector<Run>& repetitions) override;
  void Finalize() override;

 private:
  struct Row {
    std::string task;
    std::string who;
    /// Empty unless some repetition failed.
    std::string error;
    double total_ms = 0;
    std::vector<double> parts;
    double triangles = 0;
  };
  static Row row_of(const Run& run);
  void print_means();

  std::vector<Row> rows_;
};

}  // namespace halfspace::bench
