#pragma once

#include <string>

#include "halfspace/viewer/state.hpp"

namespace halfspace::viewer {

/// Whether options of `halfspace render` say all of the state: one file is
/// seen, as it is, and the camera is known. If not, a `.view` file says it.
bool fits_command_line(const State& state);

/// The command that makes the state's picture, for a shell.
///
/// Exact:    yes: it writes the bytes of the picture that is shown.
/// Requires: fits_command_line(state), or `view_file` names a file that holds
///           the state.
std::string render_command(const State& state, const std::string& output,
                           const std::string& view_file);

/// The text as one word of a POSIX shell.
std::string shell_word(const std::string& text);

}  // namespace halfspace::viewer
