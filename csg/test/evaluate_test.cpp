#include "halfspace/csg/evaluate.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "halfspace/csg/outcome.hpp"
#include "halfspace/csg/script.hpp"
#include "halfspace/fast/boolean.hpp"

namespace halfspace::csg {
namespace {

/// A folder of its own with a cube of edge 2 as `cube.off`.
class CsgEvaluate : public ::testing::Test {
 protected:
  CsgEvaluate() {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() /
              (std::string("halfspace_csg_") + test->name());
    std::filesystem::create_directories(folder_);
    std::ofstream(folder_ / "cube.off")
        << "OFF\n8 6 0\n"
           "0 0 0\n2 0 0\n0 2 0\n2 2 0\n0 0 2\n2 0 2\n0 2 2\n2 2 2\n"
           "4 0 2 3 1\n4 4 5 7 6\n4 0 1 5 4\n4 2 6 7 3\n4 0 4 6 2\n4 1 3 7 5\n";
  }
  std::ofstream file(const char* name) const {
    return std::ofstream(folder_ / name);
  }
  ~CsgEvaluate() override { std::filesystem::remove_all(folder_); }

  using Evaluation = Result<std::optional<Outcome>> (*)(const Plan&, Operands&,
                                                        const EvaluateOptions&);
  Result<std::optional<Outcome>> evaluated(const std::string& text,
                                           const EvaluateOptions& options,
                                           Evaluation by = evaluate_fast) {
    const Result<Script> script = parse_script(text);
    if (!script) return script.error();
    const Result<Plan> plan = make_plan(*script);
    if (!plan) return plan.error();
    Result<Operands> operands =
        Operands::load(*script, *plan, {.folder = folder_.string()});
    if (!operands) return operands.error();
    return by(*plan, *operands, options);
  }

 private:
  std::filesystem::path folder_;
};

constexpr const char* kDrilled = "'cube.off' - translate('cube.off', 1, 1, 1)";

TEST_F(CsgEvaluate, BothLibrariesHaveTheSameVolume) {
  for (const Evaluation by : {evaluate_fast, evaluate_ref}) {
    const auto outcome = evaluated(kDrilled, {}, by);
    ASSERT_TRUE(outcome) << outcome.error().message;
    ASSERT_TRUE(outcome->has_value());
    EXPECT_EQ((*outcome)->volume.value(), 7);
    EXPECT_EQ((*outcome)->bad_edges, 0u);
    EXPECT_TRUE((*outcome)->scene);
  }
}

TEST_F(CsgEvaluate, ProgressStopsTheWork) {
  EvaluateOptions options;
  double share = 0;
  options.progress = [&share](double done) {
    share = done;
    return false;
  };
  for (const Evaluation by : {evaluate_fast, evaluate_ref}) {
    share = 0;
    const auto outcome = evaluated(kDrilled, options, by);
    ASSERT_TRUE(outcome);
    EXPECT_FALSE(outcome->has_value());
    EXPECT_EQ(share, 1);
  }
}

TEST_F(CsgEvaluate, CombineGetsEveryBooleanOfTwoSolidsWithoutHalves) {
  EvaluateOptions options;
  std::vector<BooleanOp> operations;
  options.combine = [&operations](BooleanOp operation, const fast::Solid& a,
                                  const fast::Solid& b) {
    operations.push_back(operation);
    return fast::boolean(operation, a, b);
  };
  const auto outcome =
      evaluated(std::string("(") + kDrilled + ") & half(x < 1)", options);
  ASSERT_TRUE(outcome) << outcome.error().message;
  EXPECT_EQ((*outcome)->volume.value(), 4);
  EXPECT_EQ(operations, std::vector{BooleanOp::kDifference});
}

TEST_F(CsgEvaluate, OriginsNameLeafAndPolygon) {
  const auto outcome = evaluated("'cube.off' & half(z < 1)", {});
  ASSERT_TRUE(outcome);
  const Outcome& made = **outcome;
  ASSERT_EQ(made.origins.size(), 6u);
  std::size_t of_half = 0;
  for (const Origin& origin : made.origins) of_half += origin.leaf == 1;
  EXPECT_EQ(of_half, 1u);
}

TEST_F(CsgEvaluate, TheReferenceHasNoHalfSpaces) {
  const auto outcome = evaluated("'cube.off' & half(z < 1)", {}, evaluate_ref);
  ASSERT_FALSE(outcome);
  EXPECT_EQ(outcome.error().code, ErrorCode::kUnknownFormat);
}

/// Prints a square plate with 4 `count` corners on its rim.
void print_plate(std::ostream& out, int count) {
  const int n = 4 * count;
  out << "OFF\n" << 2 * n << " " << n + 2 << " 0\n";
  for (const int z : {0, 5}) {
    for (int i = 0; i < n; ++i) {
      const int side = i / count, at = i % count;
      const int along = side < 2 ? at : count - at;
      const int end = side == 1 || side == 2 ? count : 0;
      out << 0.7 * (side % 2 == 0 ? along : end) << " "
          << 0.7 * (side % 2 == 0 ? end : along) << " " << z << "\n";
    }
  }
  out << n;
  for (int i = n - 1; i >= 0; --i) out << " " << i;
  out << "\n" << n;
  for (int i = n; i < 2 * n; ++i) out << " " << i;
  for (int i = 0; i < n; ++i) {
    const int j = (i + 1) % n;
    out << "\n4 " << i << " " << j << " " << n + j << " " << n + i;
  }
}

/// Rounding bends sides of many corners, and the faces of floats do so again.
TEST_F(CsgEvaluate, PlatesWithManyCornersOnTheirRimsCanBeTurned) {
  auto file = this->file("plate.off");
  print_plate(file, 140);
  file.close();
  EvaluateOptions options;
  options.number = fast::FileNumber::kFloat;
  for (int angle = 10; angle < 90; angle += 10) {
    const auto outcome = evaluated(
        "rotate('plate.off', 2, 7, 3, " + std::to_string(angle) + ")", options);
    ASSERT_TRUE(outcome) << angle << ": " << outcome.error().message;
    const Outcome& made = **outcome;
    EXPECT_NEAR(made.volume.value(), 98 * 98 * 5, 0.2);
    EXPECT_LT(made.max_move, 2e-5);
    EXPECT_TRUE(!made.rounding || made.rounding->contacts == 0);
  }
}

}  // namespace
}  // namespace halfspace::csg
