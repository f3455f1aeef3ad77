#include "affine.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "fields.hpp"
#include "halfspace/fast/to_mesh.hpp"
#include "halfspace/halfspace.hpp"
#include "node.hpp"
#include "number.hpp"
#include "placed_vertices.hpp"

namespace halfspace::detail {
namespace {

using csg::ExactPoint;
using csg::Integer;

/// A random source whose numbers are of all sizes.
class Numbers {
 public:
  explicit Numbers(std::uint64_t seed) : random_(seed) {}
  std::uint64_t below(std::uint64_t bound) { return random_() % bound; }
  std::int64_t integer(int bits) {
    const auto size =
        static_cast<std::int64_t>(below(std::uint64_t{1} << bits));
    return below(2) == 0 ? size : -size;
  }
  /// Small, short, any, or many orders of magnitude away.
  double value() {
    switch (below(5)) {
      case 0:
        return static_cast<double>(integer(3));
      case 1:
        return static_cast<double>(integer(10)) / 64;
      case 2:
        return static_cast<double>(integer(40)) / 1e6;
      case 3:
        return std::ldexp(static_cast<double>(integer(53)), -52);
      default:
        return std::ldexp(static_cast<double>(integer(53)),
                          static_cast<int>(integer(7)));
    }
  }
  /// Now and then all, or two of them, are equal, or next to each other.
  std::array<double, 3> values() {
    std::array<double, 3> v = {value(), value(), value()};
    const std::uint64_t kind = below(6);
    if (kind == 0) v[1] = v[0];
    if (kind <= 1) v[2] = v[0];
    if (kind == 2) v[1] = std::nextafter(v[0], 1e9);
    return v;
  }

 private:
  std::mt19937_64 random_;
};

/// What both arithmetics make of one case.
struct Decision {
  double exact = 0;
  std::optional<double> filtered;
};

Bounded bounded_of(std::int64_t value) { return bounded(value); }

/// The affine function with values at p[0], p[1], p[2], at the point x / below.
Decision decision(const std::array<GridPoint, 3>& p, const GridPoint& x,
                  std::int64_t below, const std::array<double, 3>& values) {
  Triangle triangle;
  triangle.axis = 2;
  std::array<SeenPoint, 3> seen;
  for (std::size_t k = 0; k < 3; ++k) {
    triangle.points[k] = ExactPoint{{p[k].x, p[k].y, p[k].z}, 1};
    seen[k] = {bounded_of(p[k].x), bounded_of(p[k].y)};
  }
  triangle.area2 =
      csg::area2(triangle.points[0], triangle.points[1], triangle.points[2], 2);
  if (triangle.area2 == 0) return {};
  const ExactPoint at{{x.x, x.y, x.z}, below};
  Decision result;
  result.exact = value_of(weights_at(triangle, at), values);
  const SeenPoint bounded_at{bounded_of(x.x) / bounded_of(below),
                             bounded_of(x.y) / bounded_of(below)};
  if (const auto weights = weights_at(seen, bounded_at))
    result.filtered = value_of(*weights, values);
  return result;
}

std::uint64_t bits_of(double value) {
  return std::bit_cast<std::uint64_t>(value);
}

TEST(FaceAffine, FilterAndExactPathGiveTheSameDoubles) {
  Numbers numbers(3);
  int decided = 0, left = 0;
  for (int round = 0; round < 20000; ++round) {
    // Of any size, and slivers next to a line.
    const int bits = 3 + static_cast<int>(numbers.below(50));
    const auto point = [&] {
      return GridPoint{numbers.integer(bits), numbers.integer(bits), 0};
    };
    std::array<GridPoint, 3> p = {point(), point(), point()};
    if (numbers.below(4) == 0) p[2] = {p[1].x + 1, p[1].y - 1, 0};
    const std::int64_t below =
        1 + static_cast<std::int64_t>(numbers.below(1u << 20));
    GridPoint x = point();
    // A corner, the middle of an edge, or anywhere.
    const std::uint64_t place = numbers.below(3);
    if (place < 2 && bits < 40) {
      const auto sum = [&](std::int64_t a, std::int64_t b) {
        return place == 0 ? a * below : a * (below / 2) + b * (below / 2);
      };
      x = {sum(p[0].x, p[1].x), sum(p[0].y, p[1].y), 0};
    }
    const Decision made = decision(p, x, below, numbers.values());
    if (!made.filtered) {
      ++left;
      continue;
    }
    ++decided;
    ASSERT_EQ(bits_of(made.exact), bits_of(*made.filtered)) << round;
  }
  EXPECT_GT(decided, 10 * left);
}

TEST(FaceAffine, TiesAndZerosAreLeftToTheExactPath) {
  const std::array<GridPoint, 3> p = {GridPoint{0, 0, 0}, {2, 0, 0}, {0, 2, 0}};
  // Half way between two doubles that are next to each other.
  const Decision tie =
      decision(p, {1, 0, 0}, 1, {1, std::nextafter(1.0, 2.0), 5});
  EXPECT_FALSE(tie.filtered);
  EXPECT_EQ(tie.exact, 1);
  // Exactly 0, between values that are not.
  const Decision zero = decision(p, {2, 0, 0}, 3, {-1, 2, 5});
  EXPECT_FALSE(zero.filtered);
  EXPECT_EQ(bits_of(zero.exact), bits_of(0.0));
  // Numbers of which products would underflow.
  const Decision tiny = decision(p, {1, 0, 0}, 3, {1e-300, 2e-300, 0});
  EXPECT_FALSE(tiny.filtered);
  EXPECT_EQ(decision(p, {1, 0, 0}, 3, {7, 7, 7}).filtered, 7);
}

TEST(FaceAffine, BoundsHoldTheTrueValue) {
  Numbers numbers(4);
  const auto exactly = [](const Bounded& b, int shift) {
    // In units of 2^-shift.
    return Integer(std::ldexp(b.high, shift)) +
           Integer(std::ldexp(b.low, shift));
  };
  for (int round = 0; round < 5000; ++round) {
    const std::int64_t a = numbers.integer(62), b = numbers.integer(62);
    const Int128 wide = Int128{a} * b;
    const Integer whole = Integer(a) * b;
    for (const Bounded& product : {bounded(wide), bounded(a) * bounded(b),
                                   bounded(wide - a) + bounded(a)}) {
      const Integer off = abs(exactly(product, 0) - whole);
      ASSERT_LE(off.convert_to<double>(), product.error);
      ASSERT_LE(product.error, 0x1p-98 * std::abs(product.high));
    }
    if (b == 0) continue;
    const Bounded quotient = bounded(a) / bounded(b);
    // |q b - a| <= error |b|, with everything 2^300 times as large.
    const Integer off = abs(exactly(quotient, 300) * b - (Integer(a) << 300));
    const Integer most =
        Integer(std::ldexp(quotient.error, 300)) * abs(Integer(b));
    ASSERT_LE(off, most);
    ASSERT_LE(quotient.error, 0x1p-98 * std::abs(quotient.high));
  }
}

/// The mesh of a solid with fields that have nothing to do with each other.
Solid with_any_fields(const Solid& solid, Numbers& numbers) {
  Mesh mesh = *solid.mesh();
  mesh.origins.clear();
  mesh.field_count = 3;
  for (std::size_t i = 0; i < mesh.corners.size(); ++i) {
    const auto v = numbers.values();
    mesh.fields.insert(mesh.fields.end(), v.begin(), v.end());
  }
  return Solid::from_mesh(mesh);
}

/// Moved so that it stays on a grid, or is rounded to one.
Solid moved(const Solid& solid, Numbers& numbers) {
  const auto some = [&] { return static_cast<double>(numbers.integer(6)) / 8; };
  switch (numbers.below(4)) {
    case 0:
      return solid.translated({some(), some(), some()});
    case 1:
      return solid.rotated({1, 2, 3}, 30 + some());
    case 2:
      return solid.mirrored({{1, 0, 0}, some()}).scaled(0.3);
    default:
      return solid;
  }
}

std::vector<double> fields_of(const Evaluation& evaluation, FieldPath path) {
  const fast::Solid solid =
      fast::merge_faces(evaluation.solid, fast::Merge::kOrigin);
  Mesh mesh;
  carry_properties(evaluation, solid, fast::to_mesh(solid), mesh, path);
  return mesh.fields;
}

/// Decimals of up to 12 digits: some whole in steps of 10^exponent, and some
/// next to what is whole.
Point decimal_point(Numbers& numbers) {
  const auto decimal = [&numbers] {
    const int digits = 1 + static_cast<int>(numbers.below(11));
    const double most = std::pow(10.0, digits);
    double mantissa = std::floor(
        std::ldexp(static_cast<double>(numbers.below(std::uint64_t{1} << 40)),
                   -40) *
        most);
    if (numbers.below(2) == 0) mantissa = std::floor(mantissa / 1e5) * 1e5 + 1;
    const auto below = static_cast<double>(numbers.below(12));
    return mantissa / std::pow(10.0, below);
  };
  return {decimal(), -decimal(), decimal()};
}

TEST(FaceAffine, DoublesTellWhichDecimalsAreOnTheGrid) {
  Numbers numbers(6);
  std::size_t on_grid = 0, missed = 0, between = 0;
  for (int round = 0; round < 300; ++round) {
    auto mesh = std::make_shared<Mesh>();
    for (int i = 0; i < 20; ++i)
      mesh->vertices.push_back(decimal_point(numbers));
    const ExactPoints exact = exact_points(mesh->vertices);
    LeafData data;
    data.properties = mesh;
    data.vertices = exact.points;
    data.from = exact.decimal ? LeafData::From::kShortDecimals
                              : LeafData::From::kDoubles;
    const double factor = numbers.below(2) == 0 ? 1 : -8;
    const csg::Matrix matrix =
        csg::scaling(numbers_of({factor, factor, factor}));
    const Unit unit{10, -static_cast<std::int32_t>(numbers.below(12))};
    PlacedVertices placed(matrix, unit, data);
    for (std::size_t v = 0; v < mesh->vertices.size(); ++v) {
      const GridPoint* at = placed.on_grid(v);
      const ExactPoint& p = placed.exact(v);
      const bool is_whole = p.at[0] % p.below == 0 && p.at[1] % p.below == 0 &&
                            p.at[2] % p.below == 0;
      if (at == nullptr) {
        const bool fits = std::all_of(p.at.begin(), p.at.end(), [&p](auto& c) {
          return abs(c) < p.below * (std::int64_t{1} << 53);
        });
        if (fits) ++(is_whole ? missed : between);
        continue;
      }
      ++on_grid;
      ASSERT_TRUE(is_whole) << round << " " << v;
      ASSERT_EQ(p.at[0], p.below * at->x);
      ASSERT_EQ(p.at[1], p.below * at->y);
      ASSERT_EQ(p.at[2], p.below * at->z);
    }
  }
  EXPECT_GT(on_grid, 1000u);
  EXPECT_LT(missed, on_grid / 10);
  EXPECT_GT(between, 1000u);
}

TEST(FaceAffine, MeshesGetTheSameFieldsByFilterAndExactly) {
  Numbers numbers(5);
  std::size_t compared = 0;
  for (int round = 0; round < 60; ++round) {
    const auto size = [&] { return 1 + static_cast<double>(numbers.below(5)); };
    const auto part = [&]() -> Solid {
      switch (numbers.below(3)) {
        case 0:
          return Solid::box({0, 0, 0}, {size(), size(), size()});
        case 1:
          return Solid::sphere(size(), 7);
        default:
          return Solid::cone(size(), 0.7, size(), 5);
      }
    };
    const Solid a = moved(with_any_fields(part(), numbers), numbers);
    const Solid b = moved(with_any_fields(part(), numbers), numbers);
    const Solid made = numbers.below(2) == 0 ? a - b : a ^ b;
    const auto evaluation = SolidNode::of(made).evaluation({});
    ASSERT_TRUE(evaluation) << evaluation.error().message;
    const auto filtered = fields_of(**evaluation, FieldPath::kFiltered);
    const auto exact = fields_of(**evaluation, FieldPath::kExact);
    ASSERT_EQ(filtered.size(), exact.size());
    for (std::size_t i = 0; i < exact.size(); ++i)
      ASSERT_EQ(bits_of(filtered[i]), bits_of(exact[i])) << round << " " << i;
    compared += exact.size();
  }
  EXPECT_GT(compared, 10000u);
}

}  // namespace
}  // namespace halfspace::detail
