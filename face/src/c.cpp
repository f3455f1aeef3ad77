#include "halfspace/c.h"

#include <algorithm>
#include <cstring>
#include <utility>
#include <vector>

#include "halfspace/halfspace.hpp"

using halfspace::Error;
using halfspace::Mesh;
using halfspace::Point;
using halfspace::Result;
using halfspace::Solid;

struct halfspace_solid {
  Solid solid;
};

struct halfspace_mesh {
  std::vector<double> vertices;
  std::vector<std::int32_t> triangles;
  std::vector<std::int32_t> origins;
};

namespace {

static_assert(sizeof(Point) == 3 * sizeof(double));

halfspace_solid* handle(Solid solid) {
  return new halfspace_solid{std::move(solid)};
}

Point point_of(const double at[3]) { return {at[0], at[1], at[2]}; }

int failed(const Error& from, halfspace_error* to) {
  const int code = static_cast<int>(from.code);
  if (to != nullptr) {
    to->code = code;
    to->index = from.index;
    const std::size_t size =
        std::min(from.message.size(), sizeof to->message - 1);
    std::memcpy(to->message, from.message.data(), size);
    to->message[size] = '\0';
  }
  return code + 1;
}

}  // namespace

const char* halfspace_version() { return HALFSPACE_VERSION; }

halfspace_solid* halfspace_box(const double corner[3],
                               const double opposite[3]) {
  return handle(Solid::box(point_of(corner), point_of(opposite)));
}

halfspace_solid* halfspace_sphere(double radius, int segments) {
  return handle(Solid::sphere(radius, segments));
}

halfspace_solid* halfspace_cylinder(double radius, double height,
                                    int segments) {
  return handle(Solid::cylinder(radius, height, segments));
}

halfspace_solid* halfspace_from_mesh(const double* vertices,
                                     size_t vertex_count,
                                     const uint32_t* first_corner,
                                     size_t polygon_count,
                                     const int32_t* corners) {
  Mesh mesh;
  for (std::size_t v = 0; v < vertex_count; ++v)
    mesh.vertices.push_back(point_of(vertices + 3 * v));
  mesh.first_corner.assign(first_corner, first_corner + polygon_count + 1);
  mesh.corners.assign(corners, corners + first_corner[polygon_count]);
  return handle(Solid::from_mesh(std::move(mesh)));
}

halfspace_solid* halfspace_from_file(const char* path) {
  return handle(Solid::from_file(path));
}

halfspace_solid* halfspace_from_text(const char* script) {
  return handle(Solid::from_text(script));
}

halfspace_solid* halfspace_combine(char operation, const halfspace_solid* a,
                                   const halfspace_solid* b) {
  switch (operation) {
    case '+':
      return handle(a->solid + b->solid);
    case '-':
      return handle(a->solid - b->solid);
    case '&':
      return handle(a->solid & b->solid);
    case '^':
      return handle(a->solid ^ b->solid);
    default:
      return handle(Solid());
  }
}

halfspace_solid* halfspace_transform(const halfspace_solid* solid,
                                     const double rows[12]) {
  halfspace::AffineMap map{};
  for (std::size_t i = 0; i < 12; ++i) map[i / 4][i % 4] = rows[i];
  return handle(solid->solid.transformed(map));
}

void halfspace_free_solid(halfspace_solid* solid) { delete solid; }

int halfspace_volume(const halfspace_solid* solid, double* volume,
                     halfspace_error* error) {
  const Result<double> result = solid->solid.volume();
  if (!result) return failed(result.error(), error);
  *volume = *result;
  return 0;
}

int halfspace_locate(const halfspace_solid* solid, const double point[3],
                     int* side, halfspace_error* error) {
  const auto result = solid->solid.locate(point_of(point));
  if (!result) return failed(result.error(), error);
  *side = *result == halfspace::Location::kOn       ? 0
          : *result == halfspace::Location::kInside ? -1
                                                    : 1;
  return 0;
}

int halfspace_save(const halfspace_solid* solid, const char* path,
                   halfspace_error* error) {
  const auto result = solid->solid.save(path);
  return result ? 0 : failed(result.error(), error);
}

int halfspace_to_mesh(const halfspace_solid* solid, halfspace_mesh** mesh,
                      halfspace_error* error) {
  const Result<Mesh> from = solid->solid.mesh({.triangles = true});
  if (!from) return failed(from.error(), error);
  auto* made = new halfspace_mesh;
  for (const Point& p : from->vertices)
    made->vertices.insert(made->vertices.end(), {p.x, p.y, p.z});
  made->triangles = from->corners;
  for (const auto& [operand, polygon] : from->origins) {
    made->origins.insert(made->origins.end(),
                         {static_cast<std::int32_t>(operand), polygon});
  }
  *mesh = made;
  return 0;
}

size_t halfspace_vertex_count(const halfspace_mesh* mesh) {
  return mesh->vertices.size() / 3;
}

size_t halfspace_triangle_count(const halfspace_mesh* mesh) {
  return mesh->triangles.size() / 3;
}

const double* halfspace_vertices(const halfspace_mesh* mesh) {
  return mesh->vertices.data();
}

const int32_t* halfspace_triangles(const halfspace_mesh* mesh) {
  return mesh->triangles.data();
}

const int32_t* halfspace_origins(const halfspace_mesh* mesh) {
  return mesh->origins.data();
}

void halfspace_free_mesh(halfspace_mesh* mesh) { delete mesh; }
