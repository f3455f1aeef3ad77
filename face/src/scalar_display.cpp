#include "halfspace/scalar_display.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "display_state.hpp"
#include "halfspace/fast/shade/scalars.hpp"
#include "halfspace/io/color_map.hpp"
#include "halfspace/io/import.hpp"
#include "halfspace/io/legend.hpp"
#include "import.hpp"
#include "node.hpp"
#include "number.hpp"

namespace halfspace {
namespace {

/// The mesh with a vertex of its own for every corner.
io::Mesh mesh_of_corners(const Mesh& mesh) {
  std::vector<Point> points;
  for (const std::int32_t vertex : mesh.corners)
    points.push_back(mesh.vertices[static_cast<std::size_t>(vertex)]);
  detail::ExactPoints exact = detail::exact_points(points);
  io::Mesh result;
  result.vertices = std::move(exact.points);
  result.decimal = exact.decimal;
  result.first_corner = mesh.first_corner;
  for (std::size_t k = 0; k < points.size(); ++k)
    result.corners.push_back(static_cast<VertexId>(k));
  return result;
}

Result<io::ColorMap> map_of(const std::string& name) {
  if (auto map = io::named_color_map(name)) return *std::move(map);
  Result<io::ColorMap> read = io::read_color_map(name);
  if (read || read.error().code != ErrorCode::kUnreadable) return read;
  return Error{ErrorCode::kUnknownFormat,
               name + " is no file, and no map: " + io::color_map_names()};
}

Result<io::ScaleRange> scale_range_of(const std::vector<double>& values,
                                      const ScalarStyle& style) {
  io::ScaleRange range;
  range.logarithmic = style.logarithmic;
  range.steps = style.steps;
  range.clamp = style.clamp;
  range.no_data = style.no_data;
  std::optional<double> low = style.low;
  std::optional<double> high = style.high;
  for (const double value : values) {
    if (std::isnan(value) || (style.logarithmic && !(value > 0))) continue;
    if (!style.low) low = std::min(low.value_or(value), value);
    if (!style.high) high = std::max(high.value_or(value), value);
  }
  if (!low || !high) {
    return Error{ErrorCode::kEmpty, "there is no number to make a range of"};
  }
  // One number alone is in the middle of a range.
  if (*low == *high && !style.low && !style.high) {
    const double half = *low == 0 ? 1 : std::abs(*low) / 2;
    low = *low - half;
    high = *high + half;
  }
  range.low = *low;
  range.high = *high;
  return range;
}

}  // namespace

struct ScalarDisplay::State {
  Display display;                     ///< of triangles
  std::vector<std::int32_t> polygons;  ///< by triangle, that of the mesh
  std::size_t polygon_count = 0;       ///< of the mesh
  ScalarField field;                   ///< of the display's scene

  std::int32_t polygon_of(std::int32_t triangle) const {
    if (triangle == kBackground) return kBackground;
    const auto t = static_cast<std::size_t>(triangle);
    if (t < polygons.size()) return polygons[t];
    return static_cast<std::int32_t>(polygon_count + t - polygons.size());
  }
};

ScalarDisplay::ScalarDisplay(std::unique_ptr<State> state)
    : state_(std::move(state)) {}
ScalarDisplay::ScalarDisplay(ScalarDisplay&&) noexcept = default;
ScalarDisplay& ScalarDisplay::operator=(ScalarDisplay&&) noexcept = default;
ScalarDisplay::~ScalarDisplay() = default;

Result<ScalarDisplay> ScalarDisplay::of(const Mesh& mesh, std::size_t field) {
  // A number that is missing is no fault here.
  Mesh filled = mesh;
  for (double& value : filled.fields) {
    if (std::isnan(value)) value = 0;
  }
  if (const auto fault = detail::fault_of(filled)) return *fault;
  if (field >= mesh.field_count) {
    return Error{ErrorCode::kBadIndex,
                 "there is no field " + std::to_string(field) + ", only " +
                     std::to_string(mesh.field_count),
                 static_cast<std::int64_t>(field)};
  }
  io::ImportOptions options;
  options.triangles = true;
  options.keep_vertices = true;
  options.surface = Rgb{255, 255, 255};
  options.light_colors = true;
  const auto imported = io::import_scene(mesh_of_corners(mesh), options);
  if (!imported) return imported.error();
  const Scene& cut = imported->scene;
  Mesh triangles;
  triangles.vertices = mesh.vertices;
  for (const VertexId corner : imported->corner_vertices)
    triangles.corners.push_back(mesh.corners[static_cast<std::size_t>(corner)]);
  triangles.first_corner = cut.data().first_corner;
  triangles.colors = cut.data().colors;
  Result<Display> display = Display::of(std::move(triangles));
  if (!display) return display.error();
  auto state = std::unique_ptr<State>(new State{
      *std::move(display), imported->faces, mesh.polygon_count(), {true, {}}});
  const auto of_scene = state->display.polygons_of_scene();
  for (const std::int32_t polygon : of_scene) {
    const auto triangle = static_cast<std::size_t>(polygon);
    for (std::size_t k = 0; k < 3; ++k) {
      const auto corner =
          static_cast<std::size_t>(imported->corner_vertices[3 * triangle + k]);
      state->field.values.push_back(mesh.fields_at(corner)[field]);
    }
  }
  auto checked = make_scalars(state->display.scene(), std::move(state->field));
  if (!checked) return checked.error();
  state->field = *std::move(checked);
  return ScalarDisplay(std::move(state));
}

Result<Picture> ScalarDisplay::render(const View& view,
                                      const ScalarStyle& style) const {
  if (view.anti_aliasing == AntiAliasing::kExactArea) {
    return Error{ErrorCode::kOutOfRange,
                 "scalars have colours of samples, no exact areas"};
  }
  if (view.back_color) {
    return Error{ErrorCode::kOutOfRange,
                 "scalars colour both sides; back faces have no mark"};
  }
  if (view.caps_by_solid) {
    return Error{ErrorCode::kOutOfRange,
                 "where scalars are seen, caps are not told apart by solids"};
  }
  const Result<io::ColorMap> map = map_of(style.map);
  if (!map) return map.error();
  const auto range = scale_range_of(state_->field.values, style);
  if (!range) return range.error();
  Result<ColorScale> scale = io::make_scale(*map, *range);
  if (!scale) return scale.error();
  const fast::ScalarColors prepared =
      fast::prepare_scalars(state_->display.scene(), state_->field, *scale);
  Result<fast::Rendering> image =
      state_->display.state_->rendered(view, &prepared);
  if (!image) return image.error();
  Picture picture{std::move(image->colors), std::move(image->items)};
  for (std::int32_t& id : picture.polygons.pixels) id = state_->polygon_of(id);
  if (style.legend) {
    io::Legend legend{
        *std::move(scale), *range, style.title,
        std::any_of(state_->field.values.begin(), state_->field.values.end(),
                    [](double v) { return std::isnan(v); })};
    io::draw_legend(legend, picture.polygons, view.background, picture.colors);
  }
  return picture;
}

}  // namespace halfspace
