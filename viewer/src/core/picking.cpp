#include "core/picking.hpp"

#include <fmt/format.h>

#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "halfspace/fast/render.hpp"
#include "halfspace/io/number.hpp"

namespace halfspace::viewer {
namespace {

using glm::dvec3;

/// Lattice steps in a grid step.
constexpr double kLatticePerGrid = 1 << kLatticeBits;

double step_of(const Unit& unit) {
  return io::to_double({1, unit.exponent, unit.base == 10 ? unit.exponent : 0});
}

dvec3 vector_of(const LatticeVector& v) {
  return dvec3(static_cast<double>(v.x), static_cast<double>(v.y),
               static_cast<double>(v.z)) /
         kLatticePerGrid;
}

dvec3 vector_of(const GridPoint& p) { return dvec3(p.x, p.y, p.z); }

/// The ray through a pixel's centre. Units: grid steps.
struct Ray {
  dvec3 origin;
  dvec3 direction;
};

Ray ray_of(const Camera& camera, double x, double y) {
  const CameraData& data = camera.data();
  const dvec3 s =
      vector_of(data.s0) + x * vector_of(data.sx) + y * vector_of(data.sy);
  const dvec3 eye = vector_of(data.eye);
  if (data.perspective) return {eye, s - eye};
  return {s, -eye};
}

PolygonId polygon_at(const Model& model, const Camera& camera,
                     const ImageOptions& options, std::int32_t x,
                     std::int32_t y) {
  fast::RenderOptions how;
  how.rectangle = {x, y, x + 1, y + 1};
  how.colors = false;
  return fast::render(model.loaded.file.scene, *model.tree, camera, options,
                      how)
      .items.pixels.front();
}

/// The normal of a polygon by its corners, of any length.
dvec3 normal_of(const Scene& scene, PolygonId polygon) {
  const auto corners = scene.corners(polygon);
  dvec3 sum(0);
  const dvec3 first = vector_of(scene.point(corners[0]));
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    sum += glm::cross(vector_of(scene.point(corners[i])) - first,
                      vector_of(scene.point(corners[i + 1])) - first);
  }
  return sum;
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
  const PolygonId polygon = polygon_at(model, camera, options, x, y);
  if (polygon == kBackground) return std::nullopt;
  const Scene& scene = model.loaded.file.scene;
  PickedPoint result;
  result.polygon = polygon;
  const auto p = static_cast<std::size_t>(polygon);
  result.part = model.parts[p];
  result.face = model.loaded.polygons[p];
  for (std::uint32_t i = 0; i < result.part; ++i) {
    if (model.face_counts[i] > 0)
      result.face -= static_cast<std::int32_t>(model.face_counts[i]);
  }
  const Ray ray = ray_of(camera, x + 0.5, y + 0.5);
  const dvec3 normal = normal_of(scene, polygon);
  const dvec3 base = vector_of(scene.point(scene.corners(polygon)[0]));
  const double steep = glm::dot(normal, ray.direction);
  const double step = step_of(scene.unit());
  dvec3 at = base;
  if (steep != 0) {
    at = ray.origin +
         glm::dot(normal, base - ray.origin) / steep * ray.direction;
  }
  result.point = step * at;
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
