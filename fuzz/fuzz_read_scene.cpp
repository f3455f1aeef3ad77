#include "fuzz.hpp"
#include "halfspace/scene_file.hpp"

/// What is read from any text is written so that it reads back the same, and
/// is written the same again; what is refused is refused with a reason.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  using namespace halfspace;
  const auto file = read_scene(fuzz::text_of(data, size));
  if (!file) {
    HALFSPACE_FUZZ_EXPECT(!file.error().message.empty());
    return 0;
  }
  const std::string text = write_scene(*file);
  const auto again = read_scene(text);
  HALFSPACE_FUZZ_EXPECT(again.has_value(), text);
  HALFSPACE_FUZZ_EXPECT(*again == *file, text);
  HALFSPACE_FUZZ_EXPECT(write_scene(*again) == text, text);
  // It is valid by its own account, and by that of the makers.
  const auto scene = make_scene(file->scene.data());
  HALFSPACE_FUZZ_EXPECT(scene.has_value() && *scene == file->scene, text);
  if (file->camera) {
    const auto camera =
        make_camera(file->camera->data(), file->scene.grid_bits());
    HALFSPACE_FUZZ_EXPECT(camera.has_value() && *camera == *file->camera, text);
  }
  return 0;
}
