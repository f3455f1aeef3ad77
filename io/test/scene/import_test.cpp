#include "halfspace/io/import.hpp"

#include <gtest/gtest.h>

#include "halfspace/boolean.hpp"
#include "halfspace/io/read_mesh.hpp"
#include "scene/shade.hpp"

namespace halfspace::io {
namespace {

/// The usual surface in the usual light.
Rgb shaded(const Direction& normal) {
  return lit(kUsualSurface, normal, ImportOptions());
}

/// A mesh of one triangle with these vertices, as text.
Mesh triangle(const std::string& a, const std::string& b,
              const std::string& c) {
  return *read_mesh("OFF\n3 1 0\n" + a + "\n" + b + "\n" + c + "\n3 0 1 2\n",
                    Format::kOff);
}

Mesh mesh_of_doubles(std::initializer_list<std::array<double, 3>> points) {
  Mesh mesh;
  for (const auto& p : points) {
    mesh.vertices.push_back(
        {number_of(p[0]), number_of(p[1]), number_of(p[2])});
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    mesh.corners.push_back(static_cast<VertexId>(i));
  }
  mesh.first_corner.push_back(static_cast<std::uint32_t>(points.size()));
  return mesh;
}

Imported imported(const Mesh& mesh, const ImportOptions& options = {}) {
  Result<Imported> result = import_scene(mesh, options);
  EXPECT_TRUE(result) << result.error().message;
  return result ? *std::move(result) : Imported{};
}

TEST(ImportScene, FindsTheGridOfDecimals) {
  const struct {
    const char* coordinate;
    Unit unit;
    int bits;
  } cases[] = {
      {"0.1", {10, -1}, 26},
      {"-123.456789", {10, -6}, 40},
      {"33.554431", {10, -6}, 26},
      {"33.554432", {10, -6}, 40},
      {"-33.554432", {10, -6}, 26},
      {"33554431", {10, 0}, 26},
      {"54975581.3887", {10, -4}, 40},
      {"9007199254740991", {10, 0}, 54},
      {"0.000000000000001", {10, -15}, 26},
      {"0.1250", {10, -3}, 26},
      {"1e300", {10, 300}, 26},
  };
  for (const auto& [coordinate, unit, bits] : cases) {
    const ImportReport report =
        imported(triangle("0 0 0", std::string(coordinate) + " 0 0",
                          "0 " + std::string(coordinate) + " 0"))
            .report;
    EXPECT_EQ(report.unit.base, unit.base) << coordinate;
    EXPECT_EQ(report.unit.exponent, unit.exponent) << coordinate;
    EXPECT_EQ(report.grid_bits, bits) << coordinate;
    EXPECT_EQ(report.moved, 0u) << coordinate;
    EXPECT_EQ(report.max_move, 0) << coordinate;
  }
}

TEST(ImportScene, RoundsToAGridThatIsGiven) {
  ImportOptions options;
  options.unit = Unit{10, -1};
  options.grid_bits = 26;
  const Imported result =
      imported(triangle("0.26 0 -0.25", "2.5 0 0", "0 -1 0"), options);
  EXPECT_EQ(result.scene.unit(), (Unit{10, -1}));
  EXPECT_EQ(result.scene.grid_bits(), 26);
  EXPECT_EQ(result.scene.data().vertices,
            (std::vector<GridPoint>{{3, 0, -3}, {25, 0, 0}, {0, -10, 0}}));
  EXPECT_EQ(result.report.moved, 2u);
  EXPECT_EQ(result.report.max_move, 0.05);
  // Beyond the grid.
  const auto far =
      import_scene(triangle("3355443.2 0 0", "2.5 0 0", "0 -1 0"), options);
  ASSERT_FALSE(far.has_value());
  EXPECT_EQ(far.error().code, ErrorCode::kOutOfRange);
  EXPECT_TRUE(
      import_scene(triangle("3355443.1 0 0", "2.5 0 0", "0 -1 0"), options));
}

TEST(ImportScene, PutsATenthOnItsGridPoint) {
  const Imported result = imported(triangle("0.1 0 0", "2.5 0 0", "0 -1 0"));
  EXPECT_EQ(result.scene.unit(), (Unit{10, -1}));
  EXPECT_EQ(result.scene.data().vertices,
            (std::vector<GridPoint>{{1, 0, 0}, {25, 0, 0}, {0, -10, 0}}));
}

TEST(ImportScene, TakesThePowerOfTwoWhereThatNeedsFewerBits) {
  // 2^-20 in decimals has 20 places: on 10^-20, 1 does not fit 54 bits.
  const Imported text =
      imported(triangle("0 0 0", "1 0 0", "0 0.00000095367431640625 0"));
  EXPECT_EQ(text.report.unit, (Unit{2, -20}));
  EXPECT_EQ(text.report.grid_bits, 26);
  // A quarter and a float's bits: the power of two, if it was binary.
  const Imported binary =
      imported(mesh_of_doubles({{0, 0, 0}, {0.25, 0, 0}, {0, 0.5, 0}}));
  EXPECT_EQ(binary.report.unit, (Unit{2, -2}));
}

TEST(ImportScene, TellsTheLimitsOfEveryGrid) {
  for (const int bits : kGridBits) {
    const std::int64_t limit = std::int64_t{1} << (bits - 1);
    const auto bits_of = [](std::int64_t a, std::int64_t b) {
      return imported(triangle("0 0 0", std::to_string(a) + " 0 0",
                               "0 " + std::to_string(b) + " 0"))
          .report;
    };
    EXPECT_EQ(bits_of(-limit, limit - 1).grid_bits, bits);
    EXPECT_EQ(bits_of(-limit, limit - 1).moved, 0u);
    const ImportReport above = bits_of(limit, 1);
    EXPECT_TRUE(bits == 54 ? above.moved > 0 : above.grid_bits > bits);
  }
}

TEST(ImportScene, RoundsToTheNearestWhereNothingFits) {
  // 2^60 + 2^53 + 1 and 1: the unit of 54 bits is 2^8.
  const Imported result =
      imported(triangle("1161928703861587969 0 0", "0 1 0", "0 -384 0"));
  EXPECT_EQ(result.report.unit, (Unit{2, 8}));
  EXPECT_EQ(result.report.grid_bits, 54);
  EXPECT_EQ(result.report.moved, 3u);
  EXPECT_EQ(result.report.max_move, 128);  // -384 is -1.5 steps: a tie
  EXPECT_EQ(result.scene.data().vertices,
            (std::vector<GridPoint>{
                {(std::int64_t{1} << 52) + (std::int64_t{1} << 45), 0, 0},
                {0, 0, 0},
                {0, -2, 0}}));
}

TEST(ImportScene, RoundsOnRequestAndOnlyWhereItMust) {
  const Mesh mesh = triangle("1.23456789012 0 0", "0 1 0", "0 0 1");
  ImportOptions options;
  options.grid_bits = 26;
  const ImportReport report = imported(mesh, options).report;
  EXPECT_EQ(report.grid_bits, 26);
  EXPECT_EQ(report.unit, (Unit{2, -24}));
  EXPECT_EQ(report.moved, 1u);
  EXPECT_GT(report.max_move, 0);
  EXPECT_LE(report.max_move, 0x1p-25);
  options.grid_bits = 54;
  EXPECT_EQ(imported(mesh, options).report.moved, 0u);
  EXPECT_EQ(imported(mesh, options).report.grid_bits, 54);
  options.grid_bits = 32;
  EXPECT_EQ(import_scene(mesh, options).error().code, ErrorCode::kOutOfRange);
}

TEST(ImportScene, TakesTheNextUnitWhereRoundingCarries) {
  // All ones: rounded to 53 bits it becomes a power of two, one bit longer.
  const Imported result =
      imported(triangle("0.99999999999999999999999 0 0",
                        "0 0.33333333333333333333333 0", "0 0 1"));
  EXPECT_TRUE(fits(result.scene.point(0).x, 54));
  EXPECT_EQ(result.report.unit, (Unit{2, -52}));
}

TEST(ImportScene, NamesThePolygonBesideWhichOthersVanish) {
  const std::string text =
      "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 -1e30\n"
      "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";
  const auto result = import_scene(*read_mesh(text, Format::kOff), {});
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kOutOfRange);
  EXPECT_EQ(result.error().index, 1);
  EXPECT_EQ(
      result.error().message,
      "polygon 1 reaches as far as 1e+30; on the grid of 2^47 that holds "
      "it 4 of the 4 polygons have no area left; correct that polygon, or "
      "put what is so small beside it into a file of its own");
  // What had no area before is not lost.
  const Mesh flat = mesh_of_doubles({{0, 0, 0}, {1, 0, 0}, {0x1p70, 0, 0}});
  EXPECT_EQ(imported(flat).report.dropped, 1u);
  EXPECT_GT(imported(flat).report.moved, 0u);
}

TEST(ImportScene, RefinesTheUnitWithinItsBits) {
  ImportOptions options;
  options.refine_bits = 24;
  const Imported result =
      imported(triangle("0 0 0", "5 0 0", "0 5 0"), options);
  EXPECT_EQ(result.report.unit, (Unit{10, -5}));
  EXPECT_EQ(result.report.grid_bits, 26);
  EXPECT_EQ(result.scene.point(1), (GridPoint{500000, 0, 0}));
}

TEST(ImportScene, PassesOverVerticesThatNoFaceUses) {
  const Mesh mesh = *read_mesh(
      "OFF\n5 1 0\n0 0 0\n1 0 0\n0 1 0\n1e200 0 0\n0.3 0 0\n3 0 1 2\n",
      Format::kOff);
  const Imported result = imported(mesh);
  EXPECT_EQ(result.report.unit, (Unit{10, 0}));
  EXPECT_EQ(result.report.vertices, 5u);
  EXPECT_EQ(result.scene.data().vertices.size(), 3u);
}

TEST(ImportScene, MakesEqualPointsOneVertex) {
  const Mesh mesh =
      *read_mesh("OFF\n4 2 0\n0 0 0\n1 0 0\n0 1 0\n1.0 0 0\n3 0 1 2\n3 2 3 0\n",
                 Format::kOff);
  EXPECT_EQ(imported(mesh).scene.data().corners,
            (std::vector<VertexId>{0, 1, 2, 2, 1, 0}));
}

TEST(ImportScene, DropsAndCountsWhatHasNoArea) {
  const Mesh mesh = *read_mesh(
      "OFF\n5 8 0\n0 0 0\n1 0 0\n2 0 0\n0 1 0\n1 0 0\n"
      "3 0 1 2\n"     // on a line
      "3 0 0 1\n"     // two points
      "2 0 1\n"       // an edge
      "0\n1 3\n"      // nothing, a point
      "4 0 1 3 1\n"   // there and back again, off the line
      "4 0 1 4 3\n"   // good: a corner repeats
      "4 0 0 1 3\n",  // good: a corner repeats
      Format::kOff);
  const Imported result = imported(mesh);
  EXPECT_EQ(result.report.dropped, 6u);
  EXPECT_EQ(result.report.polygons, 8u);
  EXPECT_EQ(result.report.triangulated, 0u);
  EXPECT_EQ(result.scene.polygon_count(), 2u);
  EXPECT_EQ(result.faces, (std::vector<PolygonId>{6, 7}));
}

TEST(ImportScene, KeepsConvexPlanarPolygonsWithStraightCorners) {
  const Imported result = imported(
      *read_mesh("v 0 0 0\nv 1 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nf 1 2 3 4 5\n",
                 Format::kObj));
  EXPECT_EQ(result.scene.polygon_count(), 1u);
  EXPECT_EQ(result.scene.corners(0).size(), 5u);
  EXPECT_EQ(result.report.triangulated, 0u);
}

TEST(ImportScene, CutsWhatIsNotPlanarOrNotConvex) {
  const Imported result =
      imported(*read_mesh("v 0 0 0\nv 4 0 0\nv 4 4 1\nv 0 4 0\nv 1 1 0\n"
                          "f 1 2 3 4\nf 1 2 5 4\n",
                          Format::kObj));
  EXPECT_EQ(result.report.triangulated, 2u);
  EXPECT_EQ(result.scene.polygon_count(), 4u);
  EXPECT_EQ(result.faces, (std::vector<PolygonId>{0, 0, 1, 1}));
}

TEST(ImportScene, KeepsASolidClosed) {
  // A cube whose top is bent, and whose front has a corner amid an edge.
  const Imported result = imported(*read_mesh(
      "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\n"
      "v 0 0 2\nv 2 0 2\nv 2 2 3\nv 0 2 2\nv 1 0 0\n"
      "f 4 3 2 9 1\nf 5 6 7 8\nf 1 9 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n",
      Format::kObj));
  EXPECT_TRUE(bad_edges(result.scene).empty());
  EXPECT_EQ(result.report.triangulated, 1u);
}

TEST(ImportScene, SaysWhatItCannotDo) {
  EXPECT_EQ(
      import_scene(*read_mesh("v 0 0 0\n", Format::kObj), {}).error().code,
      ErrorCode::kEmpty);
  EXPECT_EQ(
      imported(*read_mesh("OFF\n0 0 0\n", Format::kOff)).scene.polygon_count(),
      0u);
  Mesh mesh = mesh_of_doubles({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  mesh.corners[1] = 3;
  EXPECT_EQ(import_scene(mesh, {}).error().code, ErrorCode::kBadIndex);
  // There and back again, and a corner apart: no more is to be cut.
  for (const int count : {100000, 100001}) {
    Mesh large = mesh_of_doubles({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
    large.corners = {3, 2};
    while (std::ssize(large.corners) < count)
      large.corners.push_back(large.corners.size() % 2 == 0 ? 0 : 1);
    large.first_corner[1] = static_cast<std::uint32_t>(count);
    const Result<Imported> result = import_scene(large, {});
    if (count == 100000) {
      EXPECT_TRUE(result);
    } else {
      EXPECT_EQ(result.error().code, ErrorCode::kOutOfRange);
    }
  }
}

TEST(ImportScene, ColoursFromTheFileFirst) {
  const Mesh mesh = *read_mesh(
      "COFF\n4 3 0\n0 0 0 10 20 30\n1 0 0 20 30 40\n0 1 0 31 41 51\n"
      "0 0 1 0 0 0\n3 0 1 2\n3 0 1 3 1 2 3\n3 0 2 3\n",
      Format::kOff);
  const Imported flat = imported(mesh);
  EXPECT_EQ(flat.scene.color(0), (Rgb{20, 30, 40}));  // 61 / 3 = 20.33, 91 / 3
  EXPECT_EQ(flat.scene.color(1), (Rgb{1, 2, 3}));
  EXPECT_EQ(flat.scene.color(2), (Rgb{14, 20, 27}));  // 41 / 3, 61 / 3, 81 / 3
  EXPECT_TRUE(flat.scene.data().corner_colors.empty());
  ImportOptions options;
  options.gouraud = true;
  const Imported smooth = imported(mesh, options);
  EXPECT_EQ(smooth.scene.corner_colors(1)[1], (Rgb{20, 30, 40}));
}

TEST(ImportScene, ShadesWhatHasNoColour) {
  const Mesh mesh = *read_mesh(
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 3 2\nf 1 2 4\n",
      Format::kObj);
  const Imported result = imported(mesh);
  EXPECT_GT(result.scene.color(0).r, result.scene.color(1).r);  // lit from up
  EXPECT_NE(result.scene.color(0), result.scene.color(2));
}

TEST(ImportScene, MakesTrianglesForGouraud) {
  ImportOptions options;
  options.gouraud = true;
  const Imported result = imported(
      *read_mesh("v 0 0 0\nv 1 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 0 0 1\n"
                 "f 1 2 3 4 5\nf 1 2 6\n",
                 Format::kObj),
      options);
  EXPECT_EQ(result.scene.polygon_count(), 4u);
  EXPECT_EQ(result.scene.data().corner_colors.size(), 12u);
  EXPECT_EQ(result.report.triangulated, 1u);
  // The same vertex has the same shade in every polygon.
  for (std::size_t i = 0; i < 12; ++i) {
    for (std::size_t j = 0; j < 12; ++j) {
      if (result.scene.data().corners[i] != result.scene.data().corners[j]) {
        continue;
      }
      EXPECT_EQ(result.scene.data().corner_colors[i],
                result.scene.data().corner_colors[j]);
    }
  }
}

TEST(ImportScene, LetsCornersGoThatRepeatTheOneBeforeRoundTheEndToo) {
  const std::string vertices =
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 0\nv 0 0.0 0\n";
  const Imported result = imported(*read_mesh(
      vertices + "f 1 4 2 2 3 3 5 1\nf 4 5 2 3 4 1\n", Format::kObj));
  EXPECT_EQ(result.scene.data().corners,
            (std::vector<VertexId>{0, 1, 2, 0, 1, 2}));
  EXPECT_EQ(result.report.dropped, 0u);
  const Imported nothing = imported(*read_mesh(
      vertices + "f 1 2 3\nf 1 2 4\nf 1 4 5\nf 2 2 3\n", Format::kObj));
  EXPECT_EQ(nothing.report.dropped, 3u);
  EXPECT_EQ(nothing.scene.polygon_count(), 1u);
}

/// A tent of two triangles and a flat one, and what they are coloured by.
Imported tent(const std::string& colors_of_faces) {
  // The last vertex is the first again: one point, one sum of normals.
  ImportOptions options;
  options.gouraud = true;
  return imported(
      *read_mesh("OFF\n6 3 0\n0 0 0\n3 0 0\n0 4 0\n0 0 5\n2 2 0\n0 0 0\n" +
                     colors_of_faces,
                 Format::kOff),
      options);
}

TEST(ImportScene, ShadesCornersByTheSumOfTheNormalsOfTheirFaces) {
  const Imported result = tent("3 0 1 2\n3 5 3 1\n3 0 2 3\n");
  const Direction flat = {0, 0, 12}, front = {0, 15, 0}, side = {20, 0, 0};
  const auto sum = [](const Direction& u, const Direction& v) {
    return Direction{u[0] + v[0], u[1] + v[1], u[2] + v[2]};
  };
  const std::vector<Rgb> shades = {
      shaded(sum(sum(flat, front), side)), shaded(sum(flat, front)),
      shaded(sum(flat, side)), shaded(sum(front, side))};
  ASSERT_EQ(result.scene.polygon_count(), 3u);
  const auto& corners = result.scene.data().corners;
  EXPECT_EQ(corners, (std::vector<VertexId>{0, 1, 2, 0, 3, 1, 0, 2, 3}));
  for (std::size_t i = 0; i < corners.size(); ++i) {
    EXPECT_EQ(result.scene.data().corner_colors[i],
              shades[static_cast<std::size_t>(corners[i])]);
  }
}

TEST(ImportScene, LightsTheColoursOfTheFileWhereThatIsAskedFor) {
  const Mesh white = *read_mesh(
      "OFF\n4 2 0\n0 0 0\n3 0 0\n0 4 0\n0 0 5\n"
      "3 0 1 2 255 255 255\n3 0 1 3 255 255 255\n",
      Format::kOff);
  const Rgb plain = {255, 255, 255};
  const ImportOptions usual;
  EXPECT_EQ(imported(white).scene.color(0), plain);
  ImportOptions options;
  options.light_colors = true;
  const Scene lit_scene = imported(white, options).scene;
  EXPECT_EQ(lit_scene.color(0), lit(plain, {0, 0, 1}, usual));
  EXPECT_EQ(lit_scene.color(1), lit(plain, {0, -1, 0}, usual));
  EXPECT_NE(lit_scene.color(0), lit_scene.color(1));
  options.gouraud = true;
  const Scene smooth = imported(white, options).scene;
  EXPECT_EQ(smooth.corner_colors(0)[2], lit(plain, {0, 0, 12}, usual));
  EXPECT_EQ(smooth.corner_colors(1)[2], lit(plain, {0, -15, 0}, usual));
  options = {};
  options.surface = Rgb{10, 20, 30};
  options.lights = {{{0, 0, 1}}};
  EXPECT_EQ(imported(white, options).scene.color(0), (Rgb{10, 20, 30}));
}

TEST(ImportScene, GivesCornersTheColourOfTheirFaceWhereItHasOne) {
  const Imported result = tent("3 0 1 2 9 8 7\n3 5 3 1\n3 0 2 3 1 2 3\n");
  const Direction side = {20, 0, 0};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(result.scene.corner_colors(0)[i], (Rgb{9, 8, 7}));
    EXPECT_NE(result.scene.corner_colors(1)[i], (Rgb{9, 8, 7}));
    EXPECT_EQ(result.scene.corner_colors(2)[i], (Rgb{1, 2, 3}));
  }
  EXPECT_NE(result.scene.corner_colors(1)[0], shaded(side));
}

}  // namespace
}  // namespace halfspace::io
