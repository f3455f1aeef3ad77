#include "shapes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <vector>

#include "halfspace/boolean.hpp"
#include "halfspace/fast/check_operand.hpp"

namespace halfspace::fast::shapes {
namespace {

std::array<double, 3> moved(const std::array<double, 3>& p, const Motion& m) {
  std::array<double, 3> q = m.shift;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) q[i] += m.rotation[i][j] * p[j];
  }
  return q;
}

struct Surface {
  std::vector<std::array<double, 3>> points;
  std::vector<std::array<VertexId, 3>> triangles;
};

Solid solid_of(const Surface& surface, const Motion& motion,
               const Solid* with) {
  SceneData data;
  data.unit = {2, 0};
  data.grid_bits = 54;
  for (const auto& p : surface.points) {
    const auto q = moved(p, motion);
    data.vertices.push_back(
        {std::llround(q[0]), std::llround(q[1]), std::llround(q[2])});
  }
  for (const auto& t : surface.triangles) {
    data.corners.insert(data.corners.end(), t.begin(), t.end());
    data.first_corner.push_back(
        static_cast<std::uint32_t>(data.corners.size()));
  }
  data.colors.resize(surface.triangles.size());
  Result<Scene> scene = make_scene(std::move(data));
  if (!scene) return {};
  const auto solid = make_solid(*std::move(scene));
  if (!solid) return {};
  return with != nullptr ? to_solid(*solid, *with) : to_solid(*solid);
}

}  // namespace

Motion turned(std::mt19937_64& random, double angle) {
  std::normal_distribution<double> normal;
  std::array<double, 3> a{};
  double size = 0;
  for (double& c : a) {
    c = normal(random);
    size += c * c;
  }
  for (double& c : a) c /= std::sqrt(size);
  const double s = std::sin(angle), c = std::cos(angle);
  Motion m;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j)
      m.rotation[i][j] = (1 - c) * a[i] * a[j] + (i == j ? c : 0);
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    m.rotation[j][k] -= s * a[i];
    m.rotation[k][j] += s * a[i];
  }
  return m;
}

Motion turned_about_each_axis(double angle) {
  const double s = std::sin(angle), c = std::cos(angle);
  Motion m;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    for (auto& row : m.rotation) {
      const double a = row[j], b = row[k];
      row[j] = c * a + s * b;
      row[k] = c * b - s * a;
    }
  }
  return m;
}

Solid box(const std::array<double, 3>& low, const std::array<double, 3>& high,
          const Motion& motion, const Solid* with) {
  Surface surface;
  for (int corner = 0; corner < 8; ++corner) {
    surface.points.push_back({(corner & 1) != 0 ? high[0] : low[0],
                              (corner & 2) != 0 ? high[1] : low[1],
                              (corner & 4) != 0 ? high[2] : low[2]});
  }
  constexpr std::array<std::array<VertexId, 4>, 6> kFaces = {{{0, 2, 3, 1},
                                                              {4, 5, 7, 6},
                                                              {0, 1, 5, 4},
                                                              {2, 6, 7, 3},
                                                              {0, 4, 6, 2},
                                                              {1, 3, 7, 5}}};
  for (const auto& f : kFaces) {
    surface.triangles.push_back({f[0], f[1], f[2]});
    surface.triangles.push_back({f[0], f[2], f[3]});
  }
  return solid_of(surface, motion, with);
}

Solid sphere(double radius, int stacks, int slices, const Motion& motion,
             const Solid* with) {
  Surface surface;
  surface.points.push_back({0, 0, radius});
  for (int i = 1; i < stacks; ++i) {
    const double a = std::numbers::pi * i / stacks;
    for (int j = 0; j < slices; ++j) {
      const double b = 2 * std::numbers::pi * j / slices;
      surface.points.push_back({radius * std::sin(a) * std::cos(b),
                                radius * std::sin(a) * std::sin(b),
                                radius * std::cos(a)});
    }
  }
  surface.points.push_back({0, 0, -radius});
  const auto last = static_cast<VertexId>(surface.points.size() - 1);
  const auto at = [&](int i, int j) -> VertexId {
    if (i == 0) return 0;
    if (i == stacks) return last;
    return 1 + (i - 1) * slices + j % slices;
  };
  for (int i = 0; i < stacks; ++i) {
    for (int j = 0; j < slices; ++j) {
      if (i > 0)
        surface.triangles.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
      if (i + 1 < stacks) {
        surface.triangles.push_back(
            {at(i, j + 1), at(i + 1, j), at(i + 1, j + 1)});
      }
    }
  }
  return solid_of(surface, motion, with);
}

std::string fault_of(const RoundedMesh& mesh, FileNumber number) {
  std::set<std::array<double, 3>> places;
  int step = 2000;
  for (const auto& at : mesh.vertices) {
    if (!places.insert(at).second) return "two vertices in one place";
    for (const double c : at) {
      if (number == FileNumber::kFloat && double{static_cast<float>(c)} != c)
        return "a coordinate is no float";
      if (c == 0) continue;
      int exponent = 0;
      double rest = std::frexp(c, &exponent);
      while (rest != std::floor(rest)) {
        rest *= 2;
        --exponent;
      }
      step = std::min(step, exponent);
    }
  }
  SceneData data;
  data.unit = {2, step};
  for (const auto& at : mesh.vertices) {
    GridPoint p;
    p.x = static_cast<std::int64_t>(std::ldexp(at[0], -step));
    p.y = static_cast<std::int64_t>(std::ldexp(at[1], -step));
    p.z = static_cast<std::int64_t>(std::ldexp(at[2], -step));
    data.vertices.push_back(p);
  }
  data.grid_bits = grid_bits_for(data.vertices);
  data.first_corner = mesh.first_corner;
  data.corners = mesh.corners;
  data.colors = mesh.colors;
  Result<Scene> scene = make_scene(std::move(data));
  if (!scene) return scene.error().message;
  for (std::size_t p = 0; p < scene->polygon_count(); ++p) {
    const auto corners = scene->corners(static_cast<PolygonId>(p));
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const GridPoint &a = scene->point(corners[i]),
                      &b = scene->point(corners[(i + 1) % corners.size()]),
                      &c = scene->point(corners[(i + 2) % corners.size()]);
      const auto cross = [](std::int64_t s, std::int64_t t, std::int64_t u,
                            std::int64_t v) {
        return Int128{s} * v - Int128{t} * u;
      };
      if (cross(b.x - a.x, b.y - a.y, c.x - a.x, c.y - a.y) == 0 &&
          cross(b.y - a.y, b.z - a.z, c.y - a.y, c.z - a.z) == 0 &&
          cross(b.z - a.z, b.x - a.x, c.z - a.z, c.x - a.x) == 0)
        return "a straight corner";
    }
  }
  if (scene->polygon_count() == 0) return "";
  const auto solid = make_solid(*std::move(scene));
  if (!solid) return solid.error().message;
  const Result<Done> fine = check_operand(to_solid(*solid));
  return fine ? "" : fine.error().message;
}

double volume_of(const RoundedMesh& mesh) {
  double sum = 0;
  for (std::size_t p = 0; p < mesh.faces.size(); ++p) {
    const std::size_t first = mesh.first_corner[p];
    for (std::size_t i = first + 1; i + 1 < mesh.first_corner[p + 1]; ++i) {
      const auto at = [&](std::size_t k) {
        return mesh.vertices[static_cast<std::size_t>(mesh.corners[k])];
      };
      const auto a = at(first), b = at(i), c = at(i + 1);
      sum += a[0] * (b[1] * c[2] - b[2] * c[1]) +
             a[1] * (b[2] * c[0] - b[0] * c[2]) +
             a[2] * (b[0] * c[1] - b[1] * c[0]);
    }
  }
  return sum;
}

}  // namespace halfspace::fast::shapes
