#include "cli/uncut_loading.hpp"

#include <new>

#include "cli/loading.hpp"
#include "halfspace/viewer/model.hpp"

namespace halfspace::tools {

Result<io::LoadedScene> load_uncut(const std::string& path,
                                   const io::ImportOptions& options) {
  if (!viewer::is_view_name(path)) return load(path, options);
  try {
    return viewer::load_view(path, viewer::Sections::kByPlanes);
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::kOutOfRange,
                 path + ": there is not enough memory to read it"};
  }
}

}  // namespace halfspace::tools
