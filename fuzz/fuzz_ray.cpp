#include <algorithm>

#include "fuzz.hpp"
#include "halfspace/fast/build.hpp"
#include "halfspace/fast/display_tree.hpp"
#include "halfspace/fast/image/lazy_tree.hpp"
#include "halfspace/fast/ray.hpp"
#include "halfspace/ref/ray.hpp"
#include "halfspace/ref/render.hpp"
#include "views.hpp"

namespace halfspace {
namespace {

/// The integer that the words of a hit spell.
ref::Rational to_rational(const RayInteger& words) {
  const bool negative = words.back() >> 63 != 0;
  ref::Rational value = negative ? -1 : 0;
  for (std::size_t k = words.size(); k-- > 0;) {
    value = value * ref::Rational(Int128{1} << 64) +
            ref::Rational(static_cast<Int128>(words[k]));
  }
  return value;
}

bool is_same(const RayHit& hit, const ref::Hit& expected) {
  return hit.polygon == expected.polygon &&
         to_rational(hit.numerator) ==
             expected.parameter * to_rational(hit.denominator);
}

/// A point of the lattice: a corner of the scene or the eye, moved a little or
/// not.
LatticeVector point_of(const SceneFile& view, fuzz::Bytes& bytes) {
  const auto& vertices = view.scene.data().vertices;
  const auto move = bytes.numbers(3);
  const int scale = bytes.below(2) == 0 ? 0 : 1 << bytes.below(10);
  LatticeVector at;
  if (vertices.empty() || bytes.below(5) == 0) {
    if ((*view.camera)->perspective) at = (*view.camera)->eye;
  } else {
    const GridPoint& p =
        vertices[static_cast<std::size_t>(bytes.next()) % vertices.size()];
    constexpr Int128 kStep = Int128{1} << kLatticeBits;
    at = {kStep * p.x, kStep * p.y, kStep * p.z};
  }
  return {at.x + scale * move[0], at.y + scale * move[1],
          at.z + scale * move[2]};
}

void expect_same_hits(const SceneFile& view, const fast::BspTree& tree,
                      const Ray& ray, const std::string& text) {
  const auto expected = ref::all_hits(view.scene, ray);
  const auto found = fast::all_hits(view.scene, tree, ray);
  HALFSPACE_FUZZ_EXPECT(std::equal(found.begin(), found.end(), expected.begin(),
                                   expected.end(), is_same),
                        text);
  const auto first = fast::first_hit(view.scene, tree, ray);
  HALFSPACE_FUZZ_EXPECT(first.has_value() == !expected.empty(), text);
  if (first) HALFSPACE_FUZZ_EXPECT(is_same(*first, expected.front()), text);
  if (ray->reach != Reach::kBetween) return;
  HALFSPACE_FUZZ_EXPECT(
      fast::see_each_other(view.scene, tree, ray) == expected.empty(), text);
}

/// A lazy tree, of which that is built that rays and picks come to.
void expect_same_lazily(const SceneFile& view, const fast::LazyTree& tree,
                        const Ray& ray, const std::string& text) {
  const auto expected = ref::all_hits(view.scene, ray);
  const auto first = fast::first_hit(tree, ray);
  HALFSPACE_FUZZ_EXPECT(first.has_value() == !expected.empty(), text);
  if (first) HALFSPACE_FUZZ_EXPECT(is_same(*first, expected.front()), text);
  if (ray->reach == Reach::kBetween) {
    HALFSPACE_FUZZ_EXPECT(fast::see_each_other(tree, ray) == expected.empty(),
                          text);
  }
  const auto found = fast::all_hits(tree, ray);
  HALFSPACE_FUZZ_EXPECT(std::equal(found.begin(), found.end(), expected.begin(),
                                   expected.end(), is_same),
                        text);
}

}  // namespace
}  // namespace halfspace

/// Rays hit the same by the reference, which asks every polygon, and over trees
/// of three kinds; picks are the item image.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  using namespace halfspace;
  fuzz::Bytes bytes(data, size);
  const BuildOptions build = fuzz::build_options_of(bytes);
  // The rays' bytes come first: those of the scene take what is left.
  const std::uint64_t first = bytes.word();
  const std::uint64_t second = bytes.word();
  const std::uint64_t third = bytes.word();
  const SceneFile view = fuzz::view_of(bytes);
  const std::string text = write_scene(view);
  const fast::BspTree plain = fast::build(view.scene, build);
  fast::DisplayTreeOptions display;
  display.leaf_size = build.candidates;
  display.threads = 1;
  const fast::BspTree other = fast::build_display_tree(view.scene, display);
  fast::LazyTreeOptions lazy;
  lazy.tree = display;
  lazy.cell_size = 1 + build.candidates % 4;
  lazy.most_in_cell = 1 + build.candidates % 5;
  lazy.most_listed = 4;
  const fast::LazyTree opened(view.scene, lazy);
  std::uint8_t rays[24];
  for (std::size_t k = 0; k < 8; ++k) {
    rays[k] = static_cast<std::uint8_t>(first >> 8 * k);
    rays[k + 8] = static_cast<std::uint8_t>(second >> 8 * k);
    rays[k + 16] = static_cast<std::uint8_t>(third >> 8 * k);
  }
  fuzz::Bytes ray_bytes(rays, sizeof rays);
  const LatticeVector from = point_of(view, ray_bytes);
  const LatticeVector to = point_of(view, ray_bytes);
  for (const Reach reach :
       {Reach::kRay, Reach::kSegment, Reach::kBetween, Reach::kLine}) {
    const auto ray =
        make_ray({from, {to.x - from.x, to.y - from.y, to.z - from.z}, reach},
                 view.scene.grid_bits());
    if (!ray) continue;
    expect_same_hits(view, plain, *ray, text);
    expect_same_hits(view, other, *ray, text);
    expect_same_lazily(view, opened, *ray, text);
  }
  const auto image = ref::render(view.scene, ref::build(view.scene, build),
                                 *view.camera, view.options);
  for (std::int32_t j = 0; j < image.items.height_px; ++j) {
    for (std::int32_t i = 0; i < image.items.width_px; ++i) {
      HALFSPACE_FUZZ_EXPECT(
          fast::pick(view.scene, other, *view.camera, view.options, i, j) ==
              image.items.at(i, j),
          text);
      HALFSPACE_FUZZ_EXPECT(fast::pick(opened, *view.camera, view.options, i,
                                       j) == image.items.at(i, j),
                            text);
    }
  }
  return 0;
}
