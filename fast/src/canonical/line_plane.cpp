#include "canonical/line_plane.hpp"

#include <cstddef>

#include "canonical/big_vector.hpp"
#include "canonical/own_grid.hpp"
#include "halfspace/assert.hpp"

namespace halfspace::fast {
namespace {

std::size_t farthest_axis(const BigVector& normal) {
  std::size_t axis = 0;
  for (const std::size_t k : {1u, 2u}) {
    if (abs(normal[k]) > abs(normal[axis])) axis = k;
  }
  return axis;
}

/// Divides by what the components have in common, and makes the first that is
/// not 0 positive.
void reduce(BigVector& v) {
  BigInteger divisor = gcd(gcd(v[0], v[1]), v[2]);
  const std::size_t first = v[0] != 0 ? 0 : v[1] != 0 ? 1 : 2;
  if (v[first] < 0) divisor = -divisor;
  for (BigInteger& component : v) component /= divisor;
}

}  // namespace

std::optional<LinePlane> line_plane_of(const GeometryTable& table,
                                       std::int32_t face, std::int32_t other) {
  const BigVector n = to_big_vector(table.reduced_normal(face));
  const BigVector m = to_big_vector(table.reduced_normal(other));
  const std::size_t axis = farthest_axis(n);
  const BigVector along = cross(n, m);
  BigVector e;
  e[axis] = 1;
  BigVector normal = cross(along, e);
  HALFSPACE_ASSERT(normal != BigVector{});
  reduce(normal);
  const BigInteger limit = BigInteger(1) << 53;
  for (const BigInteger& component : normal) {
    if (abs(component) >= limit) return std::nullopt;
  }
  // The line's point nearest to the origin is (p m x along + q along x n) over
  // the square of `along`, p and q the offsets of the planes.
  BigInteger offset = offset_of(table, face) * dot(normal, cross(m, along)) +
                      offset_of(table, other) * dot(normal, cross(along, n));
  BigInteger below = dot(along, along);
  const BigInteger divisor = gcd(offset, below);
  offset /= divisor;
  below /= divisor;
  const auto component = [&](std::size_t k) {
    return Int128{normal[k].convert_to<std::int64_t>()};
  };
  return LinePlane{
      {component(0), component(1), component(2)}, offset, below, face, other};
}

}  // namespace halfspace::fast
