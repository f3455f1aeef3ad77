#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <memory_resource>
#include <string>

#include "booleans/contestant.hpp"
#include "booleans/table_reporter.hpp"
#include "halfspace/fast/huge_page_pool.hpp"

/// Measures booleans of solids: ours and those of other libraries.
namespace halfspace::bench {
namespace {

std::vector<Contestant> contestants() {
  std::vector<Contestant> all{ours_in_turn(), ours_at_once()};
#ifdef HALFSPACE_BENCH_CGAL
  all.push_back(cgal());
  all.push_back(cgal_nef());
#endif
  return all;
}

bool is_ours(const Contestant& contestant) {
  return contestant.name.rfind("Halfspace", 0) == 0;
}

/// The fault of an outcome, or null. Its surface must be closed and have the
/// least number of triangles where that is known. Volumes must agree up to the
/// rounding of doubles.
const char* fault_of(const BooleanCase& task, const Contestant& contestant,
                     const Outcome& outcome) {
  static std::map<std::string, double> volumes;
  const double volume6 =
      volumes.emplace(task.name, outcome.volume6).first->second;
  if (!outcome.closed) return "wrong: not closed";
  if (is_ours(contestant) && task.least != 0 && outcome.triangles != task.least)
    return "wrong: not the least triangles";
  if (std::abs(outcome.volume6 - volume6) > 1e-9 * volume6)
    return "wrong: another volume than the first one's";
  return nullptr;
}

void measure(benchmark::State& state, const BooleanCase& task,
             const Contestant& contestant, bool& good) {
  for ([[maybe_unused]] auto iteration : state) {
    const std::optional<Outcome> outcome = contestant.run(task);
    const char* fault =
        outcome ? fault_of(task, contestant, *outcome) : "refused";
    // Other libraries may refuse or be wrong; the table says so.
    if (fault != nullptr) {
      good = good && !is_ours(contestant);
      state.SkipWithError(fault);
      return;
    }
    state.SetIterationTime(outcome->total_ms() / 1000);
    state.counters["import"] = outcome->import_ms;
    state.counters["booleans"] = outcome->boolean_ms;
    state.counters["output"] = outcome->output_ms;
    state.counters["triangles"] = static_cast<double>(outcome->triangles);
  }
}

int run(int count, char** arguments) {
  benchmark::Initialize(&count, arguments);
  if (benchmark::ReportUnrecognizedArguments(count, arguments)) return 2;
  const std::vector<BooleanCase> cases = boolean_cases();
  const std::vector<Contestant> all = contestants();
  bool good = true;
  for (const BooleanCase& task : cases) {
    for (const Contestant& contestant : all) {
      if (!contestant.takes(task)) continue;
      const std::string name = task.name + "/" + contestant.name;
      benchmark::RegisterBenchmark(name.c_str(),
                                   [&](benchmark::State& state) {
                                     measure(state, task, contestant, good);
                                   })
          ->Iterations(1)
          ->Repetitions(is_ours(contestant) ? task.repeats
                                            : task.repeats_of_others)
          ->UseManualTime()
          ->Unit(benchmark::kMillisecond);
    }
  }
  TableReporter table;
  const std::size_t matched = benchmark::RunSpecifiedBenchmarks(&table);
  benchmark::Shutdown();
  if (matched == 0) {
    std::fprintf(stderr, "run_booleans: no case matches the filter\n");
    return 2;
  }
  return good ? 0 : 1;
}

}  // namespace
}  // namespace halfspace::bench

int main(int count, char** arguments) {
  // As the command line program does.
  static auto* const pool = new halfspace::fast::HugePagePool;
  std::pmr::set_default_resource(pool);
  return halfspace::bench::run(count, arguments);
}
