#include "peers/soup.hpp"

#include <algorithm>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <numeric>

#include "halfspace/assert.hpp"

namespace halfspace::bench {
namespace {

std::array<double, 3> to_array(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

double w_of(const Soup& soup, const std::array<float, 3>& p) {
  const std::array<double, 4>& row = soup.to_image[2];
  return row[0] * static_cast<double>(p[0]) +
         row[1] * static_cast<double>(p[1]) +
         row[2] * static_cast<double>(p[2]) + row[3];
}

void add_polygon(const Scene& scene, PolygonId id, double scale, Soup& soup) {
  const auto corners = scene.corners(id);
  const auto colors = scene.corner_colors(id);
  const Pixel flat = to_pixel(scene.color(id));
  const auto corner = [&](std::size_t k) -> std::array<float, 3> {
    const GridPoint& p = scene.point(corners[k]);
    return {static_cast<float>(static_cast<double>(p.x) * scale),
            static_cast<float>(static_cast<double>(p.y) * scale),
            static_cast<float>(static_cast<double>(p.z) * scale)};
  };
  const auto color = [&](std::size_t k) {
    return colors.empty() ? flat : to_pixel(colors[k]);
  };
  for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
    soup.triangles.push_back({{corner(0), corner(k), corner(k + 1)},
                              {color(0), color(k), color(k + 1)},
                              flat,
                              id});
  }
}

}  // namespace

Soup make_soup(const Scene& scene, const Camera& camera) {
  const CameraData& data = camera.data();
  HALFSPACE_ASSERT(data.perspective);
  double greatest = 1;
  for (const GridPoint& p : scene.data().vertices) {
    for (const std::int64_t c : {p.x, p.y, p.z}) {
      greatest = std::max(greatest, std::abs(static_cast<double>(c)));
    }
  }
  const double scale = 1 / greatest;
  const auto to_vec = [scale](const LatticeVector& v) {
    constexpr double kSteps = 1 << kLatticeBits;
    return glm::dvec3(static_cast<double>(v.x), static_cast<double>(v.y),
                      static_cast<double>(v.z)) *
           (scale / kSteps);
  };
  const glm::dvec3 eye = to_vec(data.eye);
  const glm::dvec3 corner = to_vec(data.s0) - eye;
  const glm::dvec3 right = to_vec(data.sx);
  const glm::dvec3 down = to_vec(data.sy);

  Soup soup{};
  soup.width_px = data.width_px;
  soup.height_px = data.height_px;
  soup.eye = to_array(eye);
  soup.corner = to_array(corner);
  soup.right = to_array(right);
  soup.down = to_array(down);
  // p - eye = w (x right + y down + corner), solved for (x w, y w, w).
  const glm::dmat3 inverse = glm::inverse(glm::dmat3(right, down, corner));
  const glm::dvec3 offset = -(inverse * eye);
  for (int row = 0; row < 3; ++row) {
    const auto r = static_cast<std::size_t>(row);
    soup.to_image[r] = {inverse[0][row], inverse[1][row], inverse[2][row],
                        offset[row]};
  }

  soup.triangles.reserve(scene.polygon_count());
  const auto polygons = static_cast<PolygonId>(scene.polygon_count());
  for (PolygonId id = 0; id < polygons; ++id) {
    add_polygon(scene, id, scale, soup);
  }
  soup.near = std::numeric_limits<double>::infinity();
  for (const SoupTriangle& triangle : soup.triangles) {
    for (const std::array<float, 3>& p : triangle.corners) {
      soup.near = std::min(soup.near, w_of(soup, p));
      soup.far = std::max(soup.far, w_of(soup, p));
    }
  }
  HALFSPACE_ASSERT(soup.near > 0);
  soup.near *= 0.999;
  soup.far *= 1.001;
  return soup;
}

std::vector<std::uint32_t> order_of(const Soup& soup, Order order) {
  std::vector<std::uint32_t> indices(soup.triangles.size());
  std::iota(indices.begin(), indices.end(), 0u);
  if (order == Order::kInput) return indices;
  std::vector<double> depth;
  depth.reserve(indices.size());
  for (const SoupTriangle& t : soup.triangles) {
    const double sum = w_of(soup, t.corners[0]) + w_of(soup, t.corners[1]) +
                       w_of(soup, t.corners[2]);
    depth.push_back(order == Order::kFrontToBack ? sum : -sum);
  }
  std::stable_sort(indices.begin(), indices.end(),
                   [&depth](std::uint32_t a, std::uint32_t b) {
                     return depth[a] < depth[b];
                   });
  return indices;
}

}  // namespace halfspace::bench
