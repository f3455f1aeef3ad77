// Stands for read_gltf.cpp and encode_gltf.cpp where nothing may be thrown.
#include "mesh/readers.hpp"
#include "mesh/writers.hpp"

namespace halfspace::io {
namespace {

Error no_glb() {
  return {ErrorCode::kUnknownFormat,
          "this build has no GLB: it was made without a file system", -1};
}

}  // namespace

Result<Mesh> read_gltf(std::string_view, const std::filesystem::path*,
                       const Stop&) {
  return no_glb();
}
Result<std::string> glb_bytes(const MeshContent&) { return no_glb(); }
Result<std::string> gltf_text(const MeshContent&) { return no_glb(); }

}  // namespace halfspace::io
