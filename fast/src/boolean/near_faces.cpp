#include "halfspace/fast/solid/near_faces.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "box/bvh.hpp"

namespace halfspace::fast {
namespace {

/// The box in other steps, rounded outwards; floats hold no more than the
/// greatest.
Box in_steps(const Box& box, double steps) {
  constexpr double kLargestFloat = std::numeric_limits<float>::max();
  // Rounding outwards adds what is below a float, too: half of the greatest
  // leaves room for that.
  const auto held = [](double value) {
    return std::clamp(value, -kLargestFloat / 2, kLargestFloat / 2);
  };
  Box result;
  for (std::size_t k = 0; k < 3; ++k) {
    result.low[k] = rounded_down(held(steps * static_cast<double>(box.low[k])));
    result.high[k] = rounded_up(held(steps * static_cast<double>(box.high[k])));
  }
  return result;
}

}  // namespace

std::vector<std::pair<std::int32_t, std::int32_t>> near_faces(const Solid& a,
                                                              const Solid& b,
                                                              double steps) {
  std::vector<Box> boxes;
  Box all = kEmptyBox;
  boxes.reserve(b.faces.size());
  for (const Face& face : b.faces) {
    boxes.push_back(in_steps(face.box, steps));
    extend(all, boxes.back());
  }
  std::vector<std::int32_t> items(boxes.size());
  std::iota(items.begin(), items.end(), 0);
  const BoxTree tree(
      [&](std::int32_t g) { return boxes[static_cast<std::size_t>(g)]; },
      items);
  std::vector<std::pair<std::int32_t, std::int32_t>> pairs;
  for (std::size_t f = 0; f < a.faces.size(); ++f) {
    const Box box = in_steps(a.faces[f].box, 1);
    if (!overlap(box, all)) continue;
    tree.find(box, [&](std::int32_t g) {
      pairs.emplace_back(static_cast<std::int32_t>(f), g);
    });
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace halfspace::fast
