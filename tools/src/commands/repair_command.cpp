#include <CLI/App.hpp>
#include <CLI/Validators.hpp>
#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "cli/command.hpp"
#include "cli/loading.hpp"
#include "cli/long_work.hpp"
#include "cli/options.hpp"
#include "cli/outputs.hpp"
#include "commands/csg_write.hpp"
#include "halfspace/csg/evaluate.hpp"
#include "halfspace/csg/outcome.hpp"
#include "halfspace/csg/repair.hpp"
#include "halfspace/io/format.hpp"
#include "halfspace/io/load_scene.hpp"

namespace halfspace::tools {
namespace {

/// The words for the formats of solids.
constexpr Word<std::string_view> kFormatWords[] = {
    {"off", "off"}, {"obj", "obj"}, {"stl", "stl"},   {"ply", "ply"},
    {"3mf", "3mf"}, {"glb", "glb"}, {"gltf", "gltf"}, {"scene", "scene"}};

struct RepairArguments {
  std::string input;
  std::string output;
  std::optional<std::string_view> format;  ///< of standard output
  std::optional<double> weld;
  bool close_all = false;
  std::optional<double> thicken;
  std::vector<std::string> without;
  std::optional<double> max_move;
  bool strict = false;
  std::optional<std::uint32_t> threads;
};

/// The words for steps, in their order.
constexpr std::array<const char*, 6> kStepWords = {
    "duplicates", "weld", "agree", "close", "outwards", "resolve"};

std::vector<csg::RepairStep> steps_of(const std::vector<std::string>& words) {
  std::vector<csg::RepairStep> steps;
  for (const std::string& word : words) {
    const auto at = std::find(kStepWords.begin(), kStepWords.end(), word);
    steps.push_back(static_cast<csg::RepairStep>(at - kStepWords.begin()));
  }
  return steps;
}

/// A name that ends as the output's format does.
std::string output_name(const RepairArguments& arguments) {
  if (arguments.output != "-" || !arguments.format) return arguments.output;
  return "-." + std::string(*arguments.format);
}

int threads_of(const RepairArguments& arguments) {
  return static_cast<int>(arguments.threads.value_or(
      std::max(1u, std::thread::hardware_concurrency())));
}

std::optional<double> parse_distance(std::string_view text) {
  const std::optional<double> distance = parse_number<double>(text);
  return distance && *distance >= 0 ? distance : std::nullopt;
}

std::optional<double> parse_thickness(std::string_view text) {
  const std::optional<double> thickness = parse_distance(text);
  return thickness && *thickness > 0 ? thickness : std::nullopt;
}

/// The solid of the source, in the numbers of the output.
Result<std::optional<csg::Outcome>> outcome_of(const RepairArguments& arguments,
                                               const std::string& name,
                                               csg::Source source) {
  const Result<csg::Script> script =
      csg::parse_script("A", std::array{csg::Binding{"A", name}});
  if (!script) return script.error();
  const Result<csg::Plan> plan = csg::make_plan(*script);
  if (!plan) return plan.error();
  csg::OperandOptions how;
  how.repair_word = "repair";
  Result<csg::Operands> operands = csg::Operands::join(
      {std::make_shared<const csg::Source>(std::move(source))}, *script, *plan,
      how);
  if (!operands) return operands.error();
  LongWork work("resolving");
  csg::EvaluateOptions options;
  const auto format = io::format_of(output_name(arguments));
  options.triangles = format && io::has_floats(*format);
  if (options.triangles) options.number = fast::FileNumber::kFloat;
  options.max_move = arguments.max_move;
  options.output = arguments.output == "-" ? kOutputName : arguments.output;
  options.threads = threads_of(arguments);
  options.progress = [&work](double share) { return work.report(share); };
  return csg::evaluate_fast(*plan, *operands, options);
}

void print_report(const csg::RepairReport& report,
                  const csg::Outcome& outcome) {
  if (report.is_empty()) say("nothing had to be done: it is a solid\n");
  for (const std::string& sentence : report.sentences()) say("{}\n", sentence);
  for (const csg::Repair& repair : outcome.repairs) {
    say("resolving cut {} faces, of which parts are left, and dropped {}\n",
        repair.faces_cut, repair.faces_dropped);
  }
}

Status write(const RepairArguments& arguments, const csg::RepairReport& report,
             const csg::Outcome& outcome) {
  if (outcome.bad_edges != 0) {
    return fail("this is a bug: the result has " +
                std::to_string(outcome.bad_edges) +
                " bad edges; nothing was written");
  }
  if (arguments.strict && outcome.rounding && outcome.rounding->lost_any()) {
    return fail(loss_sentence(outcome) + "; nothing was written");
  }
  if (arguments.output == "-") {
    const Result<Done> printed =
        write_through("." + std::string(*arguments.format),
                      [&](const std::string& path) -> Result<Done> {
                        const Result<io::ExportReport> made = write_result(
                            path, outcome, SolidForm::kBinary, false);
                        if (!made) return made.error();
                        return Done{};
                      });
    return printed ? Status::kFine : fail(arguments.output, printed.error());
  }
  note_part(arguments.output);
  const Result<io::ExportReport> written =
      write_result(arguments.output, outcome);
  if (!written) return fail(arguments.output, written.error());
  print_report(report, outcome);
  say("{}: {} polygons, closed, volume {}; moved {} vertices (by at most "
      "{:.3g})\n",
      arguments.output, outcome.polygons, csg::to_string(outcome.volume, 12),
      written->moved, written->max_move);
  if (outcome.rounding && outcome.rounding->lost_any())
    say("warning: {}\n", loss_sentence(outcome));
  print_lost(arguments.output, written->lost);
  print_notes(arguments.output, *written);
  return Status::kFine;
}

/// What is wrong with the output, if files beside both are looked at, too.
std::string file_complaint(const RepairArguments& arguments,
                           const io::Attributes& attributes) {
  std::vector<NamedFile> inputs{{"FILE", arguments.input}};
  for (const std::filesystem::path& beside : attributes.files)
    inputs.push_back({"FILE", beside.string()});
  std::vector<NamedFile> outputs{{"-o", arguments.output}};
  if (!attributes.empty() &&
      io::format_of(arguments.output) == io::Format::kObj)
    outputs.push_back({"-o", io::material_path(arguments.output).string()});
  return complaint(inputs, outputs);
}

/// Of a file that has nothing to be welded, turned or filled.
std::string exact_input(const RepairArguments& arguments) {
  return arguments.input +
         ": an exact file needs no repair: halfspace csg A A=" +
         arguments.input + " -o " + arguments.output +
         " writes it in any format, and with --repair resolves what crosses "
         "itself";
}

/// Where a flat surface was closed.
constexpr const char* kNothingWithin =
    ": what fills its holes lies upon its polygons, so nothing is within; "
    "--thicken THICKNESS makes the surface a shell";

Status run_repair(const RepairArguments& arguments) {
  const std::string output = output_name(arguments);
  if (output == "-") return fail("-o -: give --format as well");
  if (io::is_solid_name(arguments.input)) return fail(exact_input(arguments));
  if (io::is_solid_name(output)) {
    return fail(output +
                ": a repaired solid is written as a mesh first; halfspace csg "
                "A A=MESH -o " +
                output + " makes an exact file of that");
  }
  if (!io::is_scene_name(output) && !io::format_of(output)) {
    return fail(output + ": the name must end in " +
                io::format_extensions(".scene"));
  }
  const std::string wrong =
      complaint(std::array{NamedFile{"FILE", arguments.input}},
                std::array{NamedFile{"-o", arguments.output}});
  if (!wrong.empty()) return fail(wrong);
  Result<io::Mesh> mesh = read_mesh_file(arguments.input);
  if (!mesh) return fail(mesh.error().message);
  const std::string wrong_beside = file_complaint(arguments, mesh->attributes);
  if (!wrong_beside.empty()) return fail(wrong_beside);
  csg::RepairOptions options;
  options.weld = arguments.weld;
  options.without = steps_of(arguments.without);
  options.close_all = arguments.close_all;
  options.thicken = arguments.thicken;
  options.check.threads = threads_of(arguments);
  std::optional<LongWork> work(std::in_place, "checking the surface");
  options.check.progress = [&](double share) { return work->report(share); };
  const std::string name =
      arguments.input == "-" ? io::kInputName : arguments.input;
  Result<csg::Repaired> repaired = csg::repaired(name, *mesh, options);
  work.reset();
  const auto failed = [](const Error& error) {
    return error.code == ErrorCode::kStopped
               ? stop("stopped; nothing was written")
               : fail(error.message);
  };
  if (!repaired) return failed(repaired.error());
  const bool has_filled = repaired->report.filled > 0;
  const Result<std::optional<csg::Outcome>> outcome =
      outcome_of(arguments, name, std::move(repaired->source));
  if (!outcome && outcome.error().code == ErrorCode::kInsideOut && has_filled)
    return fail(name + kNothingWithin);
  if (!outcome) return failed(outcome.error());
  if (!*outcome) return stop("stopped; nothing was written");
  if (arguments.output != "-") print_notes(name, mesh->attributes);
  return write(arguments, repaired->report, **outcome);
}

/// More than anybody can use.
constexpr std::uint32_t kMostThreads = 1'000'000;

constexpr const char* kFooter =
    "What is done, where it has to be, in this order: polygons that others "
    "cover go;\nvertices at borders are welded; corners are added where "
    "vertices lie within edges;\npolygons are turned to agree; holes are "
    "filled, in their plane or by the least area;\ncomponents are turned "
    "outwards; what crosses itself is resolved by winding number.\n"
    "--without leaves steps out: they are duplicates, weld, agree, close, "
    "outwards\nand resolve. Each step is reported. A solid is written as it "
    "is. A border as wide as half "
    "of its\ncomponent may be no hole: say --close-all or --thicken.\n\n"
    "Examples:\n"
    "  halfspace repair scan.stl -o solid.stl\n"
    "  halfspace repair sheet.obj -o plate.off --thicken 2";

}  // namespace

void add_repair(CLI::App& program, Status& status) {
  CLI::App* app = program.add_subcommand(
      "repair", "Make a solid of a mesh that is none, and say how");
  const auto arguments = std::make_shared<RepairArguments>();
  app->add_option("FILE", arguments->input,
                  "The mesh: " + io::format_names() +
                      "; also gzipped; - is standard input")
      ->required()
      ->type_name("");
  app->add_option("-o,--output", arguments->output,
                  "The solid: " + io::format_names() +
                      " or .scene; - is standard output")
      ->required()
      ->type_name("OUT");
  add_choice(*app, "--format", kFormatWords, arguments->format,
             "The format of the solid where OUT is -, standard output");
  add_parsed(*app, "--weld", "DISTANCE", "a number of at least 0",
             arguments->weld, parse_distance,
             "Weld vertices at borders that are no farther apart along any "
             "axis; else 4 steps of a float of the size of the mesh");
  app->add_flag("--close-all", arguments->close_all,
                "Fill holes however wide they are");
  add_parsed(*app, "--thicken", "THICKNESS", "a number greater than 0",
             arguments->thicken, parse_thickness,
             "Make an open surface a shell so thick, in place of filling it");
  app->add_option("--without", arguments->without,
                  "Leave steps out: duplicates, weld, agree, close, outwards, "
                  "resolve")
      ->delimiter(',')
      ->check(CLI::IsMember(
          std::vector<std::string>(kStepWords.begin(), kStepWords.end())))
      ->type_name("STEP,...");
  add_parsed(*app, "--max-move", "DISTANCE", "a number of at least 0",
             arguments->max_move, parse_distance,
             "Do not write a result of which rounding to the file's numbers "
             "moves the surface farther, along an axis");
  app->add_flag("--strict", arguments->strict,
                "Do not write a result of which rounding lost a face or a "
                "part of the surface");
  add_number(*app, "--threads", "N", arguments->threads, 1u, kMostThreads,
             "Threads to use; if not said, as many as there are");
  add_quiet_option(*app);
  app->footer(kFooter);
  app->callback([arguments, &status] { status = run_repair(*arguments); });
}

}  // namespace halfspace::tools
