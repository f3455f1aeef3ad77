#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <utility>

#include "core/measure.hpp"
#include "core/moves.hpp"
#include "window/window.hpp"

namespace halfspace::viewer {
namespace {

/// A press that moves less is a click.
constexpr int kClickPx = 3;
/// What one notch of the wheel does.
constexpr double kNotch = 0.88;

Modifiers modifiers_of(int held) {
  return {(held & KMOD_SHIFT) != 0, (held & KMOD_CTRL) != 0,
          (held & KMOD_ALT) != 0};
}

}  // namespace

void Window::handle(const SDL_Event& event) {
  if (event.type == wake_event_) {
    is_woken_ = false;
    redraws_ = std::max(redraws_, 1);
    return;
  }
  if (player_ == nullptr) held_ = modifiers_of(SDL_GetModState());
  if (event.type == SDL_MOUSEMOTION) is_hover_known_ = false;
  if (event.type == SDL_MOUSEBUTTONDOWN && !is_hover_known_ && button_ == 0) {
    // Panels must know where the cursor is to say whether the press is theirs.
    redraws_ = std::max(redraws_, 1);
    draw();
  }
  imgui_.handle(event);
  // Panels settle in three frames; while the cursor turns the model they have
  // nothing to settle.
  const bool is_turning = event.type == SDL_MOUSEMOTION && button_ != 0;
  redraws_ = std::max(redraws_, is_turning ? 1 : 3);
  const double ratio = imgui_.pixel_ratio();
  const auto pixel = [ratio](int at) {
    return static_cast<int>(std::floor(at * ratio));
  };
  switch (event.type) {
    case SDL_QUIT:
      ui_.wants_to_quit = true;
      break;
    case SDL_WINDOWEVENT:
      handle_window(event.window);
      break;
    case SDL_MOUSEMOTION:
      move(pixel(event.motion.x), pixel(event.motion.y));
      break;
    case SDL_MOUSEBUTTONDOWN:
      press(event.button.button, pixel(event.button.x), pixel(event.button.y));
      break;
    case SDL_MOUSEBUTTONUP:
      release(event.button.button, event.button.clicks > 1);
      break;
    case SDL_MOUSEWHEEL:
      wheel(event.wheel);
      break;
    case SDL_MULTIGESTURE:
      pinch(event.mgesture);
      break;
    case SDL_FINGERDOWN:
    case SDL_FINGERUP:
      fingers_.reset();
      break;
    case SDL_KEYDOWN:
      key(event.key);
      break;
    case SDL_DROPFILE:
      dropped_.emplace_back(event.drop.file);
      SDL_free(event.drop.file);
      break;
    case SDL_DROPCOMPLETE:
      drop();
      break;
    default:
      break;
  }
}

void Window::drop() {
  if (dropped_.empty()) return;
  // Beside what is there only where that is asked for.
  if (ui_.question == FileQuestion::kAdd || (SDL_GetModState() & KMOD_SHIFT))
    session_.add(dropped_);
  else
    session_.open(dropped_);
  dropped_.clear();
}

void Window::handle_window(const SDL_WindowEvent& event) {
  if (event.event == SDL_WINDOWEVENT_CLOSE) ui_.wants_to_quit = true;
  if (event.event == SDL_WINDOWEVENT_SIZE_CHANGED) lay_out();
  // Shown, uncovered, of another size: what was drawn may be gone.
  if (event.event != SDL_WINDOWEVENT_ENTER &&
      event.event != SDL_WINDOWEVENT_LEAVE)
    is_exposed_ = true;
}

void Window::press(int button, int x, int y) {
  fingers_.reset();
  if (ImGui::GetIO().WantCaptureMouse || !ui_.view.holds(x, y)) return;
  if (button_ != 0) return;
  button_ = button;
  pressed_x_ = last_x_ = x;
  pressed_y_ = last_y_ = y;
  has_moved_ = false;
  const AxesPlace axes = axes_place(ui_);
  drags_axes_ =
      ui_.has_axes && std::hypot(static_cast<float>(x) - axes.x,
                                 static_cast<float>(y) - axes.y) <= axes.radius;
  grip_.reset();
  if (held_.alt && button == SDL_BUTTON_LEFT && !drags_axes_) take_hold(x, y);
}

void Window::take_hold(int x, int y) {
  const auto point = session_.pick(x - ui_.view.x, y - ui_.view.y);
  if (!point) return;
  const State& state = session_.state();
  Held held;
  held.point = point->point;
  held.is_plane = point->part == kCapPart;
  if (!held.is_plane) {
    held.index = point->part;
    held.shift = state.parts[held.index].shift;
    grip_ = held;
  } else {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < state.sections.size(); ++i) {
      const Section& section = state.sections[i];
      const glm::dvec3 normal(section.normal[0], section.normal[1],
                              section.normal[2]);
      const double distance =
          std::abs(glm::dot(normal, held.point) - section.offset) /
          glm::length(normal);
      if (!section.is_on || !(distance < least)) continue;
      least = distance;
      held.index = i;
      held.offset = section.offset;
      grip_ = held;
    }
  }
  ++grip_count_;
}

void Window::move_held(const glm::dvec2& drag) {
  const io::ViewOptions& camera = *session_.camera();
  const Held& held = *grip_;
  // Beyond the gestures of keys and of panels, which are hashes.
  const unsigned gesture = 16 + grip_count_;
  const State& state = session_.state();
  if (held.is_plane && held.index < state.sections.size()) {
    const auto& [a, b, c] = state.sections[held.index].normal;
    const glm::dvec3 normal(a, b, c);
    const double by =
        dragged_along(camera, held.point, glm::normalize(normal), drag) *
        glm::length(normal);
    session_.change(
        [&](State& s) {
          s.sections[held.index].offset = six_digits(held.offset + by);
        },
        gesture);
  } else if (!held.is_plane && held.index < state.parts.size()) {
    const glm::dvec3 by = dragged(camera, held.point, drag);
    session_.change(
        [&](State& s) {
          for (int axis = 0; axis < 3; ++axis) {
            const auto k = static_cast<std::size_t>(axis);
            s.parts[held.index].shift[k] = six_digits(held.shift[k] + by[axis]);
          }
        },
        gesture);
  }
}

void Window::release(int button, bool is_double) {
  fingers_.reset();
  if (button != button_) return;
  button_ = 0;
  grip_.reset();
  if (!has_moved_ && !drags_axes_ && button == SDL_BUTTON_LEFT)
    click(pressed_x_ - ui_.view.x, pressed_y_ - ui_.view.y, is_double);
}

void Window::move(int x, int y) {
  if (button_ == 0) return;
  if (!has_moved_ && std::abs(x - pressed_x_) < kClickPx &&
      std::abs(y - pressed_y_) < kClickPx)
    return;
  has_moved_ = true;
  const glm::dvec2 drag(x - last_x_, y - last_y_);
  last_x_ = x;
  last_y_ = y;
  if (!session_.camera()) return;
  stop_flight(session_, ui_);
  if (grip_) {
    move_held({x - pressed_x_, y - pressed_y_});
    return;
  }
  const io::ViewOptions& camera = *session_.camera();
  const Modifiers held = held_;
  if (drags_axes_) {
    // The handle is small: its width is a half turn.
    const double gain = camera.height_px / (2.0 * axes_place(ui_).radius);
    ask_for_camera(rolled(camera, gain * drag));
  } else if (button_ == SDL_BUTTON_MIDDLE ||
             (button_ == SDL_BUTTON_LEFT && held.shift)) {
    ask_for_camera(panned(camera, drag));
  } else if (button_ == SDL_BUTTON_RIGHT) {
    const double factor = std::exp(4 * drag.y / camera.height_px);
    ask_for_camera(
        zoomed(camera, factor,
               {pressed_x_ - ui_.view.x + 0.5, pressed_y_ - ui_.view.y + 0.5}));
  } else if (held.control) {
    ask_for_camera(twisted(camera, 0.4 * drag.x));
  } else if (ui_.is_trackball) {
    ask_for_camera(rolled(camera, drag));
  } else {
    ask_for_camera(orbited(camera, drag));
  }
}

void Window::ask_for_camera(const io::ViewOptions& camera) {
  if (session_.is_settled()) note_request();
  session_.set_camera(camera);
}

void Window::wheel(const SDL_MouseWheelEvent& wheel) {
  if (ImGui::GetIO().WantCaptureMouse || !session_.camera()) return;
  stop_flight(session_, ui_);
  const ImVec2 at = ImGui::GetIO().MousePos;
  if (!ui_.view.holds(static_cast<int>(at.x), static_cast<int>(at.y))) return;
  if (held_.shift) {
    const double px = 24 * ui_.scale;
    ask_for_camera(panned(*session_.camera(),
                          {-px * wheel.preciseX, px * wheel.preciseY}));
    return;
  }
  const double notches = std::clamp<double>(wheel.preciseY, -20, 20);
  ask_for_camera(zoomed(*session_.camera(), std::pow(kNotch, notches),
                        {at.x - static_cast<float>(ui_.view.x),
                         at.y - static_cast<float>(ui_.view.y)}));
}

void Window::pinch(const SDL_MultiGestureEvent& gesture) {
  if (!session_.camera()) return;
  int width = 0, height = 0;
  SDL_GetRendererOutputSize(renderer_, &width, &height);
  const glm::dvec2 at(double{gesture.x} * width - ui_.view.x,
                      double{gesture.y} * height - ui_.view.y);
  const std::optional<glm::dvec2> before = std::exchange(fingers_, at);
  // The first finger was taken for a mouse, which has pressed a button.
  button_ = 0;
  grip_.reset();
  const io::ViewOptions& camera = *session_.camera();
  if (!before && (at.x < 0 || at.y < 0 || at.x >= camera.width_px ||
                  at.y >= camera.height_px)) {
    fingers_.reset();
    return;
  }
  stop_flight(session_, ui_);
  const double factor =
      std::exp(-4 * std::clamp(double{gesture.dDist}, -1.0, 1.0));
  ask_for_camera(
      zoomed(before ? panned(camera, at - *before) : camera, factor, at));
}

void Window::key(const SDL_KeyboardEvent& key) {
  const bool is_escape = key.keysym.sym == SDLK_ESCAPE;
  if (ImGui::GetIO().WantTextInput && !is_escape) return;
  act_on_key(key.keysym.sym, modifiers_of(key.keysym.mod), session_, ui_);
}

void Window::click(int x, int y, bool is_double) {
  std::optional<PickedPoint> point = session_.pick(x, y);
  if (!point) {
    if (!ui_.measures) ui_.points.clear();
    return;
  }
  if (is_double && session_.camera()) {
    io::ViewOptions camera = *session_.camera();
    const glm::dvec3 by = point->point - camera.target;
    camera.target += by;
    camera.eye += by;
    fly_to(session_, ui_, camera);
    return;
  }
  if (!ui_.measures) ui_.points.clear();
  ui_.points.push_back(*std::move(point));
}

}  // namespace halfspace::viewer
