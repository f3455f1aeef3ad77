#include <CLI/App.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <new>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "cli/command.hpp"
#include "cli/loading.hpp"
#include "cli/long_work.hpp"
#include "cli/measuring.hpp"
#include "cli/options.hpp"
#include "cli/outputs.hpp"
#include "commands/csg_write.hpp"
#include "halfspace/csg/openscad.hpp"
#include "halfspace/csg/operands.hpp"
#include "halfspace/csg/outcome.hpp"
#include "halfspace/csg/step_file.hpp"
#include "halfspace/io/file.hpp"
#include "halfspace/io/format.hpp"
#include "halfspace/io/load_scene.hpp"
#include "halfspace/shadow/boolean.hpp"
#include "image/building.hpp"
#include "image/engine.hpp"
#include "image/shadowing.hpp"

namespace halfspace::tools {
namespace {

/// As many as a script may have (csg::parse_script()).
constexpr std::uint64_t kMostScriptBytes = (std::uint64_t{1} << 31) - 1;

struct CsgArguments {
  std::vector<std::string> words;
  std::string script;
  std::string output;
  std::optional<std::string_view> format;  ///< of standard output
  std::string origin;
  bool keep_origin = false;
  std::optional<csg::MergeRule> merge;
  bool strict = false;
  bool trust = false;
  bool repair = false;
  std::optional<double> max_move;
  std::optional<double> shadow;
  std::string shadow_file = "halfspace-shadow.txt";
  std::optional<int> grid_bits;
  BuildArguments build;
};

/// The format of exact solids in their form for people.
constexpr std::string_view kTextForm = "hsolid-text";

std::string extension_of(std::string_view format) {
  return "." + std::string(format == kTextForm ? "hsolid" : format);
}

/// A name that ends as the output's format does.
std::string output_name(const CsgArguments& arguments) {
  if (arguments.output != "-" || !arguments.format) return arguments.output;
  return "-" + extension_of(*arguments.format);
}

bool is_exact(const CsgArguments& arguments) {
  return io::is_solid_name(output_name(arguments));
}

bool is_step(const CsgArguments& arguments) {
  return csg::is_step_name(output_name(arguments));
}

SolidForm solid_form(const CsgArguments& arguments) {
  return arguments.format == kTextForm ? SolidForm::kText : SolidForm::kBinary;
}

/// Writes the result to the file, or to standard output.
Result<io::ExportReport> write_result_of(const CsgArguments& arguments,
                                         const csg::Outcome& result) {
  if (arguments.output != "-") {
    note_part(arguments.output);
    return write_result(arguments.output, result, solid_form(arguments));
  }
  io::ExportReport report;
  const Result<Done> written =
      write_through(extension_of(*arguments.format),
                    [&](const std::string& path) -> Result<Done> {
                      const Result<io::ExportReport> made = write_result(
                          path, result, solid_form(arguments), false);
                      if (!made) return made.error();
                      report = *made;
                      return Done{};
                    });
  if (!written) return written.error();
  return report;
}

/// What is to be worked out, and what it is called in errors.
struct Request {
  std::string text;
  std::string source;
  std::string folder;  ///< of the files that the text has in quotes
  std::vector<csg::Binding> bindings;
};

/// The request of `csg union A B` and its like; nothing if it is none.
std::optional<Result<Request>> request_by_word(
    const std::vector<std::string>& words) {
  constexpr std::pair<const char*, char> kWords[] = {
      {"union", '|'},
      {"intersection", '&'},
      {"difference", '-'},
      {"symmetric-difference", '^'}};
  for (const auto& [word, symbol] : kWords) {
    if (words.empty() || words[0] != word) continue;
    // It may be the name of a solid, too.
    if (words.size() > 1 && words[1].find('=') != std::string::npos) continue;
    if (words.size() < 3) {
      return Error{
          ErrorCode::kSyntax,
          std::string(word) + " takes two files or more (--help tells more)",
          -1};
    }
    Request request{{}, "the expression", {}, {}};
    for (std::size_t i = 1; i < words.size(); ++i) {
      // Two are called A and B in messages, more A1, A2 and so on.
      const std::string name = words.size() > 3 ? "A" + std::to_string(i)
                               : i == 1         ? "A"
                                                : "B";
      if (i > 1) request.text += std::string(" ") + symbol + " ";
      request.text += name;
      request.bindings.push_back({name, words[i]});
    }
    return request;
  }
  return std::nullopt;
}

/// Whether the word, which can be no expression, names a file that is there.
bool names_file(const std::string& word) {
  std::error_code ignored;
  return word.find('.') != std::string::npos &&
         word.find_first_of("\"()") == std::string::npos &&
         std::filesystem::is_regular_file(word, ignored);
}

Result<Request> request_of(const CsgArguments& arguments) {
  if (arguments.script.empty()) {
    if (auto request = request_by_word(arguments.words))
      return *std::move(request);
  }
  Request request{{}, "the expression", {}, {}};
  std::size_t first = 0;
  if (!arguments.script.empty()) {
    Result<std::string> text =
        io::read_file(arguments.script, kMostScriptBytes);
    if (!text) return io::error_about(arguments.script, text.error());
    request.text = *std::move(text);
    request.source = arguments.script;
    request.folder =
        std::filesystem::path(arguments.script).parent_path().string();
  } else if (!arguments.words.empty()) {
    request.text = arguments.words[0];
    if (names_file(request.text)) {
      return Error{ErrorCode::kSyntax,
                   request.text +
                       ": this is a file, where an expression was "
                       "expected, as in csg A A=FILE; for a script there is "
                       "--script FILE",
                   -1};
    }
    first = 1;
  } else {
    return Error{ErrorCode::kSyntax,
                 "say what to work out, as in csg 'A - B' A=a.off B=b.off, or "
                 "give a --script (--help tells more)",
                 -1};
  }
  for (std::size_t i = first; i < arguments.words.size(); ++i) {
    const std::string& word = arguments.words[i];
    const std::size_t at = word.find('=');
    if (at == std::string::npos || at == 0 || at + 1 == word.size()) {
      return Error{ErrorCode::kSyntax,
                   "expected NAME=FILE, not '" + word + "' (--help tells more)",
                   -1};
    }
    request.bindings.push_back({word.substr(0, at), word.substr(at + 1)});
  }
  return request;
}

/// The work itself, once there is a plan.
class Job {
 public:
  Job(const CsgArguments& arguments, Request request)
      : arguments_(arguments), request_(std::move(request)) {}
  Status run();

 private:
  Status fail_in_source(const Error& error) const {
    return fail(request_.source + ": " + error.message);
  }
  static Status fail_at_work(const Error& error) {
    return error.code == ErrorCode::kStopped
               ? stop("stopped; nothing was written")
               : fail(error.message);
  }
  std::string file_complaint(const csg::Plan& plan,
                             const csg::Operands& operands) const;
  Result<std::optional<csg::Outcome>> evaluate(const csg::Plan& plan,
                                               csg::Operands& operands);
  Status finish(const csg::Script& script, const csg::Plan& plan,
                const csg::Operands& operands, const csg::Outcome& result,
                double boolean_ms) const;
  int threads() const;
  csg::Combine checked_combine();
  Status shadow_status() const;
  Result<csg::Operands> load(const csg::Script& script, const csg::Plan& plan,
                             bool find_crossings) const;

  const CsgArguments& arguments_;
  Request request_;
  std::optional<shadow::BooleanReport> checks_;
};

/// Whatever they are, the result is the same.
int Job::threads() const {
  const unsigned all = std::max(1u, std::thread::hardware_concurrency());
  return static_cast<int>(arguments_.build.threads.value_or(all));
}

/// Booleans of the fast library, a share of them checked.
csg::Combine Job::checked_combine() {
  if (!arguments_.shadow) return {};
  shadow::BooleanReport& report = checks_.emplace();
  shadow::BooleanOptions how;
  how.share = *arguments_.shadow;
  how.threads = threads();
  return [&report, how](BooleanOp operation, const fast::Solid& a,
                        const fast::Solid& b) {
    return shadow::boolean(operation, a, b, how, report);
  };
}

Result<std::optional<csg::Outcome>> Job::evaluate(const csg::Plan& plan,
                                                  csg::Operands& operands) {
  const bool by_ref =
      library_of(arguments_.build, Library::kFast) == Library::kRef;
  if (by_ref) {
    std::size_t polygons = 0;
    for (std::size_t i = 0; i < plan.leaves.size(); ++i)
      polygons += operands.polygon_count(static_cast<std::int32_t>(i));
    progress(make_engine(Library::kRef)->warning(polygons));
  }
  LongWork work(std::to_string(plan.booleans) + " booleans");
  csg::EvaluateOptions options;
  options.exact_data = is_exact(arguments_) || is_step(arguments_);
  options.merge = arguments_.merge.value_or(csg::MergeRule::kOrigin);
  const auto format = io::format_of(output_name(arguments_));
  // Files of triangles would have others than their origins tell of.
  options.triangles = format && io::has_floats(*format);
  if (options.triangles) options.number = fast::FileNumber::kFloat;
  options.max_move = arguments_.max_move;
  options.output = arguments_.output == "-" ? kOutputName : arguments_.output;
  options.keep_origin = arguments_.keep_origin;
  options.keep_corners = !arguments_.origin.empty() || arguments_.keep_origin;
  options.build = build_options(arguments_.build);
  options.threads = threads();
  options.combine = checked_combine();
  options.progress = [&work](double share) { return work.report(share); };
  return by_ref ? csg::evaluate_ref(plan, operands, options)
                : csg::evaluate_fast(plan, operands, options);
}

Result<csg::Operands> Job::load(const csg::Script& script,
                                const csg::Plan& plan,
                                bool find_crossings) const {
  // Solids that are moved are checked later on.
  const auto work = std::make_shared<LongWork>("checking the solids");
  csg::OperandOptions options;
  options.folder = request_.folder;
  options.grid_bits = arguments_.grid_bits;
  options.find_crossings = find_crossings;
  options.repair = arguments_.repair;
  options.repair_word = "--repair";
  options.mending_word = "halfspace repair FILE -o OUT";
  options.check.threads = threads();
  options.check.progress = [work](double share) { return work->report(share); };
  try {
    return csg::Operands::load(script, plan, options);
  } catch (const std::bad_alloc&) {
    std::vector<std::string> paths;
    for (const csg::File& file : script.files) {
      if (!file.mesh) paths.push_back(file.path);
    }
    return no_room_for(paths);
  }
}

/// What is wrong with the files that are written.
std::string Job::file_complaint(const csg::Plan& plan,
                                const csg::Operands& operands) const {
  std::vector<NamedFile> inputs = {{"--script", arguments_.script}};
  bool has_attributes = false;
  for (std::size_t i = 0; i < plan.leaves.size(); ++i) {
    const auto id = static_cast<std::int32_t>(i);
    inputs.push_back({operands.name_of(id), operands.path_of(id)});
    if (const io::AttributedFaces* faces = operands.attributed(id)) {
      has_attributes = true;
      for (const std::filesystem::path& beside : faces->attributes.files)
        inputs.push_back({operands.name_of(id), beside.string()});
    }
  }
  const bool has_materials =
      has_attributes && io::format_of(arguments_.output) == io::Format::kObj;
  return complaint(
      inputs,
      std::array{
          NamedFile{"-o", arguments_.output},
          NamedFile{"-o", has_materials
                              ? io::material_path(arguments_.output).string()
                              : std::string()},
          NamedFile{"--origin", arguments_.origin},
          NamedFile{"--stats", arguments_.build.stats_file.value_or("")},
          NamedFile{"--shadow-file",
                    arguments_.shadow ? arguments_.shadow_file : ""}});
}

Status Job::run() {
  const bool is_foreign = request_.bindings.empty() &&
                          !arguments_.script.empty() &&
                          csg::is_openscad(request_.text);
  const Result<csg::Script> script =
      is_foreign ? csg::read_openscad(request_.text)
                 : csg::parse_script(request_.text, request_.bindings);
  if (!script) return fail_in_source(script.error());
  const Result<csg::Plan> plan = csg::make_plan(*script);
  if (!plan) return fail_in_source(plan.error());
  Result<csg::Operands> operands = load(*script, *plan, !arguments_.trust);
  if (!operands) return fail_at_work(operands.error());
  const std::string wrong = file_complaint(*plan, *operands);
  if (!wrong.empty()) return fail(wrong);
  const Stopwatch watch;
  Result<std::optional<csg::Outcome>> result = evaluate(*plan, *operands);
  if (!result && result.error().code != ErrorCode::kStopped &&
      operands->can_be_finer()) {
    operands = operands->on_finest_grid();
    if (!operands) return fail(operands.error().message);
    result = evaluate(*plan, *operands);
  }
  if (!result) return fail_at_work(result.error());
  if (!*result) return stop("stopped; nothing was written");
  return finish(*script, *plan, *operands, **result, watch.elapsed_ms());
}

Status Job::finish(const csg::Script& script, const csg::Plan& plan,
                   const csg::Operands& operands, const csg::Outcome& result,
                   double boolean_ms) const {
  const CsgContext context{script, plan, operands, result, checks_, boolean_ms};
  if (result.bad_edges != 0) {
    const std::string edges =
        std::to_string(result.bad_edges) + " bad edges; nothing was written";
    if (!operands.are_trusted())
      return fail("this is a bug: the result has " + edges);
    // Now it is worth looking. What only moving has bent is not found so.
    const Result<csg::Operands> checked = load(script, plan, true);
    return fail(
        "--trust did not look for surfaces that cross themselves: the "
        "result has " +
        edges + (checked ? "" : "; " + checked.error().message));
  }
  if (arguments_.strict && result.rounding && result.rounding->lost_any())
    return fail(loss_sentence(result) + "; nothing was written");
  const Result<io::ExportReport> report = write_result_of(arguments_, result);
  if (!report) return fail(arguments_.output, report.error());
  if (!arguments_.origin.empty()) {
    const Result<Done> written = write_origins(arguments_.origin, context);
    if (!written) return fail(arguments_.origin, written.error());
  }
  const auto& stats_file = arguments_.build.stats_file;
  if (stats_file != "-" && arguments_.output != "-")
    print_summary(context, *report, arguments_.output);
  if (stats_file) {
    const Result<Done> written =
        write_stats(*stats_file, stats_of(context, *report));
    if (!written) return fail(*stats_file, written.error());
  }
  return shadow_status();
}

/// Whether a checked boolean was wrong; then that is said, and written down.
Status Job::shadow_status() const {
  if (!checks_ || checks_->mismatches == 0) return Status::kFine;
  const shadow::PointMismatch& first = checks_->first.front();
  const std::string& file = arguments_.shadow_file;
  const Result<Done> written = write_output(file, first.reproducer);
  if (!written) return fail(written.error().message);
  fail("--shadow: " + shadow::to_string(first) + "; this is a bug, and " +
       file + " has the operation and the two solids");
  return Status::kDiffers;
}

std::optional<double> parse_distance(std::string_view text) {
  const std::optional<double> distance = parse_number<double>(text);
  return distance && *distance >= 0 ? distance : std::nullopt;
}

Status run_csg(const CsgArguments& arguments) {
  const std::string output = output_name(arguments);
  if (output == "-") return fail("-o -: give --format as well");
  if (!io::is_scene_name(output) && !io::is_solid_name(output) &&
      !csg::is_step_name(output) && !io::format_of(output)) {
    return fail(
        (output.empty() ? "-o" : output) + ": the name must end in " +
        io::format_extensions(".scene, .step, or for exact solids in .hsolid"));
  }
  if (arguments.format == kTextForm && !io::is_solid_name(output))
    return fail("--format hsolid-text: the name must end in .hsolid");
  const bool by_ref =
      library_of(arguments.build, Library::kFast) == Library::kRef;
  if (by_ref && !arguments.origin.empty())
    return fail("--origin: the reference does not know it; use --impl fast");
  if (by_ref && arguments.keep_origin)
    return fail(
        "--keep-origin: the reference does not know it; use --impl "
        "fast");
  if (by_ref && is_step(arguments))
    return fail(output + ": the reference writes no STEP; use --impl fast");
  if (by_ref && is_exact(arguments))
    return fail(output +
                ": the reference writes no exact solids; use --impl fast");
  if (by_ref && arguments.shadow)
    return fail("--shadow: it is the reference that checks; use --impl fast");
  if (arguments.trust && arguments.repair)
    return fail("--trust finds nothing that --repair could resolve");
  Result<Request> request = request_of(arguments);
  if (!request) return fail(request.error().message);
  return Job(arguments, *std::move(request)).run();
}

constexpr Word<std::string_view> kFormatWords[] = {
    {"off", "off"},   {"obj", "obj"},        {"stl", "stl"},
    {"ply", "ply"},   {"3mf", "3mf"},        {"glb", "glb"},
    {"gltf", "gltf"}, {"scene", "scene"},    {"hsolid", "hsolid"},
    {"step", "step"}, {kTextForm, kTextForm}};

constexpr Word<csg::MergeRule> kMergeWords[] = {
    {"origin", csg::MergeRule::kOrigin},
    {"color", csg::MergeRule::kColor},
    {"plane", csg::MergeRule::kPlane},
    {"none", csg::MergeRule::kNone}};

constexpr const char* kFooter =
    "The expression: names or files in \"quotes\"; a & b, then from left to "
    "right a | b\nor a + b, a - b and a ^ b (in one of them); ~a (outside of "
    "a); brackets;\n"
    "  translate(a, X, Y, Z)  scale(a, S)  scale(a, X, Y, Z)\n"
    "  rotate(a, AXIS_X, AXIS_Y, AXIS_Z, DEGREES)  mirror(a, X, Y, Z)\n"
    "  matrix(a, 12 numbers, row by row)  flip(a): faces turned round\n"
    "  half(x < 5)  half(z > -1)  half(9 numbers: three points of a plane)\n"
    "  box(X, Y, Z)  sphere(R)  cylinder(R, H)  cone(R1, R2, H)\n"
    "  torus(R, TUBE_R): of 32 segments, or of as many as one more number "
    "says\n"
    "  hull(X, Y, Z, X, Y, Z, ...)\n"
    "  union(a, b, ...)  intersection(...)  difference(...)  also of lists\n"
    "Numbers have + - * /, sin, cos, sqrt, min, max ...; lists are [a, b] and "
    "[for i in\nrange(5): a]. A script has lines `name = expression` and `def "
    "name(x) = expression`;\nthe last one is the result. `#` begins a comment. "
    "A .csg that OpenSCAD exported is\nread as a script, too.\n\n"
    "All must be closed, faces outwards; `halfspace info` tells. Files of "
    "different\nunits are brought to one that holds all.\n\n"
    "Examples:\n"
    "  halfspace csg union a.off b.off -o both.off\n"
    "  halfspace csg union *.stl -o all.off.gz\n"
    "  halfspace csg '(A - B) | C & D' A=a.off B=b.stl C=c.ply D=d.obj -o "
    "out.off\n"
    "  halfspace csg 'A & half(z < 2.5)' A=part.stl -o lower.stl\n"
    "  halfspace csg --script machine.csg -o machine.off --stats -";

}  // namespace

void add_csg(CLI::App& program, Status& status) {
  CLI::App* app = program.add_subcommand(
      "csg", "Booleans of closed solids: an expression, or a script");
  const auto arguments = std::make_shared<CsgArguments>();
  app->add_option("EXPRESSION", arguments->words,
                  "What to work out, and NAME=FILE for each of its names; or "
                  "union, intersection, difference or symmetric-difference, "
                  "and two files or more; - is standard input")
      ->type_name("");
  app->add_option("-o,--output", arguments->output,
                  "The result: " + io::format_names() +
                      ", .scene, .step (faces of planes), or exactly .hsolid, "
                      "gzipped if it ends in "
                      ".gz; - is standard output")
      ->required()
      ->type_name("OUT");
  add_choice(*app, "--format", kFormatWords, arguments->format,
             "The format of the result where OUT is -, standard output; "
             "hsolid-text is the form of .hsolid that people can read");
  app->add_option("--script", arguments->script,
                  "Read the statements in this file instead")
      ->type_name("FILE");
  app->add_option("--origin", arguments->origin,
                  "Write which polygon of which solid each polygon of the "
                  "result comes from")
      ->type_name("FILE");
  app->add_flag("--keep-origin", arguments->keep_origin,
                "Note that in the result, too: in PLY, 3MF and GLB");
  add_choice(*app, "--merge", kMergeWords, arguments->merge,
             "Which faces in one plane become one: parts of one polygon "
             "(without this option), those of one colour, all, or none");
  app->add_flag("--strict", arguments->strict,
                "Do not write a result of which rounding lost a face or a part "
                "of the surface");
  add_parsed(*app, "--max-move", "DISTANCE", "a number of at least 0",
             arguments->max_move, parse_distance,
             "Do not write a result of which rounding moves the surface "
             "farther, along an axis");
  app->add_flag("--repair", arguments->repair,
                "Keep what a surface that crosses itself winds round at least "
                "once, instead of refusing it");
  app->add_flag("--trust", arguments->trust,
                "Do not look whether surfaces cross themselves: if one does, "
                "the result may be wrong");
  add_share(*app, "--shadow", arguments->shadow,
            "Check this share of the booleans without halves at "
            "points near the surfaces, by the reference's numbers; exit "
            "status 1, and a file that shows it, if one is wrong");
  app->add_option("--shadow-file", arguments->shadow_file, "That file")
      ->type_name("FILE.txt")
      ->capture_default_str();
  add_grid_option(*app, arguments->grid_bits);
  add_build_options(*app, arguments->build, "fast");
  add_quiet_option(*app);
  app->footer(kFooter);
  app->callback([arguments, &status] { status = run_csg(*arguments); });
}

}  // namespace halfspace::tools
