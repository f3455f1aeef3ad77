#include "window/panels.hpp"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <filesystem>
#include <glm/geometric.hpp>
#include <set>
#include <utility>

#include "core/command_line.hpp"
#include "core/measure.hpp"
#include "core/moves.hpp"
#include "window/fonts.hpp"
#include "window/ui.hpp"

namespace halfspace::viewer {

void change(Session& session, const Edit& edit) {
  session.change(edit, ImGui::GetActiveID());
}

namespace {

/// A button as wide as `share` of what is left in a row of `count`.
bool wide_button(const char* name, int count) {
  const float space = ImGui::GetStyle().ItemSpacing.x;
  const float all = ImGui::GetWindowContentRegionMax().x -
                    ImGui::GetWindowContentRegionMin().x;
  const auto n = static_cast<float>(count);
  return ImGui::Button(name, {(all - (n - 1) * space) / n, 0});
}

/// What was open before, to be opened again.
void draw_recent(Session& session, const Ui& ui) {
  if (ui.recent.empty()) return;
  ImGui::SetNextItemWidth(-1);
  if (!ImGui::BeginCombo("##recent", "Recent")) return;
  for (const std::string& path : ui.recent) {
    if (ImGui::Selectable(path.c_str())) session.open({path});
  }
  ImGui::EndCombo();
}

void draw_files(Session& session, Ui& ui) {
  if (wide_button("Open...", 2)) ui.question = FileQuestion::kOpen;
  ImGui::SameLine();
  if (wide_button("Add...", 2)) ui.question = FileQuestion::kAdd;
  draw_recent(session, ui);
  const State& state = session.state();
  Edit edit;
  for (std::size_t i = 0; i < state.parts.size(); ++i) {
    const Part& part = state.parts[i];
    ImGui::PushID(static_cast<int>(i));
    bool is_visible = part.is_visible;
    if (ImGui::Checkbox("##seen", &is_visible))
      edit = [i, is_visible](State& s) { s.parts[i].is_visible = is_visible; };
    ImGui::SameLine();
    Rgb color = part.color.value_or(Rgb{204, 204, 204});
    if (choose_color("##color", color))
      edit = [i, color](State& s) { s.parts[i].color = color; };
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    const std::string name =
        std::filesystem::path(part.path).filename().string();
    ImGui::TextUnformatted(name.c_str());
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", part.path.c_str());
    ImGui::SameLine(ImGui::GetWindowContentRegionMax().x -
                    ImGui::GetFrameHeight());
    if (ImGui::Button("x", {ImGui::GetFrameHeight(), 0})) {
      edit = [i](State& s) {
        s.parts.erase(s.parts.begin() + static_cast<std::ptrdiff_t>(i));
      };
    }
    ImGui::PopID();
  }
  if (edit) change(session, edit);
}

/// What is nearer to the eye than this is not seen.
void draw_near(Session& session) {
  io::ViewOptions camera = *session.camera();
  bool has_near = camera.near.has_value();
  const double distance = glm::distance(camera.eye, camera.target);
  if (ImGui::Checkbox("Near", &has_near)) {
    camera.near.reset();
    if (has_near) camera.near = six_digits(distance);
    session.set_camera(camera);
  }
  if (ImGui::IsItemHovered())
    ImGui::SetTooltip("What is not farther from the eye is not seen");
  if (!camera.near) return;
  ImGui::SameLine();
  auto near = static_cast<float>(*camera.near);
  ImGui::SetNextItemWidth(-1);
  const float least =
      camera.orthographic ? static_cast<float>(-distance) : 0.0f;
  if (ImGui::DragFloat("##near", &near, static_cast<float>(distance / 400),
                       least, static_cast<float>(100 * distance), "%.6g")) {
    camera.near = six_digits(near);
    session.set_camera(camera);
  }
}

void draw_view(Session& session, Ui& ui) {
  const struct {
    const char* name;
    io::ViewDirection side;
  } kSides[] = {
      {"Front", {{0, -1, 0}, {0, 0, 1}}}, {"Right", {{1, 0, 0}, {0, 0, 1}}},
      {"Top", {{0, 0, 1}, {0, 1, 0}}},    {"Back", {{0, 1, 0}, {0, 0, 1}}},
      {"Left", {{-1, 0, 0}, {0, 0, 1}}},  {"Bottom", {{0, 0, -1}, {0, -1, 0}}}};
  for (int i = 0; i < 6; ++i) {
    if (i % 3 != 0) ImGui::SameLine();
    if (wide_button(kSides[i].name, 3)) session.seek_side(kSides[i].side);
  }
  if (wide_button("Corner", 3)) session.seek_side(io::ViewDirection());
  ImGui::SameLine();
  if (wide_button("Fit", 3)) session.seek_fit();
  ImGui::SameLine();
  if (wide_button("Reset", 3)) session.seek_first();
  if (!session.camera()) return;
  int is_orthographic = session.camera()->orthographic ? 1 : 0;
  bool is_other = ImGui::RadioButton("Perspective", &is_orthographic, 0);
  ImGui::SameLine();
  is_other |= ImGui::RadioButton("Orthographic", &is_orthographic, 1);
  if (is_other)
    session.set_camera(
        with_projection(*session.camera(), is_orthographic == 1));
  draw_near(session);
  if (!session.camera()->orthographic) {
    auto degrees = static_cast<float>(session.camera()->fov_deg);
    if (ImGui::SliderFloat("Field", &degrees, 5, 120, "%.0f deg",
                           ImGuiSliderFlags_AlwaysClamp))
      session.set_camera(with_field(*session.camera(), degrees));
  }
  ImGui::Checkbox("Free turning", &ui.is_trackball);
  ImGui::SameLine();
  ImGui::Checkbox("Axes", &ui.has_axes);
  ImGui::SameLine();
  ImGui::Checkbox("Grid", &ui.has_grid);
}

std::string face_text(const State& state, const PickedPoint& point) {
  if (point.part >= state.parts.size()) {
    if (point.is_overlap) return "The cap where parts overlap";
    if (!point.cap_part || *point.cap_part >= state.parts.size())
      return "The cap of a section";
    const std::filesystem::path cut = state.parts[*point.cap_part].path;
    return fmt::format("The cap of {}", cut.filename().string());
  }
  const std::filesystem::path path = state.parts[point.part].path;
  return fmt::format("Face {} of {}", point.face, path.filename().string());
}

void draw_point(const PickedPoint& point) {
  if (ImFont* font = fixed_font()) ImGui::PushFont(font);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    ImGui::TextDisabled("%c", "xyz"[axis]);
    ImGui::SameLine();
    ImGui::TextUnformatted(point.exact_corner[axis].c_str());
  }
  if (fixed_font() != nullptr) ImGui::PopFont();
}

void draw_distances(const std::vector<PickedPoint>& points) {
  const std::size_t n = points.size();
  if (n < 2) return;
  const glm::dvec3& b = points[n - 1].corner;
  const glm::dvec3& a = points[n - 2].corner;
  const glm::dvec3 by = b - a;
  const std::string distance = fmt::format("{:.9g}", glm::length(by));
  ImGui::Text("Distance  %s", distance.c_str());
  const std::string axes =
      fmt::format("{:.6g}, {:.6g}, {:.6g}", by.x, by.y, by.z);
  ImGui::TextDisabled("by %s", axes.c_str());
  if (n < 3) return;
  const glm::dvec3& c = points[n - 3].corner;
  const std::string angle = fmt::format("{:.6g} deg", angle_deg(b, a, c));
  ImGui::Text("Angle  %s", angle.c_str());
  const std::string area = fmt::format("{:.6g}", triangle_area(a, b, c));
  ImGui::Text("Triangle  %s", area.c_str());
}

/// How many faces were clicked, and their area.
void draw_chosen_faces(const std::vector<PickedPoint>& points) {
  std::set<std::pair<std::uint32_t, std::int32_t>> faces;
  double area = 0;
  for (const PickedPoint& point : points) {
    if (point.part == kCapPart) continue;
    if (faces.insert({point.part, point.face}).second) area += point.face_area;
  }
  if (faces.empty()) return;
  const std::string text =
      fmt::format("{} {}, area {:.9g}", faces.size(),
                  faces.size() == 1 ? "face" : "faces", area);
  ImGui::TextUnformatted(text.c_str());
}

void draw_measures(Session& session, Jobs& jobs, Ui& ui) {
  ImGui::Checkbox("Keep points that are clicked", &ui.measures);
  if (ui.points.empty()) {
    ImGui::TextDisabled("Click on the model: the nearest corner,");
    ImGui::TextDisabled("in exact numbers");
  } else {
    const PickedPoint& point = ui.points.back();
    ImGui::TextUnformatted(face_text(session.state(), point).c_str());
    draw_point(point);
    draw_distances(ui.points);
    draw_chosen_faces(ui.points);
    if (ImGui::SmallButton("Forget points")) ui.points.clear();
  }
  if (wide_button("Volume and area", 1) && !session.state().parts.empty()) {
    const State state = session.state();
    ui.measures_text.clear();
    jobs.solids.start(
        [state](const Report& report) { return measures_of(state, report); });
  }
  if (!ui.measures_text.empty())
    ImGui::TextWrapped("%s", ui.measures_text.c_str());
}

void draw_shift(Session& session, std::size_t index) {
  const Part& part = session.state().parts[index];
  float shift[3] = {static_cast<float>(part.shift[0]),
                    static_cast<float>(part.shift[1]),
                    static_cast<float>(part.shift[2])};
  ImGui::PushID(static_cast<int>(index));
  ImGui::TextDisabled(
      "%s", std::filesystem::path(part.path).filename().string().c_str());
  ImGui::SetNextItemWidth(-1);
  const float speed =
      session.camera()
          ? static_cast<float>(height_at_target(*session.camera()) / 500)
          : 0.01f;
  if (ImGui::DragFloat3("##shift", shift, speed, 0, 0, "%.6g")) {
    change(session, [&](State& state) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        // As many digits as are shown.
        state.parts[index].shift[axis] = six_digits(shift[axis]);
      }
    });
  }
  ImGui::PopID();
}

void draw_booleans(Session& session, Ui& ui) {
  const struct {
    const char* name;
    Combination value;
  } kChoices[] = {{"None", Combination::kNone},
                  {"Union", Combination::kUnion},
                  {"Difference", Combination::kDifference},
                  {"Intersection", Combination::kIntersection},
                  {"Sym. difference", Combination::kSymmetricDifference}};
  if (session.state().parts.size() < 2) {
    ImGui::TextDisabled("Add a second file to combine them");
  } else {
    int n = 0;
    for (const auto& choice : kChoices) {
      const bool is_it = session.state().combination == choice.value;
      if (n++ % 2 == 1)
        ImGui::SameLine(ImGui::GetWindowContentRegionMax().x / 2);
      if (ImGui::RadioButton(choice.name, is_it) && !is_it)
        session.change(
            [&choice](State& state) { state.combination = choice.value; });
    }
  }
  for (std::size_t i = 0; i < session.state().parts.size(); ++i)
    draw_shift(session, i);
  if (!session.state().parts.empty() && wide_button("Export the solid...", 1))
    ui.question = FileQuestion::kExport;
}

void draw_saving(Session& session, Ui& ui) {
  if (wide_button("Picture...", 2)) ui.question = FileQuestion::kSavePicture;
  ImGui::SameLine();
  if (wide_button("View...", 2)) ui.question = FileQuestion::kSaveView;
  if (wide_button("Film of a turn...", 1))
    ui.question = FileQuestion::kSaveFilm;
  if (wide_button("Copy as command line", 1)) copy_command(session, ui);
}

/// The extent of what is shown along a direction of length 1.
std::array<double, 2> extent_along(const Session& session,
                                   const glm::dvec3& axis) {
  return session.model() ? session.model()->extent_along(axis)
                         : std::array<double, 2>{-1, 1};
}

/// A plane across a direction, in the middle of what is shown.
Section section_across(const Session& session, const glm::dvec3& axis) {
  const auto [low, high] = extent_along(session, axis);
  const double middle = six_digits((low + high) / 2);
  return {{axis.x, axis.y, axis.z}, middle, true};
}

void draw_section(Session& session, const Ui& ui, std::size_t index) {
  Section section = session.state().sections[index];
  ImGui::PushID(static_cast<int>(index));
  ImGui::Checkbox("##on", &section.is_on);
  const struct {
    const char* name;
    glm::dvec3 axis;
  } kAxes[] = {{"X", {1, 0, 0}}, {"Y", {0, 1, 0}}, {"Z", {0, 0, 1}}};
  for (const auto& [name, axis] : kAxes) {
    ImGui::SameLine();
    if (ImGui::Button(name)) section = section_across(session, axis);
  }
  ImGui::SameLine();
  ImGui::BeginDisabled(ui.points.empty());
  if (ImGui::Button("Face")) {
    const glm::dvec3& n = ui.points.back().normal;
    section.normal = {six_digits(n.x), six_digits(n.y), six_digits(n.z)};
    section.offset = six_digits(glm::dot(n, ui.points.back().corner));
  }
  ImGui::EndDisabled();
  ImGui::SameLine();
  if (ImGui::Button("Flip")) {
    for (double& value : section.normal) value = 0 - value;
    section.offset = 0 - section.offset;
  }
  ImGui::SameLine();
  const bool is_removed = ImGui::Button("x");
  const glm::dvec3 axis(section.normal[0], section.normal[1],
                        section.normal[2]);
  const auto [low, high] = extent_along(session, axis);
  auto offset = static_cast<float>(section.offset);
  ImGui::SetNextItemWidth(-1);
  if (ImGui::SliderFloat("##offset", &offset, static_cast<float>(low),
                         static_cast<float>(high), "%.6g"))
    section.offset = six_digits(offset);
  ImGui::PopID();
  if (is_removed) {
    change(session, [index](State& state) {
      state.sections.erase(state.sections.begin() +
                           static_cast<std::ptrdiff_t>(index));
    });
  } else if (section != session.state().sections[index]) {
    change(session, [&](State& state) { state.sections[index] = section; });
  }
}

void draw_sections(Session& session, const Ui& ui) {
  for (std::size_t i = 0; i < session.state().sections.size(); ++i)
    draw_section(session, ui, i);
  if (session.state().sections.size() < kMostSections && session.model() &&
      wide_button("Cut by a plane", 1)) {
    const Section section = section_across(session, {1, 0, 0});
    change(session, [&](State& state) { state.sections.push_back(section); });
  }
}

bool begin_section(const char* name, bool is_open = true) {
  return ImGui::CollapsingHeader(
      name, is_open ? ImGuiTreeNodeFlags_DefaultOpen : ImGuiTreeNodeFlags_None);
}

void draw_undo(Session& session, Ui& ui) {
  ImGui::BeginDisabled(!session.can_undo());
  if (wide_button("Undo", 4)) session.undo();
  ImGui::EndDisabled();
  ImGui::SameLine();
  ImGui::BeginDisabled(!session.can_redo());
  if (wide_button("Redo", 4)) session.redo();
  ImGui::EndDisabled();
  ImGui::SameLine();
  if (wide_button("Save...", 4)) ui.question = FileQuestion::kSavePicture;
  ImGui::SameLine();
  if (wide_button("Keys", 4)) ui.has_help = !ui.has_help;
}

void draw_side_panel(Session& session, Jobs& jobs, Ui& ui) {
  const float left = static_cast<float>(ui.view.x + ui.view.width);
  const ImVec2 all = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({left, 0});
  ImGui::SetNextWindowSize({all.x - left, all.y});
  ImGui::Begin("panel", nullptr,
               ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                   ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_NoNav);
  draw_undo(session, ui);
  if (begin_section("Files")) draw_files(session, ui);
  if (begin_section("View")) draw_view(session, ui);
  if (begin_section("Look")) draw_looks(session, ui);
  if (begin_section("Section", session.model() != nullptr))
    draw_sections(session, ui);
  if (begin_section("Measure")) draw_measures(session, jobs, ui);
  if (begin_section("Combine", session.state().parts.size() > 1))
    draw_booleans(session, ui);
  if (begin_section("Save")) draw_saving(session, ui);
  ImGui::End();
}

std::string status_of(Session& session, const Ui& ui) {
  if (!session.model()) return session.is_loading() ? "Loading" : "";
  const io::LoadedScene& loaded = session.model()->loaded;
  std::string text =
      fmt::format("{} polygons", loaded.file.scene.polygon_count());
  if (loaded.report.moved > 0)
    text += fmt::format("; import rounded {} coordinates, by {:.2g} at most",
                        loaded.report.moved, loaded.report.max_move);
  if (!ui.note.empty()) text = ui.note + "   |   " + text;
  return text;
}

void draw_status_line(Session& session, const Ui& ui) {
  const ImVec2 all = ImGui::GetIO().DisplaySize;
  const auto top = static_cast<float>(ui.view.y + ui.view.height);
  ImGui::SetNextWindowPos({0, top});
  ImGui::SetNextWindowSize({static_cast<float>(ui.view.width), all.y - top});
  ImGui::PushStyleVar(
      ImGuiStyleVar_WindowPadding,
      {12 * static_cast<float>(ui.scale), 4 * static_cast<float>(ui.scale)});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});
  ImGui::Begin("status", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav);
  ImGui::TextDisabled("%s", status_of(session, ui).c_str());
  ImGui::End();
  ImGui::PopStyleVar(2);
}

}  // namespace

void draw_panels(Session& session, Jobs& jobs, Ui& ui) {
  if (ui.closes_popups) ImGui::ClosePopupToLevel(0, true);
  ui.closes_popups = false;
  if (ui.has_panel && !ui.is_fullscreen) draw_side_panel(session, jobs, ui);
  if (!ui.is_fullscreen) draw_status_line(session, ui);
  draw_file_question(session, jobs, ui);
  ui.has_popup = ImGui::IsPopupOpen(
      "", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
}

}  // namespace halfspace::viewer
