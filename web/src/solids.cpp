#include <array>
#include <string_view>
#include <utility>

#include "answer.hpp"
#include "halfspace/solid.hpp"

namespace halfspace::web {
namespace {

std::int32_t given(Solid solid) {
  return handle_of(new Solid(std::move(solid)));
}

OperandOptions operand_options_of(std::uint32_t flags) {
  OperandOptions options;
  options.resolve = (flags & 1u) != 0;
  options.merge_coplanar = (flags & 2u) == 0;
  options.may_round = (flags & 4u) != 0;
  return options;
}

MeshOptions mesh_options_of(std::int32_t merge, std::int32_t triangles) {
  MeshOptions options;
  options.merge = static_cast<MergeFaces>(merge);
  options.triangles = triangles != 0;
  options.progress = goes_on;
  return options;
}

std::vector<Point2> points_from(const double* numbers, std::int32_t count) {
  std::vector<Point2> points;
  for (std::int32_t k = 0; k < count; ++k)
    points.push_back({numbers[2 * k], numbers[2 * k + 1]});
  return points;
}

int number(Result<double> result) {
  return answered(result, [](double v) { answer().numbers = {v}; });
}

}  // namespace

HALFSPACE_EXPORT(hs_free_solid) void hs_free_solid(Solid* solid) {
  delete solid;
}
HALFSPACE_EXPORT(hs_empty) std::int32_t hs_empty() { return given({}); }
HALFSPACE_EXPORT(hs_box)
std::int32_t hs_box(double x, double y, double z, double u, double v,
                    double w) {
  return given(Solid::box({x, y, z}, {u, v, w}));
}
HALFSPACE_EXPORT(hs_sphere)
std::int32_t hs_sphere(double radius, int segments) {
  return given(Solid::sphere(radius, segments));
}
HALFSPACE_EXPORT(hs_cone)
std::int32_t hs_cone(double bottom, double top, double height, int segments) {
  return given(bottom == top ? Solid::cylinder(bottom, height, segments)
                             : Solid::cone(bottom, top, height, segments));
}
HALFSPACE_EXPORT(hs_torus)
std::int32_t hs_torus(double radius, double tube, int segments,
                      int tube_segments) {
  return given(Solid::torus(radius, tube, segments, tube_segments));
}
/// Loops of points, the first the outline and the others holes.
HALFSPACE_EXPORT(hs_prism)
std::int32_t hs_prism(const double* points, const std::int32_t* sizes,
                      std::int32_t loops, double height) {
  Outline outline;
  for (std::int32_t l = 0; l < loops; ++l) {
    auto loop = points_from(points, sizes[l]);
    points += 2 * sizes[l];
    if (l == 0) {
      outline.points = std::move(loop);
    } else {
      outline.holes.push_back(std::move(loop));
    }
  }
  return given(Solid::prism(outline, height));
}
HALFSPACE_EXPORT(hs_revolution)
std::int32_t hs_revolution(const double* points, std::int32_t count,
                           int segments) {
  return given(Solid::revolution(points_from(points, count), segments));
}
HALFSPACE_EXPORT(hs_hull)
std::int32_t hs_hull(const Point* points, std::int32_t count) {
  return given(Solid::hull({points, points + count}));
}
HALFSPACE_EXPORT(hs_half_space)
std::int32_t hs_half_space(double x, double y, double z, double offset) {
  return given(Solid::half_space({{x, y, z}, offset}));
}
HALFSPACE_EXPORT(hs_from_file)
std::int32_t hs_from_file(const char* name, std::uint32_t size,
                          std::uint32_t flags) {
  return given(
      Solid::from_file(std::string(name, size), operand_options_of(flags)));
}
HALFSPACE_EXPORT(hs_from_text)
std::int32_t hs_from_text(const char* script, std::uint32_t size) {
  return given(Solid::from_text({script, size}));
}
/// A mesh of triangles, or of polygons where `first_corner` is not null; the
/// polygons' materials may be null.
HALFSPACE_EXPORT(hs_from_mesh)
std::int32_t hs_from_mesh(const Point* vertices, std::uint32_t vertex_count,
                          const std::uint32_t* first_corner,
                          std::uint32_t polygon_count,
                          const std::int32_t* corners,
                          const std::int32_t* materials, std::uint32_t flags) {
  Mesh mesh;
  mesh.vertices.assign(vertices, vertices + vertex_count);
  if (first_corner != nullptr) {
    mesh.first_corner.assign(first_corner, first_corner + polygon_count + 1);
  } else {
    for (std::uint32_t p = 1; p <= polygon_count; ++p)
      mesh.first_corner.push_back(3 * p);
  }
  mesh.corners.assign(corners, corners + mesh.first_corner.back());
  if (materials != nullptr)
    mesh.materials.assign(materials, materials + polygon_count);
  return given(Solid::from_mesh(std::move(mesh), operand_options_of(flags)));
}

HALFSPACE_EXPORT(hs_combine)
std::int32_t hs_combine(int operation, const Solid* a, const Solid* b) {
  switch (operation) {
    case 0:
      return given(*a + *b);
    case 1:
      return given(*a - *b);
    case 2:
      return given(*a & *b);
    default:
      return given(*a ^ *b);
  }
}
/// The union, or the intersection, of many.
HALFSPACE_EXPORT(hs_combine_all)
std::int32_t hs_combine_all(int intersects, const Solid* const* handles,
                            std::int32_t count) {
  std::vector<Solid> solids;
  for (std::int32_t k = 0; k < count; ++k) solids.push_back(*handles[k]);
  return given(intersects != 0 ? Solid::intersection_of(solids)
                               : Solid::union_of(solids));
}
HALFSPACE_EXPORT(hs_complement)
std::int32_t hs_complement(const Solid* solid) { return given(~*solid); }

HALFSPACE_EXPORT(hs_translated)
std::int32_t hs_translated(const Solid* s, double x, double y, double z) {
  return given(s->translated({x, y, z}));
}
HALFSPACE_EXPORT(hs_scaled)
std::int32_t hs_scaled(const Solid* s, double x, double y, double z) {
  return given(s->scaled({x, y, z}));
}
HALFSPACE_EXPORT(hs_rotated)
std::int32_t hs_rotated(const Solid* s, double x, double y, double z,
                        double degrees) {
  return given(s->rotated({x, y, z}, degrees));
}
HALFSPACE_EXPORT(hs_mirrored)
std::int32_t hs_mirrored(const Solid* s, double x, double y, double z,
                         double offset) {
  return given(s->mirrored({{x, y, z}, offset}));
}
HALFSPACE_EXPORT(hs_transformed)
std::int32_t hs_transformed(const Solid* s, const double* rows) {
  AffineMap map{};
  for (std::size_t k = 0; k < 12; ++k) map[k / 4][k % 4] = rows[k];
  return given(s->transformed(map));
}
HALFSPACE_EXPORT(hs_named)
std::int32_t hs_named(const Solid* s, const char* name, std::uint32_t size) {
  return given(s->named({name, size}));
}
HALFSPACE_EXPORT(hs_name) void hs_name(const Solid* s) {
  begin_answer();
  answer().bytes = s->name();
}
/// Both sides of a plane: the negative one, then the positive one.
HALFSPACE_EXPORT(hs_split)
void hs_split(const Solid* s, double x, double y, double z, double offset) {
  auto [negative, positive] = s->split({{x, y, z}, offset});
  begin_answer();
  answer().integers = {given(std::move(negative)), given(std::move(positive))};
}

HALFSPACE_EXPORT(hs_evaluate) int hs_evaluate(const Solid* s) {
  WorkOptions options;
  options.progress = goes_on;
  return answered(s->evaluate(options), [](Done) {});
}
HALFSPACE_EXPORT(hs_volume) int hs_volume(const Solid* s) {
  return number(s->volume());
}
HALFSPACE_EXPORT(hs_area) int hs_area(const Solid* s) {
  return number(s->area());
}
HALFSPACE_EXPORT(hs_exact_volume) int hs_exact_volume(const Solid* s) {
  return answered(s->exact_volume(),
                  [](std::string text) { answer().bytes = std::move(text); });
}
/// No bytes: the area is irrational.
HALFSPACE_EXPORT(hs_exact_area) int hs_exact_area(const Solid* s) {
  return answered(s->exact_area(), [](std::optional<std::string> text) {
    if (text) answer().bytes = *std::move(text);
  });
}
HALFSPACE_EXPORT(hs_bounds) int hs_bounds(const Solid* s) {
  return answered(s->bounds(), [](const Bounds& b) {
    answer().numbers = {b.low.x,  b.low.y,  b.low.z,
                        b.high.x, b.high.y, b.high.z};
  });
}
HALFSPACE_EXPORT(hs_centroid) int hs_centroid(const Solid* s) {
  return answered(s->centroid(), [](const Point& p) {
    answer().numbers = {p.x, p.y, p.z};
  });
}
HALFSPACE_EXPORT(hs_inertia) int hs_inertia(const Solid* s) {
  return answered(s->inertia(), [](const auto& rows) {
    for (const auto& row : rows)
      answer().numbers.insert(answer().numbers.end(), row.begin(), row.end());
  });
}
HALFSPACE_EXPORT(hs_shell_count) int hs_shell_count(const Solid* s) {
  return answered(s->shell_count(), [](std::size_t count) {
    answer().numbers = {static_cast<double>(count)};
  });
}
HALFSPACE_EXPORT(hs_genus) int hs_genus(const Solid* s) {
  return answered(s->genus(), [](std::int64_t genus) {
    answer().numbers = {static_cast<double>(genus)};
  });
}
HALFSPACE_EXPORT(hs_is_empty) int hs_is_empty(const Solid* s) {
  return answered(s->is_empty(),
                  [](bool is) { answer().numbers = {is ? 1.0 : 0.0}; });
}
HALFSPACE_EXPORT(hs_rounding) int hs_rounding(const Solid* s) {
  return answered(s->rounding(), [](const RoundingReport& r) {
    answer().numbers = {static_cast<double>(r.moved), r.max_move, r.step,
                        static_cast<double>(r.grid_bits)};
  });
}
/// 0: whether the interiors meet, 1: the closed solids, 2: whether b is in a.
HALFSPACE_EXPORT(hs_relation)
int hs_relation(int which, const Solid* a, const Solid* b) {
  return answered(which == 0   ? a->overlaps(*b)
                  : which == 1 ? a->touches(*b)
                               : a->contains(*b),
                  [](bool is) { answer().numbers = {is ? 1.0 : 0.0}; });
}
/// -1 inside, 0 on the surface, 1 outside.
HALFSPACE_EXPORT(hs_locate)
int hs_locate(const Solid* s, double x, double y, double z) {
  return answered(s->locate({x, y, z}), [](Location at) {
    answer().numbers = {at == Location::kInside ? -1.0
                        : at == Location::kOn   ? 0.0
                                                : 1.0};
  });
}
HALFSPACE_EXPORT(hs_decompose) int hs_decompose(const Solid* s) {
  return answered(s->decompose(), [](std::vector<Solid> parts) {
    for (Solid& part : parts) answer().integers.push_back(given(part));
  });
}
HALFSPACE_EXPORT(hs_operands) int hs_operands(const Solid* s) {
  return answered(s->operands(), [](std::vector<Solid> solids) {
    for (Solid& solid : solids) answer().integers.push_back(given(solid));
  });
}
/// Integers: by region the number of its loops, then by loop its points'.
HALFSPACE_EXPORT(hs_section)
int hs_section(const Solid* s, double x, double y, double z, double offset) {
  return answered(
      s->section({{x, y, z}, offset}), [](const std::vector<Region>& regions) {
        Answer& now = answer();
        const auto put = [&now](const std::vector<Point>& loop) {
          now.integers.push_back(static_cast<std::int32_t>(loop.size()));
          for (const Point& p : loop)
            now.numbers.insert(now.numbers.end(), {p.x, p.y, p.z});
        };
        for (const Region& region : regions) {
          now.integers.push_back(
              static_cast<std::int32_t>(region.holes.size() + 1));
          put(region.boundary);
          for (const auto& hole : region.holes) put(hole);
        }
      });
}
/// A file in memory that was mended: the solid, and a line for each thing done.
HALFSPACE_EXPORT(hs_mended)
int hs_mended(const char* name, std::uint32_t size, double weld,
              double thicken) {
  MendOptions options;
  if (weld >= 0) options.weld = weld;
  if (thicken > 0) options.thicken = thicken;
  return answered(mended(std::string(name, size), options), [](Mended m) {
    answer().integers = {given(m.solid)};
    for (const std::string& line : m.done) answer().bytes += line + "\n";
  });
}
/// Writes a file into memory.
HALFSPACE_EXPORT(hs_save)
int hs_save(const Solid* s, const char* name, std::uint32_t size,
            std::int32_t merge, std::int32_t triangles) {
  return answered(
      s->save(std::string(name, size), mesh_options_of(merge, triangles)),
      [](Done) {});
}

HALFSPACE_EXPORT(hs_mesh)
int hs_mesh(const Solid* s, std::int32_t merge, std::int32_t triangles) {
  return answered(s->mesh(mesh_options_of(merge, triangles)), [](Mesh mesh) {
    answer().integers = {handle_of(new Mesh(std::move(mesh)))};
  });
}
HALFSPACE_EXPORT(hs_free_mesh) void hs_free_mesh(Mesh* mesh) { delete mesh; }
/// By array of a mesh its address and how many numbers it has: vertices,
/// first_corner, corners, materials, origins, colours.
HALFSPACE_EXPORT(hs_mesh_arrays) void hs_mesh_arrays(const Mesh* mesh) {
  begin_answer();
  const auto put = [](const auto& array, std::size_t each) {
    answer().integers.push_back(handle_of(array.data()));
    answer().integers.push_back(static_cast<std::int32_t>(array.size() * each));
  };
  put(mesh->vertices, 3);
  put(mesh->first_corner, 1);
  put(mesh->corners, 1);
  put(mesh->materials, 1);
  put(mesh->origins, 2);
  put(mesh->colors, 3);
}

}  // namespace halfspace::web
