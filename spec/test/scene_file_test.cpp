#include "halfspace/scene_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace halfspace {
namespace {

const std::string kExample =
    "halfspace-scene 1\n"
    "unit 10 -3\n"
    "grid 26\n"
    "v 0 0 0\n"
    "v 1000 0 0\n"
    "v 0 1000 0\n"
    "p 0 1 2 color 200 80 40 colors 1 2 3 4 5 6 7 8 9\n"
    "eye 64000 64000 512000 1\n"
    "s0 -64000 320000 0\n"
    "sx 4000 0 0\n"
    "sy 0 -4000 0\n"
    "near 17\n"
    "size 64 48\n"
    "cull\n"
    "shade gouraud\n"
    "background 9 8 7\n"
    "end\n";

/// The example with one line, found by its start, put in place of another.
std::string with_line(const std::string& start, const std::string& line,
                      std::string text = kExample) {
  const std::size_t at = text.find("\n" + start) + 1;
  EXPECT_NE(at, 0u);
  return text.replace(at, text.find('\n', at) + 1 - at, line);
}

ErrorCode code_of(const std::string& text) {
  const Result<SceneFile> file = read_scene(text);
  EXPECT_FALSE(file) << text;
  return file ? static_cast<ErrorCode>(-1) : file.error().code;
}

TEST(SceneFile, HoldsWhatWasWrittenInIt) {
  const Result<SceneFile> file = read_scene(kExample);
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_EQ(file->scene.unit(), (Unit{10, -3}));
  EXPECT_EQ(file->scene.grid_bits(), 26);
  ASSERT_EQ(file->scene.polygon_count(), 1u);
  EXPECT_EQ(file->scene.point(1), (GridPoint{1000, 0, 0}));
  EXPECT_EQ(file->scene.color(0), (Rgb{200, 80, 40}));
  EXPECT_EQ(file->scene.corner_colors(0)[2], (Rgb{7, 8, 9}));
  const CameraData& camera = file->camera->data();
  EXPECT_EQ(camera.eye, (LatticeVector{64000, 64000, 512000}));
  EXPECT_TRUE(camera.perspective);
  EXPECT_EQ(camera.s0, (LatticeVector{-64000, 320000, 0}));
  EXPECT_EQ(camera.sx, (LatticeVector{4000, 0, 0}));
  EXPECT_EQ(camera.sy, (LatticeVector{0, -4000, 0}));
  EXPECT_EQ(camera.near, 17);
  EXPECT_EQ(camera.width_px, 64);
  EXPECT_EQ(camera.height_px, 48);
  EXPECT_EQ(file->options, (ImageOptions{true, Shading::kGouraud, {9, 8, 7}}));
}

TEST(SceneFile, RoundTrips) {
  EXPECT_EQ(write_scene(*read_scene(kExample)), kExample);
  for (const std::string& text :
       {with_line("near", ""), with_line("near", "near 0\n"),
        with_line("eye", "eye 0 0 549755813888 1\n"),
        with_line("eye", "eye 0 0 1 0\n", with_line("near", "near -5\n")),
        with_line("cull", ""), with_line("p", ""),
        with_line("p", "p 0 1 2 color 5 5 5\n"),
        with_line("shade", "shade flat\n"),
        std::string("halfspace-scene 1\nunit 2 -4096\ngrid 54\nend\n")}) {
    const Result<SceneFile> file = read_scene(text);
    ASSERT_TRUE(file) << file.error().message;
    const Result<SceneFile> again = read_scene(write_scene(*file));
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(*again, *file);
  }
}

TEST(SceneFile, GivesCornersWithoutColoursTheirPolygonsColour) {
  const std::string plain = "p 0 1 2 color 5 6 7\n";
  const std::string line = "p 2 1 0 color 0 0 0 colors 1 2 3 4 5 6 7 8 9\n";
  const Result<SceneFile> file =
      read_scene(with_line("p", plain + line + plain));
  ASSERT_TRUE(file) << file.error().message;
  for (const PolygonId polygon : {0, 2}) {
    for (const Rgb color : file->scene.corner_colors(polygon)) {
      EXPECT_EQ(color, (Rgb{5, 6, 7}));
    }
  }
  EXPECT_EQ(file->scene.corner_colors(1)[0], (Rgb{1, 2, 3}));
  EXPECT_EQ(*read_scene(write_scene(*file)), *file);
}

TEST(SceneFile, AllowsCommentsBlankLinesAndCarriageReturns) {
  std::string text = "# first\r\n\r\n";
  for (const char c : kExample) {
    if (c == '\n') {
      text += "\t # more\r\n \r\n";
    } else {
      text += c;
    }
  }
  const Result<SceneFile> file = read_scene(text);
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_EQ(*file, *read_scene(kExample));
}

TEST(SceneFile, IsTruncatedWhereverItIsCut) {
  // Only the last line feed may be missing.
  for (std::size_t size = 0; size + 1 < kExample.size(); ++size) {
    EXPECT_EQ(code_of(kExample.substr(0, size)), ErrorCode::kTruncated) << size;
  }
  EXPECT_TRUE(read_scene(kExample.substr(0, kExample.size() - 1)));
}

TEST(SceneFile, NamesTheLineOfWhatIsWrong) {
  const struct {
    const char* start;
    const char* line;
    ErrorCode code;
  } cases[] = {
      {"unit", "grid 26\n", ErrorCode::kSyntax},
      {"unit", "unit 3 0\n", ErrorCode::kOutOfRange},
      {"unit", "unit 10 5000\n", ErrorCode::kOutOfRange},
      {"unit", "unit 10\n", ErrorCode::kSyntax},
      {"grid", "grid 32\n", ErrorCode::kOutOfRange},
      {"v", "v 0 0\n", ErrorCode::kSyntax},
      {"v", "v 0 0 0 0\n", ErrorCode::kSyntax},
      {"v", "v 0 0.5 0\n", ErrorCode::kSyntax},
      {"v", "v 33554432 0 0\n", ErrorCode::kOutOfRange},
      {"v", "v 99999999999999999999999999999999999999999999 0 0\n",
       ErrorCode::kOutOfRange},
      {"p", "p 0 1 3 color 0 0 0\n", ErrorCode::kBadIndex},
      {"p", "p 0 1 -1 color 0 0 0\n", ErrorCode::kBadIndex},
      {"p", "p 0 1 2\n", ErrorCode::kSyntax},
      {"p", "p 0 1 2 color 0 0\n", ErrorCode::kSyntax},
      {"p", "p 0 1 2 color 0 0 0 0\n", ErrorCode::kSyntax},
      {"p", "p 0 1 2 color 0 0 256\n", ErrorCode::kOutOfRange},
      {"p", "p 0 1 x color 0 0 0\n", ErrorCode::kSyntax},
      {"p", "p 0 1 2 color 0 0 0 colors 0 0 0\n", ErrorCode::kSyntax},
      {"p", "q 0 1 2 color 0 0 0\n", ErrorCode::kSyntax},
      {"s0", "eye 0 0 0 1\n", ErrorCode::kSyntax},
      {"eye", "eye 0 0 0\n", ErrorCode::kSyntax},
      {"eye", "eye 0 0 0 2\n", ErrorCode::kOutOfRange},
      {"size", "size 0 48\n", ErrorCode::kOutOfRange},
      {"size", "size 64 65537\n", ErrorCode::kOutOfRange},
      {"cull", "cull 1\n", ErrorCode::kSyntax},
      {"shade", "shade smooth\n", ErrorCode::kSyntax},
      {"background", "background 1 2\n", ErrorCode::kSyntax},
  };
  for (const auto& [start, line, code] : cases) {
    const std::string text = with_line(start, line);
    const Result<SceneFile> file = read_scene(text);
    ASSERT_FALSE(file) << line;
    EXPECT_EQ(file.error().code, code) << line << file.error().message;
    const std::size_t before = text.find("\n" + std::string(line)) + 1;
    const auto number =
        1 + std::count(text.begin(),
                       text.begin() + static_cast<std::ptrdiff_t>(before),
                       '\n');
    EXPECT_EQ(file.error().index, number) << line;
    EXPECT_NE(file.error().message.find("line " + std::to_string(number)),
              std::string::npos);
  }
  EXPECT_EQ(code_of(kExample + "v 1 2 3\n"), ErrorCode::kSyntax);
  EXPECT_EQ(code_of(std::string("halfspace-scene 2\n")), ErrorCode::kSyntax);
  for (const char* line : {"eye", "s0", "sx", "sy", "size"}) {
    EXPECT_EQ(code_of(with_line(line, "")), ErrorCode::kSyntax) << line;
  }
}

TEST(SceneFile, PassesOnWhatSceneAndCameraRefuse) {
  const Result<SceneFile> flat =
      read_scene(with_line("p", "p 0 1 color 0 0 0\n"));
  ASSERT_FALSE(flat);
  EXPECT_EQ(flat.error().code, ErrorCode::kTooFewVertices);
  EXPECT_EQ(flat.error().index, 0);
  EXPECT_EQ(flat.error().message.substr(0, 7), "line 7:");
  EXPECT_EQ(code_of(with_line("sx", "sx 0 8 0\n")), ErrorCode::kBadCamera);
  EXPECT_EQ(code_of(with_line("sx", "sx 549755813889 0 0\n")),
            ErrorCode::kOutOfRange);
  EXPECT_EQ(code_of(with_line("near", "near -1\n")), ErrorCode::kOutOfRange);
}

}  // namespace
}  // namespace halfspace
