#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "halfspace/io/import.hpp"
#include "halfspace/io/read_mesh.hpp"
#include "peers/aims.hpp"
#include "peers/row.hpp"
#include "workloads.hpp"

namespace halfspace::bench {
namespace {

const std::map<std::string, fast::SimdLevel> kSimdNames = {
    {"best", fast::SimdLevel::kBest},
    {"portable", fast::SimdLevel::kPortable},
    {"avx2", fast::SimdLevel::kAvx2},
    {"avx512", fast::SimdLevel::kAvx512}};

/// The options of the command line.
struct Request {
  Plan plan;
  std::uint64_t seed = 1;
  std::string view = "front";
  std::vector<std::string> only;
  std::vector<std::string> meshes;
  std::optional<int> grid_bits;
  std::string simd = "best";
  std::string csv;

  bool wants(const std::string& name) const {
    return only.empty() ||
           std::any_of(only.begin(), only.end(), [&](const std::string& part) {
             return (" " + name + " ").find(" " + part + " ") !=
                    std::string::npos;
           });
  }
};

/// The nearest float, as a binary file holds it.
io::Number as_float(const io::Number& number) {
  return io::number_of(static_cast<float>(io::to_double(number)));
}

/// A mesh as it is, or on a grid of so many bits, its coordinates floats.
Result<Scene> scene_of(const std::filesystem::path& path,
                       std::optional<int> grid_bits) {
  Result<io::Mesh> mesh = io::read_mesh(path);
  if (!mesh) return mesh.error();
  io::ImportOptions options;
  options.grid_bits = grid_bits;
  if (grid_bits && mesh->decimal) {
    mesh->decimal = false;
    for (auto& vertex : mesh->vertices) {
      for (io::Number& x : vertex) x = as_float(x);
    }
  }
  options.gouraud = true;
  Result<io::Imported> imported = io::import_scene(*mesh, options);
  if (!imported) return imported.error();
  return imported->scene;
}

Workload workload_of(const std::filesystem::path& path,
                     std::optional<int> grid_bits) {
  return {"W4 " + path.filename().string(), false,
          [path, grid_bits] { return scene_of(path, grid_bits); },
          &scene_camera};
}

void print(const char* title, const Table& table) {
  std::printf("## %s\n\n%s\n", title, to_markdown(table).c_str());
}

/// Whether all pictures are right; prints those that are not.
bool agree(const std::vector<Row>& rows) {
  bool good = true;
  for (const Row& row : rows) {
    for (const WrongPicture& wrong : row.wrong_pictures) {
      std::fprintf(stderr, "run_peers: %s: wrong picture by %s (%s equal)\n",
                   row.name.c_str(), wrong.peer.c_str(),
                   digits(wrong.share_equal, 4).c_str());
      good = false;
    }
  }
  return good;
}

int run(Request request) {
  request.plan.view = *view_named(request.view);
  request.plan.simd = kSimdNames.at(request.simd);
  std::vector<Workload> all = workloads(request.seed, request.grid_bits);
  for (const std::string& mesh : request.meshes) {
    all.push_back(workload_of(mesh, request.grid_bits));
  }
  std::vector<Row> rows;
  for (const Workload& workload : all) {
    if (!request.wants(workload.name)) continue;
    const Result<Scene> scene = workload.scene();
    if (!scene) {
      std::fprintf(stderr, "run_peers: %s\n", scene.error().message.c_str());
      return 2;
    }
    std::fprintf(stderr, "%s ...\n", workload.name.c_str());
    rows.push_back(measure_row(workload, *scene, request.plan));
  }
  const std::string coordinates =
      request.grid_bits
          ? "floats on " + std::to_string(*request.grid_bits) + " bits"
          : "as they are";
  std::printf(
      "seed %llu, view %s, coordinates %s, instructions %s, %d x %d pixels, "
      "one thread, processor time in ms, least of up to %d\n\n",
      static_cast<unsigned long long>(request.seed), request.view.c_str(),
      coordinates.c_str(), request.simd.c_str(), request.plan.size_px,
      request.plan.size_px, request.plan.repeats.most);
  print("Time per frame", cost_table(rows));
  print("Peers' time / ours", ratio_table(rows));
  print("Work of a frame", work_table(rows));
  print("Trees", tree_table(rows));
  print("Aims", aim_table(aims_of(rows)));
  if (!request.csv.empty() &&
      !write_file(request.csv, to_csv(cost_table(rows)))) {
    std::fprintf(stderr, "run_peers: cannot write %s\n", request.csv.c_str());
    return 2;
  }
  return agree(rows) ? 0 : 1;
}

}  // namespace
}  // namespace halfspace::bench

int main(int argc, char** argv) {
  halfspace::bench::Request request;
  CLI::App app(
      "Draws each workload with the fast library and with the peers, and "
      "prints the times.");
  app.add_option("--seed", request.seed, "Seed of the random scenes");
  app.add_option("--size", request.plan.size_px, "Columns and rows")
      ->check(CLI::Range(16, 8192));
  app.add_option("--view", request.view, "Where the eye is")
      ->check(CLI::IsMember(
          std::vector<std::string>(halfspace::bench::kViewNames.begin(),
                                   halfspace::bench::kViewNames.end())));
  app.add_option("--only", request.only,
                 "Only workloads with one of these words in their names");
  app.add_option("--mesh", request.meshes, "Mesh files, as workloads W4");
  app.add_option("--grid", request.grid_bits,
                 "Coordinates are floats, on a grid of so many bits")
      ->check(CLI::IsMember({26, 40, 54}));
  app.add_option("--simd", request.simd, "The fast library's instructions")
      ->check(CLI::IsMember(halfspace::bench::kSimdNames));
  app.add_option("--repeats", request.plan.repeats.most,
                 "The most times that a frame is drawn")
      ->check(CLI::PositiveNumber);
  app.add_option("--budget", request.plan.repeats.budget_ms,
                 "Time to spend on one number. Units: ms");
  app.add_flag("!--no-peers", request.plan.peers,
               "Measure the fast library alone");
  app.add_flag("!--no-back-to-front", request.plan.back_to_front,
               "Leave out the fast library's painter");
  app.add_option("--csv", request.csv, "Also write the times to this file");
  CLI11_PARSE(app, argc, argv);
  return halfspace::bench::run(std::move(request));
}
