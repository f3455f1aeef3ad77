#include "core/saving.hpp"

#include <fmt/format.h>

#include <cctype>
#include <numbers>
#include <optional>
#include <utility>

#include "core/picture.hpp"
#include "halfspace/fast/render.hpp"
#include "halfspace/io/file.hpp"
#include "halfspace/io/picture.hpp"
#include "halfspace/scene_file.hpp"

namespace halfspace::viewer {
namespace {

const Scene& scene_of(const Shown& shown) {
  return shown.picture.model->loaded.file.scene;
}

/// The picture with its lines.
Result<ColorImage> drawn(const State& state, PictureRequest picture,
                         PictureMaker& maker) {
  const Lines lines = state.looks.lines;
  if (lines != Lines::kNone) {
    auto drawing = lines_for(picture, lines);
    if (!drawing) return drawing.error();
    picture.lines = *std::move(drawing);
  }
  fast::Rendering rendering;
  maker.draw(picture, 0, picture.camera->height_px, rendering);
  return std::move(rendering.colors);
}

Result<Done> save_picture(const Shown& shown, const std::string& path) {
  if (shown.finished) return io::write_png(path, *shown.finished);
  PictureMaker maker;
  const auto picture = drawn(shown.state, shown.picture, maker);
  if (!picture) return picture.error();
  return io::write_png(path, *picture);
}

}  // namespace

Result<Done> save_shown(const Shown& shown, const std::string& path) {
  if (io::has_extension(path, ".png")) return save_picture(shown, path);
  const PictureRequest& picture = shown.picture;
  if (io::has_extension(path, ".npy")) {
    fast::RenderOptions how;
    how.colors = false;
    return io::write_npy(path,
                         fast::render(scene_of(shown), *picture.model->tree,
                                      picture.camera, picture.options, how)
                             .items);
  }
  if (io::is_scene_name(path)) {
    SceneFile file = picture.model->loaded.file;
    file.options = picture.options;
    file.camera = picture.camera;
    return io::write_file(path, write_scene(file));
  }
  return Error{ErrorCode::kUnknownFormat,
               path + ": the name must end in .png, .npy or .scene"};
}

bool is_shown_name(const std::string& path) {
  return io::has_extension(path, ".png") || io::has_extension(path, ".npy") ||
         io::is_scene_name(path);
}

std::optional<std::string> numbered_name(const std::string& name,
                                         std::int64_t number) {
  std::optional<std::string> result;
  std::size_t copied = 0;
  std::string text;
  for (std::size_t at = name.find('%'); at != std::string::npos;
       at = name.find('%', copied)) {
    std::size_t end = at + 1;
    int digits = 0;
    while (end < name.size() && digits < 20 &&
           std::isdigit(static_cast<unsigned char>(name[end])) != 0)
      digits = 10 * digits + (name[end++] - '0');
    const bool is_padded = end == at + 1 || name[at + 1] == '0';
    if (result || digits >= 20 || !is_padded || end >= name.size() ||
        name[end] != 'd')
      return std::nullopt;
    text += name.substr(copied, at - copied) +
            fmt::format("{:0{}}", number, digits);
    copied = end + 1;
    result = text;
  }
  if (result) *result = text + name.substr(copied);
  return result;
}

Result<Done> save_film(const Shown& shown, const std::string& name,
                       std::int32_t frames, const Report& report) {
  PictureMaker maker;
  for (std::int32_t k = 0; k < frames; ++k) {
    if (!report("saving the film", static_cast<double>(k) / frames))
      return Error{ErrorCode::kStopped, "stopped"};
    const auto view = io::turned_about(*shown.state.camera, {0, 0, 1},
                                       2 * std::numbers::pi * k / frames);
    const auto viewed = io::look_at(scene_of(shown), view);
    if (!viewed) return viewed.error();
    PictureRequest picture = shown.picture;
    picture.camera = viewed->camera;
    const auto image = drawn(shown.state, std::move(picture), maker);
    if (!image) return image.error();
    const auto written = io::write_png(*numbered_name(name, k), *image);
    if (!written) return written;
  }
  return Done{};
}

}  // namespace halfspace::viewer
