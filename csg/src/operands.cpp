#include "halfspace/csg/operands.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <limits>
#include <utility>

#include "halfspace/csg/closing.hpp"
#include "halfspace/csg/fault.hpp"
#include "halfspace/csg/measure.hpp"
#include "halfspace/csg/trimmed.hpp"
#include "halfspace/csg/volume.hpp"
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

/// What is free is rounded to steps that are no more of its size than this: a
/// grid of 40 bits has them for solids of one size or so.
constexpr double kFineness = 0x1p-28;

/// Whether the number is a decimal of at most 12 digits: not one that was
/// computed in doubles, most likely.
bool is_short(const io::Number& number) {
  const std::int32_t ten = std::min(number.two, number.five);
  if (number.two - ten > 40 || number.five - ten > 17) return false;
  io::Integer digits =
      abs(number.mantissa) *
      pow(io::Integer(5), static_cast<unsigned>(number.five - ten));
  digits <<= static_cast<unsigned>(number.two - ten);
  return digits < 1'000'000'000'000;
}

/// Whether each coordinate of an image is one of the point, times plus or minus
/// a power of 2 and one of 5, and shifted by a short decimal.
bool keeps_grids(const Matrix& matrix) {
  return std::all_of(matrix.rows.begin(), matrix.rows.end(),
                     [](const auto& row) {
                       int used = 0;
                       for (std::size_t j = 0; j < 3; ++j) {
                         if (row[j].mantissa == 0) continue;
                         if (abs(row[j].mantissa) != 1) return false;
                         ++used;
                       }
                       return used == 1 && is_short(row[3]);
                     });
}

/// A power of two that no coordinate is beyond.
io::Number bound_of(const Extent& extent) {
  const double most = std::max(std::abs(io::to_double(extent.least)),
                               std::abs(io::to_double(extent.greatest)));
  int exponent = 0;
  std::frexp(most, &exponent);
  return {1, exponent, 0};
}

double size_of(const Extent& extent) {
  return io::to_double(extent.greatest) - io::to_double(extent.least);
}

bool is_short(const Plane& plane) {
  return std::all_of(
      plane.points.begin(), plane.points.end(), [](const Numbers3& point) {
        return std::all_of(
            point.begin(), point.end(),
            [](const io::Number& number) { return is_short(number); });
      });
}

double size_of(const Plane& plane) {
  double size = 0;
  for (const Numbers3& point : plane.points) {
    for (const io::Number& number : point)
      size = std::max(size, std::abs(io::to_double(number)));
  }
  return size;
}

std::string text_of(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.3g", value);
  return text.data();
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

/// Whether the surface must be repaired; an error if that is not wanted.
Result<bool> needs_repair(const GridSolid& solid,
                          const std::vector<PolygonId>& polygons,
                          const OperandOptions& options) {
  if (solid.scene().polygon_count() == 0) return false;
  if (!options.find_crossings) {
    // What is found without a search.
    const std::string volume = exact_volume(solid.scene());
    if (volume != "0" && volume.front() != '-') return false;
    return Error{
        ErrorCode::kInsideOut,
        volume == "0"
            ? "the surface holds nothing: its volume is 0"
            : "the surface is inside out: its volume is " + volume +
                  "; flip(...) in an expression turns its faces round"};
  }
  const Result<Done> fine = fast::check_operand(
      numbered(fast::to_solid(solid), polygons), options.check);
  if (!fine && fine.error().code == ErrorCode::kStopped) return fine.error();
  if (fine || options.repair) return !fine;
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

}  // namespace

Scene Operands::closed(Scene scene) {
  ClosedScene result = closed_on_lines(std::move(scene));
  corners_added_ += result.added;
  return std::move(result.scene);
}

Result<Source> make_source(const std::string& path,
                           const io::Imported& imported,
                           const OperandOptions& options) {
  Source source;
  source.path = path;
  source.polygons = imported.faces;
  source.report = imported.report;
  Result<Scene> scene = make_scene(trimmed(imported.scene));
  if (!scene) return io::error_about(path, scene.error());
  ClosedScene closed = closed_on_lines(*std::move(scene));
  source.corners_added = closed.added;
  source.scene = std::move(closed.scene);
  const Result<GridSolid> solid = make_solid(source.scene);
  if (!solid)
    return io::error_about(
        path, with_advice(open_error(source.scene, source.polygons), options));
  const Result<bool> repairs = needs_repair(*solid, source.polygons, options);
  if (!repairs) return io::error_about(path, repairs.error());
  source.to_repair = *repairs;
  return source;
}

Result<Source> read_source(const std::string& path,
                           const OperandOptions& options, bool flip) {
  Result<io::LoadedScene> loaded = io::load_scene(path, {});
  if (!loaded) return loaded.error();
  if (flip) loaded->file.scene = flipped(loaded->file.scene);
  return make_source(path,
                     {std::move(loaded->file.scene),
                      std::move(loaded->polygons), loaded->report},
                     options);
}

Result<Source> primitive_source(const std::string& name, const io::Mesh& mesh,
                                const OperandOptions& options) {
  Result<io::Imported> imported = io::import_scene(mesh, {});
  if (!imported) return io::error_about(name, imported.error());
  return make_source(name, *imported, options);
}

Result<Done> Operands::choose_grid() {
  std::vector<io::Number> coordinates;
  bool decimal = true, any_kept = false;
  for (const Leaf& leaf : plan_->leaves) {
    const Scene& scene = sources_[static_cast<std::size_t>(leaf.file)]->scene;
    if (scene.polygon_count() == 0) continue;
    decimal = decimal && scene.unit().base == 10;
    const Matrix& matrix =
        plan_->matrices[static_cast<std::size_t>(leaf.matrix)];
    any_kept = any_kept || keeps_grids(matrix);
    const StepMap map = step_map(matrix, scene.unit());
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
  // What is moved and cannot be held by any grid is rounded, to a grid that
  // holds the others, or else with them to that of 40 bits.
  const bool is_moved = plan_->matrices.size() > 1;
  if (imported && imported->report.moved > 0 && is_moved &&
      !options_.grid_bits) {
    if (any_kept && choose_exact_grid(true)) return Done{};
    imported = io::import_scene(mesh, {.grid_bits = 40});
  }
  if (!imported) return imported.error();
  report_.unit = imported->report.unit;
  report_.grid_bits = imported->report.grid_bits;
  return Done{};
}

/// Chooses a grid that holds everything exactly but for what is free; with
/// `rounds_moved`, also for what is moved by a map that grids do not hold, and
/// planes of numbers that were computed.
/// Returns false where no grid will do.
bool Operands::choose_exact_grid(bool rounds_moved) {
  std::vector<io::Number> coordinates;
  bool decimal = true, any_exact = false;
  double least_size = std::numeric_limits<double>::infinity();
  for (const Leaf& leaf : plan_->leaves) {
    const Source& source = *sources_[static_cast<std::size_t>(leaf.file)];
    if (source.scene.polygon_count() == 0) continue;
    const Matrix& matrix =
        plan_->matrices[static_cast<std::size_t>(leaf.matrix)];
    StepMap map = step_map(matrix, source.scene.unit());
    const auto& points = source.scene.data().vertices;
    const Extent extent = extent_of(map, points);
    if (!source.is_free && !(rounds_moved && !keeps_grids(matrix))) {
      decimal = decimal && source.scene.unit().base == 10;
      any_exact = true;
      add_extent(extent, coordinates);
      continue;
    }
    coordinates.push_back(bound_of(extent));
    for (auto& row : map.rows) row[3] = 0;
    least_size = std::min(least_size, size_of(extent_of(map, points)));
  }
  for (const Plane& plane : plan_->planes) {
    if (rounds_moved && !is_short(plane)) {
      least_size = std::min(least_size, size_of(plane));
      continue;
    }
    for (const Numbers3& point : plane.points)
      coordinates.insert(coordinates.end(), point.begin(), point.end());
  }
  io::Mesh mesh = mesh_of_points(coordinates);
  mesh.decimal = decimal && any_exact;
  const bool any_free = std::isfinite(least_size);
  for (const int bits : kGridBits) {
    const auto imported = io::import_scene(
        mesh, {.grid_bits = bits, .refine_bits = any_free ? bits : 0});
    if (!imported || imported->report.moved > 0) continue;
    const Unit unit = imported->report.unit;
    const double step = std::pow(static_cast<double>(unit.base), unit.exponent);
    const bool is_last = bits == std::end(kGridBits)[-1];
    if (any_free && step > least_size * kFineness && !is_last) continue;
    report_.unit = unit;
    report_.grid_bits = bits;
    return true;
  }
  return false;
}

Result<Done> Operands::choose_exact_grid() {
  if (choose_exact_grid(false) || choose_exact_grid(true)) return Done{};
  return no_grid();
}

/// The error of solids that no grid holds; names two that do not go together.
Error Operands::no_grid() const {
  std::int32_t finest = -1, farthest = -1;
  double step = 0, reach = 0;
  for (std::size_t i = 0; i < plan_->leaves.size(); ++i) {
    const Leaf& leaf = plan_->leaves[i];
    const Source& source = *sources_[static_cast<std::size_t>(leaf.file)];
    if (source.is_free || source.scene.polygon_count() == 0) continue;
    const Extent extent = extent_of(
        step_map(plan_->matrices[static_cast<std::size_t>(leaf.matrix)],
                 source.scene.unit()),
        source.scene.data().vertices);
    const double its_step = io::to_double(extent.step);
    if (finest < 0 || its_step < step) {
      finest = static_cast<std::int32_t>(i);
      step = its_step;
    }
    const double its_reach = io::to_double(bound_of(extent));
    if (farthest < 0 || its_reach > reach) {
      farthest = static_cast<std::int32_t>(i);
      reach = its_reach;
    }
  }
  std::string message =
      "no grid of 54 bits holds all coordinates exactly, in powers of two or "
      "of "
      "ten";
  if (finest >= 0) {
    message += ": " + name_of(finest) + " has steps of " + text_of(step) +
               ", and " + name_of(farthest) + " reaches to " + text_of(reach);
  }
  return {ErrorCode::kOutOfRange, message, finest};
}

Result<Operands> Operands::load(const Script& script, const Plan& plan,
                                const OperandOptions& options) {
  std::vector<std::shared_ptr<const Source>> sources;
  std::vector<bool> is_used(script.files.size());
  for (const Leaf& leaf : plan.leaves)
    is_used[static_cast<std::size_t>(leaf.file)] = true;
  for (std::size_t i = 0; i < script.files.size(); ++i) {
    const File& file = script.files[i];
    if (!is_used[i]) {
      sources.push_back(std::make_shared<const Source>());
      continue;
    }
    std::string path = file.path;
    if (file.name.empty() && !options.folder.empty())
      path = (std::filesystem::path(options.folder) / path).string();
    Result<Source> source =
        file.mesh ? primitive_source(file.name, *file.mesh, options)
                  : read_source(path, options, file.is_flipped);
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
  const Result<Done> chosen =
      options.exact ? operands.choose_exact_grid() : operands.choose_grid();
  if (!chosen) return chosen.error();
  return operands;
}

const Source& Operands::source_of(std::int32_t leaf) const {
  const auto file = plan_->leaves[static_cast<std::size_t>(leaf)].file;
  return *sources_[static_cast<std::size_t>(file)];
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
  const Source& source = *sources_[static_cast<std::size_t>(leaf.file)];
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

Result<GridSolid> Operands::leaf(std::int32_t id) {
  const Leaf& leaf = plan_->leaves[static_cast<std::size_t>(id)];
  const auto located = [&](Error error) {
    // The first matrix moves nothing.
    const std::string at =
        leaf.place.line > 0 ? " at " + to_string(leaf.place) : "";
    error.message = (leaf.matrix == 0 ? "as it stands" : "as moved") + at +
                    ": " + error.message;
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
    const Result<bool> found = needs_repair(*solid, polygons, options_);
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
