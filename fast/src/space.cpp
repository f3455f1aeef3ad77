#include "space.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "halfspace/assert.hpp"
#include "residue.hpp"

namespace halfspace::fast {
namespace {

Uint128 size_of(Int128 value) {
  return value < 0 ? -static_cast<Uint128>(value) : static_cast<Uint128>(value);
}

Uint128 greatest_common_divisor(Uint128 a, Uint128 b) {
  while (b != 0) {
    if (((a | b) >> 64) == 0) {
      return std::gcd(static_cast<std::uint64_t>(a),
                      static_cast<std::uint64_t>(b));
    }
    a %= b;
    std::swap(a, b);
  }
  return a;
}

template <int kBits>
Vector3<typename Grid<kBits>::Normal> normal_of(const SpacePlane& plane) {
  using N = typename Grid<kBits>::Normal;
  return {static_cast<N>(plane.normal.x), static_cast<N>(plane.normal.y),
          static_cast<N>(plane.normal.z)};
}

template <int kBits>
ExactPlane<kBits> exact_of(const SpacePlane& plane) {
  return {normal_of<kBits>(plane), plane.origin};
}

/// A cross product of normals: 4n + 3 bits, so 107, 163 and 219.
template <int kBits>
using Cross = std::conditional_t<kBits == 26, Int128, Wide<4>>;

template <int kBits>
Cross<kBits> minor_of(Int128 a, Int128 b, Int128 c, Int128 d) {
  if constexpr (kBits == 26) {
    return a * d - b * c;
  } else {
    return multiply<4>(a, d) - multiply<4>(b, c);
  }
}

template <int kBits>
Cross<kBits> cross_component(const SpacePlane& p, const SpacePlane& q,
                             int axis) {
  const auto& m = p.normal;
  const auto& n = q.normal;
  if (axis == 0) return minor_of<kBits>(m.y, m.z, n.y, n.z);
  if (axis == 1) return minor_of<kBits>(m.z, m.x, n.z, n.x);
  return minor_of<kBits>(m.x, m.y, n.x, n.y);
}

double coordinate(const Vertex& v, int axis) {
  return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

}  // namespace

std::int32_t Space::add_point(const GridPoint& point) {
  // The same hash as make_exact gives a meet of planes that is on the grid.
  const auto residue_of = [](std::int64_t c) {
    return residue(Wide<2>(Int128{c}));
  };
  const std::uint64_t hash =
      hash_of(residue_of(point.x), residue_of(point.y), residue_of(point.z));
  const std::int32_t known = vertex_index_.find(hash, [&](std::int32_t v) {
    const SpaceVertex& other = vertex(v);
    if (other.is_grid()) return other.point == point;
    // A meet is the point if the point lies on its three planes.
    return std::all_of(
        other.planes.begin(), other.planes.end(), [&](std::int32_t p) {
          return sign(value_at(exact_of<54>(plane(p)), point)) == 0;
        });
  });
  if (known >= 0) return known;
  const auto v = static_cast<std::int32_t>(vertices_.size());
  SpaceVertex vertex_of_grid;
  vertex_of_grid.approximate = to_vertex(point);
  vertex_of_grid.point = point;
  vertices_.push_back(vertex_of_grid);
  vertex_index_.enter(hash, v);
  return v;
}

OrientedPlane Space::add_plane(const std::array<GridPoint, 3>& corners) {
  const ExactPlane<54> plane = exact_plane<54>(corners);
  return add_plane(plane.normal, plane.origin);
}

OrientedPlane Space::add_plane(const Vector3<Int128>& normal,
                               const GridPoint& origin) {
  const Uint128 divisor = greatest_common_divisor(
      greatest_common_divisor(size_of(normal.x), size_of(normal.y)),
      size_of(normal.z));
  const Int128 lead = normal.x != 0   ? normal.x
                      : normal.y != 0 ? normal.y
                                      : normal.z;
  const bool turned = lead < 0;
  const Int128 by =
      turned ? -static_cast<Int128>(divisor) : static_cast<Int128>(divisor);
  SpacePlane plane;
  plane.normal = {normal.x / by, normal.y / by, normal.z / by};
  plane.origin = origin;
  const auto offset = value_at(exact_of<54>(plane), GridPoint{});
  const auto word = [](Int128 v) { return residue(Wide<2>(v)); };
  const std::uint64_t hash =
      mixed(hash_of(word(plane.normal.x), word(plane.normal.y),
                    word(plane.normal.z)) +
            residue(offset));
  const std::int32_t known = plane_index_.find(hash, [&](std::int32_t p) {
    const SpacePlane& other = this->plane(p);
    return other.normal == plane.normal &&
           sign(value_at(exact_of<54>(other), origin)) == 0;
  });
  if (known >= 0) return {known, turned};
  plane.filter =
      filter_plane({to_double(plane.normal.x), to_double(plane.normal.y),
                    to_double(plane.normal.z), to_double(offset)});
  const auto id = static_cast<std::int32_t>(planes_.size());
  planes_.push_back(plane);
  plane_index_.enter(hash, id);
  return {id, turned};
}

std::int32_t Space::add_line_plane(std::int32_t u, std::int32_t v, int axis) {
  const GridPoint& p = vertex(u).point;
  HALFSPACE_ASSERT(vertex(u).is_grid() && vertex(v).is_grid());
  const auto d = difference(p, vertex(v).point);
  const Vector3<std::int64_t> e{axis == 0, axis == 1, axis == 2};
  const auto n = cross<26>(d, e);
  return add_plane({n.x, n.y, n.z}, p).plane;
}

std::int32_t Space::meet(std::int32_t p, std::int32_t q, std::int32_t r) {
  std::array<std::int32_t, 3> triple{p, q, r};
  std::sort(triple.begin(), triple.end());
  const auto word = [&](std::size_t i) {
    return static_cast<std::uint64_t>(triple[i]);
  };
  const std::uint64_t hash = hash_of(word(0), word(1), word(2));
  const std::int32_t known = triple_index_.find(hash, [&](std::int32_t t) {
    return triples_[static_cast<std::size_t>(t)] == triple;
  });
  if (known >= 0) return triple_vertices_[static_cast<std::size_t>(known)];
  const std::int32_t v = add_meet(triple);
  triple_index_.enter(hash, static_cast<std::int32_t>(triples_.size()));
  triples_.push_back(triple);
  triple_vertices_.push_back(v);
  return v;
}

std::int32_t Space::add_meet(const std::array<std::int32_t, 3>& planes) {
  // The new vertex is tried as the last one, and taken back if it is known.
  const auto v = static_cast<std::int32_t>(vertices_.size());
  const std::uint64_t hash = with_grid(grid_bits_, [&](auto bits) {
    make_exact<bits()>(planes);
    return point_hash(exact<bits()>(v));
  });
  const std::int32_t known = vertex_index_.find(hash, [&](std::int32_t other) {
    return std::all_of(planes.begin(), planes.end(),
                       [&](std::int32_t p) { return side(p, other) == 0; });
  });
  if (known >= 0) {
    if (!vertices_.back().is_grid()) exact_.resize(vertices_.back().exact);
    vertices_.pop_back();
    return known;
  }
  vertex_index_.enter(hash, v);
  return v;
}

template <int kBits>
void Space::make_exact(const std::array<std::int32_t, 3>& planes) {
  constexpr std::size_t kWords = Grid<kBits>::kWords;
  using Big = typename Grid<kBits>::Determinant;
  const SpacePlane* p[3];
  for (std::size_t i = 0; i < 3; ++i) p[i] = &plane(planes[i]);
  // Cramer's rule: the offsets weigh the cross products of the other two.
  std::array<Big, 4> c;
  for (std::size_t i = 0; i < 3; ++i) {
    const SpacePlane& q = *p[(i + 1) % 3];
    const SpacePlane& r = *p[(i + 2) % 3];
    const auto offset = value_at(exact_of<kBits>(*p[i]), GridPoint{});
    for (int axis = 0; axis < 3; ++axis) {
      const Cross<kBits> product = cross_component<kBits>(q, r, axis);
      auto& at = c[static_cast<std::size_t>(axis)];
      at = at - multiply<kWords>(offset, product);
      if (i == 0) {
        const auto& n = p[0]->normal;
        const Int128 component = axis == 0 ? n.x : axis == 1 ? n.y : n.z;
        c[3] = c[3] + multiply<kWords>(component, product);
      }
    }
  }
  HALFSPACE_ASSERT(sign(c[3]) != 0);
  if (c[3].is_negative()) {
    for (Big& value : c) value = -value;
  }
  SpaceVertex v;
  v.planes = planes;
  // Each of the two is off by 2^-52 of its size, and the quotient rounds once
  // more: 2^-50 of the size is more than that.
  const double w = to_double(c[3]);
  Vertex& a = v.approximate;
  a = {to_double(c[0]) / w, to_double(c[1]) / w, to_double(c[2]) / w, 0};
  a.error = std::max({std::abs(a.x), std::abs(a.y), std::abs(a.z)}) * 0x1p-50;
  if (!put_on_grid<kBits>(v, c)) {
    v.exact = static_cast<std::uint32_t>(exact_.size());
    for (const Big& value : c)
      exact_.insert(exact_.end(), value.words.begin(), value.words.end());
  }
  vertices_.push_back(v);
}

/// Whether the point with these coordinates, the last one their divisor, is on
/// the grid; then it is noted as a point of the grid.
template <int kBits>
bool Space::put_on_grid(
    SpaceVertex& v,
    const std::array<typename Grid<kBits>::Determinant, 4>& c) const {
  constexpr std::size_t kWords = Grid<kBits>::kWords;
  const double at[3] = {v.approximate.x, v.approximate.y, v.approximate.z};
  std::int64_t whole[3];
  for (std::size_t i = 0; i < 3; ++i) {
    const double near = std::nearbyint(at[i]);
    if (std::abs(near) >= std::ldexp(1.0, grid_bits_ - 1) ||
        std::abs(at[i] - near) > v.approximate.error)
      return false;
    whole[i] = static_cast<std::int64_t>(near);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    if (!(multiply<kWords>(Int128{whole[i]}, c[3]) == c[i])) return false;
  }
  v.point = {whole[0], whole[1], whole[2]};
  v.approximate = to_vertex(v.point);
  return true;
}

template <int kBits>
std::array<typename Grid<kBits>::Determinant, 4> Space::exact(
    std::int32_t id) const {
  constexpr std::size_t kWords = Grid<kBits>::kWords;
  const SpaceVertex& v = vertex(id);
  if (v.is_grid())
    return {Int128{v.point.x}, Int128{v.point.y}, Int128{v.point.z}, Int128{1}};
  std::array<typename Grid<kBits>::Determinant, 4> c;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t w = 0; w < kWords; ++w)
      c[i].words[w] = exact_[v.exact + i * kWords + w];
  }
  return c;
}

int Space::side(std::int32_t plane_id, std::int32_t vertex_id) const {
  const SpacePlane& p = plane(plane_id);
  const SpaceVertex& v = vertex(vertex_id);
  if (v.planes[0] == plane_id || v.planes[1] == plane_id ||
      v.planes[2] == plane_id)
    return 0;
  const int known = known_sign(value_at(p.filter, v.approximate, rounding_));
  if (known != 0) return known;
  return with_grid(grid_bits_, [&](auto bits) {
    const ExactPlane<bits()> e = exact_of<bits()>(p);
    if (v.is_grid()) return sign(value_at(e, v.point));
    constexpr std::size_t kWords = Grid<bits()>::kWords;
    const auto c = exact<bits()>(vertex_id);
    return sign(multiply<kWords>(Int128{e.normal.x}, c[0]) +
                multiply<kWords>(Int128{e.normal.y}, c[1]) +
                multiply<kWords>(Int128{e.normal.z}, c[2]) +
                multiply<kWords>(value_at(e, GridPoint{}), c[3]));
  });
}

int Space::compare(int axis, std::int32_t u, std::int32_t v) const {
  if (u == v) return 0;
  const Vertex& a = vertex(u).approximate;
  const Vertex& b = vertex(v).approximate;
  const double d = coordinate(a, axis) - coordinate(b, axis);
  const double error = (a.error + b.error) * (1 + 0x1p-50);
  if (d > error) return 1;
  if (d < -error) return -1;
  if (error == 0) return 0;
  return with_grid(grid_bits_, [&](auto bits) {
    constexpr std::size_t kWords = 2 * Grid<bits()>::kWords;
    const auto k = static_cast<std::size_t>(axis);
    const auto p = exact<bits()>(u);
    const auto q = exact<bits()>(v);
    return sign(multiply<kWords>(p[k], q[3]) - multiply<kWords>(q[k], p[3]));
  });
}

int Space::turn(int axis, std::int32_t p, std::int32_t q,
                std::int32_t r) const {
  const int i = (axis + 1) % 3;
  const int j = (axis + 2) % 3;
  const Vertex& a = vertex(p).approximate;
  const Vertex& b = vertex(q).approximate;
  const Vertex& c = vertex(r).approximate;
  const double bi = coordinate(b, i) - coordinate(a, i);
  const double bj = coordinate(b, j) - coordinate(a, j);
  const double ci = coordinate(c, i) - coordinate(a, i);
  const double cj = coordinate(c, j) - coordinate(a, j);
  const double value = bi * cj - bj * ci;
  // Each difference is off by e at most, a product of two by 2 D e + e e, and
  // rounding adds 3u of the products: doubled for the bound's own roundings.
  const double size =
      std::max({std::abs(bi), std::abs(bj), std::abs(ci), std::abs(cj)});
  const double e = 2 * (std::max({a.error, b.error, c.error}) + 0x1p-52 * size);
  const double bound = 2 * (4 * size * e + 2 * e * e + 0x1p-50 * size * size);
  if (value > bound) return 1;
  if (value < -bound) return -1;
  const auto at = [&](std::int32_t v, int k) {
    const GridPoint& g = vertex(v).point;
    return Int128{k == 0 ? g.x : k == 1 ? g.y : g.z};
  };
  if (vertex(p).is_grid() && vertex(q).is_grid() && vertex(r).is_grid()) {
    return sign((at(q, i) - at(p, i)) * (at(r, j) - at(p, j)) -
                (at(q, j) - at(p, j)) * (at(r, i) - at(p, i)));
  }
  return with_grid(grid_bits_, [&](auto bits) {
    constexpr std::size_t kTwo = 2 * Grid<bits()>::kWords;
    constexpr std::size_t kThree = 3 * Grid<bits()>::kWords;
    const auto x = static_cast<std::size_t>(i);
    const auto y = static_cast<std::size_t>(j);
    const auto s = exact<bits()>(p);
    const auto t = exact<bits()>(q);
    const auto u = exact<bits()>(r);
    const auto two = [&](const auto& f, const auto& g) {
      return multiply<kTwo>(f[x], g[y]) - multiply<kTwo>(f[y], g[x]);
    };
    return sign(multiply<kThree>(two(t, u), s[3]) +
                multiply<kThree>(two(u, s), t[3]) +
                multiply<kThree>(two(s, t), u[3]));
  });
}

int Space::cross_sign(int axis, std::int32_t p, std::int32_t q) const {
  return with_grid(grid_bits_, [&](auto bits) {
    return sign(cross_component<bits()>(plane(p), plane(q), axis));
  });
}

int Space::dot_sign(std::int32_t p, std::int32_t q) const {
  const auto& m = plane(p).normal;
  const auto& n = plane(q).normal;
  return sign(multiply<4>(m.x, n.x) + multiply<4>(m.y, n.y) +
              multiply<4>(m.z, n.z));
}

int Space::normal_sign(std::int32_t p, int axis) const {
  const auto& n = plane(p).normal;
  return sign(axis == 0 ? n.x : axis == 1 ? n.y : n.z);
}

bool Space::line_axis(std::int32_t p, std::int32_t q, int& axis) const {
  if (p == q) return false;
  const Plane& m = plane(p).filter.plane;
  const Plane& n = plane(q).filter.plane;
  const std::array<double, 3> c{std::abs(m.b * n.c - m.c * n.b),
                                std::abs(m.c * n.a - m.a * n.c),
                                std::abs(m.a * n.b - m.b * n.a)};
  axis = static_cast<int>(std::max_element(c.begin(), c.end()) - c.begin());
  for (int tried = 0; tried < 3; ++tried) {
    if (cross_sign(axis, p, q) != 0) return true;
    axis = (axis + 1) % 3;
  }
  return false;
}

int Space::edge_axis(std::int32_t u, std::int32_t v) const {
  const Vertex& a = vertex(u).approximate;
  const Vertex& b = vertex(v).approximate;
  const std::array<double, 3> c{std::abs(a.x - b.x), std::abs(a.y - b.y),
                                std::abs(a.z - b.z)};
  int axis = static_cast<int>(std::max_element(c.begin(), c.end()) - c.begin());
  while (compare(axis, u, v) == 0) axis = (axis + 1) % 3;
  return axis;
}

}  // namespace halfspace::fast
