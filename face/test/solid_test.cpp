#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "halfspace/glm.hpp"
#include "halfspace/halfspace.hpp"

namespace halfspace {
namespace {

Solid cube(double size) { return Solid::box({0, 0, 0}, {size, size, size}); }

TEST(FaceSolid, UnitsMeetOnOneGrid) {
  // Steps of a tenth, of 2^-4 and of a thousandth.
  const Solid a = cube(2.5);
  const Solid b = cube(1).scaled(0.0625).translated({1, 1, 1});
  const Solid c = cube(0.001);
  EXPECT_EQ(*(a - b - c).exact_volume(), "15.624755858375");
}

TEST(FaceSolid, ScriptsMakeTheSameRoundSolids) {
  const std::pair<const char*, Solid> pairs[] = {
      {"sphere(1)", Solid::sphere(1)},
      {"sphere(0.35, 7)", Solid::sphere(0.35, 7)},
      {"sphere(1200, 100)", Solid::sphere(1200, 100)},
      {"cylinder(1, 2)", Solid::cylinder(1, 2)},
      {"cylinder(0.1, 12.5, 100)", Solid::cylinder(0.1, 12.5, 100)},
      {"cone(2, 0, 1)", Solid::cone(2, 0, 1)},
      {"cone(0.7, 3, 1.25, 9)", Solid::cone(0.7, 3, 1.25, 9)},
      {"box(1, 2, 0.3)", Solid::box({0, 0, 0}, {1, 2, 0.3})},
      {"box(2) - translate(sphere(1), 1, 1, 2)",
       Solid::box({0, 0, 0}, {2, 2, 2}) -
           Solid::sphere(1).translated({1, 1, 2})},
      {"rotate(cylinder(1, 2), 1, 1, 0, 30)",
       Solid::cylinder(1, 2).rotated({1, 1, 0}, 30)},
  };
  for (const auto& [script, made] : pairs) {
    const auto mesh = Solid::from_text(script).mesh();
    ASSERT_TRUE(mesh) << script << ": " << mesh.error().message;
    EXPECT_EQ(*mesh, *made.mesh()) << script;
  }
}

TEST(FaceSolid, RoundSolidsGoToAnyGridWhereNoneHoldsThem) {
  // A third needs a grid in powers of two, which has no tenths.
  const Solid third = Solid::from_mesh(*cube(1.0 / 3).mesh());
  const Solid ball = Solid::sphere(0.1);
  EXPECT_EQ(ball.rounding()->moved, 0u);
  EXPECT_GT((third + ball).rounding()->moved, 0u);
  EXPECT_NEAR(*(third + ball).volume(), 1.0 / 27 + *ball.volume() * 7 / 8,
              1e-7);
}

TEST(FaceSolid, ManySegmentsStaySolids) {
  const Solid ring = Solid::cylinder(1, 1, 5000);
  EXPECT_NEAR(*ring.volume(), 3.14159183, 1e-7);
  const Solid cap = Solid::revolution({{0, 0}, {1e-3, 0}, {0, 1e-3}}, 2000);
  EXPECT_NEAR(*cap.volume(), 3.14159e-9 / 3, 1e-12);
}

TEST(FaceSolid, WhatNoGridHoldsIsAnError) {
  const Solid far = cube(1).translated({1e12, 0, 0});
  const Solid fine = cube(1e-9);
  const auto volume = (far.named("far") + fine.named("fine")).volume();
  ASSERT_FALSE(volume);
  EXPECT_EQ(volume.error().code, ErrorCode::kOutOfRange);
  EXPECT_NE(volume.error().message.find("fine"), std::string::npos);
  EXPECT_NE(volume.error().message.find("far"), std::string::npos);
  EXPECT_NE(volume.error().message.find("may_round"), std::string::npos);
}

TEST(FaceSolid, ExactMapsMoveNothing) {
  const Solid box = Solid::box({0, 0, 0}, {1, 2, 3});
  const Solid moved = box.rotated({0, 0, 1}, 90)
                          .mirrored({{1, 0, 0}, 5})
                          .scaled(0.1)
                          .translated({1e-3, 0, 0});
  EXPECT_EQ(moved.rounding()->moved, 0u);
  EXPECT_EQ(*moved.exact_volume(), "0.006");
  // (x, y, z) went to (-y, x, z), then to (10 + y, x, z).
  EXPECT_EQ(*moved.bounds(), (Bounds{{1.001, 0, 0}, {1.201, 0.1, 0.3}}));
}

TEST(FaceSolid, OtherMapsRoundOnceAndSayHowFar) {
  const Solid turned = cube(1).rotated({1, 2, 3}, 30);
  const RoundingReport report = *turned.rounding();
  EXPECT_GT(report.moved, 0u);
  EXPECT_LE(report.max_move, report.step / 2);
  EXPECT_LE(report.step, 1e-9);
  EXPECT_NEAR(*turned.volume(), 1, 1e-9);
  // What is exact beside it stays so.
  const Solid apart = turned + cube(0.1).translated({5, 0, 0});
  EXPECT_EQ(*(apart - turned).exact_volume(), "0.001");
}

TEST(FaceSolid, OperatorsAreTheRegularisedBooleans) {
  const Solid a = cube(2), b = cube(2).translated({1, 1, 1});
  EXPECT_EQ(*(a + b).volume(), 15);
  EXPECT_EQ(*(a & b).volume(), 1);
  EXPECT_EQ(*(a - b).volume(), 7);
  EXPECT_EQ(*(a ^ b).volume(), 14);
  EXPECT_EQ(*(~(~a & ~b)).volume(), 15);
  const auto unbounded = (~a).volume();
  ASSERT_FALSE(unbounded);
  EXPECT_EQ(unbounded.error().code, ErrorCode::kUnbounded);
  EXPECT_EQ(*(a - Solid()).volume(), 8);
  EXPECT_EQ(*(Solid() + a).volume(), 8);
  EXPECT_TRUE(*(a & Solid()).is_empty());
  const auto [below, above] = a.split({{0, 0, 1}, 0.5});
  EXPECT_EQ(*below.volume(), 2);
  EXPECT_EQ(*above.volume(), 6);
}

TEST(FaceSolid, ManyAtOnceAreTheSamePoints) {
  std::vector<Solid> cubes;
  for (int i = 0; i < 200; ++i)
    cubes.push_back(cube(1).translated({0.5 * i, 0, 0}));
  const Solid all = Solid::union_of(cubes);
  EXPECT_EQ(*all.volume(), 100.5);
  EXPECT_EQ(*Solid::intersection_of(std::span(cubes).first(2)).volume(), 0.5);
  EXPECT_TRUE(*Solid::union_of({}).is_empty());
}

TEST(FaceSolid, DeepExpressionsAreTakenApartWithoutRecursion) {
  Solid solid = cube(1);
  for (int i = 0; i < 200000; ++i) solid = solid.translated({1, 0, 0});
  solid = Solid();
}

TEST(FaceSolid, EqualExpressionsGiveEqualMeshesInAnyThread) {
  const auto part = [] {
    return cube(4) - Solid::sphere(2, 16) -
           Solid::cylinder(1, 9, 12).rotated({1, 1, 0}, 20);
  };
  const Mesh expected = *part().mesh();
  EXPECT_GT(expected.polygon_count(), 20u);
  const Solid shared = part();
  std::vector<std::thread> threads;
  std::vector<Mesh> meshes(8);
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    threads.emplace_back([&, i] {
      // Half of them the same value, half of them one that shares operands.
      const Solid mine = i % 2 == 0 ? shared : shared + Solid();
      meshes[i] = *(i % 2 == 0 ? mine : part()).mesh();
      EXPECT_TRUE(mine.volume());
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const Mesh& mesh : meshes) EXPECT_EQ(mesh, expected);
}

TEST(FaceSolid, OriginsNameOperandsAndPolygons) {
  const Solid plate = cube(2), drill = cube(1).named("drill");
  const Solid part = plate - drill.translated({0.5, 0.5, 1.5});
  const Mesh mesh = *part.mesh();
  const std::vector<Solid> operands = *part.operands();
  ASSERT_EQ(operands.size(), 2u);
  ASSERT_EQ(mesh.origins.size(), mesh.polygon_count());
  std::size_t of_plate = 0, of_drill = 0;
  for (const Origin& origin : mesh.origins) {
    const Solid& from = operands[origin.operand];
    of_plate += from == plate ? 1u : 0u;
    of_drill += from.name() == "drill" ? 1u : 0u;
  }
  EXPECT_EQ(of_plate + of_drill, mesh.polygon_count());
  EXPECT_EQ(of_drill, 5u);  // four sides and the bottom of the hole
}

TEST(FaceSolid, PartsAreSolidsWithTheirOrigins) {
  const Solid bar = Solid::box({0, 0, 0}, {9, 1, 1}).named("bar");
  const Solid slot = Solid::box({3, -1, -1}, {4, 2, 2}).named("slot");
  const Solid sawn = bar - slot - slot.translated({3, 0, 0});
  const std::vector<Solid> parts = *sawn.decompose();
  ASSERT_EQ(parts.size(), 3u);
  double volume = 0;
  for (const Solid& part : parts) {
    volume += *part.volume();
    EXPECT_EQ(*part.shell_count(), 1u);
    EXPECT_EQ(part.mesh()->polygon_count(), 6u);
    EXPECT_EQ(part.polygons_by_operand()->at("bar") +
                  part.polygons_by_operand()->at("slot"),
              6u);
    // In another expression, and moved, exactly or not, it is the same part.
    EXPECT_EQ(*(part - Solid()).exact_volume(), *part.exact_volume());
    const Solid moved = part.rotated({0, 0, 1}, 90).translated({0, 0, 5});
    EXPECT_EQ(*moved.exact_volume(), *part.exact_volume());
    EXPECT_NEAR(*part.rotated({1, 2, 3}, 20).volume(), *part.volume(), 1e-9);
  }
  EXPECT_EQ(volume, *sawn.volume());
  EXPECT_TRUE(*(Solid::union_of(parts) ^ sawn).is_empty());
  EXPECT_TRUE(Solid().decompose()->empty());
}

TEST(FaceSolid, PartsHaveTheirCavities) {
  // Three boxes within one another, each hollow, and one apart.
  const auto cube_at = [](double low, double high) {
    return Solid::box({low, low, low}, {high, high, high});
  };
  const Solid shells = cube_at(0, 20) - cube_at(2, 18) + cube_at(4, 16) -
                       cube_at(6, 14) + cube_at(8, 12) + cube_at(30, 31);
  const std::vector<Solid> parts = *shells.decompose();
  ASSERT_EQ(parts.size(), 4u);
  std::vector<double> volumes;
  for (const Solid& part : parts) volumes.push_back(*part.volume());
  std::sort(volumes.begin(), volumes.end());
  EXPECT_EQ(volumes, (std::vector<double>{1, 64, 12 * 12 * 12 - 8 * 8 * 8,
                                          20 * 20 * 20 - 16 * 16 * 16}));
  // Cubes that only touch along an edge are apart.
  const Solid edge = cube_at(0, 1) + cube_at(0, 1).translated({1, 1, 0});
  EXPECT_EQ(edge.decompose()->size(), 2u);
}

TEST(FaceSolid, TrianglesInOnePlaneAreOneFace) {
  Mesh mesh = *cube(1).mesh({.triangles = true});
  ASSERT_EQ(mesh.polygon_count(), 12u);
  mesh.origins.clear();
  EXPECT_EQ(Solid::from_mesh(mesh).mesh()->polygon_count(), 6u);
  // Materials keep them apart.
  mesh.materials.resize(12);
  mesh.materials[0] = 7;
  EXPECT_EQ(Solid::from_mesh(mesh).mesh()->polygon_count(), 7u);
}

TEST(FaceSolid, ErrorsSayWhatIsWrongWithWhat) {
  Mesh open = *cube(1).mesh();
  open.corners.resize(20);
  open.first_corner.resize(6);
  open.origins.clear();
  const auto code = [](const Solid& solid) {
    return solid.volume().error().code;
  };
  EXPECT_EQ(code(Solid::from_mesh(open)), ErrorCode::kOpen);
  Mesh inverted = *cube(1).mesh();
  std::reverse(inverted.corners.begin(), inverted.corners.end());
  EXPECT_EQ(code(Solid::from_mesh(inverted)), ErrorCode::kInsideOut);
  Mesh crossing = *cube(2).mesh();
  const Mesh other = *cube(2).translated({1, 1, 1}).mesh();
  for (std::size_t p = 0; p < other.polygon_count(); ++p) {
    std::vector<std::int32_t> corners;
    for (const std::int32_t c : other.corners_of(p)) corners.push_back(c + 8);
    crossing.add(corners);
  }
  crossing.vertices.insert(crossing.vertices.end(), other.vertices.begin(),
                           other.vertices.end());
  EXPECT_EQ(code(Solid::from_mesh(crossing)), ErrorCode::kSelfCrossing);
  EXPECT_EQ(*Solid::from_mesh(crossing, {.resolve = true}).volume(), 15);
  Mesh wrong = *cube(1).mesh();
  wrong.corners[3] = 99;
  EXPECT_EQ(code(Solid::from_mesh(wrong)), ErrorCode::kBadIndex);
  EXPECT_EQ(code(Solid::from_file("nowhere.off")), ErrorCode::kUnreadable);
  EXPECT_EQ(code(Solid::from_text("\"a.off\" |")), ErrorCode::kSyntax);
  EXPECT_EQ(code(Solid::sphere(-1)), ErrorCode::kOutOfRange);
  EXPECT_EQ(code(Solid::sphere(1, 2)), ErrorCode::kOutOfRange);
  EXPECT_EQ(code(Solid::box({0, 0, 0}, {1, 1, 0})), ErrorCode::kZeroArea);
  EXPECT_EQ(code(cube(1).scaled(0)), ErrorCode::kZeroArea);
  EXPECT_EQ(code(cube(1).translated({std::nan(""), 0, 0})),
            ErrorCode::kNotFinite);
  EXPECT_EQ(code(Solid::hull({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}})),
            ErrorCode::kZeroArea);
  const auto stopped =
      (cube(1) + cube(2)).evaluate({.threads = 1, .progress = [](double) {
                                      return false;
                                    }});
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, ErrorCode::kStopped);
  EXPECT_EQ(to_string(stopped.error().code), "stopped");
}

TEST(FaceSolidDeathTest, AResultWithoutAValueTellsItsMessage) {
  EXPECT_DEATH(static_cast<void>(*Solid::from_file("nowhere.off").volume()),
               "nowhere.off");
}

TEST(FaceSolid, LoopsMayGoOverResultsThatNobodyKeeps) {
  const Solid part = cube(3) - cube(1).translated({1, 1, 1});
  std::vector<std::string> names;
  for (const Solid& operand : *part.operands()) names.push_back(operand.name());
  EXPECT_EQ(names, (std::vector<std::string>{"box", "box"}));
  std::size_t corners = 0;
  for (const Region& region : *part.section({{0, 0, 1}, 1.5}))
    corners += region.boundary.size() + region.holes.at(0).size();
  EXPECT_EQ(corners, 8u);
}

TEST(FaceSolid, HullsAndPrismsAreExact) {
  std::vector<Point> points;
  for (int i = 0; i < 125; ++i)
    points.push_back({(i % 5) / 10.0, (i / 5 % 5) / 10.0, (i / 25) / 10.0});
  const Solid hull = Solid::hull(points);
  EXPECT_EQ(*hull.exact_volume(), "0.064");
  EXPECT_EQ(hull.mesh()->polygon_count(), 6u);
  EXPECT_EQ(hull.rounding()->moved, 0u);
  // Products are not the decimals; rounded to a grid they have its steps,
  // though they are multiples of longer ones there.
  for (Point& p : points) p = {0.1 * (10 * p.x), 0.1 * (10 * p.y), p.z};
  const Solid computed = Solid::hull(points);
  EXPECT_NEAR(*computed.volume(), 0.064, 1e-11);
  EXPECT_GT(computed.rounding()->moved, 0u);
  const Outline outline{{{0, 0}, {4, 0}, {4, 3}, {2, 1}, {0, 3}},
                        {{{1, 0.5}, {3, 0.5}, {2, 0.75}}}};
  EXPECT_EQ(*Solid::prism(outline, 0.5).exact_volume(), "3.875");
  EXPECT_EQ(*Solid::prism(outline, -0.5).exact_volume(), "3.875");
  EXPECT_EQ(*Solid::prism(outline, 0.5).genus(), 1);
}

TEST(FaceSolid, PointsAreInsideOnAndOutside) {
  const Solid solid = cube(2) - cube(1);
  EXPECT_EQ(*solid.locate({1.5, 1.5, 1.5}), Location::kInside);
  EXPECT_EQ(*solid.locate({0.5, 0.5, 0.5}), Location::kOutside);
  EXPECT_EQ(*solid.locate({1, 0.5, 0.5}), Location::kOn);
  EXPECT_EQ(*solid.locate({1, 1, 1}), Location::kOn);
  EXPECT_EQ(*solid.locate({0.5, 0.5, 1}), Location::kOn);
  EXPECT_EQ(*solid.locate({0.5, 0.5, 1 + 1e-9}), Location::kInside);
  EXPECT_EQ(*solid.locate({0.5, 0.5, -3}), Location::kOutside);
  EXPECT_EQ(*solid.locate({2, 2, 3}), Location::kOutside);
  EXPECT_TRUE(*cube(2).contains(cube(1)));
  EXPECT_FALSE(*cube(1).contains(cube(2)));
  EXPECT_FALSE(*cube(1).overlaps(cube(1).translated({1, 0, 0})));
  EXPECT_TRUE(*cube(1).overlaps(cube(1).translated({0.9, 0, 0})));
}

TEST(FaceSolid, MatricesOfGlmAreMaps) {
  glm::dmat4 matrix(1);
  matrix[3] = {1, 2, 3, 1};
  matrix[0][0] = 2;
  const Solid moved = cube(1).transformed(to_map(matrix));
  EXPECT_EQ(*moved.bounds(), (Bounds{{1, 2, 3}, {3, 3, 4}}));
  EXPECT_EQ(to_point(to_glm({1, 2, 3})), (Point{1, 2, 3}));
}

TEST(FaceSolid, ClosedSolidsTouchWhereTheyHaveAPoint) {
  const Solid a = cube(1);
  EXPECT_TRUE(*a.touches(cube(1).translated({1, 0, 0})));        // a face
  EXPECT_TRUE(*a.touches(cube(0.5).translated({1, 0.1, 0.2})));  // in a face
  EXPECT_TRUE(*a.touches(cube(1).translated({1, 1, 0.3})));      // an edge
  EXPECT_TRUE(*a.touches(cube(1).translated({1, 1, 1})));        // a corner
  EXPECT_TRUE(*a.touches(cube(1).translated({0.5, 0.5, 0.5})));
  EXPECT_FALSE(*a.touches(cube(1).translated({1.0001, 0, 0})));
  EXPECT_FALSE(*a.touches(Solid()));
  // An edge across a face, with no corner of either on the other.
  const Solid roof = Solid::prism({{{1, 0.5}, {3, -1}, {3, 2}}}, 4);
  EXPECT_TRUE(*a.touches(roof.translated({0, 0, -2})));
  EXPECT_FALSE(*a.touches(roof.translated({0.001, 0, -2})));
}

TEST(FaceSolid, SectionsAreRegionsWithHoles) {
  const Solid pipe =
      Solid::box({0, 0, 0}, {4, 4, 9}) - Solid::box({1, 1, -1}, {3, 3, 10});
  const auto across = *pipe.section({{0, 0, 1}, 4.5});
  ASSERT_EQ(across.size(), 1u);
  EXPECT_EQ(across[0].boundary.size(), 4u);
  ASSERT_EQ(across[0].holes.size(), 1u);
  EXPECT_EQ(across[0].holes[0].size(), 4u);
  for (const Point& p : across[0].boundary) EXPECT_EQ(p.z, 4.5);
  EXPECT_EQ(pipe.section({{1, 0, 0}, 2})->size(), 2u);
  // At its top the solid is below, and at its bottom it is not.
  EXPECT_EQ(pipe.section({{0, 0, 1}, 9})->size(), 1u);
  EXPECT_EQ(pipe.section({{0, 0, 1}, 0})->size(), 0u);
  EXPECT_EQ(pipe.section({{0, 0, 1}, 20})->size(), 0u);
}

TEST(FaceSolid, FacesThatBecomeOneAreTheSameInPlaceAndMoved) {
  // Triangles, most of which have a neighbour in their plane; of the second
  // solid the merged faces are convex, and of the third they are not.
  const Solid block = Solid::box({0, 0, 0}, {8, 6, 4});
  const Solid notched = block - Solid::box({2, 2, -1}, {5, 3, 5});
  for (const Solid& made : {block, notched, Solid::cylinder(3, 5, 4)}) {
    Mesh mesh = *made.mesh({.triangles = true});
    mesh.origins.clear();
    const Solid whole = Solid::from_mesh(mesh);
    const Solid tool =
        Solid::hull({{1, 1, 1}, {9, 2, 3}, {4, 9, 2}, {3, 3, 9}});
    const Point by{16, -8, 32};
    const Mesh here = *(whole - tool).mesh();
    const Mesh there = *(whole.translated(by) - tool.translated(by)).mesh();
    EXPECT_EQ(here.corners, there.corners);
    EXPECT_EQ(here.first_corner, there.first_corner);
    EXPECT_EQ(here.origins, there.origins);
    EXPECT_EQ(whole.mesh()->corners, made.mesh()->corners);
    EXPECT_EQ((whole - tool).mesh()->polygon_count(),
              (made - tool).mesh()->polygon_count());
  }
}

TEST(FaceSolid, MessagesSayWhatTheIndexOfAnErrorCounts) {
  Mesh mesh = *Solid::box({0, 0, 0}, {1, 1, 1}).mesh({.triangles = true});
  mesh.origins.clear();
  const auto expect = [](const Mesh& bad, ErrorCode code,
                         const std::string& noun) {
    const Error error = Solid::from_mesh(bad).volume().error();
    EXPECT_EQ(error.code, code);
    EXPECT_GE(error.index, 0);
    EXPECT_NE(to_string(error).find(noun), std::string::npos)
        << to_string(error);
    EXPECT_NE(error.message.find(std::to_string(error.index)),
              std::string::npos)
        << error.message;
  };
  Mesh bad = mesh;
  bad.corners[7] = 99;
  expect(bad, ErrorCode::kBadIndex, "corner 7");
  bad = mesh;
  bad.vertices[3].y = HUGE_VAL;
  expect(bad, ErrorCode::kNotFinite, "vertex 3");
  bad = mesh;
  bad.field_count = 1;
  bad.fields.assign(bad.corners.size(), 1);
  bad.fields[5] = NAN;
  expect(bad, ErrorCode::kNotFinite, "corner 5");
  bad = mesh;
  std::swap(bad.corners[0], bad.corners[1]);
  expect(bad, ErrorCode::kOpen, " bad edges");
  bad = mesh;
  for (std::size_t i = 0; i < bad.corners.size(); i += 3)
    std::swap(bad.corners[i], bad.corners[i + 1]);
  expect(bad, ErrorCode::kInsideOut, "polygon");
  // Two boxes that are in each other's way.
  bad = mesh;
  for (const std::int32_t corner : mesh.corners)
    bad.corners.push_back(corner + 8);
  for (std::size_t p = 0; p < mesh.polygon_count(); ++p)
    bad.first_corner.push_back(bad.first_corner.back() + 3);
  for (const Point& p : mesh.vertices)
    bad.vertices.push_back({p.x + 0.5, p.y + 0.25, p.z + 0.125});
  expect(bad, ErrorCode::kSelfCrossing, "polygon");
}

TEST(FaceSolid, AFileIsMended) {
  {
    // A tetrahedron with one face the wrong way round.
    std::ofstream file("face_turned.off");
    file << "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n"
            "3 0 2 1\n3 0 1 3\n3 1 3 2\n3 0 3 2\n";
  }
  EXPECT_FALSE(Solid::from_file("face_turned.off").volume());
  const Result<Mended> mended = halfspace::mended("face_turned.off");
  ASSERT_TRUE(mended);
  EXPECT_EQ(mended->done,
            std::vector<std::string>{"1 polygon turned to agree with others"});
  EXPECT_EQ(*mended->solid.exact_volume(), "1/6");
}

TEST(FaceSolid, TextAndFilesAreOperands) {
  ASSERT_TRUE(cube(2).save("face_cube.off"));
  const Solid file = Solid::from_file("face_cube.off");
  EXPECT_EQ(*(file - cube(1)).volume(), 7);
  const Solid text = Solid::from_text(
      R"("face_cube.off" - translate("face_cube.off", 1, 1, 1))");
  EXPECT_EQ(*text.volume(), 7);
  EXPECT_EQ(*(text & cube(1)).volume(), 1);
}

TEST(FaceSolid, ExactFilesKeepAllThatIsAsked) {
  const Solid part =
      cube(3) - Solid::hull({{-1, -1, 1}, {4, 0, 2}, {1, 5, 1}, {1, 2, 7}});
  ASSERT_TRUE(part.save("face_part.hsolid"));
  const Solid read = Solid::from_file("face_part.hsolid");
  EXPECT_EQ(*read.exact_volume(), *part.exact_volume());
  EXPECT_TRUE(*(read ^ part).is_empty());
  // Moved exactly, too; and what is open to all sides is no file's.
  EXPECT_TRUE(*(read.mirrored({{1, 0, 0}, 3}).translated({0.5, 0, 0}) ^
                part.mirrored({{1, 0, 0}, 3}).translated({0.5, 0, 0}))
                   .is_empty());
  const auto turned = read.rotated({0, 0, 1}, 33).volume();
  ASSERT_TRUE(turned) << turned.error().message;
  EXPECT_NEAR(*turned, *part.volume(), 1e-9);
}

}  // namespace
}  // namespace halfspace
