#include "halfspace/fast/splitter.hpp"

#include "halfspace/assert.hpp"
#include "tree/choose_root.hpp"

namespace halfspace::fast {

std::size_t choose_root(const Scene& scene,
                        const std::vector<Fragment>& polygons,
                        const BuildOptions& options, std::uint64_t key,
                        FilterStats& stats) {
  HALFSPACE_ASSERT(!polygons.empty());
  HALFSPACE_ASSERT(options.candidates >= 1);
  return choose_root(
      polygons.size(), options, key,
      [&](std::size_t i, std::size_t j) {
        return relation(scene, polygons[j], polygons[i].source, stats);
      },
      [] { return true; });
}

}  // namespace halfspace::fast
