#include "ours.hpp"

#include "timing.hpp"

namespace halfspace::bench {
namespace {

template <class T>
std::size_t bytes_of(const std::vector<T>& list) {
  return list.capacity() * sizeof(T);
}

}  // namespace

Built build_tree(const Scene& scene) {
  Built built;
  const double start = process_ms();
  built.tree = fast::build(scene, BuildOptions{});
  built.build_ms = process_ms() - start;
  built.stats = fast::stats(built.tree);
  built.bytes = bytes_of(built.tree.nodes) + bytes_of(built.tree.fragments) +
                bytes_of(built.tree.corners) +
                bytes_of(built.tree.cut_vertices) +
                bytes_of(built.tree.free_planes);
  return built;
}

}  // namespace halfspace::bench
