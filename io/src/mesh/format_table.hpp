#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "halfspace/io/format.hpp"
#include "halfspace/io/mesh.hpp"
#include "halfspace/io/stop.hpp"
#include "halfspace/result.hpp"
#include "mesh/encode.hpp"
#include "mesh/images.hpp"

namespace halfspace::io {

/// What a file of a format is made of, whatever it was made from.
struct MeshContent {
  Faces faces;
  std::vector<std::string> texts;                  ///< for formats of text
  std::vector<DoublePoint> doubles;                ///< for formats of bytes
  std::vector<std::array<VertexId, 3>> triangles;  ///< for those of triangles
  /// By triangle its corners, among those of the faces, and its face.
  std::vector<std::array<std::uint32_t, 3>> triangle_corners;
  std::vector<std::uint32_t> triangle_faces;
  const Attributes* attributes = nullptr;  ///< of the faces; null: none
  std::string library;  ///< the OBJ's file of materials; empty: there is none
  /// What the file calls the images of materials, by material; empty: as the
  /// materials say.
  std::vector<std::string> textures;
  EmbeddedImages images;  ///< for formats that have them inside
};

/// Which attributes a format has room for, one bit each.
enum Room : unsigned {
  kMaterialRoom = 1,
  kObjectRoom = 2,
  kGroupRoom = 4,
  kTextureRoom = 8,
  kNormalRoom = 16,
  kCornerColorRoom = 32,
  kCornerNumberRoom = 64,
  kFaceColorRoom = 128,
  kFaceNumberRoom = 256,
  kOriginRoom = 512  ///< for channels of where faces come from
};

/// What of the attributes is not in a format of that room, in words.
std::vector<std::string> lost_words(const Attributes& attributes,
                                    unsigned room);

/// How a format writes coordinates.
enum class Coordinates : std::uint8_t {
  kText,           ///< as decimals
  kTextOrDoubles,  ///< as doubles, or as decimals where those are more exact
  kFloats,         ///< as floats
};

/// A mesh format: how files name it, how it is read and how it is written.
struct FormatEntry {
  Format format;
  std::string_view name;
  std::string_view extension;
  Coordinates coordinates;
  bool has_triangles_only;
  unsigned room;
  /// Files beside the mesh's own are in the folder; null: they are not read.
  Result<Mesh> (*read)(std::string_view bytes,
                       const std::filesystem::path* folder, const Stop& stop);
  Result<std::string> (*encoded)(const MeshContent& content);
};

/// All formats: a new one is an enumerator, an entry, a reader and a writer.
std::span<const FormatEntry> format_table();

/// The format's entry; null for a value that is no enumerator.
const FormatEntry* entry_of(Format format);

}  // namespace halfspace::io
