// Stands for images.cpp where there is no file system: materials keep the names
// of their images.
#include "mesh/images.hpp"

namespace halfspace::io {

void find_images(const std::filesystem::path*, Mesh&) {}
EmbeddedImages embedded_images(const Attributes&, std::vector<std::string>&) {
  return {};
}
Result<std::vector<std::string>> images_beside(const std::filesystem::path&,
                                               const Attributes&) {
  return std::vector<std::string>();
}

}  // namespace halfspace::io
