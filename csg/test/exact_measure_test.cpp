#include "halfspace/csg/exact_measure.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "halfspace/csg/components.hpp"
#include "halfspace/csg/evaluate.hpp"
#include "halfspace/csg/script.hpp"
#include "halfspace/fast/boolean.hpp"

namespace halfspace::csg {
namespace {

fast::Solid made(const std::string& text) {
  const Result<Script> script = parse_script(text);
  EXPECT_TRUE(script) << text;
  const Result<Plan> plan = make_plan(*script);
  EXPECT_TRUE(plan) << text;
  Result<Operands> operands = Operands::load(*script, *plan, {});
  EXPECT_TRUE(operands) << text;
  const auto solid = evaluate_solid(*plan, *operands, {});
  EXPECT_TRUE(solid) << text;
  return **solid;
}

fast::Solid inside_out(fast::Solid solid) {
  solid.unbounded = true;
  solid = fast::complement(std::move(solid));
  solid.unbounded = false;
  return solid;
}

/// Both orders.
void expect_order(const fast::Solid& a, const fast::Solid& b, int sign) {
  EXPECT_TRUE(a.unit == b.unit || b.faces.empty());
  EXPECT_EQ(compare_volumes(a, b), sign);
  EXPECT_EQ(compare_volumes(b, a), -sign);
}

TEST(ExactMeasure, VolumesAreCompared) {
  // 2^-39 apart, with all on the grid.
  expect_order(made("box(1, 1, 1.0000000000009094947)"),
               made("box(1, 1, 1.000000000002728484)"), -1);
  expect_order(made("box(2, 6, 8)"), made("box(3, 4, 8)"), 0);
  expect_order(made("box(3) - box(1)"), made("box(3)"), -1);
  // Corners that are on no grid, and two parts of the same volume.
  const std::string cut = "(box(2) & rotate(box(3), 1, 2, 3, 40))";
  expect_order(made(cut), made(cut), 0);
  const std::vector<fast::Solid> two =
      components_of(made(cut + " + translate(" + cut + ", 20, 0, 0)"));
  ASSERT_EQ(two.size(), 2u);
  expect_order(two[0], two[1], 0);
  expect_order(made(cut), made(cut + " - box(1)"), 1);
  expect_order(made(cut), fast::Solid{}, 1);
}

TEST(ExactMeasure, VolumesThatFaceInwardsAreBelowNothing) {
  const fast::Solid hole = inside_out(made("box(2)"));
  expect_order(hole, fast::Solid{}, -1);
  expect_order(hole, inside_out(made("box(1)")), -1);
  expect_order(hole, made("box(1)"), -1);
}

/// Cavities of turned boxes, whose corners are on no grid: each is in the part
/// next to it, and not in a larger part or in one of its own size.
TEST(ExactMeasure, CavitiesAreInThePartsNextToThem) {
  const std::string ball = "(box(2) & rotate(box(3), 1, 2, 3, 40))";
  const auto at = [&](const std::string& solid, const char* x) {
    return "translate(" + solid + ", " + x + ", 0, 0)";
  };
  const std::string script =
      "(translate(box(20), -9, -9, -9) - "
      "translate(box(16), -7, -7, -7)) + "
      "(translate(box(8), -3, -3, -3) - " +
      ball + ") + " + at(ball, "20") + " + " +
      at("(box(5) - translate(" + ball + ", 1, 1, 1))", "40");
  std::vector<std::string> volumes;
  for (const fast::Solid& part : components_of(made(script)))
    volumes.push_back(exact_volume_of(part));
  std::sort(volumes.begin(), volumes.end());
  std::vector<std::string> expected{
      exact_volume_of(made("box(20) - translate(box(16), 1, 1, 1)")),
      exact_volume_of(made("box(8) - translate(" + ball + ", 3, 3, 3)")),
      exact_volume_of(made(ball)),
      exact_volume_of(made("box(5) - translate(" + ball + ", 1, 1, 1)"))};
  std::sort(expected.begin(), expected.end());
  EXPECT_EQ(volumes, expected);
}

}  // namespace
}  // namespace halfspace::csg
