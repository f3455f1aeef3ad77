#include <CLI/App.hpp>
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/command.hpp"
#include "cli/json_number.hpp"
#include "cli/loading.hpp"
#include "halfspace/boolean.hpp"
#include "halfspace/csg/closing.hpp"
#include "halfspace/csg/exact.hpp"
#include "halfspace/csg/exact_measure.hpp"
#include "halfspace/csg/fault.hpp"
#include "halfspace/csg/measure.hpp"
#include "halfspace/csg/operands.hpp"
#include "halfspace/csg/volume.hpp"
#include "halfspace/fast/check_operand.hpp"
#include "halfspace/fast/solid_data.hpp"

namespace halfspace::tools {
namespace {

struct InfoArguments {
  std::vector<std::string> paths;
  std::optional<int> grid_bits;
  bool exact = false;
  bool check = false;
  bool json = false;
};

/// The solid of an exact file, of which the scene is the rounded surface.
struct ExactFile {
  SolidData data;
  fast::Solid solid;
};

/// All that is known of one file.
struct Facts {
  const std::string& path;
  const io::LoadedScene& loaded;
  const std::optional<ExactFile>& exact;
  csg::Measures measures;
  std::size_t bad_edges = 0;
  std::size_t corners_added = 0;  ///< with which it is closed
  std::string exact_volume;       ///< of a closed surface, where asked for
  bool is_checked = false;        ///< by --check
  std::optional<Error> fault;  ///< found by it: why the surface is no solid's

  const Scene& scene() const { return loaded.file.scene; }
  bool is_closed() const { return bad_edges == 0 || corners_added != 0; }
};

/// Of data that have become a surface already.
Result<std::optional<ExactFile>> exact_file(std::optional<SolidData> data) {
  if (!data) return std::optional<ExactFile>();
  Result<fast::Solid> solid = fast::to_solid(*data);
  if (!solid) return solid.error();
  return std::optional(ExactFile{*std::move(data), *std::move(solid)});
}

/// Why the surface of the file is no solid's, if it is none's.
std::optional<Error> fault_of(const Facts& facts, Scene scene) {
  if (facts.exact) {
    SolidData unchecked = facts.exact->data;
    unchecked.is_checked = false;
    const Result<fast::Solid> checked = csg::checked_solid(unchecked);
    if (!checked) return checked.error();
    return std::nullopt;
  }
  const Result<GridSolid> solid = make_solid(std::move(scene));
  if (!solid) return csg::open_error(facts.scene(), facts.loaded.polygons);
  const Result<Done> fine = fast::check_operand(
      csg::numbered(fast::to_solid(*solid), facts.loaded.polygons));
  if (!fine) return fine.error();
  return std::nullopt;
}

Facts facts_of(const std::string& path, const io::LoadedScene& loaded,
               const std::optional<ExactFile>& exact,
               const InfoArguments& arguments) {
  Facts facts{path, loaded, exact, {}, 0, 0, {}, false, {}};
  Scene scene = loaded.file.scene;
  facts.bad_edges = bad_edges(scene).size();
  if (facts.bad_edges != 0) {
    csg::ClosedScene closed = csg::closed_on_lines(std::move(scene));
    facts.corners_added = closed.added;
    scene = std::move(closed.scene);
  }
  facts.measures = csg::measures_of(scene);
  if (exact) {
    // A sum over many meets has as many digits as all of them have.
    if (arguments.exact || exact->data.meets.empty())
      facts.exact_volume = csg::exact_volume_of(exact->solid);
  } else if (facts.is_closed()) {
    facts.exact_volume = csg::exact_volume(scene);
  }
  facts.is_checked = arguments.check;
  if (arguments.check) facts.fault = fault_of(facts, std::move(scene));
  return facts;
}

std::pair<std::size_t, std::size_t> corner_range(const Scene& scene) {
  std::size_t least = SIZE_MAX;
  std::size_t most = 0;
  const auto count = static_cast<PolygonId>(scene.polygon_count());
  for (PolygonId p = 0; p < count; ++p) {
    least = std::min(least, scene.corners(p).size());
    most = std::max(most, scene.corners(p).size());
  }
  return {least, most};
}

void print_faces(const SolidData& data) {
  say("faces      {}\n", data.faces.size());
  say("vertices   {}", data.points.size() + data.meets.size());
  if (!data.meets.empty())
    say(", {} of them where three planes meet", data.meets.size());
  say("\nplanes     {}\n", data.planes.size());
  say("grid       {} bits of {}\n", data.grid_bits, io::to_string(data.unit));
}

void print_polygons(const Scene& scene) {
  say("polygons   {}", scene.polygon_count());
  if (scene.polygon_count() > 0) {
    const auto [least, most] = corner_range(scene);
    say(" of {} to {} corners", least, most);
  }
  say("\nvertices   {}\n", scene.data().vertices.size());
  say("colours    {}\n", scene.data().corner_colors.empty()
                             ? "one a polygon"
                             : "at the corners, and one a polygon");
  say("grid       {} bits of {}\n", scene.grid_bits(),
      io::to_string(scene.unit()));
}

using Triple = std::array<double, 3>;

/// The sizes of the box's edges. Units: steps.
Triple size_of(const csg::Measures& m) {
  return {m.most[0] - m.least[0], m.most[1] - m.least[1],
          m.most[2] - m.least[2]};
}

/// Three lengths in steps, as text in model units.
std::string triple_text(const csg::Measures& m, const Triple& v,
                        const char* between) {
  constexpr int kDigits = 9;
  std::string text;
  for (const double steps : v) {
    if (!text.empty()) text += between;
    text += csg::to_string(m.in_units(steps), kDigits);
  }
  return text;
}

/// The corners of the box in grid steps, which are exact.
void print_exact_box(const Scene& scene) {
  const auto& corners = scene.data().corners;
  GridPoint low = scene.point(corners.front());
  GridPoint high = low;
  for (const VertexId corner : corners) {
    const GridPoint& v = scene.point(corner);
    low = {std::min(low.x, v.x), std::min(low.y, v.y), std::min(low.z, v.z)};
    high = {std::max(high.x, v.x), std::max(high.y, v.y),
            std::max(high.z, v.z)};
  }
  const std::string unit = io::to_string(scene.unit());
  say("from       {}, {}, {} times {}\n", low.x, low.y, low.z, unit);
  say("to         {}, {}, {} times {}\n", high.x, high.y, high.z, unit);
}

void print_bounds(const fast::Solid& solid) {
  const auto [low, high] = csg::exact_bounds_of(solid);
  say("from       {}, {}, {}\n", low[0], low[1], low[2]);
  say("to         {}, {}, {}\n", high[0], high[1], high[2]);
}

void print_box(const Facts& facts, bool exact) {
  if (facts.scene().polygon_count() == 0) return;
  const csg::Measures& m = facts.measures;
  if (exact && facts.exact) {
    print_bounds(facts.exact->solid);
  } else if (exact) {
    print_exact_box(facts.scene());
  } else {
    say("from       {}\n", triple_text(m, m.least, ", "));
    say("to         {}\n", triple_text(m, m.most, ", "));
  }
  say("size       {}\n", triple_text(m, size_of(m), " x "));
  say("area       {}\n", csg::to_string(m.in_units(m.area, 2), 9));
  say("centre     {}\n", triple_text(m, m.centre, ", "));
}

/// The volume as a short decimal, or exactly.
std::string volume_text(const Facts& facts, bool exact) {
  constexpr std::size_t kShort = 20;
  const std::string& volume = facts.exact_volume;
  const bool is_short = !volume.empty() && volume.size() <= kShort &&
                        volume.find('/') == std::string::npos;
  const csg::Measures& m = facts.measures;
  return exact || is_short ? volume
                           : csg::to_string(m.in_units(m.volume, 3), 12);
}

void print_components(const std::vector<csg::Component>& components) {
  constexpr std::size_t kMostShown = 10;
  say("components {}", components.size());
  const std::size_t shown = std::min(components.size(), kMostShown);
  for (std::size_t i = 0; i < shown; ++i) {
    const auto& genus = components[i].genus;
    say("{}{}", i == 0 ? " (genus " : ", ",
        genus ? std::to_string(*genus) : "unknown");
  }
  say("{}\n", components.empty()          ? ""
              : shown < components.size() ? ", ...)"
                                          : ")");
}

void print_surface(const Facts& facts, bool exact) {
  if (!facts.is_closed()) {
    say("surface    not closed: {} bad edges\n", facts.bad_edges);
  } else {
    say("surface    closed");
    if (facts.corners_added != 0) {
      say(", but for {} corners where vertices lie within edges",
          facts.corners_added);
    }
    say("\nvolume     {}\n", volume_text(facts, exact));
  }
  print_components(facts.measures.components);
  if (facts.is_checked) {
    say("solid      {}\n", facts.fault
                               ? "no: " + one_line(facts.fault->message)
                               : "yes: it crosses itself nowhere, and faces "
                                 "outwards");
  }
}

void print_camera(const SceneFile& file) {
  if (!file.camera) return;
  const CameraData& camera = file.camera->data();
  say("camera     {}, {}x{} pixels\n",
      camera.perspective ? "perspective" : "orthographic", camera.width_px,
      camera.height_px);
}

void print_facts(const Facts& facts, const InfoArguments& arguments) {
  say("file       {}\n", one_line(facts.path));
  if (facts.exact) {
    print_faces(facts.exact->data);
  } else {
    print_polygons(facts.scene());
  }
  print_box(facts, arguments.exact);
  if (!facts.loaded.is_scene_file && !facts.exact) {
    say("mesh       {} polygons, {} vertices\n", facts.loaded.report.polygons,
        facts.loaded.report.vertices);
    say("import     {}\n", to_string(facts.loaded.report));
  }
  print_surface(facts, arguments.exact);
  print_camera(facts.loaded.file);
}

/// The code of a surface that is no solid's, as the packages for Python and the
/// web name it.
std::string code_name(ErrorCode code) {
  if (code == ErrorCode::kOpen) return "OPEN";
  if (code == ErrorCode::kSelfCrossing) return "SELF_CROSSING";
  if (code == ErrorCode::kInsideOut) return "INSIDE_OUT";
  return std::string(to_string(code));
}

/// Three lengths in steps, in model units.
nlohmann::json triple_json(const csg::Measures& m, const Triple& v) {
  return {json_of(m.in_units(v[0])), json_of(m.in_units(v[1])),
          json_of(m.in_units(v[2]))};
}

/// The measures of the solid itself, not of its rounded surface.
void add_measures(const fast::Solid& solid, nlohmann::ordered_json& json) {
  json["area"] = csg::area_of(solid);
  json["volume"] = csg::volume_of(solid);
  if (solid.faces.empty()) return;
  const auto [low, high] = csg::bounds_of(solid);
  for (std::size_t i = 0; i < 3; ++i) {
    json["from"][i] = low[i];
    json["to"][i] = high[i];
    json["size"][i] = high[i] - low[i];
  }
}

nlohmann::ordered_json facts_json(const Facts& facts) {
  const Scene& scene = facts.scene();
  const csg::Measures& m = facts.measures;
  const io::ImportReport& report = facts.loaded.report;
  nlohmann::ordered_json json = {
      {"file", facts.path},
      {"polygons", scene.polygon_count()},
      {"vertices", scene.data().vertices.size()},
      {"corner_colors", !scene.data().corner_colors.empty()},
      {"grid_bits", scene.grid_bits()},
      {"unit", io::to_string(scene.unit())},
      {"from", triple_json(m, m.least)},
      {"to", triple_json(m, m.most)},
      {"size", triple_json(m, size_of(m))},
      {"area", json_of(m.in_units(m.area, 2))},
      {"centre", triple_json(m, m.centre)},
      {"import",
       {{"polygons", report.polygons},
        {"vertices", report.vertices},
        {"moved", report.moved},
        {"max_move", report.max_move},
        {"triangulated", report.triangulated},
        {"dropped", report.dropped}}},
      {"closed", facts.is_closed()},
      {"bad_edges", facts.bad_edges},
      {"corners_added", facts.corners_added}};
  if (facts.exact) {
    const SolidData& data = facts.exact->data;
    json["polygons"] = data.faces.size();
    json["vertices"] = data.points.size() + data.meets.size();
    json["planes"] = data.planes.size();
    json["points"] = data.points.size();
    json["meets"] = data.meets.size();
    json["grid_bits"] = data.grid_bits;
    json["unit"] = io::to_string(data.unit);
    json.erase("import");
  }
  if (facts.is_closed()) json["volume"] = json_of(m.in_units(m.volume, 3));
  if (facts.exact && !facts.exact_volume.empty())
    add_measures(facts.exact->solid, json);
  if (!facts.exact_volume.empty()) json["exact_volume"] = facts.exact_volume;
  json["components"] = nlohmann::ordered_json::array();
  for (const csg::Component& part : m.components) {
    nlohmann::ordered_json component = {{"polygons", part.polygons}};
    if (facts.is_closed())
      component["volume"] = json_of(m.in_units(part.volume, 3));
    component["genus"] = part.genus ? nlohmann::ordered_json(*part.genus)
                                    : nlohmann::ordered_json();
    json["components"].push_back(std::move(component));
  }
  if (facts.is_checked) json["solid"] = !facts.fault;
  if (facts.fault) {
    json["code"] = code_name(facts.fault->code);
    json["fault"] = facts.fault->message;
    if (facts.fault->index >= 0) json["polygon"] = facts.fault->index;
  }
  return json;
}

Status run_info(const InfoArguments& arguments) {
  auto all = nlohmann::ordered_json::array();
  for (const std::string& path : arguments.paths) {
    std::optional<SolidData> data;
    const Result<io::LoadedScene> loaded =
        load_with_solid(path, {.grid_bits = arguments.grid_bits}, data);
    if (!loaded) return fail(path, loaded.error());
    const Result<std::optional<ExactFile>> exact = exact_file(std::move(data));
    if (!exact) return fail(path, exact.error());
    const Facts facts = facts_of(path, *loaded, *exact, arguments);
    if (arguments.json) {
      all.push_back(facts_json(facts));
      continue;
    }
    if (path != arguments.paths.front()) say("\n");
    print_facts(facts, arguments);
  }
  // Names of files may be in any encoding.
  if (arguments.json) {
    print(all.dump(2, ' ', false,
                   nlohmann::ordered_json::error_handler_t::replace) +
          "\n");
  }
  return Status::kFine;
}

}  // namespace

void add_info(CLI::App& program, Status& status) {
  CLI::App* app = program.add_subcommand(
      "info",
      "Show what is in a file, its measures, and what import did to it");
  const auto arguments = std::make_shared<InfoArguments>();
  app->add_option("FILE", arguments->paths, "Meshes or scenes")
      ->required()
      ->type_name("");
  app->add_flag("--check", arguments->check,
                "Look whether the surface crosses itself or faces inwards, "
                "which takes a search");
  app->add_flag("--exact", arguments->exact,
                "Show the volume and the box as exact numbers; those of a "
                ".hsolid are the solid's own");
  app->add_flag("--json", arguments->json, "Show all as a JSON array");
  add_grid_option(*app, arguments->grid_bits);
  app->footer(
      "Lengths are in the model's units, which files do not name; those of "
      "3MF are\nmillimetres, of GLB and glTF metres. In JSON a number that no "
      "double is\nnear is null.\n\n"
      "Examples:\n"
      "  halfspace info part.stl\n"
      "  halfspace info *.stl --json\n"
      "  halfspace info part.stl --check --exact");
  app->callback([arguments, &status] { status = run_info(*arguments); });
}

}  // namespace halfspace::tools
