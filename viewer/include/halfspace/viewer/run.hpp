#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "halfspace/result.hpp"
#include "halfspace/viewer/state.hpp"

namespace halfspace::viewer {

/// How the first view of a scene is chosen, for an image of so many pixels.
using FirstView = std::function<Result<io::ViewOptions>(
    const Scene& scene, std::int32_t width_px, std::int32_t height_px)>;

/// What the window is opened with.
struct WindowOptions {
  State state;
  FirstView first_view;  ///< where the state has no camera
  /// Columns and rows of the picture; the window has room for it.
  std::optional<std::array<std::int32_t, 2>> picture_px;
  double scale = 0;        ///< of letters and panels; 0: as the display says
  bool watch = false;      ///< reads files that change again
  bool headlight = false;  ///< the light follows the eye, when it rests
  std::optional<std::string> play_file;  ///< events to play, then to end
  std::optional<std::string> dump_name;  ///< with %d: pictures of `dump`
  /// Draws a figure of a `.view` file, such as SVG or PDF.
  std::function<Result<Done>(const std::string& view_file,
                             const std::string& output)>
      draw_figure;
  std::optional<std::string> record_file;  ///< where events are written to
};

/// What was seen while the window was open.
struct WindowReport {
  std::size_t events = 0;
  std::size_t frames = 0;       ///< whole pictures that were shown
  double longest_block_ms = 0;  ///< between two looks at the input
  double longest_work_ms = 0;   ///< the same, of the processor
  double median_frame_ms = 0;   ///< from a camera to its whole picture
  double first_window_ms = 0;   ///< from run() to the window's first picture
};

/// Opens the window and returns when it is closed.
///
/// Errors: kUnreadable (no display; a file of events), kSyntax (its line),
///         kUnwritable (a dumped picture).
Result<WindowReport> run(const WindowOptions& options);

}  // namespace halfspace::viewer
