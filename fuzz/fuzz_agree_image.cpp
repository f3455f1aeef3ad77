#include "definition.hpp"
#include "fuzz.hpp"
#include "halfspace/ref/painter.hpp"
#include "halfspace/ref/raycast.hpp"
#include "halfspace/ref/render.hpp"
#include "halfspace/ref/zbuffer.hpp"
#include "shapes.hpp"
#include "viewpoints.hpp"

namespace halfspace {
namespace {

/// The camera, the scene and the options that the bytes mean.
SceneFile view_of(fuzz::Bytes& bytes) {
  generate::ViewRecipe view;
  view.eye = static_cast<generate::EyeKind>(bytes.below(5));
  view.aim = static_cast<generate::AimKind>(bytes.below(5));
  view.near = static_cast<generate::NearKind>(bytes.below(3));
  const int flags = bytes.below(8);
  view.perspective = (flags & 1) == 0;
  view.cull = (flags & 2) != 0;
  view.gouraud = (flags & 4) != 0;
  view.other = bytes.below(24);
  view.edge = bytes.below(12);
  view.width_px = 1 + bytes.below(16);
  view.height_px = 1 + bytes.below(12);
  view.numbers = bytes.numbers(12);
  generate::SceneRecipe scene;
  scene.stretch = static_cast<generate::Stretch>(bytes.below(4));
  const int more = bytes.below(4);
  scene.jitter = (more & 1) != 0;
  scene.corner_colors = (more & 2) != 0;
  while (!bytes.empty() && scene.shapes.size() < 10) {
    const auto kind = static_cast<generate::ShapeKind>(bytes.below(10));
    const int other = bytes.below(24);
    scene.shapes.push_back({kind, other, bytes.numbers(9)});
  }
  return generate::make(generate::make(scene), view);
}

}  // namespace
}  // namespace halfspace

/// The four algorithms of the reference, and the definition read pixel by
/// pixel, give one image, whatever the tree.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  using namespace halfspace;
  fuzz::Bytes bytes(data, size);
  BuildOptions options;
  options.rule = static_cast<RootRule>(bytes.below(9));
  options.candidates = 1 + static_cast<std::uint32_t>(bytes.below(6));
  options.seed = bytes.next();
  const SceneFile view = view_of(bytes);
  const std::string text = write_scene(view);
  const auto tree = ref::build(view.scene, options);
  const auto span = ref::render(view.scene, tree, *view.camera, view.options);
  const auto painter = ref::paint(view.scene, tree, *view.camera, view.options);
  const auto zbuffer = ref::zbuffer(view.scene, *view.camera, view.options);
  const auto rays = ref::raycast(view.scene, *view.camera, view.options);
  HALFSPACE_FUZZ_EXPECT(span.items == painter.items, text);
  HALFSPACE_FUZZ_EXPECT(span.items == zbuffer.items, text);
  HALFSPACE_FUZZ_EXPECT(span.items == rays.items, text);
  HALFSPACE_FUZZ_EXPECT(
      span.items ==
          definition::item_image(view.scene, *view.camera, view.options),
      text);
  const auto colors =
      definition::color_image(view.scene, *view.camera, view.options);
  HALFSPACE_FUZZ_EXPECT(span.colors == colors, text);
  HALFSPACE_FUZZ_EXPECT(painter.colors == colors, text);
  HALFSPACE_FUZZ_EXPECT(zbuffer.colors == colors, text);
  HALFSPACE_FUZZ_EXPECT(rays.colors == colors, text);
  // The scene file says it all: what it holds gives the image again.
  const auto read = read_scene(text);
  HALFSPACE_FUZZ_EXPECT(read.has_value() && *read == view, text);
  return 0;
}
