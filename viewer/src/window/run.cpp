#include "halfspace/viewer/run.hpp"

#include <SDL.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "core/script.hpp"
#include "halfspace/io/file.hpp"
#include "halfspace/io/load_scene.hpp"
#include "window/window.hpp"

namespace halfspace::viewer {
namespace {

Error sdl_error(const char* what) {
  return {ErrorCode::kUnreadable,
          std::string(what) + ": " + SDL_GetError() +
              "; `halfspace render` makes pictures without a display"};
}

/// Whether SDL took windows that nobody sees, unasked, as no others are there.
bool is_unseen() {
  if (SDL_getenv("SDL_VIDEODRIVER") != nullptr) return false;
  const char* driver = SDL_GetCurrentVideoDriver();
  const std::string_view name = driver != nullptr ? driver : "";
  return name == "offscreen" || name == "dummy" || name == "evdev";
}

/// SDL while it lives.
struct Sdl {
  bool is_there = SDL_Init(SDL_INIT_VIDEO) == 0;
  ~Sdl() { SDL_Quit(); }
};

struct DestroyWindow {
  void operator()(SDL_Window* window) const { SDL_DestroyWindow(window); }
};
struct DestroyRenderer {
  void operator()(SDL_Renderer* renderer) const {
    SDL_DestroyRenderer(renderer);
  }
};

/// 1 for 96 dots an inch, in quarters; what displays say beyond is a mistake.
double scale_of_display() {
  float dots = 0;
  if (SDL_GetDisplayDPI(0, &dots, nullptr, nullptr) != 0) return 1;
  const double scale = std::round(4 * dots / 96) / 4;
  return scale >= 1.25 && scale <= 3 ? scale : 1;
}

/// Lets SDL draw without OpenGL where it can, unless the environment says
/// otherwise: where processors draw for OpenGL, a frame took three times as
/// long and the window came 240 ms later. Wayland has no other way to the
/// screen.
void avoid_opengl() {
  const char* driver = SDL_GetCurrentVideoDriver();
  if (driver == nullptr || std::string_view(driver) != "x11") return;
  SDL_SetHintWithPriority(SDL_HINT_RENDER_DRIVER, "software", SDL_HINT_DEFAULT);
  SDL_SetHintWithPriority(SDL_HINT_FRAMEBUFFER_ACCELERATION, "0",
                          SDL_HINT_DEFAULT);
}

Result<std::unique_ptr<Player>> player_of(const WindowOptions& options) {
  if (!options.play_file) return std::unique_ptr<Player>();
  const auto text = io::read_file(*options.play_file);
  if (!text) return text.error();
  auto events = parse_script(*text);
  if (!events) return io::error_about(*options.play_file, events.error());
  return std::make_unique<Player>(*std::move(events));
}

/// The size of a window whose view has so many pixels.
SDL_Point window_size(const WindowOptions& options, double scale) {
  SDL_Rect usable{0, 0, 1280, 800};
  SDL_GetDisplayUsableBounds(0, &usable);
  if (options.picture_px) {
    return {(*options.picture_px)[0] + panel_px(scale),
            (*options.picture_px)[1] + status_px(scale)};
  }
  return {std::min(static_cast<int>(1280 * scale), usable.w),
          std::min(static_cast<int>(800 * scale), usable.h)};
}

void set_icon(SDL_Window* window) {
  // A cube from its corner: three faces about the middle.
  constexpr int kSize = 64;
  static std::uint32_t pixels[kSize * kSize];
  for (int j = 0; j < kSize; ++j) {
    for (int i = 0; i < kSize; ++i) {
      const double x = (i - 31.5) / 30, y = (j - 31.5) / 30;
      const double slope = 0.57735 * std::abs(x);
      const bool is_in = std::abs(x) <= 0.866 && std::abs(y) <= 1 - slope;
      std::uint32_t color = 0;
      if (is_in)
        color = y < -slope ? 0xffb9d7f2u : x < 0 ? 0xff5a9bd4u : 0xff2f6ba8u;
      pixels[j * kSize + i] = color;
    }
  }
  SDL_Surface* icon = SDL_CreateRGBSurfaceWithFormatFrom(
      pixels, kSize, kSize, 32, 4 * kSize, SDL_PIXELFORMAT_ARGB8888);
  if (icon == nullptr) return;
  SDL_SetWindowIcon(window, icon);
  SDL_FreeSurface(icon);
}

}  // namespace

Result<WindowReport> run(const WindowOptions& options) {
  const double start = window_now_ms();
  const auto player = player_of(options);
  if (!player) return player.error();
  SDL_SetHint(SDL_HINT_VIDEO_X11_NET_WM_BYPASS_COMPOSITOR, "0");
  SDL_SetHint(SDL_HINT_RENDER_SCALE_QUALITY, "0");
  SDL_SetHint(SDL_HINT_MOUSE_FOCUS_CLICKTHROUGH, "1");
  const Sdl sdl;
  const bool for_nobody =
      sdl.is_there && !options.play_file.has_value() && is_unseen();
  if (for_nobody) SDL_SetError("neither X11 nor Wayland is there");
  if (for_nobody || !sdl.is_there) return sdl_error("there is no display");
  avoid_opengl();
  const double scale = options.scale > 0 ? options.scale : scale_of_display();
  const SDL_Point size = window_size(options, scale);
  const std::unique_ptr<SDL_Window, DestroyWindow> window(SDL_CreateWindow(
      "Halfspace", SDL_WINDOWPOS_CENTERED, SDL_WINDOWPOS_CENTERED, size.x,
      size.y, SDL_WINDOW_RESIZABLE | SDL_WINDOW_ALLOW_HIGHDPI));
  if (!window) return sdl_error("no window can be opened");
  SDL_SetWindowMinimumSize(window.get(), 320, 200);
  set_icon(window.get());
  std::unique_ptr<SDL_Renderer, DestroyRenderer> renderer(
      SDL_CreateRenderer(window.get(), -1, 0));
  if (!renderer) {
    renderer.reset(SDL_CreateRenderer(window.get(), -1, SDL_RENDERER_SOFTWARE));
  }
  if (!renderer) return sdl_error("nothing draws into the window");
  Window shown(options, window.get(), renderer.get(), scale, player->get());
  auto report = shown.run();
  if (report) report->first_window_ms -= start;
  return report;
}

}  // namespace halfspace::viewer
