#include "core/script.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <optional>

namespace halfspace::viewer {
namespace {

using Kind = Event::Kind;

struct KindWord {
  std::string_view word;
  Kind kind;
};

constexpr KindWord kKinds[] = {
    {"move", Kind::kMove},       {"press", Kind::kPress},
    {"release", Kind::kRelease}, {"wheel", Kind::kWheel},
    {"pinch", Kind::kPinch},     {"key", Kind::kKey},
    {"text", Kind::kText},       {"drop", Kind::kDrop},
    {"size", Kind::kSize},       {"wait", Kind::kWait},
    {"dump", Kind::kDump},       {"shot", Kind::kShot},
    {"quit", Kind::kQuit}};

constexpr std::array<std::string_view, 3> kButtons = {"left", "middle",
                                                      "right"};

/// How many moves a drag is made of.
constexpr int kDragMoves = 8;

/// The words of a line.
class Words {
 public:
  explicit Words(std::string_view line) : rest_(line) { skip(); }

  std::string_view next() {
    const std::size_t end =
        std::min(rest_.find_first_of(" \t\r"), rest_.size());
    const std::string_view word = rest_.substr(0, end);
    rest_.remove_prefix(end);
    skip();
    return word;
  }

  template <class T>
  std::optional<T> number() {
    const std::string_view word = next();
    T value{};
    const char* end = word.data() + word.size();
    const auto [stop, code] = std::from_chars(word.data(), end, value);
    if (code != std::errc() || stop != end) return std::nullopt;
    return value;
  }

  /// All that is left.
  std::string_view rest() {
    std::string_view all = rest_;
    while (!all.empty() && (all.back() == '\r' || all.back() == ' '))
      all.remove_suffix(1);
    rest_ = {};
    return all;
  }

  bool is_empty() const { return rest_.empty(); }

 private:
  void skip() {
    rest_.remove_prefix(
        std::min(rest_.find_first_not_of(" \t\r"), rest_.size()));
  }
  std::string_view rest_;
};

std::optional<Button> parse_button(std::string_view word) {
  for (std::size_t i = 0; i < kButtons.size(); ++i) {
    if (kButtons[i] == word) return static_cast<Button>(i + 1);
  }
  return std::nullopt;
}

/// The modifiers at the end of a line; whether there is nothing else.
bool parse_modifiers(Words& words, Modifiers& modifiers) {
  while (!words.is_empty()) {
    const std::string_view word = words.next();
    if (word == "shift")
      modifiers.shift = true;
    else if (word == "ctrl")
      modifiers.control = true;
    else if (word == "alt")
      modifiers.alt = true;
    else
      return false;
  }
  return true;
}

/// A key's name with what is held before it: Ctrl+Shift+Z.
bool parse_key(std::string_view word, Event& event) {
  for (;;) {
    const std::size_t plus = word.find('+');
    if (plus == std::string_view::npos || plus + 1 == word.size()) break;
    const std::string_view held = word.substr(0, plus);
    if (held == "Ctrl")
      event.modifiers.control = true;
    else if (held == "Shift")
      event.modifiers.shift = true;
    else if (held == "Alt")
      event.modifiers.alt = true;
    else
      return false;
    word.remove_prefix(plus + 1);
  }
  event.text = word;
  return !word.empty();
}

bool parse_place(Words& words, Event& event) {
  const auto x = words.number<std::int32_t>();
  const auto y = words.number<std::int32_t>();
  if (!x || !y) return false;
  event.x = *x;
  event.y = *y;
  return true;
}

bool add_drag(Words& words, std::vector<Event>& events) {
  const auto button = parse_button(words.next());
  Event from, to;
  if (!button || !parse_place(words, from) || !parse_place(words, to))
    return false;
  Modifiers modifiers;
  if (!parse_modifiers(words, modifiers)) return false;
  from.kind = to.kind = Kind::kMove;
  from.modifiers = modifiers;
  Event press = from, release = to;
  press.kind = Kind::kPress;
  release.kind = Kind::kRelease;
  press.button = release.button = *button;
  press.modifiers = release.modifiers = modifiers;
  press.x = press.y = release.x = release.y = 0;
  events.push_back(from);
  events.push_back(press);
  for (int i = 1; i <= kDragMoves; ++i) {
    Event move = from;
    move.x += (to.x - from.x) * i / kDragMoves;
    move.y += (to.y - from.y) * i / kDragMoves;
    events.push_back(move);
  }
  events.push_back(release);
  return true;
}

bool parse_arguments(Words& words, Event& event) {
  switch (event.kind) {
    case Kind::kMove:
      return parse_place(words, event) &&
             parse_modifiers(words, event.modifiers);
    case Kind::kPress:
    case Kind::kRelease: {
      const auto button = parse_button(words.next());
      if (!button) return false;
      event.button = *button;
      return parse_modifiers(words, event.modifiers);
    }
    case Kind::kWheel: {
      const auto amount = words.number<double>();
      if (!amount || !std::isfinite(*amount)) return false;
      event.amount = *amount;
      return parse_modifiers(words, event.modifiers);
    }
    case Kind::kPinch: {
      const auto amount = words.number<double>();
      if (!amount || !std::isfinite(*amount)) return false;
      event.amount = *amount;
      return parse_place(words, event) && words.is_empty();
    }
    case Kind::kKey:
      return parse_key(words.rest(), event);
    case Kind::kText:
    case Kind::kDrop:
    case Kind::kShot:
      event.text = words.rest();
      return !event.text.empty();
    case Kind::kSize:
      return parse_place(words, event) && event.x >= 1 && event.y >= 1 &&
             event.x <= 16384 && event.y <= 16384 && words.is_empty();
    case Kind::kWait:
    case Kind::kDump:
    case Kind::kQuit:
      return words.is_empty();
  }
  return false;
}

bool parse_line(std::string_view line, std::vector<Event>& events) {
  Words words(line);
  const std::string_view word = words.next();
  if (word.empty() || word[0] == '#') return true;
  if (word == "drag") return add_drag(words, events);
  for (const KindWord& kind : kKinds) {
    if (kind.word != word) continue;
    Event event;
    event.kind = kind.kind;
    if (!parse_arguments(words, event)) return false;
    events.push_back(std::move(event));
    return true;
  }
  return false;
}

std::string modifiers_text(const Modifiers& modifiers) {
  return std::string(modifiers.shift ? " shift" : "") +
         (modifiers.control ? " ctrl" : "") + (modifiers.alt ? " alt" : "");
}

}  // namespace

Result<std::vector<Event>> parse_script(std::string_view text) {
  std::vector<Event> events;
  std::int64_t number = 0;
  while (!text.empty()) {
    ++number;
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (parse_line(line, events)) continue;
    return Error{ErrorCode::kSyntax,
                 fmt::format("line {}: '{}' is no event", number, line),
                 number};
  }
  return events;
}

std::string to_text(const Event& event) {
  std::string text;
  for (const KindWord& kind : kKinds) {
    if (kind.kind == event.kind) text = kind.word;
  }
  const Modifiers& held = event.modifiers;
  switch (event.kind) {
    case Kind::kMove:
      return text + fmt::format(" {} {}", event.x, event.y) +
             modifiers_text(held);
    case Kind::kPress:
    case Kind::kRelease:
      return text + " " +
             std::string(kButtons[static_cast<std::size_t>(event.button) - 1]) +
             modifiers_text(held);
    case Kind::kWheel:
      return text + fmt::format(" {}", event.amount) + modifiers_text(held);
    case Kind::kPinch:
      return text + fmt::format(" {} {} {}", event.amount, event.x, event.y);
    case Kind::kKey:
      return text + (held.control ? " Ctrl+" : " ") +
             (held.shift ? "Shift+" : "") + (held.alt ? "Alt+" : "") +
             event.text;
    case Kind::kText:
    case Kind::kDrop:
    case Kind::kShot:
      return text + " " + event.text;
    case Kind::kSize:
      return text + fmt::format(" {} {}", event.x, event.y);
    case Kind::kWait:
    case Kind::kDump:
    case Kind::kQuit:
      return text;
  }
  return text;
}

}  // namespace halfspace::viewer
