#pragma once

#include <string>

#include "halfspace/io/load_scene.hpp"

namespace halfspace::tools {

/// load(), but of a `.view` file the scene as it is before its sections, which
/// are clip planes of its options (S10).
Result<io::LoadedScene> load_uncut(const std::string& path,
                                   const io::ImportOptions& options);

}  // namespace halfspace::tools
