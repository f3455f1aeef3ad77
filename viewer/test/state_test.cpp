#include "halfspace/viewer/state.hpp"

#include <gtest/gtest.h>

namespace halfspace::viewer {
namespace {

State some_state() {
  State state;
  state.parts = {{"a part.stl", true, Rgb{1, 2, 255}, {0.1, -2, 1e-7}},
                 {"b.off", false, std::nullopt, {}}};
  state.combination = Combination::kDifference;
  state.sections = {{{1, 0, -0.5}, 0.1, true}, {{0, 0, 1}, -3, false}};
  state.looks = {true, true, {3, 4, 5}, {{1, 2, 3.5}}};
  state.looks.scalar = ScalarLook{"heat", "turbo", {{0.1, 3}}, true, 8, false};
  state.looks.alpha = 90;
  state.looks.ambient = 0.125;
  state.looks.coloring = Coloring::kFaces;
  state.looks.lines = Lines::kWire;
  state.looks.back_color = Rgb{7, 0, 255};
  io::ViewOptions camera;
  camera.eye = {1.0 / 3, -2e-300, 5e300};
  camera.near = 0.25;
  camera.orthographic = true;
  camera.width_px = 333;
  state.camera = camera;
  return state;
}

TEST(State, TextGivesBackEveryNumber) {
  const State state = some_state();
  const auto read = parse_state(to_text(state));
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->parts, state.parts);
  EXPECT_EQ(read->combination, state.combination);
  EXPECT_EQ(read->sections, state.sections);
  EXPECT_EQ(read->looks, state.looks);
  EXPECT_TRUE(is_same(*read->camera, *state.camera));
}

TEST(State, PathsAreTakenFromTheFolderOfTheFile) {
  State state;
  state.parts = {{"part.off", true, std::nullopt, {}},
                 {"/abs.off", true, std::nullopt, {}}};
  const auto read = parse_state(to_text(state), "/some/folder");
  ASSERT_TRUE(read);
  EXPECT_EQ(read->parts[0].path, "/some/folder/part.off");
  EXPECT_EQ(read->parts[1].path, "/abs.off");
}

TEST(State, FaultsNameTheEntry) {
  const struct {
    const char* text;
    const char* part;
  } kFaults[] = {
      {"", "JSON"},
      {"[]", "view is no object"},
      {"{}", "view.parts"},
      {R"({"parts": [3]})", "parts[0] is no object"},
      {R"({"parts": [{"file": 1}]})", "parts[0].file"},
      {R"({"parts": [], "background": "blue"})", "background"},
      {R"({"parts": [], "light": [0, 0, 0]})", "light"},
      {R"({"parts": [], "alpha": 256})", "alpha must be a whole number"},
      {R"({"parts": [], "alpha": 0.5})", "alpha must be a whole number"},
      {R"({"parts": [], "ambient": 2})", "ambient must be from 0 to 1"},
      {R"({"parts": [], "lines": "all"})", "lines must be one of none"},
      {R"({"parts": [], "coloring": 3})", "coloring must be a text"},
      {R"({"parts": [], "back_color": "red"})", "back_color must be a colour"},
      {R"({"parts": [], "combination": "sum"})", "one of none, union"},
      {R"({"parts": [], "sections": [{"normal": [0, 0, 0]}]})",
       "sections[0].normal"},
      {R"({"parts": [], "sections": 3})", "view.sections"},
      {R"({"parts": [], "camera": {"eye": [1, 2]}})", "camera.eye"},
      {R"({"parts": [], "camera": {"eye": [1,2,3], "target": [0,0,0],
          "up": [0,0,1], "fov": 180, "size": [3, 4]}})",
       "camera.fov"},
      {R"({"parts": [], "camera": {"eye": [1,2,3], "target": [0,0,0],
          "up": [0,0,1], "size": [0, 4]}})",
       "camera.size"}};
  for (const auto& [text, part] : kFaults) {
    const auto read = parse_state(text);
    ASSERT_FALSE(read) << text;
    EXPECT_NE(read.error().message.find(part), std::string::npos)
        << read.error().message;
  }
}

TEST(State, CamerasDoNotChangeTheScene) {
  State other = some_state();
  other.camera->eye.x += 1;
  other.looks.background = {9, 9, 9};
  EXPECT_TRUE(have_same_scene(some_state(), other));
  other.parts[1].is_visible = true;
  EXPECT_FALSE(have_same_scene(some_state(), other));
}

}  // namespace
}  // namespace halfspace::viewer
