#pragma once

struct ImFont;

namespace halfspace::viewer {

/// Adds the letters that the panels take: DejaVu Sans, or what else there is;
/// ImGui's own where no font file is found.
void add_fonts(double scale);

/// Colours and spaces of the panels.
void set_style(double scale);

/// Letters of equal width, for numbers and commands; null: there are none.
ImFont* fixed_font();

}  // namespace halfspace::viewer
