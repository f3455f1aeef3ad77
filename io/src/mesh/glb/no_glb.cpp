// Stands for read_glb.cpp and encode_glb.cpp where nothing may be thrown.
#include "mesh/readers.hpp"
#include "mesh/writers.hpp"

namespace halfspace::io {
namespace {

Error no_glb() {
  return {ErrorCode::kUnknownFormat,
          "this build has no GLB: it was made without a file system", -1};
}

}  // namespace

Result<Mesh> read_glb(std::string_view) { return no_glb(); }
Result<std::string> glb_bytes(const MeshContent&) { return no_glb(); }

}  // namespace halfspace::io
