#include "booleans/cases.hpp"

#include <algorithm>
#include <cmath>

#include "random.hpp"

namespace halfspace::bench {
namespace {

/// From 0 to 1.
double share(Random& random) {
  return static_cast<double>(random.between(0, 1 << 30)) * 0x1p-30;
}

/// Of length 1; all about evenly.
std::array<double, 3> direction(Random& random) {
  for (;;) {
    std::array<double, 3> d;
    for (double& x : d) x = 2 * share(random) - 1;
    const double length = std::hypot(d[0], d[1], d[2]);
    if (length > 1 || length < 0.1) continue;
    for (double& x : d) x /= length;
    return d;
  }
}

}  // namespace

BooleanCase two_spheres(int triangles, double turn, std::uint64_t seed) {
  Placement second;
  if (seed != 0) {
    Random random(seed);
    second.axis = direction(random);
    second.turn = turn == 0 ? 1 : turn;
    if (turn == 0) {
      second.centre = direction(random);
      for (double& x : second.centre) x *= 0.5 * second.radius;
    }
  } else if (turn == 0) {
    second.turn = 1;
    second.centre = {0.4 * second.radius, 0.25 * second.radius,
                     0.15 * second.radius};
  } else {
    second.turn = turn;
  }
  const int bands = bands_for(triangles);
  const bool is_million = triangles >= 1'000'000;
  const std::string size = is_million
                               ? std::to_string(triangles / 1'000'000) + " M"
                               : std::to_string(triangles / 1000) + " k";
  BooleanCase result{
      "two spheres " + size + (turn == 0 ? ", apart" : ", turned"),
      BooleanOp::kUnion,
      {sphere(bands, {}), sphere(bands, second)}};
  if (is_million) result.repeats = turn == 0 ? 3 : 1;
  if (is_million || (turn != 0 && triangles > 10000))
    result.repeats_of_others = 1;
  result.for_nef = triangles <= 10000;
  return result;
}

BooleanCase same_sphere(int triangles, BooleanOp operation) {
  const Triangles one = sphere(bands_for(triangles), {});
  return {"sphere " + std::to_string(triangles / 1000) + " k, itself, " +
              (operation == BooleanOp::kUnion ? "union" : "difference"),
          operation,
          {one, one}};
}

BooleanCase menger(int level) {
  constexpr std::int64_t kScale = 1024;
  BooleanCase result{"Menger " + std::to_string(level), BooleanOp::kDifference,
                     menger_bars(level, kScale)};
  std::int64_t size = kScale;
  for (int l = 0; l < level; ++l) size *= 3;
  result.operands.insert(result.operands.begin(),
                         block({0, 0, 0}, {size, size, size}));
  if (level == 3) result.least = 21456;
  result.repeats_of_others = 1;
  result.for_corefinement = level < 4;
  return result;
}

BooleanCase plate(bool is_flush) {
  constexpr std::int64_t kPitch = 1 << 16;
  constexpr int kHoles = 10;
  BooleanCase result{is_flush ? "plate, 100 holes" : "plate, 100 drilled",
                     BooleanOp::kDifference,
                     {},
                     13212};
  const std::int64_t more = is_flush ? 0 : kPitch / 4;
  result.repeats_of_others = 1;
  result.operands.push_back(
      block({0, 0, 0}, {kHoles * kPitch, kHoles * kPitch, kPitch}));
  for (int i = 0; i < kHoles; ++i) {
    for (int j = 0; j < kHoles; ++j) {
      result.operands.push_back(
          prism(32, {i * kPitch + kPitch / 2, j * kPitch + kPitch / 2, -more},
                kPitch / 3, kPitch + 2 * more));
    }
  }
  return result;
}

BooleanCase sphere_chain(int count) {
  BooleanCase result{
      "chain of " + std::to_string(count), BooleanOp::kUnion, {}};
  if (count > 100) result.repeats_of_others = 1;
  for (int i = 0; i < count; ++i) {
    Placement at;
    at.radius = 20000;
    at.turn = i;
    // A spiral whose turns are apart: the way along it is 1.2 radii a sphere.
    const double angle = 0.06 * i;
    at.centre = {1.2 * at.radius / 0.06 * std::cos(angle),
                 1.2 * at.radius / 0.06 * std::sin(angle),
                 0.03 * at.radius * i};
    result.operands.push_back(sphere(8, at));
  }
  return result;
}

BooleanCase shared_face(int count) {
  constexpr std::int64_t kSide = 1 << 20;
  BooleanCase result{
      "one face shared by " + std::to_string(count), BooleanOp::kUnion, {}};
  // Steps by the golden ratio and by 2^(1/2) visit a square evenly.
  constexpr double kGolden = 0.6180339887498949, kRoot = 0.4142135623730951;
  for (int i = 0; i < count; ++i) {
    const auto share = [&](double step) {
      return std::llround(static_cast<double>(kSide) *
                          (i * step - std::floor(i * step)));
    };
    result.operands.push_back(pyramid(
        kSide, {share(kGolden), share(kRoot), kSide / 2 + share(kRoot) / 2}));
  }
  result.for_nef = true;
  return result;
}

std::vector<BooleanCase> boolean_cases(std::uint64_t seed) {
  std::vector<BooleanCase> cases;
  for (const double turn : {0.0, 0.01}) {
    for (const int triangles : {1000, 10000, 100000, 1000000})
      cases.push_back(two_spheres(triangles, turn, seed));
  }
  for (const BooleanOp operation : {BooleanOp::kUnion, BooleanOp::kDifference})
    cases.push_back(same_sphere(10000, operation));
  cases.push_back(menger(3));
  cases.push_back(menger(4));
  for (const bool is_flush : {true, false}) cases.push_back(plate(is_flush));
  for (const int count : {100, 1000}) cases.push_back(sphere_chain(count));
  cases.push_back(shared_face(50));
  return cases;
}

Triangles moved(Triangles surface, double turn, std::uint64_t seed) {
  Random random(seed);
  using Point = std::array<double, 3>;
  Point low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
  const auto point_of = [](const GridPoint& p) {
    return Point{static_cast<double>(p.x), static_cast<double>(p.y),
                 static_cast<double>(p.z)};
  };
  for (const GridPoint& p : surface.points) {
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], point_of(p)[k]);
      high[k] = std::max(high[k], point_of(p)[k]);
    }
  }
  const double size =
      std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
  const Point axis = direction(random);
  for (GridPoint& grid_point : surface.points) {
    Point p = point_of(grid_point);
    for (std::size_t k = 0; k < 3; ++k) p[k] -= (low[k] + high[k]) / 2;
    if (turn != 0) p = turned(p, turn, axis);
    for (std::size_t k = 0; k < 3; ++k) {
      p[k] += (low[k] + high[k]) / 2;
      if (turn == 0) p[k] += 0.1 * size * axis[k];
    }
    grid_point = {std::llround(p[0]), std::llround(p[1]), std::llround(p[2])};
  }
  return surface;
}

BooleanCase in_floats(BooleanCase task, int grid_bits, std::uint64_t seed) {
  Random random(seed);
  double extent = 1;
  for (const Triangles& operand : task.operands) {
    for (const GridPoint& p : operand.points) {
      for (const std::int64_t x : {p.x, p.y, p.z})
        extent = std::max(extent, std::abs(static_cast<double>(x)));
    }
  }
  // What comes of it is below 1.
  const double scale = 0.4 * (1 + share(random)) / extent;
  const std::array<double, 3> shift = direction(random);
  const auto placed = [&](std::int64_t x, std::size_t axis) {
    const double at = scale * static_cast<double>(x) + 0.1 * shift[axis];
    return std::llround(
        std::ldexp(double{static_cast<float>(at)}, grid_bits - 1));
  };
  for (Triangles& operand : task.operands) {
    for (GridPoint& p : operand.points)
      p = {placed(p.x, 0), placed(p.y, 1), placed(p.z, 2)};
  }
  return task;
}

}  // namespace halfspace::bench
