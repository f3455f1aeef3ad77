#pragma once

#include <SDL.h>
#include <imgui.h>

#include <cfloat>
#include <cstdint>
#include <deque>
#include <vector>

namespace halfspace::viewer {

/// Dear ImGui on SDL: its events go in, its lists of triangles come out through
/// SDL_RenderGeometryRaw. No OpenGL. One at a time.
class ImguiBackend {
 public:
  /// `scale` is that of letters and spaces: 1 for 96 dots an inch.
  ImguiBackend(SDL_Window* window, SDL_Renderer* renderer, double scale);
  ~ImguiBackend();
  ImguiBackend(const ImguiBackend&) = delete;
  ImguiBackend& operator=(const ImguiBackend&) = delete;

  /// Tells ImGui of an event. Mouse positions become pixels of the renderer.
  void handle(const SDL_Event& event);

  /// Begins a frame with the presses and releases since the last one, but with
  /// one of a button or key at most: a quick click is two frames.
  void begin_frame();
  /// Whether presses or releases are left for another frame.
  bool has_pending() const { return !pending_.empty(); }
  /// Where a frame is to be drawn otherwise than the frame before.
  struct Changes {
    bool inside = false;   ///< in lists that stay in an area
    bool outside = false;  ///< in those that do not
  };
  /// Ends what ImGui was told since begin_frame().
  Changes end_frame(const SDL_Rect& area);
  /// Draws what of it is in a region.
  void paint(const SDL_Rect& region);

  /// Renderer pixels in a unit of mouse positions.
  double pixel_ratio() const { return pixel_ratio_; }

 private:
  void make_font_texture();
  void draw(const ImDrawList& list, const ImDrawCmd& command);
  void show_cursor();
  void forget_text();
  void take_pending();

  /// A button or key that went down or up.
  struct Change {
    bool is_key = false;
    int code = 0;
    bool is_down = false;
    ImVec2 at;     ///< of the cursor, for buttons
    int held = 0;  ///< of SDL's modifiers, for keys
  };

  std::deque<Change> pending_;
  std::vector<Change> taken_;  ///< in the frame that begins
  ImVec2 cursor_ = {-FLT_MAX, -FLT_MAX};
  SDL_Window* window_;
  SDL_Renderer* renderer_;
  SDL_Texture* font_texture_ = nullptr;
  SDL_Cursor* cursors_[ImGuiMouseCursor_COUNT] = {};
  ImGuiMouseCursor shown_cursor_ = ImGuiMouseCursor_Arrow;
  double pixel_ratio_ = 1;
  std::uint64_t last_count_ = 0;
  std::uint64_t inside_hash_ = 0, outside_hash_ = 0;
};

}  // namespace halfspace::viewer
