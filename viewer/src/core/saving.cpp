#include "core/saving.hpp"

#include "halfspace/io/file.hpp"
#include "halfspace/io/picture.hpp"
#include "halfspace/scene_file.hpp"

namespace halfspace::viewer {

Result<Done> save_shown(Session& session, const std::string& path) {
  if (is_view_name(path)) return write_state(path, session.state());
  if (!session.model() || !session.camera())
    return Error{ErrorCode::kEmpty, "nothing is shown that could be saved"};
  if (io::has_extension(path, ".png")) {
    const auto picture = session.finished_picture();
    if (!picture) return Error{ErrorCode::kEmpty, "there is no picture yet"};
    return io::write_png(path, *picture);
  }
  if (io::has_extension(path, ".npy"))
    return io::write_npy(path, session.items());
  if (io::is_scene_name(path)) {
    SceneFile file = session.model()->loaded.file;
    file.options = image_options(session.state(), *session.model());
    const auto viewed = io::look_at(file.scene, *session.camera());
    if (!viewed) return viewed.error();
    file.camera = viewed->camera;
    return io::write_file(path, write_scene(file));
  }
  return Error{ErrorCode::kUnknownFormat,
               path + ": the name must end in one of " + kShownEndings};
}

}  // namespace halfspace::viewer
