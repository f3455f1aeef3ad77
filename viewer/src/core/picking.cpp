#include "core/picking.hpp"

#include <fmt/format.h>

#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "halfspace/cap_parts.hpp"
#include "halfspace/fast/ray.hpp"
#include "halfspace/io/number.hpp"
#include "halfspace/io/ray.hpp"

namespace halfspace::viewer {
namespace {

using glm::dvec3;

double step_of(const Unit& unit) {
  return io::to_double({1, unit.exponent, unit.base == 10 ? unit.exponent : 0});
}

dvec3 vector_of(const GridPoint& p) { return dvec3(p.x, p.y, p.z); }

/// The normal of a polygon by its corners.
dvec3 normal_of(const Scene& scene, PolygonId polygon) {
  const auto corners = scene.corners(polygon);
  const dvec3 first = vector_of(scene.point(corners[0]));
  dvec3 sum(0);
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    sum += glm::cross(vector_of(scene.point(corners[i])) - first,
                      vector_of(scene.point(corners[i + 1])) - first);
  }
  return glm::normalize(sum);
}

/// Where a pixel sees a cap, whose nearest corner is that point itself.
PickedPoint picked_cap(const Scene& scene, const Camera& camera,
                       const ClipPlane& plane, PickedPoint result,
                       std::int32_t x, std::int32_t y) {
  const double step = step_of(scene.unit());
  const double lattice = 1 << kLatticeBits;
  const auto vector = [&](const LatticeVector& v) {
    return dvec3(static_cast<double>(v.x), static_cast<double>(v.y),
                 static_cast<double>(v.z)) /
           lattice;
  };
  const dvec3 eye = vector(camera->eye);
  const dvec3 s = vector(camera->s0) + (x + 0.5) * vector(camera->sx) +
                  (y + 0.5) * vector(camera->sy);
  const dvec3 normal(static_cast<double>(plane.a), static_cast<double>(plane.b),
                     static_cast<double>(plane.c));
  const dvec3 start = camera->perspective ? eye : s;
  const dvec3 along = camera->perspective ? s - eye : -eye;
  const double t = -(glm::dot(normal, start) + static_cast<double>(plane.d)) /
                   glm::dot(normal, along);
  result.part = kCapPart;
  result.point = step * (start + t * along);
  result.corner = result.point;
  for (int axis = 0; axis < 3; ++axis) {
    result.exact_corner[static_cast<std::size_t>(axis)] =
        fmt::format("{:.6g}", result.point[axis]);
  }
  // Towards what was removed.
  result.normal = -glm::normalize(normal);
  return result;
}

/// Adds the area of the face, and its polygons.
void add_face(const Model& model, PickedPoint& result) {
  // As many as can be told apart on a screen.
  constexpr std::size_t kMostPolygons = 2000;
  const Scene& scene = model.loaded.file.scene;
  const double step = step_of(scene.unit());
  for (std::size_t p = 0; p < model.faces.size(); ++p) {
    if (model.faces[p] != result.face || model.parts[p] != result.part)
      continue;
    std::vector<dvec3> corners;
    for (const VertexId corner : scene.corners(static_cast<PolygonId>(p)))
      corners.push_back(step * vector_of(scene.point(corner)));
    dvec3 sum(0);
    for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
      sum += glm::cross(corners[i] - corners[0], corners[i + 1] - corners[0]);
    }
    result.face_area += glm::length(sum) / 2;
    if (result.face_polygons.size() < kMostPolygons)
      result.face_polygons.push_back(std::move(corners));
  }
}

}  // namespace

std::string decimal_text(std::int64_t coordinate, const Unit& unit) {
  const io::Number number = io::normalised(coordinate, unit.exponent,
                                           unit.base == 10 ? unit.exponent : 0);
  // As an integer over a power of ten.
  const int places = std::max({-number.two, -number.five, 0});
  constexpr int kMostPlaces = 40;
  if (places > kMostPlaces || number.two > 200 || number.five > 200)
    return fmt::format("{}", io::to_double(number));
  namespace mp = boost::multiprecision;
  io::Integer value = number.mantissa;
  value <<= static_cast<unsigned>(number.two + places);
  value *= mp::pow(io::Integer(5), static_cast<unsigned>(number.five + places));
  const bool is_negative = value < 0;
  std::string digits = io::Integer(abs(value)).str();
  const auto count = static_cast<std::size_t>(places);
  if (digits.size() <= count) digits.insert(0, count + 1 - digits.size(), '0');
  if (count > 0) digits.insert(digits.size() - count, ".");
  return (is_negative ? "-" : "") + digits;
}

std::optional<PickedPoint> picked(const Model& model, const Camera& camera,
                                  const ImageOptions& options, std::int32_t x,
                                  std::int32_t y) {
  if (x < 0 || y < 0 || x >= camera->width_px || y >= camera->height_px)
    return std::nullopt;
  const Scene& scene = model.loaded.file.scene;
  const PolygonId polygon =
      fast::pick(scene, *model.tree, camera, options, x, y);
  if (polygon == kBackground) return std::nullopt;
  PickedPoint result;
  result.polygon = polygon;
  const auto p = static_cast<std::size_t>(polygon);
  if (p >= scene.polygon_count()) {
    const CapItem cap = cap_item(p - scene.polygon_count());
    result = picked_cap(scene, camera, options.clips[cap.plane], result, x, y);
    if (options.parts) {
      result.is_overlap = cap.part == options.parts->count();
      if (!result.is_overlap) result.cap_part = cap.part;
    }
    return result;
  }
  result.part = model.parts[p];
  result.face = model.faces[p];
  add_face(model, result);
  result.point = io::pixel_point(scene, camera, polygon, x, y).point;
  const double step = step_of(scene.unit());
  const dvec3 at = result.point / step;
  result.normal = normal_of(scene, polygon);
  double least = std::numeric_limits<double>::infinity();
  for (const VertexId corner : scene.corners(polygon)) {
    const GridPoint& point = scene.point(corner);
    const double distance = glm::distance(vector_of(point), at);
    if (!(distance < least)) continue;
    least = distance;
    result.corner = step * vector_of(point);
    result.exact_corner = {decimal_text(point.x, scene.unit()),
                           decimal_text(point.y, scene.unit()),
                           decimal_text(point.z, scene.unit())};
  }
  return result;
}

}  // namespace halfspace::viewer
