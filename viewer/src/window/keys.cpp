#include <SDL.h>
#include <fmt/format.h>

#include <filesystem>

#include "core/command_line.hpp"
#include "core/measure.hpp"
#include "core/moves.hpp"
#include "window/ui.hpp"

namespace halfspace::viewer {
namespace {

constexpr double kTurnDeg = 7.5;

constexpr io::ViewDirection kFront = {{0, -1, 0}, {0, 0, 1}};
constexpr io::ViewDirection kBack = {{0, 1, 0}, {0, 0, 1}};
constexpr io::ViewDirection kLeft = {{-1, 0, 0}, {0, 0, 1}};
constexpr io::ViewDirection kRight = {{1, 0, 0}, {0, 0, 1}};
constexpr io::ViewDirection kTop = {{0, 0, 1}, {0, 1, 0}};
constexpr io::ViewDirection kBottom = {{0, 0, -1}, {0, -1, 0}};

template <const io::ViewDirection& side>
void see(Session& session, Ui&) {
  session.seek_side(side);
}

void see_iso(Session& session, Ui&) { session.seek_side(io::ViewDirection()); }

template <int x, int y>
void turn(Session& session, Ui& ui) {
  if (!session.camera()) return;
  const double px = session.camera()->height_px * kTurnDeg / 180;
  stop_flight(session, ui);
  session.set_camera(orbited(*session.camera(), {x * px, y * px}));
}

template <int x, int y>
void pan(Session& session, Ui& ui) {
  if (!session.camera()) return;
  const double px = session.camera()->height_px / 20.0;
  stop_flight(session, ui);
  session.set_camera(panned(*session.camera(), {x * px, y * px}));
}

template <int notches>
void zoom(Session& session, Ui& ui) {
  if (!session.camera()) return;
  stop_flight(session, ui);
  const io::ViewOptions& camera = *session.camera();
  session.set_camera(zoomed(camera, notches > 0 ? 0.8 : 1.25,
                            {camera.width_px / 2.0, camera.height_px / 2.0}));
}

void change_projection(Session& session, Ui& ui) {
  if (!session.camera()) return;
  stop_flight(session, ui);
  session.set_camera(
      with_projection(*session.camera(), !session.camera()->orthographic));
}

/// Shows one part alone, the one after or before that which is alone now.
template <int step>
void show_next_part(Session& session, Ui&) {
  session.change([](State& state) {
    const auto count = static_cast<int>(state.parts.size());
    if (count < 2) return;
    int shown = 0, last = 0;
    for (int i = 0; i < count; ++i) {
      if (!state.parts[static_cast<std::size_t>(i)].is_visible) continue;
      ++shown;
      last = i;
    }
    const int from = shown == 1 ? last : step > 0 ? -1 : 0;
    const int next = (from + step + count) % count;
    for (int i = 0; i < count; ++i)
      state.parts[static_cast<std::size_t>(i)].is_visible = i == next;
  });
}

void show_all_parts(Session& session, Ui&) {
  session.change([](State& state) {
    for (Part& part : state.parts) part.is_visible = true;
  });
}

void toggle_section(Session& session, Ui&) {
  if (!session.model()) return;
  const auto [low, high] = session.model()->extent_along({1, 0, 0});
  session.change([low = low, high = high](State& state) {
    if (state.sections.empty())
      state.sections.push_back({{1, 0, 0}, six_digits((low + high) / 2), true});
    else
      state.sections[0].is_on = !state.sections[0].is_on;
  });
}

/// Moves the first plane by a thirtieth of what it cuts.
template <int steps>
void move_section(Session& session, Ui&) {
  if (!session.model() || session.state().sections.empty()) return;
  const Section& section = session.state().sections[0];
  const auto& [x, y, z] = section.normal;
  const auto [low, high] = session.model()->extent_along({x, y, z});
  const double by = (high - low) / 30;
  session.change(
      [by](State& state) {
        double& offset = state.sections[0].offset;
        offset = six_digits(offset + steps * by);
      },
      1);
}

void reset(Session& session, Ui&) { session.seek_first(); }

void fit(Session& session, Ui&) { session.seek_fit(); }

template <bool Ui::*what>
void toggle(Session&, Ui& ui) {
  ui.*what = !(ui.*what);
}

template <FileQuestion question>
void ask(Session&, Ui& ui) {
  ui.question = question;
}

/// Lines of a kind, or none where they are there.
template <Lines lines>
void toggle_lines(Session& session, Ui&) {
  session.change([](State& state) {
    Lines& now = state.looks.lines;
    now = now == lines ? Lines::kNone : lines;
  });
}

void toggle_back_color(Session& session, Ui&) {
  session.change([](State& state) {
    auto& mark = state.looks.back_color;
    mark = mark ? std::nullopt : std::optional(kBackColor);
  });
}

void show_next_coloring(Session& session, Ui&) {
  session.change([](State& state) {
    Coloring& now = state.looks.coloring;
    now = now == Coloring::kFile    ? Coloring::kParts
          : now == Coloring::kParts ? Coloring::kFaces
                                    : Coloring::kFile;
  });
}

void toggle_legend(Session& session, Ui&) {
  session.change([](State& state) {
    auto& scalar = state.looks.scalar;
    if (scalar) scalar->has_legend = !scalar->has_legend;
  });
}

void escape(Session& session, Ui& ui) {
  if (ui.has_popup) {
    ui.closes_popups = true;
  } else if (ui.has_help) {
    ui.has_help = false;
  } else if (ui.question != FileQuestion::kNone) {
    ui.question = FileQuestion::kNone;
  } else if (!session.message().empty()) {
    session.say("");
  } else if (!ui.points.empty()) {
    ui.points.clear();
  } else if (ui.is_fullscreen) {
    ui.is_fullscreen = false;
  }
}

std::vector<KeyAction> made_actions() {
  constexpr Modifiers kPlain{};
  constexpr Modifiers kControl{.control = true};
  constexpr Modifiers kShift{.shift = true};
  constexpr Modifiers kBoth{.shift = true, .control = true};
  return {
      {"1, Shift+1", "Front, back view", SDLK_1, kPlain, see<kFront>},
      {"Shift+1", "", SDLK_1, kShift, see<kBack>},
      {"3, Shift+3", "Right, left view", SDLK_3, kPlain, see<kRight>},
      {"Shift+3", "", SDLK_3, kShift, see<kLeft>},
      {"7, Shift+7", "Top, bottom view", SDLK_7, kPlain, see<kTop>},
      {"Shift+7", "", SDLK_7, kShift, see<kBottom>},
      {"9", "Corner view", SDLK_9, kPlain, see_iso},
      {"5", "Parallel rays or not", SDLK_5, kPlain, change_projection},
      {"Space", "Fit all into the picture", SDLK_SPACE, kPlain, fit},
      {"Enter", "The first view again", SDLK_RETURN, kPlain, reset},
      {"Shift+arrows", "Turn", SDLK_LEFT, kShift, turn<-1, 0>},
      {"Shift+Right", "", SDLK_RIGHT, kShift, turn<1, 0>},
      {"Shift+Up", "", SDLK_UP, kShift, turn<0, -1>},
      {"Shift+Down", "", SDLK_DOWN, kShift, turn<0, 1>},
      {"Ctrl+arrows", "Pan", SDLK_LEFT, kControl, pan<-1, 0>},
      {"Ctrl+Right", "", SDLK_RIGHT, kControl, pan<1, 0>},
      {"Ctrl+Up", "", SDLK_UP, kControl, pan<0, -1>},
      {"Ctrl+Down", "", SDLK_DOWN, kControl, pan<0, 1>},
      {"+ -", "Zoom", SDLK_PLUS, kPlain, zoom<1>},
      {"=", "", SDLK_EQUALS, kPlain, zoom<1>},
      {"-", "", SDLK_MINUS, kPlain, zoom<-1>},
      {"Left, Right", "One file after another", SDLK_LEFT, kPlain,
       show_next_part<-1>},
      {"Right", "", SDLK_RIGHT, kPlain, show_next_part<1>},
      {"A", "All files", SDLK_a, kPlain, show_all_parts},
      {"Up", "Read the files again", SDLK_UP, kPlain,
       [](Session& session, Ui&) { session.reload(); }},
      {"D", "Smooth or flat shading", SDLK_d, kPlain,
       [](Session& session, Ui&) {
         session.change([](State& state) {
           state.looks.is_smooth = !state.looks.is_smooth;
         });
       }},
      {"K", "Leave out back sides", SDLK_k, kPlain,
       [](Session& session, Ui&) {
         session.change(
             [](State& state) { state.looks.cull = !state.looks.cull; });
       }},
      {"Shift+K", "Mark back sides", SDLK_k, kShift, toggle_back_color},
      {"E", "Edges", SDLK_e, kPlain, toggle_lines<Lines::kFeatures>},
      {"W", "All edges: a wire frame", SDLK_w, kPlain,
       toggle_lines<Lines::kWire>},
      {"C", "Colours of files, parts, faces", SDLK_c, kPlain,
       show_next_coloring},
      {"S", "Colours by the next numbers", SDLK_s, kPlain,
       [](Session& session, Ui&) { show_next_numbers(session); }},
      {"B", "Legend of numbers", SDLK_b, kPlain, toggle_legend},
      {"L", "Light from the eye", SDLK_l, kPlain, toggle<&Ui::has_headlight>},
      {"V", "Cut by a plane, or not", SDLK_v, kPlain, toggle_section},
      {", .", "Move the cut back, on", SDLK_COMMA, kPlain, move_section<-1>},
      {".", "", SDLK_PERIOD, kPlain, move_section<1>},
      {"Tab", "Measure: click on points", SDLK_TAB, kPlain,
       toggle<&Ui::measures>},
      {"O", "Turntable or free turning", SDLK_o, kPlain,
       toggle<&Ui::is_trackball>},
      {"X", "Axes", SDLK_x, kPlain, toggle<&Ui::has_axes>},
      {"G", "Grid below the model", SDLK_g, kPlain, toggle<&Ui::has_grid>},
      {"N", "Name", SDLK_n, kPlain, toggle<&Ui::has_name>},
      {"Z", "Frames a second", SDLK_z, kPlain, toggle<&Ui::has_frame_rate>},
      {"P", "Panel", SDLK_p, kPlain, toggle<&Ui::has_panel>},
      {"F", "Full screen", SDLK_f, kPlain, toggle<&Ui::is_fullscreen>},
      {"H", "These keys", SDLK_h, kPlain, toggle<&Ui::has_help>},
      {"?", "", SDLK_QUESTION, kShift, toggle<&Ui::has_help>},
      {"/", "", SDLK_SLASH, kShift, toggle<&Ui::has_help>},
      {"Ctrl+O", "Open files", SDLK_o, kControl, ask<FileQuestion::kOpen>},
      {"Ctrl+S", "Save the picture", SDLK_s, kControl,
       ask<FileQuestion::kSavePicture>},
      {"Ctrl+Shift+S", "Save the view", SDLK_s, kBoth,
       ask<FileQuestion::kSaveView>},
      {"Ctrl+T", "Save the film of a turn", SDLK_t, kControl,
       ask<FileQuestion::kSaveFilm>},
      {"Ctrl+E", "Export the solid", SDLK_e, kControl,
       ask<FileQuestion::kExport>},
      {"Ctrl+C", "Copy as command line", SDLK_c, kControl, copy_command},
      {"Ctrl+Z, Ctrl+Y", "Undo, redo", SDLK_z, kControl,
       [](Session& session, Ui&) { session.undo(); }},
      {"Ctrl+Y", "", SDLK_y, kControl,
       [](Session& session, Ui&) { session.redo(); }},
      {"Escape", "Close, forget", SDLK_ESCAPE, kPlain, escape},
      {"Ctrl+Q", "Quit", SDLK_q, kControl, toggle<&Ui::wants_to_quit>},
  };
}

}  // namespace

const std::vector<KeyAction>& key_actions() {
  static const std::vector<KeyAction> actions = made_actions();
  return actions;
}

bool act_on_key(SDL_Keycode key, const Modifiers& modifiers, Session& session,
                Ui& ui) {
  if (key == SDLK_KP_PLUS) key = SDLK_PLUS;
  if (key == SDLK_KP_MINUS) key = SDLK_MINUS;
  if (key == SDLK_KP_ENTER) key = SDLK_RETURN;
  if (key >= SDLK_KP_1 && key <= SDLK_KP_9) key = SDLK_1 + (key - SDLK_KP_1);
  for (const KeyAction& action : key_actions()) {
    // A plus is typed with Shift on many keyboards.
    const bool is_held = action.modifiers == modifiers ||
                         (key == SDLK_PLUS && !modifiers.control);
    if (action.key != key || !is_held) continue;
    action.act(session, ui);
    return true;
  }
  return false;
}

void fly_to(Session& session, Ui& ui, const io::ViewOptions& camera) {
  if (!session.camera()) return;
  if (!ui.animates) {
    session.set_camera(camera);
    return;
  }
  ui.flight = CameraFlight{*session.camera(), camera,
                           static_cast<double>(SDL_GetTicks64())};
}

void stop_flight(Session& session, Ui& ui) {
  ui.flight.reset();
  session.stop_seeking();
}

std::string name_of(const State& state) {
  std::string first;
  std::size_t shown = 0;
  for (const Part& part : state.parts) {
    if (!part.is_visible) continue;
    if (++shown == 1)
      first = std::filesystem::path(part.path).filename().string();
  }
  if (shown < 2) return first;
  return first + fmt::format(" and {} more", shown - 1);
}

void copy_command(Session& session, Ui& ui) {
  const State& state = session.state();
  if (!state.camera) return;
  const std::string stem =
      std::filesystem::path(name_of(state)).stem().string();
  const std::string view_file = stem + ".view";
  if (!fits_command_line(state)) {
    const auto written = write_state(view_file, state);
    if (!written) {
      session.say(written.error().message);
      return;
    }
  }
  const std::string command = render_command(state, stem + ".png", view_file);
  SDL_SetClipboardText(command.c_str());
  ui.note = "Copied: " + command;
}

}  // namespace halfspace::viewer
