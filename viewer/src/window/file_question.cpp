#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <vector>

#include "core/combine.hpp"
#include "core/saving.hpp"
#include "halfspace/io/figure.hpp"
#include "halfspace/io/file.hpp"
#include "window/ui.hpp"

namespace halfspace::viewer {
namespace {

namespace fs = std::filesystem;

/// More names than anybody reads in a list.
constexpr std::size_t kMostNames = 2000;

/// The folder that is shown, as long as a question is asked.
struct Browser {
  FileQuestion question = FileQuestion::kNone;
  fs::path folder;
  std::vector<std::string> folders, files;
  std::string name;
  std::string fault;
};

Browser& browser() {
  static Browser kept;
  return kept;
}

bool is_reading(FileQuestion question) {
  return question == FileQuestion::kOpen || question == FileQuestion::kAdd;
}

bool is_shown_file(const fs::path& path) {
  std::string name = path.filename().string();
  std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) {
    return static_cast<char>(std::tolower(c));
  });
  if (name.ends_with(".gz")) name.resize(name.size() - 3);
  for (const char* end : {".stl", ".obj", ".ply", ".off", ".3mf", ".glb",
                          ".gltf", ".hsolid", ".scene", ".view"}) {
    if (name.ends_with(end)) return true;
  }
  return false;
}

void look_into(Browser& b, const fs::path& folder) {
  std::error_code code;
  b.folder = fs::absolute(folder, code).lexically_normal();
  b.folders.clear();
  b.files.clear();
  b.fault.clear();
  fs::directory_iterator entries(b.folder, code);
  if (code) b.fault = b.folder.string() + ": " + code.message();
  for (; !code && entries != fs::directory_iterator();
       entries.increment(code)) {
    const std::string name = entries->path().filename().string();
    if (name.starts_with('.')) continue;
    std::error_code unknown;
    if (entries->is_directory(unknown))
      b.folders.push_back(name);
    else if (is_shown_file(name))
      b.files.push_back(name);
    if (b.folders.size() + b.files.size() >= kMostNames) break;
  }
  std::sort(b.folders.begin(), b.folders.end());
  std::sort(b.files.begin(), b.files.end());
}

const char* title_of(FileQuestion question) {
  switch (question) {
    case FileQuestion::kOpen:
      return "Open";
    case FileQuestion::kAdd:
      return "Open beside these";
    case FileQuestion::kSavePicture:
      return "Save the picture";
    case FileQuestion::kSaveView:
      return "Save the view";
    case FileQuestion::kExport:
      return "Export the solid";
    case FileQuestion::kSaveFilm:
      return "Save the film of a turn";
    case FileQuestion::kNone:
      break;
  }
  return "";
}

const char* hint_of(FileQuestion question) {
  switch (question) {
    case FileQuestion::kSavePicture:
      return ".png; .svg, .pdf, .eps drawn; .npy polygon ids; .scene";
    case FileQuestion::kSaveView:
      return ".view: files, looks and camera";
    case FileQuestion::kExport:
      return ".stl, .off, .obj or .ply";
    case FileQuestion::kSaveFilm:
      return "a .png a frame: %03d is its number";
    default:
      return "";
  }
}

std::string first_name(FileQuestion question, const State& state) {
  if (is_reading(question)) return {};
  const std::string stem = fs::path(name_of(state)).stem().string();
  if (question == FileQuestion::kSavePicture) return stem + ".png";
  if (question == FileQuestion::kSaveView) return stem + ".view";
  if (question == FileQuestion::kSaveFilm) return stem + "-%03d.png";
  return stem + "-result.stl";
}

/// Draws a figure beside the pictures, by way of a `.view` file.
Result<Done> begin_figure(Session& session, Background& background,
                          const Ui& ui, const std::string& path) {
  const std::string view_file = path + ".view";
  const auto written = write_state(view_file, session.state());
  if (!written) return written;
  background.start([draw = ui.draw_figure, view_file,
                    path](const Report& report) -> Result<std::string> {
    report("drawing", 0);
    const auto drawn = draw(view_file, path);
    std::error_code ignored;
    fs::remove(view_file, ignored);
    if (!drawn) return drawn.error();
    return "Saved " + path;
  });
  return Done{};
}

/// Saves the picture or the film beside the pictures that follow.
Result<Done> begin_saving(Session& session, Background& background,
                          const Ui& ui, const std::string& path) {
  std::optional<Shown> shown = session.shown();
  if (!shown)
    return Error{ErrorCode::kEmpty, "nothing is shown that could be saved"};
  const bool is_film = ui.question == FileQuestion::kSaveFilm;
  if (!is_film && !is_shown_name(path))
    return Error{ErrorCode::kUnknownFormat, hint_of(ui.question)};
  if (is_film && !(io::has_extension(path, ".png") && numbered_name(path, 0)))
    return Error{ErrorCode::kUnknownFormat,
                 "the name needs one %d or %03d, for the frame's number, and "
                 "must end in .png"};
  background.start(
      [shown = *std::move(shown), path, is_film,
       frames = ui.film_frames](const Report& report) -> Result<std::string> {
        if (!is_film) report("saving " + path, 0);
        const auto saved = is_film ? save_film(shown, path, frames, report)
                                   : save_shown(shown, path);
        if (!saved) return saved.error();
        return "Saved " + path;
      });
  return Done{};
}

void answer(Session& session, Jobs& jobs, Ui& ui, Browser& b) {
  const std::string path = (b.folder / b.name).string();
  std::error_code code;
  if (fs::is_directory(path, code)) {
    look_into(b, path);
    b.name.clear();
    return;
  }
  if (b.question == FileQuestion::kOpen) session.open({path});
  if (b.question == FileQuestion::kAdd) session.add({path});
  if (b.question == FileQuestion::kSavePicture && io::is_figure_name(path) &&
      ui.draw_figure) {
    const auto begun = begin_figure(session, jobs.saving, ui, path);
    if (!begun) {
      b.fault = begun.error().message;
      return;
    }
    ui.question = FileQuestion::kNone;
    return;
  }
  if (b.question == FileQuestion::kSavePicture ||
      b.question == FileQuestion::kSaveFilm ||
      b.question == FileQuestion::kSaveView) {
    const bool is_view =
        b.question == FileQuestion::kSaveView ||
        (b.question == FileQuestion::kSavePicture && is_view_name(path));
    const auto begun = is_view ? write_state(path, session.state())
                               : begin_saving(session, jobs.saving, ui, path);
    if (!begun) {
      b.fault = begun.error().message;
      return;
    }
    if (is_view) ui.note = "Saved " + path;
  }
  if (b.question == FileQuestion::kExport) {
    const State state = session.state();
    jobs.solids.start([state, path](const Report& report) {
      const auto saved = save_combined(state, path, report);
      return saved ? Result<std::string>("Saved " + path)
                   : Result<std::string>(saved.error());
    });
  }
  ui.question = FileQuestion::kNone;
}

/// Whether a name in the list was chosen.
bool draw_list(Browser& b, float height) {
  bool is_chosen = false;
  fs::path next;
  ImGui::BeginChild("names", {0, height}, true);
  if (b.folder.has_parent_path() && ImGui::Selectable("../"))
    next = b.folder.parent_path();
  for (const std::string& name : b.folders) {
    if (ImGui::Selectable((name + "/").c_str())) next = b.folder / name;
  }
  for (const std::string& name : b.files) {
    if (ImGui::Selectable(name.c_str(), name == b.name,
                          ImGuiSelectableFlags_AllowDoubleClick)) {
      b.name = name;
      is_chosen = ImGui::IsMouseDoubleClicked(0);
    }
  }
  ImGui::EndChild();
  if (!next.empty()) look_into(b, next);
  return is_chosen;
}

}  // namespace

void draw_file_question(Session& session, Jobs& jobs, Ui& ui) {
  Browser& b = browser();
  if (ui.question == FileQuestion::kNone) {
    b.question = FileQuestion::kNone;
    return;
  }
  const bool is_new = b.question != ui.question;
  if (is_new) {
    b.question = ui.question;
    look_into(b, b.folder.empty() ? fs::path(".") : b.folder);
    b.name = first_name(ui.question, session.state());
  }
  const ImVec2 all = ImGui::GetIO().DisplaySize;
  const auto scale = static_cast<float>(ui.scale);
  ImGui::SetNextWindowPos({all.x / 2, all.y / 2}, ImGuiCond_Always,
                          {0.5f, 0.5f});
  ImGui::SetNextWindowSize({std::min(620 * scale, all.x), 0});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 6 * scale);
  ImGui::Begin("file question", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_AlwaysAutoResize);
  ImGui::PopStyleVar();
  ImGui::TextUnformatted(title_of(ui.question));
  ImGui::TextDisabled("%s", b.folder.string().c_str());
  bool is_answered = draw_list(b, std::min(320 * scale, all.y / 2));
  ImGui::SetNextItemWidth(-1);
  if (is_new) ImGui::SetKeyboardFocusHere();
  // One field a question: what is typed in one does not go on in another.
  ImGui::PushID(static_cast<int>(b.question));
  is_answered |=
      ImGui::InputText("##name", &b.name, ImGuiInputTextFlags_EnterReturnsTrue);
  ImGui::PopID();
  if (const char* hint = hint_of(ui.question); *hint != 0)
    ImGui::TextDisabled("%s", hint);
  if (ui.question == FileQuestion::kSaveFilm) {
    ImGui::SetNextItemWidth(140 * scale);
    ImGui::InputInt("frames once round", &ui.film_frames);
    ui.film_frames = std::clamp(ui.film_frames, 2, kMostFilmFrames);
  }
  if (!b.fault.empty())
    ImGui::TextColored({1, 0.6f, 0.5f, 1}, "%s", b.fault.c_str());
  is_answered |= ImGui::Button(is_reading(ui.question) ? "Open" : "Save");
  ImGui::SameLine();
  const bool is_cancelled = ImGui::Button("Cancel");
  ImGui::End();
  if (is_cancelled)
    ui.question = FileQuestion::kNone;
  else if (is_answered && !b.name.empty())
    answer(session, jobs, ui, b);
}

}  // namespace halfspace::viewer
