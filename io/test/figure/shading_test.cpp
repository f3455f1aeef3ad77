#include "figure/shading.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>
#include <string>

namespace halfspace::io {
namespace {

double form_at(const std::array<double, 3>& form, const FigurePoint& p) {
  return form[0] * p[0] + form[1] * p[1] + form[2];
}

/// A triangle of random colours with a hole, seen in perspective: the weights
/// of its corners have three totals there.
FigureRegion random_region(std::mt19937& random, bool perspective) {
  std::uniform_real_distribution<double> place(0, 60);
  std::uniform_real_distribution<double> level(0, 255);
  std::uniform_real_distribution<double> near(1, 6);
  std::vector<FigurePoint> p;
  double twice = 0;
  while (twice < 200) {
    p = {{place(random), place(random)},
         {place(random), place(random)},
         {place(random), place(random)}};
    twice = (p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) -
            (p[1][1] - p[0][1]) * (p[2][0] - p[0][0]);
  }
  FigureRegion region;
  FigureShade shade;
  for (std::size_t k = 0; k < 3; ++k) {
    const FigurePoint& q = p[(k + 1) % 3];
    const FigurePoint& r = p[(k + 2) % 3];
    const double w = (perspective ? near(random) : 1) / twice;
    const std::array<double, 3> weight = {w * (q[1] - r[1]), w * (r[0] - q[0]),
                                          w * (q[0] * r[1] - q[1] * r[0])};
    const double parts[4] = {level(random), level(random), level(random), 1};
    for (std::size_t f = 0; f < 4; ++f) {
      for (std::size_t c = 0; c < 3; ++c)
        shade.forms[f][c] += parts[f] * weight[c];
    }
  }
  region.shade = shade;
  const FigurePoint m = {(p[0][0] + p[1][0] + p[2][0]) / 3,
                         (p[0][1] + p[1][1] + p[2][1]) / 3};
  region.loops = {p, {}};
  for (std::size_t k = 3; k-- > 0;) {
    region.loops[1].push_back(
        {m[0] + 0.3 * (p[k][0] - m[0]), m[1] + 0.3 * (p[k][1] - m[1])});
  }
  return region;
}

bool holds(const std::vector<std::vector<FigurePoint>>& loops,
           const FigurePoint& p) {
  bool inside = false;
  for (const auto& loop : loops) {
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const FigurePoint& a = loop[k];
      const FigurePoint& b = loop[k + 1 == loop.size() ? 0 : k + 1];
      if ((a[1] <= p[1]) == (b[1] <= p[1])) continue;
      if (p[0] < a[0] + (p[1] - a[1]) * (b[0] - a[0]) / (b[1] - a[1]))
        inside = !inside;
    }
  }
  return inside;
}

/// Calls visit() with points of a region.
template <class Visit>
void for_points(const FigureRegion& region, const Visit& visit) {
  for (int j = 0; j < 60; j += 3) {
    for (int i = 0; i < 60; i += 3) {
      const FigurePoint p = {i + 0.37, j + 0.59};
      if (holds(region.loops, p)) visit(p);
    }
  }
}

double distance(const std::array<double, 3>& f,
                const std::array<double, 3>& g) {
  return std::max(
      {std::abs(f[0] - g[0]), std::abs(f[1] - g[1]), std::abs(f[2] - g[2])});
}

std::array<double, 3> color_of(const ShadePart& part, const FigurePoint& p) {
  const auto channels = [](Rgb color) {
    return std::array<double, 3>{double(color.r), double(color.g),
                                 double(color.b)};
  };
  if (!part.has_gradient) return channels(part.fill);
  const double dx = part.line[1][0] - part.line[0][0];
  const double dy = part.line[1][1] - part.line[0][1];
  const double t =
      ((p[0] - part.line[0][0]) * dx + (p[1] - part.line[0][1]) * dy) /
      (dx * dx + dy * dy);
  const auto first = channels(part.ends[0]);
  const auto last = channels(part.ends[1]);
  return {first[0] + t * (last[0] - first[0]),
          first[1] + t * (last[1] - first[1]),
          first[2] + t * (last[2] - first[2])};
}

TEST(Shading, PartsTileTheRegionWithinTheLevels) {
  std::mt19937 random(5);
  for (int run = 0; run < 12; ++run) {
    const FigureRegion region = random_region(random, run % 3 != 0);
    for (const double levels : {2.0, 20.0}) {
      for (const bool gradients : {false, true}) {
        const auto parts = shade_parts(region, levels, gradients);
        for_points(region, [&](const FigurePoint& p) {
          int holders = 0;
          for (const ShadePart& part : parts) {
            if (!holds(part.loops, p)) continue;
            ++holders;
            EXPECT_LE(distance(color_of(part, p), region.shade->at(p)),
                      levels + 1e-6);
          }
          EXPECT_EQ(holders, 1);
        });
      }
    }
  }
}

TEST(Shading, OneGradientIsEnoughWhereColoursLieOnALine) {
  std::mt19937 random(6);
  FigureRegion region = random_region(random, false);
  region.shade->forms[1] = region.shade->forms[0];
  region.shade->forms[2] = region.shade->forms[3];
  for (double& number : region.shade->forms[2]) number *= 9;
  const auto parts = shade_parts(region, 1, true);
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_TRUE(parts[0].has_gradient);
  EXPECT_GT(shade_parts(region, 1, false).size(), 10u);
}

TEST(Shading, TrianglesTileTheRegionWithinTheLevels) {
  std::mt19937 random(7);
  for (int run = 0; run < 12; ++run) {
    const FigureRegion region = random_region(random, run % 3 != 0);
    for (const double levels : {2.0, 10.0}) {
      const auto triangles = shade_triangles(region, levels);
      for_points(region, [&](const FigurePoint& p) {
        int holders = 0;
        for (const ShadeTriangle& t : triangles) {
          if (!holds({{t[0], t[1], t[2]}}, p)) continue;
          ++holders;
          const auto twice = [](const FigurePoint& a, const FigurePoint& b,
                                const FigurePoint& c) {
            return (b[0] - a[0]) * (c[1] - a[1]) -
                   (b[1] - a[1]) * (c[0] - a[0]);
          };
          std::array<double, 3> color = {};
          for (std::size_t k = 0; k < 3; ++k) {
            const double w = twice(p, t[(k + 1) % 3], t[(k + 2) % 3]) /
                             twice(t[0], t[1], t[2]);
            const auto corner = region.shade->at(t[k]);
            for (std::size_t c = 0; c < 3; ++c) color[c] += w * corner[c];
          }
          EXPECT_LE(distance(color, region.shade->at(p)), levels + 1e-6);
        }
        EXPECT_EQ(holders, 1);
      });
    }
    // The last form stays positive, which the quotients need.
    EXPECT_GT(form_at(region.shade->forms[3], region.loops[0][0]), 0);
  }
}

TEST(Certificate, SaysHowFarCoordinatesMovedAndWhatVanished) {
  Figure figure;
  figure.width = figure.height = 100;
  FigureRegion region;
  region.loops = {{{10, 10}, {40.4, 20}, {25.6, 17}}};
  figure.regions.push_back(region);
  const FigureCertificate fine = certify(".svg", figure, {3, 2});
  EXPECT_EQ(fine.turned_over, 0u);
  EXPECT_EQ(fine.loops, 1u);
  EXPECT_EQ(fine.largest_move, 0);
  const FigureCertificate coarse = certify(".svg", figure, {0, 2});
  EXPECT_NEAR(coarse.largest_move, 0.4, 1e-12);
  EXPECT_EQ(coarse.bound, 0.5);
  EXPECT_EQ(coarse.finer_points, 0u);
  EXPECT_NE(figure_bytes(".svg", figure, {0, 2})->find("0 of 1 loops turned"),
            std::string::npos);
  figure.regions[0].loops = {{{10, 10}, {10.2, 10}, {10, 10.2}}};
  EXPECT_EQ(certify(".eps", figure, {0, 2}).vanished, 1u);
}

TEST(Certificate, LoopsThatWouldTurnOverGetMoreDecimals) {
  Figure figure;
  figure.width = figure.height = 100;
  FigureRegion region;
  // Rounded to whole numbers its last corner passes its longest side.
  region.loops = {{{10, 10}, {40.4, 20.4}, {25.6, 15.4}}};
  figure.regions.push_back(region);
  region.loops = {{{60.3, 10.2}, {80, 20}, {70, 40.7}}};
  figure.regions.push_back(region);
  const FigureCertificate whole = certify(".svg", figure, {0, 2});
  EXPECT_EQ(whole.turned_over, 0u);
  EXPECT_EQ(whole.finer_points, 3u);
  EXPECT_EQ(whole.most_decimals, 1);
  const std::string bytes = *figure_bytes(".svg", figure, {0, 2});
  EXPECT_NE(bytes.find("M10 10L40.4 20.4 25.6 15.4Z"), std::string::npos);
  EXPECT_NE(bytes.find("M60 10L80 20 70 41Z"), std::string::npos);
  for (const char* ending : {".pdf", ".eps", ".tex"}) {
    EXPECT_EQ(certify(ending, figure, {0, 2}).turned_over, 0u);
    EXPECT_NE(figure_bytes(ending, figure, {0, 2})->find("0 of 2 loops turned"),
              std::string::npos);
  }
}

/// Twice the area of a path's loop, as it is written.
double twice_of(const std::string& path) {
  std::vector<double> numbers;
  for (const char* at = path.c_str(); *at != 0;) {
    char* end = nullptr;
    const double number = std::strtod(at, &end);
    if (end == at) {
      ++at;
      continue;
    }
    numbers.push_back(number);
    at = end;
  }
  double twice = 0;
  for (std::size_t k = 0; k + 1 < numbers.size(); k += 2) {
    const std::size_t next = k + 2 == numbers.size() ? 0 : k + 2;
    twice += (numbers[k] - numbers[0]) * (numbers[next + 1] - numbers[1]) -
             (numbers[k + 1] - numbers[1]) * (numbers[next] - numbers[0]);
  }
  return twice;
}

TEST(Certificate, NoSliverIsWrittenTurnedOver) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> place(0, 100);
  std::uniform_int_distribution<int> exponent(-10, -1);
  Figure figure;
  figure.width = figure.height = 100;
  // Corners beside the longest side, in one turn, by less and less.
  for (int run = 0; run < 3000; ++run) {
    const FigurePoint a = {place(random), place(random)};
    const FigurePoint b = {place(random), place(random)};
    const double off = std::pow(10.0, exponent(random));
    const FigurePoint c = {(a[0] + b[0]) / 2 - off * (b[1] - a[1]) / 100,
                           (a[1] + b[1]) / 2 + off * (b[0] - a[0]) / 100};
    FigureRegion region;
    region.id = "r" + std::to_string(run);
    region.loops = {{a, b, c}};
    figure.regions.push_back(region);
  }
  for (const int decimals : {0, 2, 3, 12}) {
    const FigureCertificate c = certify(".svg", figure, {decimals, 2});
    EXPECT_EQ(c.turned_over, 0u);
    EXPECT_LE(c.largest_move, c.bound + 1e-14);
    EXPECT_EQ(c.finer_points > 0, decimals < 12);
    const std::string bytes = *figure_bytes(".svg", figure, {decimals, 2});
    std::size_t paths = 0;
    for (std::size_t at = 0;; ++paths) {
      at = bytes.find("d=\"M", at);
      if (at == std::string::npos) break;
      at += 4;
      EXPECT_GE(twice_of(bytes.substr(at, bytes.find('Z', at) - at)), -1e-10);
    }
    EXPECT_GT(paths, 1000u);
    EXPECT_LE(paths, figure.regions.size());
  }
}

TEST(Certificate, NoShorterDecimalIsAsNear) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> place(-500, 500);
  Figure figure;
  figure.width = figure.height = 100;
  for (int run = 0; run < 200; ++run) {
    const double x = place(random);
    FigureRegion region;
    region.loops = {{{x, 0}, {x + 5, 0}, {x, 5}}};
    figure.regions = {region};
    const std::string svg = *figure_bytes(".svg", figure, {2, 2});
    const std::size_t at = svg.find("d=\"M") + 4;
    const std::string text = svg.substr(at, svg.find(' ', at) - at);
    EXPECT_LE(std::abs(std::stod(text) - x), 0.005 + 1e-9);
    const std::size_t dot = text.find('.');
    if (dot == std::string::npos) continue;
    const double unit = std::pow(10.0, double(text.size() - dot - 2));
    EXPECT_GT(std::abs(std::round(x * unit) / unit - x), 0.005) << text;
  }
}

}  // namespace
}  // namespace halfspace::io
