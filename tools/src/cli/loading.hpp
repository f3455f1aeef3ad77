#pragma once

#include <optional>
#include <string>

#include "halfspace/io/load_scene.hpp"

namespace CLI {
class App;
}

namespace halfspace::tools {

/// io::load_scene(), or for a `.view` file the scene that it shows, of which a lack of memory is an error, too.
/// Errors: kOutOfRange (not enough memory), and those of load_scene().
Result<io::LoadedScene> load(const std::string& path,
                             const io::ImportOptions& options);

/// What import did, in words.
std::string to_string(const io::ImportReport& report);

/// Adds --grid, which asks for `bits`.
void add_grid_option(CLI::App& app, std::optional<int>& bits);

}  // namespace halfspace::tools
