#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "halfspace/io/import.hpp"
#include "halfspace/result.hpp"
#include "halfspace/scene_file.hpp"

namespace CLI {
class App;
}

namespace halfspace::tools {

/// A file that was read: a mesh that was imported, or a scene.
struct Loaded {
  SceneFile file;
  /// Of each polygon the one in the file that it is, or is a part of.
  std::vector<PolygonId> polygons;
  io::ImportReport report;  ///< of a scene: that nothing was changed
  bool is_scene_file = false;
};

/// The error, the file named at its beginning.
Error about(const std::string& path, Error error);

/// Whether the name ends in the extension, such as `.png`, in capitals or not.
bool has_extension(const std::filesystem::path& path,
                   std::string_view extension);

/// Whether the file's name says that it holds a scene.
bool is_scene_name(const std::filesystem::path& path);

/// The scene in the file.
///
/// Errors: those of read_mesh and import_scene, or read_scene; kOutOfRange
///         where a grid is asked for that is not a scene file's own. The
///         message names the file.
Result<Loaded> load(const std::string& path, const io::ImportOptions& options);

/// The unit in words, such as `10^-3`.
std::string to_string(const Unit& unit);

/// What import did, in words.
std::string to_string(const io::ImportReport& report);

/// Adds --grid, which asks for `bits`.
void add_grid_option(CLI::App& app, std::optional<int>& bits);

}  // namespace halfspace::tools
