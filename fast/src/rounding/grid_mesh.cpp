#include "rounding/grid_mesh.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

#include "base/hash_index.hpp"
#include "exact/exact_plane.hpp"
#include "rounding/grid_hash.hpp"
#include "rounding/grid_predicates.hpp"

namespace halfspace::fast {
namespace {

/// Makes equal points one: that which was not moved, or the first.
std::size_t weld(GridMesh& mesh) {
  const GridPointHash hash_of;
  const auto count = static_cast<std::int32_t>(mesh.points.size());
  const auto moved_count = static_cast<std::size_t>(
      std::count_if(mesh.moved.begin(), mesh.moved.end(),
                    [](std::uint8_t moved) { return moved != 0; }));
  if (moved_count == 0) return 0;
  HashIndex moved;
  moved.reserve(moved_count, 0);
  const auto find = [&](const GridPoint& at) {
    return moved.find(hash_of(at),
                      [&](std::int32_t p) { return mesh.at(p) == at; });
  };
  std::vector<std::int32_t> stands_for(mesh.points.size());
  std::iota(stands_for.begin(), stands_for.end(), 0);
  std::size_t welded = 0;
  for (std::int32_t p = 0; p < count; ++p) {
    if (!mesh.is_moved(p)) continue;
    const std::int32_t first = find(mesh.at(p));
    if (first < 0) {
      moved.enter(hash_of(mesh.at(p)), p);
    } else {
      stands_for[static_cast<std::size_t>(p)] = first;
      ++welded;
    }
  }
  std::vector<std::int32_t> now(mesh.points.size(), -1);
  for (std::int32_t p = 0; p < count; ++p) {
    if (mesh.is_moved(p)) continue;
    const std::int32_t at = find(mesh.at(p));
    if (at < 0) continue;
    now[static_cast<std::size_t>(at)] = p;
    // What is there now counts as moved: its triangles have new neighbours.
    mesh.moved[static_cast<std::size_t>(p)] = 1;
    ++welded;
  }
  if (welded == 0) return 0;
  for (GridTriangle& t : mesh.triangles) {
    for (std::int32_t& corner : t.corners) {
      corner = stands_for[static_cast<std::size_t>(corner)];
      const std::int32_t other = now[static_cast<std::size_t>(corner)];
      if (other >= 0) corner = other;
    }
  }
  return welded;
}

bool has_equal_corners(const GridTriangle& t) {
  return t.corners[0] == t.corners[1] || t.corners[1] == t.corners[2] ||
         t.corners[2] == t.corners[0];
}

/// The corners in ascending order, and whether that is an even permutation.
std::pair<std::array<std::int32_t, 3>, bool> sorted(const GridTriangle& t) {
  std::array<std::int32_t, 3> c = t.corners;
  bool even = true;
  const auto order = [&](std::size_t i, std::size_t j) {
    if (c[i] < c[j]) return;
    std::swap(c[i], c[j]);
    even = !even;
  };
  order(0, 1);
  order(1, 2);
  order(0, 1);
  return {c, even};
}

/// Lets triangles and their reversals cancel. The ones that go are the last.
std::size_t cancel(GridMesh& mesh) {
  struct Entry {
    std::int32_t middle, high;  // corners
    std::uint32_t triangle;
    bool even;
  };
  // Those with moved corners, by their least corners: triangles that were there
  // before are all different.
  std::vector<std::uint32_t> first(mesh.points.size() + 1);
  const auto for_moved = [&](auto&& call) {
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      if (!mesh.is_moved(mesh.triangles[i])) continue;
      const auto [corners, even] = sorted(mesh.triangles[i]);
      call(static_cast<std::size_t>(corners[0]),
           Entry{corners[1], corners[2], static_cast<std::uint32_t>(i), even});
    }
  };
  for_moved([&](std::size_t low, const Entry&) { ++first[low + 1]; });
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<Entry> entries(first.back());
  std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
  for_moved([&](std::size_t low, const Entry& entry) {
    entries[next[low]++] = entry;
  });
  std::vector<std::uint8_t> goes(mesh.triangles.size());
  std::size_t gone = 0;
  for (std::size_t low = 0; low + 1 < first.size(); ++low) {
    const std::size_t last = first[low + 1];
    if (last - first[low] < 2) continue;
    std::sort(entries.begin() + first[low], entries.begin() + first[low + 1],
              [](const Entry& x, const Entry& y) {
                return std::tie(x.middle, x.high, x.triangle) <
                       std::tie(y.middle, y.high, y.triangle);
              });
    for (std::size_t i = first[low]; i < last;) {
      std::size_t end = i;
      std::array<std::size_t, 2> counts{};
      for (; end < last && entries[end].middle == entries[i].middle &&
             entries[end].high == entries[i].high;
           ++end)
        ++counts[entries[end].even ? 1 : 0];
      std::array<std::size_t, 2> left;
      left.fill(std::min(counts[0], counts[1]));
      for (std::size_t k = end; k > i; --k) {
        std::size_t& of = left[entries[k - 1].even ? 1 : 0];
        if (of == 0) continue;
        --of;
        goes[entries[k - 1].triangle] = 1;
        ++gone;
      }
      i = end;
    }
  }
  if (gone == 0) return 0;
  std::size_t at = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (goes[i] == 0) mesh.triangles[at++] = mesh.triangles[i];
  }
  mesh.triangles.resize(at);
  return gone;
}

using Ends = std::pair<std::int32_t, std::int32_t>;

/// A line through grid points: its direction, without a common divisor and with
/// its first component that is not 0 positive, and its moment about the origin.
using LineKey = std::array<Int128, 6>;

LineKey line_of(const GridPoint& p, const GridPoint& q) {
  Vector3<std::int64_t> d = difference(p, q);
  const std::int64_t g = std::gcd(std::gcd(d.x, d.y), d.z);
  const bool negative = d.x != 0 ? d.x < 0 : d.y != 0 ? d.y < 0 : d.z < 0;
  for (std::int64_t* c : {&d.x, &d.y, &d.z}) *c /= negative ? -g : g;
  return {d.x,
          d.y,
          d.z,
          Int128{p.y} * d.z - Int128{p.z} * d.y,
          Int128{p.z} * d.x - Int128{p.x} * d.z,
          Int128{p.x} * d.y - Int128{p.y} * d.x};
}

/// Cuts triangles at the vertices that lie within their edges where triangles
/// without area went.
class EdgeCutter {
 public:
  /// Notes the corners of a triangle that all lie on one line, two of them
  /// different.
  void add(const GridMesh& mesh, const GridTriangle& flat) {
    const auto& c = flat.corners;
    const std::int32_t other = c[0] != c[1] ? c[1] : c[2];
    std::vector<std::int32_t>& points =
        on_line_[line_of(mesh.at(c[0]), mesh.at(other))];
    points.insert(points.end(), c.begin(), c.end());
    for (std::size_t i = 0; i < 3; ++i) {
      if (c[i] != c[(i + 1) % 3])
        edges_[std::minmax(c[i], c[(i + 1) % 3])] = {};
    }
  }
  bool empty() const { return edges_.empty(); }

  void run(GridMesh& mesh) {
    for (auto& [line, points] : on_line_) {
      std::sort(points.begin(), points.end(),
                [&](std::int32_t p, std::int32_t q) {
                  return mesh.at(p) < mesh.at(q);
                });
      points.erase(std::unique(points.begin(), points.end()), points.end());
    }
    for (auto& [ends, within] : edges_) within = points_within(mesh, ends);
    std::vector<GridTriangle> cut;
    for (const GridTriangle& t : mesh.triangles) {
      todo_ = {t};
      while (!todo_.empty()) {
        const GridTriangle next = todo_.back();
        todo_.pop_back();
        if (!cut_once(mesh, next)) cut.push_back(next);
      }
    }
    mesh.triangles = std::move(cut);
  }

 private:
  /// The line's points strictly between two of them, ascending.
  std::vector<std::int32_t> points_within(const GridMesh& mesh,
                                          const Ends& ends) const {
    const auto [low, high] =
        std::minmax(mesh.at(ends.first), mesh.at(ends.second));
    const auto& points = on_line_.at(line_of(low, high));
    std::vector<std::int32_t> within;
    for (const std::int32_t p : points) {
      if (low < mesh.at(p) && mesh.at(p) < high) within.push_back(p);
    }
    return within;
  }

  /// Cuts a triangle into a fan, if one of its edges is to be cut. The parts of
  /// the edge have no points within.
  bool cut_once(GridMesh& mesh, const GridTriangle& t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::int32_t from = t.corners[i];
      const std::int32_t to = t.corners[(i + 1) % 3];
      const std::int32_t apex = t.corners[(i + 2) % 3];
      const auto at = edges_.find(std::minmax(from, to));
      if (at == edges_.end() || at->second.empty()) continue;
      std::vector<std::int32_t> row = at->second;
      if (mesh.at(to) < mesh.at(from)) std::reverse(row.begin(), row.end());
      std::int32_t last = from;
      row.push_back(to);
      for (const std::int32_t p : row) {
        todo_.push_back({{last, p, apex}, t.source});
        // Its triangles are not those of before.
        mesh.moved[static_cast<std::size_t>(p)] = 1;
        last = p;
      }
      return true;
    }
    return false;
  }

  std::map<LineKey, std::vector<std::int32_t>> on_line_;
  std::map<Ends, std::vector<std::int32_t>> edges_;
  std::vector<GridTriangle> todo_;
};

/// Drops triangles without area.
std::size_t drop_flat(GridMesh& mesh, EdgeCutter& cutter) {
  const std::size_t before = mesh.triangles.size();
  std::erase_if(mesh.triangles, [&](const GridTriangle& t) {
    if (!mesh.is_moved(t)) return false;
    if (has_equal_corners(t)) return true;
    if (!on_one_line(mesh.at(t.corners[0]), mesh.at(t.corners[1]),
                     mesh.at(t.corners[2])))
      return false;
    cutter.add(mesh, t);
    return true;
  });
  return before - mesh.triangles.size();
}

}  // namespace

Collapse clean(GridMesh& mesh) {
  Collapse collapse;
  collapse.points = weld(mesh);
  EdgeCutter cutter;
  collapse.triangles = drop_flat(mesh, cutter);
  collapse.triangles += cancel(mesh);
  if (cutter.empty()) return collapse;
  cutter.run(mesh);
  collapse.triangles += cancel(mesh);
  return collapse;
}

void drop_unused_points(GridMesh& mesh) {
  std::vector<std::int32_t> number(mesh.points.size(), -1);
  for (const GridTriangle& t : mesh.triangles) {
    for (const std::int32_t corner : t.corners)
      number[static_cast<std::size_t>(corner)] = 0;
  }
  std::int32_t count = 0;
  for (std::size_t p = 0; p < number.size(); ++p) {
    if (number[p] < 0) continue;
    const auto to = static_cast<std::size_t>(count);
    mesh.points[to] = mesh.points[p];
    mesh.moved[to] = mesh.moved[p];
    number[p] = count++;
  }
  mesh.points.resize(static_cast<std::size_t>(count));
  mesh.moved.resize(static_cast<std::size_t>(count));
  for (GridTriangle& t : mesh.triangles) {
    for (std::int32_t& corner : t.corners)
      corner = number[static_cast<std::size_t>(corner)];
  }
}

}  // namespace halfspace::fast
