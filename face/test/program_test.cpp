// What the library makes of files, beside what the program makes of them.
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "halfspace/csg/operands.hpp"
#include "halfspace/csg/outcome.hpp"
#include "halfspace/csg/plan.hpp"
#include "halfspace/csg/script.hpp"
#include "halfspace/halfspace.hpp"
#include "halfspace/io/write_mesh.hpp"
#include "halfspace/solid_file.hpp"

namespace halfspace {
namespace {

std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// What `halfspace csg SCRIPT A=A B=B -o x.stl` writes; nothing where it fails.
/// The grid's bits go to `grid_bits`.
std::string program_bytes(const std::string& text, const std::string& a,
                          const std::string& b, int& grid_bits) {
  const std::array<csg::Binding, 2> bindings = {{{"A", a}, {"B", b}}};
  const auto script = csg::parse_script(text, bindings);
  EXPECT_TRUE(script);
  const auto plan = csg::make_plan(*script);
  EXPECT_TRUE(plan);
  auto operands = csg::Operands::load(*script, *plan, {});
  if (!operands) return {};
  csg::EvaluateOptions options;
  options.triangles = true;
  options.number = fast::FileNumber::kFloat;
  auto result = csg::evaluate_fast(*plan, *operands, options);
  if (!result && operands->can_be_finer()) {
    operands = operands->on_finest_grid();
    result = csg::evaluate_fast(*plan, *operands, options);
  }
  if (!result) return {};
  grid_bits = operands->report().grid_bits;
  EXPECT_TRUE(io::write_mesh("program.stl", (*result)->mesh, false));
  return bytes_of("program.stl");
}

/// What `halfspace csg SCRIPT A=A B=B -o x.hsolid` writes; nothing where it
/// fails.
std::string program_solid(const std::string& text, const std::string& a,
                          const std::string& b) {
  std::vector<csg::Binding> bindings = {{"A", a}};
  if (text.find('B') != std::string::npos) bindings.push_back({"B", b});
  const auto script = csg::parse_script(text, bindings);
  EXPECT_TRUE(script);
  const auto plan = csg::make_plan(*script);
  EXPECT_TRUE(plan);
  auto operands = csg::Operands::load(*script, *plan, {});
  if (!operands) return {};
  csg::EvaluateOptions options;
  options.exact_data = true;
  const auto result = csg::evaluate_fast(*plan, *operands, options);
  if (!result) return {};
  return write_solid(*(*result)->data, SolidForm::kBinary);
}

/// Octahedra whose corners have random distances from their middles: whatever
/// these are, they are solids.
class Octahedra {
 public:
  explicit Octahedra(std::uint32_t seed) : engine_(seed) {}
  std::size_t below(std::size_t n) { return engine_() % n; }
  /// `digits` in all before the exponent; units of ten to the power `scale`.
  void write(const std::string& path, int digits, int scale) {
    std::ofstream file(path);
    file << "OFF\n6 8 0\n";
    const std::array<std::string, 3> middle = {number(digits, scale),
                                               number(digits, scale), "0"};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const char* sign : {"-", ""}) {
        std::array<std::string, 3> point = middle;
        point[axis] = sign + number(digits, scale + 1);
        file << point[0] << ' ' << point[1] << ' ' << point[2] << '\n';
      }
    }
    file << "3 1 3 5\n3 3 0 5\n3 0 2 5\n3 2 1 5\n"
            "3 3 1 4\n3 0 3 4\n3 2 0 4\n3 1 2 4\n";
  }

 private:
  std::string number(int digits, int scale) {
    std::string text = "1.";
    for (int k = 1; k < digits; ++k)
      text += static_cast<char>('0' + engine_() % 10);
    return text + "e" + std::to_string(scale);
  }
  std::mt19937 engine_;
};

/// How the second file is moved, in a script and by the library.
struct Move {
  const char* text;
  Solid (*moved)(const Solid&);
};
const std::array<Move, 4> kMoves = {
    {{"B", [](const Solid& b) { return b; }},
     {"translate(B, 0.25, 1.5, -0.125)",
      [](const Solid& b) {
        return b.translated({0.25, 1.5, -0.125});
      }},
     {"rotate(B, 0, 0, 1, 90)",
      [](const Solid& b) {
        return b.rotated({0, 0, 1}, 90);
      }},
     {"rotate(B, 1, 2, 3, 30)", [](const Solid& b) {
        return b.rotated({1, 2, 3}, 30);
      }}}};

// Decimals of up to 20 digits: some no grid holds, and some hold one another.
TEST(FaceFiles, RoundedAsTheProgramRoundsThem) {
  const OperandOptions as_program = {.merge_coplanar = false,
                                     .may_round = true};
  const std::array<int, 6> digits = {4, 9, 13, 15, 17, 20};
  Octahedra random(25);
  int held = 0, rounded = 0;
  for (int round = 0; round < 120; ++round) {
    for (const char* name : {"face_a.off", "face_b.off"}) {
      random.write(name, digits[random.below(digits.size())],
                   static_cast<int>(random.below(4)) - 1);
    }
    const Move& move = kMoves[random.below(kMoves.size())];
    int grid_bits = 0;
    const std::string expected = program_bytes(
        std::string("A - ") + move.text, "face_a.off", "face_b.off", grid_bits);
    const Solid a = Solid::from_file("face_a.off", as_program);
    const Solid b = Solid::from_file("face_b.off", as_program);
    const Solid result = a - move.moved(b);
    const auto saved = result.save("face.stl");
    ASSERT_EQ(bool(saved), !expected.empty()) << round << move.text;
    if (!saved) continue;
    ASSERT_EQ(bytes_of("face.stl"), expected) << round << move.text;
    const auto rounding = result.rounding();
    ASSERT_EQ(rounding->grid_bits, grid_bits) << round << move.text;
    ++(rounding->moved > 0 ? rounded : held);
  }
  EXPECT_GT(held, 20);
  EXPECT_GT(rounded, 20);
}

// What a grid holds stays as it is beside what none holds, asked for or not.
TEST(FaceFiles, WhatAGridHoldsIsNotRounded) {
  Octahedra random(26);
  random.write("held_a.off", 20, 0);
  random.write("held_b.off", 4, 0);
  const Solid a = Solid::from_file("held_a.off");
  const Solid b = Solid::from_file("held_b.off");
  const Solid kept = a & b;
  const auto rounding = kept.rounding();
  ASSERT_TRUE(rounding) << rounding.error().message;
  EXPECT_EQ(rounding->grid_bits, 54);
  EXPECT_GT(rounding->moved, 0U);
  EXPECT_LT(rounding->max_move, 1e-14);
  EXPECT_EQ(*((a + b) & b).exact_volume(), *b.exact_volume());
}

// Results, and what goes on from their files: of files, moved copies of them
// and half-spaces, named more than once.
TEST(FaceFiles, ExactOnesHaveTheBytesOfTheProgram) {
  const OperandOptions as_program = {.merge_coplanar = false};
  Octahedra random(21);
  std::size_t compared = 0, meets = 0;
  for (int round = 0; round < 60; ++round) {
    for (const char* name : {"exact_a.off", "exact_b.off"})
      random.write(name, 4, static_cast<int>(random.below(2)));
    const Move& move = kMoves[random.below(3)];
    const Move& other = kMoves[random.below(3)];
    const Solid a = Solid::from_file("exact_a.off", as_program);
    const Solid b = Solid::from_file("exact_b.off", as_program);
    Solid made = a;
    std::string text = "A";
    const std::size_t steps = 1 + random.below(3);
    for (std::size_t step = 0; step < steps; ++step) {
      const Solid next = (step == 0 ? move : other).moved(b);
      const std::string said = (step == 0 ? move : other).text;
      switch (random.below(5)) {
        case 0:
          made = made + next;
          text = "(" + text + " | " + said + ")";
          break;
        case 1:
          made = made & next;
          text = "(" + text + " & " + said + ")";
          break;
        case 2:
          made = made ^ next;
          text = "(" + text + " ^ " + said + ")";
          break;
        case 3:
          made = made & Solid::from_text("half(x < 0.25)");
          text = "(" + text + " & half(x < 0.25))";
          break;
        default:
          made = made - next;
          text = "(" + text + " - " + said + ")";
      }
    }
    const std::string expected =
        program_solid(text, "exact_a.off", "exact_b.off");
    if (expected.empty()) continue;
    ASSERT_TRUE(made.save("exact_face.hsolid"));
    ASSERT_EQ(bytes_of("exact_face.hsolid"), expected) << text;
    ++compared;
    meets += expected.find("@ ") != std::string::npos ? 1u : 0u;
    // And once more, from that file.
    const Solid read = Solid::from_file("exact_face.hsolid", as_program);
    const std::string on =
        program_solid("translate(A, 1, 0, 0.5) - " + std::string(move.text),
                      "exact_face.hsolid", "exact_b.off");
    if (on.empty()) continue;
    ASSERT_TRUE((read.translated({1, 0, 0.5}) - move.moved(b))
                    .save("exact_chain.hsolid"));
    ASSERT_EQ(bytes_of("exact_chain.hsolid"), on) << text;
  }
  EXPECT_GT(compared, 50u);
  EXPECT_GT(meets, 20u);  // names that say where a part stands
}

}  // namespace
}  // namespace halfspace
