#include "fields.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "halfspace/csg/interval.hpp"

namespace halfspace::detail {
namespace {

using csg::area2;
using csg::ExactPoint;
using csg::ExactSurface;
using csg::in_steps;
using csg::Integer;
using csg::longest_axis;
using csg::nearest_double;
using csg::same;

/// What a half-space cut has no colour of its own.
constexpr Rgb kCutColor{170, 170, 170};

/// A field's value where there is none.
constexpr double kNoField = 0;

/// The affine function over a polygon: its values at three of its corners,
/// and those corners, in homogeneous integers of some common scale.
struct Triangle {
  std::array<ExactPoint, 3> points;
  std::array<std::size_t, 3> corners{};  ///< of the operand's mesh
  std::size_t axis = 0;                  ///< along which areas are seen
  Integer area2;                         ///< as area2() has it
};

/// A double as numerator / 2^-two, two <= 0.
struct Dyadic {
  Integer mantissa;
  std::int32_t two = 0;
};
Dyadic dyadic_of(double value) {
  const io::Number number = io::number_of(value);
  Dyadic result{
      number.mantissa * pow(Integer(5), static_cast<unsigned>(number.five)),
      number.two};
  if (result.two > 0) {
    result.mantissa <<= result.two;
    result.two = 0;
  }
  return result;
}

class Carrier {
 public:
  Carrier(const Evaluation& evaluation, const fast::Solid& solid,
          const fast::ExportedMesh& rounded, Mesh& mesh)
      : evaluation_(evaluation),
        solid_(solid),
        rounded_(rounded),
        mesh_(mesh),
        surface_(solid) {}
  void carry();

 private:
  const LeafData* data_of(const fast::Face& face) const;
  void carry_fields();
  const ExactPoint& corner_at(const fast::Face& face, const LeafData& data,
                              std::size_t corner);
  std::optional<Triangle> triangle_of(const fast::Face& face,
                                      const LeafData& data);
  void add_fields(const Mesh& properties, const Triangle& triangle,
                  const ExactPoint& at);

  const Evaluation& evaluation_;
  const fast::Solid& solid_;
  const fast::ExportedMesh& rounded_;
  Mesh& mesh_;
  ExactSurface surface_;
  std::map<std::pair<std::int32_t, std::size_t>, ExactPoint> corners_;
};

/// The operand's data; null of a half-space's face.
const LeafData* Carrier::data_of(const fast::Face& face) const {
  const auto part = static_cast<std::size_t>(face.part);
  if (part >= evaluation_.uses.size()) return nullptr;
  return &*evaluation_.uses[part].node->leaf->data();
}

void Carrier::carry() {
  std::size_t field_count = 0;
  bool any_colors = false, any_materials = false;
  for (const Evaluation::Use& use : evaluation_.uses) {
    const auto& properties = use.node->leaf->data()->properties;
    if (!properties) continue;
    any_colors = any_colors || !properties->colors.empty();
    any_materials = any_materials || !properties->materials.empty();
    field_count = std::max(field_count, properties->field_count);
  }
  for (const std::int32_t f : rounded_.faces) {
    const fast::Face& face = solid_.faces[static_cast<std::size_t>(f)];
    const LeafData* data = data_of(face);
    const Mesh* properties = data ? data->properties.get() : nullptr;
    const auto polygon = static_cast<std::size_t>(face.polygon);
    if (any_colors) {
      const bool has = properties && !properties->colors.empty();
      mesh_.colors.push_back(has ? properties->colors[polygon] : kCutColor);
    }
    if (any_materials) {
      const bool has = properties && !properties->materials.empty();
      mesh_.materials.push_back(has ? properties->materials[polygon] : 0);
    }
  }
  mesh_.field_count = field_count;
  if (field_count > 0) carry_fields();
}

void Carrier::carry_fields() {
  for (std::size_t p = 0; p < rounded_.faces.size(); ++p) {
    const auto f = static_cast<std::size_t>(rounded_.faces[p]);
    const fast::Face& face = solid_.faces[f];
    const LeafData* data = data_of(face);
    std::optional<Triangle> triangle;
    if (data && data->properties && data->properties->field_count > 0)
      triangle = triangle_of(face, *data);
    for (std::size_t i = rounded_.first_corner[p];
         i < rounded_.first_corner[p + 1]; ++i) {
      const auto v = static_cast<std::size_t>(rounded_.corners[i]);
      if (triangle) {
        add_fields(*data->properties, *triangle,
                   surface_.point(rounded_.points[v]));
      }
      // Operands may have fewer fields than others, or none.
      mesh_.fields.resize((i + 1) * mesh_.field_count, kNoField);
    }
  }
}

/// The point of a corner of the face's operand, where the result is.
const ExactPoint& Carrier::corner_at(const fast::Face& face,
                                     const LeafData& data, std::size_t corner) {
  const auto [at, is_new] = corners_.try_emplace({face.part, corner});
  if (is_new) {
    const auto& use = evaluation_.uses[static_cast<std::size_t>(face.part)];
    at->second =
        in_steps(csg::image_of(use.matrix, data.corners[corner]), solid_.unit);
  }
  return at->second;
}

/// The first three corners of the face's polygon that are not on a line, as
/// seen along the normal's longest component; nothing where there are none.
std::optional<Triangle> Carrier::triangle_of(const fast::Face& face,
                                             const LeafData& data) {
  const std::size_t axis = longest_axis(surface_.normal(face));
  const auto polygon = static_cast<std::size_t>(face.polygon);
  const std::size_t first = data.properties->first_corner[polygon];
  const std::size_t last = data.properties->first_corner[polygon + 1];
  for (std::size_t i = first; i + 2 < last; ++i) {
    Triangle triangle;
    triangle.axis = axis;
    for (std::size_t k = 0; k < 3; ++k) {
      triangle.corners[k] = i + k;
      triangle.points[k] = corner_at(face, data, i + k);
    }
    triangle.area2 =
        area2(triangle.points[0], triangle.points[1], triangle.points[2], axis);
    if (triangle.area2 != 0) return triangle;
  }
  return std::nullopt;
}

/// Adds the values at a point: those of a corner where it is one, else their
/// mean weighted by the areas of the triangles that the point has with the
/// other two.
void Carrier::add_fields(const Mesh& properties, const Triangle& triangle,
                         const ExactPoint& at) {
  const auto& p = triangle.points;
  for (std::size_t k = 0; k < 3; ++k) {
    if (!same(p[k], at)) continue;
    const auto fields = properties.fields_at(triangle.corners[k]);
    mesh_.fields.insert(mesh_.fields.end(), fields.begin(), fields.end());
    return;
  }
  // Each area has the product of its corners' denominators; the weight's is
  // the point's in place of its corner's.
  std::array<Integer, 3> weights;
  for (std::size_t k = 0; k < 3; ++k) {
    weights[k] =
        area2(p[(k + 1) % 3], p[(k + 2) % 3], at, triangle.axis) * p[k].below;
  }
  Integer below = triangle.area2 * at.below;
  if (below < 0) {
    below = -below;
    for (Integer& weight : weights) weight = -weight;
  }
  for (std::size_t field = 0; field < properties.field_count; ++field) {
    std::array<Dyadic, 3> values;
    std::int32_t two = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      values[k] = dyadic_of(properties.fields_at(triangle.corners[k])[field]);
      two = std::min(two, values[k].two);
    }
    Integer sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      sum += weights[k] *
             (values[k].mantissa << static_cast<unsigned>(values[k].two - two));
    }
    mesh_.fields.push_back(
        nearest_double(sum, below << static_cast<unsigned>(-two)));
  }
}

}  // namespace

void carry_properties(const Evaluation& evaluation, const fast::Solid& solid,
                      const fast::ExportedMesh& rounded, Mesh& mesh) {
  Carrier(evaluation, solid, rounded, mesh).carry();
}

}  // namespace halfspace::detail
