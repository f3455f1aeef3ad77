#include <benchmark/benchmark.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory_resource>
#include <string>
#include <utility>

#include "booleans/contestant.hpp"
#include "booleans/mesh_file.hpp"
#include "booleans/table_reporter.hpp"
#include "halfspace/fast/huge_page_pool.hpp"

/// Measures booleans of solids: ours and those of other libraries.
namespace halfspace::bench {
namespace {

std::vector<Contestant> contestants() {
  std::vector<Contestant> all{ours_in_turn(), ours_at_once(), ours_checked(),
                              ours_at_once_checked()};
#ifdef HALFSPACE_BENCH_MANIFOLD
  all.push_back(manifold_in_turn());
  all.push_back(manifold_in_batch());
#endif
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
  if (std::abs(outcome.volume6 - volume6) >
      contestant.volume_error * volume6_of(task.operands.front()))
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

/// Our options; the others are Google Benchmark's.
struct Request {
  int grid_bits = 0;  ///< 0: the models' own coordinates, which are whole
  std::uint64_t seed = 0;
  std::vector<std::string> meshes;
};

/// All cases that are asked for; an error if a mesh cannot be read.
Result<std::vector<BooleanCase>> cases_of(const Request& request) {
  std::vector<BooleanCase> cases;
  if (request.meshes.empty()) cases = boolean_cases(request.seed);
  for (const std::string& path : request.meshes) {
    Result<Triangles> mesh = read_triangles(path);
    if (!mesh) return mesh.error();
    for (const double turn : {0.0, 0.01})
      cases.push_back(mesh_pair(path, *mesh, turn, request.seed));
  }
  if (request.grid_bits != 0) {
    for (BooleanCase& task : cases)
      task = in_floats(std::move(task), request.grid_bits, request.seed);
  }
  return cases;
}

int run(int count, char** arguments) {
  benchmark::Initialize(&count, arguments);
  Request request;
  CLI::App app("Booleans of solids, ours and others'");
  app.add_option("--grid", request.grid_bits,
                 "coordinates are floats, on a grid of so many bits")
      ->check(CLI::IsMember({26, 40, 54}));
  app.add_option("--seed", request.seed, "where solids stand");
  app.add_option("--mesh", request.meshes,
                 "meshes, each with itself moved, in place of all cases");
  CLI11_PARSE(app, count, arguments);
  if (!request.meshes.empty() && request.grid_bits == 0) request.grid_bits = 54;
  const Result<std::vector<BooleanCase>> made = cases_of(request);
  if (!made) {
    std::fprintf(stderr, "run_booleans: %s\n", made.error().message.c_str());
    return 2;
  }
  const std::vector<BooleanCase>& cases = *made;
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
