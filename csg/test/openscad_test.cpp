#include "halfspace/csg/openscad.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <string>

#include "halfspace/csg/operands.hpp"
#include "halfspace/csg/outcome.hpp"
#include "halfspace/csg/plan.hpp"

namespace halfspace::csg {
namespace {

/// The volume of OpenSCAD's tree, or what is wrong with it.
std::string scad(const std::string& text) {
  EXPECT_TRUE(is_openscad(text)) << text;
  const Result<Script> script = read_openscad(text);
  if (!script) return script.error().message;
  const Result<Plan> plan = make_plan(*script);
  if (!plan) return plan.error().message;
  Result<Operands> operands = Operands::load(*script, *plan, {});
  if (!operands) return operands.error().message;
  const auto outcome = evaluate_fast(*plan, *operands, {});
  if (!outcome) return outcome.error().message;
  char shown[32];
  std::snprintf(shown, sizeof shown, "%.6g", (*outcome)->volume.value());
  return shown;
}

TEST(OpenScad, IsToldFromAScript) {
  EXPECT_TRUE(is_openscad("group() {\n}\n"));
  EXPECT_TRUE(is_openscad("// c\ncube(size = [1, 1, 1], center = false);"));
  EXPECT_TRUE(is_openscad("multmatrix([[1, 0, 0, 0]"));
  EXPECT_FALSE(is_openscad("union(a, b)"));
  EXPECT_FALSE(is_openscad("a - b"));
  EXPECT_FALSE(is_openscad("tower()"));
  EXPECT_FALSE(is_openscad("x = translate(a, 1, 2, 3)"));
  EXPECT_FALSE(is_openscad(""));
}

TEST(OpenScad, ReadsItsSolids) {
  EXPECT_EQ(scad("cube(size = [1, 2, 3], center = false);"), "6");
  EXPECT_EQ(scad("cube(size = 2, center = true);"), "8");
  EXPECT_EQ(scad("cylinder($fn = 4, $fa = 12, $fs = 2, h = 5, r1 = 2, r2 = 2, "
                 "center = true);"),
            "40");
  EXPECT_EQ(scad("cylinder($fn = 4, $fa = 12, $fs = 2, h = 3, r1 = 2, r2 = 0, "
                 "center = false);"),
            "8");
  // Two parallels of squares at 45 degrees.
  EXPECT_EQ(scad("sphere($fn = 4, $fa = 12, $fs = 2, r = 2);"), "11.3137");
  EXPECT_EQ(scad("polyhedron(points = [[0, 0, 0], [1, 0, 0], [0, 1, 0], "
                 "[0, 0, 3]], faces = [[0, 1, 2], [0, 3, 1], [1, 3, 2], "
                 "[0, 2, 3]], convexity = 1);"),
            "0.5");
}

TEST(OpenScad, ReadsHullsOfShapes) {
  // Two cubes, one of them moved: a sheared box between them.
  EXPECT_EQ(scad("hull() { cube(size = 1, center = false);\n"
                 "multmatrix([[1, 0, 0, 3], [0, 1, 0, 0], [0, 0, 1, 0], "
                 "[0, 0, 0, 1]]) { group() { cube(size = 1, center = false); "
                 "} } }"),
            "4");
  EXPECT_EQ(scad("linear_extrude(height = 2, center = false, convexity = 1) { "
                 "hull() { square(size = [1, 1], center = false); "
                 "polygon(points = [[0, 0], [3, 0], [0, 1]], paths = undef, "
                 "convexity = 1); } }"),
            "4");
  EXPECT_NE(scad("hull() { difference() { cube(size = 2, center = false); "
                 "cube(size = 1, center = false); } }")
                .find("not of differences"),
            std::string::npos);
}

TEST(OpenScad, ReadsSetsAndMatrices) {
  EXPECT_EQ(scad("group() {\n"
                 "  difference() {\n"
                 "    cube(size = [4, 4, 4], center = false);\n"
                 "    multmatrix([[1, 0, 0, 1], [0, 1, 0, 1], [0, 0, 1, -1], "
                 "[0, 0, 0, 1]]) {\n"
                 "      cube(size = [2, 2, 9], center = false);\n"
                 "    }\n  }\n}\n"),
            "48");
  EXPECT_EQ(scad("union() { cube(size = [1, 1, 1], center = false);"
                 "color([1, 0, 0, 1]) { cube(size = [2, 1, 1], center = false);"
                 "} %cube(size = [9, 9, 9], center = false); }"),
            "2");
  EXPECT_EQ(scad("intersection() { cube(size = [3, 1, 1], center = false);"
                 "cube(size = [2, 2, 2], center = true); }"),
            "1");
  EXPECT_EQ(scad("union() { cube(size = [1, 1, 1], center = false);"
                 "difference() { group(); cube(size = [5, 5, 5], center = "
                 "false); } }"),
            "1");
}

TEST(OpenScad, ReadsExtrusions) {
  const std::string extrude =
      "linear_extrude(height = 2, center = false, convexity = 1, scale = [1, "
      "1], $fn = 0, $fa = 12, $fs = 2) { ";
  EXPECT_EQ(scad(extrude + "square(size = [3, 4], center = true); }"), "24");
  EXPECT_EQ(scad(extrude + "circle($fn = 4, r = 1); }"), "4");
  EXPECT_EQ(scad(extrude +
                 "polygon(points = [[0, 0], [0, 4], [4, 0]], paths = undef, "
                 "convexity = 1); }"),
            "16");
  // A square with a hole, and the difference of two.
  EXPECT_EQ(scad(extrude +
                 "polygon(points = [[0, 0], [4, 0], [4, 4], [0, 4], [1, 1], "
                 "[2, 1], [2, 2], [1, 2]], paths = [[0, 1, 2, 3], [4, 5, 6, "
                 "7]], convexity = 1); }"),
            "30");
  EXPECT_EQ(scad(extrude +
                 "difference() { square(size = [3, 3], center = false); "
                 "multmatrix([[1, 0, 0, 1], [0, 1, 0, 1], [0, 0, 1, 0], [0, 0, "
                 "0, 1]]) { square(size = [1, 1], center = false); } } }"),
            "16");
}

TEST(OpenScad, NamesWhatIsNotRead) {
  EXPECT_EQ(scad("group() {\n  minkowski() { }\n}"),
            "line 2, column 3: minkowski is not read");
  EXPECT_EQ(scad("square(size = [1, 1], center = false);"),
            "line 1, column 1: square outside of linear_extrude is flat, and "
            "not read");
  EXPECT_EQ(scad("group() { rotate_extrude(angle = 360) { circle(r = 2); } }"),
            "line 1, column 11: rotate_extrude is not read");
  EXPECT_EQ(scad("linear_extrude(height = 1, twist = 90) { }"),
            "line 1, column 1: linear_extrude with twist or scale is not read");
  EXPECT_EQ(scad("group() { cube(size = [1, 1]); }"),
            "line 1, column 11: cube needs a size of 3 numbers");
  EXPECT_EQ(scad("group() { cube(size = [1, 1, 1]) }"),
            "line 1, column 34: expected '{' or ';', not '}'");
  EXPECT_EQ(scad("group() { "),
            "line 1, column 11: expected a shape, not the "
            "end");
  EXPECT_EQ(scad("group() { }"), "there is nothing solid");
  EXPECT_EQ(scad("group() { cube(size = [1, 1e9999, 1]); }"),
            "line 1, column 27: expected a number, not '1e9999'");
  EXPECT_EQ(scad("multmatrix([[1, 0, 0, 0], [0, 0, 0, 0], [0, 0, 1, 0], [0, 0, "
                 "0, 1]]) { cube(size = 1); }"),
            "line 1, column 1: this matrix makes everything flat");
}

TEST(OpenScad, DepthCostsNoStack) {
  std::string text;
  for (int i = 0; i < 100'000; ++i) text += "group() { ";
  text += "cube(size = 1); ";
  for (int i = 0; i < 100'000; ++i) text += "} ";
  EXPECT_TRUE(read_openscad(text));
}

}  // namespace
}  // namespace halfspace::csg
