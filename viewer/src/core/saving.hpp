#pragma once

#include <string>

#include "core/session.hpp"

namespace halfspace::viewer {

/// Writes what is shown to a file; the end of its name says what: `.png` the
/// picture, `.npy` the polygon at each pixel, `.view` the state, `.scene` the
/// scene with its camera.
///
/// Waits for the picture to be whole.
/// Errors: kUnwritable; kUnknownFormat; kEmpty (nothing is shown).
Result<Done> save_shown(Session& session, const std::string& path);

/// The endings that save_shown() knows, for questions.
inline constexpr const char* kShownEndings = ".png .npy .view .scene";

}  // namespace halfspace::viewer
