#include "fields.hpp"

#include <algorithm>
#include <cmath>
#include <memory_resource>
#include <optional>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "affine.hpp"
#include "placed_vertices.hpp"

namespace halfspace::detail {
namespace {

using csg::ExactPoint;
using csg::ExactSurface;
using csg::Integer;

/// What a half-space cut has no colour of its own.
constexpr Rgb kCutColor{170, 170, 170};

/// A field's value where there is none.
constexpr double kNoField = 0;

/// The triangle that a polygon's affine functions are given by: three corners
/// of the operand's mesh, and the axis along which it is seen.
struct Base {
  std::size_t corner = 0;  ///< the first one; the others are next
  std::size_t axis = 0;
  std::array<std::size_t, 3> vertices{};
};

/// A vertex of the result.
struct ResultVertex {
  bool is_grid = false;
  bool is_near =
      false;  ///< `point` is not it, but one that is known to be near
  GridPoint point;
};

using Wide3 = std::array<Int128, 3>;

Int128 magnitude(Int128 value) { return value < 0 ? -value : value; }

/// As csg::longest_axis().
std::size_t longest_axis(const Wide3& normal) {
  std::size_t axis = 0;
  for (std::size_t i = 1; i < 3; ++i) {
    if (magnitude(normal[i]) > magnitude(normal[axis])) axis = i;
  }
  return axis;
}

/// A normal of three points of the grid; 0 where they are on a line.
Wide3 normal_of(const GridPoint& p, const GridPoint& q, const GridPoint& r) {
  const Wide3 a = {q.x - p.x, q.y - p.y, q.z - p.z};
  const Wide3 b = {r.x - p.x, r.y - p.y, r.z - p.z};
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
          a[0] * b[1] - a[1] * b[0]};
}

/// Copies `count` values, kCount if that is not 0. No value comes out as -0.
using CopyValues = void (*)(const double* from, double* to, std::size_t count);
template <std::size_t kCount>
void copy_values(const double* from, double* to, std::size_t count) {
  const std::size_t all = kCount == 0 ? count : kCount;
  for (std::size_t k = 0; k < all; ++k) to[k] = from[k] + 0.0;
}

/// The one for so many: loops of known length, for up to a line of the cache.
CopyValues copier_of(std::size_t count) {
  constexpr std::array<CopyValues, 9> kCopiers = {
      copy_values<0>, copy_values<1>, copy_values<2>,
      copy_values<3>, copy_values<4>, copy_values<5>,
      copy_values<6>, copy_values<7>, copy_values<8>};
  return count < kCopiers.size() ? kCopiers[count] : kCopiers[0];
}

/// 1 where the points are equal, else 0; without a branch, for which one of
/// three it is cannot be foretold.
std::size_t are_equal(const GridPoint& p, const GridPoint& q) {
  return ((p.x ^ q.x) | (p.y ^ q.y) | (p.z ^ q.z)) == 0 ? 1 : 0;
}

/// An operand of the result.
struct Part {
  const Mesh* properties = nullptr;        ///< null where there are none
  std::optional<PlacedVertices> vertices;  ///< where there are fields
  CopyValues copy = nullptr;
  bool has_triangles = false;  ///< and nothing else: polygon `p` begins at 3p
};

bool has_only_triangles(const Mesh& mesh) {
  const auto& first = mesh.first_corner;
  if (mesh.corners.size() != 3 * mesh.polygon_count()) return false;
  for (std::size_t p = 0; p < first.size(); ++p) {
    if (first[p] != 3 * p) return false;
  }
  return true;
}

class Carrier {
 public:
  Carrier(const Evaluation& evaluation, const fast::Solid& solid,
          const fast::ExportedMesh& rounded, FieldPath path, Mesh& mesh);
  void carry();

 private:
  /// Polygons that are worked on at once.
  static constexpr std::size_t kBlock = 64;

  Part* part_of(std::size_t polygon);
  void take_origins();
  void carry_colors();
  void take_vertices();
  void carry_block(std::size_t first, std::size_t last);
  void carry_fields(std::size_t polygon);
  /// Of a triangle: the corners of the operand that have the values of its own.
  struct Copied {
    const Part* part = nullptr;  ///< null where they are computed
    std::array<std::size_t, 3> corners{};
  };
  Copied copied_corners(std::size_t polygon);
  void prefetch(std::size_t polygon) const;
  std::optional<Base> base_of(const fast::Face& face, Part& part);
  std::size_t axis_of(const fast::Face& face) const;
  bool has_area(const Base& base, Part& part);
  Triangle exact_triangle(const Base& base, Part& part) const;
  ResultVertex& vertex_near(std::size_t v);
  std::optional<std::size_t> corner_at(const Base& base, Part& part,
                                       std::size_t v);
  std::array<SeenPoint, 3> seen_triangle(const Base& base, Part& part,
                                         const GridPoint& point);
  std::optional<BoundedWeights> bounded_weights(const Base& base, Part& part,
                                                std::size_t v);
  void add_exactly(const Base& base, Part& part, std::size_t v,
                   std::span<double> values);

  const fast::Solid& solid_;
  const fast::ExportedMesh& rounded_;
  bool is_exact_;
  Mesh& mesh_;
  std::vector<Part> parts_;
  std::pmr::vector<ResultVertex> vertices_;
  /// By vertex that is not on the grid: it less the point near it.
  std::unordered_map<std::size_t, BoundedPoint> less_;
  std::vector<bool> known_;  ///< of a corner's fields
  ExactSurface surface_;
  double steps_;  ///< in a model unit, about
};

Carrier::Carrier(const Evaluation& evaluation, const fast::Solid& solid,
                 const fast::ExportedMesh& rounded, FieldPath path, Mesh& mesh)
    : solid_(solid),
      rounded_(rounded),
      is_exact_(path == FieldPath::kExact),
      mesh_(mesh),
      parts_(evaluation.uses.size()),
      surface_(solid),
      steps_(std::pow(static_cast<double>(solid.unit.base),
                      -static_cast<double>(solid.unit.exponent))) {
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const Evaluation::Use& use = evaluation.uses[i];
    const LeafData& data = *use.node->leaf->data();
    parts_[i].properties = data.properties.get();
    if (parts_[i].properties && parts_[i].properties->field_count > 0) {
      parts_[i].vertices.emplace(use.matrix, solid_.unit, data);
      parts_[i].copy = copier_of(data.properties->field_count);
      parts_[i].has_triangles = has_only_triangles(*data.properties);
    }
  }
}

/// The operand that a polygon of the result is from; null of a half-space.
Part* Carrier::part_of(std::size_t polygon) {
  const std::size_t part = mesh_.origins[polygon].operand;
  return part < parts_.size() ? &parts_[part] : nullptr;
}

void Carrier::carry_colors() {
  bool any_colors = false, any_materials = false;
  for (const Part& part : parts_) {
    if (!part.properties) continue;
    any_colors = any_colors || !part.properties->colors.empty();
    any_materials = any_materials || !part.properties->materials.empty();
  }
  if (!any_colors && !any_materials) return;
  for (std::size_t p = 0; p < rounded_.faces.size(); ++p) {
    const Part* part = part_of(p);
    const Mesh* properties = part ? part->properties : nullptr;
    const auto from = static_cast<std::size_t>(mesh_.origins[p].polygon);
    if (any_colors) {
      const bool has = properties && !properties->colors.empty();
      mesh_.colors.push_back(has ? properties->colors[from] : kCutColor);
    }
    if (any_materials) {
      const bool has = properties && !properties->materials.empty();
      mesh_.materials.push_back(has ? properties->materials[from] : 0);
    }
  }
}

void Carrier::take_origins() {
  mesh_.origins.reserve(rounded_.faces.size());
  for (const std::int32_t f : rounded_.faces) {
    const fast::Face& face = solid_.faces[static_cast<std::size_t>(f)];
    mesh_.origins.push_back(
        {static_cast<std::uint32_t>(face.part), face.polygon});
  }
}

void Carrier::carry() {
  take_origins();
  carry_colors();
  for (const Part& part : parts_) {
    if (part.properties)
      mesh_.field_count =
          std::max(mesh_.field_count, part.properties->field_count);
  }
  if (mesh_.field_count == 0) return;
  take_vertices();
  // Operands may have fewer fields than others, or none.
  const std::size_t count = rounded_.faces.size();
  mesh_.fields.reserve(rounded_.corners.size() * mesh_.field_count);
  for (std::size_t p = 0; p < count; p += kBlock)
    carry_block(p, std::min(p + kBlock, count));
}

/// Values that are copied first, in loops that wait for memory and do little
/// else; then those that are computed.
void Carrier::carry_block(std::size_t first, std::size_t last) {
  mesh_.fields.resize(rounded_.first_corner[last] * mesh_.field_count,
                      kNoField);
  std::array<Copied, kBlock> copied;
  const std::size_t count = rounded_.faces.size();
  for (std::size_t p = first; p < last; ++p) {
    if (p + kBlock < count) prefetch(p + kBlock);
    copied[p - first] = copied_corners(p);
  }
  for (std::size_t p = first; p < last; ++p) {
    const Copied& from = copied[p - first];
    if (from.part == nullptr) continue;
    const Mesh& mesh = *from.part->properties;
    const std::size_t corner = rounded_.first_corner[p];
    for (std::size_t i = 0; i < 3; ++i) {
      from.part->copy(mesh.fields.data() + from.corners[i] * mesh.field_count,
                      mesh_.fields.data() + (corner + i) * mesh_.field_count,
                      mesh.field_count);
    }
  }
  for (std::size_t p = first; p < last; ++p) {
    if (copied[p - first].part == nullptr) carry_fields(p);
  }
}

void Carrier::take_vertices() {
  vertices_.resize(rounded_.points.size());
  for (std::size_t v = 0; v < vertices_.size(); ++v) {
    const fast::SolidVertex from = fast::vertex_at(solid_, rounded_.points[v]);
    vertices_[v].is_grid = from.is_grid;
    vertices_[v].point = from.point;
  }
}

/// Asks for the operand's numbers of a polygon that is soon to come: they are
/// anywhere, for results are in another order.
void Carrier::prefetch(std::size_t polygon) const {
#if defined(__GNUC__)
  const Origin& origin = mesh_.origins[polygon];
  if (origin.operand >= parts_.size()) return;
  const Part& part = parts_[origin.operand];
  if (!part.has_triangles) return;
  const Mesh& from = *part.properties;
  const std::size_t first = 3 * static_cast<std::size_t>(origin.polygon);
  const double* const fields = from.fields.data() + first * from.field_count;
  // A line of the cache has 8 doubles; those of three corners may end in one
  // more than they fill.
  for (std::size_t i = 0; i < 3 * from.field_count; i += 8)
    __builtin_prefetch(fields + i);
  __builtin_prefetch(fields + 3 * from.field_count - 1);
  __builtin_prefetch(from.corners.data() + first);
#endif
}

/// Where the values of a polygon of the result are copied from, if it has the
/// corners of the triangle that it is from, and by points of the grid alone.
Carrier::Copied Carrier::copied_corners(std::size_t polygon) {
  const std::size_t first = rounded_.first_corner[polygon];
  Part* part = part_of(polygon);
  if (!part || !part->has_triangles || is_exact_ ||
      rounded_.first_corner[polygon + 1] - first != 3)
    return {};
  const Mesh& from = *part->properties;
  const std::size_t base =
      3 * static_cast<std::size_t>(mesh_.origins[polygon].polygon);
  std::array<const GridPoint*, 3> at{};
  for (std::size_t k = 0; k < 3; ++k) {
    at[k] = part->vertices->on_grid(
        static_cast<std::size_t>(from.corners[base + k]));
    if (at[k] == nullptr) return {};
  }
  Copied copied;
  std::size_t found = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const ResultVertex& vertex =
        vertices_[static_cast<std::size_t>(rounded_.corners[first + i])];
    const std::size_t is_second = are_equal(*at[1], vertex.point);
    const std::size_t is_third = are_equal(*at[2], vertex.point);
    copied.corners[i] = base + is_second + 2 * is_third;
    found += (are_equal(*at[0], vertex.point) | is_second | is_third) &
             (vertex.is_grid ? 1u : 0u);
  }
  if (found == 3) copied.part = part;
  return copied;
}

/// Gives the corners of a polygon of the result their values: those of a corner
/// of the base where it is one, else those of the affine function.
void Carrier::carry_fields(std::size_t polygon) {
  Part* part = part_of(polygon);
  if (!part || !part->vertices) return;
  const auto f = static_cast<std::size_t>(rounded_.faces[polygon]);
  const fast::Face& face = solid_.faces[f];
  const std::optional<Base> base = base_of(face, *part);
  if (!base) return;
  const Mesh& from = *part->properties;
  const std::size_t count = from.field_count;
  for (std::size_t i = rounded_.first_corner[polygon];
       i < rounded_.first_corner[polygon + 1]; ++i) {
    const auto v = static_cast<std::size_t>(rounded_.corners[i]);
    const std::span<double> values(mesh_.fields.data() + i * mesh_.field_count,
                                   count);
    if (const auto corner = corner_at(*base, *part, v)) {
      const double* const same = from.fields.data() + *corner * count;
      double* const to = values.data();
      part->copy(same, to, count);
      continue;
    }
    known_.assign(count, false);
    const auto weights =
        is_exact_ ? std::nullopt : bounded_weights(*base, *part, v);
    bool are_all_known = weights.has_value();
    for (std::size_t k = 0; weights && k < count; ++k) {
      const auto value =
          value_of(*weights, {from.fields_at(base->corner)[k],
                              from.fields_at(base->corner + 1)[k],
                              from.fields_at(base->corner + 2)[k]});
      known_[k] = value.has_value();
      are_all_known = are_all_known && value;
      if (value) values[k] = *value;
    }
    if (!are_all_known) add_exactly(*base, *part, v, values);
  }
}

std::size_t Carrier::axis_of(const fast::Face& face) const {
  return longest_axis(fast::plane_at(solid_, face.plane).normal);
}

/// The first three corners of the face's polygon that are not on a line, as
/// seen along the normal's longest component; nothing where there are none.
std::optional<Base> Carrier::base_of(const fast::Face& face, Part& part) {
  const Mesh& from = *part.properties;
  const auto polygon = static_cast<std::size_t>(face.polygon);
  const std::size_t first = from.first_corner[polygon];
  const std::size_t last = from.first_corner[polygon + 1];
  const auto base_at = [&from](std::size_t corner) {
    Base base;
    base.corner = corner;
    for (std::size_t k = 0; k < 3; ++k)
      base.vertices[k] = static_cast<std::size_t>(from.corners[corner + k]);
    return base;
  };
  if (!is_exact_ && last - first == 3) {
    // A triangle of points of the grid is in its face's plane: both normals
    // have the same longest component.
    Base base = base_at(first);
    const GridPoint* p = part.vertices->on_grid(base.vertices[0]);
    const GridPoint* q = part.vertices->on_grid(base.vertices[1]);
    const GridPoint* r = part.vertices->on_grid(base.vertices[2]);
    if (p && q && r) {
      const Wide3 normal = normal_of(*p, *q, *r);
      base.axis = longest_axis(normal);
      if (normal[base.axis] != 0) return base;
    }
  }
  const std::size_t axis = axis_of(face);
  for (std::size_t i = first; i + 2 < last; ++i) {
    Base base = base_at(i);
    base.axis = axis;
    if (has_area(base, part)) return base;
  }
  return std::nullopt;
}

/// Whether the corners are not on a line, as seen along the axis.
bool Carrier::has_area(const Base& base, Part& part) {
  if (!is_exact_) {
    const GridPoint* p = part.vertices->on_grid(base.vertices[0]);
    const GridPoint* q = part.vertices->on_grid(base.vertices[1]);
    const GridPoint* r = part.vertices->on_grid(base.vertices[2]);
    if (p && q && r) return normal_of(*p, *q, *r)[base.axis] != 0;
    if (weights_at(seen_triangle(base, part, {}), SeenPoint{})) return true;
  }
  return exact_triangle(base, part).area2 != 0;
}

Triangle Carrier::exact_triangle(const Base& base, Part& part) const {
  Triangle triangle;
  triangle.axis = base.axis;
  for (std::size_t k = 0; k < 3; ++k)
    triangle.points[k] = part.vertices->exact(base.vertices[k]);
  triangle.area2 = csg::area2(triangle.points[0], triangle.points[1],
                              triangle.points[2], base.axis);
  return triangle;
}

/// The vertex, with a point of the grid that is near.
ResultVertex& Carrier::vertex_near(std::size_t v) {
  ResultVertex& vertex = vertices_[v];
  if (vertex.is_grid || vertex.is_near) return vertex;
  vertex.is_near = true;
  const auto whole = [this](double at) {
    constexpr double kMost = 0x1p53;
    return static_cast<std::int64_t>(
        std::clamp(std::nearbyint(at * steps_), -kMost, kMost));
  };
  const auto& at = rounded_.vertices[v];
  vertex.point = {whole(at[0]), whole(at[1]), whole(at[2])};
  const fast::SolidVertex from = fast::vertex_at(solid_, rounded_.points[v]);
  less_[v] = meet_less(solid_, from.planes, vertex.point);
  return vertex;
}

/// The base's corner that the vertex is, if any: by points of the grid alone
/// unless all is exact.
std::optional<std::size_t> Carrier::corner_at(const Base& base, Part& part,
                                              std::size_t v) {
  if (is_exact_) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (csg::same(part.vertices->exact(base.vertices[k]),
                    surface_.point(rounded_.points[v])))
        return base.corner + k;
    }
    return std::nullopt;
  }
  const ResultVertex& vertex = vertices_[v];
  if (!vertex.is_grid) return std::nullopt;
  for (std::size_t k = 0; k < 3; ++k) {
    const GridPoint* at = part.vertices->on_grid(base.vertices[k]);
    if (at && *at == vertex.point) return base.corner + k;
  }
  return std::nullopt;
}

/// The base's corners less a point of the grid.
std::array<SeenPoint, 3> Carrier::seen_triangle(const Base& base, Part& part,
                                                const GridPoint& point) {
  std::array<SeenPoint, 3> triangle;
  for (std::size_t k = 0; k < 3; ++k) {
    const BoundedPoint at = part.vertices->less(base.vertices[k], point);
    triangle[k] = {at[(base.axis + 1) % 3], at[(base.axis + 2) % 3]};
  }
  return triangle;
}

std::optional<BoundedWeights> Carrier::bounded_weights(const Base& base,
                                                       Part& part,
                                                       std::size_t v) {
  const ResultVertex& vertex = vertex_near(v);
  const auto triangle = seen_triangle(base, part, vertex.point);
  if (vertex.is_grid) return weights_at(triangle, SeenPoint{});
  const BoundedPoint& less = less_.at(v);
  return weights_at(triangle,
                    {less[(base.axis + 1) % 3], less[(base.axis + 2) % 3]});
}

/// The values that are not known yet.
void Carrier::add_exactly(const Base& base, Part& part, std::size_t v,
                          std::span<double> values) {
  const Triangle triangle = exact_triangle(base, part);
  const Weights weights =
      weights_at(triangle, surface_.point(rounded_.points[v]));
  const Mesh& from = *part.properties;
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (known_[k]) continue;
    values[k] = value_of(weights, {from.fields_at(base.corner)[k],
                                   from.fields_at(base.corner + 1)[k],
                                   from.fields_at(base.corner + 2)[k]});
  }
}

}  // namespace

void carry_properties(const Evaluation& evaluation, const fast::Solid& solid,
                      const fast::ExportedMesh& rounded, Mesh& mesh,
                      FieldPath path) {
  Carrier(evaluation, solid, rounded, path, mesh).carry();
}

}  // namespace halfspace::detail
