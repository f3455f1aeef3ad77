#include "image/building.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "cli/command.hpp"
#include "cli/long_work.hpp"
#include "cli/measuring.hpp"
#include "cli/options.hpp"
#include "cli/outputs.hpp"
#include "image/tree_cost.hpp"

namespace halfspace::tools {
namespace {

constexpr Word<RootRule> kRuleWords[] = {{"first", RootRule::kFirst},
                                         {"random", RootRule::kRandom},
                                         {"fewest-cuts", RootRule::kFewestCuts},
                                         {"h1", RootRule::kH1},
                                         {"h2", RootRule::kH2},
                                         {"h3", RootRule::kH3},
                                         {"h4", RootRule::kH4},
                                         {"h5", RootRule::kH5},
                                         {"h6", RootRule::kH6}};

/// More candidates or threads than anybody can use.
constexpr std::uint32_t kMostCounted = 1'000'000;

/// Whether the arguments say anything of a rule.
bool asks_for_rule(const BuildArguments& arguments) {
  return arguments.rule || arguments.candidates || arguments.seed ||
         arguments.cut_weight;
}

/// The word for what build() makes of the arguments.
std::string kind_of(const BuildArguments& arguments, Library library) {
  if (library == Library::kFast && !asks_for_rule(arguments)) return "display";
  return std::string(word_of(kRuleWords, build_options(arguments).rule));
}

double share(std::size_t bytes, std::size_t count) {
  return count == 0 ? 0
                    : static_cast<double>(bytes) / static_cast<double>(count);
}

}  // namespace

void add_build_options(CLI::App& app, BuildArguments& arguments,
                       const std::string& usual_library) {
  const std::string group = "Tree";
  add_choice(app, "--impl", kLibraryWords, arguments.library,
             "The library that does it: fast, or exact rationals (ref). If "
             "not said: " +
                 usual_library)
      ->group(group);
  add_choice(app, "--heuristic", kRuleWords, arguments.rule,
             "A tree of the papers, by how the root of each subtree is chosen: "
             "the first polygon, of K random ones that which cuts the fewest, "
             "of all, or heuristics H-1 to H-6. If not said: fast makes a tree "
             "for display, ref a random one")
      ->group(group);
  add_number(app, "--candidates", "K", arguments.candidates, 1u, kMostCounted,
             "Candidates of the random rule; 5 if not said")
      ->group(group);
  add_number(app, "--seed", "SEED", arguments.seed, std::uint64_t{0},
             std::uint64_t{UINT64_MAX},
             "Seed of the random rule; 1 if not said")
      ->group(group);
  add_number(app, "--cut-weight", "S", arguments.cut_weight, 1u, kMostCounted,
             "Weight of a cut against balance in h6; 75 if not said")
      ->group(group);
  add_number(app, "--threads", "N", arguments.threads, 1u, kMostCounted,
             "Threads to use; if not said, one for an image, and for all else "
             "as many as there are. The result is the same; ref uses one")
      ->group("Measurement");
  app.add_option("--stats", arguments.stats_file,
                 "Write sizes and processor times as JSON; - is standard "
                 "output")
      ->type_name("FILE.json")
      ->group("Measurement");
}

Library library_of(const BuildArguments& arguments, Library usual) {
  return arguments.library.value_or(usual);
}

BuildOptions build_options(const BuildArguments& arguments) {
  BuildOptions options;
  options.rule = arguments.rule.value_or(options.rule);
  options.candidates = arguments.candidates.value_or(options.candidates);
  options.seed = arguments.seed.value_or(options.seed);
  options.cut_weight = arguments.cut_weight.value_or(options.cut_weight);
  return options;
}

int thread_count(const BuildArguments& arguments) {
  return static_cast<int>(arguments.threads.value_or(1));
}

int working_threads(const BuildArguments& arguments) {
  return static_cast<int>(arguments.threads.value_or(0));
}

std::optional<BuildMeasure> build_measured(Engine& engine, Library library,
                                           const Scene& scene,
                                           const BuildArguments& arguments,
                                           bool leaves, bool lazy) {
  TreeRequest request;
  if (asks_for_rule(arguments)) request.rule = build_options(arguments);
  request.leaves = leaves;
  request.lazy = lazy;
  request.threads = working_threads(arguments);
  progress(tree_cost_warning(scene, library, request));
  LongWork work("tree");
  request.progress = [&work](double done) { return work.report(done); };
  BuildMeasure measure;
  const std::size_t before = allocated_bytes();
  const Stopwatch watch;
  const WallClock clock;
  if (!engine.build(scene, request)) return std::nullopt;
  measure.build_ms = watch.elapsed_ms();
  measure.wall_ms = clock.elapsed_ms();
  measure.bytes = engine.tree_bytes();
  if (measure.bytes == 0) measure.bytes = allocated_bytes() - before;
  measure.stats = engine.stats();
  measure.library = word_of(kLibraryWords, library);
  measure.kind = lazy ? "lazy" : kind_of(arguments, library);
  measure.is_lazy = lazy;
  return measure;
}

Result<BuildMeasure> load_measured(Engine& engine, Library library,
                                   const Scene& scene, const std::string& path,
                                   bool leaves) {
  BuildMeasure measure;
  const Stopwatch watch;
  const WallClock clock;
  const Result<Done> loaded = engine.load_tree(path, scene, leaves);
  if (!loaded) return loaded.error();
  measure.build_ms = watch.elapsed_ms();
  measure.wall_ms = clock.elapsed_ms();
  measure.bytes = engine.tree_bytes();
  measure.stats = engine.stats();
  measure.library = word_of(kLibraryWords, library);
  measure.kind = "loaded";
  measure.is_loaded = true;
  return measure;
}

nlohmann::json stats_of(const io::LoadedScene& loaded,
                        const BuildMeasure& measure) {
  const io::ImportReport& report = loaded.report;
  const std::size_t polygons = loaded.file.scene.polygon_count();
  return {{"impl", measure.library},
          {"heuristic", measure.kind},
          {"polygons", polygons},
          {"fragments", measure.stats.fragments},
          {"nodes", measure.stats.nodes},
          {"height", measure.stats.height},
          {"splits", measure.stats.splits},
          {"build_ms", measure.build_ms},
          {"build_wall_ms", measure.wall_ms},
          {"bytes", measure.bytes},
          {"bytes_per_polygon", share(measure.bytes, polygons)},
          {"bytes_per_fragment", share(measure.bytes, measure.stats.fragments)},
          {"import",
           {{"moved", report.moved},
            {"max_move", report.max_move},
            {"triangulated", report.triangulated},
            {"dropped", report.dropped},
            {"unit", io::to_string(report.unit)},
            {"grid_bits", report.grid_bits}}}};
}

std::string to_string(const BuildMeasure& measure, std::size_t polygons) {
  if (measure.is_lazy)
    return fmt::format("{} bytes, opened in {:.3f} ms", measure.bytes,
                       measure.build_ms);
  return fmt::format(
      "{} nodes, height {}, {} fragments, {} splits, {} bytes ({:.0f} a "
      "polygon, {:.0f} a fragment), {} in {:.3f} ms",
      measure.stats.nodes, measure.stats.height, measure.stats.fragments,
      measure.stats.splits, measure.bytes, share(measure.bytes, polygons),
      share(measure.bytes, measure.stats.fragments),
      measure.is_loaded ? "loaded" : "built", measure.build_ms);
}

Result<Done> write_stats(const std::string& path, const nlohmann::json& stats) {
  return write_output(path, stats.dump(2) + '\n');
}

}  // namespace halfspace::tools
