#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/session.hpp"

namespace halfspace::viewer {

/// Writes what is shown to a file; the end of its name says what: `.png` the
/// picture, `.npy` the polygon at each pixel, `.scene` the scene with its
/// camera. For any thread.
///
/// Errors: kUnwritable; kUnknownFormat; kOutOfRange (too many lines).
Result<Done> save_shown(const Shown& shown, const std::string& path);

/// Whether save_shown() knows the end of the name.
bool is_shown_name(const std::string& path);

/// The most frames of a film.
constexpr std::int32_t kMostFilmFrames = 100'000;

/// The name with the number in place of its `%d` or `%03d`; nothing where it
/// has not exactly one of those.
std::optional<std::string> numbered_name(const std::string& name,
                                         std::int64_t number);

/// Writes the film of one turn, frame by frame: what `halfspace render
/// --turntable` makes of the state's `.view` file.
///
/// Requires: 1 <= frames <= kMostFilmFrames; numbered_name(name, 0).
/// Errors: those of save_shown(); kBadCamera, kOutOfRange (a camera on the way
///         is none); kStopped.
Result<Done> save_film(const Shown& shown, const std::string& name,
                       std::int32_t frames, const Report& report);

}  // namespace halfspace::viewer
