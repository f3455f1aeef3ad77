#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "figure/figures.hpp"
#include "halfspace/camera.hpp"
#include "halfspace/drawing.hpp"
#include "halfspace/fast/drawing.hpp"
#include "halfspace/io/figure.hpp"
#include "halfspace/result.hpp"
#include "halfspace/scene.hpp"

/// What is drawn with a scene and hidden by it: lines, points and texts.
namespace halfspace::tools {

/// A text at a point of space. It is seen where the point is.
struct NoteText {
  std::size_t point = 0;  ///< of Notes::points
  std::string text;
  std::string class_of;
  bool beside = false;  ///< to the right of the point, else centred on it
};

struct Notes {
  std::vector<GivenLine> lines;
  std::vector<GridPoint> points;
  std::vector<std::size_t> marks;  ///< points that are marked
  std::vector<NoteText> texts;
  bool empty() const { return lines.empty() && points.empty(); }
};

/// Reads a file of notes, in the model's units: `line X Y Z X Y Z`,
/// `point X Y Z`, `text X Y Z WORDS`, `point X Y Z WORDS`; # begins a comment.
///
/// Errors: of the file; kSyntax, and kOutOfRange for points beyond the scene's
///         grid, with the line.
Result<Notes> read_notes(const std::string& path, const Scene& scene);

/// Adds three axes along edges of the box round a scene, those that are
/// farthest out in a view, with ticks, numbers and names. Nothing for an empty
/// scene.
void add_axes(Notes& notes, const Scene& scene, const Camera& camera);

/// Adds what is seen of notes to a figure. `drawing` has the notes' lines and
/// points, in their order. Units: `text_size` and `style` those of the figure.
void add_notes(io::Figure& figure, const fast::Drawing& drawing,
               const Notes& notes, double text_size, const StrokeStyle& style,
               const Placing& placing);

}  // namespace halfspace::tools
