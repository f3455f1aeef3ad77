#include "halfspace/csg/operands.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <limits>
#include <utility>

#include "exact/lean.hpp"
#include "halfspace/csg/closing.hpp"
#include "halfspace/csg/fault.hpp"
#include "halfspace/csg/measure.hpp"
#include "halfspace/csg/part_names.hpp"
#include "halfspace/csg/trimmed.hpp"
#include "halfspace/csg/volume.hpp"
#include "halfspace/fast/rounded_mesh.hpp"
#include "halfspace/io/file.hpp"
#include "halfspace/io/load_scene.hpp"
#include "step_map.hpp"

namespace halfspace::csg {
namespace {

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

/// The data of what was imported again, in the steps that went in: import takes
/// a longer step where that needs fewer bits.
SceneData in_single_steps(const Scene& scene) {
  SceneData data = scene.data();
  std::int64_t step = 1;
  for (int i = 0; i < data.unit.exponent; ++i) step *= data.unit.base;
  for (GridPoint& p : data.vertices) p = {p.x * step, p.y * step, p.z * step};
  return data;
}

}  // namespace

fast::Solid numbered(fast::Solid solid,
                     const std::vector<PolygonId>& polygons) {
  for (fast::Face& face : solid.faces)
    face.polygon = polygons[static_cast<std::size_t>(face.polygon)];
  return solid;
}

namespace {

/// The scene with every polygon turned round.
Scene flipped(const Scene& scene) {
  SceneData data = scene.data();
  for (std::size_t p = 0; p + 1 < data.first_corner.size(); ++p) {
    const auto begin = data.corners.begin() + data.first_corner[p];
    const auto end = data.corners.begin() + data.first_corner[p + 1];
    std::reverse(begin, end);
    if (data.corner_colors.empty()) continue;
    std::reverse(data.corner_colors.begin() + data.first_corner[p],
                 data.corner_colors.begin() + data.first_corner[p + 1]);
  }
  return *make_scene(std::move(data));
}

/// Which parts of the surface face inwards, and what to do.
std::string inside_out_advice(const Scene& scene) {
  const std::vector<Component> parts = measures_of(scene).components;
  const auto inwards = static_cast<std::size_t>(
      std::count_if(parts.begin(), parts.end(),
                    [](const Component& part) { return part.volume < 0; }));
  const std::string share = std::to_string(inwards) + " of its " +
                            std::to_string(parts.size()) + " components";
  if (inwards == parts.size()) {
    return "; so do all of its components: flip(...) in an expression turns "
           "its faces round";
  }
  return "; " + share + " face inwards, and are not in the solid of another";
}

/// The error, and what mends such faults.
Error with_advice(Error error, const OperandOptions& options) {
  if (!options.mending_word.empty())
    error.message += " (" + options.mending_word + " mends such surfaces)";
  return error;
}

/// What there is to know of a surface before it is used.
struct Checked {
  bool to_repair = false;
  LeanSurface lean;
};

/// Whether the surface must be repaired; an error if that is not wanted.
Result<Checked> checked(const GridSolid& solid,
                        const std::vector<PolygonId>& polygons,
                        const OperandOptions& options) {
  if (solid.scene().polygon_count() == 0) return Checked{};
  if (!options.find_crossings) {
    // What is found without a search.
    const std::string volume = exact_volume(solid.scene());
    if (volume != "0" && volume.front() != '-') return Checked{};
    return Error{
        ErrorCode::kInsideOut,
        volume == "0"
            ? "the surface holds nothing: its volume is 0"
            : "the surface is inside out: its volume is " + volume +
                  "; flip(...) in an expression turns its faces round"};
  }
  fast::Solid made = numbered(fast::to_solid(solid), polygons);
  const Result<Done> fine = fast::check_operand(made, options.check);
  if (!fine && fine.error().code == ErrorCode::kStopped) return fine.error();
  if (fine || options.repair)
    return Checked{!fine, options.find_coplanar
                              ? lean_surface(std::move(made), solid.scene())
                              : LeanSurface{}};
  Error error = fine.error();
  // Resolution would keep nothing of a surface that faces inwards.
  if (error.code == ErrorCode::kSelfCrossing) {
    error.message += " (" + options.repair_word + " keeps what it winds round)";
  } else if (error.code == ErrorCode::kInsideOut) {
    error.message += inside_out_advice(solid.scene());
    return with_advice(std::move(error), options);
  }
  return error;
}

Result<bool> needs_repair(const GridSolid& solid,
                          const std::vector<PolygonId>& polygons,
                          const OperandOptions& options) {
  const Result<Checked> found = checked(solid, polygons, options);
  if (!found) return found.error();
  return found->to_repair;
}

}  // namespace

Scene Operands::closed(Scene scene) {
  ClosedScene result = closed_on_lines(std::move(scene));
  corners_added_ += result.added;
  return std::move(result.scene);
}

Result<Source> closed_source(const std::string& path, Scene scene,
                             const io::Imported& imported) {
  Source source;
  source.path = path;
  source.polygons = imported.faces;
  source.report = imported.report;
  source.has_color = imported.has_color;
  ClosedScene closed = closed_on_lines(std::move(scene));
  source.corners_added = closed.added;
  source.scene = std::move(closed.scene);
  if (closed.is_open) return open_error(source.scene, source.polygons);
  Result<GridSolid> solid = make_solid(source.scene);
  if (!solid) return open_error(source.scene, source.polygons);
  const Extent extent =
      extent_of(step_map(identity_matrix(), source.scene.unit()),
                source.scene.data().vertices);
  source.need = {extent.step, extent.least, extent.greatest};
  source.solid = std::make_shared<const GridSolid>(*std::move(solid));
  return source;
}

Result<Source> make_source(const std::string& path,
                           const io::Imported& imported,
                           const OperandOptions& options) {
  Result<Scene> scene = make_scene(trimmed(imported.scene));
  if (!scene) return io::error_about(path, scene.error());
  Result<Source> source = closed_source(path, *std::move(scene), imported);
  if (!source)
    return io::error_about(path, with_advice(source.error(), options));
  const Result<Checked> found =
      checked(*source->solid, source->polygons, options);
  if (!found) return io::error_about(path, found.error());
  source->to_repair = found->to_repair;
  source->is_lean = found->lean.is_lean;
  source->lean = found->lean.solid;
  source->lean_polygons = found->lean.polygons;
  return source;
}

namespace {

/// By origin whether a face of it has a colour; empty: none has.
std::vector<bool> colored_origins(const SolidData& data) {
  std::vector<bool> colored(data.origins.size());
  for (const SolidData::Face& face : data.faces) {
    if (face.has_color) colored[face.origin] = true;
  }
  return colored;
}

}  // namespace

/// The source that the bytes of a `.hsolid` file are.
Result<Source> exact_source(const std::string& path, std::string_view bytes,
                            const OperandOptions& options, bool flip) {
  Result<SolidData> data = read_solid(bytes);
  if (!data) return io::error_about(path, data.error());
  if (flip) *data = flipped(*std::move(data));
  Source source;
  source.path = path;
  source.report.polygons = data->faces.size();
  source.report.unit = data->unit;
  source.report.grid_bits = data->grid_bits;
  if (!data->is_checked && options.find_crossings) {
    const Result<fast::Solid> fine = checked_solid(*data, options.check);
    const auto code = fine ? ErrorCode::kEmpty : fine.error().code;
    source.to_repair = options.repair && (code == ErrorCode::kSelfCrossing ||
                                          code == ErrorCode::kInsideOut);
    if (!fine && !source.to_repair) return io::error_about(path, fine.error());
  }
  for (SolidData::Face& face : data->faces) {
    if (!face.has_color) face.color = io::kUsualSurface;
  }
  source.has_color = colored_origins(*data);
  source.exact = std::make_shared<const SolidData>(*std::move(data));
  return source;
}

namespace {

/// Reads a source; `read`, if not null, is the scene in it, and is taken.
Result<Source> read_or_taken(const std::string& path,
                             const OperandOptions& options, bool flip,
                             Result<io::LoadedScene>* read) {
  std::string input;
  if (path == "-") {
    Result<std::string> bytes = io::read_input();
    if (!bytes) return bytes.error();
    if (is_solid_file(*bytes))
      return exact_source(io::kInputName, *bytes, options, flip);
    input = *std::move(bytes);
  }
  if (io::is_solid_name(path)) {
    const Result<std::string> bytes = io::read_file(path);
    if (!bytes) return io::error_about(path, bytes.error());
    return exact_source(path, *bytes, options, flip);
  }
  Result<io::LoadedScene> loaded =
      path == "-"       ? io::scene_of_input(input, io::unlit())
      : read != nullptr ? std::move(*read)
                        : io::load_scene(path, io::unlit());
  if (!loaded) return loaded.error();
  if (flip) loaded->file.scene = flipped(loaded->file.scene);
  Result<Source> source = make_source(path,
                                      {std::move(loaded->file.scene),
                                       std::move(loaded->polygons),
                                       loaded->report,
                                       {},
                                       std::move(loaded->has_color)},
                                      options);
  if (!source) return source;
  source->attributed = std::move(loaded->attributed);
  source->is_lit = loaded->is_scene_file;
  return source;
}

}  // namespace

Result<Source> read_source(const std::string& path,
                           const OperandOptions& options, bool flip) {
  return read_or_taken(path, options, flip, nullptr);
}

Result<Source> primitive_source(const std::string& name, const io::Mesh& mesh,
                                const OperandOptions& options) {
  Result<io::Imported> imported = io::import_scene(mesh, io::unlit());
  if (!imported) return io::error_about(name, imported.error());
  return make_source(name, *imported, options);
}

Result<Operands> Operands::load(const Script& script, const Plan& plan,
                                const OperandOptions& options) {
  std::vector<std::shared_ptr<const Source>> sources;
  std::vector<bool> is_used(script.files.size());
  for (const Leaf& leaf : plan.leaves)
    is_used[static_cast<std::size_t>(leaf.file)] = true;
  const auto path_of = [&](const File& file) {
    return file.name.empty() && !options.folder.empty()
               ? (std::filesystem::path(options.folder) / file.path).string()
               : file.path;
  };
  // Meshes are read side by side, and looked at one after another.
  std::vector<std::size_t> meshes;
  std::vector<std::string> paths;
  for (std::size_t i = 0; i < script.files.size(); ++i) {
    const File& file = script.files[i];
    if (!is_used[i] || file.mesh || file.path == "-" ||
        io::is_solid_name(file.path))
      continue;
    meshes.push_back(i);
    paths.push_back(path_of(file));
  }
  std::vector<Result<io::LoadedScene>> scenes =
      io::load_scenes(paths, io::unlit(), options.check.threads);
  std::size_t taken = 0;
  for (std::size_t i = 0; i < script.files.size(); ++i) {
    const File& file = script.files[i];
    if (!is_used[i]) {
      sources.push_back(std::make_shared<const Source>());
      continue;
    }
    const std::string path = path_of(file);
    // Standard input is read once, whatever names it has.
    const auto is_same_input = [&](const File& other) {
      return path == "-" && other.path == path &&
             other.is_flipped == file.is_flipped;
    };
    const auto first = static_cast<std::size_t>(
        std::find_if(script.files.begin(),
                     script.files.begin() + static_cast<std::ptrdiff_t>(i),
                     is_same_input) -
        script.files.begin());
    if (first < i && is_used[first]) {
      sources.push_back(sources[first]);
      continue;
    }
    Result<io::LoadedScene>* const read =
        taken < meshes.size() && meshes[taken] == i ? &scenes[taken++]
                                                    : nullptr;
    Result<Source> source =
        file.mesh ? primitive_source(file.name, *file.mesh, options)
                  : read_or_taken(path, options, file.is_flipped, read);
    if (!source) return source.error();
    sources.push_back(std::make_shared<const Source>(*std::move(source)));
  }
  return join(std::move(sources), script, plan, options);
}

Result<Operands> Operands::join(
    std::vector<std::shared_ptr<const Source>> sources, const Script& script,
    const Plan& plan, const OperandOptions& options) {
  Operands operands(script, plan, options);
  operands.sources_ = std::move(sources);
  operands.rounded_.resize(operands.sources_.size());
  for (const auto& source : operands.sources_) {
    io::ImportReport& report = operands.report_;
    report.vertices += source->report.vertices;
    report.polygons += source->report.polygons;
    report.moved += source->report.moved;
    report.max_move = std::max(report.max_move, source->report.max_move);
    report.triangulated += source->report.triangulated;
    report.dropped += source->report.dropped;
    operands.corners_added_ += source->corners_added;
  }
  const Result<Done> found = operands.find_exact_leaves();
  if (!found) return found.error();
  const Result<Done> chosen = operands.choose_grid();
  if (!chosen) return chosen.error();
  const Result<Done> rounds = operands.round_what_grid_lacks();
  if (!rounds) return rounds.error();
  return operands;
}

const Source& Operands::source_of(std::int32_t leaf) const {
  const auto file = static_cast<std::size_t>(
      plan_->leaves[static_cast<std::size_t>(leaf)].file);
  return sources_[file]->exact && !is_exact(leaf) ? *rounded_[file]
                                                  : *sources_[file];
}

Result<Operands> Operands::on_finest_grid() const {
  OperandOptions options = options_;
  options.finest_grid = true;
  return join(sources_, *script_, *plan_, options);
}

std::size_t Operands::polygon_count(std::int32_t leaf) const {
  return is_exact(leaf) ? source_of(leaf).exact->faces.size()
                        : source_of(leaf).scene.polygon_count();
}

ColorSource Operands::color_source(std::int32_t part, PolygonId polygon) const {
  if (part < 0 || part >= leaf_count() || polygon < 0)
    return ColorSource::kNone;
  const Source& source = source_of(part);
  if (source.is_lit) return ColorSource::kLit;
  const auto at = static_cast<std::size_t>(polygon);
  return at < source.has_color.size() && source.has_color[at]
             ? ColorSource::kGiven
             : ColorSource::kNone;
}

const std::string& Operands::path_of(std::int32_t leaf) const {
  return source_of(leaf).path;
}

std::string Operands::name_of(std::int32_t leaf) const {
  const Leaf& at = plan_->leaves[static_cast<std::size_t>(leaf)];
  const File& file = script_->files[static_cast<std::size_t>(at.file)];
  return file.name.empty() ? file.path : file.name;
}

std::string Operands::name_in_files(std::int32_t leaf) const {
  const Leaf& at = plan_->leaves[static_cast<std::size_t>(leaf)];
  const File& file = script_->files[static_cast<std::size_t>(at.file)];
  // Where a primitive stands in a script is not what it is: another script may
  // make the same solid.
  if (file.path.empty()) return file.name.substr(0, file.name.find(" at "));
  return std::filesystem::path(file.path).filename().string();
}

std::string Operands::part_name(std::int32_t leaf) const {
  const Leaf& at = plan_->leaves[static_cast<std::size_t>(leaf)];
  const File& file = script_->files[static_cast<std::size_t>(at.file)];
  return file.mesh ? primitive_name(name_in_files(leaf), *file.mesh)
                   : name_in_files(leaf);
}

bool Operands::is_primitive(std::int32_t leaf) const {
  const Leaf& at = plan_->leaves[static_cast<std::size_t>(leaf)];
  return script_->files[static_cast<std::size_t>(at.file)].mesh != nullptr;
}

/// Makes `polygons` those in the file that the scene's are parts of.
Result<Scene> Operands::moved_scene(const Leaf& leaf, const Source& source,
                                    std::vector<PolygonId>& polygons) {
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
  data = in_single_steps(again->scene);
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
           "should, so it is empty or inside out; flip(...) in an expression "
           "turns its faces round"});
}

/// Whether a leaf that moving has bent is to be mended by moving it a little
/// more: its surface was fine before, and no finer grid can be tried.
bool Operands::may_settle(std::int32_t id, const Result<bool>& repairs) const {
  if (!options_.find_crossings || source_of(id).to_repair || can_be_finer())
    return false;
  return repairs ? *repairs : repairs.error().code != ErrorCode::kStopped;
}

/// The solid of a leaf that crosses itself only because it was rounded.
Result<GridSolid> Operands::settled(const Scene& scene,
                                    std::vector<PolygonId>& polygons) {
  Result<fast::SettledScene> made =
      fast::settled_scene(scene, options_.check.threads);
  if (!made) return made.error();
  if (made->scene.polygon_count() == 0) {
    return Error{ErrorCode::kOutOfRange, "rounding it to the grid of " +
                                             io::to_string(report_.unit) +
                                             " leaves nothing of it"};
  }
  settled_contacts_ += made->contacts;
  report_.max_move +=
      made->max_move *
      std::pow(static_cast<double>(report_.unit.base), report_.unit.exponent);
  for (PolygonId& p : made->polygons) p = polygons[static_cast<std::size_t>(p)];
  polygons = std::move(made->polygons);
  return make_solid(std::move(made->scene));
}

/// Whether a leaf's solid is that of its source, on the same grid.
bool Operands::stays_in_place(std::int32_t id) const {
  const Source& source = source_of(id);
  return source.solid && matrix_of(id) == identity_matrix() &&
         source.scene.unit() == report_.unit &&
         source.scene.grid_bits() == report_.grid_bits;
}

Result<std::shared_ptr<const GridSolid>> Operands::leaf(std::int32_t id) {
  lean_[static_cast<std::size_t>(id)] = source_of(id).is_lean;
  if (stays_in_place(id)) {
    if (to_merge(id) && source_of(id).lean && !source_of(id).to_repair) {
      lean_[static_cast<std::size_t>(id)] = true;
      polygons_[static_cast<std::size_t>(id)] = source_of(id).lean_polygons;
      return source_of(id).lean;
    }
    polygons_[static_cast<std::size_t>(id)] = source_of(id).polygons;
    repair_[static_cast<std::size_t>(id)] = source_of(id).to_repair;
    return source_of(id).solid;
  }
  const Leaf& leaf = plan_->leaves[static_cast<std::size_t>(id)];
  const auto located = [&](Error error) {
    return this->located(id, std::move(error));
  };
  const std::size_t moved_before = report_.moved;
  std::vector<PolygonId>& polygons = polygons_[static_cast<std::size_t>(id)];
  Result<Scene> scene = moved_scene(leaf, source_of(id), polygons);
  if (!scene) return located(scene.error());
  const bool is_exact = report_.moved == moved_before;
  // An exact map opens nothing, and makes no new crossings.
  Result<GridSolid> solid =
      make_solid(is_exact ? *std::move(scene) : closed(*std::move(scene)));
  if (!solid) return located(solid.error());
  bool repairs = source_of(id).to_repair;
  if (!is_exact) {
    lean_[static_cast<std::size_t>(id)] = false;
    const Result<bool> found = needs_repair(*solid, polygons, options_);
    if (may_settle(id, found)) {
      solid = settled(solid->scene(), polygons);
      if (!solid) return located(solid.error());
    } else {
      if (!found) return located(found.error());
      repairs = *found;
    }
  }
  repair_[static_cast<std::size_t>(id)] = repairs;
  return std::make_shared<const GridSolid>(*std::move(solid));
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
