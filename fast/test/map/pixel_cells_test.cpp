#include "map/pixel_cells.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include "cases.hpp"
#include "exact/big_rational.hpp"

/// What items have of pixels is what rationals say, within the error that is
/// said: areas, and their integrals.
namespace halfspace::fast {
namespace {

// Far from the left side numbers are large, and so is what they are off by.
constexpr std::int32_t kWidth = 16384;
constexpr std::int32_t kFirst = kWidth - 66;
constexpr std::int32_t kHeight = 4;

struct Point {
  BigRational x, y;
};
using Polygon = std::vector<Point>;

/// A line of integers over 2^16, which `PixelLine` has nearly.
struct Line {
  std::int64_t a = 0, b = 0, c = 0;
  BigRational at(const Point& p) const { return a * p.x + b * p.y + c; }
};

/// The parts of a polygon on the two sides of a line.
std::pair<Polygon, Polygon> cut(const Polygon& polygon, const Line& line) {
  std::pair<Polygon, Polygon> parts;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Point& p = polygon[k];
    const Point& q = polygon[(k + 1) % polygon.size()];
    const BigRational here = line.at(p);
    const BigRational there = line.at(q);
    if (here >= 0) parts.first.push_back(p);
    if (here <= 0) parts.second.push_back(p);
    if ((here < 0 && there > 0) || (here > 0 && there < 0)) {
      const BigRational t = here / (here - there);
      parts.first.push_back({p.x + t * (q.x - p.x), p.y + t * (q.y - p.y)});
      parts.second.push_back(parts.first.back());
    }
  }
  return parts;
}

struct Moments {
  BigRational area = 0, x = 0, y = 0;
};

void add(const Polygon& polygon, Moments& sum) {
  for (std::size_t k = 2; k < polygon.size(); ++k) {
    const Point& o = polygon[0];
    const Point& p = polygon[k - 1];
    const Point& q = polygon[k];
    const BigRational twice =
        (p.x - o.x) * (q.y - o.y) - (p.y - o.y) * (q.x - o.x);
    sum.area += twice / 2;
    sum.x += twice * (o.x + p.x + q.x) / 6;
    sum.y += twice * (o.y + p.y + q.y) / 6;
  }
}

class PixelCellsTest : public ::testing::Test, public PixelSink {
 public:
  void fill(PolygonId item, std::int32_t row, std::int32_t from,
            std::int32_t end) override {
    for (std::int32_t x = from; x < end; ++x) {
      ++told_[{x, row}];
      const auto exact = exact_in(x, row);
      ASSERT_TRUE(exact.size() == 1 && exact.begin()->first == item)
          << x << " " << row;
    }
  }
  void mix(std::int32_t column, std::int32_t row,
           std::span<const PixelShare> shares, double error) override {
    ++told_[{column, row}];
    ++mixed_;
    several_ += shares.size() > 2 ? 1u : 0u;
    auto exact = exact_in(column, row);
    std::array<BigRational, 3> off = {0, 0, 0};
    const auto note = [&](const PixelShare& share, const Moments& right) {
      off[0] += abs(BigRational(share.area) - right.area);
      off[1] += abs(BigRational(share.x) - right.x);
      off[2] += abs(BigRational(share.y) - right.y);
    };
    for (const PixelShare& share : shares) {
      note(share, exact[share.item]);
      exact.erase(share.item);
    }
    for (const auto& [item, right] : exact) note({}, right);
    for (const BigRational& sum : off) {
      ASSERT_LE(sum, BigRational(error)) << column << " " << row;
      is_off_ = is_off_ || sum != 0;
    }
    // Of use only if it is small.
    ASSERT_LT(error, 0x1p-24);
  }

 protected:
  /// A fan, which shares edges, before and behind triangles and bands.
  void draw(std::uint64_t seed) {
    std::mt19937_64 random(seed);
    const auto within = [&](std::int64_t low, std::int64_t high) {
      return std::uniform_int_distribution<std::int64_t>(low, high)(random);
    };
    // Some corners are on the sides of pixels.
    const auto point = [&](std::int64_t size) {
      std::array<std::int64_t, 2> p{};
      for (std::size_t c = 0; c < 2; ++c) {
        p[c] = within(-size, size);
        if (within(0, 4) == 0) p[c] &= ~std::int64_t{0x7FFF};
      }
      return p;
    };
    const auto add_polygon = [&](std::vector<std::array<std::int64_t, 2>> p,
                                 std::array<std::int64_t, 2> at) {
      std::vector<Line> lines;
      const auto side = [&](std::size_t k, std::size_t l) {
        const std::int64_t ax = p[k][0] + at[0], ay = p[k][1] + at[1];
        const std::int64_t bx = p[l][0] + at[0], by = p[l][1] + at[1];
        // Over 2^16, and c of products over 2^32.
        return Line{(ay - by) << 16, (bx - ax) << 16, ax * by - ay * bx};
      };
      for (std::size_t k = 0; k < p.size(); ++k)
        lines.push_back(side(k, (k + 1) % p.size()));
      const Line& l = lines[0];
      const auto& far = p[2];
      const Point third = {BigRational(far[0] + at[0]) / 65536,
                           BigRational(far[1] + at[1]) / 65536};
      const BigRational turn = l.at(third);
      if (turn == 0) return;
      if (turn < 0) {
        for (Line& line : lines) line = {-line.a, -line.b, -line.c};
      }
      polygons_.push_back(lines);
    };
    const std::int64_t size = std::int64_t{1} << within(13, 20);
    for (int fan = 0; fan < 3; ++fan) {
      const std::array<std::int64_t, 2> at = {
          within(65536L * (kFirst + 20), 65536L * kWidth),
          within(0, 65536L * kHeight)};
      std::vector<std::array<std::int64_t, 2>> ring;
      for (int k = 0; k < 5; ++k) ring.push_back(point(size));
      std::sort(ring.begin(), ring.end(), [](const auto& p, const auto& q) {
        return std::atan2(p[1], p[0]) < std::atan2(q[1], q[0]);
      });
      for (std::size_t k = 0; k < ring.size(); ++k)
        add_polygon({{0, 0}, ring[k], ring[(k + 1) % ring.size()]}, at);
      add_polygon({point(size), point(size), point(size)}, at);
      // A band, thinner than a pixel.
      const auto p = point(size);
      const auto q = point(size);
      add_polygon(
          {p, q, {q[0] + 3000, q[1] + 1000}, {p[0] + 3000, p[1] + 1000}}, at);
    }
    PixelCells cells(kWidth, 0, kHeight, *this);
    for (std::size_t k = 0; k < polygons_.size(); ++k) {
      std::vector<PixelLine> sides;
      for (const Line& line : polygons_[k]) {
        PixelLine& side = sides.emplace_back();
        side = {static_cast<double>(line.a), static_cast<double>(line.b),
                static_cast<double>(line.c)};
        const double most = std::max(std::abs(side.a), std::abs(side.b));
        const double scale = std::ldexp(2, -std::ilogb(most));
        // As far off as they may be.
        for (double* number : {&side.a, &side.b, &side.c}) {
          *number *= scale * (1 + 0x1p-52 * static_cast<double>(within(-1, 0)));
        }
      }
      cells.light(sides, static_cast<PolygonId>(k));
    }
    cells.finish();
    for (std::int32_t row = 0; row < kHeight; ++row) {
      for (std::int32_t column = kFirst; column < kWidth; ++column) {
        if (told_[{column, row}] == 1) continue;
        const auto exact = exact_in(column, row);
        ASSERT_EQ((told_[{column, row}]), 0);
        ASSERT_TRUE(exact.size() == 1 && exact.begin()->first == kBackground);
      }
    }
  }

  std::map<PolygonId, Moments> exact_in(std::int32_t column, std::int32_t row) {
    const BigRational x = column;
    const BigRational y = row;
    std::vector<Polygon> unlit = {
        {{x, y}, {x + 1, y}, {x + 1, y + 1}, {x, y + 1}}};
    std::map<PolygonId, Moments> moments;
    const auto note = [&](PolygonId item, Polygon piece) {
      for (Point& p : piece) p = {p.x - x, p.y - y};
      Moments sum;
      add(piece, sum);
      if (sum.area == 0) return;
      Moments& all = moments[item];
      all.area += sum.area;
      all.x += sum.x;
      all.y += sum.y;
    };
    for (std::size_t k = 0; k < polygons_.size(); ++k) {
      std::vector<Polygon> left;
      for (Polygon piece : unlit) {
        for (const Line& line : polygons_[k]) {
          auto parts = cut(piece, line);
          if (parts.second.size() > 2) left.push_back(parts.second);
          piece = parts.first;
        }
        if (piece.size() > 2) note(static_cast<PolygonId>(k), piece);
      }
      unlit = left;
    }
    for (const Polygon& piece : unlit) note(kBackground, piece);
    return moments;
  }

  std::vector<std::vector<Line>> polygons_;
  std::map<std::pair<std::int32_t, std::int32_t>, int> told_;
  std::size_t mixed_ = 0;
  std::size_t several_ = 0;
  bool is_off_ = false;
};

TEST_F(PixelCellsTest, SharesAreOffByAtMostTheirError) {
  for (std::uint64_t seed = 1; seed <= cases(16) && !HasFatalFailure();
       ++seed) {
    polygons_.clear();
    told_.clear();
    draw(seed);
  }
  EXPECT_GT(mixed_, 100u);
  EXPECT_GT(several_, 50u);
  EXPECT_TRUE(is_off_);
}

}  // namespace
}  // namespace halfspace::fast
