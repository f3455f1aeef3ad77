#include "core/numbers.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <utility>

#include "halfspace/io/color_map.hpp"
#include "halfspace/io/scalars.hpp"

namespace halfspace::viewer {
namespace {

/// What a legend calls the numbers.
std::string legend_title(const std::string& source) {
  if (!io::is_scalar_file_name(source)) return source;
  const std::size_t colon = source.rfind(':');
  if (colon != std::string::npos && colon > source.rfind('.'))
    return source.substr(colon + 1);
  return std::filesystem::path(source).stem().string();
}

}  // namespace

Result<std::shared_ptr<const Numbers>> numbers_of(const std::string& path,
                                                  const io::LoadedScene& loaded,
                                                  const ScalarLook& look) {
  const bool is_file = io::is_scalar_file_name(look.source);
  const Result<io::ScalarColumn> column =
      is_file ? io::read_scalars(look.source)
              : io::read_ply_scalars(path, look.source);
  if (!column) return column.error();
  Result<ScalarField> field = io::scalars_of(loaded, *column);
  if (!field)
    return io::error_about(is_file ? look.source : path, field.error());
  auto numbers = std::make_shared<Numbers>();
  numbers->source = look.source;
  numbers->field = *std::move(field);
  constexpr double kFar = std::numeric_limits<double>::infinity();
  numbers->extent = {kFar, -kFar};
  numbers->least_positive = kFar;
  for (const double value : numbers->field.values) {
    numbers->has_gaps = numbers->has_gaps || std::isnan(value);
    if (std::isnan(value)) continue;
    numbers->extent = {std::min(numbers->extent[0], value),
                       std::max(numbers->extent[1], value)};
    if (value > 0)
      numbers->least_positive = std::min(numbers->least_positive, value);
  }
  auto& [low, high] = numbers->extent;
  if (low > high)
    return Error{ErrorCode::kEmpty, look.source + ": there is no number"};
  // One number alone is in the middle of a range.
  if (low == high) {
    const double half = low == 0 ? 1 : std::abs(low) / 2;
    low -= half;
    high += half;
  }
  return std::shared_ptr<const Numbers>(std::move(numbers));
}

Result<std::shared_ptr<const ShownNumbers>> shown_numbers(
    const Model& model, const ScalarLook& look) {
  io::ScaleRange range;
  range.low = look.range ? (*look.range)[0] : model.numbers->extent[0];
  range.high = look.range ? (*look.range)[1] : model.numbers->extent[1];
  if (look.is_logarithmic && !look.range)
    range.low = model.numbers->least_positive;
  range.logarithmic = look.is_logarithmic;
  range.steps = look.steps;
  auto named = io::named_color_map(look.map);
  Result<io::ColorMap> map = named ? Result<io::ColorMap>(*std::move(named))
                                   : io::read_color_map(look.map);
  if (!map) return map.error();
  const Result<ColorScale> scale = io::make_scale(*map, range);
  if (!scale) return scale.error();
  ShownNumbers shown{model.numbers, *scale,
                     io::Legend{*scale, range, legend_title(look.source),
                                model.numbers->has_gaps},
                     look.has_legend};
  return std::shared_ptr<const ShownNumbers>(
      std::make_shared<ShownNumbers>(std::move(shown)));
}

}  // namespace halfspace::viewer
