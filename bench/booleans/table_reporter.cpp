#include "booleans/table_reporter.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "papers/table.hpp"

namespace halfspace::bench {

TableReporter::Row TableReporter::row_of(const Run& run) {
  // A suffix says how it was run: "/iterations:1/manual_time".
  const std::string& name = run.run_name.function_name;
  const std::size_t slash = name.find('/');
  Row row;
  row.task = name.substr(0, slash);
  row.who = name.substr(slash + 1);
  if (run.error_occurred) {
    row.error = run.error_message;
    return row;
  }
  row.total_ms = run.GetAdjustedRealTime();
  for (const char* part : {"import", "booleans", "output"})
    row.parts.push_back(run.counters.at(part));
  row.triangles = run.counters.at("triangles");
  return row;
}

void TableReporter::ReportRuns(const std::vector<Run>& repetitions) {
  std::vector<Row> rows;
  for (const Run& run : repetitions) {
    if (run.run_type == Run::RT_Iteration) rows.push_back(row_of(run));
  }
  if (rows.empty()) return;
  // One failed repetition makes the row a failure.
  rows_.push_back(*std::min_element(
      rows.begin(), rows.end(), [](const Row& a, const Row& b) {
        return a.error.empty() != b.error.empty() ? !a.error.empty()
                                                  : a.total_ms < b.total_ms;
      }));
  GetErrorStream() << rows_.back().task << ": " << rows_.back().who << '\n';
}

void TableReporter::Finalize() {
  Table table{{"case", "who", "import", "booleans", "output", "all",
               "times ours", "triangles"},
              {}};
  for (const Row& row : rows_) {
    if (!row.error.empty()) {
      table.rows.push_back(
          {row.task, row.who, "-", "-", "-", "-", row.error, "-"});
      continue;
    }
    const auto first =
        std::find_if(rows_.begin(), rows_.end(),
                     [&](const Row& other) { return other.task == row.task; });
    std::vector<std::string> cells{row.task, row.who};
    for (const double part : row.parts) cells.push_back(digits(part));
    cells.push_back(digits(row.total_ms));
    cells.push_back(
        first->error.empty() ? digits(row.total_ms / first->total_ms) : "-");
    cells.push_back(std::to_string(static_cast<std::size_t>(row.triangles)));
    table.rows.push_back(cells);
  }
  GetOutputStream()
      << "Processor time in ms, one thread, least of all runs.\n\n"
      << to_markdown(table);
  print_means();
}

void TableReporter::print_means() {
  using Times = std::map<std::string, double>;  // by case
  std::map<std::string, Times> ours, others;
  for (const Row& row : rows_) {
    if (!row.error.empty()) continue;
    const bool is_ours = row.who.rfind("Halfspace", 0) == 0;
    (is_ours ? ours : others)[row.who][row.task] = row.total_ms;
  }
  if (others.empty()) return;
  Table table{{"ours", "other", "cases", "mean ratio", "least", "of"}, {}};
  for (const auto& [mine, my_times] : ours) {
    for (const auto& [other, its_times] : others) {
      std::size_t cases = 0;
      double sum = 0, least = 0;
      std::string of;
      for (const auto& [task, time] : my_times) {
        const auto its = its_times.find(task);
        if (its == its_times.end()) continue;
        const double ratio = its->second / time;
        sum += std::log(ratio);
        if (cases++ != 0 && ratio >= least) continue;
        least = ratio;
        of = task;
      }
      if (cases == 0) continue;
      table.rows.push_back({mine, other, std::to_string(cases),
                            digits(std::exp(sum / static_cast<double>(cases))),
                            digits(least), of});
    }
  }
  GetOutputStream() << "\nTheir time over ours, geometric means.\n\n"
                    << to_markdown(table);
}

}  // namespace halfspace::bench
