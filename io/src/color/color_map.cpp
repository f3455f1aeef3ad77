#include "halfspace/io/color_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "color/color_tables.hpp"

namespace halfspace::io {
namespace {

constexpr int kMapColors = 256;

std::uint8_t byte_of(double share) {
  return static_cast<std::uint8_t>(
      std::floor(std::clamp(share, 0.0, 1.0) * 255 + 0.5));
}

ColorMap grey_map() {
  ColorMap map;
  for (int k = 0; k < kMapColors; ++k) {
    const auto level = static_cast<std::uint8_t>(k);
    map.push_back({level, level, level});
  }
  return map;
}

/// Red rises over the first three eighths, green over the next three, blue over
/// the rest.
ColorMap heated_map() {
  ColorMap map;
  for (int k = 0; k < kMapColors; ++k) {
    const double x = k / 255.0;
    map.push_back({byte_of(x * 8 / 3), byte_of((x - 0.375) * 8 / 3),
                   byte_of((x - 0.75) * 4)});
  }
  return map;
}

ColorMap table_map(std::string_view digits) {
  const auto value = [&](std::size_t at) {
    const auto digit = [](char c) { return c <= '9' ? c - '0' : c - 'a' + 10; };
    return static_cast<std::uint8_t>(16 * digit(digits[at]) +
                                     digit(digits[at + 1]));
  };
  ColorMap map;
  for (std::size_t at = 0; at < digits.size(); at += 6)
    map.push_back({value(at), value(at + 2), value(at + 4)});
  return map;
}

using Triple = std::array<double, 3>;

/// The reference white D65 of CIE XYZ.
constexpr Triple kWhite = {0.9505, 1.0, 1.089};

/// sRGB (IEC 61966-2-1) to CIE L*a*b*.
Triple lab_of(const Rgb& color) {
  const auto linear = [](std::uint8_t byte) {
    const double v = byte / 255.0;
    return v > 0.04045 ? std::pow((v + 0.055) / 1.055, 2.4) : v / 12.92;
  };
  const double r = linear(color.r), g = linear(color.g), b = linear(color.b);
  const Triple xyz = {0.4124 * r + 0.3576 * g + 0.1805 * b,
                      0.2126 * r + 0.7152 * g + 0.0722 * b,
                      0.0193 * r + 0.1192 * g + 0.9505 * b};
  Triple f{};
  for (std::size_t k = 0; k < 3; ++k) {
    const double t = xyz[k] / kWhite[k];
    f[k] = t > 0.008856 ? std::cbrt(t) : 7.787 * t + 16.0 / 116;
  }
  return {116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])};
}

Rgb srgb_of(const Triple& lab) {
  const double y = (lab[0] + 16) / 116;
  const Triple f = {y + lab[1] / 500, y, y - lab[2] / 200};
  Triple xyz{};
  for (std::size_t k = 0; k < 3; ++k) {
    const double cube = f[k] * f[k] * f[k];
    xyz[k] = kWhite[k] * (cube > 0.008856 ? cube : (f[k] - 16.0 / 116) / 7.787);
  }
  const auto encoded = [](double v) {
    return byte_of(v > 0.0031308 ? 1.055 * std::pow(v, 1 / 2.4) - 0.055
                                 : 12.92 * v);
  };
  return {encoded(3.2406 * xyz[0] - 1.5372 * xyz[1] - 0.4986 * xyz[2]),
          encoded(-0.9689 * xyz[0] + 1.8758 * xyz[1] + 0.0415 * xyz[2]),
          encoded(0.0557 * xyz[0] - 0.2040 * xyz[1] + 1.0570 * xyz[2])};
}

/// Moreland's Msh: size, saturation angle and hue angle of L*a*b*.
Triple msh_of(const Triple& lab) {
  const double m = std::hypot(lab[0], lab[1], lab[2]);
  return {m, m > 0 ? std::acos(lab[0] / m) : 0.0, std::atan2(lab[2], lab[1])};
}
Triple lab_of_msh(const Triple& msh) {
  return {msh[0] * std::cos(msh[1]),
          msh[0] * std::sin(msh[1]) * std::cos(msh[2]),
          msh[0] * std::sin(msh[1]) * std::sin(msh[2])};
}

/// The hue that a colour without saturation is given, so that the way to it
/// from `saturated` is even to the eye (Moreland, fig. 6).
double adjusted_hue(const Triple& saturated, double m) {
  if (saturated[0] >= m) return saturated[2];
  const double spin = saturated[1] *
                      std::sqrt(m * m - saturated[0] * saturated[0]) /
                      (saturated[0] * std::sin(saturated[1]));
  return saturated[2] > -std::numbers::pi / 3 ? saturated[2] + spin
                                              : saturated[2] - spin;
}

/// Moreland's cool to warm, by his method: from blue (59, 76, 192) to a white
/// of size 88 and on to red (180, 4, 38).
ColorMap coolwarm_map() {
  const Triple cool = msh_of(lab_of({59, 76, 192}));
  const Triple warm = msh_of(lab_of({180, 4, 38}));
  const double middle = std::max({cool[0], warm[0], 88.0});
  ColorMap map;
  for (int k = 0; k < kMapColors; ++k) {
    const double x = k / 255.0;
    const bool is_first = x < 0.5;
    const Triple& end = is_first ? cool : warm;
    const Triple white = {middle, 0, adjusted_hue(end, middle)};
    const double share = is_first ? 1 - 2 * x : 2 * x - 1;  // of `end`
    Triple msh{};
    for (std::size_t c = 0; c < 3; ++c)
      msh[c] = share * end[c] + (1 - share) * white[c];
    map.push_back(srgb_of(lab_of_msh(msh)));
  }
  return map;
}

constexpr std::string_view kMapNames[] = {"heated",  "grey",  "viridis",
                                          "cividis", "turbo", "coolwarm"};

}  // namespace

std::optional<ColorMap> named_color_map(std::string_view name) {
  const bool is_reversed = name.ends_with("_r");
  if (is_reversed) name.remove_suffix(2);
  ColorMap map;
  if (name == "heated") map = heated_map();
  if (name == "grey" || name == "gray") map = grey_map();
  if (name == "viridis") map = table_map(kViridisColors);
  if (name == "cividis") map = table_map(kCividisColors);
  if (name == "turbo") map = table_map(kTurboColors);
  if (name == "coolwarm") map = coolwarm_map();
  if (map.empty()) return std::nullopt;
  if (is_reversed) std::reverse(map.begin(), map.end());
  return map;
}

std::string color_map_names() {
  std::string list;
  for (const std::string_view name : kMapNames)
    list += (list.empty() ? "" : ", ") + std::string(name);
  return list;
}

}  // namespace halfspace::io
