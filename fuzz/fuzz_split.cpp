#include <algorithm>
#include <vector>

#include "definition/definition.hpp"
#include "halfspace/fast/split.hpp"
#include "halfspace/ref/split.hpp"
#include "views.hpp"

namespace halfspace {
namespace {

/// A fragment, as everyone has it.
struct Fragments {
  ref::Fragment reference;
  fast::Fragment fast;
  FragmentName definition;
};

/// The polygons' planes, as those have them that need them.
struct Planes {
  std::vector<ref::Plane> reference;
  std::vector<definition::Plane> definition;
};

/// Compares the relation to the plane of `q`, and the parts where it spans;
/// goes on with one of them.
void cut(const Scene& scene, const Planes& planes, Fragments& fragment,
         PolygonId q, bool keep_up, const fuzz::Shown& text) {
  fast::FilterStats stats;
  const auto& plane = planes.reference[static_cast<std::size_t>(q)];
  const Relation relation = ref::relation(fragment.reference, plane);
  HALFSPACE_FUZZ_EXPECT(
      fast::relation(scene, fragment.fast, q, stats) == relation, text);
  HALFSPACE_FUZZ_EXPECT(
      definition::relation(definition::points_of(scene, fragment.definition),
                           planes.definition[static_cast<std::size_t>(q)]) ==
          relation,
      text);
  if (relation != Relation::kSpanning) return;
  const auto parts = ref::split(fragment.reference, plane, q);
  const auto others = fast::split(scene, fragment.fast, q, stats);
  const auto said = definition::split(scene, fragment.definition, q);
  HALFSPACE_FUZZ_EXPECT(ref::name_of(parts.positive) == said.positive, text);
  HALFSPACE_FUZZ_EXPECT(ref::name_of(parts.negative) == said.negative, text);
  HALFSPACE_FUZZ_EXPECT(fast::name_of(others.positive) == said.positive, text);
  HALFSPACE_FUZZ_EXPECT(fast::name_of(others.negative) == said.negative, text);
  fragment = keep_up
                 ? Fragments{parts.positive, others.positive, said.positive}
                 : Fragments{parts.negative, others.negative, said.negative};
}

}  // namespace
}  // namespace halfspace

/// Polygons are cut by planes in any order: reference, fast library and
/// definition give the same relations and the same parts.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  using namespace halfspace;
  if (size < 8) return 0;
  // The cuts come first, so that they stay where shapes are added.
  fuzz::Bytes order(data, 8);
  fuzz::Bytes bytes(data + 8, size - 8);
  const auto made = generate::make(fuzz::scene_recipe_of(bytes));
  const Scene& scene = made.scene;
  const auto count = static_cast<PolygonId>(scene.polygon_count());
  if (count == 0) return 0;
  const SceneFile view{scene, std::nullopt, {}};
  const fuzz::Shown text{view};
  const std::uint64_t which = order.word();
  Planes planes;
  for (PolygonId p = 0; p < count; ++p) {
    planes.reference.push_back(ref::plane_of(ref::whole(scene, p).vertices));
    planes.definition.push_back(definition::plane_of(scene, p));
  }
  for (PolygonId p = 0; p < count; ++p) {
    Fragments fragment{ref::whole(scene, p), fast::whole(scene, p),
                       definition::whole(scene, p)};
    // More would be beside the fragment.
    for (PolygonId k = 0; k < std::min(count, PolygonId{8}); ++k) {
      const std::uint64_t choice = mix(which + static_cast<unsigned>(k));
      const auto q =
          static_cast<PolygonId>(choice % static_cast<std::uint64_t>(count));
      cut(scene, planes, fragment, q, choice >> 63 != 0, text);
    }
  }
  return 0;
}
