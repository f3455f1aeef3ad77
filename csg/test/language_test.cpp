#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "halfspace/csg/measure.hpp"
#include "halfspace/csg/operands.hpp"
#include "halfspace/csg/outcome.hpp"
#include "halfspace/csg/plan.hpp"
#include "halfspace/csg/script.hpp"

namespace halfspace::csg {
namespace {

/// The volume of the script's result, or what is wrong with it.
std::string volume_of(const std::string& text) {
  const Result<Script> script = parse_script(text);
  if (!script) return script.error().message;
  const Result<Plan> plan = make_plan(*script);
  if (!plan) return plan.error().message;
  Result<Operands> operands = Operands::load(*script, *plan, {});
  if (!operands) return operands.error().message;
  const auto outcome = evaluate_fast(*plan, *operands, {});
  if (!outcome) return outcome.error().message;
  char shown[32];
  std::snprintf(shown, sizeof shown, "%.9g", (*outcome)->volume.value());
  return shown;
}

TEST(CsgLanguage, CountsExactly) {
  EXPECT_EQ(volume_of("w = 0.1 + 0.2\nbox(w, 10, 10)"), "30");
  EXPECT_EQ(volume_of("box(2 * 3 - 4, 7 / 2, -(-1))"), "7");
  EXPECT_EQ(volume_of("box(1, 1 + 2 * 3, (1 + 2) * 3)"), "63");
  EXPECT_EQ(volume_of("box(sqrt(16), abs(-2), floor(3.9))"), "24");
  EXPECT_EQ(volume_of("box(min(3, 2, 5), max([1, [4]]), sin(30))"), "4");
  EXPECT_EQ(volume_of("box(cos(60), tan(45), cos(360))"), "0.5");
  EXPECT_EQ(volume_of("box(floor(-0.5) + 3, 1, 1)"), "2");
  EXPECT_EQ(volume_of("box(1 / 3 * 3, 1, 1)"), "1");
}

TEST(CsgLanguage, HasPrimitives) {
  EXPECT_EQ(volume_of("box(2)"), "8");
  EXPECT_EQ(volume_of("box(2, 3, 4)"), "24");
  // A square of diagonal 4 as base.
  EXPECT_EQ(volume_of("cylinder(2, 5, 4)"), "40");
  EXPECT_EQ(volume_of("cone(2, 0, 3, 4)"), "8");
  EXPECT_EQ(volume_of("cone(0, 2, 3, 4)"), "8");
  EXPECT_EQ(volume_of("cone(2, 1, 3, 4)"), "14");
  EXPECT_EQ(volume_of("hull(0, 0, 0, 1, 0, 0, 0, 1, 0, [0, 0, 3], [0.1, 0.1, "
                      "0.1])"),
            "0.5");
  EXPECT_NE(volume_of("hull(0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0)")
                .find("line 1, column 1: hull: all points are in one plane"),
            std::string::npos);
  EXPECT_NE(volume_of("hull(1, 2, 3)").find("hull takes 3 numbers"),
            std::string::npos);
  // A square tube of area 2 about a square.
  EXPECT_EQ(volume_of("torus(3, 1, 4, 4)"), "24");
  EXPECT_EQ(volume_of("torus(3, 1)").substr(0, 3), "57.");
  EXPECT_NE(volume_of("torus(1, 1)").find("torus takes a radius and a lesser"),
            std::string::npos);
  EXPECT_NE(volume_of("torus(3, 1, 2)").find("torus takes"), std::string::npos);
  // An octahedron.
  EXPECT_EQ(volume_of("sphere(3, 4)"), "36");
  EXPECT_EQ(volume_of("sphere(1, 100)").substr(0, 4), "4.18");
}

TEST(CsgLanguage, CombinesManyAndLists) {
  EXPECT_EQ(volume_of("union(box(1), [box(2), box(3)])"), "27");
  EXPECT_EQ(volume_of("intersection(box(1), box(2), box(3))"), "1");
  EXPECT_EQ(volume_of("difference(box(3), box(2), box(1))"), "19");
  EXPECT_EQ(volume_of("symmetric_difference(box(3), box(2))"), "19");
  EXPECT_EQ(volume_of("union(box(2))"), "8");
}

TEST(CsgLanguage, RepeatsAndNames) {
  EXPECT_EQ(volume_of("union([for i in range(5): translate(box(1), 2 * i, 0, "
                      "0)])"),
            "5");
  EXPECT_EQ(volume_of("union([for i in range(3): [for j in range(i): "
                      "translate(box(1), 2 * i, 2 * j, 0)]])"),
            "3");
  EXPECT_EQ(volume_of("sizes = [1, 2, [3, 4]]\n"
                      "box(sizes[1], sizes[2][1], length(sizes))"),
            "24");
  EXPECT_EQ(volume_of("union([for x in range(10, 4, -3): translate(box(1), x, "
                      "0, 0)])"),
            "2");
  EXPECT_EQ(volume_of("union([for x in range(0, 1, 0.25): translate(box(0.1), "
                      "x, 0, 0)])"),
            "0.004");
}

TEST(CsgLanguage, DefinesFunctions) {
  EXPECT_EQ(volume_of("def plate(w, h) = box(w, h, 1)\n"
                      "def pair(w) = union(plate(w, w), translate(plate(w, 1), "
                      "0, 0, 2))\n"
                      "pair(3)"),
            "12");
  EXPECT_EQ(volume_of("h = 5\ndef tower() = box(1, 1, h)\ntower()"), "5");
  EXPECT_EQ(volume_of("def f(x) = [for i in range(x): i + x]\n"
                      "box(f(3)[2], f(1)[0], 2)"),
            "10");
  // A name of the script hides a function of the language, and `for` may be
  // one outside of lists.
  EXPECT_EQ(volume_of("sphere = box(2)\nfor = sphere\nfor"), "8");
  EXPECT_EQ(volume_of("def box2(x) = box(x)\ndef box2(x) = box2(2 * x)\n"
                      "box2(1)"),
            "8");
}

TEST(CsgLanguage, AddsNumbersAndSolids) {
  EXPECT_EQ(volume_of("box(1 + 1) + translate(box(1 + 1), 1, 0, 0)"), "12");
  EXPECT_EQ(volume_of("box(2) + box(3) - box(1) + box(1)"), "27");
}

TEST(CsgLanguage, MirrorsAndMoves) {
  EXPECT_EQ(volume_of("mirror(box(1, 2, 3), 1, 0, 0) | box(1, 2, 3)"), "12");
  EXPECT_EQ(volume_of("mirror(box(1), 1, 1, 0) & translate(box(1), -1, -1, 0)"),
            "1");
  EXPECT_EQ(volume_of("box(4) & half(x < 1 + 1)"), "32");
  EXPECT_EQ(volume_of("x = 3\nbox(4) & half(x < x)"), "48");
}

TEST(CsgLanguage, NamesTroubleWithItsPlace) {
  EXPECT_EQ(volume_of("box(1) + 2"),
            "line 1, column 8: + adds numbers, not a solid");
  EXPECT_EQ(volume_of("box(1) - 1"),
            "line 1, column 8: this combines solids, not a number");
  EXPECT_EQ(volume_of("~1"), "line 1, column 1: ~ takes a solid, not a number");
  EXPECT_EQ(volume_of("box(1 / (2 - 2))"),
            "line 1, column 7: this divides by 0");
  EXPECT_EQ(volume_of("a = 1\na"),
            "line 2, column 1: the last statement is the result, but it is no "
            "solid; union(...) makes one of a list");
  EXPECT_EQ(volume_of("f(1)"), "line 1, column 1: there is no function 'f'");
  EXPECT_EQ(volume_of("cube(3)"),
            "line 1, column 1: there is no function 'cube'; it is called box "
            "here");
  for (const char* slip : {"cylindr", "cylinderr", "cylimder", "cyilnder"})
    EXPECT_EQ(volume_of(std::string(slip) + "(1, 2)"),
              "line 1, column 1: there is no function '" + std::string(slip) +
                  "'; is cylinder meant?");
  EXPECT_EQ(volume_of("cylnidr(1, 2)"),
            "line 1, column 1: there is no function 'cylnidr'");
  EXPECT_EQ(volume_of("union(for i in range(3): box(i))"),
            "line 1, column 7: for stands in square brackets: [for i in "
            "range(3): ...]");
  EXPECT_EQ(volume_of("translate([1, 2, 3]) box(1)"),
            "line 1, column 22: expected an operator, not 'box'; the solid is "
            "the first argument, as in translate(S, 1, 2, 3)");
  EXPECT_EQ(volume_of("box(1) sphere(2)"),
            "line 1, column 8: expected an operator, not 'sphere'");
  EXPECT_EQ(volume_of("box(1) union sphere(2)"),
            "line 1, column 8: expected an operator, not 'union'; the "
            "operators on solids are | & - ^");
  EXPECT_EQ(volume_of("cylinder(h = 3, r = 1)"),
            "line 1, column 12: expected an operator, not '='; arguments have "
            "an order, and no names");
  EXPECT_EQ(volume_of("difference() { box(1); }"),
            "line 1, column 14: nothing begins with '{'; solids stand in round "
            "brackets, as in union(A, B)");
  EXPECT_EQ(volume_of("def f(a) = f(a)\nf(1)"),
            "line 1, column 12: there is no function 'f'");
  EXPECT_EQ(volume_of("def f(a) = box(a)\nf(1, 2)"),
            "line 2, column 1: f takes 1 value, not 2");
  EXPECT_EQ(volume_of("def half(a) = a"),
            "line 1, column 5: 'half' is a function already");
  EXPECT_EQ(volume_of("[1, 2][2]"),
            "line 1, column 7: the list has the indices 0 to 1");
  EXPECT_EQ(volume_of("union([])"),
            "line 1, column 1: union takes solids and lists of them, at least "
            "one");
  EXPECT_EQ(volume_of("union([for i in 3: box(1)])"),
            "line 1, column 8: for takes a list, not a number");
  EXPECT_EQ(volume_of("union([for i range(3): box(1)])"),
            "line 1, column 14: expected 'in', not 'range'");
  EXPECT_EQ(volume_of("union([for i in range(3)])"),
            "line 1, column 25: expected ':', not ']'");
  EXPECT_EQ(volume_of("(box(1)]"),
            "line 1, column 8: expected an operator or ')', not ']'");
  EXPECT_EQ(volume_of("[box(1))"),
            "line 1, column 8: expected an operator or ']', not ')'");
  EXPECT_EQ(volume_of("cone(0, 0, 1)").substr(0, 38),
            "line 1, column 1: cone takes two radii");
  EXPECT_EQ(volume_of("sphere(1, 2)").substr(0, 37),
            "line 1, column 1: sphere takes a radi");
  EXPECT_EQ(volume_of("flip(box(1))"),
            "line 1, column 1: flip takes a file, or a name that stands for "
            "one");
  EXPECT_EQ(volume_of("box(sqrt(-1))"),
            "line 1, column 5: sqrt has no value there");
}

TEST(CsgLanguage, StopsWhatHasNoEnd) {
  EXPECT_NE(volume_of("[for i in range(1e9): 1]").find("the range is too long"),
            std::string::npos);
  EXPECT_NE(volume_of("a = range(2000)\n"
                      "[for i in a: [for j in a: [for k in a: 1]]]")
                .find("too many parts"),
            std::string::npos);
  std::string doubling = "def f0(x) = [x, x]\n";
  for (int i = 1; i < 40; ++i) {
    const std::string before = "f" + std::to_string(i - 1) + "(x)";
    doubling += "def f" + std::to_string(i) + "(x) = [" + before + ", " +
                before + "]\n";
  }
  EXPECT_NE(volume_of(doubling + "union(f39(box(1)))").find("too many"),
            std::string::npos);
  std::string deep = "a = [1]\n";
  for (int i = 0; i < 2000; ++i) deep += "a = [a]\n";
  EXPECT_NE(volume_of(deep + "box(1)").find("nested too deeply"),
            std::string::npos);
}

}  // namespace
}  // namespace halfspace::csg
