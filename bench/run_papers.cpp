#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "papers/depth_sort.hpp"
#include "papers/frames.hpp"
#include "papers/report.hpp"
#include "papers/screens.hpp"
#include "papers/tree_sizes.hpp"

namespace halfspace::bench {
namespace {

/// The options of the command line.
struct Request {
  Effort effort;
  std::filesystem::path out = "papers";
  std::vector<std::string> only;
  std::vector<std::string> scans;

  bool wants(const std::string& name) const {
    return only.empty() ||
           std::find(only.begin(), only.end(), name) != only.end();
  }
};

/// Prints a report and writes its files; false where that fails.
bool publish(const Report& report, const std::filesystem::path& out) {
  std::printf("## %s\n\n%s\n", report.title.c_str(),
              to_markdown(report.table).c_str());
  std::fflush(stdout);
  bool good = write_file(out / (report.name + ".csv"), to_csv(report.table));
  for (const Figure& figure : report.figures) {
    good =
        write_file(out / (figure.name + ".svg"), to_svg(figure.chart)) && good;
  }
  if (!good) {
    std::fprintf(stderr, "run_papers: cannot write to %s\n",
                 out.string().c_str());
  }
  return good;
}

int run(const Request& request) {
  std::error_code ignored;
  std::filesystem::create_directories(request.out, ignored);
  bool good = true;
  const auto models = fag83_models(request.effort.scans);
  if (!models) {
    std::fprintf(stderr, "run_papers: %s\n", models.error().message.c_str());
    return 2;
  }
  if (request.wants("fag83")) {
    good = publish(fag83_table_1(*models, request.effort), request.out) && good;
    good = publish(fag83_table_2(*models, request.effort), request.out) && good;
  }
  if (request.wants("heur")) {
    good = publish(heur_figures(request.effort), request.out) && good;
  }
  if (request.wants("f2b")) {
    good = publish(f2b_tree_sizes(request.effort), request.out) && good;
    good = publish(f2b_figures_12_to_14(request.effort), request.out) && good;
    good = publish(f2b_figures_15_16(request.effort), request.out) && good;
  }
  if (request.wants("sort")) {
    good =
        publish(f2b_depth_sort(*models, request.effort), request.out) && good;
  }
  if (request.wants("faq")) {
    good = publish(faq_screens(request.effort), request.out) && good;
  }
  return good ? 0 : 1;
}

}  // namespace
}  // namespace halfspace::bench

int main(int argc, char** argv) {
  halfspace::bench::Request request;
  CLI::App app("Does the papers' experiments again: CSV, SVG, and tables.");
  app.add_option("--out", request.out, "Folder for the CSV and SVG files");
  app.add_option("--seed", request.effort.seed, "The first seed");
  app.add_option("--trees", request.effort.trees,
                 "Trees, from as many seeds, behind each number")
      ->check(CLI::PositiveNumber);
  app.add_option("--size", request.effort.size_px, "Columns and rows, F2B")
      ->check(CLI::Range(16, 8192));
  app.add_option("--most-parallel", request.effort.most_parallel,
                 "The most parallel triangles, F2B fig. 15 and 16");
  app.add_option("--only", request.only, "Any of f2b, sort, fag83, heur, faq")
      ->check(CLI::IsMember({"f2b", "sort", "fag83", "heur", "faq"}));
  app.add_option("--scan", request.scans,
                 "Mesh files that join the models of FAG83");
  CLI11_PARSE(app, argc, argv);
  for (const std::string& scan : request.scans) {
    request.effort.scans.emplace_back(scan);
  }
  return halfspace::bench::run(request);
}
