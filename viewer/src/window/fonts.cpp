#include "window/fonts.hpp"

#include <imgui.h>

#include <cmath>
#include <filesystem>
#include <string>

namespace halfspace::viewer {
namespace {

constexpr double kLetterPx = 15;

/// Where Debian and its relations keep them.
constexpr const char* kFolders[] = {"/usr/share/fonts/truetype/dejavu/",
                                    "/usr/share/fonts/truetype/noto/",
                                    "/usr/share/fonts/truetype/liberation/",
                                    "/usr/share/fonts/truetype/liberation2/",
                                    "/usr/share/fonts/dejavu-sans-fonts/",
                                    "/usr/share/fonts/TTF/"};

ImFont* fixed = nullptr;

std::string found(std::initializer_list<const char*> names) {
  for (const char* folder : kFolders) {
    for (const char* name : names) {
      std::error_code code;
      const std::string path = std::string(folder) + name;
      if (std::filesystem::is_regular_file(path, code)) return path;
    }
  }
  return {};
}

/// Latin letters and the signs that the panels write.
constexpr ImWchar kLetters[] = {0x20,   0xff,   0x2013, 0x2026, 0x2190,
                                0x2193, 0x2212, 0x2212, 0x25a0, 0x25cf,
                                0x2715, 0x2717, 0};

ImVec4 color(unsigned rgb, float alpha = 1) {
  return {static_cast<float>(rgb >> 16 & 255) / 255,
          static_cast<float>(rgb >> 8 & 255) / 255,
          static_cast<float>(rgb & 255) / 255, alpha};
}

}  // namespace

void add_fonts(double scale) {
  ImGuiIO& io = ImGui::GetIO();
  const auto size = static_cast<float>(std::round(kLetterPx * scale));
  const std::string plain = found(
      {"DejaVuSans.ttf", "NotoSans-Regular.ttf", "LiberationSans-Regular.ttf"});
  const std::string mono =
      found({"DejaVuSansMono.ttf", "NotoSansMono-Regular.ttf",
             "LiberationMono-Regular.ttf"});
  ImFontConfig config;
  config.OversampleH = 2;
  config.PixelSnapH = true;
  if (plain.empty() || io.Fonts->AddFontFromFileTTF(
                           plain.c_str(), size, &config, kLetters) == nullptr) {
    config.SizePixels = size;
    io.Fonts->AddFontDefault(&config);
  }
  fixed = mono.empty() ? nullptr
                       : io.Fonts->AddFontFromFileTTF(mono.c_str(), size - 1,
                                                      &config, kLetters);
}

ImFont* fixed_font() { return fixed; }

void set_style(double scale) {
  ImGui::StyleColorsDark();
  ImGuiStyle& style = ImGui::GetStyle();
  style.WindowPadding = {14, 12};
  style.FramePadding = {8, 5};
  style.ItemSpacing = {8, 7};
  style.ItemInnerSpacing = {6, 5};
  style.WindowRounding = 0;
  style.PopupRounding = 6;
  style.FrameRounding = 4;
  style.GrabRounding = 4;
  style.ScrollbarRounding = 6;
  style.ScrollbarSize = 11;
  style.WindowBorderSize = 0;
  style.PopupBorderSize = 1;
  style.IndentSpacing = 14;
  style.ScaleAllSizes(static_cast<float>(scale));
  // Text is textured; lines by triangles suit every driver.
  style.AntiAliasedLinesUseTex = false;
  const struct {
    ImGuiCol what;
    ImVec4 value;
  } kColors[] = {{ImGuiCol_WindowBg, color(0x23272e)},
                 {ImGuiCol_ChildBg, color(0x1d2127)},
                 {ImGuiCol_PopupBg, color(0x2a2f37)},
                 {ImGuiCol_Border, color(0x3c434e)},
                 {ImGuiCol_Text, color(0xe4e7eb)},
                 {ImGuiCol_TextDisabled, color(0x8d96a3)},
                 {ImGuiCol_FrameBg, color(0x333a44)},
                 {ImGuiCol_FrameBgHovered, color(0x3e4652)},
                 {ImGuiCol_FrameBgActive, color(0x48515f)},
                 {ImGuiCol_Button, color(0x39414d)},
                 {ImGuiCol_ButtonHovered, color(0x465060)},
                 {ImGuiCol_ButtonActive, color(0x3b82c4)},
                 {ImGuiCol_Header, color(0x2d333c)},
                 {ImGuiCol_HeaderHovered, color(0x3a424e)},
                 {ImGuiCol_HeaderActive, color(0x3b82c4)},
                 {ImGuiCol_CheckMark, color(0x5aa9ec)},
                 {ImGuiCol_SliderGrab, color(0x5aa9ec)},
                 {ImGuiCol_SliderGrabActive, color(0x7fc0f5)},
                 {ImGuiCol_Separator, color(0x3c434e)},
                 {ImGuiCol_TitleBg, color(0x2a2f37)},
                 {ImGuiCol_TitleBgActive, color(0x2a2f37)},
                 {ImGuiCol_PlotHistogram, color(0x5aa9ec)},
                 {ImGuiCol_ScrollbarBg, color(0x23272e)},
                 {ImGuiCol_ScrollbarGrab, color(0x454d5a)},
                 {ImGuiCol_ModalWindowDimBg, color(0x000000, 0.35f)}};
  for (const auto& [what, value] : kColors) style.Colors[what] = value;
}

}  // namespace halfspace::viewer
