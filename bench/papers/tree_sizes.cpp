#include "papers/tree_sizes.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <utility>

#include "halfspace/assert.hpp"
#include "halfspace/fast/build.hpp"
#include "halfspace/io/import.hpp"
#include "halfspace/io/read_mesh.hpp"
#include "models.hpp"
#include "papers/paper_models.hpp"
#include "scenes.hpp"
#include "timing.hpp"

namespace halfspace::bench {
namespace {

/// A number measured several times.
struct Spread {
  std::vector<double> values;

  double middle() const { return median(values); }
  std::string range() const {
    const auto [least, greatest] =
        std::minmax_element(values.begin(), values.end());
    return digits(*least) + " to " + digits(*greatest);
  }
};

Scene model_named(const char* name) {
  Result<Scene> scene = models::make_model(name, {});
  HALFSPACE_ASSERT(scene.has_value());
  return std::move(scene).value();
}

/// HEUR fig. 6 as far as the scan can be read; the rest of that paper's
/// numbers cannot be.
struct HeurPaper {
  const char* nodes;
  const char* height;
};
constexpr std::array<HeurPaper, 6> kHeurFigure6 = {{{"501", "45"},
                                                    {"415", "15"},
                                                    {"494", "42"},
                                                    {"509", "12"},
                                                    {"496", "11"},
                                                    {"507", "illegible"}}};

constexpr std::array kHeurRules = {RootRule::kH1, RootRule::kH2, RootRule::kH3,
                                   RootRule::kH4, RootRule::kH5, RootRule::kH6};

void add_heur_scene(const char* name, bool has_paper, const Effort& effort,
                    const std::function<Scene(std::uint64_t seed)>& scene,
                    Table& table) {
  for (std::size_t rule = 0; rule < kHeurRules.size(); ++rule) {
    Spread nodes, heights;
    std::size_t polygons = 0;
    for (std::size_t k = 0; k < effort.trees; ++k) {
      const Scene made = scene(effort.seed + k);
      polygons = made.polygon_count();
      const TreeStats stats =
          fast::stats(fast::build(made, {.rule = kHeurRules[rule]}));
      nodes.values.push_back(static_cast<double>(stats.nodes));
      heights.values.push_back(static_cast<double>(stats.height));
    }
    const HeurPaper paper =
        has_paper ? kHeurFigure6[rule] : HeurPaper{"illegible", "illegible"};
    table.rows.push_back(
        {name, std::to_string(polygons), "H-" + std::to_string(rule + 1),
         digits(nodes.middle()), nodes.range(), paper.nodes,
         digits(heights.middle()), heights.range(), paper.height});
  }
}

}  // namespace

Result<std::vector<Model>> fag83_models(
    const std::vector<std::filesystem::path>& scans) {
  std::vector<Model> models;
  models.push_back({"Klein bottle",
                    model_named("klein-bottle"),
                    {"1475", "1118", "1035", "990"},
                    {}});
  models.push_back({"3 cubes",
                    model_named("interlocking-cubes"),
                    {"402", "279", "263", "240"},
                    {"280", "2.46 to 4.81"}});
  models.push_back({"Ribbon plot",
                    model_named("ribbons"),
                    {"1478", "929", "797", "860"},
                    {}});
  models.push_back({"3 atoms", three_atoms(), {}, {"1440", "1.53 to 1.84"}});
  for (const std::filesystem::path& path : scans) {
    const Result<io::Mesh> mesh = io::read_mesh(path);
    if (!mesh) return mesh.error();
    Result<io::Imported> imported = io::import_scene(*mesh, {});
    if (!imported) return imported.error();
    models.push_back({path.filename().string(), imported->scene, {}, {}});
  }
  return models;
}

Report fag83_table_1(const std::vector<Model>& models, const Effort& effort) {
  constexpr std::array<std::uint32_t, 4> kCandidates = {1, 3, 5, 15};
  Report report = {
      "fag83-table-1", "FAG83 table 1: polygons in the tree", {}, {}};
  report.table.head = {"model", "polygons", "candidates",       "tree, median",
                       "range", "paper",    "build, median, ms"};
  Chart chart = {"FAG83 table 1, growth by number of candidates",
                 "candidates",
                 "polygons in the tree / in the model",
                 false,
                 {}};
  for (const Model& model : models) {
    Series series = {model.name, {}};
    const auto polygons = static_cast<double>(model.scene.polygon_count());
    for (std::size_t c = 0; c < kCandidates.size(); ++c) {
      Spread sizes, times;
      for (std::size_t k = 0; k < effort.trees; ++k) {
        const double start = process_ms();
        const fast::BspTree tree =
            fast::build(model.scene, {.rule = RootRule::kRandom,
                                      .candidates = kCandidates[c],
                                      .seed = effort.seed + k});
        times.values.push_back(process_ms() - start);
        sizes.values.push_back(
            static_cast<double>(fast::stats(tree).fragments));
      }
      report.table.rows.push_back(
          {model.name, digits(polygons), std::to_string(kCandidates[c]),
           digits(sizes.middle()), sizes.range(),
           model.paper.empty() ? "" : model.paper[c], digits(times.middle())});
      series.points.emplace_back(kCandidates[c], sizes.middle() / polygons);
    }
    if (chart.series.size() < 8) chart.series.push_back(std::move(series));
  }
  report.figures.push_back({report.name, std::move(chart)});
  return report;
}

Report heur_figures(const Effort& effort) {
  Report report = {"heur-figures-4-to-7",
                   "HEUR fig. 4 to 7: nodes and height by H-1 to H-6",
                   {},
                   {}};
  report.table.head = {"scene",          "polygons", "rule",
                       "nodes, median",  "range",    "paper",
                       "height, median", "range",    "paper"};
  add_heur_scene("fig. 4: solids", false, effort, &cylinders_cones_blocks,
                 report.table);
  const auto random = [](std::int64_t count) {
    return [count](std::uint64_t seed) {
      return random_triangles({1000, count, false, seed});
    };
  };
  add_heur_scene("fig. 5: random", false, effort, random(100), report.table);
  add_heur_scene("fig. 6: random", true, effort, random(50), report.table);
  add_heur_scene(
      "fig. 7: cycles", false, effort,
      [](std::uint64_t seed) { return cyclic_groups(10, seed); }, report.table);
  return report;
}

Report f2b_tree_sizes(const Effort& effort) {
  Report report = {"f2b-tree-sizes",
                   "F2B: polygons in the tree of random triangles",
                   {},
                   {}};
  report.table.head = {"S",     "triangles", "rule", "tree, median",
                       "range", "paper"};
  Chart chart = {"F2B, polygons in the tree of random triangles",
                 "triangles",
                 "polygons in the tree",
                 false,
                 {}};
  struct Rule {
    const char* name;
    BuildOptions options;
  };
  const std::array<Rule, 3> rules = {
      {{"first", {.rule = RootRule::kFirst}},
       {"5 candidates", {.rule = RootRule::kRandom, .candidates = 5}},
       {"fewest cuts", {.rule = RootRule::kFewestCuts}}}};
  for (const std::int64_t size : {50, 300, 500}) {
    for (const Rule& rule : rules) {
      Series series = {"S " + std::to_string(size) + ", " + rule.name, {}};
      for (std::int64_t count = 100; count <= 500; count += 100) {
        Spread sizes;
        for (std::size_t k = 0; k < effort.trees; ++k) {
          const Scene scene =
              random_triangles({size, count, false, effort.seed + k});
          sizes.values.push_back(static_cast<double>(
              fast::stats(fast::build(scene, rule.options)).fragments));
        }
        const bool known = size == 500 && count == 500;
        report.table.rows.push_back({std::to_string(size),
                                     std::to_string(count), rule.name,
                                     digits(sizes.middle()), sizes.range(),
                                     known ? "almost 10000" : ""});
        series.points.emplace_back(count, sizes.middle());
      }
      if (size > 50) chart.series.push_back(std::move(series));
    }
  }
  report.figures.push_back({report.name, std::move(chart)});
  return report;
}

}  // namespace halfspace::bench
