#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "halfspace/camera.hpp"
#include "halfspace/image.hpp"
#include "halfspace/result.hpp"
#include "halfspace/scene.hpp"

namespace halfspace {

/// The contents of a `.scene` file (spec/scene-format.md).
struct SceneFile {
  Scene scene;
  std::optional<Camera> camera;
  ImageOptions options;
  friend bool operator==(const SceneFile&, const SceneFile&) = default;
};

/// Reads the text of a `.scene` file.
///
/// Exact:  yes: every number is an integer, and round trips.
/// Errors: kSyntax, kTruncated, kOutOfRange, kBadIndex with the line's number
///         as index and in the message; those of make_scene and make_camera.
/// Cost:   linear; memory at most a small multiple of the text.
Result<SceneFile> read_scene(std::string_view text);

/// The text of a `.scene` file: read_scene(write_scene(f)) == f.
std::string write_scene(const SceneFile& file);

}  // namespace halfspace
