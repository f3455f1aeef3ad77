#include <algorithm>

#include "halfspace/fast/screen.hpp"

namespace halfspace::fast {

Merged merge(const std::vector<Span>& objects, const std::vector<Span>& unlit) {
  Merged merged;
  auto object = objects.begin();
  for (const Span& line : unlit) {
    while (object != objects.end() && object->last < line.first) ++object;
    // What is left of the unlit segment begins here.
    std::int32_t rest = line.first;
    for (auto o = object; o != objects.end() && o->first <= line.last; ++o) {
      const Span lit = {std::max(o->first, line.first),
                        std::min(o->last, line.last)};
      merged.lit.push_back(lit);
      if (rest < lit.first) merged.unlit.push_back({rest, lit.first - 1});
      rest = lit.last + 1;
    }
    if (rest <= line.last) merged.unlit.push_back({rest, line.last});
  }
  return merged;
}

}  // namespace halfspace::fast
