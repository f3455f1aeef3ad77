#include "table/geometry_table.hpp"

#include <algorithm>
#include <cmath>

#include "table/exact_point.hpp"

namespace halfspace::fast {

int GeometryTable::side_exactly(std::int32_t plane_id,
                                std::int32_t vertex_id) const {
  const TableVertex& v = vertex(vertex_id);
  if (v.planes[0] == plane_id || v.planes[1] == plane_id ||
      v.planes[2] == plane_id)
    return 0;
  return with_grid(grid_bits_, [&](auto bits) {
    const ExactPlane<bits()> e = exact_at<bits()>(plane_id);
    if (v.is_grid()) return sign(value_at(e, v.point()));
    constexpr std::size_t kWords = Grid<bits()>::kWords;
    const auto c = exact<bits()>(vertex_id);
    return sign(multiply<kWords>(Int128{e.normal.x}, c[0]) +
                multiply<kWords>(Int128{e.normal.y}, c[1]) +
                multiply<kWords>(Int128{e.normal.z}, c[2]) +
                multiply<kWords>(value_at(e, GridPoint{}), c[3]));
  });
}

int GeometryTable::compare_exactly(int axis, std::int32_t u,
                                   std::int32_t v) const {
  return with_grid(grid_bits_, [&](auto bits) {
    constexpr std::size_t kWords = 2 * Grid<bits()>::kWords;
    const auto k = static_cast<std::size_t>(axis);
    const auto p = exact<bits()>(u);
    const auto q = exact<bits()>(v);
    return sign(multiply<kWords>(p[k], q[3]) - multiply<kWords>(q[k], p[3]));
  });
}

int GeometryTable::turn(int axis, std::int32_t p, std::int32_t q,
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
    const GridPoint g = vertex(v).point();
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

int GeometryTable::cross_sign(int axis, std::int32_t p, std::int32_t q) const {
  const Plane& m = plane(p).filter.plane;
  const Plane& n = plane(q).filter.plane;
  const auto component = [](const Plane& of, int k) {
    return k == 0 ? of.a : k == 1 ? of.b : of.c;
  };
  const int i = (axis + 1) % 3;
  const int j = (axis + 2) % 3;
  const double left = component(m, i) * component(n, j);
  const double right = component(m, j) * component(n, i);
  // Four roundings of each product: of its factors, its own, the difference's.
  const double bound = 8 * kRounding * (std::abs(left) + std::abs(right));
  if (left - right > bound) return 1;
  if (left - right < -bound) return -1;
  return with_grid(grid_bits_, [&](auto bits) {
    return sign(cross_component<bits()>(exact_at<bits()>(p),
                                        exact_at<bits()>(q), axis));
  });
}

Vector3<Int128> GeometryTable::normal(std::int32_t p) const {
  return with_grid(grid_bits_, [&](auto bits) {
    const auto n = exact_at<bits()>(p).normal;
    return Vector3<Int128>{n.x, n.y, n.z};
  });
}

int GeometryTable::dot_sign(std::int32_t p, std::int32_t q) const {
  const auto m = normal(p);
  const auto n = normal(q);
  return sign(multiply<4>(m.x, n.x) + multiply<4>(m.y, n.y) +
              multiply<4>(m.z, n.z));
}

int GeometryTable::normal_sign(std::int32_t p, int axis) const {
  // A double is 0 for 0 alone.
  const Plane& n = plane(p).filter.plane;
  const double c = axis == 0 ? n.a : axis == 1 ? n.b : n.c;
  return (c > 0) - (c < 0);
}

bool GeometryTable::line_axis(std::int32_t p, std::int32_t q, int& axis) const {
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

int GeometryTable::edge_axis(std::int32_t u, std::int32_t v) const {
  const Vertex& a = vertex(u).approximate;
  const Vertex& b = vertex(v).approximate;
  const std::array<double, 3> c{std::abs(a.x - b.x), std::abs(a.y - b.y),
                                std::abs(a.z - b.z)};
  int axis = static_cast<int>(std::max_element(c.begin(), c.end()) - c.begin());
  while (compare(axis, u, v) == 0) axis = (axis + 1) % 3;
  return axis;
}

}  // namespace halfspace::fast
