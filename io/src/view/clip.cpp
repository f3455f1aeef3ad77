#include "halfspace/io/clip.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "halfspace/big_integer.hpp"
#include "view/fraction.hpp"

namespace halfspace::io {
namespace {

/// The plane with these coefficients in grid steps.
ClipPlane plane_of(std::array<Fraction, 4> exact, int grid_bits) {
  Integer common = 1;
  for (const Fraction& value : exact) common = lcm(common, denominator(value));
  std::array<Integer, 4> whole;
  Integer shared = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    exact[k] *= common;
    whole[k] = numerator(exact[k]);
    shared = gcd(shared, whole[k]);
  }
  for (Integer& value : whole) value /= shared;
  // By how many bits the numbers are beyond the budget of S10.1.
  const auto beyond = [](const Integer& value, int bits) {
    const Integer size = abs(value);
    return size == 0 ? 0 : static_cast<int>(msb(size)) + 1 - bits;
  };
  int excess = 0;
  for (std::size_t k = 0; k < 3; ++k)
    excess = std::max(excess, beyond(whole[k], 2 * grid_bits + 1));
  excess = std::max(excess, beyond(whole[3], std::min(3 * grid_bits + 3, 126)));
  if (excess > 0) {
    for (Integer& value : whole)
      value = rounded(Fraction(value, Integer(1) << (excess + 1)));
  }
  return {to_int128(whole[0]), to_int128(whole[1]), to_int128(whole[2]),
          to_int128(whole[3])};
}

}  // namespace

Result<ClipPlane> clip_plane(const Scene& scene,
                             const std::array<Number, 4>& numbers) {
  std::array<Fraction, 4> exact;
  for (std::size_t k = 0; k < 4; ++k) exact[k] = fraction_of(numbers[k]);
  if (exact[0] == 0 && exact[1] == 0 && exact[2] == 0) {
    return Error{ErrorCode::kZeroArea,
                 "a clip plane's normal is zero, which is no plane"};
  }
  exact[3] /= grid_step(scene.unit());
  const ClipPlane plane = plane_of(exact, scene.grid_bits());
  if (plane.a == 0 && plane.b == 0 && plane.c == 0) {
    return Error{ErrorCode::kOutOfRange,
                 "a clip plane is farther away than its numbers can say"};
  }
  return plane;
}

Result<ClipPlane> yon_plane(const Scene& scene, const Camera& camera,
                            double distance) {
  const CameraData& data = camera.data();
  const auto vector = [](const LatticeVector& v) {
    return glm::dvec3(static_cast<double>(v.x), static_cast<double>(v.y),
                      static_cast<double>(v.z));
  };
  const auto length = [](const glm::dvec3& v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  };
  const glm::dvec3 sx = vector(data.sx) / length(vector(data.sx));
  const glm::dvec3 sy = vector(data.sy) / length(vector(data.sy));
  glm::dvec3 forward = glm::normalize(glm::cross(sx, sy));
  const glm::dvec3 depth =
      data.perspective ? vector(data.s0) - vector(data.eye) : -vector(data.eye);
  if (glm::dot(forward, depth) < 0) forward = -forward;
  // The plane's point, in grid steps; its normal in 40 bits.
  const LatticeVector& start = data.perspective ? data.eye : data.s0;
  const Int128 starts[3] = {start.x, start.y, start.z};
  const Fraction steps =
      fraction_of(number_of(distance)) / grid_step(scene.unit());
  std::array<Fraction, 4> exact;
  for (int a = 0; a < 3; ++a) {
    const auto k = static_cast<std::size_t>(a);
    exact[k] = Fraction(
        -static_cast<std::int64_t>(std::llround(std::ldexp(forward[a], 40))));
    const Fraction at =
        Fraction(to_big<Integer>(starts[a]), Integer(1) << kLatticeBits) +
        steps * fraction_of(number_of(forward[a]));
    exact[3] -= exact[k] * at;
  }
  exact[3] = rounded(exact[3]);
  return plane_of(exact, scene.grid_bits());
}

}  // namespace halfspace::io
