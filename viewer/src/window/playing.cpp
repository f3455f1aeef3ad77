#include <SDL.h>

#include <cstdlib>
#include <cstring>

#include "core/saving.hpp"
#include "halfspace/io/file.hpp"
#include "halfspace/io/picture.hpp"
#include "window/window.hpp"

namespace halfspace::viewer {
namespace {

using Kind = Event::Kind;

int sdl_modifiers(const Modifiers& held) {
  return (held.shift ? KMOD_LSHIFT : 0) | (held.control ? KMOD_LCTRL : 0) |
         (held.alt ? KMOD_LALT : 0);
}

Button button_of(int button) {
  return button == SDL_BUTTON_RIGHT    ? Button::kRight
         : button == SDL_BUTTON_MIDDLE ? Button::kMiddle
                                       : Button::kLeft;
}

/// The name with the number in place of `%d`.
std::string numbered(const std::string& name, std::int64_t number) {
  const std::size_t at = name.find("%d");
  if (at == std::string::npos) return name;
  return name.substr(0, at) + std::to_string(number) + name.substr(at + 2);
}

}  // namespace

Result<Done> Window::play() {
  if (player_->is_at_end()) {
    if (session_.is_settled()) ui_.wants_to_quit = true;
    return Done{};
  }
  // What follows would else come before the camera does, or after it.
  if (session_.is_seeking()) return Done{};
  const Event& event = player_->next();
  const bool waits = event.kind == Kind::kWait || event.kind == Kind::kDump ||
                     event.kind == Kind::kShot;
  if (waits) {
    update();
    if (!session_.is_settled() || jobs_.are_busy()) return Done{};
  }
  // A picture of the window is taken when panels have settled.
  if (event.kind == Kind::kShot && redraws_ > 0) return Done{};
  const auto played = play_event(event);
  player_->advance();
  return played;
}

Result<Done> Window::play_event(const Event& event) {
  held_ = event.modifiers;
  SDL_Event e{};
  switch (event.kind) {
    case Kind::kMove:
      e.type = SDL_MOUSEMOTION;
      e.motion.x = played_x_ = event.x;
      e.motion.y = played_y_ = event.y;
      break;
    case Kind::kPress:
    case Kind::kRelease:
      e.type =
          event.kind == Kind::kPress ? SDL_MOUSEBUTTONDOWN : SDL_MOUSEBUTTONUP;
      e.button.button = event.button == Button::kLeft    ? SDL_BUTTON_LEFT
                        : event.button == Button::kRight ? SDL_BUTTON_RIGHT
                                                         : SDL_BUTTON_MIDDLE;
      e.button.clicks = 1;
      e.button.x = played_x_;
      e.button.y = played_y_;
      break;
    case Kind::kWheel:
      e.type = SDL_MOUSEWHEEL;
      e.wheel.preciseY = static_cast<float>(event.amount);
      break;
    case Kind::kPinch: {
      int width = 0, height = 0;
      SDL_GetRendererOutputSize(renderer_, &width, &height);
      e.type = SDL_MULTIGESTURE;
      e.mgesture.numFingers = 2;
      e.mgesture.dDist = static_cast<float>(event.amount);
      e.mgesture.x = static_cast<float>(event.x) / static_cast<float>(width);
      e.mgesture.y = static_cast<float>(event.y) / static_cast<float>(height);
      break;
    }
    case Kind::kKey: {
      e.type = SDL_KEYDOWN;
      e.key.keysym.sym = SDL_GetKeyFromName(event.text.c_str());
      e.key.keysym.scancode = SDL_GetScancodeFromKey(e.key.keysym.sym);
      e.key.keysym.mod = static_cast<Uint16>(sdl_modifiers(event.modifiers));
      handle(e);
      draw();
      e.type = SDL_KEYUP;
      break;
    }
    case Kind::kText:
      e.type = SDL_TEXTINPUT;
      std::strncpy(e.text.text, event.text.c_str(), sizeof e.text.text - 1);
      break;
    case Kind::kDrop:
      dropped_.push_back(event.text);
      drop();
      return Done{};
    case Kind::kSize:
      SDL_SetWindowSize(window_, event.x, event.y);
      lay_out();
      redraws_ = 3;
      return Done{};
    case Kind::kWait:
      return Done{};
    case Kind::kDump:
      return dump();
    case Kind::kShot:
      return shoot(event.text);
    case Kind::kQuit:
      ui_.wants_to_quit = true;
      return Done{};
  }
  handle(e);
  return Done{};
}

Result<Done> Window::dump() {
  if (!options_.dump_name)
    return Error{ErrorCode::kUnwritable,
                 "the events ask for `dump`, but --dump names no file"};
  // A state that shows nothing is numbered, too.
  const std::string path = numbered(*options_.dump_name, dump_count_++);
  const auto shown = session_.shown();
  if (!shown) return Done{};
  const std::size_t dot = path.rfind(".png");
  const auto view = write_state(path.substr(0, dot) + ".view", shown->state);
  if (!view) return view.error();
  return save_shown(*shown, path);
}

Result<Done> Window::shoot(const std::string& path) {
  redraws_ = 1;
  is_exposed_ = true;
  draw();
  int width = 0, height = 0;
  SDL_GetRendererOutputSize(renderer_, &width, &height);
  ColorImage image(width, height, {});
  std::vector<std::uint8_t> pixels(static_cast<std::size_t>(width) *
                                   static_cast<std::size_t>(height) * 3);
  if (SDL_RenderReadPixels(renderer_, nullptr, SDL_PIXELFORMAT_RGB24,
                           pixels.data(), 3 * width) != 0)
    return Error{ErrorCode::kUnwritable, path + ": " + SDL_GetError()};
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = {pixels[3 * i], pixels[3 * i + 1], pixels[3 * i + 2]};
  return io::write_png(path, image);
}

void Window::record(const SDL_Event& e) {
  if (!options_.record_file) return;
  Event event;
  event.modifiers = held_;
  switch (e.type) {
    case SDL_MOUSEMOTION:
      event.kind = Kind::kMove;
      event.x = e.motion.x;
      event.y = e.motion.y;
      break;
    case SDL_MOUSEBUTTONDOWN:
    case SDL_MOUSEBUTTONUP:
      event.kind =
          e.type == SDL_MOUSEBUTTONDOWN ? Kind::kPress : Kind::kRelease;
      event.button = button_of(e.button.button);
      break;
    case SDL_MOUSEWHEEL:
      event.kind = Kind::kWheel;
      event.amount = static_cast<double>(e.wheel.preciseY);
      break;
    case SDL_MULTIGESTURE: {
      int width = 0, height = 0;
      SDL_GetRendererOutputSize(renderer_, &width, &height);
      event.kind = Kind::kPinch;
      event.amount = static_cast<double>(e.mgesture.dDist);
      event.x = static_cast<int>(e.mgesture.x * static_cast<float>(width));
      event.y = static_cast<int>(e.mgesture.y * static_cast<float>(height));
      break;
    }
    case SDL_KEYDOWN: {
      event.kind = Kind::kKey;
      event.text = SDL_GetKeyName(e.key.keysym.sym);
      // What is only held is with the keys and moves that follow.
      if (event.text.empty() || event.text.find(' ') != std::string::npos)
        return;
      break;
    }
    case SDL_TEXTINPUT:
      event.kind = Kind::kText;
      event.text = e.text.text;
      break;
    case SDL_DROPFILE:
      event.kind = Kind::kDrop;
      event.text = e.drop.file;
      break;
    case SDL_WINDOWEVENT:
      if (e.window.event != SDL_WINDOWEVENT_SIZE_CHANGED) return;
      event.kind = Kind::kSize;
      event.x = e.window.data1;
      event.y = e.window.data2;
      break;
    default:
      return;
  }
  recorded_ += to_text(event) + '\n';
}

Result<Done> Window::write_recorded() const {
  return io::write_file(*options_.record_file, recorded_);
}

}  // namespace halfspace::viewer
