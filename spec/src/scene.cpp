#include "halfspace/scene.hpp"

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <limits>
#include <optional>

#include "halfspace/int128.hpp"

namespace halfspace {
namespace {

using Int256 = boost::multiprecision::int256_t;

constexpr std::size_t kMaxCount = std::numeric_limits<std::int32_t>::max();

/// A vector of grid steps, in integers wide enough for what is done with it.
template <class Int>
struct Vector {
  Int x, y, z;
};

template <class Int>
Vector<Int> difference(const GridPoint& p, const GridPoint& q) {
  return {Int(p.x) - Int(q.x), Int(p.y) - Int(q.y), Int(p.z) - Int(q.z)};
}

template <class Int>
Vector<Int> cross(const Vector<Int>& u, const Vector<Int>& v) {
  return {Int(u.y * v.z - u.z * v.y), Int(u.z * v.x - u.x * v.z),
          Int(u.x * v.y - u.y * v.x)};
}

template <class Int>
Int dot(const Vector<Int>& u, const Vector<Int>& v) {
  return Int(u.x * v.x + u.y * v.y + u.z * v.z);
}

template <class Int>
bool is_zero(const Vector<Int>& u) {
  return u.x == 0 && u.y == 0 && u.z == 0;
}

std::string name_of(std::size_t polygon) {
  return "polygon " + std::to_string(polygon);
}

Error error_at(ErrorCode code, std::size_t polygon, const std::string& what) {
  return {code, name_of(polygon) + " " + what,
          static_cast<std::int64_t>(polygon)};
}

/// How often the edges change between going down and up in lexicographic
/// order. A closed polygon that turns one way does so exactly twice for each
/// time round.
template <class PointAt>
int monotone_chains(std::size_t count, PointAt&& at) {
  int changes = 0;
  bool was_up = at(count - 1) < at(0);
  for (std::size_t i = 0; i < count; ++i) {
    const bool up = at(i) < at((i + 1) % count);
    changes += up != was_up ? 1 : 0;
    was_up = up;
  }
  return changes;
}

/// The first of the shape errors of S1.3 that a triangle has: if it has an
/// area, it is planar and convex. Its normal has 2n + 3 bits: 55 where n is 26,
/// 111 at most.
template <class Int, class PointAt>
std::optional<Error> triangle_error(std::size_t polygon, PointAt&& at) {
  if (at(0) == at(1) || at(1) == at(2) || at(2) == at(0)) {
    return error_at(ErrorCode::kRepeatedVertex, polygon,
                    "visits a point twice");
  }
  if (is_zero(cross(difference<Int>(at(1), at(0)),
                    difference<Int>(at(2), at(1))))) {
    return error_at(ErrorCode::kZeroArea, polygon, "has no area");
  }
  return std::nullopt;
}

/// The first of the shape errors of S1.3 that a polygon has.
///
/// With Int of b bits and a grid of n bits: a difference has n + 1 bits, a
/// normal 2n + 3, its dot product with a difference 3n + 6. At n = 40 that is
/// 126 bits; at n = 54 it is 168.
template <class Int, class PointAt>
std::optional<Error> shape_error(std::size_t polygon, std::size_t count,
                                 PointAt&& at) {
  if (count < 3) {
    return error_at(ErrorCode::kTooFewVertices, polygon,
                    "has " + std::to_string(count) + " vertices");
  }
  std::vector<GridPoint> sorted(count);
  for (std::size_t i = 0; i < count; ++i) sorted[i] = at(i);
  std::sort(sorted.begin(), sorted.end());
  if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) {
    return error_at(ErrorCode::kRepeatedVertex, polygon,
                    "visits a point twice");
  }

  // The normal, from the first corner that is not straight (S1.4).
  const auto turn = [&](std::size_t i) {
    const GridPoint& p = at(i);
    const GridPoint& q = at((i + 1) % count);
    const GridPoint& r = at((i + 2) % count);
    return cross(difference<Int>(q, p), difference<Int>(r, q));
  };
  Vector<Int> normal{};
  for (std::size_t i = 0; i < count && is_zero(normal); ++i) normal = turn(i);
  if (is_zero(normal)) {
    return error_at(ErrorCode::kZeroArea, polygon, "has no area");
  }

  for (std::size_t i = 1; i < count; ++i) {
    if (dot(normal, difference<Int>(at(i), at(0))) != 0) {
      return error_at(ErrorCode::kNotPlanar, polygon,
                      "has its corner " + std::to_string(i) + " off its plane");
    }
  }

  // Every corner turns the way of the normal, or is straight and goes on.
  for (std::size_t i = 0; i < count; ++i) {
    const Vector<Int> corner = turn(i);
    // A turn is a multiple of the normal, so one component with the normal's
    // sign decides; a product of two normals might not fit.
    const Int& sign_of = normal.x != 0   ? normal.x
                         : normal.y != 0 ? normal.y
                                         : normal.z;
    const Int& turned = normal.x != 0   ? corner.x
                        : normal.y != 0 ? corner.y
                                        : corner.z;
    const bool straight = turned == 0;
    const bool wrong = (turned < 0) != (sign_of < 0);
    const bool back =
        straight &&
        dot(difference<Int>(at((i + 1) % count), at(i)),
            difference<Int>(at((i + 2) % count), at((i + 1) % count))) < 0;
    if ((!straight && wrong) || back) {
      return error_at(
          ErrorCode::kNotConvex, polygon,
          "is not convex at corner " + std::to_string((i + 1) % count));
    }
  }
  if (monotone_chains(count, at) != 2) {
    return error_at(ErrorCode::kNotConvex, polygon,
                    "winds round more than once");
  }
  return std::nullopt;
}

std::optional<Error> count_error(const SceneData& data) {
  const auto too_many = [](const char* what, std::size_t count) {
    return Error{ErrorCode::kOutOfRange, "there are " + std::to_string(count) +
                                             " " + what +
                                             ", more than 2147483647"};
  };
  if (data.vertices.size() > kMaxCount) {
    return too_many("vertices", data.vertices.size());
  }
  if (data.corners.size() > kMaxCount) {
    return too_many("corners", data.corners.size());
  }
  const auto& first = data.first_corner;
  if (first.empty() || first.front() != 0 ||
      first.back() != data.corners.size() ||
      !std::is_sorted(first.begin(), first.end()) ||
      data.colors.size() != first.size() - 1 ||
      (!data.corner_colors.empty() &&
       data.corner_colors.size() != data.corners.size())) {
    return Error{ErrorCode::kOutOfRange,
                 "the sizes of the scene's arrays disagree"};
  }
  return std::nullopt;
}

std::optional<Error> grid_error(const SceneData& data) {
  if (std::find(std::begin(kGridBits), std::end(kGridBits), data.grid_bits) ==
      std::end(kGridBits)) {
    return Error{ErrorCode::kOutOfRange, "a grid has 26, 40 or 54 bits, not " +
                                             std::to_string(data.grid_bits)};
  }
  const Unit unit = data.unit;
  if ((unit.base != 2 && unit.base != 10) || unit.exponent < -4096 ||
      unit.exponent > 4096) {
    return Error{ErrorCode::kOutOfRange,
                 "a unit is a power of 2 or 10 with an exponent from -4096 to "
                 "4096, not " +
                     std::to_string(unit.base) + "^" +
                     std::to_string(unit.exponent)};
  }
  for (std::size_t v = 0; v < data.vertices.size(); ++v) {
    const GridPoint& p = data.vertices[v];
    for (const std::int64_t coordinate : {p.x, p.y, p.z}) {
      if (fits(coordinate, data.grid_bits)) continue;
      return Error{ErrorCode::kOutOfRange,
                   "vertex " + std::to_string(v) + " has the coordinate " +
                       std::to_string(coordinate) + ", which is not in " +
                       std::to_string(data.grid_bits) + " bits",
                   static_cast<std::int64_t>(v)};
    }
  }
  return std::nullopt;
}

/// The first error of one polygon (S1.3).
std::optional<Error> polygon_error(const SceneData& data, std::size_t polygon) {
  const std::size_t first = data.first_corner[polygon];
  const std::size_t count = data.first_corner[polygon + 1] - first;
  const std::size_t vertex_count = data.vertices.size();
  for (std::size_t i = 0; i < count; ++i) {
    const VertexId vertex = data.corners[first + i];
    if (vertex < 0 || static_cast<std::size_t>(vertex) >= vertex_count) {
      return error_at(ErrorCode::kBadIndex, polygon,
                      "names vertex " + std::to_string(vertex) + " of " +
                          std::to_string(vertex_count));
    }
  }
  const auto at = [&](std::size_t i) -> const GridPoint& {
    return data.vertices[static_cast<std::size_t>(data.corners[first + i])];
  };
  if (count == 3) {
    return data.grid_bits == 26 ? triangle_error<std::int64_t>(polygon, at)
                                : triangle_error<Int128>(polygon, at);
  }
  if (auto error = data.grid_bits < 54
                       ? shape_error<Int128>(polygon, count, at)
                       : shape_error<Int256>(polygon, count, at)) {
    return error;
  }
  if (!data.corner_colors.empty()) {
    const auto begin =
        data.corner_colors.begin() + static_cast<std::ptrdiff_t>(first);
    const auto end = begin + static_cast<std::ptrdiff_t>(count);
    if (std::adjacent_find(begin, end, std::not_equal_to<>()) != end) {
      return error_at(ErrorCode::kNotTriangle, polygon,
                      "has differing vertex colours and " +
                          std::to_string(count) + " vertices, not 3");
    }
  }
  return std::nullopt;
}

}  // namespace

Result<Scene> make_scene(SceneData data) {
  if (auto error = count_error(data)) return *error;
  if (auto error = grid_error(data)) return *error;
  const std::size_t polygons = data.first_corner.size() - 1;
  for (std::size_t p = 0; p < polygons; ++p) {
    if (auto error = polygon_error(data, p)) return *error;
  }
  Scene scene;
  scene.data_ = std::move(data);
  return scene;
}

int grid_bits_for(std::span<const GridPoint> vertices) {
  for (const int bits : kGridBits) {
    const bool all = std::all_of(
        vertices.begin(), vertices.end(), [bits](const GridPoint& p) {
          return fits(p.x, bits) && fits(p.y, bits) && fits(p.z, bits);
        });
    if (all) return bits;
  }
  return 0;
}

}  // namespace halfspace
