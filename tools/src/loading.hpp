#pragma once

#include <optional>
#include <string>

#include "halfspace/io/load_scene.hpp"

namespace CLI {
class App;
}

namespace halfspace::tools {

/// What import did, in words.
std::string to_string(const io::ImportReport& report);

/// Adds --grid, which asks for `bits`.
void add_grid_option(CLI::App& app, std::optional<int>& bits);

}  // namespace halfspace::tools
