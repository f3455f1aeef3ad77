#include "halfspace/io/picture.hpp"

namespace halfspace::io {
namespace {

Error no_png_here(const std::filesystem::path& path) {
  return {ErrorCode::kUnwritable,
          path.string() +
              ": cannot be written: this build writes no PNG; take the pixels",
          -1};
}

}  // namespace

Result<Done> write_png(const std::filesystem::path& path, const ColorImage&,
                       const std::optional<PartOfPicture>&, int) {
  return no_png_here(path);
}

Result<Done> write_png_cut_out(const std::filesystem::path& path,
                               const ColorImage&, const CoverageImage&, int) {
  return no_png_here(path);
}

}  // namespace halfspace::io
