#include <CLI/App.hpp>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>

#include "building.hpp"
#include "command.hpp"
#include "engine.hpp"
#include "halfspace/io/import.hpp"
#include "halfspace/io/read_mesh.hpp"
#include "halfspace/io/write_mesh.hpp"
#include "halfspace/scene_file.hpp"
#include "loading.hpp"
#include "measuring.hpp"
#include "operands.hpp"

namespace halfspace::tools {
namespace {

struct Arguments {
  std::string path_a;
  std::string path_b;
  std::string output;
  std::optional<int> grid_bits;
  BuildArguments build;
};

/// The doubles of the result as a scene, rounded to a grid if need be.
Result<io::Imported> import_rounded(const io::OutputMesh& rounded) {
  io::Mesh mesh;
  for (const auto& [x, y, z] : rounded.vertices) {
    if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(z)) {
      return Error{ErrorCode::kNotFinite,
                   "a coordinate is beyond the range of doubles"};
    }
    mesh.vertices.push_back(
        {io::number_of(x), io::number_of(y), io::number_of(z)});
  }
  mesh.first_corner = rounded.first_corner;
  mesh.corners = rounded.corners;
  mesh.face_colors.assign(rounded.colors.begin(), rounded.colors.end());
  return io::import_scene(mesh, {});
}

/// Writes the result as a scene, and counts what had to be rounded.
Result<io::ExportReport> write_scene_file(const std::string& path,
                                          const BooleanResult& result) {
  io::ExportReport report;
  SceneFile file;
  if (result.scene) {
    file.scene = *result.scene;
  } else {
    Result<io::Imported> imported = import_rounded(result.mesh);
    if (!imported) return imported.error();
    report = {.moved = result.moved + imported->report.moved,
              .max_move = result.max_move + imported->report.max_move,
              .triangulated = imported->report.triangulated};
    file.scene = std::move(imported->scene);
  }
  std::ofstream out(path, std::ios::binary);
  out << write_scene(file);
  out.close();
  if (!out) return Error{ErrorCode::kUnwritable, path + ": cannot be written"};
  return report;
}

Result<io::ExportReport> write_result(const std::string& path,
                                      const BooleanResult& result) {
  if (is_scene_name(path)) return write_scene_file(path, result);
  if (result.scene) return io::write_scene_mesh(path, *result.scene);
  Result<io::ExportReport> report = io::write_mesh(path, result.mesh);
  if (!report) return report;
  report->moved += result.moved;
  report->max_move += result.max_move;
  return report;
}

nlohmann::json stats_of(const Operands& operands, const BooleanResult& result,
                        const io::ExportReport& report, double boolean_ms) {
  const io::ImportReport& import = operands.report;
  return {{"polygons", operands.a.scene().polygon_count() +
                           operands.b.scene().polygon_count()},
          {"faces", result.faces},
          {"bad_edges", result.bad_edges},
          {"volume", result.volume},
          {"boolean_ms", boolean_ms},
          {"import",
           {{"moved", import.moved},
            {"max_move", import.max_move},
            {"triangulated", import.triangulated},
            {"dropped", import.dropped},
            {"unit", to_string(import.unit)},
            {"grid_bits", import.grid_bits}}},
          {"export",
           {{"moved", report.moved},
            {"max_move", report.max_move},
            {"triangulated", report.triangulated}}}};
}

/// Says what was done, line by line, on standard output.
void print_summary(const Operands& operands, const BooleanResult& result,
                   const io::ExportReport& report, double boolean_ms,
                   const std::string& output) {
  std::printf("operands: %zu and %zu polygons; %s\n",
              operands.a.scene().polygon_count(),
              operands.b.scene().polygon_count(),
              to_string(operands.report).c_str());
  std::printf("result: %zu polygons, closed, volume %.12g, %.3f ms\n",
              result.faces, result.volume, boolean_ms);
  std::printf("%s: moved %zu coordinates (by at most %.3g), triangulated %zu\n",
              output.c_str(), report.moved, report.max_move,
              report.triangulated);
}

Status run(BooleanOp operation, const Arguments& arguments) {
  const std::unique_ptr<Engine> engine =
      make_engine(library_of(arguments.build, Library::kRef));
  if (!engine->has_booleans()) {
    return fail("--impl fast: has no booleans yet; use --impl ref");
  }
  const std::string& output = arguments.output;
  if (!is_scene_name(output) && !io::format_of(output)) {
    return fail(output +
                ": the name must end in .obj, .stl, .ply, .off or "
                ".scene");
  }
  const Result<Operands> operands =
      load_operands(arguments.path_a, arguments.path_b, arguments.grid_bits);
  if (!operands) return fail(operands.error().message);
  progress(engine->warning(operands->a.scene().polygon_count() +
                           operands->b.scene().polygon_count()));
  const Stopwatch watch;
  const BooleanResult result = engine->boolean(
      operation, operands->a, operands->b, build_options(arguments.build));
  const double boolean_ms = watch.elapsed_ms();
  if (result.bad_edges != 0) {
    return fail("this is a bug: the result has " +
                std::to_string(result.bad_edges) +
                " bad edges; nothing was written");
  }
  const Result<io::ExportReport> report = write_result(output, result);
  if (!report) return fail(output, report.error());
  if (arguments.build.stats_file != "-") {
    print_summary(*operands, result, *report, boolean_ms, output);
  }
  if (arguments.build.stats_file) {
    const Result<Done> written =
        write_stats(*arguments.build.stats_file,
                    stats_of(*operands, result, *report, boolean_ms));
    if (!written) return fail(*arguments.build.stats_file, written.error());
  }
  return Status::kFine;
}

void add_operation(CLI::App& csg, const std::string& name,
                   const std::string& meaning, BooleanOp operation,
                   Status& status) {
  CLI::App* app = csg.add_subcommand(name, meaning);
  const auto arguments = std::make_shared<Arguments>();
  app->add_option("A", arguments->path_a, "A closed mesh or .scene")
      ->required()
      ->type_name("");
  app->add_option("B", arguments->path_b, "Another")->required()->type_name("");
  app->add_option("-o,--output", arguments->output,
                  "The result: OBJ, STL, PLY, OFF or .scene")
      ->required()
      ->type_name("OUT");
  add_grid_option(*app, arguments->grid_bits);
  add_build_options(*app, arguments->build, "ref");
  app->callback(
      [operation, arguments, &status] { status = run(operation, *arguments); });
}

}  // namespace

void add_csg(CLI::App& program, Status& status) {
  CLI::App* app = program.add_subcommand(
      "csg", "Union, intersection or difference of two closed solids");
  app->require_subcommand(1);
  add_operation(*app, "union", "What is in A or in B", BooleanOp::kUnion,
                status);
  add_operation(*app, "intersection", "What is in A and in B",
                BooleanOp::kIntersection, status);
  add_operation(*app, "difference", "What is in A and not in B",
                BooleanOp::kDifference, status);
  app->footer(
      "Both must be closed, faces outwards; `halfspace info` tells. Files of "
      "different\nunits are brought to one that holds both.\n\n"
      "Examples:\n"
      "  halfspace csg union a.off b.off -o both.off\n"
      "  halfspace csg difference plate.stl drill.stl -o drilled.scene");
}

}  // namespace halfspace::tools
