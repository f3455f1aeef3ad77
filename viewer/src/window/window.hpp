#pragma once

#include <SDL.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/background.hpp"
#include "core/script.hpp"
#include "core/session.hpp"
#include "halfspace/viewer/run.hpp"
#include "window/imgui_backend.hpp"
#include "window/player.hpp"
#include "window/ui.hpp"

namespace halfspace::viewer {

/// Width of the panel and height of the status line. Units: pixels.
int panel_px(double scale);
int status_px(double scale);

/// Time as it passes. Units: milliseconds.
double window_now_ms();
/// Time that the processor has spent on this thread. Units: milliseconds.
double window_work_ms();

/// The window: takes events to the session, and its pictures to the screen.
///
/// It draws when something has changed, and sleeps until then.
class Window {
 public:
  /// `player` gives the events to be played; null where a person does.
  Window(const WindowOptions& options, SDL_Window* window,
         SDL_Renderer* renderer, double scale, Player* player);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  Result<WindowReport> run();

 private:
  void wait();
  void handle(const SDL_Event& event);
  void handle_window(const SDL_WindowEvent& event);
  void press(int button, int x, int y);
  void release(int button, bool is_double);
  void move(int x, int y);
  void take_hold(int x, int y);
  void move_held(const glm::dvec2& drag);
  void wheel(const SDL_MouseWheelEvent& wheel);
  void key(const SDL_KeyboardEvent& key);
  void click(int x, int y, bool is_double);
  void pinch(const SDL_MultiGestureEvent& gesture);
  void drop();
  void ask_for_camera(const io::ViewOptions& camera);
  void note_request();
  void lay_out();
  void update();
  void fly();
  void follow_eye();
  void note_opened();
  void note_done(const Result<std::string>& result);
  void draw();
  bool take_rows();
  void paint(const SDL_Rect& region);
  void show_title();
  bool is_drawn_later() const;
  Result<Done> play();
  Result<Done> play_event(const Event& event);
  Result<Done> dump();
  Result<Done> shoot(const std::string& path);
  void record(const SDL_Event& event);
  Result<Done> write_recorded() const;
  WindowReport report() const;

  const WindowOptions& options_;
  SDL_Window* window_;
  SDL_Renderer* renderer_;
  std::uint32_t wake_event_;
  std::atomic<bool> is_woken_ = false;
  ImguiBackend imgui_;
  Ui ui_;
  Session session_;
  Jobs jobs_;
  Player* player_;
  SDL_Texture* texture_ = nullptr;
  int texture_width_ = 0, texture_height_ = 0;
  bool is_exposed_ = true;  ///< the screen has lost what was drawn
  bool is_kept_ = false;    ///< what is drawn stays until it is drawn over
  int redraws_ = 3;         ///< ImGui settles in a few
  // The button that moves the camera now, and where it was pressed.
  int button_ = 0;
  bool drags_axes_ = false;
  /// What is held by Alt and moves instead of the camera.
  struct Held {
    bool is_plane = false;             ///< else a part
    std::size_t index = 0;             ///< of the section or the part
    glm::dvec3 point{};                ///< that the cursor holds
    double offset = 0;                 ///< of the plane, when it was pressed
    std::array<double, 3> shift = {};  ///< of the part, likewise
  };
  std::optional<Held> grip_;
  unsigned grip_count_ = 0;
  std::optional<glm::dvec2> fingers_;  ///< their middle, while two are down
  int pressed_x_ = 0, pressed_y_ = 0, last_x_ = 0, last_y_ = 0;
  bool has_moved_ = false;
  bool is_hover_known_ = false;  ///< to the panels, of the cursor's place
  Modifiers held_;
  int played_x_ = 0, played_y_ = 0;
  std::vector<std::string> dropped_;
  bool is_fullscreen_ = false;
  std::string title_;
  std::string last_opened_;
  std::string recorded_;
  std::int64_t dump_count_ = 0;
  std::size_t event_count_ = 0;
  double longest_block_ms_ = 0;
  double longest_work_ms_ = 0;
  double first_draw_ms_ = -1;
  double asked_ms_ = 0;      ///< when rows came, or a picture was asked for
  double next_look_ms_ = 0;  ///< at files, where they are watched
};

}  // namespace halfspace::viewer
