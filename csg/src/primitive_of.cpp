#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include "functions.hpp"
#include "halfspace/csg/hull.hpp"
#include "halfspace/csg/primitives.hpp"
#include "numbers.hpp"

namespace halfspace::csg {
namespace {

using io::Number;

constexpr std::uint32_t kUsualSegments = 32;
constexpr std::uint32_t kMostSegments = 1000;

/// The points of a hull: more take minutes.
constexpr std::size_t kMostHullPoints = 20000;

/// Whether primitives of this size can be made in doubles.
bool is_usable(const Number& number) {
  const double size = std::abs(io::to_double(number));
  return size < 1e100 && (number.mantissa == 0 || size > 1e-100);
}

bool is_positive(const Number& number) { return number.mantissa > 0; }

std::optional<std::uint32_t> segments_of(const Number& number) {
  const auto segments = whole_in(number, 3, kMostSegments);
  if (!segments) return std::nullopt;
  return static_cast<std::uint32_t>(*segments);
}

using Numbers = std::vector<Number>;

/// Each makes its mesh of what a call gives; nothing of what it does not take.
std::optional<io::Mesh> box_of(const Numbers& numbers) {
  const std::size_t count = numbers.size();
  if ((count != 1 && count != 3) ||
      !std::all_of(numbers.begin(), numbers.end(), is_positive))
    return std::nullopt;
  return box_mesh(
      {}, {numbers[0], numbers[count / 3], numbers[count == 3 ? 2 : 0]});
}

std::optional<io::Mesh> torus_of(const Numbers& numbers) {
  if (numbers.size() < 2 || numbers.size() > 4 || !is_positive(numbers[1]) ||
      !is_less(numbers[1], numbers[0]))
    return std::nullopt;
  std::array<std::uint32_t, 2> segments = {kUsualSegments, kUsualSegments / 2};
  for (std::size_t k = 2; k < numbers.size(); ++k) {
    const auto asked = segments_of(numbers[k]);
    if (!asked) return std::nullopt;
    segments[k - 2] = *asked;
  }
  return torus_mesh(numbers[0], numbers[1], segments[0], segments[1]);
}

/// Sphere, cylinder or cone.
std::optional<io::Mesh> round_of(Function function, const Numbers& numbers) {
  const std::size_t lengths = function == Function::kSphere     ? 1
                              : function == Function::kCylinder ? 2
                                                                : 3;
  if (numbers.size() != lengths && numbers.size() != lengths + 1)
    return std::nullopt;
  std::optional<std::uint32_t> segments = kUsualSegments;
  if (numbers.size() > lengths) segments = segments_of(numbers.back());
  if (!segments) return std::nullopt;
  if (function == Function::kSphere) {
    if (!is_positive(numbers[0])) return std::nullopt;
    return sphere_mesh(numbers[0], *segments);
  }
  const Number& low = numbers[0];
  const Number& high = numbers[function == Function::kCone ? 1 : 0];
  const Number& height = numbers[lengths - 1];
  if (low.mantissa < 0 || high.mantissa < 0 ||
      (low.mantissa == 0 && high.mantissa == 0) || !is_positive(height))
    return std::nullopt;
  return frustum_mesh(low, high, Number{}, height, *segments);
}

}  // namespace

Result<io::Mesh> primitive_of(Function function, const Place& place,
                              const std::vector<Number>& numbers) {
  const std::size_t count = numbers.size();
  if (!std::all_of(numbers.begin(), numbers.end(), is_usable))
    return wrong_call(function, place);
  if (function == Function::kHull) {
    if (count < 12 || count % 3 != 0 || count > 3 * kMostHullPoints)
      return wrong_call(function, place);
    std::vector<Numbers3> points;
    for (std::size_t i = 0; i < count; i += 3)
      points.push_back({numbers[i], numbers[i + 1], numbers[i + 2]});
    Result<io::Mesh> hull = hull_of(std::move(points), true);
    if (!hull) return error_at(place, hull.error().code, hull.error().message);
    return hull;
  }
  std::optional<io::Mesh> mesh = function == Function::kBox ? box_of(numbers)
                                 : function == Function::kTorus
                                     ? torus_of(numbers)
                                     : round_of(function, numbers);
  if (!mesh) return wrong_call(function, place);
  return *std::move(mesh);
}

}  // namespace halfspace::csg
