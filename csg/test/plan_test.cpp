#include "halfspace/csg/plan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace halfspace::csg {
namespace {

Result<Plan> planned(const std::string& text) {
  const Result<Script> script = parse_script(text);
  EXPECT_TRUE(script) << script.error().message;
  if (!script) return script.error();
  return make_plan(*script);
}

const Step& result_of(const Plan& plan) { return plan.steps.back(); }

TEST(CsgPlan, LongUnionsAreOneStep) {
  for (const char* text :
       {"'a'|'b'|'c'|'d'", "'a'|('b'|('c'|'d'))", "('a'|'b')|('c'|'d')",
        "x='a'|'b'\ny=x|'c'\ny|'d'"}) {
    const Result<Plan> plan = planned(text);
    ASSERT_TRUE(plan);
    ASSERT_EQ(plan->steps.size(), 5u) << text;
    std::string files;
    for (const std::int32_t term : result_of(*plan).terms) {
      const Step& leaf = plan->steps[static_cast<std::size_t>(term)];
      files += static_cast<char>(
          'a' + plan->leaves[static_cast<std::size_t>(leaf.item)].file);
    }
    EXPECT_EQ(files, "abcd") << text;
    EXPECT_EQ(plan->booleans, 3u);
  }
}

/// Where faces coincide, another order would give them to others.
TEST(CsgPlan, SymmetricDifferencesStayAsTheyStand) {
  for (const auto& [text, terms] : {std::pair{"'a'^('b'^'c')", 2u},
                                    {"('a'^'b')^('c'^'d')", 2u},
                                    {"'a'^'b'^'c'", 2u},
                                    {"'a'^('b'|'c'|'d')", 2u}}) {
    const Result<Plan> plan = planned(text);
    ASSERT_TRUE(plan);
    EXPECT_EQ(result_of(*plan).terms.size(), terms) << text;
  }
  // A call of many takes them two by two.
  std::string call = "symmetric_difference('a0'";
  for (int i = 1; i < 32; ++i) call += ", 'a" + std::to_string(i) + "'";
  const Result<Plan> plan = planned(call + ")");
  ASSERT_TRUE(plan);
  EXPECT_EQ(plan->booleans, 31u);
  std::vector<int> depth(plan->steps.size());
  for (std::size_t i = 0; i < depth.size(); ++i) {
    for (const std::int32_t term : plan->steps[i].terms)
      depth[i] = std::max(depth[i], depth[static_cast<std::size_t>(term)] + 1);
  }
  EXPECT_EQ(depth.back(), 5);
}

TEST(CsgPlan, DifferencesGatherWhatGoes) {
  const Result<Plan> plan = planned("'a'-'b'-('c'|'d')-'e'");
  ASSERT_TRUE(plan);
  EXPECT_EQ(result_of(*plan).terms.size(), 5u);
  const Result<Plan> kept = planned("'a'-('b'-'c')");
  ASSERT_TRUE(kept);
  EXPECT_EQ(result_of(*kept).terms.size(), 2u);
}

TEST(CsgPlan, WhatIsUsedTwiceIsDoneOnce) {
  const Result<Plan> plan = planned("x='a'|'b'\n(x|'c')-(x|'d')");
  ASSERT_TRUE(plan);
  // Four files, x, x|'c', and that less x and 'd'.
  EXPECT_EQ(plan->steps.size(), 7u);
  EXPECT_EQ(result_of(*plan).terms.size(), 3u);
  const Result<Plan> moved =
      planned("translate('a',1,0,0)|translate(translate('a',2,0,0),-1,0,0)");
  ASSERT_TRUE(moved);
  EXPECT_EQ(moved->leaves.size(), 1u);
  EXPECT_EQ(moved->steps.front().uses, 2);
}

TEST(CsgPlan, TransformsGoIntoTheLeaves) {
  const Result<Plan> plan =
      planned("translate(scale('a' - rotate('b', 0, 0, 1, 90), 2), 5, 6, 7)");
  ASSERT_TRUE(plan);
  ASSERT_EQ(plan->leaves.size(), 2u);
  const auto image = [&](std::size_t leaf, double x, double y, double z) {
    const Numbers3 point = {io::number_of(x), io::number_of(y),
                            io::number_of(z)};
    const Numbers3 at = image_of(
        plan->matrices[static_cast<std::size_t>(plan->leaves[leaf].matrix)],
        point);
    return std::array{io::to_double(at[0]), io::to_double(at[1]),
                      io::to_double(at[2])};
  };
  EXPECT_EQ(image(0, 1, 2, 3), (std::array{7.0, 10.0, 13.0}));
  EXPECT_EQ(image(1, 1, 2, 3), (std::array{1.0, 8.0, 13.0}));
}

TEST(CsgPlan, HalvesComeLastAndTurnWithMirrors) {
  const Result<Plan> plan =
      planned("half(x < 1) & 'a' & half(z > 2) & scale('b', 1, 1, -1)");
  ASSERT_TRUE(plan);
  EXPECT_EQ(result_of(*plan).halves, 2u);
  EXPECT_EQ(
      plan->steps[static_cast<std::size_t>(result_of(*plan).terms[0])].kind,
      NodeKind::kFile);
  const Result<Plan> mirrored = planned("scale('a' & half(x < 1), -1, 1, 1)");
  const Result<Plan> other = planned("scale('a', -1, 1, 1) & half(x > -1)");
  ASSERT_TRUE(mirrored);
  ASSERT_TRUE(other);
  // The same plane, and the same side of it, by the turn of its points.
  const auto turn = [](const Plan& p) {
    const HalfSpace& h = p.planes.front().points;
    const auto c = [&](std::size_t i, std::size_t k) {
      return io::to_double(h[i][k]) - io::to_double(h[0][k]);
    };
    EXPECT_EQ(io::to_double(h[0][0]), -1);
    return c(1, 1) * c(2, 2) - c(1, 2) * c(2, 1);
  };
  EXPECT_EQ(turn(*mirrored), turn(*other));
  EXPECT_LT(turn(*other), 0);
}

TEST(CsgPlan, SurfacesThatReachInfinitelyFarAreRefused) {
  const auto verdict = [](const std::string& text) {
    const Result<Plan> plan = planned(text);
    if (plan) return std::string("fine");
    EXPECT_EQ(plan.error().code, ErrorCode::kUnbounded);
    return plan.error().message.substr(0, 17);
  };
  for (const char* fine :
       {"'a' & half(x<1)", "'a' - half(x<1)", "'a' & ~half(x<1)", "~~'a'",
        "~'a' ^ ~'b'", "~'a' & 'b'", "'a' - ~'b'", "~(~'a' | 'b')",
        "~(~'a' | half(x<1))", "'a' & half(x<1) & half(x>0)",
        "~'a' - ~'b' - half(x<1)", "~'a' - ~'b'"})
    EXPECT_EQ(verdict(fine), "fine") << fine;
  EXPECT_EQ(verdict("'a' | half(x<1)"), "line 1, column 5:");
  EXPECT_EQ(verdict("'a' ^ half(x<1)"), "line 1, column 5:");
  EXPECT_EQ(verdict("half(x<1) & half(x>0)"), "line 1, column 11");
  EXPECT_EQ(verdict("'a' & (half(x<1) & half(x>0) ^ 'b')"),
            "line 1, column 18");
  EXPECT_EQ(verdict("half(x<1) - 'a'"), "line 1, column 11");
  EXPECT_EQ(verdict("~'a' & half(x<1)"), "line 1, column 6:");
  EXPECT_EQ(verdict("half(x<1)"), "line 1, column 1:");
  EXPECT_EQ(verdict("~'a'"), "line 1, column 1:");
  EXPECT_EQ(verdict("~half(x<1)"), "line 1, column 1:");
}

TEST(CsgPlan, DoublingWithoutEndIsRefused) {
  std::string text = "x='a'\n";
  for (int i = 0; i < 64; ++i)
    text += "x=x|translate(x," + std::to_string(1 << (i % 30)) + ",0,0)\n";
  const Result<Script> script = parse_script(text);
  ASSERT_TRUE(script);
  const Result<Plan> plan = make_plan(*script, /*most_steps=*/5000);
  ASSERT_FALSE(plan);
  EXPECT_EQ(plan.error().code, ErrorCode::kOutOfRange);
  std::string deep;
  for (int i = 0; i < 10; ++i) deep += "scale(";
  deep += "'a'";
  for (int i = 0; i < 10; ++i) deep += ",1e-1000)";
  const Result<Plan> small = planned(deep);
  ASSERT_FALSE(small);
  EXPECT_EQ(small.error().code, ErrorCode::kOutOfRange);
}

TEST(CsgPlan, DepthCostsNoStack) {
  constexpr int kDepth = 100'000;
  std::string left;
  std::string right;
  for (int i = 0; i < kDepth; ++i) {
    left += "'a'-";
    right += "'a'|(";
  }
  const Result<Plan> chain = planned(left + "'a'");
  ASSERT_TRUE(chain);
  EXPECT_EQ(chain->booleans, std::size_t{kDepth});
  const Result<Plan> nest = planned(right + "'a'" + std::string(kDepth, ')'));
  ASSERT_TRUE(nest);
  EXPECT_EQ(result_of(*nest).terms.size(), std::size_t{kDepth} + 1);
  EXPECT_TRUE(planned(std::string(kDepth, '~') + "'a'"));
}

}  // namespace
}  // namespace halfspace::csg
