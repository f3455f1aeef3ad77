#include "solid/dynamic_bvh.hpp"

#include <utility>

namespace halfspace::fast {

void DynamicBvh::add(const Solid& solid, std::int32_t first) {
  std::vector<std::int32_t> faces;
  const auto count = static_cast<std::int32_t>(solid.faces.size());
  gone_.resize(solid.faces.size());
  for (std::int32_t f = first; f < count; ++f) {
    if (!is_gone(f)) faces.push_back(f);
  }
  if (faces.empty()) return;
  int level = 0;
  const auto is_full = [&] {
    return layers_.size() + 1 >= kAlike &&
           layers_[layers_.size() + 1 - kAlike].level == level;
  };
  for (; is_full(); ++level) {
    for (std::size_t i = 1; i < kAlike; ++i) {
      for (const std::int32_t f : layers_.back().faces) {
        if (!is_gone(f)) faces.push_back(f);
      }
      layers_.pop_back();
    }
  }
  BoxTree tree(
      [&](std::int32_t f) -> const Box& {
        return solid.faces[static_cast<std::size_t>(f)].box;
      },
      faces);
  layers_.push_back({std::move(faces), level, std::move(tree)});
}

}  // namespace halfspace::fast
