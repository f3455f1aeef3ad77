#include "halfspace/fast/to_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

#include "base/id_map.hpp"
#include "base/parallel.hpp"
#include "solid/decimal_place.hpp"
#include "solid/face_projection.hpp"
#include "solid/face_triangulation.hpp"
#include "solid/vertex_order.hpp"
#include "table/shared_table.hpp"

namespace halfspace::fast {
namespace {

/// One grid step in model units. A power of ten is rounded, and applied to
/// numbers that are divided by it where it is less than one.
double scaled(double value, Unit unit) {
  // A product with a power of two that is a double is rounded as if scaled.
  if (unit.base == 2 && std::abs(unit.exponent) < 1000) {
    return value * power_of_two(unit.exponent);
  }
  if (unit.base == 2) return std::ldexp(value, unit.exponent);
  return unit.exponent < 0 ? value / std::pow(10.0, -unit.exponent)
                           : value * std::pow(10.0, unit.exponent);
}

/// Polygons in a row, by points' ids, then by vertices.
struct Polygons {
  List<std::int32_t> corners;
  List<std::uint32_t> first_corner = {0};
  List<std::int32_t> faces;

  std::size_t size() const { return faces.size(); }
  std::span<std::int32_t> at(std::size_t p) {
    const std::uint32_t first = first_corner[p];
    return {corners.data() + first, first_corner[p + 1] - first};
  }
  void add(std::span<const std::int32_t> polygon, std::int32_t face) {
    corners.insert(corners.end(), polygon.begin(), polygon.end());
    end_polygon(face);
  }
  void add(const Polygons& others) {
    const auto before = static_cast<std::uint32_t>(corners.size());
    corners.insert(corners.end(), others.corners.begin(), others.corners.end());
    for (std::size_t p = 0; p < others.size(); ++p)
      first_corner.push_back(before + others.first_corner[p + 1]);
    faces.insert(faces.end(), others.faces.begin(), others.faces.end());
  }
  /// Its corners are the last ones.
  void end_polygon(std::int32_t face) {
    first_corner.push_back(static_cast<std::uint32_t>(corners.size()));
    faces.push_back(face);
  }
};

/// Adds a face that is one triangle. Whether it is.
bool add_triangle(const Solid& solid, std::size_t f, Polygons& polygons) {
  const Face& face = solid.faces[f];
  if (face.edge_count != 3) return false;
  const SolidEdge* e = solid.edges.data() + face.first_edge;
  // Three edges in a row are a loop round what they bound.
  if (e[0].to != e[1].from || e[1].to != e[2].from || e[2].to != e[0].from)
    return false;
  for (std::size_t i = 0; i < 3; ++i) polygons.corners.push_back(e[i].from);
  polygons.end_polygon(static_cast<std::int32_t>(f));
  return true;
}

/// Whether a convex loop goes straight on at a vertex.
bool has_straight_corner(const Solid& solid, const Face& face,
                         std::span<const std::int32_t> loop) {
  const FaceProjection view(solid, face);
  for (std::size_t i = 0; i < loop.size(); ++i) {
    if (view.turn(loop[i], loop[(i + 1) % loop.size()],
                  loop[(i + 2) % loop.size()]) == 0)
      return true;
  }
  return false;
}

/// Adds the polygons of the faces from `first` to before `last`.
void add_polygons(const Solid& solid, std::size_t first, std::size_t last,
                  const ExportOptions& options, Polygons& polygons) {
  const bool triangles = options.triangles;
  const auto fits = [&](const Face& face, std::span<const std::int32_t> loop) {
    return options.straight_corners || !has_straight_corner(solid, face, loop);
  };
  std::vector<std::array<std::int32_t, 3>> parts;
  std::vector<std::vector<std::int32_t>> joined;
  for (std::size_t f = first; f < last; ++f) {
    if (add_triangle(solid, f, polygons)) continue;
    const auto id = static_cast<std::int32_t>(f);
    const Face& face = solid.faces[f];
    if (!triangles) {
      const auto loop = convex_loop(
          solid, face,
          std::span(solid.edges).subspan(face.first_edge, face.edge_count));
      if (!loop.empty() && fits(face, loop)) {
        polygons.add(loop, id);
        continue;
      }
    }
    parts.clear();
    triangulate(solid, face, parts);
    if (!triangles) {
      joined.clear();
      join_convex(solid, face, parts, joined);
      const bool all_fit =
          std::all_of(joined.begin(), joined.end(),
                      [&](const auto& part) { return fits(face, part); });
      if (all_fit) {
        for (const auto& part : joined) polygons.add(part, id);
        continue;
      }
    }
    for (const auto& part : parts) polygons.add(part, id);
  }
}

Polygons polygons_of(const Solid& solid, const ExportOptions& options) {
  constexpr std::size_t kBlock = 256;
  Polygons all;
  const int threads = thread_count(options.threads);
  if (threads == 1) {
    all.corners.reserve(solid.edges.size());
    all.first_corner.reserve(solid.faces.size() + 1);
    all.faces.reserve(solid.faces.size());
    add_polygons(solid, 0, solid.faces.size(), options, all);
    return all;
  }
  std::vector<Polygons> blocks((solid.faces.size() + kBlock - 1) / kBlock);
  for_blocks(threads, solid.faces.size(), kBlock,
             [&](std::size_t number, std::size_t first, std::size_t last) {
               add_polygons(solid, first, last, options, blocks[number]);
             });
  std::size_t corners = 0, polygons = 0;
  for (const Polygons& block : blocks) {
    corners += block.corners.size();
    polygons += block.size();
  }
  all.corners.reserve(corners);
  all.first_corner.reserve(polygons + 1);
  all.faces.reserve(polygons);
  for (const Polygons& block : blocks) all.add(block);
  return all;
}

/// Turns a polygon's corners until the least is the first.
void begin_with_least(std::span<std::int32_t> corners) {
  if (corners.size() != 3) {
    std::rotate(corners.begin(),
                std::min_element(corners.begin(), corners.end()),
                corners.end());
    return;
  }
  // Most are triangles.
  const std::int32_t a = corners[0], b = corners[1], c = corners[2];
  const bool second = b < a && b < c;
  const bool third = c < a && c < b;
  corners[0] = second ? b : third ? c : a;
  corners[1] = second ? c : third ? a : b;
  corners[2] = second ? a : third ? b : c;
}

/// Loops of the output are shared in blocks of so many. Untuned.
constexpr std::size_t kShare = 4096;

/// How far vertices in a row were moved.
struct Moves {
  std::size_t count = 0;
  double most = 0;
};

/// Puts the vertices from number `first` to before `last` in the mesh, as they
/// are in the order.
Moves place_vertices(const Solid& solid, const List<std::int32_t>& order,
                     std::size_t first, std::size_t last, ExportedMesh& mesh) {
  const GeometryTable& table = *solid.table;
  Moves moves;
  const Unit& unit = solid.unit;
  const bool is_decimal =
      unit.base == 10 && unit.exponent <= 0 && unit.exponent >= -kMostDigits;
  // Times others, a double of a table may be none.
  const bool is_scaled_exactly =
      unit.base == 2 && std::abs(unit.exponent) <= 900;
  for (std::size_t i = first; i < last; ++i) {
    constexpr std::size_t kAhead = 16;
    if (i + kAhead < last) table.prefetch_vertex(order[i + kAhead]);
    bool rounded = false;
    std::array<double, 3>& at = mesh.vertices[i];
    if (is_decimal) {
      at = decimal_place(table, order[i], -unit.exponent, rounded);
    } else {
      at = table.nearest(order[i], rounded);
      for (double& coordinate : at) {
        const double steps = coordinate;
        coordinate = scaled(steps, unit);
        rounded |= !is_scaled_exactly &&
                   (unit.base == 10 ||
                    std::ldexp(coordinate, -unit.exponent) != steps);
      }
    }
    if (!rounded) continue;
    // Half a unit in the last place, and 2^-51 for a long power of ten and what
    // is done with it.
    const double size =
        std::max({std::abs(at[0]), std::abs(at[1]), std::abs(at[2])});
    mesh.is_rounded[i] = 1;
    ++moves.count;
    moves.most = std::max(
        moves.most, size * (unit.base == 2 || is_decimal ? 0x1p-53 : 0x1p-50));
  }
  return moves;
}

/// Puts the vertices that the polygons have in the mesh, in the order of their
/// coordinates, and their numbers there in place of the points' ids.
void add_vertices(const Solid& solid, Polygons& polygons, int threads,
                  ExportedMesh& mesh) {
  const GeometryTable& table = *solid.table;
  IdRange extent;
  for (const std::int32_t v : polygons.corners) extent.add(v);
  IdMap places(extent);
  std::vector<std::int32_t> numbers(places.size(), -1);
  std::vector<std::int32_t> used;
  std::int32_t* const number_at = numbers.data();
  places.with_slots([&](const auto& place) {
    for (const std::int32_t v : polygons.corners) {
      std::int32_t& number = number_at[place(v)];
      if (number < 0) used.push_back(v);
      number = 0;
    }
  });
  const List<std::int32_t> order = vertices_in_order(used, table);
  const std::size_t count = order.size();
  mesh.vertices.resize(count);
  mesh.points.assign(order.begin(), order.end());
  mesh.is_rounded.resize(count);
  std::vector<Moves> moves((count + kShare - 1) / kShare);
  for_blocks(threads, count, kShare,
             [&](std::size_t number, std::size_t first, std::size_t last) {
               moves[number] = place_vertices(solid, order, first, last, mesh);
               for (std::size_t i = first; i < last; ++i)
                 number_at[places.find(order[i])] =
                     static_cast<std::int32_t>(i);
             });
  for (const Moves& some : moves) {
    mesh.moved += some.count;
    mesh.max_move = std::max(mesh.max_move, some.most);
  }
  for_blocks(threads, polygons.size(), kShare,
             [&](std::size_t, std::size_t first, std::size_t last) {
               const auto corners =
                   std::span(polygons.corners)
                       .subspan(polygons.first_corner[first],
                                polygons.first_corner[last] -
                                    polygons.first_corner[first]);
               std::as_const(places).with_slots([&](const auto& place) {
                 for (std::int32_t& v : corners) v = number_at[place(v)];
               });
               for (std::size_t p = first; p < last; ++p)
                 begin_with_least(polygons.at(p));
             });
}

/// The polygons in the order of their corners, the first of which are the
/// least.
std::vector<std::uint32_t> polygons_in_order(Polygons& polygons,
                                             std::size_t vertex_count,
                                             int threads) {
  std::vector<std::uint32_t> place(vertex_count + 1);
  const auto first = [&](std::size_t p) {
    return static_cast<std::size_t>(polygons.corners[polygons.first_corner[p]]);
  };
  for (std::size_t p = 0; p < polygons.size(); ++p) ++place[first(p) + 1];
  std::partial_sum(place.begin(), place.end(), place.begin());
  std::vector<std::uint32_t> order(polygons.size());
  for (std::size_t p = 0; p < polygons.size(); ++p)
    order[place[first(p)]++] = static_cast<std::uint32_t>(p);
  const auto second = [&](std::uint32_t p) {
    return polygons.corners[polygons.first_corner[p] + 1];
  };
  const auto is_before = [&](std::uint32_t p, std::uint32_t q) {
    // Nearly always decisive.
    if (second(p) != second(q)) return second(p) < second(q);
    const auto x = polygons.at(p);
    const auto y = polygons.at(q);
    const auto [at, other] =
        std::mismatch(x.begin(), x.end(), y.begin(), y.end());
    if (at == x.end() || other == y.end())
      return x.size() != y.size() ? x.size() < y.size()
                                  : polygons.faces[p] < polygons.faces[q];
    return *at < *other;
  };
  // Where a vertex's polygons end now; those of the next one begin there.
  const auto at = [&](std::size_t v) {
    return order.begin() +
           (v == 0 ? 0 : static_cast<std::ptrdiff_t>(place[v - 1]));
  };
  for_blocks(threads, vertex_count, kShare,
             [&](std::size_t, std::size_t begin, std::size_t end) {
               for (std::size_t v = begin; v < end; ++v)
                 std::sort(at(v), at(v + 1), is_before);
             });
  return order;
}

/// Whether three points, corners in a row, surely turn to the left as seen from
/// outside.
bool surely_turn(const std::array<double, 3>& p, const std::array<double, 3>& q,
                 const std::array<double, 3>& r, const Plane& normal,
                 double sign) {
  std::array<double, 3> u, v;
  double size = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    u[k] = q[k] - p[k];
    v[k] = r[k] - p[k];
    size = std::max({size, std::abs(u[k]), std::abs(v[k])});
  }
  const double length =
      std::max({std::abs(normal.a), std::abs(normal.b), std::abs(normal.c)});
  const double value = normal.a * (u[1] * v[2] - u[2] * v[1]) +
                       normal.b * (u[2] * v[0] - u[0] * v[2]) +
                       normal.c * (u[0] * v[1] - u[1] * v[0]);
  // Six products of three factors, each with five roundings or fewer.
  return sign * value > 64 * kRounding * length * size * size;
}

/// Whether some corner surely turns so. A convex polygon may have straight
/// ones; one sure corner decides where it faces.
bool surely_faces_out(const ExportedMesh& mesh,
                      std::span<const std::int32_t> polygon,
                      const Plane& normal, double sign) {
  const auto at = [&](std::size_t i) -> const std::array<double, 3>& {
    return mesh.vertices[static_cast<std::size_t>(polygon[i])];
  };
  const std::size_t count = polygon.size();
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t j = i + 1 < count ? i + 1 : 0;
    const std::size_t k = j + 1 < count ? j + 1 : 0;
    if (surely_turn(at(i), at(j), at(k), normal, sign)) return true;
  }
  return false;
}

/// Fills in the mesh's polygons, in order.
class PolygonWriter {
 public:
  PolygonWriter(const Solid& solid, Polygons& polygons,
                const std::vector<std::uint32_t>& order, ExportedMesh& mesh)
      : solid_(solid), polygons_(polygons), order_(order), mesh_(mesh) {}

  void run(int threads) {
    mesh_.corners.resize(polygons_.corners.size());
    mesh_.first_corner.resize(polygons_.size() + 1);
    mesh_.faces.resize(polygons_.size());
    mesh_.colors.resize(polygons_.size());
    if (polygons_.corners.size() == 3 * polygons_.size()) {
      // Each has three, then: none has fewer.
      for (std::size_t i = 0; i < order_.size(); ++i)
        mesh_.first_corner[i + 1] = static_cast<std::uint32_t>(3 * i + 3);
    } else {
      for (std::size_t i = 0; i < order_.size(); ++i) {
        mesh_.first_corner[i + 1] =
            mesh_.first_corner[i] +
            static_cast<std::uint32_t>(polygons_.at(order_[i]).size());
      }
    }
    std::vector<std::vector<std::int32_t>> flipped(
        (order_.size() + kShare - 1) / kShare);
    for_blocks(threads, order_.size(), kShare,
               [&](std::size_t number, std::size_t first, std::size_t last) {
                 write(first, last, flipped[number]);
               });
    for (const std::vector<std::int32_t>& some : flipped)
      mesh_.flipped.insert(mesh_.flipped.end(), some.begin(), some.end());
  }

 private:
  /// A polygon whose vertices do not move cannot be flipped by rounding.
  bool is_moved(std::span<const std::int32_t> corners) const {
    return std::any_of(corners.begin(), corners.end(), [&](std::int32_t v) {
      return mesh_.is_rounded[static_cast<std::size_t>(v)] != 0;
    });
  }
  const Face& face_at(std::size_t i) const {
    return solid_.faces[static_cast<std::size_t>(polygons_.faces[order_[i]])];
  }

  void write(std::size_t first, std::size_t last,
             std::vector<std::int32_t>& flipped) {
    VertexId* corner = mesh_.corners.data() + mesh_.first_corner[first];
    for (std::size_t at = first; at < last; ++at) {
      // What is far off in memory is fetched while others are worked on: a step
      // further for each list. (In a function of its own it would be dropped,
      // as it does nothing.)
      constexpr std::size_t kAhead = 10;
      if (at + 3 * kAhead < last) {
        const std::uint32_t far = order_[at + 3 * kAhead];
        __builtin_prefetch(&polygons_.faces[far]);
        __builtin_prefetch(&polygons_.first_corner[far]);
        const std::uint32_t next = order_[at + 2 * kAhead];
        __builtin_prefetch(&face_at(at + 2 * kAhead));
        __builtin_prefetch(&polygons_.corners[polygons_.first_corner[next]]);
        const auto near = polygons_.at(order_[at + kAhead]);
        if (is_moved(near)) {
          __builtin_prefetch(&solid_.table->plane(face_at(at + kAhead).plane));
          for (const std::int32_t v : near)
            __builtin_prefetch(&mesh_.vertices[static_cast<std::size_t>(v)]);
        }
      }
      const std::uint32_t p = order_[at];
      const auto corners = polygons_.at(p);
      const std::int32_t f = polygons_.faces[p];
      const Face& face = solid_.faces[static_cast<std::size_t>(f)];
      if (is_moved(corners)) {
        const Plane& normal = solid_.table->plane(face.plane).filter.plane;
        if (!surely_faces_out(mesh_, corners, normal, face.flipped ? -1 : 1))
          flipped.push_back(static_cast<std::int32_t>(at));
      }
      for (const std::int32_t v : corners) *corner++ = v;
      mesh_.faces[at] = f;
      mesh_.colors[at] = face.color;
    }
  }

  const Solid& solid_;
  Polygons& polygons_;
  const std::vector<std::uint32_t>& order_;
  ExportedMesh& mesh_;
};

}  // namespace

ExportedMesh to_mesh(const Solid& solid, const ExportOptions& options) {
  ExportedMesh mesh;
  if (solid.faces.empty()) return mesh;
  const int threads = thread_count(options.threads);
  Polygons polygons = polygons_of(solid, options);
  add_vertices(solid, polygons, threads, mesh);
  const std::vector<std::uint32_t> order =
      polygons_in_order(polygons, mesh.vertices.size(), threads);
  PolygonWriter(solid, polygons, order, mesh).run(threads);
  return mesh;
}

}  // namespace halfspace::fast
