#include "papers/paper_models.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "random.hpp"
#include "scenes.hpp"

namespace halfspace::bench {
namespace {

using List = std::vector<VertexId>;

/// A regular polygon's corners about (x, y), rounded, counterclockwise seen
/// from above.
List ring(SceneMaker& maker, const GridPoint& centre, std::int64_t radius,
          std::int32_t sides) {
  List corners;
  for (std::int32_t k = 0; k < sides; ++k) {
    const double angle = 2 * std::numbers::pi * k / sides;
    const auto r = static_cast<double>(radius);
    corners.push_back(
        maker.vertex({centre.x + std::llround(r * std::cos(angle)),
                      centre.y + std::llround(r * std::sin(angle)), centre.z}));
  }
  return corners;
}

/// The side of a prism or pyramid under edge k of its base; quadrilaterals are
/// planar since the top is the bottom, moved.
void add_sides(SceneMaker& maker, const List& bottom, const List& top,
               Rgb color) {
  const std::size_t count = bottom.size();
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t next = (k + 1) % count;
    if (top.size() == 1) {
      maker.polygon({bottom[k], bottom[next], top[0]}, color);
    } else {
      maker.polygon({bottom[k], bottom[next], top[next], top[k]}, color);
    }
  }
}

/// A closed prism, or a pyramid where the top is one point.
void add_solid(SceneMaker& maker, const List& bottom, const List& top,
               Rgb color) {
  add_sides(maker, bottom, top, color);
  if (top.size() > 1) maker.polygon(top, color);
  List floor = bottom;
  std::reverse(floor.begin(), floor.end());
  maker.polygon(floor, color);
}

List block_corners(SceneMaker& maker, const GridPoint& centre, std::int64_t u,
                   std::int64_t v) {
  const auto at = [&](std::int64_t x, std::int64_t y) {
    return maker.vertex({centre.x + x, centre.y + y, centre.z});
  };
  return {at(-u, -v), at(u, -v), at(u, v), at(-u, v)};
}

void add_ball(SceneMaker& maker, const GridPoint& centre, std::int64_t radius,
              Rgb color) {
  constexpr std::int32_t kRings = 12;
  constexpr std::int32_t kSectors = 20;
  std::vector<List> rings;
  for (std::int32_t j = 0; j <= kRings; ++j) {
    const double angle = std::numbers::pi * j / kRings;
    const auto r = static_cast<double>(radius);
    const GridPoint level = {centre.x, centre.y,
                             centre.z - std::llround(r * std::cos(angle))};
    if (j == 0 || j == kRings) {
      rings.push_back({maker.vertex(level)});
    } else {
      rings.push_back(
          ring(maker, level, std::llround(r * std::sin(angle)), kSectors));
    }
  }
  const auto corner = [](const List& list, std::size_t k) {
    return list[k % list.size()];
  };
  for (std::size_t j = 0; j + 1 < rings.size(); ++j) {
    const List& low = rings[j];
    const List& high = rings[j + 1];
    for (std::size_t k = 0; k < kSectors; ++k) {
      if (low.size() > 1) {
        maker.polygon({low[k], corner(low, k + 1), corner(high, k + 1)}, color);
      }
      if (high.size() > 1) {
        maker.polygon({corner(low, k), corner(high, k + 1), high[k]}, color);
      }
    }
  }
}

}  // namespace

Scene three_atoms() {
  SceneMaker maker;
  constexpr std::int64_t kUnit = kStepsPerUnit;
  add_ball(maker, {0, 0, 0}, 300 * kUnit, {200, 60, 60});
  add_ball(maker, {310 * kUnit, 70 * kUnit, 40 * kUnit}, 230 * kUnit,
           {230, 230, 230});
  add_ball(maker, {-170 * kUnit, 260 * kUnit, -90 * kUnit}, 230 * kUnit,
           {120, 160, 230});
  return std::move(maker).scene();
}

Scene cylinders_cones_blocks(std::uint64_t seed) {
  // Fifteen solids in a field of 4 x 4 places, each in the middle of its own.
  Random random(seed);
  SceneMaker maker;
  constexpr std::int64_t kUnit = kStepsPerUnit;
  constexpr std::int64_t kPlace = 250;
  std::vector<std::int64_t> places(16);
  for (std::size_t k = 0; k < 16; ++k) places[k] = static_cast<int>(k);
  for (std::size_t k = 15; k > 0; --k) {
    const auto other = random.between(0, static_cast<std::int64_t>(k));
    std::swap(places[k], places[static_cast<std::size_t>(other)]);
  }
  for (std::size_t k = 0; k < 15; ++k) {
    const auto jitter = [&random] { return random.between(-20, 20) * kUnit; };
    const GridPoint base = {(places[k] % 4 * kPlace - 375) * kUnit + jitter(),
                            (places[k] / 4 * kPlace - 375) * kUnit + jitter(),
                            0};
    const std::int64_t radius = random.between(40, 100) * kUnit;
    const std::int64_t depth = random.between(40, 100) * kUnit;
    const GridPoint top = {base.x, base.y, random.between(60, 400) * kUnit};
    const Rgb color = color_of(random.next());
    if (k < 4) {
      add_solid(maker, ring(maker, base, radius, 10),
                ring(maker, top, radius, 10), color);
    } else if (k < 8) {
      add_solid(maker, ring(maker, base, radius, 8), {maker.vertex(top)},
                color);
    } else {
      add_solid(maker, block_corners(maker, base, radius, depth),
                block_corners(maker, top, radius, depth), color);
    }
  }
  return std::move(maker).scene();
}

Scene cyclic_groups(std::int32_t per_group, std::uint64_t seed) {
  Random random(seed);
  SceneMaker maker;
  constexpr std::int64_t kUnit = kStepsPerUnit;
  for (std::int32_t group = 0; group < 3; ++group) {
    const double turn = 2 * std::numbers::pi * group / 3;
    const double x = 280 * std::cos(turn), y = 280 * std::sin(turn);
    const auto corner = [&](double number, double radius) {
      const double a = 2 * std::numbers::pi * number / per_group + turn / 7;
      return std::pair(x + radius * std::cos(a), y + radius * std::sin(a));
    };
    for (std::int32_t k = 0; k < per_group; ++k) {
      // From before corner k, where the wall before it ends against this one,
      // to just short of corner k + 1, where the next one passes.
      const auto [ax, ay] = corner(k, 150);
      const auto [bx, by] = corner(k + 1, 150);
      const auto at = [&](double share, std::int64_t z) {
        const double px = ax + share * (bx - ax);
        const double py = ay + share * (by - ay);
        return maker.vertex(
            {std::llround(px * kUnit), std::llround(py * kUnit), z * kUnit});
      };
      const std::int64_t low = random.between(-200, -100);
      const std::int64_t high = random.between(100, 200);
      maker.polygon(
          {at(-0.2, low), at(0.98, low), at(0.98, high), at(-0.2, high)},
          color_of(random.next()));
    }
  }
  return std::move(maker).scene();
}

}  // namespace halfspace::bench
