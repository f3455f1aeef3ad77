#include "rounding/mesh_contacts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/parallel.hpp"
#include "box/bvh.hpp"
#include "exact/exact_plane.hpp"
#include "exact/wide.hpp"
#include "rounding/grid_predicates.hpp"

namespace halfspace::fast {
namespace {

Box box_of(const GridMesh& mesh, const GridTriangle& t) {
  Bounds bounds;
  for (const std::int32_t c : t.corners) {
    const GridPoint& p = mesh.at(c);
    bounds.add({static_cast<double>(p.x), static_cast<double>(p.y),
                static_cast<double>(p.z), 0});
  }
  return bounds.box();
}

/// A triangle at one of its edges.
struct EdgeUse {
  std::int32_t high = 0;  ///< the greater end
  std::int32_t triangle = 0;
  bool forward = false;  ///< it goes there
};

/// All uses of edges, those of one edge in a row.
class EdgeUses {
 public:
  explicit EdgeUses(const GridMesh& mesh) {
    first_.resize(mesh.points.size() + 1);
    for_each(mesh, [&](std::int32_t low, const EdgeUse&) {
      ++first_[static_cast<std::size_t>(low) + 1];
    });
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    uses_.resize(first_.back());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for_each(mesh, [&](std::int32_t low, const EdgeUse& use) {
      uses_[next[static_cast<std::size_t>(low)]++] = use;
    });
    for (std::size_t p = 0; p + 1 < first_.size(); ++p) {
      std::sort(uses_.begin() + first_[p], uses_.begin() + first_[p + 1],
                [](const EdgeUse& x, const EdgeUse& y) {
                  return x.high != y.high ? x.high < y.high
                                          : x.triangle < y.triangle;
                });
    }
  }

  /// Calls `found(low, first use, use after the last)` for each edge.
  template <class Found>
  void for_edges(Found&& found) const {
    for (std::size_t p = 0; p + 1 < first_.size(); ++p) {
      for (std::size_t i = first_[p]; i < first_[p + 1];) {
        std::size_t end = i + 1;
        while (end < first_[p + 1] && uses_[end].high == uses_[i].high) ++end;
        found(static_cast<std::int32_t>(p), uses_.data() + i,
              uses_.data() + end);
        i = end;
      }
    }
  }

 private:
  template <class Found>
  static void for_each(const GridMesh& mesh, Found&& found) {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto& c = mesh.triangles[t].corners;
      for (std::size_t i = 0; i < 3; ++i) {
        const std::int32_t from = c[i], to = c[(i + 1) % 3];
        found(std::min(from, to),
              EdgeUse{std::max(from, to), static_cast<std::int32_t>(t),
                      from < to});
      }
    }
  }

  std::vector<std::uint32_t> first_;
  std::vector<EdgeUse> uses_;
};

/// The parts of a surface that hang together along edges.
std::vector<std::int32_t> parts_of(const GridMesh& mesh, const EdgeUses& uses) {
  std::vector<std::int32_t> parent(mesh.triangles.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](std::int32_t t) {
    while (parent[static_cast<std::size_t>(t)] != t) {
      std::int32_t& up = parent[static_cast<std::size_t>(t)];
      up = parent[static_cast<std::size_t>(up)];
      t = up;
    }
    return t;
  };
  uses.for_edges([&](std::int32_t, const EdgeUse* first, const EdgeUse* last) {
    for (const EdgeUse* use = first + 1; use < last; ++use) {
      const std::int32_t a = root(first->triangle), b = root(use->triangle);
      parent[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
    }
  });
  for (std::size_t t = 0; t < parent.size(); ++t)
    parent[t] = root(static_cast<std::int32_t>(t));
  return parent;
}

/// Whether entries and exits alternate round an edge.
bool alternates(const GridMesh& mesh, std::int32_t low, const EdgeUse* first,
                const EdgeUse* last) {
  const std::int32_t high = first->high;
  struct Half {
    std::int32_t apex;
    bool forward;
    int half;  ///< 0: the first one's direction; 2: the opposite one
  };
  std::vector<Half> halves;
  for (const EdgeUse* use = first; use < last; ++use) {
    for (const std::int32_t c :
         mesh.triangles[static_cast<std::size_t>(use->triangle)].corners) {
      if (c != low && c != high) halves.push_back({c, use->forward, 0});
    }
  }
  const auto side = [&](std::int32_t p, std::int32_t q) {
    return side_of_triangle(mesh.at(low), mesh.at(high), mesh.at(p),
                            mesh.at(q));
  };
  // In the plane of the first one, no other is on its side: they would meet.
  for (std::size_t i = 1; i < halves.size(); ++i) {
    const int s = side(halves[0].apex, halves[i].apex);
    halves[i].half = s > 0 ? 1 : s == 0 ? 2 : 3;
  }
  std::sort(halves.begin(), halves.end(), [&](const Half& x, const Half& y) {
    return x.half != y.half ? x.half < y.half : side(x.apex, y.apex) > 0;
  });
  for (std::size_t i = 0; i < halves.size(); ++i) {
    if (halves[i].forward == halves[(i + 1) % halves.size()].forward)
      return false;
  }
  return true;
}

/// Counts how often the surface winds round points in front of its triangles.
class WindingCounter {
 public:
  explicit WindingCounter(const GridMesh& mesh) : mesh_(mesh) {}

  /// Whether the winding number in front of the triangle is surely 0, with the
  /// triangles that `for_near(box, call)` finds.
  /// Requires: it is not upright.
  template <class ForNear>
  bool is_zero_in_front(std::int32_t t, ForNear&& for_near) {
    const GridTriangle& own = mesh_.triangles[static_cast<std::size_t>(t)];
    middle_ = {};
    for (const std::int32_t c : own.corners) {
      middle_.x += mesh_.at(c).x;
      middle_.y += mesh_.at(c).y;
      middle_.z += mesh_.at(c).z;
    }
    Box box = box_of(mesh_, own);
    box.high[2] = std::numeric_limits<float>::max();
    int above = 0;
    bool sure = true;
    for_near(box, [&](std::int32_t other) {
      if (other == t) return;
      const auto winds =
          winding_above(mesh_.triangles[static_cast<std::size_t>(other)], sure);
      above += winds;
    });
    return sure && above == (upward(own) > 0 ? 0 : 1);
  }

  /// The sign of the upward component of a triangle's normal.
  int upward(const GridTriangle& t) const {
    return turn_along(2, mesh_.at(t.corners[0]), mesh_.at(t.corners[1]),
                      mesh_.at(t.corners[2]));
  }

 private:
  /// p, three times as large, from three times the middle: up to 57 bits.
  Vector3<std::int64_t> from_middle(std::int32_t p) const {
    const GridPoint& at = mesh_.at(p);
    return {3 * at.x - middle_.x, 3 * at.y - middle_.y, 3 * at.z - middle_.z};
  }

  /// What a triangle adds to the winding number below it, if it is above the
  /// middle, moved by (e, e^2) for an infinitely small e > 0.
  int winding_above(const GridTriangle& t, bool& sure) const {
    std::array<Vector3<std::int64_t>, 3> v;
    for (std::size_t i = 0; i < 3; ++i) v[i] = from_middle(t.corners[i]);
    int first = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto& a = v[i];
      const auto& b = v[(i + 1) % 3];
      int turn = sign(Int128{a.x} * b.y - Int128{a.y} * b.x);
      if (turn == 0) turn = a.y > b.y ? 1 : a.y < b.y ? -1 : 0;
      if (turn == 0) turn = b.x > a.x ? 1 : b.x < a.x ? -1 : 0;
      if (turn == 0 || (i > 0 && turn != first)) return 0;
      first = turn;
    }
    // The determinant is the normal's product with a corner.
    const auto minor = [](std::int64_t a, std::int64_t b, std::int64_t c,
                          std::int64_t d) {
      return Int128{a} * d - Int128{b} * c;
    };
    const auto &a = v[0], &b = v[1], &c = v[2];
    const int side = sign(multiply<3>(minor(b.y, b.z, c.y, c.z), Int128{a.x}) +
                          multiply<3>(minor(b.z, b.x, c.z, c.x), Int128{a.y}) +
                          multiply<3>(minor(b.x, b.y, c.x, c.y), Int128{a.z}));
    if (side == 0) sure = false;
    return side == first ? first : 0;
  }

  const GridMesh& mesh_;
  GridPoint middle_;  ///< three times as large
};

/// A triangle of each part that is as level as any: where it begins, none.
std::vector<std::int32_t> level_triangles(
    const GridMesh& mesh, const std::vector<std::int32_t>& part) {
  std::vector<std::int32_t> best(mesh.triangles.size(), -1);
  std::vector<double> area(mesh.triangles.size(), -1);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& c = mesh.triangles[t].corners;
    const GridPoint &p = mesh.at(c[0]), &q = mesh.at(c[1]), &r = mesh.at(c[2]);
    const auto d = [](std::int64_t value) {
      return static_cast<double>(value);
    };
    const double size =
        std::abs(d(q.x - p.x) * d(r.y - p.y) - d(q.y - p.y) * d(r.x - p.x));
    const auto of = static_cast<std::size_t>(part[t]);
    if (size <= area[of]) continue;
    area[of] = size;
    best[of] = static_cast<std::int32_t>(t);
  }
  std::erase(best, -1);
  return best;
}

void check_parts(const GridMesh& mesh, const std::vector<std::int32_t>& part,
                 MeshContacts& found) {
  // A tree costs about as much as looking at all triangles so many times.
  constexpr std::size_t kFew = 4;
  const std::vector<std::int32_t> level = level_triangles(mesh, part);
  const auto box = [&](std::int32_t t) {
    return box_of(mesh, mesh.triangles[static_cast<std::size_t>(t)]);
  };
  std::vector<std::int32_t> all(mesh.triangles.size());
  std::iota(all.begin(), all.end(), 0);
  WindingCounter counter(mesh);
  const auto check = [&](auto&& for_near) {
    for (const std::int32_t t : level) {
      if (counter.upward(mesh.triangles[static_cast<std::size_t>(t)]) == 0 ||
          !counter.is_zero_in_front(t, for_near))
        found.in_parts.push_back(t);
    }
  };
  if (level.size() <= kFew) {
    check([&](const Box&, auto&& call) {
      for (const std::int32_t t : all) call(t);
    });
    return;
  }
  const BoxTree tree(box, all);
  check([&](const Box& near, auto&& call) { tree.find(near, call); });
}

void find_pairs(const GridMesh& mesh, int threads, MeshContacts& found) {
  std::vector<std::int32_t> moved;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (mesh.is_moved(mesh.triangles[t]))
      moved.push_back(static_cast<std::int32_t>(t));
  }
  const auto triangle = [&](std::int32_t t) -> const GridTriangle& {
    return mesh.triangles[static_cast<std::size_t>(t)];
  };
  const BoxTree tree([&](std::int32_t t) { return box_of(mesh, triangle(t)); },
                     moved);
  constexpr std::size_t kBlock = 1024;
  std::vector<std::vector<std::pair<std::int32_t, std::int32_t>>> blocks(
      (mesh.triangles.size() + kBlock - 1) / kBlock);
  for_blocks(threads, mesh.triangles.size(), kBlock,
             [&](std::size_t number, std::size_t first, std::size_t last) {
               for (std::size_t i = first; i < last; ++i) {
                 const auto t = static_cast<std::int32_t>(i);
                 const bool is_moved = mesh.is_moved(triangle(t));
                 tree.find(box_of(mesh, triangle(t)), [&](std::int32_t other) {
                   // If both moved, the first finds the other.
                   if (is_moved && other <= t) return;
                   if (triangles_meet(mesh, triangle(t), triangle(other)))
                     blocks[number].push_back(std::minmax(t, other));
                 });
               }
             });
  for (const auto& block : blocks)
    found.pairs.insert(found.pairs.end(), block.begin(), block.end());
  std::sort(found.pairs.begin(), found.pairs.end());
}

}  // namespace

bool triangles_meet(const GridMesh& mesh, const GridTriangle& a,
                    const GridTriangle& b) {
  // The corners of either, those that both have first.
  std::array<std::int32_t, 3> p = a.corners, q = b.corners;
  std::size_t shared = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = shared; j < 3; ++j) {
      if (p[i] != q[j]) continue;
      std::swap(p[i], p[shared]);
      std::swap(q[j], q[shared]);
      ++shared;
      break;
    }
  }
  const auto at = [&](std::int32_t c) -> const GridPoint& {
    return mesh.at(c);
  };
  if (shared == 3) return true;
  if (shared == 2) {
    if (side_of_triangle(at(p[0]), at(p[1]), at(p[2]), at(q[2])) != 0)
      return false;
    // In one plane: they lie on either side of the edge, or overlap.
    for (int axis = 0; axis < 3; ++axis) {
      const int turn = turn_along(axis, at(p[0]), at(p[1]), at(p[2]));
      if (turn == 0) continue;
      return turn == turn_along(axis, at(p[0]), at(p[1]), at(q[2]));
    }
    return true;
  }
  // What they have in common besides a corner ends where one of them does.
  const auto edge_meets = [&](const auto& edge, const auto& other) {
    return meets_triangle(at(edge[1]), at(edge[2]), at(other[0]), at(other[1]),
                          at(other[2]));
  };
  if (shared == 1) return edge_meets(p, q) || edge_meets(q, p);
  const auto is_beside = [&](const auto& u, const auto& v) {
    const int s = side_of_triangle(at(u[0]), at(u[1]), at(u[2]), at(v[0]));
    return s != 0 &&
           s == side_of_triangle(at(u[0]), at(u[1]), at(u[2]), at(v[1])) &&
           s == side_of_triangle(at(u[0]), at(u[1]), at(u[2]), at(v[2]));
  };
  if (is_beside(p, q) || is_beside(q, p)) return false;
  for (int i = 0; i < 3; ++i) {
    if (edge_meets(p, q) || edge_meets(q, p)) return true;
    std::rotate(p.begin(), p.begin() + 1, p.end());
    std::rotate(q.begin(), q.begin() + 1, q.end());
  }
  return false;
}

MeshContacts contacts_of(const GridMesh& mesh, int threads) {
  MeshContacts found;
  const bool any_moved =
      std::any_of(mesh.triangles.begin(), mesh.triangles.end(),
                  [&](const GridTriangle& t) { return mesh.is_moved(t); });
  if (!any_moved) return found;
  find_pairs(mesh, threads, found);
  if (!found.empty()) return found;
  const EdgeUses uses(mesh);
  uses.for_edges(
      [&](std::int32_t low, const EdgeUse* first, const EdgeUse* last) {
        if (last - first == 2) return;
        const bool moved = std::any_of(first, last, [&](const EdgeUse& use) {
          return mesh.is_moved(
              mesh.triangles[static_cast<std::size_t>(use.triangle)]);
        });
        if (moved && !alternates(mesh, low, first, last))
          found.at_edges.push_back(first->triangle);
      });
  if (found.empty()) check_parts(mesh, parts_of(mesh, uses), found);
  return found;
}

bool is_closed(const GridMesh& mesh) {
  bool closed = true;
  EdgeUses(mesh).for_edges(
      [&](std::int32_t, const EdgeUse* first, const EdgeUse* last) {
        const auto forward = std::count_if(
            first, last, [](const EdgeUse& use) { return use.forward; });
        closed = closed && 2 * forward == last - first;
      });
  return closed;
}

std::size_t part_count(const GridMesh& mesh) {
  const std::vector<std::int32_t> part = parts_of(mesh, EdgeUses(mesh));
  std::size_t count = 0;
  for (std::size_t t = 0; t < part.size(); ++t)
    count += part[t] == static_cast<std::int32_t>(t) ? 1u : 0u;
  return count;
}

}  // namespace halfspace::fast
