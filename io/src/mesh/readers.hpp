#pragma once

#include <string_view>

#include "halfspace/io/mesh.hpp"
#include "halfspace/result.hpp"

namespace halfspace::io {

/// The mesh that `bytes` hold in each format, as read_mesh() says.
Result<Mesh> read_obj(std::string_view bytes);
Result<Mesh> read_stl(std::string_view bytes);
Result<Mesh> read_ply(std::string_view bytes);
Result<Mesh> read_off(std::string_view bytes);

}  // namespace halfspace::io
