#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "halfspace/io/attributes.hpp"
#include "halfspace/io/mesh.hpp"
#include "halfspace/result.hpp"

namespace halfspace::io {

/// Whether files have images, and what surfaces are like: not in a module for
/// the web, of whose size that is some hundred bytes.
#if defined(__wasm__)
inline constexpr bool kHasImages = false;
#else
inline constexpr bool kHasImages = true;
#endif

/// An image that a file of a mesh has inside.
struct EmbeddedImage {
  std::string name;  ///< of letters, digits, `_`, `-` and `.`; no other's
  const char* type;  ///< `image/png` or `image/jpeg`
  std::string bytes;
};

/// The images of materials, each once.
struct EmbeddedImages {
  std::vector<EmbeddedImage> images;
  /// By material its image's place, -1 for none; empty: no material has one.
  std::vector<std::int32_t> of_material;

  std::int32_t at(std::size_t material) const {
    return of_material.empty() ? -1 : of_material[material];
  }
};

/// Whether these are the bytes of a PNG or a JPEG: its media type, or null.
const char* image_type(std::string_view bytes);

/// Finds the images that a mesh's materials name, which are files of the folder
/// or of one within or beside it. Those that are there are the mesh's files.
void find_images(const std::filesystem::path* folder, Mesh& mesh);

/// The images that are to be in a file, read where they are files. Of others,
/// a note says why they are not there.
EmbeddedImages embedded_images(const Attributes& attributes,
                               std::vector<std::string>& notes);

/// What a file at `path` calls the images of materials that are beside it, by
/// material: their paths from its folder. Those that have no file are written,
/// under names that begin as the file's does; no other file is written over.
/// Errors: those of write_file().
Result<std::vector<std::string>> images_beside(
    const std::filesystem::path& path, const Attributes& attributes);

}  // namespace halfspace::io
