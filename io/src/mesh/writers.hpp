#pragma once

#include <optional>
#include <span>
#include <string>

#include "halfspace/result.hpp"
#include "mesh/format_table.hpp"

namespace halfspace::io {

/// The files of formats that hold the triangles with all attributes that they
/// have room for.
///
/// Errors: kNotFinite (a coordinate beyond floats), kOutOfRange (a GLB of 4 GiB
///         or more), kUnknownFormat (this build has no 3MF).
Result<std::string> glb_bytes(const MeshContent& content);
Result<std::string> gltf_text(const MeshContent& content);
Result<std::string> three_mf_bytes(const MeshContent& content);

/// The error of a coordinate that no float holds.
std::optional<Error> beyond_floats(std::span<const DoublePoint> points);

}  // namespace halfspace::io
