#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory_resource>
#include <string>
#include <vector>

#include "booleans/cases.hpp"
#include "halfspace/fast/boolean.hpp"
#include "halfspace/fast/chain.hpp"
#include "halfspace/fast/check_operand.hpp"
#include "halfspace/fast/display_tree.hpp"
#include "halfspace/fast/huge_page_pool.hpp"
#include "halfspace/fast/to_mesh.hpp"
#include "halfspace/io/picture.hpp"
#include "ours.hpp"
#include "papers/table.hpp"
#include "timing.hpp"
#include "workloads.hpp"

/// How long work takes in one thread and in several, by the wall, and what
/// Amdahl's law makes of that: which share of it stays serial, and how far
/// more threads would lead.
namespace halfspace::bench {
namespace {

/// Work that can be done in any number of threads.
using Work = std::function<void(int threads)>;

class Report {
 public:
  Report(int threads, const Repeats& repeats)
      : threads_(threads), repeats_(repeats) {
    const std::string many = std::to_string(threads);
    table_.head = {"work",         "1 thread, ms", many + " threads, ms",
                   "times faster", "serial",       "of 8",
                   "of 64"};
  }

  void add(const std::string& name, const Work& work) {
    std::fprintf(stderr, "%s ...\n", name.c_str());
    const double one = elapsed_time([&] { work(1); }, repeats_).least;
    add_times(name, one, elapsed_time([&] { work(threads_); }, repeats_).least);
  }

  /// The same of work that needs something new each time, which is not timed.
  void add(const std::string& name, const std::function<void()>& prepare,
           const Work& work) {
    std::fprintf(stderr, "%s ...\n", name.c_str());
    const auto least = [&](int threads) {
      const double end = wall_ms() + repeats_.budget_ms;
      double time = std::numeric_limits<double>::max();
      for (int run = 0; run < repeats_.most && wall_ms() < end; ++run) {
        prepare();
        const double start = wall_ms();
        work(threads);
        time = std::min(time, wall_ms() - start);
      }
      return time;
    };
    const double one = least(1);
    add_times(name, one, least(threads_));
  }

  void print() const {
    std::printf(
        "Time on the wall, least of up to %d. *Serial*: the share that "
        "Amdahl's "
        "law makes of the ratio; *of 8*, *of 64*: how many times faster it "
        "lets so many threads be.\n\n%s",
        repeats_.most, to_markdown(table_).c_str());
  }

 private:
  void add_times(const std::string& name, double one, double many) {
    // many = one (s + (1 - s) / n), solved for s.
    const double n = threads_;
    const double serial = std::clamp((n * many / one - 1) / (n - 1), 0.0, 1.0);
    const auto faster_by = [serial](double count) {
      return digits(1 / (serial + (1 - serial) / count));
    };
    table_.rows.push_back({name, digits(one), digits(many), digits(one / many),
                           digits(100 * serial, 2) + " %", faster_by(8),
                           faster_by(64)});
  }

  int threads_;
  Repeats repeats_;
  Table table_;
};

/// Building the tree of pictures, and a frame of it.
void measure_pictures(const Workload& workload, const Scene& scene,
                      Report& report) {
  fast::BspTree tree;
  report.add(workload.name + ", build", [&](int threads) {
    fast::DisplayTreeOptions options;
    options.threads = threads;
    tree = fast::build_display_tree(scene, options);
  });
  const Camera camera = workload.camera(scene, View::kFront, 1500);
  Ours ours(scene, tree, camera);
  for (const Shading shading : {Shading::kFlat, Shading::kGouraud}) {
    const bool is_flat = shading == Shading::kFlat;
    report.add(workload.name + (is_flat ? ", flat" : ", smooth"),
               [&](int threads) { ours.draw(shading, threads); });
  }
}

/// What one boolean is made of; many operands are combined all at once.
void measure_boolean(const BooleanCase& task, Report& report) {
  std::vector<GridSolid> operands;
  for (const Triangles& operand : task.operands)
    operands.push_back(solid_of(operand));
  std::vector<fast::Solid> solids;
  fast::Solid result;
  const auto import = [&] {
    result = {};
    solids.clear();
    for (const GridSolid& solid : operands) {
      const auto part = static_cast<std::int32_t>(solids.size());
      solids.push_back(solids.empty() ? fast::to_solid(solid)
                                      : fast::to_solid(solid, solids[0], part));
    }
  };
  import();
  report.add(task.name + ", check", [&](int threads) {
    for (const fast::Solid& solid : solids)
      (void)fast::check_operand(solid, {threads, {}});
  });
  // A table knows the points of the last boolean: each time a new one.
  report.add(task.name + ", boolean", import, [&](int threads) {
    result = solids.size() == 2
                 ? fast::boolean(task.operation, solids[0], solids[1], threads)
                 : fast::boolean_all(task.operation, solids, threads);
  });
  report.add(task.name + ", output", [&](int threads) {
    (void)fast::to_mesh(result, {.triangles = true, .threads = threads});
  });
}

/// A picture of 4000 x 4000 pixels as a file.
void measure_picture_file(const Workload& workload, const Scene& scene,
                          Report& report) {
  const fast::BspTree tree = fast::build_display_tree(scene, {});
  Ours ours(scene, tree, workload.camera(scene, View::kFront, 4000));
  ours.draw(Shading::kGouraud, 1);
  const auto path =
      std::filesystem::temp_directory_path() / "halfspace_run_threads.png";
  report.add(workload.name + ", smooth, PNG", [&](int threads) {
    (void)io::write_png(path, ours.frame().colors, {}, threads);
  });
  std::error_code ignored;
  std::filesystem::remove(path, ignored);
}

struct Request {
  int threads = 2;
  std::uint64_t seed = 1;
  std::vector<std::string> only;
  Repeats repeats{9, 3000};

  bool wants(const std::string& name) const {
    return only.empty() ||
           std::any_of(only.begin(), only.end(), [&](const std::string& part) {
             return name.find(part) != std::string::npos;
           });
  }
};

int run(const Request& request) {
  Report report(request.threads, request.repeats);
  for (const Workload& workload : workloads(request.seed)) {
    if (!request.wants(workload.name)) continue;
    const Result<Scene> scene = workload.scene();
    if (!scene) {
      std::fprintf(stderr, "run_threads: %s\n", scene.error().message.c_str());
      return 2;
    }
    measure_pictures(workload, *scene, report);
    measure_picture_file(workload, *scene, report);
  }
  for (const BooleanCase& task : boolean_cases(request.seed)) {
    if (request.wants(task.name)) measure_boolean(task, report);
  }
  report.print();
  return 0;
}

}  // namespace
}  // namespace halfspace::bench

int main(int argc, char** argv) {
  halfspace::bench::Request request;
  CLI::App app("Work in one thread and in several, and Amdahl's law");
  app.add_option("--threads", request.threads, "How many are several")
      ->check(CLI::Range(2, 1024));
  app.add_option("--seed", request.seed, "Of scenes and solids");
  app.add_option("--only", request.only,
                 "Only workloads and cases with one of these in their names");
  app.add_option("--repeats", request.repeats.most, "The most runs of each")
      ->check(CLI::PositiveNumber);
  CLI11_PARSE(app, argc, argv);
  static auto* const pool = new halfspace::fast::HugePagePool;
  std::pmr::set_default_resource(pool);
  return halfspace::bench::run(request);
}
