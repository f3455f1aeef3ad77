#include "commands/csg_write.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "cli/command.hpp"
#include "cli/json_number.hpp"
#include "cli/loading.hpp"
#include "cli/outputs.hpp"
#include "halfspace/csg/step_file.hpp"
#include "halfspace/io/import.hpp"
#include "halfspace/io/light_scene.hpp"
#include "halfspace/io/load_scene.hpp"
#include "halfspace/scene_file.hpp"

namespace halfspace::tools {
namespace {

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

/// The scene of the result's polygons, lit as a picture of a mesh is; `faces`
/// are those of the result that its polygons are parts of.
Scene lit(const Scene& scene, const std::vector<PolygonId>& faces,
          const csg::Outcome& result) {
  std::vector<bool> is_lit(scene.polygon_count());
  for (std::size_t p = 0; p < is_lit.size(); ++p) {
    const std::size_t face =
        faces.empty() ? p : static_cast<std::size_t>(faces[p]);
    is_lit[p] = result.color_sources[face] == csg::ColorSource::kLit;
  }
  return io::lit_scene(scene, is_lit);
}

/// Writes the result as a scene, and counts what had to be rounded.
Result<io::ExportReport> write_scene_file(const std::string& path,
                                          const csg::Outcome& result) {
  io::ExportReport report;
  SceneFile file;
  if (result.scene) {
    file.scene = lit(*result.scene, {}, result);
  } else {
    Result<io::Imported> imported = import_rounded(result.mesh);
    if (!imported) return imported.error();
    report = {.moved = result.moved + imported->report.moved,
              .max_move = result.max_move + imported->report.max_move,
              .triangulated = imported->report.triangulated};
    file.scene = lit(imported->scene, imported->faces, result);
  }
  const Result<Done> written = write_output(path, write_scene(file));
  if (!written) return written.error();
  return report;
}

/// What a format of faces' colours alone has no room for.
std::vector<std::string> lost_but_colors(const io::Attributes& attributes) {
  std::vector<std::string> words = io::words_of(attributes);
  std::erase(words, "colours of faces");
  return words;
}

std::size_t polygons_in(const CsgContext& context) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < context.plan.leaves.size(); ++i)
    count += context.operands.polygon_count(static_cast<std::int32_t>(i));
  return count;
}

}  // namespace

Result<io::ExportReport> write_result(const std::string& path,
                                      const csg::Outcome& result,
                                      SolidForm form, bool beside) {
  if (result.data && csg::is_step_name(path)) {
    const Result<std::string> text = csg::step_text(*result.data, "solid");
    if (!text) return text.error();
    const Result<Done> written = write_output(path, *text);
    if (!written) return written.error();
    return io::ExportReport();
  }
  if (result.data) {
    const Result<Done> written =
        write_output(path, write_solid(*result.data, form));
    if (!written) return written.error();
    return io::ExportReport();
  }
  if (io::is_scene_name(path)) {
    Result<io::ExportReport> report = write_scene_file(path, result);
    if (report && result.attributes)
      report->lost = lost_but_colors(*result.attributes);
    return report;
  }
  if (result.scene) {
    return io::write_scene_mesh(path, *result.scene, result.attributes.get(),
                                beside, csg::has_color(result.color_sources));
  }
  Result<io::ExportReport> report = io::write_mesh(path, result.mesh, beside);
  if (!report) return report;
  report->moved += result.moved;
  report->max_move += result.max_move;
  return report;
}

Result<Done> write_origins(const std::string& path, const CsgContext& context) {
  std::string text;
  for (std::size_t i = 0; i < context.plan.leaves.size(); ++i) {
    const auto id = static_cast<std::int32_t>(i);
    const csg::Place& place = context.plan.leaves[i].place;
    text += "solid " + std::to_string(i) + " " +
            one_line(context.operands.name_of(id)) + " (" +
            csg::to_string(place) + ") " +
            one_line(context.operands.path_of(id)) + "\n";
  }
  for (std::size_t i = 0; i < context.plan.planes.size(); ++i) {
    text += "solid " + std::to_string(context.plan.leaves.size() + i) +
            " half (" + csg::to_string(context.plan.planes[i].place) + ")\n";
  }
  for (const csg::Origin& origin : context.result.origins) {
    text += std::to_string(origin.leaf) + " " + std::to_string(origin.polygon) +
            "\n";
  }
  return write_output(path, text);
}

std::string loss_sentence(const csg::Outcome& result) {
  const csg::RoundingReport& rounding = *result.rounding;
  std::string sentence = "rounding lost " +
                         std::to_string(rounding.faces_lost) + " of " +
                         std::to_string(result.faces) + " faces";
  if (rounding.parts_before != rounding.parts_after) {
    sentence += ", and made " + std::to_string(rounding.parts_before) +
                (rounding.parts_before == 1 ? " part" : " parts") +
                " of the surface " + std::to_string(rounding.parts_after);
  }
  return sentence + ": they are thinner than the file's numbers are fine";
}

void print_notes(const std::string& name, const io::Attributes& attributes) {
  for (const std::string& note : attributes.notes)
    say("note: {}: {}\n", name, one_line(note));
}

void print_lost(const std::string& output,
                const std::vector<std::string>& lost) {
  if (lost.empty()) return;
  std::string list;
  for (const std::string& word : lost)
    list += (list.empty() ? "" : ", ") + one_line(word);
  say("warning: {} has no room for {}; PLY has\n", output, list);
}

void print_notes(const std::string& output, const io::ExportReport& report) {
  for (const std::string& note : report.notes)
    say("warning: {}: {}\n", output, one_line(note));
}

namespace {

/// What was passed over in files, and what the result's has no room for.
void print_attributes(const CsgContext& context, const io::ExportReport& report,
                      const std::string& output) {
  std::vector<std::string> lost = report.lost;
  for (std::size_t i = 0; i < context.plan.leaves.size(); ++i) {
    const auto leaf = static_cast<std::int32_t>(i);
    const io::AttributedFaces* faces = context.operands.attributed(leaf);
    if (faces == nullptr) continue;
    print_notes(context.operands.name_of(leaf), faces->attributes);
    if (!context.result.data) continue;
    for (std::string& word : lost_but_colors(faces->attributes)) {
      if (std::find(lost.begin(), lost.end(), word) == lost.end())
        lost.push_back(std::move(word));
    }
  }
  print_lost(output, lost);
  print_notes(output, report);
}

/// What is said where rounding did more than move vertices a little.
void print_rounding(const CsgContext& context) {
  if (!context.result.rounding) return;
  const csg::RoundingReport& rounding = *context.result.rounding;
  if (rounding.contacts > 0) {
    say("rounding: surfaces met in {} places; settled in {} rounds\n",
        rounding.contacts, rounding.rounds);
  }
  if (rounding.lost_any()) say("warning: {}\n", loss_sentence(context.result));
  // Rounding and one more for what meets move less.
  constexpr double kFar = 8;
  if (context.result.max_move > kFar * rounding.spacing) {
    say("warning: surfaces that nearly coincide moved by up to {:.3g}; the "
        "numbers there are {:.3g} apart\n",
        context.result.max_move, rounding.spacing);
  }
}

}  // namespace

nlohmann::json stats_of(const CsgContext& context,
                        const io::ExportReport& report) {
  const io::ImportReport& import = context.operands.report();
  const csg::Outcome& result = context.result;
  nlohmann::json stats = {{"operands", context.plan.leaves.size()},
                          {"booleans", context.plan.booleans},
                          {"polygons", polygons_in(context)},
                          {"faces", result.faces},
                          {"polygons_out", result.polygons},
                          {"bad_edges", result.bad_edges},
                          {"repaired", result.repairs.size()},
                          {"corners_added", context.operands.corners_added()},
                          {"settled", context.operands.settled_contacts()},
                          {"trusted", context.operands.are_trusted()},
                          {"volume", json_of(result.volume)},
                          {"boolean_ms", context.boolean_ms},
                          {"import",
                           {{"moved", import.moved},
                            {"max_move", import.max_move},
                            {"triangulated", import.triangulated},
                            {"dropped", import.dropped},
                            {"unit", io::to_string(import.unit)},
                            {"grid_bits", import.grid_bits}}},
                          {"export",
                           {{"moved", report.moved},
                            {"max_move", report.max_move},
                            {"triangulated", report.triangulated}}}};
  if (result.rounding) {
    const csg::RoundingReport& rounding = *result.rounding;
    stats["export"]["rounding"] = {{"spacing", rounding.spacing},
                                   {"rounds", rounding.rounds},
                                   {"contacts", rounding.contacts},
                                   {"faces_lost", rounding.faces_lost},
                                   {"parts_before", rounding.parts_before},
                                   {"parts_after", rounding.parts_after}};
  }
  if (context.checks) {
    stats["shadow_booleans"] = context.checks->operations;
    stats["shadow_checked"] = context.checks->checked;
    stats["shadow_points"] = context.checks->points;
    stats["shadow_mismatches"] = context.checks->mismatches;
  }
  return stats;
}

void print_summary(const CsgContext& context, const io::ExportReport& report,
                   const std::string& output) {
  const csg::Outcome& result = context.result;
  say("operands: {} of {} polygons; {}\n", context.plan.leaves.size(),
      polygons_in(context), to_string(context.operands.report()));
  if (context.operands.corners_added() > 0) {
    say("closed: {} corners added where vertices lay within edges\n",
        context.operands.corners_added());
  }
  if (context.operands.settled_contacts() > 0) {
    say("rounded: surfaces of operands met in {} places and were moved a "
        "little more\n",
        context.operands.settled_contacts());
  }
  if (context.operands.are_trusted()) {
    say("trusted: nobody looked whether a surface crosses itself; if one does, "
        "the result may be wrong\n");
  }
  for (const csg::Repair& repair : result.repairs) {
    const std::string crossed =
        repair.crossings
            ? std::to_string(*repair.crossings) + " pairs of polygons crossed; "
            : std::string();
    say("repaired: {}: {}{} polygons cut, {} dropped\n",
        context.operands.name_of(repair.leaf), crossed, repair.faces_cut,
        repair.faces_dropped);
  }
  if (context.checks) {
    say("shadow: {} of {} booleans checked at {} points, {} mismatches\n",
        context.checks->checked, context.checks->operations,
        context.checks->points, context.checks->mismatches);
  }
  say("result: {} polygons, closed, volume {}, {:.3f} ms\n", result.polygons,
      csg::to_string(result.volume, 12), context.boolean_ms);
  say("{}: moved {} {} (by at most {:.3g}), triangulated {}\n", output,
      report.moved, result.moved > 0 ? "vertices" : "coordinates",
      report.max_move, report.triangulated);
  print_rounding(context);
  print_attributes(context, report, output);
}

}  // namespace halfspace::tools
