#include <imgui.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/measure.hpp"
#include "core/moves.hpp"
#include "window/panels.hpp"
#include "window/ui.hpp"

/// The panel of looks.
namespace halfspace::viewer {
namespace {

std::array<float, 3> to_floats(const Rgb& color) {
  return {static_cast<float>(color.r) / 255, static_cast<float>(color.g) / 255,
          static_cast<float>(color.b) / 255};
}

Rgb to_color(const std::array<float, 3>& floats) {
  const auto channel = [](float value) {
    return static_cast<std::uint8_t>(std::clamp(value, 0.f, 1.f) * 255 + 0.5f);
  };
  return {channel(floats[0]), channel(floats[1]), channel(floats[2])};
}

void draw_lines(Looks& looks) {
  int lines = static_cast<int>(looks.lines);
  if (ImGui::Combo("Edges", &lines, "none\0outline\0features\0all\0"))
    looks.lines = static_cast<Lines>(lines);
}

void draw_back_sides(Looks& looks) {
  int sides = looks.cull ? 1 : looks.back_color ? 2 : 0;
  if (ImGui::Combo("Back sides", &sides, "as fronts\0left out\0marked\0")) {
    looks.cull = sides == 1;
    looks.back_color = sides == 2 ? std::optional(kBackColor) : std::nullopt;
  }
  if (!looks.back_color) return;
  Rgb color = *looks.back_color;
  if (choose_color("Mark", color)) looks.back_color = color;
}

void draw_coloring(Looks& looks) {
  if (looks.scalar) return;
  int coloring = static_cast<int>(looks.coloring);
  if (ImGui::Combo("Colours", &coloring,
                   "of the files\0one a file\0one a face\0"))
    looks.coloring = static_cast<Coloring>(coloring);
}

void draw_light(Session& session, Ui& ui, Looks& looks) {
  ImGui::Checkbox("Headlight", &ui.has_headlight);
  if (ImGui::IsItemHovered())
    ImGui::SetTooltip("The light follows the eye when it rests");
  ImGui::SameLine();
  bool has_own = looks.light.has_value();
  if (ImGui::Checkbox("Light from here", &has_own)) {
    ui.has_headlight = false;
    looks.light.reset();
    if (has_own && session.camera()) {
      const glm::dvec3 back = axes_of(*session.camera()).back;
      looks.light = {back.x, back.y, back.z};
    }
  }
  if (ImGui::IsItemHovered())
    ImGui::SetTooltip("The light comes from where the eye is now");
  constexpr float kUsualAmbient = 0.22f;
  auto ambient =
      looks.ambient ? static_cast<float>(*looks.ambient) : kUsualAmbient;
  if (ImGui::SliderFloat("Ambient", &ambient, 0, 1, "%.2f",
                         ImGuiSliderFlags_AlwaysClamp))
    looks.ambient = six_digits(ambient);
}

/// The numbers of the only file.
std::vector<std::string> properties_of(const Session& session) {
  return session.model() ? session.model()->scalar_names
                         : std::vector<std::string>();
}

constexpr const char* kMaps[] = {"viridis", "heated", "turbo",
                                 "cividis", "grey",   "coolwarm"};

/// Which numbers colour the file, and how.
void draw_numbers(Session& session, Looks& looks) {
  const std::vector<std::string> names = properties_of(session);
  if (names.empty() && !looks.scalar) return;
  const std::string shown = looks.scalar ? looks.scalar->source : "none";
  if (ImGui::BeginCombo("Numbers", shown.c_str())) {
    if (ImGui::Selectable("none", !looks.scalar)) looks.scalar.reset();
    for (const std::string& name : names) {
      if (!ImGui::Selectable(name.c_str(), name == shown)) continue;
      const ScalarLook before = looks.scalar.value_or(ScalarLook());
      looks.scalar = ScalarLook{name,  before.map,   std::nullopt,
                                false, before.steps, before.has_legend};
    }
    ImGui::EndCombo();
  }
  if (!looks.scalar) return;
  ScalarLook& look = *looks.scalar;
  if (ImGui::BeginCombo("Map", look.map.c_str())) {
    for (const char* map : kMaps) {
      if (ImGui::Selectable(map, look.map == map)) look.map = map;
    }
    ImGui::EndCombo();
  }
  const auto numbers = session.model() ? session.model()->numbers : nullptr;
  if (numbers && numbers->source == look.source) {
    const auto range = look.range.value_or(numbers->extent);
    std::array<float, 2> ends = {static_cast<float>(range[0]),
                                 static_cast<float>(range[1])};
    const auto step =
        static_cast<float>((numbers->extent[1] - numbers->extent[0]) / 200);
    if (ImGui::DragFloat2("Range", ends.data(), step, 0, 0, "%.4g") &&
        ends[0] < ends[1])
      look.range = {six_digits(double{ends[0]}), six_digits(double{ends[1]})};
    if (look.range && ImGui::SmallButton("All of them")) look.range.reset();
    if (numbers->extent[0] > 0)
      ImGui::Checkbox("Logarithmic", &look.is_logarithmic);
  }
  ImGui::Checkbox("Legend", &look.has_legend);
}

}  // namespace

bool choose_color(const char* name, Rgb& color) {
  std::array<float, 3> floats = to_floats(color);
  const bool is_changed = ImGui::ColorEdit3(
      name, floats.data(),
      ImGuiColorEditFlags_NoInputs | ImGuiColorEditFlags_PickerHueWheel);
  const Rgb next = to_color(floats);
  if (!is_changed || next == color) return false;
  color = next;
  return true;
}
void draw_looks(Session& session, Ui& ui) {
  Looks looks = session.state().looks;
  int is_smooth = looks.is_smooth ? 1 : 0;
  ImGui::RadioButton("Flat", &is_smooth, 0);
  ImGui::SameLine();
  ImGui::RadioButton("Smooth", &is_smooth, 1);
  looks.is_smooth = is_smooth == 1;
  draw_lines(looks);
  draw_back_sides(looks);
  draw_light(session, ui, looks);
  draw_coloring(looks);
  int alpha = looks.alpha;
  if (ImGui::SliderInt("Opacity", &alpha, 0, kOpaque, "%d",
                       ImGuiSliderFlags_AlwaysClamp))
    looks.alpha = static_cast<std::uint8_t>(alpha);
  if (ImGui::IsItemHovered())
    ImGui::SetTooltip("255 hides what is behind, 0 is not seen");
  choose_color("Background", looks.background);
  for (const Rgb& color : {Rgb{255, 255, 255}, Rgb{232, 236, 241},
                           Rgb{43, 48, 56}, Rgb{0, 0, 0}}) {
    ImGui::SameLine();
    ImGui::PushID(color.r);
    const auto c = to_floats(color);
    if (ImGui::ColorButton("##paper", {c[0], c[1], c[2], 1}))
      looks.background = color;
    ImGui::PopID();
  }
  draw_numbers(session, looks);
  if (looks != session.state().looks)
    change(session, [&looks](State& state) { state.looks = looks; });
}
void show_next_numbers(Session& session) {
  const std::vector<std::string> names = properties_of(session);
  if (names.empty()) return;
  session.change([&names](State& state) {
    auto& scalar = state.looks.scalar;
    const auto now = scalar
                         ? std::find(names.begin(), names.end(), scalar->source)
                         : names.end();
    const auto next = now == names.end() ? names.begin() : now + 1;
    if (next == names.end()) {
      scalar.reset();
      return;
    }
    ScalarLook look = scalar.value_or(ScalarLook());
    look.source = *next;
    look.range.reset();
    look.is_logarithmic = false;
    scalar = look;
  });
}

}  // namespace halfspace::viewer
