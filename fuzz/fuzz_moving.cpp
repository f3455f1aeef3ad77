#include "fuzz.hpp"
#include "generate/clip_planes.hpp"
#include "generate/moving_views.hpp"
#include "halfspace/fast/image/flat_scene.hpp"
#include "halfspace/fast/image/moving.hpp"
#include "halfspace/ref/moving.hpp"
#include "halfspace/ref/oracle/zbuffer.hpp"
#include "views.hpp"

/// Moving objects: the reference, the fast library and, where a grid of 54 bits
/// holds it, the z-buffer of the moved polygons give one image.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  using namespace halfspace;
  fuzz::Bytes bytes(data, size);
  const std::uint64_t seed =
      bytes.next() + std::uint64_t{256} * static_cast<unsigned>(bytes.next());
  const SceneFile view = fuzz::view_of(bytes);
  const auto moving = generate::moving_view(view, seed);
  if (!moving) return 0;
  const auto& [assembly, pose, placement, camera] = *moving;
  const std::string text = write_scene(view) + "# " + std::to_string(seed);
  ImageOptions options = view.options;
  options.caps = std::nullopt;
  options.clips = generate::clip_planes(view.scene, seed, seed / 7 % 3);
  const auto expected =
      ref::render_moving(assembly, placement, camera, options);
  fast::DisplayTreeOptions display;
  display.leaf_size = 1 + seed % 5;
  display.threads = 1;
  const auto trees =
      fast::build_moving_trees(assembly, fast::InRegion::kCut, display);
  HALFSPACE_FUZZ_EXPECT(trees.has_value(), text);
  const auto found =
      fast::render_moving(assembly, *trees, placement, camera, options);
  HALFSPACE_FUZZ_EXPECT(found.items == expected.items, text);
  HALFSPACE_FUZZ_EXPECT(found.colors == expected.colors, text);
  if (!ref::check_free(assembly)) return 0;
  const auto flat = ref::flat_scene(assembly, placement, camera);
  const auto same = fast::flat_scene(assembly, placement, camera);
  HALFSPACE_FUZZ_EXPECT(same.has_value() == flat.has_value(), text);
  if (!flat) return 0;
  HALFSPACE_FUZZ_EXPECT(same->ids == flat->ids, text);
  HALFSPACE_FUZZ_EXPECT(same->corners == flat->corners, text);
  HALFSPACE_FUZZ_EXPECT(same->camera == flat->camera, text);
  for (std::size_t k = 0; k < flat->corners.size(); ++k) {
    HALFSPACE_FUZZ_EXPECT(same->scene.point(same->scene.data().corners[k]) ==
                              flat->scene.point(flat->scene.data().corners[k]),
                          text);
  }
  const auto own = flat_options(*flat, options);
  if (!own) return 0;
  auto image = ref::zbuffer(flat->scene, flat->camera, *own);
  for (PolygonId& item : image.items.pixels)
    item = moved_item(assembly, *flat, item);
  HALFSPACE_FUZZ_EXPECT(image.items == expected.items, text);
  HALFSPACE_FUZZ_EXPECT(image.colors == expected.colors, text);
  return 0;
}
