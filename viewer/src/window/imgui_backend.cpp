#include "window/imgui_backend.hpp"

#include <imgui_internal.h>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <iterator>

#include "window/fonts.hpp"

namespace halfspace::viewer {
namespace {

const char* clipboard_text(void* kept) {
  char*& text = *static_cast<char**>(kept);
  SDL_free(text);
  text = SDL_GetClipboardText();
  return text;
}

void set_clipboard_text(void*, const char* text) { SDL_SetClipboardText(text); }

char* kept_clipboard_text = nullptr;

void set_key_map(ImGuiIO& io) {
  constexpr struct {
    ImGuiKey key;
    SDL_Scancode code;
  } kKeys[] = {{ImGuiKey_Tab, SDL_SCANCODE_TAB},
               {ImGuiKey_LeftArrow, SDL_SCANCODE_LEFT},
               {ImGuiKey_RightArrow, SDL_SCANCODE_RIGHT},
               {ImGuiKey_UpArrow, SDL_SCANCODE_UP},
               {ImGuiKey_DownArrow, SDL_SCANCODE_DOWN},
               {ImGuiKey_PageUp, SDL_SCANCODE_PAGEUP},
               {ImGuiKey_PageDown, SDL_SCANCODE_PAGEDOWN},
               {ImGuiKey_Home, SDL_SCANCODE_HOME},
               {ImGuiKey_End, SDL_SCANCODE_END},
               {ImGuiKey_Insert, SDL_SCANCODE_INSERT},
               {ImGuiKey_Delete, SDL_SCANCODE_DELETE},
               {ImGuiKey_Backspace, SDL_SCANCODE_BACKSPACE},
               {ImGuiKey_Space, SDL_SCANCODE_SPACE},
               {ImGuiKey_Enter, SDL_SCANCODE_RETURN},
               {ImGuiKey_Escape, SDL_SCANCODE_ESCAPE},
               {ImGuiKey_KeyPadEnter, SDL_SCANCODE_KP_ENTER},
               {ImGuiKey_A, SDL_SCANCODE_A},
               {ImGuiKey_C, SDL_SCANCODE_C},
               {ImGuiKey_V, SDL_SCANCODE_V},
               {ImGuiKey_X, SDL_SCANCODE_X},
               {ImGuiKey_Y, SDL_SCANCODE_Y},
               {ImGuiKey_Z, SDL_SCANCODE_Z}};
  for (const auto& [key, code] : kKeys) io.KeyMap[key] = code;
}

/// Eight bytes at a time, as splitmix64 mixes them.
std::uint64_t hash_of(const void* data, std::size_t bytes, std::uint64_t hash) {
  const char* at = static_cast<const char*>(data);
  while (bytes > 0) {
    const std::size_t count = std::min(bytes, sizeof(std::uint64_t));
    std::uint64_t word = count;
    std::memcpy(&word, at, count);
    hash = (hash ^ word) * 0x9e3779b97f4a7c15u;
    hash ^= hash >> 29;
    at += count;
    bytes -= count;
  }
  return hash;
}

/// The rectangle beyond which the command draws nothing.
SDL_Rect clip_of(const ImDrawCmd& command) {
  const ImVec4& box = command.ClipRect;
  const int left = std::max(0, static_cast<int>(box.x));
  const int top = std::max(0, static_cast<int>(box.y));
  return {left, top, static_cast<int>(box.z) - left,
          static_cast<int>(box.w) - top};
}

}  // namespace

ImguiBackend::ImguiBackend(SDL_Window* window, SDL_Renderer* renderer,
                           double scale)
    : window_(window), renderer_(renderer) {
  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;
  io.BackendPlatformName = "halfspace";
  io.BackendFlags |= ImGuiBackendFlags_HasMouseCursors |
                     ImGuiBackendFlags_RendererHasVtxOffset;
  io.GetClipboardTextFn = clipboard_text;
  io.SetClipboardTextFn = set_clipboard_text;
  io.ClipboardUserData = &kept_clipboard_text;
  set_key_map(io);
  add_fonts(scale);
  set_style(scale);
  constexpr struct {
    ImGuiMouseCursor cursor;
    SDL_SystemCursor system;
  } kCursors[] = {{ImGuiMouseCursor_Arrow, SDL_SYSTEM_CURSOR_ARROW},
                  {ImGuiMouseCursor_TextInput, SDL_SYSTEM_CURSOR_IBEAM},
                  {ImGuiMouseCursor_ResizeAll, SDL_SYSTEM_CURSOR_SIZEALL},
                  {ImGuiMouseCursor_ResizeNS, SDL_SYSTEM_CURSOR_SIZENS},
                  {ImGuiMouseCursor_ResizeEW, SDL_SYSTEM_CURSOR_SIZEWE},
                  {ImGuiMouseCursor_Hand, SDL_SYSTEM_CURSOR_HAND}};
  for (const auto& [cursor, system] : kCursors)
    cursors_[cursor] = SDL_CreateSystemCursor(system);
  make_font_texture();
}

ImguiBackend::~ImguiBackend() {
  ImGui::DestroyContext();
  if (font_texture_ != nullptr) SDL_DestroyTexture(font_texture_);
  for (SDL_Cursor* cursor : cursors_) {
    if (cursor != nullptr) SDL_FreeCursor(cursor);
  }
  SDL_free(kept_clipboard_text);
  kept_clipboard_text = nullptr;
}

void ImguiBackend::make_font_texture() {
  unsigned char* pixels = nullptr;
  int width = 0, height = 0;
  ImGuiIO& io = ImGui::GetIO();
  io.Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
  font_texture_ = SDL_CreateTexture(renderer_, SDL_PIXELFORMAT_ABGR8888,
                                    SDL_TEXTUREACCESS_STATIC, width, height);
  if (font_texture_ == nullptr) return;
  SDL_UpdateTexture(font_texture_, nullptr, pixels, 4 * width);
  SDL_SetTextureBlendMode(font_texture_, SDL_BLENDMODE_BLEND);
  io.Fonts->SetTexID(font_texture_);
}

void ImguiBackend::handle(const SDL_Event& event) {
  ImGuiIO& io = ImGui::GetIO();
  const auto ratio = static_cast<float>(pixel_ratio_);
  switch (event.type) {
    case SDL_MOUSEMOTION:
      cursor_ = {static_cast<float>(event.motion.x) * ratio,
                 static_cast<float>(event.motion.y) * ratio};
      io.MousePos = cursor_;
      break;
    case SDL_MOUSEBUTTONDOWN:
    case SDL_MOUSEBUTTONUP: {
      const auto button = event.button.button;
      const int code = button == SDL_BUTTON_LEFT     ? 0
                       : button == SDL_BUTTON_RIGHT  ? 1
                       : button == SDL_BUTTON_MIDDLE ? 2
                                                     : -1;
      if (code < 0) break;
      pending_.push_back({false,
                          code,
                          event.type == SDL_MOUSEBUTTONDOWN,
                          {static_cast<float>(event.button.x) * ratio,
                           static_cast<float>(event.button.y) * ratio},
                          0});
      break;
    }
    case SDL_MOUSEWHEEL:
      io.MouseWheel += event.wheel.preciseY;
      io.MouseWheelH += event.wheel.preciseX;
      break;
    case SDL_TEXTINPUT:
      io.AddInputCharactersUTF8(event.text.text);
      break;
    case SDL_KEYDOWN:
    case SDL_KEYUP: {
      pending_.push_back({true,
                          static_cast<int>(event.key.keysym.scancode),
                          event.type == SDL_KEYDOWN,
                          {},
                          event.key.keysym.mod});
      break;
    }
    case SDL_WINDOWEVENT:
      if (event.window.event == SDL_WINDOWEVENT_LEAVE)
        io.MousePos = cursor_ = {-FLT_MAX, -FLT_MAX};
      if (event.window.event == SDL_WINDOWEVENT_FOCUS_LOST) {
        pending_.clear();
        std::fill(std::begin(io.KeysDown), std::end(io.KeysDown), false);
      }
      break;
    default:
      break;
  }
}

void ImguiBackend::take_pending() {
  ImGuiIO& io = ImGui::GetIO();
  for (std::size_t taken = 0; !pending_.empty(); ++taken) {
    const Change& change = pending_.front();
    bool& is_down =
        change.is_key ? io.KeysDown[change.code] : io.MouseDown[change.code];
    const auto is_same = [&change](const Change& other) {
      return other.is_key == change.is_key && other.code == change.code;
    };
    if (std::any_of(taken_.begin(), taken_.end(), is_same)) break;
    // What was pressed elsewhere is another frame, too.
    if (!change.is_key && taken > 0 &&
        (io.MousePos.x != change.at.x || io.MousePos.y != change.at.y))
      break;
    if (change.is_key) {
      io.KeyShift = (change.held & KMOD_SHIFT) != 0;
      io.KeyCtrl = (change.held & KMOD_CTRL) != 0;
      io.KeyAlt = (change.held & KMOD_ALT) != 0;
    } else {
      io.MousePos = change.at;
    }
    is_down = change.is_down;
    taken_.push_back(change);
    pending_.pop_front();
  }
  taken_.clear();
}

void ImguiBackend::begin_frame() {
  ImGuiIO& io = ImGui::GetIO();
  io.MousePos = cursor_;
  take_pending();
  int width = 0, height = 0, window_width = 0, window_height = 0;
  SDL_GetRendererOutputSize(renderer_, &width, &height);
  SDL_GetWindowSize(window_, &window_width, &window_height);
  pixel_ratio_ = window_width > 0 ? double(width) / window_width : 1;
  io.DisplaySize = {static_cast<float>(width), static_cast<float>(height)};
  const std::uint64_t now = SDL_GetPerformanceCounter();
  const double passed = static_cast<double>(now - last_count_) /
                        static_cast<double>(SDL_GetPerformanceFrequency());
  io.DeltaTime = static_cast<float>(
      last_count_ == 0 ? 1.0 / 60 : std::clamp(passed, 1e-4, 0.5));
  last_count_ = now;
  SDL_SetRenderDrawBlendMode(renderer_, SDL_BLENDMODE_BLEND);
  show_cursor();
  ImGui::NewFrame();
}

void ImguiBackend::show_cursor() {
  const ImGuiMouseCursor wanted = ImGui::GetMouseCursor();
  if (wanted == shown_cursor_ || wanted < 0) return;
  shown_cursor_ = wanted;
  SDL_Cursor* cursor = cursors_[wanted];
  SDL_SetCursor(cursor != nullptr ? cursor : cursors_[ImGuiMouseCursor_Arrow]);
}

/// ImGui keeps what was typed in a field to be undone there when it is edited
/// again, though the field may hold another text by then: undoing beyond its
/// end is an assertion that fails.
void ImguiBackend::forget_text() {
  ImGuiContext& context = *ImGui::GetCurrentContext();
  if (context.InputTextState.ID != context.ActiveId)
    context.InputTextState.ID = 0;
}

ImguiBackend::Changes ImguiBackend::end_frame(const SDL_Rect& area) {
  ImGui::Render();
  forget_text();
  const ImDrawData& data = *ImGui::GetDrawData();
  std::uint64_t inside = hash_of(&data.DisplaySize, sizeof(ImVec2), 1);
  std::uint64_t outside = inside;
  for (int l = 0; l < data.CmdListsCount; ++l) {
    const ImDrawList& list = *data.CmdLists[l];
    const bool is_inside =
        std::all_of(list.CmdBuffer.begin(), list.CmdBuffer.end(),
                    [&area](const ImDrawCmd& command) {
                      const SDL_Rect clip = clip_of(command);
                      SDL_Rect both;
                      SDL_UnionRect(&clip, &area, &both);
                      return command.ElemCount == 0 ||
                             SDL_RectEquals(&both, &area) == SDL_TRUE;
                    });
    std::uint64_t& hash = is_inside ? inside : outside;
    hash =
        hash_of(list.VtxBuffer.Data,
                static_cast<std::size_t>(list.VtxBuffer.size_in_bytes()), hash);
    hash =
        hash_of(list.IdxBuffer.Data,
                static_cast<std::size_t>(list.IdxBuffer.size_in_bytes()), hash);
    for (const ImDrawCmd& command : list.CmdBuffer)
      hash = hash_of(&command.ClipRect, sizeof command.ClipRect, hash);
  }
  const Changes changes = {inside != inside_hash_, outside != outside_hash_};
  inside_hash_ = inside;
  outside_hash_ = outside;
  return changes;
}

void ImguiBackend::draw(const ImDrawList& list, const ImDrawCmd& command) {
  const ImDrawVert* vertices = list.VtxBuffer.Data + command.VtxOffset;
  const ImDrawIdx* indices = list.IdxBuffer.Data + command.IdxOffset;
  const ImVec2 white = ImGui::GetIO().Fonts->TexUvWhitePixel;
  // Plain areas need no texture: without one SDL fills rectangles as such,
  // which is ten times sooner where it draws by software.
  const auto is_plain = [&](unsigned first) {
    for (unsigned k = first; k < first + 3; ++k) {
      const ImVec2& uv = vertices[indices[k]].uv;
      if (uv.x != white.x || uv.y != white.y) return false;
    }
    return true;
  };
  const auto* bytes = reinterpret_cast<const char*>(vertices);
  constexpr int kStride = sizeof(ImDrawVert);
  for (unsigned first = 0; first < command.ElemCount;) {
    const bool plain = is_plain(first);
    unsigned end = first + 3;
    while (end < command.ElemCount && is_plain(end) == plain) end += 3;
    SDL_RenderGeometryRaw(
        renderer_,
        plain ? nullptr : static_cast<SDL_Texture*>(command.GetTexID()),
        reinterpret_cast<const float*>(bytes + offsetof(ImDrawVert, pos)),
        kStride,
        reinterpret_cast<const SDL_Color*>(bytes + offsetof(ImDrawVert, col)),
        kStride,
        reinterpret_cast<const float*>(bytes + offsetof(ImDrawVert, uv)),
        kStride, list.VtxBuffer.Size - static_cast<int>(command.VtxOffset),
        indices + first, static_cast<int>(end - first), sizeof(ImDrawIdx));
    first = end;
  }
}

void ImguiBackend::paint(const SDL_Rect& region) {
  const ImDrawData& data = *ImGui::GetDrawData();
  for (int l = 0; l < data.CmdListsCount; ++l) {
    const ImDrawList& list = *data.CmdLists[l];
    for (const ImDrawCmd& command : list.CmdBuffer) {
      if (command.UserCallback != nullptr || command.ElemCount == 0) continue;
      const SDL_Rect own = clip_of(command);
      SDL_Rect clip;
      if (SDL_IntersectRect(&own, &region, &clip) == SDL_FALSE) continue;
      SDL_RenderSetClipRect(renderer_, &clip);
      draw(list, command);
    }
  }
  SDL_RenderSetClipRect(renderer_, nullptr);
}

}  // namespace halfspace::viewer
