#include "halfspace/csg/repair.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "halfspace/boolean.hpp"
#include "halfspace/csg/volume.hpp"
#include "halfspace/io/read_mesh.hpp"

namespace halfspace::csg {
namespace {

using Point = std::array<std::string, 3>;
using Polygon = std::vector<int>;

struct Pieces {
  std::vector<Point> points;
  std::vector<Polygon> polygons;
};

/// A box in model units, its polygons outwards.
void add_box(Pieces& pieces, const Point& low, const Point& high) {
  const int first = static_cast<int>(pieces.points.size());
  for (int i = 0; i < 8; ++i) {
    pieces.points.push_back({(i & 1) != 0 ? high[0] : low[0],
                             (i & 2) != 0 ? high[1] : low[1],
                             (i & 4) != 0 ? high[2] : low[2]});
  }
  for (const Polygon& face :
       {Polygon{0, 2, 3, 1}, Polygon{4, 5, 7, 6}, Polygon{0, 1, 5, 4},
        Polygon{2, 6, 7, 3}, Polygon{0, 4, 6, 2}, Polygon{1, 3, 7, 5}}) {
    Polygon polygon;
    for (const int i : face) polygon.push_back(first + i);
    pieces.polygons.push_back(polygon);
  }
}

Pieces box() {
  Pieces pieces;
  add_box(pieces, {"0", "0", "0"}, {"2", "2", "3"});
  return pieces;
}

Result<Repaired> mended(const Pieces& pieces,
                        const RepairOptions& options = {}) {
  std::string text = "OFF\n" + std::to_string(pieces.points.size()) + " " +
                     std::to_string(pieces.polygons.size()) + " 0\n";
  for (const Point& p : pieces.points)
    text += p[0] + " " + p[1] + " " + p[2] + "\n";
  for (const Polygon& polygon : pieces.polygons) {
    text += std::to_string(polygon.size());
    for (const int corner : polygon) text += " " + std::to_string(corner);
    text += "\n";
  }
  const auto mesh = io::read_mesh(text, io::Format::kOff);
  EXPECT_TRUE(mesh.has_value());
  return repaired("soup.off", *mesh, options);
}

/// What was done, and the volume of what came of it.
std::string told(const Pieces& pieces, const RepairOptions& options = {}) {
  const Result<Repaired> result = mended(pieces, options);
  if (!result) return "error: " + result.error().message;
  std::string all;
  for (const std::string& sentence : result->report.sentences())
    all += sentence + "; ";
  if (result->source.to_repair) return all;
  EXPECT_TRUE(make_solid(result->source.scene).has_value());
  return all + exact_volume(result->source.scene);
}

TEST(Repair, DoesNothingToASolid) { EXPECT_EQ(told(box()), "12"); }

TEST(Repair, TurnsPolygonsAndComponents) {
  Pieces pieces = box();
  std::reverse(pieces.polygons[2].begin(), pieces.polygons[2].end());
  EXPECT_EQ(told(pieces), "1 polygon turned to agree with others; 12");
  for (Polygon& polygon : pieces.polygons)
    std::reverse(polygon.begin(), polygon.end());
  EXPECT_EQ(told(pieces),
            "1 polygon turned to agree with others; 1 component turned "
            "outwards; 12");
}

TEST(Repair, KeepsCavities) {
  Pieces pieces = box();
  add_box(pieces, {"0.5", "0.5", "0.5"}, {"1", "1", "1"});
  for (std::size_t p = 6; p < 12; ++p)
    std::reverse(pieces.polygons[p].begin(), pieces.polygons[p].end());
  EXPECT_EQ(told(pieces), "11.875");
  add_box(pieces, {"5", "0", "0"}, {"6", "1", "1"});
  for (std::size_t p = 12; p < 18; ++p)
    std::reverse(pieces.polygons[p].begin(), pieces.polygons[p].end());
  EXPECT_EQ(told(pieces), "1 component turned outwards; 12.875");
}

TEST(Repair, DropsPolygonsThatAreThereTwice) {
  Pieces pieces = box();
  pieces.polygons.push_back(pieces.polygons[3]);
  EXPECT_EQ(told(pieces), "1 polygon dropped that others cover; 12");
}

TEST(Repair, WeldsBorders) {
  Pieces pieces = box();
  // The top has corners of its own, a little off.
  const int first = static_cast<int>(pieces.points.size());
  for (const std::size_t i : {4u, 5u, 7u, 6u}) {
    const Point point = pieces.points[i];
    pieces.points.push_back(point);
  }
  pieces.points.back()[2] = "3.0000001";
  pieces.polygons[1] = {first, first + 1, first + 2, first + 3};
  const std::string all = told(pieces);
  EXPECT_NE(all.find("1 point welded to others, moved by up to 1e-07; "),
            std::string::npos)
      << all;
  // Not so far apart.
  EXPECT_NE(told(pieces, {.weld = 1e-9})
                .find("error: soup.off: the surface is "
                      "open"),
            std::string::npos);
}

TEST(Repair, FillsHolesThatAreSmall) {
  // A box whose top has a square hole, at once or with its corners bent up.
  Pieces pieces = box();
  const int first = static_cast<int>(pieces.points.size());
  for (const auto& [x, y] :
       {std::pair("0.5", "0.5"), std::pair("1.25", "0.5"),
        std::pair("1.25", "1.25"), std::pair("0.5", "1.25")})
    pieces.points.push_back({x, y, "3"});
  pieces.polygons.erase(pieces.polygons.begin() + 1);
  const int outer[] = {4, 5, 7, 6};
  for (int i = 0; i < 4; ++i) {
    const int j = (i + 1) % 4;
    pieces.polygons.push_back({outer[i], outer[j], first + j, first + i});
  }
  EXPECT_EQ(told(pieces), "1 hole filled, 1 in a plane, with 1 polygon; 12");
  pieces.points.back()[2] = "3.25";
  const std::string bent = told(pieces);
  EXPECT_EQ(bent.find("1 hole filled, 0 in a plane, with 2 polygons; "), 0u)
      << bent;
}

TEST(Repair, AsksWhatAWideBorderIs) {
  Pieces pieces = box();
  pieces.polygons.erase(pieces.polygons.begin() + 1);
  EXPECT_EQ(told(pieces),
            "error: soup.off: the surface is open: its border of 4 edges at 2, "
            "0, 3 is half as wide as its component or wider, so it may be no "
            "hole; --close-all fills it all the same, --thicken THICKNESS "
            "makes the surface a shell");
  EXPECT_EQ(told(pieces, {.close_all = true}),
            "1 hole filled, 1 in a plane, with 1 polygon; 12");
}

TEST(Repair, MakesASheetAPlate) {
  Pieces sheet;
  sheet.points = {
      {"0", "0", "0"}, {"4", "0", "0"}, {"4", "2", "0"}, {"0", "2", "0"}};
  sheet.polygons = {{0, 1, 2}, {2, 0, 3}};
  EXPECT_EQ(told(sheet, {.thicken = 0.5}),
            "1 polygon turned to agree with others; made a shell 0.5 thick; 4");
}

TEST(Repair, AShellIsAsThickAsWasSaid) {
  Pieces pieces = box();
  pieces.polygons.erase(pieces.polygons.begin() + 1);
  // The outer box is 2.25 by 2.25 by 3.125, the inner 1.75 by 1.75 by 2.875.
  EXPECT_EQ(told(pieces, {.thicken = 0.25}),
            "made a shell 0.25 thick; 7.015625");
  // Two edges at right angles: a miter.
  Pieces fold;
  fold.points = {{"0", "0", "0"}, {"4", "0", "0"}, {"4", "2", "0"},
                 {"0", "2", "0"}, {"4", "0", "4"}, {"4", "2", "4"}};
  fold.polygons = {{0, 1, 2, 3}, {1, 4, 5, 2}};
  const Result<Repaired> made = mended(fold, {.thicken = 1});
  ASSERT_TRUE(made);
  EXPECT_NEAR(made->report.least_thickness, 1, 1e-12);
  EXPECT_NEAR(made->report.most_thickness, 1, 1e-12);
  EXPECT_EQ(exact_volume(made->source.scene), "16");
  // Where four planes do not meet in a point it is told how thick it is.
  Pieces tent;
  tent.points = {{"0", "0", "0"},
                 {"4", "0", "0"},
                 {"4", "2", "0"},
                 {"0", "2", "0"},
                 {"2", "1", "1"}};
  tent.polygons = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
  const std::string sentence = told(tent, {.thicken = 0.5});
  EXPECT_NE(sentence.find("made a shell 0.5 thick, at sharp or curved places "),
            std::string::npos)
      << sentence;
}

TEST(Repair, LeavesWhatCrossesItselfToBeResolved) {
  Pieces pieces = box();
  add_box(pieces, {"1", "1", "1"}, {"4", "4", "4"});
  const Result<Repaired> result = mended(pieces);
  ASSERT_TRUE(result);
  EXPECT_TRUE(result->source.to_repair);
  EXPECT_EQ(result->report.crossing.find("the surface crosses itself: "), 0u);
}

TEST(Repair, ASheetHasNothingWithin) {
  Pieces sheet;
  sheet.points = {{"0", "0", "0"}, {"4", "0", "0"}, {"4", "2", "0"}};
  sheet.polygons = {{0, 1, 2}};
  const Result<Repaired> result = mended(sheet, {.close_all = true});
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kEmpty);
  EXPECT_NE(result.error().message.find("--thicken"), std::string::npos);
}

TEST(Repair, RefusesWhatHasNoSurface) {
  Pieces pieces;
  pieces.points = {{"0", "0", "0"}, {"1", "0", "0"}, {"2", "0", "0"}};
  pieces.polygons = {{0, 1, 2}};
  EXPECT_EQ(mended(pieces).error().code, ErrorCode::kEmpty);
}

/// The error of a repair without a step, which names it.
ErrorCode code_without(RepairStep step, const std::string& word,
                       const Pieces& pieces) {
  const Result<Repaired> result = mended(pieces, {.without = {step}});
  if (result) return ErrorCode::kEmpty;
  EXPECT_NE(result.error().message.find("; left out was: " + word),
            std::string::npos)
      << result.error().message;
  return result.error().code;
}

TEST(Repair, StepsThatAreLeftOutAreNotTakenAndNamed) {
  Pieces open = box();
  open.polygons.pop_back();
  EXPECT_EQ(code_without(RepairStep::kClose, "close", open), ErrorCode::kOpen);
  Pieces turned = box();
  for (Polygon& polygon : turned.polygons)
    std::reverse(polygon.begin(), polygon.end());
  // What faces inwards holds nothing that could be kept.
  EXPECT_NE(code_without(RepairStep::kOutwards, "outwards", turned),
            ErrorCode::kSelfCrossing);
  Pieces crossing = box();
  add_box(crossing, {"1", "1", "1"}, {"4", "4", "4"});
  EXPECT_EQ(code_without(RepairStep::kResolve, "resolve", crossing),
            ErrorCode::kSelfCrossing);
  Pieces against = box();
  std::reverse(against.polygons[2].begin(), against.polygons[2].end());
  const Result<Repaired> other =
      mended(against, {.without = {RepairStep::kAgree, RepairStep::kClose}});
  ASSERT_FALSE(other);
  EXPECT_NE(other.error().message.find("left out was: agree, close"),
            std::string::npos);
  Pieces twice = box();
  twice.polygons.push_back(twice.polygons[3]);
  const Result<Repaired> kept =
      mended(twice, {.without = {RepairStep::kDuplicates, RepairStep::kClose}});
  EXPECT_FALSE(kept);
}

TEST(Repair, StepsThatAreNotNeededMayBeLeftOut) {
  const std::vector<RepairStep> all = {
      RepairStep::kDuplicates, RepairStep::kWeld,     RepairStep::kAgree,
      RepairStep::kClose,      RepairStep::kOutwards, RepairStep::kResolve};
  EXPECT_EQ(told(box(), {.without = all}), "12");
  Pieces pieces = box();
  std::reverse(pieces.polygons[2].begin(), pieces.polygons[2].end());
  EXPECT_EQ(told(pieces, {.without = {RepairStep::kWeld, RepairStep::kClose,
                                      RepairStep::kResolve}}),
            "1 polygon turned to agree with others; 12");
}

}  // namespace
}  // namespace halfspace::csg
