#include "halfspace/fast/split.hpp"

#include "halfspace/assert.hpp"
#include "tree/fragment_splitter.hpp"

namespace halfspace::fast {

SplitResult split(const Scene& scene, const Fragment& fragment,
                  PolygonId splitter, FilterStats& stats) {
  StandaloneFragment whole(scene, fragment, stats);
  const FilterPlane plane = filter_plane(plane_of(scene, splitter));
  const Relation relation =
      whole.splitter().relation(whole.ref(), splitter, plane);
  HALFSPACE_ASSERT(relation == Relation::kSpanning);
  const FragmentPair parts =
      whole.splitter().split(whole.ref(), splitter, plane);
  return {whole.fragment_of(parts.positive), whole.fragment_of(parts.negative)};
}

}  // namespace halfspace::fast
