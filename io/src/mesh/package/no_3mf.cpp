// Stands for read_3mf.cpp and encode_3mf.cpp where their libraries are not.
#include "mesh/readers.hpp"
#include "mesh/writers.hpp"

namespace halfspace::io {
namespace {

Error no_3mf() {
  return {ErrorCode::kUnknownFormat,
          "this build has no 3MF: install libzip-dev and libexpat1-dev, and "
          "build again",
          -1};
}

}  // namespace

Result<Mesh> read_3mf(std::string_view, const Stop&) { return no_3mf(); }
Result<std::string> three_mf_bytes(const MeshContent&) { return no_3mf(); }

}  // namespace halfspace::io
