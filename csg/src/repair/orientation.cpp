#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

#include "soup.hpp"

/// Which way the polygons of a soup face.
namespace halfspace::csg {
namespace {

/// Components of polygons, and whether each runs against the first one of its
/// component: union-find with parities (TAR75).
class Parities {
 public:
  explicit Parities(std::size_t count) : parent_(count), odd_(count) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  std::pair<std::size_t, bool> root(std::size_t p) {
    bool odd = false;
    while (parent_[p] != p) {
      odd = odd != (odd_[p] != 0);
      p = parent_[p];
    }
    return {p, odd};
  }
  /// Whether the two can be so.
  bool unite(std::size_t p, std::size_t q, bool is_odd) {
    const auto [a, a_odd] = root(p);
    const auto [b, b_odd] = root(q);
    const bool odd = (a_odd != b_odd) != is_odd;
    if (a == b) return !odd;
    std::size_t low = a, high = b;
    if (size(low) < size(high)) std::swap(low, high);
    parent_[high] = low;
    odd_[high] = odd ? 1 : 0;
    sizes_[low] += sizes_[high];
    return true;
  }

 private:
  std::size_t size(std::size_t p) {
    if (sizes_.empty()) sizes_.assign(parent_.size(), 1);
    return sizes_[p];
  }

  std::vector<std::size_t> parent_;
  std::vector<std::uint8_t> odd_;
  std::vector<std::size_t> sizes_;
};

struct Part {
  std::size_t polygons = 0;
  double volume = 0;
  bool is_open = false;
  std::array<double, 3> low, high;

  Part() {
    low.fill(std::numeric_limits<double>::max());
    high.fill(std::numeric_limits<double>::lowest());
  }
  bool is_within(const Part& other) const {
    for (std::size_t k = 0; k < 3; ++k) {
      if (low[k] < other.low[k] || high[k] > other.high[k]) return false;
    }
    return true;
  }
};

/// Six times the volume of the cone from the first point over a polygon.
double cone_over(const Soup& soup, const std::vector<VertexId>& corners) {
  const auto from = in_doubles(soup.points.front());
  const auto arm = [&](VertexId v) {
    std::array<double, 3> at = in_doubles(soup.at(v));
    for (std::size_t k = 0; k < 3; ++k) at[k] -= from[k];
    return at;
  };
  double sum = 0;
  const auto a = arm(corners[0]);
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    const auto b = arm(corners[i]), c = arm(corners[i + 1]);
    sum += a[0] * (b[1] * c[2] - b[2] * c[1]) +
           a[1] * (b[2] * c[0] - b[0] * c[2]) +
           a[2] * (b[0] * c[1] - b[1] * c[0]);
  }
  return sum;
}

void turn(std::vector<VertexId>& corners) {
  std::reverse(corners.begin(), corners.end());
}

}  // namespace

Turned turn_to_agree(Soup& soup) {
  Parities parities(soup.polygons.size());
  Turned turned;
  for_edges(edges_of(soup), [&](const SoupEdge* first, const SoupEdge* last) {
    if (last - first != 2 || first[0].polygon == first[1].polygon) return;
    if (!parities.unite(static_cast<std::size_t>(first[0].polygon),
                        static_cast<std::size_t>(first[1].polygon),
                        first[0].forward == first[1].forward))
      ++turned.conflicts;
  });
  std::vector<std::size_t> even(soup.polygons.size());
  std::vector<std::size_t> odd(soup.polygons.size());
  for (std::size_t p = 0; p < soup.polygons.size(); ++p) {
    const auto [root, is_odd] = parities.root(p);
    ++(is_odd ? odd : even)[root];
  }
  for (std::size_t p = 0; p < soup.polygons.size(); ++p) {
    const auto [root, is_odd] = parities.root(p);
    if (is_odd != (odd[root] <= even[root])) continue;
    turn(soup.polygons[p]);
    ++turned.polygons;
  }
  return turned;
}

std::vector<std::size_t> turn_outwards(Soup& soup) {
  Parities joined(soup.polygons.size());
  std::vector<std::int32_t> open;
  for_edges(edges_of(soup), [&](const SoupEdge* first, const SoupEdge* last) {
    std::ptrdiff_t excess = 0;
    for (const SoupEdge* use = first; use < last; ++use) {
      excess += use->forward ? 1 : -1;
      joined.unite(static_cast<std::size_t>(first->polygon),
                   static_cast<std::size_t>(use->polygon), false);
    }
    if (excess != 0) open.push_back(first->polygon);
  });
  std::vector<Part> parts(soup.polygons.size());
  const auto part_of = [&](std::size_t p) -> Part& {
    return parts[joined.root(p).first];
  };
  for (std::size_t p = 0; p < soup.polygons.size(); ++p) {
    Part& part = part_of(p);
    ++part.polygons;
    part.volume += cone_over(soup, soup.polygons[p]);
    for (const VertexId v : soup.polygons[p]) {
      const auto at = in_doubles(soup.at(v));
      for (std::size_t k = 0; k < 3; ++k) {
        part.low[k] = std::min(part.low[k], at[k]);
        part.high[k] = std::max(part.high[k], at[k]);
      }
    }
  }
  for (const std::int32_t p : open)
    part_of(static_cast<std::size_t>(p)).is_open = true;
  std::vector<std::size_t> turned;
  std::vector<bool> turns(parts.size());
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const Part& part = parts[i];
    if (part.polygons == 0 || part.is_open || part.volume >= 0) continue;
    // Within another it is a cavity.
    turns[i] = std::none_of(parts.begin(), parts.end(), [&](const Part& other) {
      return &other != &part && other.polygons > 0 && other.volume > 0 &&
             part.is_within(other);
    });
    if (turns[i]) turned.push_back(part.polygons);
  }
  for (std::size_t p = 0; p < soup.polygons.size(); ++p) {
    if (turns[joined.root(p).first]) turn(soup.polygons[p]);
  }
  return turned;
}

}  // namespace halfspace::csg
