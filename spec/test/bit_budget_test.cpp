// The bit budget of S1.6 at its extremes: planes of triangles with their
// corners at the corners of the grid's cube, and cameras with every component
// at its limit.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <random>
#include <set>
#include <vector>

#include "halfspace/camera.hpp"
#include "halfspace/scene.hpp"

namespace halfspace {
namespace {

using Integer =
    boost::multiprecision::number<boost::multiprecision::cpp_int_backend<>,
                                  boost::multiprecision::et_off>;

/// How many bits the value has, its sign counted: the least b with
/// |value| < 2^(b-1).
int bits_of(const Integer& value) {
  return value == 0 ? 1 : static_cast<int>(msb(abs(value))) + 2;
}

Integer power(int exponent) { return Integer(1) << exponent; }

/// A value with the width that counting one step at a time gives it.
struct Counted {
  Integer value;
  int width;
};

/// A product has the sum of the widths.
Counted operator*(const Counted& a, const Counted& b) {
  return {a.value * b.value, a.width + b.width};
}

/// A sum of 2 terms has one bit more, of 3 or 4 two more, of 6 three more.
Counted sum(const std::vector<Counted>& terms) {
  Counted total{0, 0};
  for (const Counted& term : terms) {
    total.value += term.value;
    total.width = std::max(total.width, term.width);
  }
  total.width += terms.size() > 4 ? 3 : terms.size() > 2 ? 2 : 1;
  EXPECT_LE(bits_of(total.value), total.width);
  return total;
}

Counted minus(const Counted& a) { return {-a.value, a.width}; }

using Row = std::array<Counted, 4>;

Counted det2(const Row& p, const Row& q, std::size_t i, std::size_t j) {
  return sum({p[i] * q[j], minus(p[j] * q[i])});
}

/// The determinant of three rows in columns i, j, k, as six products.
Counted det3(const Row& p, const Row& q, const Row& r, std::size_t i,
             std::size_t j, std::size_t k) {
  return sum({p[i] * q[j] * r[k], p[j] * q[k] * r[i], p[k] * q[i] * r[j],
              minus(p[k] * q[j] * r[i]), minus(p[j] * q[i] * r[k]),
              minus(p[i] * q[k] * r[j])});
}

/// The plane a x + b y + c z + d of three grid points (S1.4).
Row plane_of(const GridPoint& p0, const GridPoint& p1, const GridPoint& p2,
             int n) {
  const auto minus_p0 = [&](const GridPoint& p) -> Row {
    return {Counted{Integer(p.x) - p0.x, n + 1},
            Counted{Integer(p.y) - p0.y, n + 1},
            Counted{Integer(p.z) - p0.z, n + 1}, Counted{0, 1}};
  };
  const Row u = minus_p0(p1);
  const Row v = minus_p0(p2);
  const Counted a = det2(u, v, 1, 2);
  const Counted b = det2(u, v, 2, 0);
  const Counted c = det2(u, v, 0, 1);
  const Counted d = minus(
      sum({a * Counted{p0.x, n}, b * Counted{p0.y, n}, c * Counted{p0.z, n}}));
  return {a, b, c, d};
}

/// The point of three planes, homogeneous, by Cramer's rule.
Row point_of(const Row& p, const Row& q, const Row& r) {
  return {minus(det3(p, q, r, 3, 1, 2)), minus(det3(p, q, r, 0, 3, 2)),
          minus(det3(p, q, r, 0, 1, 3)), det3(p, q, r, 0, 1, 2)};
}

Counted value_at(const Row& plane, const Row& point) {
  return sum({plane[0] * point[0], plane[1] * point[1], plane[2] * point[2],
              plane[3] * point[3]});
}

std::vector<GridPoint> cube_corners(int n) {
  const std::int64_t least = -(std::int64_t{1} << (n - 1));
  const std::int64_t most = -least - 1;
  std::vector<GridPoint> corners;
  for (const std::int64_t x : {least, most}) {
    for (const std::int64_t y : {least, most}) {
      for (const std::int64_t z : {least, most}) corners.push_back({x, y, z});
    }
  }
  return corners;
}

/// The planes of all triangles with their corners at those of the cube, one of
/// each two opposite ones.
std::vector<Row> cube_planes(int n) {
  const std::vector<GridPoint> corners = cube_corners(n);
  std::vector<Row> planes;
  std::set<std::array<Integer, 4>> seen;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    for (std::size_t j = i + 1; j < corners.size(); ++j) {
      for (std::size_t k = j + 1; k < corners.size(); ++k) {
        const Row p = plane_of(corners[i], corners[j], corners[k], n);
        const std::array<Integer, 4> key{p[0].value, p[1].value, p[2].value,
                                         p[3].value};
        const std::array<Integer, 4> opposite{-key[0], -key[1], -key[2],
                                              -key[3]};
        if (seen.count(opposite) == 0 && seen.insert(key).second)
          planes.push_back(p);
      }
    }
  }
  return planes;
}

/// Planes of triangles whose coordinates are all within 3 of a limit.
std::vector<Row> planes_near_limits(int n, std::size_t count) {
  std::mt19937_64 random(static_cast<std::uint64_t>(n));
  const std::vector<GridPoint> corners = cube_corners(n);
  const auto inwards = [&](std::int64_t c) {
    const auto step = static_cast<std::int64_t>(random() % 4);
    return c < 0 ? c + step : c - step;
  };
  const auto point = [&] {
    const GridPoint& p = corners[random() % corners.size()];
    return GridPoint{inwards(p.x), inwards(p.y), inwards(p.z)};
  };
  std::vector<Row> planes;
  while (planes.size() < count) {
    const Row p = plane_of(point(), point(), point(), n);
    if (p[0].value != 0) planes.push_back(p);
  }
  return planes;
}

/// The largest size of what has been put in.
struct Largest {
  Integer size = 0;
  void put(const Integer& value) { size = std::max(size, Integer(abs(value))); }
};

/// The largest values that the definitions compute from planes alone.
struct PlaneExtremes {
  Largest normal, offset, w, xyz, fourth;
};

PlaneExtremes extremes_of(const std::vector<Row>& planes) {
  PlaneExtremes extremes;
  for (std::size_t i = 0; i < planes.size(); ++i) {
    for (const std::size_t m : {0u, 1u, 2u})
      extremes.normal.put(planes[i][m].value);
    extremes.offset.put(planes[i][3].value);
    for (std::size_t j = i + 1; j < planes.size(); ++j) {
      for (std::size_t k = j + 1; k < planes.size(); ++k) {
        const Row point = point_of(planes[i], planes[j], planes[k]);
        for (const std::size_t m : {i, j, k})
          EXPECT_EQ(value_at(planes[m], point).value, 0);
        for (const std::size_t m : {0u, 1u, 2u})
          extremes.xyz.put(point[m].value);
        extremes.w.put(point[3].value);
        for (std::size_t l = k + 1; l < planes.size(); ++l)
          extremes.fourth.put(value_at(planes[l], point).value);
      }
    }
  }
  return extremes;
}

class BitBudget : public ::testing::TestWithParam<int> {
 protected:
  int n() const { return GetParam(); }
  /// The width of the fast library's integers for this grid.
  int register_bits() const { return n() == 26 ? 256 : n() == 40 ? 384 : 512; }
  /// The largest coordinate.
  Integer most() const { return power(n() - 1); }
  /// The largest component of a camera, and of twice an image point.
  Integer camera_most() const { return power(n() + 13); }
  Integer image_most() const { return power(n() + 31); }
};

TEST_P(BitBudget, ExtremePlanesStayInTheirBounds) {
  const Integer square = (power(n()) - 1) * (power(n()) - 1);
  for (const auto& planes : {cube_planes(n()), planes_near_limits(n(), 12)}) {
    const PlaneExtremes extremes = extremes_of(planes);
    EXPECT_LE(extremes.normal.size, square);
    EXPECT_LE(extremes.offset.size, 4 * most() * most() * most());
    EXPECT_LE(extremes.w.size, 4 * square * square * square);
    EXPECT_LE(extremes.xyz.size, power(3 * n() + 1) * square * square);
    EXPECT_LE(extremes.fourth.size,
              power(3 * n() + 3) * square * square * square);
    EXPECT_LE(bits_of(extremes.normal.size), 2 * n() + 1);
    EXPECT_LE(bits_of(extremes.offset.size), 3 * n() + 1);
    EXPECT_LE(bits_of(extremes.w.size), 6 * n() + 3);
    EXPECT_LE(bits_of(extremes.xyz.size), 7 * n() + 2);
    EXPECT_LE(bits_of(extremes.fourth.size), 9 * n() + 4);
  }
}

TEST_P(BitBudget, TheCornerPlanesReachEveryBoundWithinOneBit) {
  const PlaneExtremes extremes = extremes_of(cube_planes(n()));
  EXPECT_GE(bits_of(extremes.normal.size), 2 * n() + 1);
  EXPECT_GE(bits_of(extremes.offset.size), 3 * n());
  EXPECT_GE(bits_of(extremes.w.size), 6 * n() + 2);
  EXPECT_GE(bits_of(extremes.xyz.size), 7 * n() + 1);
  EXPECT_GE(bits_of(extremes.fourth.size), 9 * n() + 3);
}

TEST_P(BitBudget, CountedWidthsAreThoseOfTheTable) {
  const std::vector<Row> planes = cube_planes(n());
  const Row point = point_of(planes[0], planes[1], planes[2]);
  const Counted fourth = value_at(planes[3], point);
  EXPECT_EQ(planes[0][0].width, 2 * n() + 3);
  EXPECT_EQ(planes[0][3].width, 3 * n() + 5);
  EXPECT_EQ(point[3].width, 6 * n() + 12);
  EXPECT_EQ(point[0].width, 7 * n() + 14);
  EXPECT_EQ(fourth.width, 9 * n() + 19);
  EXPECT_LE(fourth.width, register_bits());
}

TEST_P(BitBudget, TwoPointsByCoordinateExceedTheRegister) {
  // The largest X of one point times the largest W of another.
  const PlaneExtremes extremes = extremes_of(cube_planes(n()));
  const Integer product = extremes.xyz.size * extremes.w.size;
  EXPECT_LE(bits_of(2 * product), 13 * n() + 5);
  EXPECT_GT(bits_of(product), register_bits());
}

using Triple = std::array<Integer, 3>;

/// The eight vectors all of whose components have this size.
std::vector<Triple> sign_vectors(const Integer& size) {
  std::vector<Triple> all;
  for (int mask = 0; mask < 8; ++mask) {
    all.push_back({(mask & 1) != 0 ? size : Integer(-size),
                   (mask & 2) != 0 ? size : Integer(-size),
                   (mask & 4) != 0 ? size : Integer(-size)});
  }
  return all;
}

/// The plane's value at the point (x, y, z) / w, times w.
Integer value_at(const Row& plane, const Triple& p, const Integer& w) {
  return plane[0].value * p[0] + plane[1].value * p[1] + plane[2].value * p[2] +
         plane[3].value * w;
}

TEST_P(BitBudget, ValuesAtTheEyeAndOnTheImageReachTheirBounds) {
  Largest eye, image;
  for (const Row& plane : cube_planes(n())) {
    for (const Triple& e : sign_vectors(camera_most()))
      eye.put(value_at(plane, e, power(kLatticeBits)));
    for (const Triple& s : sign_vectors(image_most()))
      image.put(value_at(plane, s, power(kLatticeBits + 1)));
  }
  EXPECT_LT(eye.size, power(3 * n() + 15));
  EXPECT_LT(image.size, power(3 * n() + 33));
  EXPECT_GE(bits_of(eye.size), 3 * n() + 16);
  EXPECT_GE(bits_of(image.size), 3 * n() + 34);
}

TEST_P(BitBudget, EdgeSignsDepthsAndTheirDerivativesStayInTheirBounds) {
  const std::vector<Row> planes = cube_planes(n());
  Largest sign, derivative;
  for (const Triple& e : sign_vectors(camera_most())) {
    for (const Triple& s : sign_vectors(image_most())) {
      Triple step = s;
      for (Integer& c : step) c = c > 0 ? camera_most() : -camera_most();
      for (const Row& p : planes) {
        for (const Row& q : planes) {
          const Integer pe = value_at(p, e, power(kLatticeBits));
          const Integer qe = value_at(q, e, power(kLatticeBits));
          const Integer ps = value_at(p, s, power(kLatticeBits + 1));
          const Integer qs = value_at(q, s, power(kLatticeBits + 1));
          sign.put(pe * qs - qe * ps);
          derivative.put(pe * value_at(q, step, 0) - qe * value_at(p, step, 0));
        }
      }
    }
  }
  EXPECT_LT(sign.size, power(6 * n() + 49));
  EXPECT_LT(derivative.size, power(6 * n() + 31));
  // 18 would need P(e) = Q(s) = -Q(e) = P(s) = 3; eight is what is possible.
  EXPECT_GE(bits_of(sign.size), 6 * n() + 48);
  EXPECT_GE(bits_of(derivative.size), 6 * n() + 30);
}

TEST_P(BitBudget, NearLinesStayInTheirBounds) {
  const Integer one = power(kNearBits);
  const Integer most_near = power(32);
  Largest perspective, orthographic;
  for (const Row& plane : cube_planes(n())) {
    for (const Triple& e : sign_vectors(camera_most())) {
      const Integer pe = value_at(plane, e, power(kLatticeBits));
      const Integer ne = value_at(plane, e, 0);
      for (const Triple& s : sign_vectors(image_most())) {
        const Integer ps = value_at(plane, s, power(kLatticeBits + 1));
        for (const Integer& k : {Integer(0), most_near}) {
          perspective.put((one - k) * 2 * pe + k * ps);
          orthographic.put(one * ps - k * 2 * ne);
          orthographic.put(one * ps + k * 2 * ne);
        }
      }
    }
  }
  EXPECT_LT(perspective.size, power(3 * n() + 65));
  EXPECT_LT(orthographic.size, power(3 * n() + 50));
  EXPECT_GE(bits_of(perspective.size), 3 * n() + 65);
  EXPECT_GE(bits_of(orthographic.size), 3 * n() + 50);
}

/// det(e, s, p, q) for homogeneous e, s and grid points p, q.
Integer edge_determinant(const Triple& e, const Triple& s, const GridPoint& p,
                         const GridPoint& q) {
  const Integer we = power(kLatticeBits);
  const Integer ws = power(kLatticeBits + 1);
  const Triple u{Integer(p.x), Integer(p.y), Integer(p.z)};
  const Triple v{Integer(q.x), Integer(q.y), Integer(q.z)};
  Integer total = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const std::size_t k = (i + 2) % 3;
    // The minor of rows e, s in columns i, j against that of p, q in k, w; and
    // the minor in columns i, w against that in j, k.
    total += (e[i] * s[j] - e[j] * s[i]) * (u[k] - v[k]);
    total += (e[i] * ws - we * s[i]) * (u[j] * v[k] - u[k] * v[j]);
  }
  return total;
}

TEST_P(BitBudget, SourceEdgesAndColoursStayInTheirBounds) {
  const std::vector<GridPoint> corners = cube_corners(n());
  Largest edge, color;
  for (const Triple& e : sign_vectors(camera_most())) {
    for (const Triple& s : sign_vectors(image_most())) {
      for (const GridPoint& p : corners) {
        for (const GridPoint& q : corners) {
          const Integer d = edge_determinant(e, s, p, q);
          edge.put(d);
          // Triple such weights, each times 2 c - 2 m + 1 for channels c, m.
          color.put(3 * 511 * d);
        }
      }
    }
  }
  EXPECT_LT(edge.size, power(3 * n() + 47));
  EXPECT_LT(color.size, power(3 * n() + 58));
  EXPECT_GE(bits_of(edge.size), 3 * n() + 46);
}

TEST_P(BitBudget, TheExtremePolygonsAndCamerasAreValid) {
  const std::vector<GridPoint> corners = cube_corners(n());
  SceneData data;
  data.grid_bits = n();
  data.vertices = corners;
  // The corner planes, whose normals are (+-L^2, +-L^2, +-L^2).
  data.corners = {1, 2, 4, 0, 3, 5, 3, 6, 0, 7, 2, 1};
  data.first_corner = {0, 3, 6, 9, 12};
  data.colors.resize(4);
  EXPECT_TRUE(make_scene(data));

  const Int128 most = Int128{1} << (n() + 13);
  CameraData camera;
  camera.eye = {most, most, most};
  camera.s0 = {most, -most, -most};
  camera.sx = {most, most, -most};
  camera.sy = {-most, most, most};
  camera.width_px = kMaxImageSize;
  camera.height_px = kMaxImageSize;
  camera.near = std::int64_t{1} << 32;
  EXPECT_TRUE(make_camera(camera, n()));
  camera.eye.x = most + 1;
  const Result<Camera> refused = make_camera(camera, n());
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kOutOfRange);
}

INSTANTIATE_TEST_SUITE_P(Grids, BitBudget, ::testing::ValuesIn(kGridBits));

}  // namespace
}  // namespace halfspace
