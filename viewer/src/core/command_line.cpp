#include "core/command_line.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "halfspace/io/load_scene.hpp"
#include "halfspace/line_style.hpp"

namespace halfspace::viewer {
namespace {

std::string vector_text(double x, double y, double z) {
  return fmt::format("{},{},{}", x, y, z);
}

std::string vector_text(const glm::dvec3& v) {
  return vector_text(v.x, v.y, v.z);
}

std::string color_text(const Rgb& color) {
  return fmt::format("{},{},{}", color.r, color.g, color.b);
}

std::string camera_options(const io::ViewOptions& camera) {
  std::string text = fmt::format(
      " --size {}x{} --eye={} --target={} --up={} --fov {}", camera.width_px,
      camera.height_px, vector_text(camera.eye), vector_text(camera.target),
      vector_text(camera.up), camera.fov_deg);
  if (camera.orthographic)
    text += fmt::format(" --ortho --height {}", camera.ortho_height);
  if (camera.near) text += fmt::format(" --near={}", *camera.near);
  return text;
}

std::string scalar_options(const ScalarLook& look) {
  std::string text =
      " --scalar " + shell_word(look.source) + " --map " + shell_word(look.map);
  if (look.range)
    text += fmt::format(" --range={},{}", (*look.range)[0], (*look.range)[1]);
  if (look.is_logarithmic) text += " --log";
  if (look.steps > 0) text += fmt::format(" --steps {}", look.steps);
  if (look.has_legend) text += " --legend";
  return text;
}

/// What is drawn over the picture, or marked in it.
std::string mark_options(const State& state) {
  std::string text;
  if (const auto mark = back_color_of(state))
    text += " --back-color " + color_text(*mark);
  const Lines lines = state.looks.lines;
  if (lines == Lines::kNone) return text;
  text += lines == Lines::kOutline    ? " --lines outline"
          : lines == Lines::kFeatures ? " --lines features"
                                      : " --lines wire";
  const Rgb color = line_color_of(state);
  return color == LineStyle().color
             ? text
             : text + " --line-color " + color_text(color);
}

const Part* only_part(const State& state) {
  const Part* found = nullptr;
  for (const Part& part : state.parts) {
    if (!part.is_visible) continue;
    if (found != nullptr) return nullptr;
    found = &part;
  }
  return found;
}

}  // namespace

bool fits_command_line(const State& state) {
  const Part* part = only_part(state);
  if (part == nullptr || !state.camera ||
      state.combination != Combination::kNone || has_sections(state) ||
      part->shift != std::array<double, 3>{} ||
      (state.looks.coloring != Coloring::kFile && !state.looks.scalar) ||
      io::is_solid_name(part->path))
    return false;
  // A scene has colours and light of its own.
  const bool is_scene =
      part->path.ends_with(".scene") || part->path.ends_with(".scene.gz");
  return !is_scene ||
         (!part->color && !state.looks.light && !state.looks.ambient);
}

std::string shell_word(const std::string& text) {
  const auto is_plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
           (c >= '0' && c <= '9') ||
           std::string_view("_-./=,:+@%").find(c) != std::string_view::npos;
  };
  if (!text.empty() && text[0] != '-' &&
      std::all_of(text.begin(), text.end(), is_plain))
    return text;
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? "'\\''" : std::string(1, c);
  return quoted + "'";
}

std::string render_command(const State& state, const std::string& output,
                           const std::string& view_file) {
  std::string command = "halfspace render ";
  if (!fits_command_line(state)) {
    command += shell_word(view_file);
  } else {
    const Part& part = *only_part(state);
    // A name that begins with a dash would be an option.
    command +=
        shell_word(part.path.starts_with('-') ? "./" + part.path : part.path);
    command += camera_options(*state.camera);
    if (state.looks.is_smooth)
      command += " --shade gouraud";
    else
      command += " --shade flat";
    command += state.looks.cull ? " --cull" : " --no-cull";
    command += " --background " + color_text(state.looks.background);
    if (state.looks.alpha != kOpaque)
      command += fmt::format(" --alpha {}", state.looks.alpha);
    if (part.color) command += " --color " + color_text(*part.color);
    if (state.looks.light) {
      const auto& [x, y, z] = *state.looks.light;
      command += " --light=" + vector_text(x, y, z);
    }
    if (state.looks.ambient)
      command += fmt::format(" --ambient {}", *state.looks.ambient);
    command += mark_options(state);
  }
  if (fits_command_line(state) && state.looks.scalar)
    command += scalar_options(*state.looks.scalar);
  return command + " -o " + shell_word(output);
}

}  // namespace halfspace::viewer
