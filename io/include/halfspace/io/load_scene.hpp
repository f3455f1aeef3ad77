#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "halfspace/io/attributes.hpp"
#include "halfspace/io/import.hpp"
#include "halfspace/result.hpp"
#include "halfspace/scene_file.hpp"

namespace halfspace::io {

/// A file that was read: a mesh that was imported, or a scene.
struct LoadedScene {
  SceneFile file;
  /// For each polygon of the scene, the polygon of the file that it is or is a
  /// part of.
  std::vector<PolygonId> polygons;
  ImportReport report;  ///< of a scene file: that nothing was changed
  bool is_scene_file = false;
  std::vector<VertexId> corner_vertices = {};  ///< as Imported has them
  /// The faces of the file with what it says of them; null where that is
  /// nothing.
  std::shared_ptr<const AttributedFaces> attributed = nullptr;
  std::vector<bool> has_color = {};  ///< as Imported has it; of meshes only
};

/// The error with the file's name at the front of its message, unless the name
/// is there already.
Error error_about(const std::string& path, Error error);

/// Whether the name ends in the extension, such as `.png`, in either case.
bool has_extension(const std::filesystem::path& path,
                   std::string_view extension);

/// Whether the name is that of a scene file: whether it ends in `.scene`, or in
/// `.scene.gz`.
bool is_scene_name(const std::filesystem::path& path);

/// Whether the name is that of an exact solid: whether it ends in `.hsolid`, or
/// in `.hsolid.gz`.
bool is_solid_name(const std::filesystem::path& path);

/// The scene in a file, whose name tells whether it is a mesh or a scene file,
/// or for `-` on standard input, whose first bytes tell.
///
/// Exact:  but for the rounding that the report tells of, yes.
/// Errors: those of read_mesh() and import_scene(), or read_scene();
///         kUnreadable (no name); kOutOfRange (a grid is asked for that is not
///         the scene file's own). The message names the file.
Result<LoadedScene> load_scene(const std::string& path,
                               const ImportOptions& options);

/// The same of several files, none of them `-`, in up to `threads` threads at
/// once; 0: as many as the machine has. What is wrong with one of them changes
/// nothing of the others.
std::vector<Result<LoadedScene>> load_scenes(
    const std::vector<std::string>& paths, const ImportOptions& options,
    int threads);

/// What standard input is called in messages.
inline const std::string kInputName = "standard input";

/// The bytes of standard input, unpacked if they are gzipped.
/// Errors: those of read_file().
Result<std::string> read_input();

/// The scene that bytes of standard input are: their first ones tell.
/// Errors: those of load_scene().
Result<LoadedScene> scene_of_input(std::string_view bytes,
                                   const ImportOptions& options);

/// The unit as text, such as `10^-3`.
std::string to_string(const Unit& unit);

}  // namespace halfspace::io
