#include "rounding/mesh_contacts.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>

#include "base/parallel.hpp"
#include "box/bvh.hpp"
#include "exact/flat_star.hpp"
#include "rounding/grid_predicates.hpp"
#include "rounding/mesh_edges.hpp"
#include "rounding/mesh_winding.hpp"

namespace halfspace::fast {
namespace {

/// The parts of a surface that hang together along edges.
std::vector<std::int32_t> parts_of(const GridMesh& mesh,
                                   const MeshEdges& uses) {
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
  uses.for_edges(
      [&](std::int32_t, const MeshEdgeUse* first, const MeshEdgeUse* last) {
        for (const MeshEdgeUse* use = first + 1; use < last; ++use) {
          const std::int32_t a = root(first->triangle), b = root(use->triangle);
          parent[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
        }
      });
  for (std::size_t t = 0; t < parent.size(); ++t)
    parent[t] = root(static_cast<std::int32_t>(t));
  return parent;
}

/// Whether entries and exits alternate round an edge.
bool alternates(const GridMesh& mesh, std::int32_t low,
                const MeshEdgeUse* first, const MeshEdgeUse* last) {
  const std::int32_t high = first->high;
  struct Half {
    std::int32_t apex;
    bool forward;
    int half;  ///< 0: the first one's direction; 2: the opposite one
  };
  std::vector<Half> halves;
  for (const MeshEdgeUse* use = first; use < last; ++use) {
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

void check_parts(const GridMesh& mesh, const std::vector<std::int32_t>& part,
                 const MeshIndex& index, MeshContacts& found) {
  const auto check = [&](const MeshIndex& by_box, const auto& facing) {
    for_windings(mesh, by_box, facing,
                 [&](std::size_t i, const std::optional<int>& winding) {
                   if (winding != 0)
                     found.in_parts.push_back(facing[i].triangle);
                 });
  };
  // A tree costs about as much as looking at all triangles so many times.
  constexpr std::size_t kFew = 4;
  const std::vector<FacingTriangle> facing = facing_triangles(mesh, part);
  if (index.is_empty() && facing.size() > kFew)
    check(MeshIndex(mesh), facing);
  else
    check(index, facing);
}

/// Where no triangles meet: at edges, and in front of parts.
void check_winding(const GridMesh& mesh, const MeshEdges& uses,
                   const MeshIndex& index, MeshContacts& found) {
  uses.for_edges([&](std::int32_t low, const MeshEdgeUse* first,
                     const MeshEdgeUse* last) {
    if (last - first == 2) return;
    const bool moved = std::any_of(first, last, [&](const MeshEdgeUse& use) {
      return mesh.is_moved(
          mesh.triangles[static_cast<std::size_t>(use.triangle)]);
    });
    if (moved && !alternates(mesh, low, first, last))
      found.at_edges.push_back(first->triangle);
  });
  if (found.empty()) check_parts(mesh, parts_of(mesh, uses), index, found);
}

bool is_closed(const MeshEdges& uses) {
  bool closed = true;
  uses.for_edges(
      [&](std::int32_t, const MeshEdgeUse* first, const MeshEdgeUse* last) {
        const auto forward = std::count_if(
            first, last, [](const MeshEdgeUse& use) { return use.forward; });
        closed = closed && 2 * forward == last - first;
      });
  return closed;
}

/// By triangle: its corners, and which of them have flat stars; empty, where
/// those are not looked for.
List<StarCorners> stars_of(const GridMesh& mesh) {
  List<StarCorners> triangles;
  if (!kHasFlatStars) return triangles;
  List<FlatStar> stars(mesh.points.size());
  for (const GridTriangle& t : mesh.triangles) {
    const auto at = [&](std::size_t i) -> const GridPoint& {
      return mesh.at(t.corners[i % 3]);
    };
    const NormalSigns normal = normal_signs(at(0), at(1), at(2));
    const std::uint8_t sides = seen_sides(normal.positive, normal.negative);
    std::array<std::uint8_t, 3> before;
    for (std::size_t i = 0; i < 3; ++i)
      before[i] = axes_before(at(i), at(i + 1));
    for (std::size_t i = 0; i < 3; ++i) {
      stars[static_cast<std::size_t>(t.corners[i])].add(sides, before[i],
                                                        before[(i + 2) % 3]);
    }
  }
  triangles.reserve(mesh.triangles.size());
  for (const GridTriangle& t : mesh.triangles) {
    const auto corner = [&](std::size_t i) {
      const std::int32_t c = t.corners[i];
      return stars[static_cast<std::size_t>(c)].is_flat() ? c : ~c;
    };
    triangles.push_back(StarCorners{corner(0), corner(1), corner(2), 0});
  }
  return triangles;
}

using Pairs = std::vector<std::pair<std::int32_t, std::int32_t>>;

/// Of `count` items, those pairs that `for_near(item, call)` calls it for and
/// `meet` says it of.
template <class Meet, class ForNear>
Pairs pairs_of(std::size_t count, int threads, Meet&& meet,
               ForNear&& for_near) {
  constexpr std::size_t kBlock = 64;
  std::vector<Pairs> blocks((count + kBlock - 1) / kBlock);
  for_blocks(threads, count, kBlock,
             [&](std::size_t number, std::size_t first, std::size_t last) {
               for (std::size_t i = first; i < last; ++i) {
                 for_near(i, [&](std::int32_t t, std::int32_t other) {
                   if (meet(t, other))
                     blocks[number].push_back(std::minmax(t, other));
                 });
               }
             });
  Pairs pairs;
  for (const Pairs& block : blocks)
    pairs.insert(pairs.end(), block.begin(), block.end());
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

std::vector<std::int32_t> marked_triangles(
    const GridMesh& mesh, const std::vector<std::uint8_t>& marked) {
  std::vector<std::int32_t> found;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (has_marked_corner(mesh.triangles[t], marked))
      found.push_back(static_cast<std::int32_t>(t));
  }
  return found;
}

/// Those of triangles with marked corners. If both have, the first finds the
/// other.
Pairs find_pairs(const GridMesh& mesh, const std::vector<std::uint8_t>& marked,
                 int threads, const MeshIndex& index) {
  const auto triangle = [&](std::int32_t t) -> const GridTriangle& {
    return mesh.triangles[static_cast<std::size_t>(t)];
  };
  const std::vector<std::int32_t> moved = marked_triangles(mesh, marked);
  const auto meet = [&](std::int32_t t, std::int32_t other) {
    return triangles_meet(mesh, triangle(t), triangle(other));
  };
  return pairs_of(moved.size(), threads, meet, [&](std::size_t i, auto&& call) {
    const std::int32_t t = moved[i];
    index.find(box_of(mesh, triangle(t)), [&](std::int32_t other) {
      if (other > t || !has_marked_corner(triangle(other), marked))
        call(t, other);
    });
  });
}

/// The same of those with moved corners, without an index: among them packets
/// find each other, and all others look them up.
Pairs find_first_pairs(const GridMesh& mesh, const MeshEdges& uses,
                       int threads) {
  const auto box = [&](std::int32_t t) {
    return box_of(mesh, mesh.triangles[static_cast<std::size_t>(t)]);
  };
  const std::vector<std::int32_t> moved = marked_triangles(mesh, mesh.moved);
  const BoxTree tree(box, moved);
  const List<StarCorners> stars =
      is_closed(uses) ? stars_of(mesh) : List<StarCorners>();
  const auto meet = [&](std::int32_t t, std::int32_t other) {
    const auto i = static_cast<std::size_t>(t);
    const auto j = static_cast<std::size_t>(other);
    if (!stars.empty() && common_of(stars[i], stars[j]) == Common::kFlatStar)
      return false;
    return triangles_meet(mesh, mesh.triangles[i], mesh.triangles[j]);
  };
  Pairs pairs =
      pairs_of(tree.packet_count(), threads, meet,
               [&](std::size_t i, auto&& call) { tree.find_pairs(i, call); });
  if (moved.size() == mesh.triangles.size()) return pairs;
  const Pairs others = pairs_of(
      mesh.triangles.size(), threads, meet, [&](std::size_t i, auto&& call) {
        const auto t = static_cast<std::int32_t>(i);
        if (mesh.is_moved(mesh.triangles[i])) return;
        tree.find(box(t), [&](std::int32_t other) { call(t, other); });
      });
  const auto middle = static_cast<std::ptrdiff_t>(pairs.size());
  pairs.insert(pairs.end(), others.begin(), others.end());
  std::inplace_merge(pairs.begin(), pairs.begin() + middle, pairs.end());
  return pairs;
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
    return on_one_side(at(u[0]), at(u[1]), at(u[2]),
                       {&at(v[0]), &at(v[1]), &at(v[2])});
  };
  if (is_beside(p, q) || is_beside(q, p)) return false;
  for (int i = 0; i < 3; ++i) {
    if (edge_meets(p, q) || edge_meets(q, p)) return true;
    std::rotate(p.begin(), p.begin() + 1, p.end());
    std::rotate(q.begin(), q.begin() + 1, q.end());
  }
  return false;
}

MeshContacts contacts_of(const GridMesh& mesh, int threads,
                         const MeshIndex& index) {
  MeshContacts found;
  const bool any_moved =
      std::any_of(mesh.triangles.begin(), mesh.triangles.end(),
                  [&](const GridTriangle& t) { return mesh.is_moved(t); });
  if (!any_moved) return found;
  if (!index.is_empty()) {
    found.pairs = find_pairs(mesh, mesh.moved, threads, index);
    if (found.empty()) check_winding(mesh, MeshEdges(mesh), index, found);
    return found;
  }
  const MeshEdges uses(mesh);
  found.pairs = find_first_pairs(mesh, uses, threads);
  if (found.empty()) check_winding(mesh, uses, index, found);
  return found;
}

MeshContacts contacts_after(const MeshContacts& before, const GridMesh& mesh,
                            const std::vector<std::uint8_t>& changed,
                            int threads, const MeshIndex& index) {
  MeshContacts found;
  found.pairs = find_pairs(mesh, changed, threads, index);
  const auto is_changed = [&](std::int32_t t) {
    return has_marked_corner(mesh.triangles[static_cast<std::size_t>(t)],
                             changed);
  };
  for (const auto& pair : before.pairs) {
    if (!is_changed(pair.first) && !is_changed(pair.second))
      found.pairs.push_back(pair);
  }
  std::sort(found.pairs.begin(), found.pairs.end());
  if (found.empty()) check_winding(mesh, MeshEdges(mesh), index, found);
  return found;
}

bool is_closed(const GridMesh& mesh) { return is_closed(MeshEdges(mesh)); }

std::size_t part_count(const GridMesh& mesh) {
  const std::vector<std::int32_t> part = parts_of(mesh, MeshEdges(mesh));
  std::size_t count = 0;
  for (std::size_t t = 0; t < part.size(); ++t)
    count += part[t] == static_cast<std::int32_t>(t) ? 1u : 0u;
  return count;
}

}  // namespace halfspace::fast
