#include "halfspace/csg/operands.hpp"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "halfspace/csg/closing.hpp"
#include "halfspace/csg/trimmed.hpp"
#include "halfspace/csg/volume.hpp"
#include "halfspace/fast/operand.hpp"
#include "halfspace/io/load_scene.hpp"
#include "step_map.hpp"

namespace halfspace::csg {
namespace {

/// A mesh of points alone: faces without area hold them. Import drops those,
/// but finds the grid that holds the points.
io::Mesh mesh_of_points(const std::vector<io::Number>& coordinates) {
  io::Mesh mesh;
  for (std::size_t i = 0; i < coordinates.size(); ++i) {
    const auto id = static_cast<VertexId>(i);
    mesh.vertices.push_back({coordinates[i], {}, {}});
    mesh.corners.insert(mesh.corners.end(), {id, id, id});
    mesh.first_corner.push_back(
        static_cast<std::uint32_t>(mesh.corners.size()));
  }
  return mesh;
}

void add_extent(const Extent& extent, std::vector<io::Number>& coordinates) {
  coordinates.insert(coordinates.end(),
                     {extent.step, extent.least, extent.greatest});
}

/// The polygons of moved points that rounding may have bent, imported anew.
Result<io::Imported> imported_again(const SceneData& data) {
  io::Mesh mesh;
  for (const GridPoint& p : data.vertices) {
    mesh.vertices.push_back({io::normalised(p.x, 0, 0),
                             io::normalised(p.y, 0, 0),
                             io::normalised(p.z, 0, 0)});
  }
  mesh.first_corner = data.first_corner;
  mesh.corners = data.corners;
  mesh.face_colors.assign(data.colors.begin(), data.colors.end());
  return io::import_scene(mesh, {});
}

}  // namespace

fast::Solid numbered(fast::Solid solid,
                     const std::vector<PolygonId>& polygons) {
  for (fast::Face& face : solid.faces)
    face.polygon = polygons[static_cast<std::size_t>(face.polygon)];
  return solid;
}

/// Whether the surface must be repaired; an error if that is not wanted.
Result<bool> Operands::needs_repair(
    const GridSolid& solid, const std::vector<PolygonId>& polygons) const {
  if (solid.scene().polygon_count() == 0) return false;
  if (!options_.find_crossings) {
    // What is found without a search.
    const std::string volume = exact_volume(solid.scene());
    if (volume != "0" && volume.front() != '-') return false;
    return Error{ErrorCode::kInsideOut,
                 volume == "0"
                     ? "the surface holds nothing: its volume is 0"
                     : "the surface is inside out: its volume is " + volume};
  }
  const Result<Done> fine =
      fast::check_operand(numbered(fast::to_solid(solid), polygons));
  if (fine || options_.repair) return !fine;
  Error error = fine.error();
  error.message += " (" + options_.repair_word + " keeps what it winds round)";
  return error;
}

Scene Operands::closed(Scene scene) {
  ClosedScene result = closed_on_lines(std::move(scene));
  corners_added_ += result.added;
  return std::move(result.scene);
}

Result<Done> Operands::read_files() {
  for (const File& file : script_->files) {
    std::string path = file.path;
    if (file.name.empty() && !options_.folder.empty())
      path = (std::filesystem::path(options_.folder) / path).string();
    Result<io::LoadedScene> loaded = io::load_scene(path, {});
    if (!loaded) return loaded.error();
    Result<Scene> scene = make_scene(trimmed(loaded->file.scene));
    if (!scene) return io::error_about(path, scene.error());
    *scene = closed(*std::move(scene));
    const Result<GridSolid> solid = make_solid(*scene);
    if (!solid) return io::error_about(path, solid.error());
    const Result<bool> repairs = needs_repair(*solid, loaded->polygons);
    if (!repairs) return io::error_about(path, repairs.error());
    const io::ImportReport& report = loaded->report;
    report_.vertices += report.vertices;
    report_.polygons += report.polygons;
    report_.moved += report.moved;
    report_.max_move = std::max(report_.max_move, report.max_move);
    report_.triangulated += report.triangulated;
    report_.dropped += report.dropped;
    sources_.push_back({std::move(path), *std::move(scene),
                        std::move(loaded->polygons), *repairs});
  }
  return Done{};
}

Result<Done> Operands::choose_grid() {
  std::vector<io::Number> coordinates;
  bool decimal = true;
  for (const Leaf& leaf : plan_->leaves) {
    const Scene& scene = sources_[static_cast<std::size_t>(leaf.file)].scene;
    if (scene.polygon_count() == 0) continue;
    decimal = decimal && scene.unit().base == 10;
    const StepMap map = step_map(
        plan_->matrices[static_cast<std::size_t>(leaf.matrix)], scene.unit());
    add_extent(extent_of(map, scene.data().vertices), coordinates);
  }
  for (const Plane& plane : plan_->planes) {
    for (const Numbers3& point : plane.points)
      coordinates.insert(coordinates.end(), point.begin(), point.end());
  }
  io::Mesh mesh = mesh_of_points(coordinates);
  mesh.decimal = decimal;
  Result<io::Imported> imported =
      io::import_scene(mesh, {.grid_bits = options_.grid_bits});
  // What is moved and cannot be held by any grid goes to that of 40 bits. On
  // the next one, faces that rounding bent are flatter than doubles can tell
  // when the result is written.
  const bool is_moved = plan_->matrices.size() > 1;
  if (imported && imported->report.moved > 0 && is_moved && !options_.grid_bits)
    imported = io::import_scene(mesh, {.grid_bits = 40});
  if (!imported) return imported.error();
  report_.unit = imported->report.unit;
  report_.grid_bits = imported->report.grid_bits;
  return Done{};
}

Result<Operands> Operands::load(const Script& script, const Plan& plan,
                                const OperandOptions& options) {
  Operands operands(script, plan, options);
  const Result<Done> read = operands.read_files();
  if (!read) return read.error();
  const Result<Done> chosen = operands.choose_grid();
  if (!chosen) return chosen.error();
  return operands;
}

const Operands::Source& Operands::source_of(std::int32_t leaf) const {
  const auto file = plan_->leaves[static_cast<std::size_t>(leaf)].file;
  return sources_[static_cast<std::size_t>(file)];
}

std::size_t Operands::polygon_count(std::int32_t leaf) const {
  return source_of(leaf).scene.polygon_count();
}

const std::string& Operands::path_of(std::int32_t leaf) const {
  return source_of(leaf).path;
}

std::string Operands::name_of(std::int32_t leaf) const {
  const Leaf& at = plan_->leaves[static_cast<std::size_t>(leaf)];
  const File& file = script_->files[static_cast<std::size_t>(at.file)];
  return file.name.empty() ? file.path : file.name;
}

/// Makes `polygons` those in the file that the scene's are parts of.
Result<Scene> Operands::moved_scene(const Leaf& leaf,
                                    std::vector<PolygonId>& polygons) {
  const Source& source = sources_[static_cast<std::size_t>(leaf.file)];
  const Scene& scene = source.scene;
  polygons = source.polygons;
  const Matrix& matrix = plan_->matrices[static_cast<std::size_t>(leaf.matrix)];
  PlacedPoints moved = placed(step_map(matrix, scene.unit()),
                              scene.data().vertices, report_.unit);
  SceneData data = scene.data();
  data.unit = report_.unit;
  data.grid_bits = report_.grid_bits;
  data.vertices = std::move(moved.points);
  if (determinant_sign(matrix) < 0) {
    for (std::size_t p = 0; p < scene.polygon_count(); ++p) {
      std::reverse(data.corners.begin() + data.first_corner[p],
                   data.corners.begin() + data.first_corner[p + 1]);
    }
  }
  if (moved.moved == 0) return make_scene(std::move(data));
  report_.moved += moved.moved;
  report_.max_move = std::max(report_.max_move, moved.max_move);
  Result<io::Imported> again = imported_again(data);
  if (!again) return again.error();
  if (again->scene.polygon_count() == 0) {
    return Error{ErrorCode::kOutOfRange,
                 "nothing is left of it on the grid of " +
                     io::to_string(report_.unit) +
                     ", which reaches as far as the farthest of the solids"};
  }
  report_.triangulated += again->report.triangulated;
  report_.dropped += again->report.dropped;
  polygons = std::move(again->faces);
  for (PolygonId& p : polygons)
    p = source.polygons[static_cast<std::size_t>(p)];
  data = again->scene.data();
  data.unit = report_.unit;
  data.grid_bits = report_.grid_bits;
  return make_scene(std::move(data));
}

Error Operands::nothing_left(std::int32_t leaf) const {
  return io::error_about(
      path_of(leaf),
      {ErrorCode::kInsideOut,
       options_.repair_word +
           " leaves nothing of it: its surface winds round no place as it "
           "should, so it is empty or inside out"});
}

Result<GridSolid> Operands::leaf(std::int32_t id) {
  const Leaf& leaf = plan_->leaves[static_cast<std::size_t>(id)];
  const auto located = [&](Error error) {
    // The first matrix moves nothing.
    error.message = (leaf.matrix == 0 ? "as it stands at " : "as moved at ") +
                    to_string(leaf.place) + ": " + error.message;
    return io::error_about(path_of(id), std::move(error));
  };
  const std::size_t moved_before = report_.moved;
  std::vector<PolygonId>& polygons = polygons_[static_cast<std::size_t>(id)];
  Result<Scene> scene = moved_scene(leaf, polygons);
  if (!scene) return located(scene.error());
  Result<GridSolid> solid = make_solid(closed(*std::move(scene)));
  if (!solid) return located(solid.error());
  // An exact map makes no new crossings.
  bool repairs = source_of(id).to_repair;
  if (report_.moved != moved_before) {
    const Result<bool> found = needs_repair(*solid, polygons);
    if (!found) return located(found.error());
    repairs = *found;
  }
  repair_[static_cast<std::size_t>(id)] = repairs;
  return solid;
}

Result<std::array<GridPoint, 3>> Operands::plane(std::int32_t id) {
  const Plane& plane = plan_->planes[static_cast<std::size_t>(id)];
  std::array<GridPoint, 3> points;
  for (std::size_t i = 0; i < 3; ++i) {
    const PlacedPoints at =
        placed(step_map(translation(plane.points[i]), report_.unit),
               std::array{GridPoint{0, 0, 0}}, report_.unit);
    points[i] = at.points.front();
    report_.moved += at.moved;
    report_.max_move = std::max(report_.max_move, at.max_move);
  }
  // A scene of one triangle is valid if they are not on a line.
  SceneData data;
  data.grid_bits = report_.grid_bits;
  data.vertices.assign(points.begin(), points.end());
  data.corners = {0, 1, 2};
  data.first_corner = {0, 3};
  data.colors.resize(1);
  if (make_scene(std::move(data))) return points;
  return error_at(plane.place, ErrorCode::kZeroArea,
                  "on the grid of " + io::to_string(report_.unit) +
                      " that the solids need, the plane's three points are on "
                      "one line; choose them farther apart");
}

GridSolid Operands::nothing() const {
  SceneData data;
  data.unit = report_.unit;
  data.grid_bits = report_.grid_bits;
  Result<Scene> scene = make_scene(std::move(data));
  if (!scene) return {};
  Result<GridSolid> solid = make_solid(*std::move(scene));
  return solid ? *std::move(solid) : GridSolid();
}

}  // namespace halfspace::csg
