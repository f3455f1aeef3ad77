#pragma once

#include <SDL.h>

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/background.hpp"
#include "core/script.hpp"
#include "core/session.hpp"

namespace halfspace::viewer {

/// The mark of back sides, where none is chosen.
constexpr Rgb kBackColor = {226, 88, 62};

/// A rectangle of the window. Units: pixels of the renderer.
struct Area {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
  bool holds(int px, int py) const {
    return px >= x && py >= y && px < x + width && py < y + height;
  }
};

/// A way of the camera that takes a moment.
struct CameraFlight {
  io::ViewOptions from;
  io::ViewOptions to;
  double start_ms = 0;
};

/// A question for a file's name.
enum class FileQuestion : std::uint8_t {
  kNone,
  kOpen,
  kAdd,
  kSavePicture,
  kSaveView,
  kExport,  ///< the solid
  kSaveFilm,
};

/// What the window shows beside the picture.
struct Ui {
  Area view;
  double scale = 1;
  bool has_panel = true;
  bool has_help = false;
  bool has_axes = true;
  bool has_grid = false;
  bool has_frame_rate = false;
  bool has_name = false;
  bool is_fullscreen = false;
  bool is_trackball = false;
  bool measures = false;
  bool wants_to_quit = false;
  bool has_popup = false;      ///< a list to choose from is open
  bool closes_popups = false;  ///< in the next frame
  bool animates = true;        ///< not while events are played
  std::optional<CameraFlight> flight;
  std::vector<PickedPoint> points;    ///< that were clicked, the last one last
  std::optional<glm::ivec2> hovered;  ///< pixel of the view
  FileQuestion question = FileQuestion::kNone;
  int film_frames = 36;
  bool has_headlight = false;  ///< the light follows the eye
  std::string note;            ///< of what was done last, for the status line
  std::vector<std::string> recent;
  /// Draws a figure of a `.view` file, as `halfspace draw` does.
  std::function<Result<Done>(const std::string& view_file,
                             const std::string& output)>
      draw_figure;
  std::string measures_text;  ///< of the solid, a line each
};

/// Work beside the pictures. What is saved does not wait for solids, which are
/// measured and exported.
struct Jobs {
  explicit Jobs(const std::function<void()>& wake)
      : saving(wake), solids(wake) {}
  bool are_busy() const { return saving.is_busy() || solids.is_busy(); }

  Background saving;
  Background solids;
};

/// Panels, the status line and questions, by ImGui.
void draw_panels(Session& session, Jobs& jobs, Ui& ui);

/// The question for a file's name, if one is asked, and what follows from it.
void draw_file_question(Session& session, Jobs& jobs, Ui& ui);

/// What is drawn over the picture: axes, measures, progress, messages.
void draw_overlay(Session& session, Jobs& jobs, Ui& ui);

/// The circle of the axes, in which a drag turns freely. Units: pixels.
struct AxesPlace {
  float x = 0;
  float y = 0;
  float radius = 0;
};
AxesPlace axes_place(const Ui& ui);

/// Moves the camera there, in a moment if it animates.
void fly_to(Session& session, Ui& ui, const io::ViewOptions& camera);
/// The camera stays where it is now.
void stop_flight(Session& session, Ui& ui);

/// A key and what it does.
struct KeyAction {
  const char* keys;  ///< as people read them
  const char* deed;  ///< empty: the help names it with another one
  SDL_Keycode key;
  Modifiers modifiers;
  void (*act)(Session& session, Ui& ui);
};

/// All keys, in the order of the help.
const std::vector<KeyAction>& key_actions();

/// Does what the key is for; whether it is for anything.
bool act_on_key(SDL_Keycode key, const Modifiers& modifiers, Session& session,
                Ui& ui);

/// Colours the file by the next of its numbers, and after the last by none.
void show_next_numbers(Session& session);

/// Copies the command that makes the picture; where options do not say all of
/// the state, it is saved first.
void copy_command(Session& session, Ui& ui);

/// The name of what is shown, for titles and names of files.
std::string name_of(const State& state);

}  // namespace halfspace::viewer
