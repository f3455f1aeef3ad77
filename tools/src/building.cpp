#include "building.hpp"

#include <array>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>

#include "arguments.hpp"
#include "measuring.hpp"

namespace halfspace::tools {
namespace {

/// In the order of RootRule.
const std::vector<std::string>& rule_words() {
  static const std::vector<std::string> kWords = {
      "first", "random", "fewest-cuts", "h1", "h2", "h3", "h4", "h5", "h6"};
  return kWords;
}

}  // namespace

void add_build_options(CLI::App& app, BuildArguments& arguments) {
  const std::string group = "Tree";
  add_choice(app, "--impl", library_words(), arguments.library,
             "The library that does it: exact rationals (ref, usual) or fast")
      ->group(group);
  add_choice(app, "--heuristic", rule_words(), arguments.rule,
             "How the root of each subtree is chosen: the first polygon, of K "
             "random ones that which cuts the fewest (usual), of all, or "
             "heuristics H-1 to H-6")
      ->group(group);
  add_parsed(app, "--candidates", "K", arguments.candidates, parse_count,
             "Candidates of the random rule; 5 if not said")
      ->group(group);
  add_parsed(app, "--seed", "SEED", arguments.seed, parse_natural,
             "Seed of the random rule; 1 if not said")
      ->group(group);
  add_parsed(app, "--cut-weight", "S", arguments.cut_weight, parse_count,
             "Weight of a cut against balance in h6; 75 if not said")
      ->group(group);
  add_parsed(app, "--threads", "N", arguments.threads, parse_count,
             "Threads to use; the result is the same, and ref uses one")
      ->group("Measurement");
  app.add_option("--stats", arguments.stats_file,
                 "Write sizes and processor times as JSON; - is standard "
                 "output")
      ->type_name("FILE.json")
      ->group("Measurement");
}

BuildOptions build_options(const BuildArguments& arguments) {
  BuildOptions options;
  options.rule = static_cast<RootRule>(arguments.rule);
  options.candidates = arguments.candidates.value_or(options.candidates);
  options.seed = arguments.seed.value_or(options.seed);
  options.cut_weight = arguments.cut_weight.value_or(options.cut_weight);
  return options;
}

int thread_count(const BuildArguments& arguments) {
  return static_cast<int>(arguments.threads.value_or(1));
}

BuildMeasure build_measured(Engine& engine, const Scene& scene,
                            const BuildArguments& arguments) {
  BuildMeasure measure;
  const std::size_t before = allocated_bytes();
  const Stopwatch watch;
  engine.build(scene, build_options(arguments), thread_count(arguments));
  measure.build_ms = watch.elapsed_ms();
  measure.bytes = allocated_bytes() - before;
  measure.stats = engine.stats();
  return measure;
}

nlohmann::json stats_of(const Loaded& loaded, const BuildMeasure& measure,
                        const BuildArguments& arguments) {
  const io::ImportReport& report = loaded.report;
  return {{"impl", library_words()[arguments.library]},
          {"heuristic", rule_words()[arguments.rule]},
          {"threads", thread_count(arguments)},
          {"polygons", loaded.file.scene.polygon_count()},
          {"fragments", measure.stats.fragments},
          {"nodes", measure.stats.nodes},
          {"height", measure.stats.height},
          {"splits", measure.stats.splits},
          {"build_ms", measure.build_ms},
          {"bytes", measure.bytes},
          {"import",
           {{"moved", report.moved},
            {"max_move", report.max_move},
            {"triangulated", report.triangulated},
            {"dropped", report.dropped},
            {"unit", to_string(report.unit)},
            {"grid_bits", report.grid_bits}}}};
}

std::string to_string(const BuildMeasure& measure) {
  char text[256];
  std::snprintf(text, sizeof text,
                "%zu nodes, height %zu, %zu fragments, %zu splits, %zu bytes, "
                "%.3f ms",
                measure.stats.nodes, measure.stats.height,
                measure.stats.fragments, measure.stats.splits, measure.bytes,
                measure.build_ms);
  return text;
}

Result<Done> write_stats(const std::string& path, const nlohmann::json& stats) {
  if (path == "-") {
    std::cout << stats.dump(2) << std::endl;
    return Done{};
  }
  std::ofstream file(path);
  file << stats.dump(2) << '\n';
  file.close();
  if (!file) {
    return Error{ErrorCode::kUnwritable, path + ": cannot be written"};
  }
  return Done{};
}

}  // namespace halfspace::tools
