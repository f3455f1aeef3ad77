#include "halfspace/polygon.hpp"

#include <algorithm>

namespace halfspace {

std::vector<EdgeName> rotated_to_least(std::vector<EdgeName> edges) {
  std::rotate(edges.begin(), std::min_element(edges.begin(), edges.end()),
              edges.end());
  return edges;
}

}  // namespace halfspace
