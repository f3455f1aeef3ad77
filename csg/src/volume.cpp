#include "halfspace/csg/volume.hpp"

#include <algorithm>

#include "halfspace/io/number.hpp"

namespace halfspace::csg {
namespace {

using io::Integer;

/// Six times the volume, in cubic steps. Fixed width: no coordinate has more
/// than 54 bits, so no determinant more than 165, and 2^31 of them 196.
boost::multiprecision::int256_t volume6(const Scene& scene) {
  using Wide = boost::multiprecision::int256_t;
  Wide total = 0;
  for (std::size_t p = 0; p < scene.polygon_count(); ++p) {
    const auto corners = scene.corners(static_cast<PolygonId>(p));
    const GridPoint& a = scene.point(corners[0]);
    for (std::size_t i = 2; i < corners.size(); ++i) {
      const GridPoint& b = scene.point(corners[i - 1]);
      const GridPoint& c = scene.point(corners[i]);
      const auto minor = [](std::int64_t r, std::int64_t s, std::int64_t t,
                            std::int64_t u) -> Wide {
        return Wide(r) * u - Wide(s) * t;
      };
      total += a.x * minor(b.y, b.z, c.y, c.z);
      total += a.y * minor(b.z, b.x, c.z, c.x);
      total += a.z * minor(b.x, b.y, c.x, c.y);
    }
  }
  return total;
}

Integer integer_power(int base, std::int32_t exponent) {
  return pow(Integer(base), static_cast<unsigned>(std::max(exponent, 0)));
}

/// digits / 10^places as a decimal.
std::string decimal(const Integer& digits, std::size_t places) {
  std::string text = Integer(abs(digits)).str();
  if (text.size() <= places) text.insert(0, places + 1 - text.size(), '0');
  if (places > 0) text.insert(text.size() - places, ".");
  return (digits < 0 ? "-" : "") + text;
}

}  // namespace

double about_volume(const std::vector<std::array<double, 3>>& vertices,
                    const std::vector<std::uint32_t>& first_corner,
                    const std::vector<VertexId>& corners) {
  if (vertices.empty()) return 0;
  // From a corner of its own: far from the origin the terms cancel less.
  const auto& o = vertices.front();
  const auto at = [&](std::size_t corner) {
    const auto& v = vertices[static_cast<std::size_t>(corners[corner])];
    return std::array{v[0] - o[0], v[1] - o[1], v[2] - o[2]};
  };
  double total = 0;
  for (std::size_t p = 0; p + 1 < first_corner.size(); ++p) {
    const auto a = at(first_corner[p]);
    for (std::size_t i = first_corner[p] + 2; i < first_corner[p + 1]; ++i) {
      const auto b = at(i - 1);
      const auto c = at(i);
      total += a[0] * (b[1] * c[2] - b[2] * c[1]) +
               a[1] * (b[2] * c[0] - b[0] * c[2]) +
               a[2] * (b[0] * c[1] - b[1] * c[0]);
    }
  }
  return total / 6;
}

std::string exact_volume(const Scene& scene) {
  Integer total(volume6(scene));
  const bool has_third = total % 3 != 0;
  if (!has_third) total /= 3;
  const Unit unit = scene.unit();
  const io::Number volume = io::normalised(
      total, 3 * unit.exponent - 1, unit.base == 10 ? 3 * unit.exponent : 0);
  const Integer above = volume.mantissa * integer_power(2, volume.two) *
                        integer_power(5, volume.five);
  if (has_third) {
    const Integer below =
        3 * integer_power(2, -volume.two) * integer_power(5, -volume.five);
    return above.str() + "/" + below.str();
  }
  const std::int32_t places = std::max({0, -volume.two, -volume.five});
  return decimal(above * integer_power(2, places + std::min(volume.two, 0)) *
                     integer_power(5, places + std::min(volume.five, 0)),
                 static_cast<std::size_t>(places));
}

}  // namespace halfspace::csg
