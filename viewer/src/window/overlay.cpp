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

/// A line of many short pieces: SDL, where it draws by software, looks at all
/// pixels of the box round each triangle. The lines of a grid took 18 ms.
void draw_line(ImDrawList& list, const ImVec2& from, const ImVec2& to,
               ImU32 color, float width) {
  constexpr float kPiecePx = 24;
  const float length = std::hypot(to.x - from.x, to.y - from.y);
  const int count = std::clamp(static_cast<int>(length / kPiecePx), 1, 400);
  for (int i = 0; i <= count; ++i) {
    const float share = static_cast<float>(i) / static_cast<float>(count);
    list.PathLineTo(
        {from.x + share * (to.x - from.x), from.y + share * (to.y - from.y)});
  }
  list.PathStroke(color, 0, width);
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

/// The width of a square of the grid: 1, 2 or 5 times a power of ten, so that
/// ten to twenty-five of them are as long as the model.
double grid_step(double length) {
  const double least = length / 25;
  const double power = std::pow(10, std::floor(std::log10(least)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= least) return factor * power;
  }
  return 10 * power;
}

/// Draws a line where the picture shows nothing, or all of it.
void draw_where_empty(ImDrawList& list, const Canvas& canvas,
                      std::uint32_t empty, bool is_in_front,
                      const ImVec2& origin, const glm::dvec2& from,
                      const glm::dvec2& to) {
  constexpr ImU32 kLine = IM_COL32(128, 136, 148, 130);
  constexpr double kStepPx = 2;
  const double length = glm::distance(from, to);
  const int steps = std::max(
      1, static_cast<int>(std::min(std::ceil(length / kStepPx), 4000.0)));
  const auto at = [&](int i) { return from + double(i) / steps * (to - from); };
  const auto is_empty = [&](int i) {
    const auto x = static_cast<std::int32_t>(std::floor(at(i).x));
    const auto y = static_cast<std::int32_t>(std::floor(at(i).y));
    return x >= 0 && y >= 0 && x < canvas.width_px && y < canvas.height_px &&
           (is_in_front ||
            canvas.pixels[static_cast<std::size_t>(y) *
                              static_cast<std::size_t>(canvas.width_px) +
                          static_cast<std::size_t>(x)] == empty);
  };
  const auto place = [&](int i) {
    return origin +
           ImVec2(static_cast<float>(at(i).x), static_cast<float>(at(i).y));
  };
  for (int i = 0; i < steps;) {
    const int first = i;
    while (i <= steps && is_empty(i)) ++i;
    if (i - 1 > first) draw_line(list, place(first), place(i - 1), kLine, 1);
    i = std::max(i, first + 1);
  }
}

/// A grid on the floor: the plane below the model. Where the eye is above it,
/// all of the model hides what it covers.
void draw_grid(ImDrawList& list, const Session& session, const Ui& ui) {
  const Model& model = *session.model();
  const io::ViewOptions& camera = *session.camera();
  const double size =
      std::max(model.high[0] - model.low[0], model.high[1] - model.low[1]);
  if (!(size > 0) || !std::isfinite(size)) return;
  const double step = grid_step(size);
  const double floor = model.low[2];
  const bool is_in_front =
      camera.orthographic ? axes_of(camera).back.z < 0 : camera.eye.z < floor;
  const Rgb paper = session.state().looks.background;
  const std::uint32_t empty =
      0xff000000u | static_cast<std::uint32_t>(paper.r) << 16 |
      static_cast<std::uint32_t>(paper.g) << 8 | paper.b;
  const auto ends = [&](std::size_t axis) {
    const double middle = (model.low[axis] + model.high[axis]) / 2;
    return std::array<double, 2>{
        std::floor((middle - 0.75 * size) / step) * step,
        std::ceil((middle + 0.75 * size) / step) * step};
  };
  const auto [x_low, x_high] = ends(0);
  const auto [y_low, y_high] = ends(1);
  const ImVec2 origin = {static_cast<float>(ui.view.x),
                         static_cast<float>(ui.view.y)};
  session.frames().look([&](const Canvas& canvas) {
    const auto line = [&](const dvec3& a, const dvec3& b) {
      const auto from = projected(camera, a);
      const auto to = projected(camera, b);
      if (from && to)
        draw_where_empty(list, canvas, empty, is_in_front, origin, *from, *to);
    };
    for (int i = 0; i <= std::lround((x_high - x_low) / step); ++i)
      line({x_low + i * step, y_low, floor}, {x_low + i * step, y_high, floor});
    for (int i = 0; i <= std::lround((y_high - y_low) / step); ++i)
      line({x_low, y_low + i * step, floor}, {x_high, y_low + i * step, floor});
  });
  const std::string text = fmt::format("squares of {:.6g}", step);
  const ImVec2 half = ImGui::CalcTextSize(text.c_str());
  const auto pad = static_cast<float>(12 * ui.scale);
  draw_label(
      list,
      origin + ImVec2(static_cast<float>(ui.view.width) - pad - half.x / 2,
                      static_cast<float>(ui.view.height) - pad - half.y / 2),
      text, ui.scale);
}

/// The faces that were clicked.
void draw_faces(ImDrawList& list, const Session& session, const Ui& ui) {
  for (const PickedPoint& picked : ui.points) {
    for (const auto& polygon : picked.face_polygons) {
      std::vector<ImVec2> places;
      for (const dvec3& corner : polygon) {
        const auto at = projected(*session.camera(), corner);
        if (!at) break;
        places.push_back({static_cast<float>(ui.view.x + at->x),
                          static_cast<float>(ui.view.y + at->y)});
      }
      if (places.size() < polygon.size()) continue;
      list.AddConvexPolyFilled(places.data(), static_cast<int>(places.size()),
                               IM_COL32(217, 95, 2, 70));
    }
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
      draw_line(list, *before, *at, kPaper, 4 * static_cast<float>(ui.scale));
      draw_line(list, *before, *at, kAccent, 2 * static_cast<float>(ui.scale));
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

/// A card for work that is being done; whether it is to end.
bool draw_card_of(const Progress& progress, const char* name, float low,
                  const Ui& ui) {
  const auto middle = static_cast<float>(ui.view.x + ui.view.width / 2);
  begin_card(name, middle, low, 0.5f, 1);
  ImGui::TextUnformatted(progress.work.c_str());
  const auto width = static_cast<float>(260 * ui.scale);
  ImGui::ProgressBar(static_cast<float>(progress.share),
                     {width, static_cast<float>(8 * ui.scale)}, "");
  ImGui::SameLine();
  const bool is_cancelled = ImGui::SmallButton("Cancel");
  ImGui::End();
  return is_cancelled;
}

void draw_progress(Session& session, Jobs& jobs, const Ui& ui) {
  auto low = static_cast<float>(ui.view.y + ui.view.height - 24 * ui.scale);
  const auto step = static_cast<float>(76 * ui.scale);
  const auto draw = [&](const Progress& progress, const char* name) {
    if (progress.work.empty()) return false;
    const bool is_cancelled = draw_card_of(progress, name, low, ui);
    low -= step;
    return is_cancelled;
  };
  if (draw(session.progress(), "loading")) session.cancel_loading();
  if (draw(jobs.solids.progress(), "solids")) jobs.solids.cancel();
  if (draw(jobs.saving.progress(), "saving")) jobs.saving.cancel();
}

void draw_message(Session& session, const Ui& ui) {
  if (session.message().empty()) return;
  const auto middle = static_cast<float>(ui.view.x + ui.view.width / 2);
  const auto top = static_cast<float>(ui.view.y + 20 * ui.scale);
  begin_card("message", middle, top, 0.5f, 0);
  const auto width = static_cast<float>(
      std::min(520 * ui.scale, ui.view.width - 60 * ui.scale));
  ImGui::PushStyleColor(ImGuiCol_Text, IM_COL32(255, 150, 120, 255));
  ImGui::TextUnformatted(!session.is_about_files() ? "That cannot be done"
                         : session.model() ? "Not shown; what was there stays"
                                           : "Not shown");
  ImGui::PopStyleColor();
  ImGui::PushTextWrapPos(width);
  ImGui::TextUnformatted(session.message().c_str());
  ImGui::PopTextWrapPos();
  if (ImGui::Button("Close")) session.say("");
  ImGui::End();
}

void draw_welcome(Session& session, Ui& ui) {
  if (session.model() || session.is_loading() ||
      ui.question != FileQuestion::kNone)
    return;
  const auto x = static_cast<float>(ui.view.x + ui.view.width / 2);
  const auto y = static_cast<float>(ui.view.y + ui.view.height / 2);
  begin_card("welcome", x, y, 0.5f, 0.5f);
  ImGui::TextUnformatted("Drop a mesh here: STL, OBJ, PLY, OFF, 3MF, GLB");
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
    draw_row("Alt+drag", "move a file or a cut");
    draw_row("Shift+wheel", "pan");
    draw_row("Two fingers", "zoom and pan");
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

void draw_overlay(Session& session, Jobs& jobs, Ui& ui) {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const ImVec2 low = {static_cast<float>(ui.view.x),
                      static_cast<float>(ui.view.y)};
  list.PushClipRect(low, low + ImVec2(static_cast<float>(ui.view.width),
                                      static_cast<float>(ui.view.height)));
  if (session.camera() && session.model()) {
    if (ui.has_grid) draw_grid(list, session, ui);
    draw_faces(list, session, ui);
    draw_points(list, session, ui);
    if (ui.has_axes) draw_axes(list, session, ui);
    draw_corner_texts(list, session, ui);
  }
  list.PopClipRect();
  draw_welcome(session, ui);
  draw_progress(session, jobs, ui);
  draw_message(session, ui);
  draw_help(ui);
}

}  // namespace halfspace::viewer
