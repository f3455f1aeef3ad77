#pragma once

#include <functional>

#include "core/session.hpp"
#include "window/ui.hpp"

/// Parts of the side panel, and what they share.
namespace halfspace::viewer {

using Edit = std::function<void(State&)>;

/// Changes the state; what one drag of a widget does is undone as one.
void change(Session& session, const Edit& edit);

/// A colour to choose; whether another was chosen.
bool choose_color(const char* name, Rgb& color);

/// Shading, edges, back sides, light, colours, opacity, numbers.
void draw_looks(Session& session, Ui& ui);

}  // namespace halfspace::viewer
