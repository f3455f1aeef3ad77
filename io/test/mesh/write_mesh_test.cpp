#include "halfspace/io/write_mesh.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "halfspace/io/file.hpp"
#include "halfspace/io/import.hpp"
#include "halfspace/io/number.hpp"
#include "halfspace/io/read_mesh.hpp"
#include "mesh/samples.hpp"

namespace halfspace::io {
namespace {

constexpr const char* kNames[] = {"a.obj", "a.off", "a.ply", "a.stl"};

/// Two triangles and a quad, with coordinates that are multiples of the unit.
SceneData scene_data(Unit unit, std::int64_t step, int bits = 26) {
  SceneData data;
  data.unit = unit;
  data.grid_bits = bits;
  data.vertices = {
      {0, 0, 0}, {step, 0, 0}, {step, step, 0}, {0, step, 0}, {0, 0, -step}};
  data.first_corner = {0, 3, 7, 10};
  data.corners = {0, 1, 4, 0, 1, 2, 3, 4, 3, 0};
  data.colors = {{1, 2, 3}, {4, 5, 6}, {255, 0, 128}};
  return data;
}

Scene scene_of(const SceneData& data) {
  const Result<Scene> scene = make_scene(data);
  EXPECT_TRUE(scene) << scene.error().message;
  return scene ? *scene : Scene{};
}

/// What a scene's file reads back to.
Result<Imported> read_back(const std::filesystem::path& path) {
  const Result<Mesh> mesh = read_mesh(path);
  if (!mesh) return mesh.error();
  return import_scene(*mesh, {});
}

/// The corners' exact coordinates, polygon by polygon.
std::vector<std::vector<std::array<Number, 3>>> points_of(const Scene& scene) {
  std::vector<std::vector<std::array<Number, 3>>> all;
  const Unit unit = scene.unit();
  const auto number = [unit](std::int64_t steps) {
    return normalised(steps, unit.exponent,
                      unit.base == 10 ? unit.exponent : 0);
  };
  for (std::size_t p = 0; p < scene.polygon_count(); ++p) {
    auto& points = all.emplace_back();
    for (const VertexId corner : scene.corners(static_cast<PolygonId>(p))) {
      const GridPoint& g = scene.point(corner);
      points.push_back({number(g.x), number(g.y), number(g.z)});
    }
  }
  return all;
}

TEST(WriteSceneMesh, ReadsBackExactlyInEveryFormat) {
  const struct {
    Unit unit;
    std::int64_t step;
    int bits;
  } cases[] = {{{10, 0}, 7, 26},
               {{10, -6}, 33554431, 26},
               {{10, 3}, 12, 26},
               {{2, -10}, 5, 26},
               {{2, 30}, 3, 26},
               {{2, -45}, (1LL << 53) - 1, 54},
               {{10, -15}, (1LL << 53) - 1, 54},
               {{10, -40}, 33554431, 26},
               {{2, -60}, 33554431, 26}};
  for (const auto& [unit, step, bits] : cases) {
    const Scene scene = scene_of(scene_data(unit, step, bits));
    for (const char* name : {"a.obj", "a.off", "a.ply"}) {
      const samples::TemporaryFile file(name);
      const Result<ExportReport> report = write_scene_mesh(file.path(), scene);
      ASSERT_TRUE(report) << report.error().message;
      EXPECT_EQ(report->moved, 0u);
      const Result<Imported> back = read_back(file.path());
      ASSERT_TRUE(back) << back.error().message;
      EXPECT_EQ(points_of(back->scene), points_of(scene)) << name;
      EXPECT_EQ(back->report.moved, 0u);
      if (name != std::string("a.obj")) {
        EXPECT_EQ(back->scene.data().colors, scene.data().colors);
      }
    }
  }
}

TEST(WriteSceneMesh, CutsAnStlAndTellsHowFarFloatsMoveIt) {
  const samples::TemporaryFile file("a.stl");
  const Scene exact = scene_of(scene_data({2, -3}, 5));
  Result<ExportReport> report = write_scene_mesh(file.path(), exact);
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_EQ(report->moved, 0u);
  EXPECT_EQ(report->triangulated, 1u);
  EXPECT_EQ(read_back(file.path())->scene.polygon_count(), 4u);

  const Scene tenths = scene_of(scene_data({10, -1}, 1));
  report = write_scene_mesh(file.path(), tenths);
  ASSERT_TRUE(report);
  EXPECT_EQ(report->moved, 5u);  // five coordinates are a tenth in size
  // The float is 0.100000001490116119384765625.
  EXPECT_EQ(report->max_move, 1.490116119384765625e-9);
}

TEST(WriteSceneMesh, CutsStraightCornersIntoTrianglesWithArea) {
  SceneData data;
  data.vertices = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 2, 0}};
  data.first_corner = {0, 4};
  data.corners = {0, 1, 2, 3};
  data.colors = {{}};
  const samples::TemporaryFile file("a.stl");
  ASSERT_TRUE(write_scene_mesh(file.path(), scene_of(data)));
  const Result<Imported> back = read_back(file.path());
  EXPECT_EQ(back->scene.polygon_count(), 2u);
  EXPECT_EQ(back->report.dropped, 0u);
}

TEST(WriteSceneMesh, CutsEachPolygonByItself) {
  SceneData data;
  data.vertices = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0},
                   {0, 0, 5}, {3, 0, 5}, {3, 1, 5}, {0, 1, 5}};
  data.first_corner = {0, 4, 8};
  data.corners = {0, 1, 2, 3, 4, 5, 6, 7};
  data.colors = {{}, {}};
  const samples::TemporaryFile file("a.stl");
  const Result<ExportReport> report =
      write_scene_mesh(file.path(), scene_of(data));
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_EQ(report->triangulated, 2u);
  EXPECT_EQ(read_back(file.path())->scene.polygon_count(), 4u);
}

TEST(WriteSceneMesh, WritesDoublesWhereDecimalsAreLong) {
  const Scene scene = scene_of(scene_data({2, -400}, 33554431));
  for (const char* name : {"a.obj", "a.off"}) {
    const samples::TemporaryFile file(name);
    const Result<ExportReport> report = write_scene_mesh(file.path(), scene);
    ASSERT_TRUE(report);
    EXPECT_EQ(report->moved, 0u);  // doubles hold them
  }
  const Scene large = scene_of(scene_data({10, 300}, (1LL << 53) - 1, 54));
  const samples::TemporaryFile file("a.obj");
  const Result<ExportReport> report = write_scene_mesh(file.path(), large);
  ASSERT_FALSE(report);
  EXPECT_EQ(report.error().code, ErrorCode::kNotFinite);
}

TEST(WriteSceneMesh, WritesAnEmptyScene) {
  for (const char* name : kNames) {
    const samples::TemporaryFile file(name);
    ASSERT_TRUE(write_scene_mesh(file.path(), Scene{})) << name;
    const Result<Imported> back = read_back(file.path());
    ASSERT_TRUE(back) << name << back.error().message;
    EXPECT_EQ(back->scene.polygon_count(), 0u);
  }
}

TEST(WriteSceneMesh, WritesDecimalsToTheLetter) {
  const samples::TemporaryFile file("a.off");
  const auto first_points = [&](Unit unit, std::int64_t step, int bits) {
    EXPECT_TRUE(
        write_scene_mesh(file.path(), scene_of(scene_data(unit, step, bits))));
    const std::string bytes = *samples::raw_bytes(file.path());
    const std::size_t begin = bytes.find("0 0 0\n") + 6;
    return bytes.substr(begin, bytes.find('\n', begin) - begin);
  };
  EXPECT_EQ(first_points({10, 0}, 120, 26), "120 0 0");
  EXPECT_EQ(first_points({10, 3}, 12, 26), "12000 0 0");
  EXPECT_EQ(first_points({10, -1}, 12, 26), "1.2 0 0");
  EXPECT_EQ(first_points({10, -2}, 12, 26), "0.12 0 0");
  EXPECT_EQ(first_points({10, -3}, 12, 26), "0.012 0 0");
  EXPECT_EQ(first_points({10, -3}, 5000, 26), "5 0 0");
  EXPECT_EQ(first_points({2, -3}, 5, 26), "0.625 0 0");
  EXPECT_EQ(first_points({2, 5}, 3, 26), "96 0 0");
  // 80 characters are written exactly, more are a double's.
  EXPECT_EQ(first_points({10, 79}, 1, 26), "1" + std::string(79, '0') + " 0 0");
  EXPECT_EQ(first_points({10, 80}, 1, 26), "1e+80 0 0");
  EXPECT_EQ(first_points({10, -78}, 1, 26),
            "0." + std::string(77, '0') + "1 0 0");
  EXPECT_EQ(first_points({10, -79}, 1, 26), "1e-79 0 0");
}

TEST(WriteSceneMesh, TellsHowFarDoublesMove) {
  const samples::TemporaryFile file("a.off");
  const Result<ExportReport> report =
      write_scene_mesh(file.path(), scene_of(scene_data({10, -90}, 3, 26)));
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_EQ(report->moved, 5u);
  EXPECT_GT(report->max_move, 0);
  EXPECT_LT(report->max_move, 3e-90 * 0x1p-53);
  const Scene huge = scene_of(scene_data({10, 300}, (1LL << 53) - 1, 54));
  samples::expect_error(
      write_scene_mesh(file.path(), huge), ErrorCode::kNotFinite,
      file.path().string() + ": vertex 1 has a coordinate that no double holds",
      1);
}

TEST(WriteSceneMesh, PlyIsOfBytesWhereDoublesAreExact) {
  const samples::TemporaryFile file("a.ply");
  const struct {
    Unit unit;
    bool is_binary;
  } cases[] = {{{2, 0}, true},   {{2, -1022}, true}, {{2, -1023}, false},
               {{2, 900}, true}, {{2, 901}, false},  {{10, 0}, false},
               {{10, -3}, false}};
  for (const auto& [unit, is_binary] : cases) {
    const Result<ExportReport> report =
        write_scene_mesh(file.path(), scene_of(scene_data(unit, 3, 26)));
    ASSERT_TRUE(report) << report.error().message;
    EXPECT_EQ(samples::raw_bytes(file.path())->find("format binary") == 4,
              is_binary)
        << unit.base << " " << unit.exponent;
  }
}

TEST(WriteSceneMesh, RefusesPolygonsOfTooManyCornersInAnStl) {
  for (const std::size_t count : {100000u, 100001u}) {
    SceneData data;
    data.grid_bits = 54;
    // On a parabola, so that every corner turns.
    for (std::size_t i = 0; i < count; ++i) {
      const auto x = static_cast<std::int64_t>(i);
      data.vertices.push_back({x, x * x, 0});
      data.corners.push_back(static_cast<VertexId>(i));
    }
    data.first_corner = {0, static_cast<std::uint32_t>(count)};
    data.colors = {{}};
    const samples::TemporaryFile file("a.stl");
    const Result<ExportReport> report =
        write_scene_mesh(file.path(), scene_of(data));
    if (count == 100000) {
      ASSERT_TRUE(report) << report.error().message;
      EXPECT_EQ(report->triangulated, 1u);
      EXPECT_EQ(samples::raw_bytes(file.path())->size(), 84u + 50 * 99998);
      continue;
    }
    samples::expect_error(report, ErrorCode::kOutOfRange,
                          file.path().string() +
                              ": polygon 0 has 100001 corners, too many to cut "
                              "into triangles",
                          0);
  }
}

OutputMesh output_mesh() {
  OutputMesh mesh;
  mesh.vertices = {
      {0.1, 1.0 / 3, -1e300}, {1, 0, 5e-324}, {0, 1, 0}, {1, 1, 1}};
  mesh.first_corner = {0, 3, 7};
  mesh.corners = {0, 1, 2, 0, 1, 3, 2};
  mesh.colors = {{1, 2, 3}, {4, 5, 6}};
  return mesh;
}

TEST(WriteMesh, ReadsBackAsTheSameDoubles) {
  const OutputMesh mesh = output_mesh();
  for (const char* name : {"a.obj", "a.off", "a.ply"}) {
    const samples::TemporaryFile file(name);
    const Result<ExportReport> report = write_mesh(file.path(), mesh);
    ASSERT_TRUE(report) << report.error().message;
    EXPECT_EQ(report->moved, 0u);
    const Result<Mesh> back = read_mesh(file.path());
    ASSERT_TRUE(back) << back.error().message;
    EXPECT_EQ(back->corners, mesh.corners);
    EXPECT_EQ(back->first_corner, mesh.first_corner);
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        EXPECT_EQ(to_double(back->vertices[v][axis]), mesh.vertices[v][axis]);
      }
    }
  }
}

TEST(WriteMesh, MovesToFloatsInAnStl) {
  OutputMesh mesh = output_mesh();
  const samples::TemporaryFile file("a.stl");
  const Result<ExportReport> large = write_mesh(file.path(), mesh);
  ASSERT_FALSE(large);
  EXPECT_EQ(large.error().code, ErrorCode::kNotFinite);
  mesh.vertices[0][2] = 0.5;
  mesh.vertices[1][2] = 0;
  const Result<ExportReport> report = write_mesh(file.path(), mesh);
  ASSERT_TRUE(report);
  EXPECT_EQ(report->moved, 2u);
  EXPECT_EQ(report->max_move, std::abs(double{1.f / 3} - 1.0 / 3));
  EXPECT_EQ(report->triangulated, 1u);
  EXPECT_EQ(read_mesh(file.path())->face_count(), 3u);
}

TEST(WriteMesh, WritesFacesOfManyCorners) {
  OutputMesh mesh;
  for (int i = 0; i < 300; ++i) {
    mesh.vertices.push_back({std::cos(i / 50.0), std::sin(i / 50.0), 0});
    mesh.corners.push_back(i);
  }
  mesh.first_corner = {0, 300};
  for (const char* name : {"a.obj", "a.off", "a.ply"}) {
    const samples::TemporaryFile file(name);
    ASSERT_TRUE(write_mesh(file.path(), mesh));
    EXPECT_EQ(read_mesh(file.path())->corners, mesh.corners) << name;
  }
}

TEST(WriteMesh, SaysWhyItCannot) {
  const OutputMesh mesh = output_mesh();
  const samples::TemporaryFile file("a.obj");
  EXPECT_EQ(write_mesh("/nowhere/at/all.obj", mesh).error().code,
            ErrorCode::kUnwritable);
  for (const char* name : {"a.abc", "a"}) {
    EXPECT_EQ(write_mesh(file.path().parent_path() / name, mesh).error().code,
              ErrorCode::kUnknownFormat);
  }
  OutputMesh bad = mesh;
  bad.vertices[1][1] = std::numeric_limits<double>::quiet_NaN();
  const Result<ExportReport> report = write_mesh(file.path(), bad);
  ASSERT_FALSE(report);
  EXPECT_EQ(report.error().code, ErrorCode::kNotFinite);
  EXPECT_EQ(report.error().index, 1);
}

TEST(WriteMesh, ErrorsAreToTheLetter) {
  const samples::TemporaryFile file("a.stl");
  const std::string name = file.path().string() + ": ";
  OutputMesh mesh = output_mesh();
  samples::expect_error(
      write_mesh("/nowhere/at/all.obj", mesh), ErrorCode::kUnwritable,
      "/nowhere/at/all.obj: cannot be written: No such file or directory");
  for (const char* bad : {"a.abc", "a.abc.gz", "a"}) {
    samples::expect_error(write_mesh(bad, mesh), ErrorCode::kUnknownFormat,
                          std::string(bad) +
                              ": a mesh is written to .obj, .stl, .ply, "
                              ".off, .3mf, .glb or .gltf");
    samples::expect_error(write_scene_mesh(bad, Scene{}),
                          ErrorCode::kUnknownFormat,
                          std::string(bad) +
                              ": a mesh is written to .obj, .stl, .ply, "
                              ".off, .3mf, .glb or .gltf");
  }
  mesh.vertices[0][2] = 0x1p128;
  samples::expect_error(
      write_mesh(file.path(), mesh), ErrorCode::kNotFinite,
      name +
          "vertex 0 has the coordinate 340282366920938463463374607431768211456."
          "000000, which no float holds",
      0);
  mesh.vertices[2][1] = -std::numeric_limits<double>::infinity();
  samples::expect_error(write_mesh(file.path(), mesh), ErrorCode::kNotFinite,
                        name + "vertex 2 has the coordinate -inf", 2);
  mesh.vertices[0][0] = std::numeric_limits<double>::infinity();
  samples::expect_error(write_mesh(file.path(), mesh), ErrorCode::kNotFinite,
                        name + "vertex 0 has the coordinate inf", 0);
}

TEST(WriteMesh, WritesExactDecimalsOfDoublesWhereTheyAreAskedFor) {
  OutputMesh mesh;
  mesh.vertices = {{0.1, -0.5, 0x1p-60},
                   {-0x1.fffffffffffffp+52, 1e-300, 0x1.8p+70},
                   {std::numeric_limits<double>::denorm_min(), 3, -0.0}};
  mesh.first_corner = {0, 3};
  mesh.corners = {0, 1, 2};
  for (const char* name : {"a.obj", "a.off"}) {
    for (const bool exact : {false, true}) {
      mesh.exact_decimals = exact;
      const samples::TemporaryFile file(name);
      ASSERT_TRUE(write_mesh(file.path(), mesh));
      const Result<Mesh> back = read_mesh(file.path());
      ASSERT_TRUE(back) << back.error().message;
      std::size_t same = 0;
      for (std::size_t v = 0; v < 3; ++v) {
        for (std::size_t k = 0; k < 3; ++k) {
          const Number number = number_of(mesh.vertices[v][k]);
          EXPECT_EQ(to_double(back->vertices[v][k]), to_double(number));
          same += back->vertices[v][k] == number ? 1u : 0u;
        }
      }
      EXPECT_EQ(same == 9, exact) << name;
    }
  }
}

TEST(WriteMesh, WritesTheSameByAnyNumberOfThreads) {
  OutputMesh mesh;
  // Some blocks of vertices, the last one not full.
  for (int v = 0; v < 9999; ++v)
    mesh.vertices.push_back({v / 7.0, -v / 3.0, v * 0x1p-40});
  for (VertexId v = 0; v < 9999; ++v) mesh.corners.push_back(v);
  for (std::uint32_t end = 3; end <= 9999; end += 3)
    mesh.first_corner.push_back(end);
  mesh.exact_decimals = true;
  for (const char* name : {"a.obj", "a.off"}) {
    const samples::TemporaryFile file(name);
    std::string one;
    for (const int threads : {1, 2, 0}) {
      mesh.threads = threads;
      ASSERT_TRUE(write_mesh(file.path(), mesh));
      const Result<std::string> bytes = read_file(file.path());
      ASSERT_TRUE(bytes);
      if (one.empty()) one = *bytes;
      EXPECT_TRUE(*bytes == one) << name << " by " << threads;
    }
    const Result<Mesh> back = read_mesh(file.path());
    ASSERT_TRUE(back);
    ASSERT_EQ(back->vertices.size(), mesh.vertices.size());
    EXPECT_EQ(back->vertices[8191][0], number_of(8191 / 7.0));
    EXPECT_EQ(back->vertices[8192][1], number_of(-8192 / 3.0));
  }
}

TEST(WriteMesh, RefusesWhatIsNoMesh) {
  const samples::TemporaryFile file("a.off");
  OutputMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {2, 1, 0}};
  mesh.first_corner = {0, 3};
  for (const VertexId bad : {3, -1}) {
    mesh.corners = {0, 1, bad};
    const auto report = write_mesh(file.path(), mesh);
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().code, ErrorCode::kBadIndex);
    EXPECT_EQ(report.error().index, 2);
  }
  mesh.corners = {0, 1};
  EXPECT_EQ(write_mesh(file.path(), mesh).error().code, ErrorCode::kBadIndex);
  mesh.first_corner = {0, 2};
  EXPECT_EQ(write_mesh(file.path(), mesh).error().code,
            ErrorCode::kTooFewVertices);
  mesh.corners = {0, 1, 2};
  mesh.first_corner = {0, 3};
  mesh.colors.resize(2);
  EXPECT_EQ(write_mesh(file.path(), mesh).error().code, ErrorCode::kBadIndex);
}

TEST(WriteMesh, CutsFansForAnStl) {
  OutputMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {2, 1, 0}, {1, 2, 0}, {0, 1, 0}};
  mesh.first_corner = {0, 5, 8, 12};
  mesh.corners = {4, 0, 1, 2, 3, 0, 2, 1, 3, 2, 1, 0};
  const samples::TemporaryFile file("a.stl");
  const Result<ExportReport> report = write_mesh(file.path(), mesh);
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_EQ(report->triangulated, 2u);
  EXPECT_EQ(report->moved, 0u);
  EXPECT_EQ(report->max_move, 0);
  const Result<Mesh> back = read_mesh(file.path());
  std::vector<std::array<double, 3>> corners;
  for (const VertexId corner : back->corners) {
    const auto& p = back->vertices[static_cast<std::size_t>(corner)];
    corners.push_back({to_double(p[0]), to_double(p[1]), to_double(p[2])});
  }
  std::vector<std::array<double, 3>> want;
  for (const std::size_t v : {4u, 0u, 1u, 4u, 1u, 2u, 4u, 2u, 3u, 0u, 2u, 1u,
                              3u, 2u, 1u, 3u, 1u, 0u}) {
    want.push_back(mesh.vertices[v]);
  }
  EXPECT_EQ(corners, want);
}

TEST(WriteMesh, WhatHasNoColourHasNoneInPlyEither) {
  OutputMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.corners = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
  mesh.first_corner = {0, 3, 6, 9, 12};
  mesh.colors = {{1, 2, 3}, kUsualSurface, kUsualSurface, {4, 5, 6}};
  const samples::TemporaryFile file("a.ply");
  for (const bool some_lack : {false, true}) {
    if (some_lack) mesh.has_color = {true, false, true, true};
    ASSERT_TRUE(write_mesh(file.path(), mesh));
    const Result<Mesh> back = read_mesh(file.path());
    ASSERT_TRUE(back) << back.error().message;
    ASSERT_EQ(back->face_colors.size(), 4u);
    EXPECT_EQ(back->face_colors[0], mesh.colors[0]);
    EXPECT_EQ(back->face_colors[1].has_value(), !some_lack);
    // A colour of its own may be the usual one.
    EXPECT_EQ(back->face_colors[2], kUsualSurface);
    EXPECT_EQ(back->face_colors[3], mesh.colors[3]);
    EXPECT_TRUE(back->attributes.empty());
    const std::string bytes = *samples::raw_bytes(file.path());
    EXPECT_EQ(bytes.find("halfspace_has_color") != std::string::npos,
              some_lack);
  }
}

}  // namespace
}  // namespace halfspace::io
