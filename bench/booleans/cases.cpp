#include "booleans/cases.hpp"

#include <cmath>

namespace halfspace::bench {

BooleanCase two_spheres(int triangles, double turn) {
  Placement second;
  if (turn == 0) {
    second.turn = 1;
    second.centre = {0.4 * second.radius, 0.25 * second.radius,
                     0.15 * second.radius};
  } else {
    second.turn = turn;
  }
  const int bands = bands_for(triangles);
  const std::string size = std::to_string(triangles / 1000) + " k";
  return {"two spheres " + size + (turn == 0 ? ", apart" : ", turned"),
          BooleanOp::kUnion,
          {sphere(bands, {}), sphere(bands, second)}};
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
  result.for_peers = level < 4;
  return result;
}

BooleanCase plate() {
  constexpr std::int64_t kPitch = 1 << 16;
  constexpr int kHoles = 10;
  BooleanCase result{"plate, 100 holes", BooleanOp::kDifference, {}, 13212};
  result.operands.push_back(
      block({0, 0, 0}, {kHoles * kPitch, kHoles * kPitch, kPitch}));
  for (int i = 0; i < kHoles; ++i) {
    for (int j = 0; j < kHoles; ++j) {
      result.operands.push_back(
          prism(32, {i * kPitch + kPitch / 2, j * kPitch + kPitch / 2, 0},
                kPitch / 3, kPitch));
    }
  }
  return result;
}

BooleanCase sphere_chain(int count) {
  BooleanCase result{
      "chain of " + std::to_string(count), BooleanOp::kUnion, {}};
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

std::vector<BooleanCase> boolean_cases() {
  std::vector<BooleanCase> cases;
  for (const double turn : {0.0, 0.01}) {
    for (const int triangles : {1000, 10000, 100000})
      cases.push_back(two_spheres(triangles, turn));
  }
  cases.push_back(menger(3));
  cases.push_back(menger(4));
  cases.push_back(plate());
  for (const int count : {100, 1000}) cases.push_back(sphere_chain(count));
  return cases;
}

}  // namespace halfspace::bench
