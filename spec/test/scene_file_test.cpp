#include "halfspace/scene_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "halfspace/cap_parts.hpp"

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

TEST(SceneFile, SaysWhatIsWrongInASentence) {
  const auto message_of = [](const std::string& text) {
    const Result<SceneFile> file = read_scene(text);
    return file ? std::string("fine") : file.error().message;
  };
  const struct {
    const char* start;
    const char* line;
    const char* message;
  } cases[] = {
      {"unit", "unit 1 0\n", "line 2: '1' is not from 2 to 10"},
      {"unit", "unit 3 0\n", "line 2: the base of a unit is 2 or 10, not '3'"},
      {"unit", "unit 2 -4097\n", "line 2: '-4097' is not from -4096 to 4096"},
      {"unit", "unit 2 4097\n", "line 2: '4097' is not from -4096 to 4096"},
      {"unit", "unit ten 0\n", "line 2: 'ten' is not an integer"},
      {"unit", "unit 10 ~\x7f\x1f \n", "line 2: '~\?\?' is not an integer"},
      {"unit", "unit 10 \x80\xff!\n", "line 2: '\?\?!' is not an integer"},
      {"unit", "unit 10 0123456789012345678901234567890123456789\n",
       "line 2: '0123456789012345678901234567890123456789' is not from -4096 "
       "to 4096"},
      {"unit", "unit 10 01234567890123456789012345678901234567890\n",
       "line 2: '0123456789012345678901234567890123456789...' is not from "
       "-4096 to 4096"},
      {"unit", "unit 10\n", "line 2: 'unit' is followed by 2 values, not 1"},
      {"unit", "units 10 0\n", "line 2: there should be 'unit', not 'units'"},
      {"grid", "grid 25\n", "line 3: '25' is not from 26 to 54"},
      {"grid", "grid 55\n", "line 3: '55' is not from 26 to 54"},
      {"grid", "grid 41\n", "line 3: a grid has 26, 40 or 54 bits, not '41'"},
      {"v", "v 0 -33554433 0\n",
       "line 4: '-33554433' is not from -33554432 to 33554431"},
      {"v", "v 0 0 33554432\n",
       "line 4: '33554432' is not from -33554432 to 33554431"},
      {"v", "v 0 0\n", "line 4: 'v' is followed by 3 values, not 2"},
      {"p", "p 0 1 3 color 0 0 0\n",
       "line 7: there is no vertex '3' above, only 3 vertices"},
      {"p", "p 0 1 2\n", "line 7: the polygon has no 'color'"},
      {"p", "p 0 1 2 color 0 0\n", "line 7: a colour has three values"},
      {"p", "p 0 1 2 color -1 0 0\n", "line 7: '-1' is not from 0 to 255"},
      {"p", "p 0 1 2 color 0 256 0\n", "line 7: '256' is not from 0 to 255"},
      {"p", "p 0 1 2 color 0 0 256\n", "line 7: '256' is not from 0 to 255"},
      {"p", "p 0 1 2 color 256 0 0\n", "line 7: '256' is not from 0 to 255"},
      {"p", "p 0 1 a color 0 0 0\n",
       "line 7: 'a' is not a vertex, nor 'color'"},
      {"p", "p 0 1 2 color 0 0 0 colors 1 2 3\n",
       "line 7: after its colour a polygon of 3 corners has nothing, or "
       "'colors' and 9 values"},
      {"p", "p 0 1 2 color 0 0 0 colours 1 2 3 4 5 6 7 8 9\n",
       "line 7: after its colour a polygon of 3 corners has nothing, or "
       "'colors' and 9 values"},
      {"p", "p 0 1 2 color 0 0 0 colors 1 2 3 4 5 6 7 8 900\n",
       "line 7: '900' is not from 0 to 255"},
      {"p", "q\n", "line 7: 'q' is no keyword"},
      {"eye", "eye 0 0 1 -1\n", "line 8: '-1' is not from 0 to 1"},
      {"eye", "eye 0 0 1 2\n", "line 8: '2' is not from 0 to 1"},
      {"eye", "eye 0 0 1\n", "line 8: 'eye' is followed by 4 values, not 3"},
      {"eye", "eye 0 0 1329227995784915872903807060280344577 1\n",
       "line 8: '1329227995784915872903807060280344577' is not from "
       "-1329227995784915872903807060280344576 to "
       "1329227995784915872903807060280344576"},
      {"s0", "s0 0 0 549755813889\n",
       "the camera's s0 has a component beyond 549755813888"},
      {"sx", "sx 0 0\n", "line 10: 'sx' is followed by 3 values, not 2"},
      {"sy", "sy 0 0 0 0\n", "line 11: 'sy' is followed by 3 values, not 4"},
      {"near", "near\n", "line 12: 'near' is followed by 1 value, not 0"},
      {"near", "near 4611686018427387905\n",
       "line 12: '4611686018427387905' is not from -4611686018427387904 to "
       "4611686018427387904"},
      {"size", "size 64\n", "line 13: 'size' is followed by 2 values, not 1"},
      {"size", "size 0 1\n", "line 13: '0' is not from 1 to 65536"},
      {"size", "size 1 0\n", "line 13: '0' is not from 1 to 65536"},
      {"size", "size 65537 1\n", "line 13: '65537' is not from 1 to 65536"},
      {"size", "", "line 16: the camera has no 'size' line"},
      {"eye", "", "line 16: the camera has no 'eye' line"},
      {"cull", "cull 1\n", "line 14: 'cull' is followed by 0 values, not 1"},
      {"shade", "shade\n", "line 15: 'shade' is followed by 1 value, not 0"},
      {"shade", "shade phong\n",
       "line 15: shading is 'flat' or 'gouraud', not 'phong'"},
      {"background", "background 1 2\n",
       "line 16: 'background' is followed by 3 values, not 2"},
      {"end", "end 1\n", "line 17: 'end' is followed by 0 values, not 1"},
      {"end", "end\n# a comment\nv 0 0 0\n",
       "line 19: there is more after 'end'"},
      {"end", "", "line 17: the file ends without 'end'"},
      {"end", "# nothing\n\n", "line 19: the file ends without 'end'"},
      {"end", "en", "line 17: 'en' is no keyword, where the file ends"},
  };
  for (const auto& [start, line, message] : cases) {
    EXPECT_EQ(message_of(with_line(start, line)), message) << line;
  }
  EXPECT_EQ(message_of(""),
            "line 1: the file ends where its 'halfspace-scene' line should be");
  EXPECT_EQ(message_of("halfspace-scene 1\n"),
            "line 2: the file ends where its 'unit' line should be");
  EXPECT_EQ(message_of("halfspace-scene 2\n"),
            "line 1: version '2' is not known");
  EXPECT_EQ(message_of("halfspace-scene 1\nunit 2 0\n"),
            "line 3: the file ends where its 'grid' line should be");
  // Whether 'end' has its line feed does not matter.
  std::string cut = with_line("size", "");
  cut.pop_back();
  EXPECT_EQ(message_of(cut), "line 16: the camera has no 'size' line");
  // Without vertices, and with a second line of what there is once.
  EXPECT_EQ(message_of("halfspace-scene 1\nunit 2 0\ngrid 26\np 0\nend\n"),
            "line 4: there is no vertex '0' above, only 0 vertices");
  const std::string header = "halfspace-scene 1\nunit 2 0\ngrid 26\n";
  for (const std::string keyword : {"halfspace-scene", "unit", "grid"}) {
    EXPECT_EQ(message_of(header + keyword + " 1\nend\n"),
              "line 4: there is a second '" + keyword + "' line");
  }
  for (const std::string keyword : {"eye", "s0", "sx", "sy", "near", "size",
                                    "cull", "shade", "background"}) {
    const std::size_t at = kExample.find("\n" + keyword) + 1;
    const std::string line =
        kExample.substr(at, kExample.find('\n', at) + 1 - at);
    const auto number =
        2 + std::count(kExample.begin(),
                       kExample.begin() + static_cast<std::ptrdiff_t>(at),
                       '\n');
    EXPECT_EQ(message_of(with_line(keyword, line + line)),
              "line " + std::to_string(number) + ": there is a second '" +
                  keyword + "' line");
  }
}

TEST(SceneFile, HoldsNumbersAtTheirLimits) {
  const Result<SceneFile> file = read_scene(
      "halfspace-scene 1\nunit 10 4096\ngrid 26\n"
      "v -33554432 33554431 -33554432\nv 33554431 -33554432 33554431\n"
      "v +0 -0 00\n"
      "p 0 1 2 color 255 0 255 colors 0 255 0 255 0 255 1 1 1\n"
      "eye 549755813888 -549755813888 1 1\n"
      "s0 0 0 0\nsx 1 0 0\nsy 0 1 0\nnear 4294967296\nsize 1 65536\n"
      "shade flat\nend\n");
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_EQ(file->scene.unit(), (Unit{10, 4096}));
  EXPECT_EQ(file->scene.point(0), (GridPoint{-33554432, 33554431, -33554432}));
  EXPECT_EQ(file->scene.color(0), (Rgb{255, 0, 255}));
  EXPECT_EQ(file->scene.corner_colors(0)[0], (Rgb{0, 255, 0}));
  EXPECT_EQ(file->camera->data().near, std::int64_t{1} << 32);
  EXPECT_EQ(file->camera->data().width_px, 1);
  EXPECT_EQ(file->camera->data().height_px, 65536);
  EXPECT_EQ(file->options,
            (ImageOptions{false, Shading::kFlat, {255, 255, 255}}));
  EXPECT_FALSE(
      read_scene("halfspace-scene 1\nunit 2 0\ngrid 26\nend\n")->camera);
  EXPECT_FALSE(
      read_scene("halfspace-scene 1\nunit 2 0\ngrid 26\nnear 1\nend\n"));
}

/// Two tetrahedra, whose corners are 0 to 3 and 4 to 7, with these lines.
std::string two_parts(const std::string& lines) {
  std::string text = "halfspace-scene 1\nunit 10 0\ngrid 26\n";
  for (const int at : {0, 9}) {
    const std::string x = std::to_string(at);
    text += "v " + x + " 0 0\nv " + std::to_string(at + 4) + " 0 0\nv " + x +
            " 4 0\nv " + x + " 0 4\n";
  }
  for (const int first : {0, 4}) {
    for (const auto& [a, b, c] :
         {std::array{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}) {
      text += "p " + std::to_string(first + a) + " " +
              std::to_string(first + b) + " " + std::to_string(first + c) +
              " color 1 2 3\n";
    }
  }
  return text + lines + "end\n";
}

TEST(SceneFile, SaysOfWhatPartsAClosedSceneIs) {
  const std::string caps = "caps 9 9 9\n";
  const std::string looks =
      caps + "cap 1 1 1\ncap 2 2 2 hatch 3 3 3\ncap 4 4 4\n";
  const auto file = read_scene(two_parts(looks + "part 1 4 4\n"));
  ASSERT_TRUE(file) << file.error().message;
  const CapParts& parts = *file->options.parts;
  EXPECT_EQ(parts.part_of,
            (std::vector<std::uint32_t>{0, 0, 0, 0, 1, 1, 1, 1}));
  EXPECT_EQ(parts.part_of, connected_parts(file->scene));
  ASSERT_EQ(parts.count(), 2u);
  EXPECT_EQ(parts.styles[1], (CapStyle{{2, 2, 2}, Rgb{3, 3, 3}}));
  EXPECT_EQ(parts.styles[2], (CapStyle{{4, 4, 4}, std::nullopt}));
  const auto again = read_scene(write_scene(*file));
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(*again, *file);
  SceneFile other = *file;
  other.options.parts = told_apart(parts.part_of, {});
  EXPECT_NE(other, *file);
  // Without polygons there are no parts, and one look.
  const auto empty = read_scene("halfspace-scene 1\nunit 2 0\ngrid 26\n" +
                                caps + "cap 4 4 4\nend\n");
  ASSERT_TRUE(empty) << empty.error().message;
  EXPECT_EQ(empty->options.parts->count(), 0u);
  EXPECT_EQ(*read_scene(write_scene(*empty)), *empty);

  const auto code = [](const std::string& lines) {
    return code_of(two_parts(lines));
  };
  EXPECT_EQ(code("part 0 0 8\n"), ErrorCode::kSyntax);
  EXPECT_EQ(code("cap 1 1 1\ncap 2 2 2\n"), ErrorCode::kSyntax);
  EXPECT_EQ(code(caps + "cap 1 1 1\n"), ErrorCode::kSyntax);
  EXPECT_EQ(code(looks + "cap 1 1\n"), ErrorCode::kSyntax);
  EXPECT_EQ(code(looks + "part 2 0 4\n"), ErrorCode::kBadIndex);
  EXPECT_EQ(code(looks + "part 1 4 5\n"), ErrorCode::kBadIndex);
  EXPECT_EQ(code(looks + "part 1 2147483647 2147483647\n"),
            ErrorCode::kBadIndex);
  EXPECT_EQ(code(looks + "part -1 0 4\n"), ErrorCode::kOutOfRange);
  // Half of a tetrahedron is not closed.
  EXPECT_EQ(code(looks + "part 1 2 4\n"), ErrorCode::kOpen);
}

}  // namespace
}  // namespace halfspace
