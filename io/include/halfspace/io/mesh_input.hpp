#pragma once

#include <string_view>

#include "halfspace/io/mesh.hpp"
#include "halfspace/result.hpp"

namespace halfspace::io {

/// The mesh that bytes of standard input are: their first ones tell the format.
/// Errors: those of read_mesh(), of kInputName.
Result<Mesh> mesh_of_input(std::string_view bytes);

}  // namespace halfspace::io
