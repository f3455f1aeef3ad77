#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace halfspace::io {

/// The mesh formats that are read and written.
enum class Format : std::uint8_t {
  kObj,
  kStl,
  kPly,
  kOff,
  k3mf,
  kGlb,
  kGltf  ///< its JSON; written with the bytes in base64
};

/// The format that the end of a file's name tells, such as `.obj`, in either
/// case and before an optional `.gz`; nothing for any other name.
std::optional<Format> format_of(const std::filesystem::path& path);

/// Whether the format has coordinates in floats, and triangles alone.
bool has_floats(Format format);

/// The formats' extensions as a list for messages, such as
/// `.obj, .stl, .ply, .off, .3mf, .glb or .gltf`; `other`, if it is not empty,
/// comes last.
std::string format_extensions(std::string_view other = {});

/// The formats' names as a list for messages:
/// `OBJ, STL, PLY, OFF, 3MF, GLB, glTF`.
std::string format_names();

}  // namespace halfspace::io
