#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "core/measure.hpp"
#include "core/moves.hpp"
#include "window/fonts.hpp"
#include "window/ui.hpp"

namespace halfspace::viewer {
namespace {

using glm::dvec3;

constexpr ImU32 kInk = IM_COL32(32, 36, 42, 255);
constexpr ImU32 kPaper = IM_COL32(255, 255, 255, 225);
constexpr ImU32 kAccent = IM_COL32(217, 95, 2, 255);

ImVec2 operator+(const ImVec2& a, const ImVec2& b) {
  return {a.x + b.x, a.y + b.y};
}

/// Text on a slip of paper, in the middle of a place.
void draw_label(ImDrawList& list, const ImVec2& at, const std::string& text,
                double scale) {
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  const auto pad = static_cast<float>(4 * scale);
  const ImVec2 low = {std::round(at.x - size.x / 2),
                      std::round(at.y - size.y / 2)};
  list.AddRectFilled({low.x - pad, low.y - pad / 2},
                     {low.x + size.x + pad, low.y + size.y + pad / 2}, kPaper,
                     pad);
  list.AddText(low, kInk, text.c_str());
}

/// FAG83's toothpick: a stick through a ball, which shows how the model is
/// turned; the ball is a handle that turns it.
void draw_axes(ImDrawList& list, const Session& session, const Ui& ui) {
  const AxesPlace place = axes_place(ui);
  const CameraAxes axes = axes_of(*session.camera());
  struct Stick {
    dvec3 direction;
    ImU32 color;
    const char* name;
  };
  Stick sticks[] = {{{1, 0, 0}, IM_COL32(200, 55, 55, 255), "x"},
                    {{0, 1, 0}, IM_COL32(45, 140, 60, 255), "y"},
                    {{0, 0, 1}, IM_COL32(45, 95, 190, 255), "z"}};
  std::sort(std::begin(sticks), std::end(sticks),
            [&axes](const Stick& a, const Stick& b) {
              return glm::dot(a.direction, axes.back) <
                     glm::dot(b.direction, axes.back);
            });
  const ImVec2 middle = {place.x, place.y};
  list.AddCircleFilled(middle, place.radius, IM_COL32(255, 255, 255, 70), 48);
  list.AddCircle(middle, place.radius, IM_COL32(120, 128, 140, 160), 48);
  const auto width = static_cast<float>(2.5 * ui.scale);
  for (const Stick& stick : sticks) {
    const auto x = static_cast<float>(glm::dot(stick.direction, axes.right));
    const auto y = static_cast<float>(-glm::dot(stick.direction, axes.up));
    const float reach = 0.74f * place.radius;
    const ImVec2 tip = {place.x + reach * x, place.y + reach * y};
    list.AddLine(middle, tip, stick.color, width);
    const ImVec2 size = ImGui::CalcTextSize(stick.name);
    const float far = 0.94f * place.radius - size.y / 3;
    list.AddText(
        {place.x + far * x - size.x / 2, place.y + far * y - size.y / 2},
        stick.color, stick.name);
  }
  list.AddCircleFilled(middle, width, kInk, 12);
}

/// The visible lines of the picture, once it is at rest.
void draw_edges(ImDrawList& list, Session& session, const Ui& ui) {
  const auto* strokes = session.edge_lines();
  if (strokes == nullptr) return;
  const auto x = static_cast<float>(ui.view.x);
  const auto y = static_cast<float>(ui.view.y);
  const auto width = static_cast<float>(1.2 * ui.scale);
  const Rgb paper = session.state().looks.background;
  const bool is_dark = paper.r + paper.g + paper.b < 3 * 90;
  const ImU32 ink = is_dark ? IM_COL32(235, 238, 242, 230) : kInk;
  for (const fast::Stroke& stroke : *strokes) {
    list.AddLine({x + static_cast<float>(stroke.from.x),
                  y + static_cast<float>(stroke.from.y)},
                 {x + static_cast<float>(stroke.to.x),
                  y + static_cast<float>(stroke.to.y)},
                 ink, width);
  }
}

/// Marks the points that were clicked, with their distances.
void draw_points(ImDrawList& list, const Session& session, const Ui& ui) {
  const ImVec2 origin = {static_cast<float>(ui.view.x),
                         static_cast<float>(ui.view.y)};
  const auto place_of = [&](const dvec3& point) {
    const auto at = projected(*session.camera(), point);
    return at ? std::optional<ImVec2>(origin +
                                      ImVec2(static_cast<float>(at->x),
                                             static_cast<float>(at->y)))
              : std::nullopt;
  };
  const auto size = static_cast<float>(4.5 * ui.scale);
  std::optional<ImVec2> before;
  for (std::size_t i = 0; i < ui.points.size(); ++i) {
    const dvec3& point = ui.points[i].corner;
    const auto at = place_of(point);
    if (at && before) {
      const double length = glm::distance(ui.points[i - 1].corner, point);
      list.AddLine(*before, *at, kPaper, 4 * static_cast<float>(ui.scale));
      list.AddLine(*before, *at, kAccent, 2 * static_cast<float>(ui.scale));
      draw_label(list, {(before->x + at->x) / 2, (before->y + at->y) / 2},
                 fmt::format("{:.6g}", length), ui.scale);
    }
    before = at;
  }
  for (const PickedPoint& picked : ui.points) {
    const auto at = place_of(picked.corner);
    if (!at) continue;
    list.AddCircleFilled(*at, size + 1.5f, IM_COL32(255, 255, 255, 230), 16);
    list.AddCircleFilled(*at, size, kAccent, 16);
  }
}

/// A window without a frame in the view.
bool begin_card(const char* name, float x, float y, float pivot_x,
                float pivot_y) {
  ImGui::SetNextWindowPos({x, y}, ImGuiCond_Always, {pivot_x, pivot_y});
  ImGui::SetNextWindowBgAlpha(0.95f);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 6);
  const bool is_open = ImGui::Begin(
      name, nullptr,
      ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize |
          ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoMove |
          ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav);
  ImGui::PopStyleVar();
  return is_open;
}

void draw_progress(Session& session, Background& background, const Ui& ui) {
  Progress progress = session.progress();
  const bool is_loading = !progress.work.empty();
  if (!is_loading) progress = background.progress();
  if (progress.work.empty()) return;
  const auto middle = static_cast<float>(ui.view.x + ui.view.width / 2);
  const auto low =
      static_cast<float>(ui.view.y + ui.view.height - 24 * ui.scale);
  begin_card("progress", middle, low, 0.5f, 1);
  ImGui::TextUnformatted(progress.work.c_str());
  const auto width = static_cast<float>(260 * ui.scale);
  ImGui::ProgressBar(static_cast<float>(progress.share),
                     {width, static_cast<float>(8 * ui.scale)}, "");
  ImGui::SameLine();
  if (ImGui::SmallButton("Cancel")) {
    if (is_loading)
      session.cancel_loading();
    else
      background.cancel();
  }
  ImGui::End();
}

void draw_message(Session& session, const Ui& ui) {
  if (session.message().empty()) return;
  const auto middle = static_cast<float>(ui.view.x + ui.view.width / 2);
  const auto top = static_cast<float>(ui.view.y + 20 * ui.scale);
  begin_card("message", middle, top, 0.5f, 0);
  const auto width = static_cast<float>(
      std::min(520 * ui.scale, ui.view.width - 60 * ui.scale));
  ImGui::PushStyleColor(ImGuiCol_Text, IM_COL32(255, 150, 120, 255));
  ImGui::TextUnformatted(session.model() ? "Not shown; what was there stays"
                                         : "Not shown");
  ImGui::PopStyleColor();
  ImGui::PushTextWrapPos(width);
  ImGui::TextUnformatted(session.message().c_str());
  ImGui::PopTextWrapPos();
  if (ImGui::Button("Close")) session.say("");
  ImGui::End();
}

void draw_welcome(Session& session, Ui& ui) {
  if (session.model() || session.is_loading()) return;
  const auto x = static_cast<float>(ui.view.x + ui.view.width / 2);
  const auto y = static_cast<float>(ui.view.y + ui.view.height / 2);
  begin_card("welcome", x, y, 0.5f, 0.5f);
  ImGui::TextUnformatted("Drop a mesh here: STL, OBJ, PLY, OFF");
  if (ImGui::Button("Open...")) ui.question = FileQuestion::kOpen;
  for (const std::string& path : ui.recent) {
    if (ImGui::Selectable(path.c_str())) session.open({path});
  }
  ImGui::End();
}

/// A row of two columns: what is done, and what it does.
void draw_row(const char* what, const char* deed) {
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(what);
  ImGui::TableNextColumn();
  ImGui::TextDisabled("%s", deed);
}

void draw_help(Ui& ui) {
  if (!ui.has_help) return;
  const auto x = static_cast<float>(ui.view.x + ui.view.width / 2);
  const auto y = static_cast<float>(ui.view.y + ui.view.height / 2);
  begin_card("help", x, y, 0.5f, 0.5f);
  ImGui::PushStyleVar(
      ImGuiStyleVar_CellPadding,
      {7 * static_cast<float>(ui.scale), 1.5f * static_cast<float>(ui.scale)});
  if (ImGui::BeginTable("help", 4, ImGuiTableFlags_SizingFixedFit)) {
    draw_row("Left drag", "turn");
    draw_row("Wheel, right drag", "zoom");
    draw_row("Middle drag", "pan");
    draw_row("Shift+drag", "pan");
    draw_row("Ctrl+drag", "turn the picture");
    draw_row("Shift+wheel", "pan");
    draw_row("Click", "what is there");
    draw_row("Double click", "turn about it");
    for (const KeyAction& action : key_actions()) {
      if (*action.deed != 0) draw_row(action.keys, action.deed);
    }
    ImGui::EndTable();
  }
  ImGui::PopStyleVar();
  ImGui::End();
}

void draw_corner_texts(ImDrawList& list, Session& session, const Ui& ui) {
  const auto pad = static_cast<float>(12 * ui.scale);
  const auto x = static_cast<float>(ui.view.x);
  const auto y = static_cast<float>(ui.view.y);
  if (ui.has_name) {
    const std::string name = name_of(session.state());
    const ImVec2 size = ImGui::CalcTextSize(name.c_str());
    draw_label(list, {x + pad + size.x / 2, y + pad + size.y / 2}, name,
               ui.scale);
  }
  if (ui.has_frame_rate && session.frames().count() > 0) {
    const double ms = session.frames().last_ms();
    const std::string text = fmt::format("{:.1f} ms, {:.0f} a second", ms,
                                         1000 / std::max(ms, 0.01));
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    draw_label(list,
               {x + static_cast<float>(ui.view.width) - pad - size.x / 2,
                y + pad + size.y / 2},
               text, ui.scale);
  }
}

}  // namespace

AxesPlace axes_place(const Ui& ui) {
  const auto radius = static_cast<float>(44 * ui.scale);
  const auto pad = static_cast<float>(14 * ui.scale);
  return {static_cast<float>(ui.view.x) + pad + radius,
          static_cast<float>(ui.view.y + ui.view.height) - pad - radius,
          radius};
}

void draw_overlay(Session& session, Background& background, Ui& ui) {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const ImVec2 low = {static_cast<float>(ui.view.x),
                      static_cast<float>(ui.view.y)};
  list.PushClipRect(low, low + ImVec2(static_cast<float>(ui.view.width),
                                      static_cast<float>(ui.view.height)));
  if (session.camera() && session.model()) {
    if (ui.has_edges) draw_edges(list, session, ui);
    draw_points(list, session, ui);
    if (ui.has_axes) draw_axes(list, session, ui);
    draw_corner_texts(list, session, ui);
  }
  list.PopClipRect();
  draw_welcome(session, ui);
  draw_progress(session, background, ui);
  draw_message(session, ui);
  draw_help(ui);
}

}  // namespace halfspace::viewer
