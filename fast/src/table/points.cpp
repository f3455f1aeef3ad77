#include <algorithm>
#include <array>
#include <cmath>

#include "base/id_map.hpp"
#include "exact/cell_hash.hpp"
#include "halfspace/assert.hpp"
#include "table/exact_point.hpp"

namespace halfspace::fast {
namespace {

std::uint64_t hash_of_grid(const GridPoint& point, int grid_bits) {
  const auto cell = [&](std::int64_t c) {
    return static_cast<std::uint64_t>(cell_of(c, cell_digits(grid_bits)));
  };
  return hash_of(cell(point.x), cell(point.y), cell(point.z));
}

std::uint64_t hash_of_triple(const std::array<std::int32_t, 3>& planes) {
  const auto word = [&](std::size_t i) {
    return static_cast<std::uint64_t>(planes[i]);
  };
  return hash_of(word(0), word(1), word(2));
}

}  // namespace

/// What is stored of a point that is not on the grid.
std::size_t GeometryTable::words_of_meet() const {
  return with_grid(grid_bits_,
                   [](auto bits) { return 4 * Grid<bits()>::kWords; });
}

void GeometryTable::reserve_meets(std::size_t points) {
  vertices_.reserve(vertices_.size() + points);
  exact_.reserve(exact_.size() + words_of_meet() * points);
  triples_.reserve(triples_.size() + points);
  vertex_index_.reserve(vertices_.size() + points, 0);
  triple_index_.reserve(triples_.size() + points, 0);
}

/// Of a point that is not on the grid nothing depends on the order of its
/// planes, nor on their ids but the hash of the three.
void GeometryTable::copy(const GeometryTable& from,
                         std::span<const std::int32_t> planes,
                         std::span<const std::int32_t> points) {
  HALFSPACE_ASSERT(grid_bits_ == from.grid_bits_);
  HALFSPACE_ASSERT(planes_.size() == 0 && vertices_.size() == 0);
  IdRange extent;
  for (const std::int32_t p : planes) extent.add(p);
  Renumbering ids(extent);
  planes_.reserve(planes.size());
  plane_index_.reserve(planes.size(), 0);
  const bool has_normals = from.normals_.size() != 0;
  if (has_normals) normals_.reserve(planes.size());
  const List<std::uint32_t> of_planes =
      from.plane_index_.marks(from.planes_.size());
  for (const std::int32_t p : planes) {
    const auto id = static_cast<std::int32_t>(planes_.size());
    ids.at(p) = id;
    planes_.push_back(from.plane(p));
    if (has_normals)
      normals_.push_back(from.normals_[static_cast<std::size_t>(p)]);
    plane_index_.enter(of_planes[static_cast<std::size_t>(p)], id);
  }
  const auto meets = static_cast<std::size_t>(
      std::count_if(points.begin(), points.end(),
                    [&](std::int32_t v) { return !from.vertex(v).is_grid(); }));
  vertices_.reserve(points.size());
  vertex_index_.reserve(points.size(), 0);
  exact_.reserve(words_of_meet() * meets);
  triples_.reserve(meets);
  triple_index_.reserve(meets, 0);
  const List<std::uint32_t> of_points =
      from.vertex_index_.marks(from.vertices_.size());
  for (const std::int32_t v : points) {
    const auto id = static_cast<std::int32_t>(vertices_.size());
    TableVertex point = from.vertex(v);
    if (point.is_grid()) {
      point.planes = {-1, -1, -1};
    } else {
      for (std::int32_t& p : point.planes) p = ids.at(p);
      std::sort(point.planes.begin(), point.planes.end());
      note_triple(point.planes, hash_of_triple(point.planes), id);
      const std::size_t first = point.exact;
      point.exact = static_cast<std::uint32_t>(exact_.size());
      for (std::size_t word = 0; word < words_of_meet(); ++word)
        exact_.push_back(from.exact_[first + word]);
    }
    vertices_.push_back(point);
    vertex_index_.enter(of_points[static_cast<std::size_t>(v)], id);
  }
}

std::int32_t GeometryTable::add_point(const GridPoint& point) {
  return enter_point(point, hash_of_grid(point, grid_bits_));
}

/// In blocks: where points are looked up is fetched from memory meanwhile.
void GeometryTable::add_points(std::span<const GridPoint> points,
                               std::vector<std::int32_t>& ids) {
  std::array<std::uint64_t, 32> hashes;
  for (std::size_t i = 0; i < points.size(); i += hashes.size()) {
    const auto block =
        points.subspan(i, std::min(hashes.size(), points.size() - i));
    for (std::size_t k = 0; k < block.size(); ++k) {
      hashes[k] = hash_of_grid(block[k], grid_bits_);
      vertex_index_.prefetch(hashes[k]);
    }
    for (std::size_t k = 0; k < block.size(); ++k)
      ids.push_back(enter_point(block[k], hashes[k]));
  }
}

std::int32_t GeometryTable::enter_point(const GridPoint& point,
                                        std::uint64_t hash) {
  const std::int32_t known = vertex_index_.find(hash, [&](std::int32_t v) {
    const TableVertex& other = vertex(v);
    if (other.is_grid()) return other.point() == point;
    // A meet is the point if the point lies on its three planes.
    return std::all_of(
        other.planes.begin(), other.planes.end(), [&](std::int32_t p) {
          return with_grid(grid_bits_, [&](auto bits) {
            return sign(value_at(exact_at<bits()>(p), point)) == 0;
          });
        });
  });
  if (known >= 0) return known;
  const auto v = static_cast<std::int32_t>(vertices_.size());
  TableVertex vertex_of_grid;
  vertex_of_grid.approximate = to_vertex(point);
  vertices_.push_back(vertex_of_grid);
  vertex_index_.enter(hash, v);
  return v;
}

std::int32_t GeometryTable::known_meet(
    const std::array<std::int32_t, 3>& planes, std::uint64_t hash) const {
  const std::int32_t known = triple_index_.find(hash, [&](std::int32_t t) {
    return triples_[static_cast<std::size_t>(t)].planes == planes;
  });
  return known < 0 ? -1 : triples_[static_cast<std::size_t>(known)].vertex;
}

std::int32_t GeometryTable::note_triple(
    const std::array<std::int32_t, 3>& planes, std::uint64_t hash,
    std::int32_t vertex) {
  triple_index_.enter(hash, static_cast<std::int32_t>(triples_.size()));
  triples_.push_back({planes, vertex});
  return vertex;
}

std::int32_t GeometryTable::meet(std::int32_t p, std::int32_t q,
                                 std::int32_t r) {
  std::array<std::int32_t, 3> triple{p, q, r};
  std::sort(triple.begin(), triple.end());
  const std::uint64_t hash = hash_of_triple(triple);
  const std::int32_t known = known_meet(triple, hash);
  return known >= 0 ? known : note_triple(triple, hash, add_meet(triple));
}

AskedMeet GeometryTable::ask_meet(std::int32_t p, std::int32_t q,
                                  std::int32_t r, bool computes,
                                  std::vector<std::uint64_t>& words) const {
  AskedMeet asked;
  asked.planes = {p, q, r};
  std::sort(asked.planes.begin(), asked.planes.end());
  asked.triple_hash = hash_of_triple(asked.planes);
  asked.known = known_meet(asked.planes, asked.triple_hash);
  if (asked.known >= 0 || !computes) return asked;
  with_grid(grid_bits_, [&](auto bits) {
    std::array<typename Grid<bits()>::Determinant, 4> c;
    TableVertex v;
    v.planes = asked.planes;
    asked.hash = make_exact<bits()>(v, c);
    asked.approximate = v.approximate;
    asked.is_grid = v.is_grid();
    asked.first_word = words.size();
    if (asked.is_grid) return;
    for (const auto& value : c)
      words.insert(words.end(), value.words.begin(), value.words.end());
  });
  asked.is_computed = true;
  return asked;
}

std::int32_t GeometryTable::add_asked(const AskedMeet& asked,
                                      std::span<const std::uint64_t> words) {
  if (asked.known >= 0) return asked.known;
  const std::int32_t known = known_meet(asked.planes, asked.triple_hash);
  if (known >= 0) return known;
  if (!asked.is_computed) {
    return note_triple(asked.planes, asked.triple_hash, add_meet(asked.planes));
  }
  TableVertex v;
  v.approximate = asked.approximate;
  v.planes = asked.planes;
  if (!asked.is_grid) v.exact = 0;
  return note_triple(
      asked.planes, asked.triple_hash, enter_meet(v, asked.hash, [&] {
        exact_.append(words.subspan(asked.first_word, words_of_meet()));
      }));
}

std::int32_t GeometryTable::add_meet(
    const std::array<std::int32_t, 3>& planes) {
  return with_grid(grid_bits_, [&](auto bits) {
    std::array<typename Grid<bits()>::Determinant, 4> c;
    TableVertex v;
    v.planes = planes;
    const std::uint64_t hash = make_exact<bits()>(v, c);
    return enter_meet(v, hash, [&] {
      for (const auto& value : c) exact_.append(value.words);
    });
  });
}

/// The id of a point, which is added if it is not known. `append()` adds its
/// coordinates.
template <class Append>
std::int32_t GeometryTable::enter_meet(TableVertex& v, std::uint64_t hash,
                                       const Append& append) {
  const std::int32_t known = vertex_index_.find(hash, [&](std::int32_t other) {
    return std::all_of(v.planes.begin(), v.planes.end(),
                       [&](std::int32_t p) { return side(p, other) == 0; });
  });
  if (known >= 0) return known;
  const auto id = static_cast<std::int32_t>(vertices_.size());
  if (!v.is_grid()) {
    v.exact = static_cast<std::uint32_t>(exact_.size());
    append();
  }
  vertices_.push_back(v);
  vertex_index_.enter(hash, id);
  return id;
}

/// Where the vertex's planes meet, and exactly: the coordinates times the last
/// number. Gives the point's hash.
template <int kBits>
std::uint64_t GeometryTable::make_exact(
    TableVertex& v, std::array<typename Grid<kBits>::Determinant, 4>& c) const {
  constexpr std::size_t kWords = Grid<kBits>::kWords;
  using Big = typename Grid<kBits>::Determinant;
  std::array<ExactPlane<kBits>, 3> p;
  for (std::size_t i = 0; i < 3; ++i) p[i] = exact_at<kBits>(v.planes[i]);
  // Cramer's rule: the offsets weigh the cross products of the other two.
  c = {};
  for (std::size_t i = 0; i < 3; ++i) {
    const ExactPlane<kBits>& q = p[(i + 1) % 3];
    const ExactPlane<kBits>& r = p[(i + 2) % 3];
    const auto offset = value_at(p[i], GridPoint{});
    for (int axis = 0; axis < 3; ++axis) {
      const Cross<kBits> product = cross_component<kBits>(q, r, axis);
      auto& at = c[static_cast<std::size_t>(axis)];
      at = at - multiply<kWords>(offset, product);
      if (i == 0) {
        const auto& n = p[0].normal;
        const Int128 component = axis == 0 ? n.x : axis == 1 ? n.y : n.z;
        c[3] = c[3] + multiply<kWords>(component, product);
      }
    }
  }
  HALFSPACE_ASSERT(sign(c[3]) != 0);
  if (c[3].is_negative()) {
    for (Big& value : c) value = -value;
  }
  // Each of the two is off by 2^-52 of its size, and the quotient rounds once
  // more: 2^-50 of the size is more than that.
  const double w = to_double(c[3]);
  Vertex& a = v.approximate;
  a = {to_double(c[0]) / w, to_double(c[1]) / w, to_double(c[2]) / w, 0};
  a.error = std::max({std::abs(a.x), std::abs(a.y), std::abs(a.z)}) * 0x1p-50;
  if (put_on_grid<kBits>(v, c)) return hash_of_grid(v.point(), grid_bits_);
  v.exact = 0;  // not yet known
  const double at[3] = {a.x, a.y, a.z};
  std::array<std::uint64_t, 3> cells;
  for (std::size_t i = 0; i < 3; ++i) {
    cells[i] = static_cast<std::uint64_t>(
        cell_of<kWords + 1>(at[i], a.error, c[i], c[3], cell_digits(kBits)));
  }
  return hash_of(cells[0], cells[1], cells[2]);
}

/// Whether the point with these coordinates, the last one their divisor, is on
/// the grid; then it is noted as a point of the grid.
template <int kBits>
bool GeometryTable::put_on_grid(
    TableVertex& v,
    const std::array<typename Grid<kBits>::Determinant, 4>& c) const {
  constexpr std::size_t kWords = Grid<kBits>::kWords;
  const double at[3] = {v.approximate.x, v.approximate.y, v.approximate.z};
  std::int64_t whole[3];
  for (std::size_t i = 0; i < 3; ++i) {
    const double near = std::nearbyint(at[i]);
    if (std::abs(near) >= power_of_two(grid_bits_ - 1) ||
        std::abs(at[i] - near) > v.approximate.error)
      return false;
    whole[i] = static_cast<std::int64_t>(near);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const auto rest = c[i] - multiply<kWords>(Int128{whole[i]}, c[3]);
    if (sign(rest) == 0) continue;
    // Far out on the widest grid doubles are off by some steps, which are whole
    // but for rounding.
    if (v.approximate.error < 0.5) return false;
    const double off = to_double(rest) / to_double(c[3]);
    const double steps = std::nearbyint(off);
    if (std::abs(off - steps) > 0x1p-20) return false;
    whole[i] += static_cast<std::int64_t>(steps);
    if (!fits(whole[i], grid_bits_) ||
        !(multiply<kWords>(Int128{whole[i]}, c[3]) == c[i]))
      return false;
  }
  v.approximate = to_vertex({whole[0], whole[1], whole[2]});
  return true;
}

}  // namespace halfspace::fast
