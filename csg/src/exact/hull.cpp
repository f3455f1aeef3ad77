#include "halfspace/csg/hull.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "halfspace/csg/surface.hpp"

namespace halfspace::csg {
namespace {

Integers3 difference(const Integers3& a, const Integers3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

bool is_zero(const Integers3& a) { return a[0] == 0 && a[1] == 0 && a[2] == 0; }

class Hull {
 public:
  Hull(std::vector<Numbers3> points, bool decimal)
      : points_(std::move(points)), decimal_(decimal) {
    for (const Numbers3& p : points_) {
      std::array<double, 3>& at = rounded_.emplace_back();
      for (std::size_t i = 0; i < 3; ++i) {
        at[i] = io::to_double(p[i]);
        largest_ = std::max(largest_, std::abs(at[i]));
      }
    }
    scale();
  }

  Result<io::Mesh> mesh();

 private:
  struct Triangle {
    std::array<std::size_t, 3> corners;
  };

  /// The points as integers: times a power of 2 and one of 5.
  void scale();
  int orientation(std::size_t a, std::size_t b, std::size_t c,
                  std::size_t d) const;
  bool begin();
  void add(std::size_t point);

  std::vector<Numbers3> points_;
  bool decimal_;
  std::vector<std::array<double, 3>> rounded_;
  std::vector<Integers3> scaled_;
  double largest_ = 0;
  std::array<std::size_t, 4> first_{};
  std::vector<Triangle> triangles_;
};

void Hull::scale() {
  std::int32_t two = 0, five = 0;
  for (const Numbers3& p : points_) {
    for (const io::Number& c : p) {
      two = std::min(two, c.two);
      five = std::min(five, c.five);
    }
  }
  for (const Numbers3& p : points_) {
    Integers3 v;
    for (std::size_t i = 0; i < 3; ++i) {
      v[i] = p[i].mantissa *
             pow(Integer(5), static_cast<unsigned>(p[i].five - five));
      v[i] <<= static_cast<unsigned>(p[i].two - two);
    }
    scaled_.push_back(std::move(v));
  }
}

/// The sign of (b - a) x (c - a) . (d - a): above 0 where d sees the triangle
/// counterclockwise.
///
/// With M the largest coordinate: each is off its exact value by half an ulp,
/// a difference below 2M by 4uM in all, u = 2^-53, a product of three by 3 * 4
/// * 4 u M^3 from those and 5 u 8 M^3 from rounding, and six of them and their
/// sums by less than 600 u M^3.
int Hull::orientation(std::size_t a, std::size_t b, std::size_t c,
                      std::size_t d) const {
  const auto less = [&](std::size_t p) {
    const auto &u = rounded_[p], &v = rounded_[a];
    return std::array{u[0] - v[0], u[1] - v[1], u[2] - v[2]};
  };
  const auto u = less(b), v = less(c), w = less(d);
  const double value = w[0] * (u[1] * v[2] - u[2] * v[1]) +
                       w[1] * (u[2] * v[0] - u[0] * v[2]) +
                       w[2] * (u[0] * v[1] - u[1] * v[0]);
  const double bound = 600 * 0x1p-53 * largest_ * largest_ * largest_;
  if (value > bound) return 1;
  if (value < -bound) return -1;
  const Integers3 normal = cross(difference(scaled_[b], scaled_[a]),
                                 difference(scaled_[c], scaled_[a]));
  return dot(normal, difference(scaled_[d], scaled_[a])).sign();
}

/// Makes the first tetrahedron; false where all points are in one plane.
bool Hull::begin() {
  const std::size_t n = rounded_.size();
  std::size_t b = 1, c = 0, d = 0;
  while (b < n && scaled_[b] == scaled_[0]) ++b;
  if (b == n) return false;
  const Integers3 edge = difference(scaled_[b], scaled_[0]);
  for (c = b + 1; c < n; ++c) {
    if (!is_zero(cross(edge, difference(scaled_[c], scaled_[0])))) break;
  }
  for (d = c + 1; d < n; ++d) {
    if (orientation(0, b, c, d) != 0) break;
  }
  if (c >= n || d >= n) return false;
  if (orientation(0, b, c, d) > 0) std::swap(b, c);
  first_ = {0, b, c, d};
  // d is behind the first triangle, as each corner is behind the other three.
  triangles_ = {{{0, b, c}}, {{0, d, b}}, {{b, d, c}}, {{c, d, 0}}};
  return true;
}

void Hull::add(std::size_t point) {
  std::set<std::pair<std::size_t, std::size_t>> edges;
  const auto sees = [&](const Triangle& t) {
    return orientation(t.corners[0], t.corners[1], t.corners[2], point) > 0;
  };
  const auto seen =
      std::stable_partition(triangles_.begin(), triangles_.end(),
                            [&](const Triangle& t) { return !sees(t); });
  for (auto t = seen; t != triangles_.end(); ++t) {
    for (std::size_t i = 0; i < 3; ++i)
      edges.insert({t->corners[i], t->corners[(i + 1) % 3]});
  }
  triangles_.erase(seen, triangles_.end());
  for (const auto& [from, to] : edges) {
    if (!edges.contains({to, from})) triangles_.push_back({{from, to, point}});
  }
}

Result<io::Mesh> Hull::mesh() {
  if (rounded_.size() < 4) {
    return Error{ErrorCode::kTooFewVertices,
                 "hull: there are fewer than 4 points"};
  }
  if (!begin())
    return Error{ErrorCode::kZeroArea, "hull: all points are in one plane"};
  for (std::size_t p = 0; p < rounded_.size(); ++p) {
    if (std::find(first_.begin(), first_.end(), p) == first_.end()) add(p);
  }
  io::Mesh result;
  result.vertices = points_;
  result.decimal = decimal_;
  for (const Triangle& t : triangles_) {
    for (const std::size_t corner : t.corners)
      result.corners.push_back(static_cast<VertexId>(corner));
    result.first_corner.push_back(
        static_cast<std::uint32_t>(result.corners.size()));
  }
  return result;
}

}  // namespace

Result<io::Mesh> hull_of(std::vector<Numbers3> points, bool decimal) {
  return Hull(std::move(points), decimal).mesh();
}

}  // namespace halfspace::csg
