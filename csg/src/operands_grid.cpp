#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <limits>
#include <utility>

#include "halfspace/csg/operands.hpp"
#include "halfspace/fast/solid_data.hpp"
#include "halfspace/io/load_scene.hpp"
#include "step_map.hpp"

/// The grid that holds all solids of a plan (S1.7).
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

/// A grid to be tried, and the longest step that will do, as a share of the
/// size of the least solid that is free to be rounded.
struct GridTrial {
  int bits;
  int refine_bits;
  double fineness;
};

/// The grids, the best first, for solids of which some are free. A grid of 40
/// bits has steps of 2^-28 of a size for solids of one size or so. One of 54
/// bits is made no finer than 2^-40, if need be, so that what comes of it still
/// fits beside larger solids.
std::vector<GridTrial> trials(bool any_free, bool only_finest) {
  constexpr double kAnyStep = std::numeric_limits<double>::infinity();
  if (!any_free) return {{26, 0, 0}, {40, 0, 0}, {54, 0, 0}};
  if (only_finest) return {{54, 54, kAnyStep}};
  return {{26, 26, 0x1p-28},
          {40, 40, 0x1p-28},
          {54, 0, 0x1p-40},
          {54, 48, 0x1p-40},
          {54, 54, kAnyStep}};
}

/// The unit, divided by tens while a grid of 54 bits holds the coordinates.
Unit finest(Unit unit, const std::vector<io::Number>& coordinates) {
  double most = 0;
  for (const io::Number& number : coordinates)
    most = std::max(most, std::abs(io::to_double(number)));
  constexpr double kMostSteps = 0x1p53 * (1 - 0x1p-40);
  constexpr int kLeastExponent = -300;  // of a double
  while (most > 0 && unit.base == 10 && unit.exponent > kLeastExponent &&
         most < kMostSteps * std::pow(10.0, unit.exponent - 1)) {
    --unit.exponent;
  }
  return unit;
}

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

/// The binary logarithm of the size of a number that is not zero, about.
double log2_of(const io::Number& number) {
  return static_cast<double>(msb(io::Integer(abs(number.mantissa)))) +
         number.two + number.five * std::log2(5.0);
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

}  // namespace

const Matrix& Operands::matrix_of(std::int32_t leaf) const {
  const auto id = plan_->leaves[static_cast<std::size_t>(leaf)].matrix;
  return plan_->matrices[static_cast<std::size_t>(id)];
}

bool Operands::is_empty(std::int32_t leaf) const {
  return is_exact(leaf) ? source_of(leaf).exact->faces.empty()
                        : source_of(leaf).scene.polygon_count() == 0;
}

/// Whether a leaf's coordinates may be rounded, if need be, for they were
/// computed: its matrix is not one that grids hold, or it is the surface in
/// doubles of an exact solid.
bool Operands::is_rounded_by_move(std::int32_t leaf) const {
  if (is_exact(leaf)) return false;
  return !keeps_grids(matrix_of(leaf)) || source_of(leaf).exact != nullptr;
}

/// What a grid must be a divisor of, and reach, to hold a leaf.
void Operands::add_need(std::int32_t leaf,
                        std::vector<io::Number>& coordinates) const {
  if (const auto& need = needs_[static_cast<std::size_t>(leaf)]) {
    coordinates.insert(coordinates.end(),
                       {need->step, need->least, need->greatest});
    return;
  }
  const Source& source = source_of(leaf);
  const Scene& scene = source.scene;
  if (source.need && matrix_of(leaf) == identity_matrix()) {
    coordinates.insert(coordinates.end(), source.need->begin(),
                       source.need->end());
    return;
  }
  add_extent(
      extent_of(step_map(matrix_of(leaf), scene.unit()), scene.data().vertices),
      coordinates);
}

Unit Operands::unit_of(std::int32_t leaf) const {
  const Source& source = source_of(leaf);
  return is_exact(leaf) ? source.exact->unit : source.scene.unit();
}

void Operands::set_grid(const Unit& unit, int bits) {
  report_.unit = unit;
  report_.grid_bits = bits;
  if (options_.grid_bits) return;
  for (const auto& need : needs_) {
    if (need) report_.grid_bits = std::max(report_.grid_bits, need->grid_bits);
  }
}

/// Whether a leaf may be rounded where no grid holds all.
bool Operands::may_round(std::int32_t leaf) const {
  const Source& source = source_of(leaf);
  return !options_.exact || source.may_round || source.is_free ||
         is_rounded(leaf, kMoved | kImported);
}

/// Whether a grid need not hold a leaf that is not free.
bool Operands::is_rounded(std::int32_t leaf, unsigned rounds) const {
  if (is_exact(leaf)) return false;
  return ((rounds & kMoved) != 0 && is_rounded_by_move(leaf)) ||
         ((rounds & kImported) != 0 && source_of(leaf).report.moved > 0) ||
         ((rounds & kAllowed) != 0 && may_round(leaf));
}

/// Whether a grid need not hold some leaf or plane, but must hold another.
bool Operands::rounds_some(unsigned rounds) const {
  bool any_rounded = false, any_kept = false;
  const auto count = [&](bool is_rounded_there) {
    any_rounded = any_rounded || is_rounded_there;
    any_kept = any_kept || !is_rounded_there;
  };
  for (std::int32_t leaf = 0; leaf < leaf_count(); ++leaf) {
    if (!is_empty(leaf)) count(is_rounded(leaf, rounds));
  }
  for (const Plane& plane : plan_->planes)
    count((rounds & kMoved) != 0 && !is_short(plane));
  return any_rounded && any_kept;
}

bool Operands::may_round_all() const {
  if (!options_.exact) return true;
  for (std::int32_t leaf = 0; leaf < leaf_count(); ++leaf) {
    if (!is_empty(leaf) && !may_round(leaf)) return false;
  }
  return std::none_of(plan_->planes.begin(), plan_->planes.end(),
                      [](const Plane& plane) { return is_short(plane); });
}

/// Chooses the grid: one that holds everything exactly; or one that holds all
/// but what reading rounded, or what was moved by a map that grids do not hold;
/// or one to which everything is rounded, if it may be. The same for scripts
/// and for the library.
Result<Done> Operands::choose_grid() {
  if (choose_unrounded_grid()) return Done{};
  if (options_.grid_bits) return choose_rounded_grid();
  constexpr unsigned kRead = kImported, kTurned = kMoved;
  for (const unsigned rounds :
       {kRead, kTurned, kTurned | kRead, kTurned | kRead | kAllowed}) {
    if (rounds_some(rounds) && choose_exact_grid(rounds)) return Done{};
  }
  return may_round_all() ? choose_rounded_grid() : no_grid();
}

/// What a grid that holds everything must hold.
io::Mesh Operands::mesh_of_needs() const {
  std::vector<io::Number> coordinates;
  bool decimal = true;
  for (std::int32_t leaf = 0; leaf < leaf_count(); ++leaf) {
    if (is_empty(leaf)) continue;
    decimal = decimal && unit_of(leaf).base == 10;
    add_need(leaf, coordinates);
  }
  for (const Plane& plane : plan_->planes) {
    for (const Numbers3& point : plane.points)
      coordinates.insert(coordinates.end(), point.begin(), point.end());
  }
  io::Mesh mesh = mesh_of_points(coordinates);
  mesh.decimal = decimal;
  return mesh;
}

/// Chooses the grid that holds everything, or everything that is not free;
/// returns false where there is none.
bool Operands::choose_unrounded_grid() {
  if (options_.exact) return choose_exact_grid(kNothing);
  const auto imported =
      io::import_scene(mesh_of_needs(), {.grid_bits = options_.grid_bits});
  if (!imported || imported->report.moved > 0) return false;
  set_grid(imported->report.unit, imported->report.grid_bits);
  return true;
}

/// An error of all coordinates, with the name of what reaches the farthest.
Error Operands::about_farthest(const Error& error) const {
  std::int32_t farthest = -1;
  double reach = 0;  // by its binary logarithm, for doubles do not reach so far
  for (std::int32_t leaf = 0; leaf < leaf_count(); ++leaf) {
    if (is_empty(leaf)) continue;
    std::vector<io::Number> coordinates;
    add_need(leaf, coordinates);
    for (const io::Number& number : coordinates) {
      if (number.mantissa == 0) continue;
      const double log = log2_of(number);
      if (farthest >= 0 && log <= reach) continue;
      farthest = leaf;
      reach = log;
    }
  }
  return farthest < 0 ? error : io::error_about(path_of(farthest), error);
}

/// Chooses the grid to which everything is rounded: as little as can be, lest
/// it cross itself, but where all was moved anyway.
Result<Done> Operands::choose_rounded_grid() {
  io::ImportOptions how;
  how.grid_bits = options_.grid_bits;
  bool all_moved = true, any = false;
  for (std::int32_t leaf = 0; leaf < leaf_count(); ++leaf) {
    if (is_empty(leaf)) continue;
    all_moved = all_moved && is_rounded(leaf, kMoved);
    any = true;
  }
  if (!how.grid_bits) {
    how.grid_bits = any && all_moved && !options_.finest_grid ? 40 : 54;
  }
  const auto imported = io::import_scene(mesh_of_needs(), how);
  if (!imported) return about_farthest(imported.error());
  set_grid(imported->report.unit, imported->report.grid_bits);
  return Done{};
}

/// Chooses a grid that holds everything exactly but for what is free, unless
/// that is decimals and they are kept, and for what is to be rounded. Returns
/// false where no grid will do.
bool Operands::choose_exact_grid(unsigned rounds) {
  return choose_exact_grid(rounds, true) || choose_exact_grid(rounds, false);
}

bool Operands::choose_exact_grid(unsigned rounds, bool keeps_decimals) {
  std::vector<io::Number> coordinates;
  bool decimal = true, any_exact = false;
  // Files are rounded as little as can be: what touches in them may cross.
  bool only_finest = options_.finest_grid;
  double least_size = std::numeric_limits<double>::infinity();
  for (std::int32_t leaf = 0; leaf < leaf_count(); ++leaf) {
    if (is_empty(leaf)) continue;
    const Source& source = source_of(leaf);
    const bool is_kept = keeps_decimals && unit_of(leaf).base == 10;
    const bool is_free = source.is_free && !is_exact(leaf) && !is_kept &&
                         !is_rounded_by_move(leaf);
    if (!is_free && !is_rounded(leaf, rounds)) {
      decimal = decimal && unit_of(leaf).base == 10;
      any_exact = true;
      add_need(leaf, coordinates);
      continue;
    }
    only_finest =
        only_finest || is_rounded(leaf, rounds & (kImported | kAllowed));
    StepMap map = step_map(matrix_of(leaf), source.scene.unit());
    const auto& points = source.scene.data().vertices;
    coordinates.push_back(bound_of(extent_of(map, points)));
    for (auto& row : map.rows) row[3] = 0;
    least_size = std::min(least_size, size_of(extent_of(map, points)));
  }
  for (const Plane& plane : plan_->planes) {
    if ((rounds & kMoved) != 0 && !is_short(plane)) {
      least_size = std::min(least_size, size_of(plane));
      continue;
    }
    for (const Numbers3& point : plane.points)
      coordinates.insert(coordinates.end(), point.begin(), point.end());
  }
  io::Mesh mesh = mesh_of_points(coordinates);
  mesh.decimal = decimal && any_exact;
  const bool any_free = std::isfinite(least_size);
  for (const GridTrial& trial : trials(any_free, only_finest)) {
    const auto imported = io::import_scene(
        mesh, {.grid_bits = trial.bits, .refine_bits = trial.refine_bits});
    if (!imported || imported->report.moved > 0) continue;
    const Unit unit = only_finest && any_free
                          ? finest(imported->report.unit, coordinates)
                          : imported->report.unit;
    const double step = std::pow(static_cast<double>(unit.base), unit.exponent);
    if (any_free && step > least_size * trial.fineness) continue;
    set_grid(unit, trial.bits);
    return true;
  }
  return false;
}

/// Finds which leaves are exact solids whose planes some grid can have.
Result<Done> Operands::find_exact_leaves() {
  for (std::int32_t leaf = 0; leaf < leaf_count(); ++leaf) {
    const auto i = static_cast<std::size_t>(leaf);
    const auto& source =
        sources_[static_cast<std::size_t>(plan_->leaves[i].file)];
    if (!source->exact) continue;
    needs_[i] = need_of(*source->exact, matrix_of(leaf));
    exact_[i] = needs_[i].has_value();
    if (exact_[i]) continue;
    const Result<Done> done = round_leaf(leaf);
    if (!done) return done;
  }
  return Done{};
}

/// Takes, in place of the exact solid, its surface in doubles.
Result<Done> Operands::round_leaf(std::int32_t leaf) {
  const auto i = static_cast<std::size_t>(leaf);
  const auto file = static_cast<std::size_t>(plan_->leaves[i].file);
  exact_[i] = false;
  needs_[i].reset();
  if (rounded_[file]) return Done{};
  const Source& source = *sources_[file];
  const Result<io::Imported> imported = rounded(*source.exact, io::unlit());
  if (!imported) return io::error_about(source.path, imported.error());
  Result<Source> made = make_source(source.path, *imported, options_);
  if (!made) return made.error();
  made->exact = source.exact;
  made->has_color = source.has_color;
  made->merge_coplanar = source.merge_coplanar;
  made->is_free = true;
  report_.moved += made->report.moved;
  report_.max_move = std::max(report_.max_move, made->report.max_move);
  rounded_[file] = std::make_shared<const Source>(*std::move(made));
  return Done{};
}

/// Rounds the exact solids that the chosen grid does not hold.
Result<Done> Operands::round_what_grid_lacks() {
  for (std::int32_t leaf = 0; leaf < leaf_count(); ++leaf) {
    const auto& need = needs_[static_cast<std::size_t>(leaf)];
    if (!need) continue;
    const auto is_held = [&](const io::Number& value) {
      const std::int32_t two = value.two - report_.unit.exponent;
      const std::int32_t five =
          value.five - (report_.unit.base == 10 ? report_.unit.exponent : 0);
      if (value.mantissa == 0) return true;
      if (two < 0 || five < 0 || two > 64 || five > 64) return false;
      const io::Integer steps =
          (abs(value.mantissa) << two) *
          pow(io::Integer(5), static_cast<unsigned>(five));
      return steps < io::Integer(1) << (report_.grid_bits - 1);
    };
    if (report_.grid_bits >= need->grid_bits && is_held(need->step) &&
        is_held(need->least) && is_held(need->greatest)) {
      continue;
    }
    const Result<Done> done = round_leaf(leaf);
    if (!done) return done;
  }
  return Done{};
}

Error Operands::located(std::int32_t id, Error error) const {
  const Leaf& leaf = plan_->leaves[static_cast<std::size_t>(id)];
  // The first matrix moves nothing.
  const std::string at =
      leaf.place.line > 0 ? " at " + to_string(leaf.place) : "";
  error.message = (leaf.matrix == 0 ? "as it stands" : "as moved") + at + ": " +
                  error.message;
  return io::error_about(path_of(id), std::move(error));
}

Result<fast::Solid> Operands::exact_leaf(std::int32_t id,
                                         const fast::Solid& with) {
  repair_[static_cast<std::size_t>(id)] = source_of(id).to_repair;
  const SolidData moved = placed(*source_of(id).exact, matrix_of(id),
                                 report_.unit, report_.grid_bits);
  Result<fast::Solid> solid = fast::to_solid(moved, with, id);
  if (!solid) return located(id, solid.error());
  return solid;
}

const SolidData* Operands::parts_of(std::int32_t leaf) const {
  return source_of(leaf).exact.get();
}

/// The error of solids that no grid holds; names two that do not go together.
Error Operands::no_grid() const {
  std::int32_t finest = -1, farthest = -1;
  double step = 0, reach = 0;
  for (std::size_t i = 0; i < plan_->leaves.size(); ++i) {
    const auto leaf = static_cast<std::int32_t>(i);
    const Source& source = source_of(leaf);
    if (source.is_free || is_empty(leaf) || may_round(leaf)) continue;
    const auto& need = needs_[i];
    const Extent extent =
        need ? Extent{need->step, need->least, need->greatest}
             : extent_of(step_map(matrix_of(leaf), source.scene.unit()),
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

}  // namespace halfspace::csg
