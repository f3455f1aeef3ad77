#include "image/scalars.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string_view>

#include "cli/options.hpp"
#include "halfspace/io/format.hpp"
#include "image/viewing.hpp"

namespace halfspace::tools {
namespace {

constexpr Word<io::ScalarPlace> kPlaceWords[] = {
    {"vertices", io::ScalarPlace::kVertices},
    {"faces", io::ScalarPlace::kFaces}};

std::optional<std::array<double, 2>> parse_interval(std::string_view text) {
  const std::size_t comma = text.find(',');
  if (comma == std::string_view::npos) return std::nullopt;
  const auto low = parse_number<double>(text.substr(0, comma));
  const auto high = parse_number<double>(text.substr(comma + 1));
  if (!low || !high || !(*low < *high)) return std::nullopt;
  return std::array<double, 2>{*low, *high};
}

/// What a legend calls the numbers.
std::string legend_title(const std::string& source) {
  if (!io::is_scalar_file_name(source)) return source;
  const std::size_t colon = source.rfind(':');
  const std::string name = source.substr(source.find_last_of('/') + 1);
  if (colon != std::string::npos && colon > source.rfind('.'))
    return source.substr(colon + 1);
  return std::filesystem::path(name).stem().string();
}

Result<io::ColorMap> chosen_map(const std::string& name) {
  if (auto map = io::named_color_map(name)) return *std::move(map);
  std::error_code code;
  if (!std::filesystem::exists(name, code)) {
    return Error{
        ErrorCode::kUnknownFormat,
        "--map: " + name + " is no file, and no map: " + io::color_map_names()};
  }
  return io::read_color_map(name);
}

/// The least and the greatest number that there is; those above 0 alone where
/// asked for.
std::optional<std::array<double, 2>> number_extent(const ScalarField& field,
                                                   bool positive) {
  std::optional<std::array<double, 2>> extent;
  for (const double value : field.values) {
    if (std::isnan(value) || (positive && !(value > 0))) continue;
    if (!extent) extent = {value, value};
    (*extent)[0] = std::min((*extent)[0], value);
    (*extent)[1] = std::max((*extent)[1], value);
  }
  return extent;
}

Result<io::ScaleRange> range_of(const ScalarField& field,
                                const ScalarArguments& arguments,
                                const std::string& source) {
  io::ScaleRange range;
  range.logarithmic = arguments.logarithmic;
  range.steps = arguments.steps.value_or(0);
  range.clamp = arguments.clamp;
  range.no_data = arguments.no_data.value_or(range.no_data);
  std::array<double, 2> ends{};
  if (arguments.range) {
    ends = *arguments.range;
  } else {
    const auto extent = number_extent(field, arguments.logarithmic);
    if (!extent) {
      return Error{ErrorCode::kEmpty,
                   source + ": there is no number" +
                       (arguments.logarithmic ? " above 0" : "") +
                       " to make a range of; give --range"};
    }
    ends = *extent;
    // One number alone is in the middle of a range.
    if (ends[0] == ends[1]) {
      const double half = ends[0] == 0 ? 1 : std::abs(ends[0]) / 2;
      ends = {ends[0] - half, ends[1] + half};
    }
  }
  range.low = ends[0];
  range.high = ends[1];
  return range;
}

}  // namespace

void add_scalar_options(CLI::App& app, ScalarArguments& arguments) {
  const std::string group = "Scalars";
  app.add_option("--scalar", arguments.source,
                 "Colour by numbers: a property of a PLY, or a file of a "
                 "number a vertex or face, FILE.npy or FILE.csv:COLUMN")
      ->type_name("NAME|FILE")
      ->group(group);
  add_choice(app, "--scalar-on", kPlaceWords, arguments.place,
             "What the numbers of a file belong to; only where there are as "
             "many vertices as faces")
      ->group(group);
  app.add_option("--map", arguments.map,
                 "Colours from low to high: " + io::color_map_names() +
                     ", with _r after it in reverse; or a text file with a "
                     "colour a line")
      ->type_name("NAME|FILE")
      ->capture_default_str()
      ->group(group);
  add_parsed(app, "--range", "LOW,HIGH",
             "LOW,HIGH, two numbers, LOW below HIGH", arguments.range,
             parse_interval,
             "The numbers that the map begins and ends with; all there are if "
             "not said")
      ->group(group);
  app.add_flag("--log", arguments.logarithmic, "A logarithmic scale")
      ->group(group);
  add_number(app, "--steps", "N", arguments.steps, 2, 4096,
             "So many bands of one colour")
      ->group(group);
  app.add_flag(
         "--no-clamp", [&arguments](std::int64_t) { arguments.clamp = false; },
         "What is outside of the range has the colour of no data")
      ->group(group);
  add_parsed(app, "--nan-color", "R,G,B",
             "R,G,B, three whole numbers of at least 0 and at most 255, or "
             "#rrggbb",
             arguments.no_data, parse_color, "The colour of no data")
      ->group(group);
  app.add_flag("--legend", arguments.has_legend,
               "Show the scale at the right of the picture")
      ->group(group);
  app.add_option("--legend-title", arguments.title, "Its title")
      ->type_name("TEXT")
      ->group(group);
}

std::string scalar_complaint(const ScalarArguments& arguments) {
  if (arguments.source) return {};
  const bool says_more = arguments.place || arguments.range ||
                         arguments.logarithmic || arguments.steps ||
                         !arguments.clamp || arguments.no_data ||
                         arguments.has_legend || arguments.title ||
                         arguments.map != ScalarArguments().map;
  return says_more ? "--map and what goes with it: needs --scalar, the numbers "
                     "that have colours"
                   : "";
}

Result<ShownScalars> load_scalars(const std::string& path,
                                  const io::LoadedScene& loaded,
                                  const ScalarArguments& arguments) {
  const std::string& source = *arguments.source;
  const bool is_file = io::is_scalar_file_name(source);
  const Error no_ply = {ErrorCode::kUnknownFormat,
                        "--scalar: " + source +
                            " is no .npy or .csv, and only a PLY has "
                            "properties"};
  if (!is_file && loaded.is_scene_file && !arguments.owner) return no_ply;
  Result<io::ScalarColumn> column =
      is_file ? io::read_scalars(source) : io::read_ply_scalars(path, source);
  if (!column) {
    const bool other = !is_file && io::format_of(path) != io::Format::kPly;
    return other && column.error().code == ErrorCode::kUnknownFormat
               ? no_ply
               : column.error();
  }
  if (arguments.place) column->place = arguments.place;
  Result<ScalarField> field = io::scalars_of(loaded, *column);
  if (!field) return io::error_about(is_file ? source : path, field.error());
  return shown_scalars(*std::move(field), arguments);
}

Result<ShownScalars> shown_scalars(ScalarField field,
                                   const ScalarArguments& arguments) {
  const std::string& source = *arguments.source;
  const Result<io::ColorMap> map = chosen_map(arguments.map);
  if (!map) return map.error();
  const Result<io::ScaleRange> range = range_of(field, arguments, source);
  if (!range) return range.error();
  Result<ColorScale> scale = io::make_scale(*map, *range);
  if (!scale)
    return Error{scale.error().code, "--range: " + scale.error().message};
  ShownScalars shown;
  shown.legend.range = *range;
  shown.legend.scale = *std::move(scale);
  shown.legend.title = arguments.title.value_or(legend_title(source));
  shown.legend.shows_no_data =
      std::any_of(field.values.begin(), field.values.end(),
                  [](double value) { return std::isnan(value); });
  shown.field = std::move(field);
  return shown;
}

Size size_beside_legend(const std::optional<ShownScalars>& scalars,
                        const ScalarArguments& arguments, const Size& size) {
  if (!scalars || !arguments.has_legend) return size;
  const std::int32_t left =
      size.width_px -
      io::legend_width(scalars->legend, size.width_px, size.height_px);
  return left > size.width_px / 3 ? Size{left, size.height_px} : size;
}

void color_by_scalars(io::ImportOptions& options) {
  options.triangles = true;
  options.keep_vertices = true;
  if (!options.surface) options.surface = Rgb{255, 255, 255};
  options.light_colors = true;
}

}  // namespace halfspace::tools
