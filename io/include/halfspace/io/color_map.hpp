#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "halfspace/polygon.hpp"
#include "halfspace/result.hpp"
#include "halfspace/scalars.hpp"

namespace halfspace::io {

/// Colours from the least number to the greatest.
using ColorMap = std::vector<Rgb>;

/// The map of a name, or nothing; after `_r` in reverse order. All have 256
/// colours:
///
/// * heated: the heated-object scale (FAG83 fig. 9; Pizer & Zimmerman 1983):
///   black through red, orange and yellow to white.
/// * grey: black to white.
/// * viridis, cividis: of even steps to the eye, dark to light.
/// * turbo: a rainbow without false edges.
/// * coolwarm: blue through light grey to red, for numbers about a middle
///   (Moreland, "Diverging Color Maps for Scientific Visualization", 2009).
std::optional<ColorMap> named_color_map(std::string_view name);

/// The names, as a list for messages.
std::string color_map_names();

/// The map in a text file: a colour a line, `R G B` of 0 to 255 or `#rrggbb`,
/// 2 to 4096 of them; empty lines and those that begin with `#` and a blank are
/// passed over.
/// Errors: those of read_file(); kSyntax, kOutOfRange, with the line.
Result<ColorMap> read_color_map(const std::filesystem::path& path);

/// How numbers are spread over a map's colours.
struct ScaleRange {
  double low = 0;
  double high = 1;
  bool logarithmic = false;
  std::int32_t steps = 0;  ///< so many bands of one colour; 0: one a colour
  bool clamp = true;       ///< else what is outside has the colour of no data
  Rgb no_data = {160, 160, 160};
};

/// Of n bands the k-th begins at low + k (high - low) / n, or at
/// low (high / low)^(k / n): the nearest double. Band k of n has the map's
/// colour in its middle.
///
/// Bands that are too narrow for doubles are left out.
/// Errors: kOutOfRange (low is not below high; a logarithm of what is not
///         positive; steps from 2 to 4096), kNotFinite.
Result<ColorScale> make_scale(const ColorMap& map, const ScaleRange& range);

/// Numbers for the marks of a scale, at most `most` or a few fewer, and how
/// they are written: multiples of 1, 2 or 5 times a power of ten; on a
/// logarithmic scale powers of ten, and 2 and 5 times those where there is
/// room.
struct ScaleMark {
  double value = 0;
  double share = 0;  ///< of the way from low to high
  std::string text;
};
std::vector<ScaleMark> scale_marks(const ScaleRange& range, int most);

}  // namespace halfspace::io
