#include "core/command_line.hpp"

#include <gtest/gtest.h>

namespace halfspace::viewer {
namespace {

State one_part() {
  State state;
  state.parts = {{"part.stl", true, std::nullopt, {}}};
  state.camera = io::ViewOptions();
  return state;
}

TEST(CommandLine, SaysEveryNumberOfTheState) {
  State state = one_part();
  state.camera->eye = {1.0 / 3, -2, 0};
  state.camera->orthographic = true;
  state.looks.light = {1, 2, -3};
  state.looks.alpha = 90;
  state.parts[0].color = Rgb{1, 2, 3};
  EXPECT_EQ(render_command(state, "out.png", ""),
            "halfspace render part.stl --size 640x480 "
            "--eye=0.3333333333333333,-2,0 --target=0,0,0 --up=0,0,1 --fov 40 "
            "--ortho --height 2 --shade flat --no-cull --background "
            "255,255,255 --alpha 90 --color 1,2,3 --light=1,2,-3 -o out.png");
  state = one_part();
  state.looks.background = {0, 0, 9};
  state.looks.ambient = 0.5;
  state.looks.back_color = Rgb{9, 8, 7};
  state.looks.lines = Lines::kWire;
  const std::string command = render_command(state, "out.png", "");
  EXPECT_TRUE(command.ends_with(
      " --background 0,0,9 --ambient 0.5 --back-color 9,8,7 --lines wire "
      "--line-color 235,238,242 -o out.png"))
      << command;
}

TEST(CommandLine, WhatOptionsDoNotSayIsInAView) {
  State state = one_part();
  EXPECT_TRUE(fits_command_line(state));
  state.parts.push_back({"b.stl", false, std::nullopt, {}});
  EXPECT_TRUE(fits_command_line(state)) << "a hidden part is not there";
  state.parts[1].is_visible = true;
  EXPECT_FALSE(fits_command_line(state));
  EXPECT_EQ(render_command(state, "out.png", "my view.view"),
            "halfspace render 'my view.view' -o out.png");
  state = one_part();
  state.parts[0].shift = {0, 0, 1};
  EXPECT_FALSE(fits_command_line(state));
  state = one_part();
  state.combination = Combination::kUnion;
  EXPECT_FALSE(fits_command_line(state));
  state = one_part();
  state.looks.coloring = Coloring::kFaces;
  EXPECT_FALSE(fits_command_line(state));
}

TEST(CommandLine, WordsAreQuotedForTheShell) {
  EXPECT_EQ(shell_word("a/b_c-1.stl"), "a/b_c-1.stl");
  EXPECT_EQ(shell_word("it's $HOME"), "'it'\\''s $HOME'");
  EXPECT_EQ(shell_word(""), "''");
  EXPECT_EQ(shell_word("-o"), "'-o'");
  State state = one_part();
  state.parts[0].path = "-strange.stl";
  EXPECT_TRUE(render_command(state, "o.png", "")
                  .starts_with("halfspace render ./-strange.stl "));
}

}  // namespace
}  // namespace halfspace::viewer
