#pragma once

#include <optional>
#include <string>
#include <vector>

#include "halfspace/io/load_scene.hpp"
#include "halfspace/io/mesh.hpp"
#include "halfspace/solid_file.hpp"

namespace CLI {
class App;
}

namespace halfspace::tools {

/// csg::load_scene(), or for a `.view` file the scene that it shows, of which a
/// lack of memory is an error, too.
/// Errors: kOutOfRange (not enough memory), and those of load_scene().
Result<io::LoadedScene> load(const std::string& path,
                             const io::ImportOptions& options);

/// The same; `exact` gets the solid of an exact file.
Result<io::LoadedScene> load_with_solid(const std::string& path,
                                        const io::ImportOptions& options,
                                        std::optional<SolidData>& exact);

/// io::read_mesh(), for `-` of standard input, of which a lack of memory is an
/// error, too.
/// Errors: kOutOfRange (not enough memory), and those of read_mesh() and
///         io::read_input().
Result<io::Mesh> read_mesh_file(const std::string& path);

/// The error of files that do not fit into memory.
Error no_room_for(const std::vector<std::string>& paths);

/// What import did, in words.
std::string to_string(const io::ImportReport& report);

/// Adds --grid, which asks for `bits`.
void add_grid_option(CLI::App& app, std::optional<int>& bits);

}  // namespace halfspace::tools
