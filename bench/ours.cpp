#include "ours.hpp"

#include <functional>

#include "halfspace/fast/display_tree.hpp"
#include "timing.hpp"

namespace halfspace::bench {
namespace {

Built timed(const std::function<fast::BspTree()>& build) {
  Built built;
  const double start = process_ms();
  built.tree = build();
  built.build_ms = process_ms() - start;
  built.stats = fast::stats(built.tree);
  built.bytes = fast::bytes_of(built.tree);
  return built;
}

}  // namespace

Built build_for_display(const Scene& scene) {
  return timed([&scene] {
    fast::DisplayTreeOptions options;
    options.threads = 1;
    return fast::build_display_tree(scene, options);
  });
}

Built build_by_rule(const Scene& scene, const BuildOptions& options) {
  return timed([&] { return fast::build(scene, options); });
}

}  // namespace halfspace::bench
