#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "halfspace/result.hpp"

namespace halfspace::viewer {

/// A mouse button, as SDL numbers them.
enum class Button : std::uint8_t { kLeft = 1, kMiddle = 2, kRight = 3 };

/// Keys that are held.
struct Modifiers {
  bool shift = false;
  bool control = false;
  bool alt = false;
  friend bool operator==(const Modifiers&, const Modifiers&) = default;
};

/// One line of a script of events (docs/guide.md).
struct Event {
  enum class Kind : std::uint8_t {
    kMove,     ///< of the cursor to x, y
    kPress,    ///< of the button
    kRelease,  ///< of the button
    kWheel,    ///< `amount` notches, away from the user if above 0
    kPinch,    ///< two fingers about x, y, apart by `amount` more
    kKey,      ///< the key that SDL calls `text`, pressed and released
    kText,     ///< letters that were typed
    kDrop,     ///< the file `text`
    kSize,     ///< of the window: x, y
    kWait,     ///< until the picture is whole
    kDump,     ///< the picture, by the name that --dump says
    kShot,     ///< the whole window, to the file `text`
    kQuit,
  };
  Kind kind = Kind::kWait;
  std::int32_t x = 0;
  std::int32_t y = 0;
  Button button = Button::kLeft;
  double amount = 0;
  Modifiers modifiers;
  std::string text;
  friend bool operator==(const Event&, const Event&) = default;
};

/// The events that the lines say, in order. Empty lines and those that begin
/// with # say nothing; `drag BUTTON X Y X Y` says many.
///
/// Errors: kSyntax, with the line's number.
Result<std::vector<Event>> parse_script(std::string_view text);

/// The event as a line without its end: parse_script() gives it back.
std::string to_text(const Event& event);

}  // namespace halfspace::viewer
