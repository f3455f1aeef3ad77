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

BooleanCase plate() {
  constexpr std::int64_t kPitch = 1 << 16;
  constexpr int kHoles = 10;
  BooleanCase result{"plate, 100 holes", BooleanOp::kDifference, {}, 13212};
  result.repeats_of_others = 1;
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

std::vector<BooleanCase> boolean_cases() {
  std::vector<BooleanCase> cases;
  for (const double turn : {0.0, 0.01}) {
    for (const int triangles : {1000, 10000, 100000, 1000000})
      cases.push_back(two_spheres(triangles, turn));
  }
  cases.push_back(menger(3));
  cases.push_back(menger(4));
  cases.push_back(plate());
  for (const int count : {100, 1000}) cases.push_back(sphere_chain(count));
  cases.push_back(shared_face(50));
  return cases;
}

}  // namespace halfspace::bench
