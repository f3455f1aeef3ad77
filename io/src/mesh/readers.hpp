#pragma once

#include <filesystem>
#include <string_view>

#include "halfspace/io/mesh.hpp"
#include "halfspace/io/stop.hpp"
#include "halfspace/result.hpp"

namespace halfspace::io {

/// The mesh that `bytes` hold in each format, as read_mesh() says.
/// Errors: also kStopped.
Result<Mesh> read_obj(std::string_view bytes, const Stop& stop);
Result<Mesh> read_stl(std::string_view bytes, const Stop& stop);
Result<Mesh> read_ply(std::string_view bytes, const Stop& stop);
Result<Mesh> read_off(std::string_view bytes, const Stop& stop);
Result<Mesh> read_3mf(std::string_view bytes, const Stop& stop);

/// The same of a GLB or a .gltf; buffers beside it are read from the folder,
/// and are an error where it is null.
Result<Mesh> read_gltf(std::string_view bytes,
                       const std::filesystem::path* folder, const Stop& stop);

/// Reads the files of materials that an OBJ names, from its folder. Whatever is
/// wrong with them is noted, and they are left out of `files`; without a folder
/// all are.
void add_materials(const std::filesystem::path* folder, Mesh& mesh);

}  // namespace halfspace::io
