#pragma once

#include <deque>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "halfspace/result.hpp"
#include "mesh/glb/gltf_json.hpp"

namespace halfspace::io {

/// A glTF 2.0 as it comes: its JSON, and the bytes that it speaks of.
struct GltfFile {
  Json json;
  /// By the file's number of them: each as long as the file says, or longer.
  std::vector<std::string_view> buffers;
  /// The bytes of those that are not in the file as they are.
  std::deque<std::string> owned;
  /// The files beside it that were read, or that its images are.
  std::vector<std::filesystem::path> files;
  /// The folder that these are in; nothing where they are not read.
  std::optional<std::filesystem::path> folder;
};

/// A file's name from a URI, in which bytes may be given as %20 (RFC 3986).
std::string name_of_uri(std::string_view uri);

/// Whether a URI names something that is not in the folder of the file or below
/// it, as its dots and %2e tell: a reader opens no such file.
bool leads_elsewhere(std::string_view uri);

/// The bytes of a URI `data:...;base64,...`; nothing where it is none.
std::optional<std::string> bytes_of_data_uri(std::string_view uri);

/// The file that `bytes` are: a GLB, or the JSON of a .gltf, whose buffers are
/// in base64 or in files of `folder`; these are not read where it is null.
///
/// Errors: kUnknownFormat, kTruncated, kSyntax, kOutOfRange, kUnreadable.
Result<GltfFile> gltf_file(std::string_view bytes,
                           const std::filesystem::path* folder);

}  // namespace halfspace::io
