#include "rounding/resolve_mesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include "cases.hpp"
#include "halfspace/boolean.hpp"
#include "halfspace/fast/resolve.hpp"
#include "halfspace/fast/to_mesh.hpp"

namespace halfspace::fast {
namespace {

/// Adds a sphere of triangles whose points are rounded to the grid. `size`:
/// along each axis.
void add_sphere(GridMesh& mesh, const std::array<double, 3>& size, int stacks,
                int slices, const GridPoint& middle, bool inside_out) {
  const auto first = static_cast<std::int32_t>(mesh.points.size());
  const auto add = [&](double polar, double azimuth) {
    mesh.points.push_back(
        {middle.x + std::llround(size[0] * std::sin(polar) * std::cos(azimuth)),
         middle.y + std::llround(size[1] * std::sin(polar) * std::sin(azimuth)),
         middle.z + std::llround(size[2] * std::cos(polar))});
  };
  add(0, 0);
  for (int i = 1; i < stacks; ++i) {
    for (int j = 0; j < slices; ++j)
      add(std::numbers::pi * i / stacks, 2 * std::numbers::pi * j / slices);
  }
  add(std::numbers::pi, 0);
  const auto last = static_cast<std::int32_t>(mesh.points.size()) - 1;
  const auto at = [&](int i, int j) {
    return i == 0        ? first
           : i == stacks ? last
                         : first + 1 + (i - 1) * slices + j % slices;
  };
  const auto triangle = [&](std::int32_t a, std::int32_t b, std::int32_t c) {
    if (a == b || b == c || c == a) return;
    if (inside_out) std::swap(b, c);
    const auto source = static_cast<std::int32_t>(mesh.triangles.size());
    mesh.triangles.push_back({{a, b, c}, source});
  };
  for (int i = 0; i < stacks; ++i) {
    for (int j = 0; j < slices; ++j) {
      triangle(at(i, j), at(i + 1, j), at(i + 1, j + 1));
      triangle(at(i, j), at(i + 1, j + 1), at(i, j + 1));
    }
  }
}

/// Spheres, some of them inside out, that cross, hold or touch each other.
GridMesh some_spheres(std::mt19937_64& random, int count, std::int64_t size) {
  const auto among = [&](std::int64_t low, std::int64_t high) {
    return std::uniform_int_distribution<std::int64_t>(low, high)(random);
  };
  GridMesh mesh;
  for (int i = 0; i < count; ++i) {
    const auto radius = [&] {
      return static_cast<double>(among(size / 4, size));
    };
    const GridPoint middle = {among(-size, size), among(-size, size),
                              among(-size, size)};
    const auto stacks = static_cast<int>(among(2, 10));
    const auto slices = static_cast<int>(among(3, 14));
    add_sphere(mesh, {radius(), radius(), radius()}, stacks, slices, middle,
               among(0, 3) == 0);
  }
  mesh.moved.assign(mesh.points.size(), 1);
  clean(mesh);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    mesh.triangles[t].source = static_cast<std::int32_t>(t);
  return mesh;
}

double area_of(const StepPoint& p, const StepPoint& q, const StepPoint& r) {
  std::array<double, 3> u{}, v{};
  for (std::size_t k = 0; k < 3; ++k) {
    u[k] = q[k] - p[k];
    v[k] = r[k] - p[k];
  }
  return std::hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                    u[0] * v[1] - u[1] * v[0]) /
         2;
}

/// By triangle of `mesh`: the area of what resolve() leaves of it.
std::vector<double> areas_left_of_whole(const GridMesh& mesh) {
  SceneData data;
  data.grid_bits = grid_bits_for(mesh.points);
  data.vertices = mesh.points;
  for (const GridTriangle& t : mesh.triangles) {
    data.corners.insert(data.corners.end(), t.corners.begin(), t.corners.end());
    data.first_corner.push_back(
        static_cast<std::uint32_t>(data.corners.size()));
  }
  data.colors.resize(mesh.triangles.size());
  std::vector<double> areas(mesh.triangles.size());
  Result<Scene> scene = make_scene(std::move(data));
  EXPECT_TRUE(scene.has_value());
  if (!scene) return areas;
  const Result<GridSolid> solid = make_solid(*std::move(scene));
  EXPECT_TRUE(solid.has_value());
  if (!solid) return areas;
  const Solid resolved = resolve(to_solid(*solid)).solid;
  const ExportedMesh left = to_mesh(resolved, {.triangles = true});
  for (std::size_t t = 0; t < left.faces.size(); ++t) {
    const Face& face = resolved.faces[static_cast<std::size_t>(left.faces[t])];
    const auto at = [&](std::size_t i) {
      return left.vertices[static_cast<std::size_t>(left.corners[3 * t + i])];
    };
    areas[static_cast<std::size_t>(face.polygon)] +=
        area_of(at(0), at(1), at(2));
  }
  return areas;
}

/// The same, of what resolve_mesh() leaves.
std::vector<double> areas_left(GridMesh mesh, const MeshContacts& contacts) {
  std::vector<double> areas(mesh.triangles.size());
  MeshIndex index;
  const auto loose =
      resolve_mesh(mesh, contacts, index, FileGrid::of_bits(26), 1);
  EXPECT_TRUE(is_closed(mesh));
  std::vector<StepPoint> places;
  for (const GridPoint& p : mesh.points) {
    places.push_back({static_cast<double>(p.x), static_cast<double>(p.y),
                      static_cast<double>(p.z)});
  }
  for (const LoosePoint& p : loose)
    places[static_cast<std::size_t>(p.point)] = p.at;
  for (const GridTriangle& t : mesh.triangles) {
    const auto at = [&](std::size_t i) {
      return places[static_cast<std::size_t>(t.corners[i])];
    };
    areas[static_cast<std::size_t>(t.source)] += area_of(at(0), at(1), at(2));
  }
  return areas;
}

TEST(FastResolveMesh, APatchIsResolvedAsTheWholeSurfaceIs) {
  std::size_t with_rest = 0, in_parts = 0;
  for (unsigned seed = 0; seed < cases(300); ++seed) {
    std::mt19937_64 random(seed);
    // Small ones touch in points, edges and faces; large ones cross at random.
    const std::int64_t size = seed % 3 == 0 ? 6 : seed % 3 == 1 ? 40 : 100'000;
    const GridMesh mesh =
        some_spheres(random, 2 + static_cast<int>(seed % 4), size);
    const MeshContacts contacts = contacts_of(mesh, 1);
    std::vector<std::int32_t> meet;
    contacts.for_triangles([&](std::int32_t t) { meet.push_back(t); });
    std::sort(meet.begin(), meet.end());
    meet.erase(std::unique(meet.begin(), meet.end()), meet.end());
    if (!contacts.pairs.empty() && 2 * meet.size() < mesh.triangles.size())
      ++with_rest;
    if (contacts.pairs.empty() && !meet.empty()) ++in_parts;
    const std::vector<double> whole = areas_left_of_whole(mesh);
    const std::vector<double> patch = areas_left(mesh, contacts);
    const double most = 1e-9 * static_cast<double>(size * size);
    for (std::size_t t = 0; t < whole.size(); ++t)
      ASSERT_NEAR(whole[t], patch[t], most) << "seed " << seed << ", " << t;
  }
  EXPECT_GT(with_rest, cases(100));
  EXPECT_GT(in_parts, cases(10));
}

}  // namespace
}  // namespace halfspace::fast
