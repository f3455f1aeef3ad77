#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "halfspace/boolean.hpp"
#include "halfspace/fast/boolean.hpp"
#include "halfspace/fast/check_operand.hpp"
#include "halfspace/fast/rounded_mesh.hpp"
#include "halfspace/fast/to_mesh.hpp"
#include "halfspace/io/import.hpp"
#include "laws/law.hpp"

/// Laws of solids rounded to the numbers of a file (S6.8): of pairs of solids
/// that are turned against each other by anything from a tenth to a millionth
/// of a millionth, near the origin and far out, where numbers are coarse.
namespace halfspace {
namespace {

using FilePoint = std::array<double, 3>;

constexpr int kRoundings = 150;
/// Steps of the grid of 54 bits are this long.
constexpr int kStepExponent = -46;

/// A solid of the grid: a sphere of triangles, of few to some, stretched.
struct Ball {
  int stacks = 3;
  int slices = 4;
  FilePoint size{1, 1, 1};
  FilePoint angles{};  ///< of turns about the axes, one after another
  FilePoint shift{};
};

FilePoint turned(FilePoint p, const FilePoint& angles) {
  for (std::size_t k = 0; k < 3; ++k) {
    double& u = p[(k + 1) % 3];
    double& v = p[(k + 2) % 3];
    const double c = std::cos(angles[k]), s = std::sin(angles[k]);
    const double turned_u = c * u - s * v;
    v = s * u + c * v;
    u = turned_u;
  }
  return p;
}

std::optional<GridSolid> solid_of(const Ball& ball) {
  SceneData data;
  data.unit = {2, kStepExponent};
  data.grid_bits = 54;
  const auto add = [&](double polar, double azimuth) {
    const FilePoint p =
        turned({ball.size[0] * std::sin(polar) * std::cos(azimuth),
                ball.size[1] * std::sin(polar) * std::sin(azimuth),
                ball.size[2] * std::cos(polar)},
               ball.angles);
    const auto steps = [&](std::size_t k) {
      return std::llround(std::ldexp(p[k] + ball.shift[k], -kStepExponent));
    };
    data.vertices.push_back({steps(0), steps(1), steps(2)});
  };
  add(0, 0);
  for (int i = 1; i < ball.stacks; ++i) {
    for (int j = 0; j < ball.slices; ++j)
      add(std::numbers::pi * i / ball.stacks,
          2 * std::numbers::pi * j / ball.slices);
  }
  add(std::numbers::pi, 0);
  const int last = static_cast<int>(data.vertices.size()) - 1;
  const auto at = [&](int i, int j) {
    return i == 0             ? 0
           : i == ball.stacks ? last
                              : 1 + (i - 1) * ball.slices + j % ball.slices;
  };
  const auto triangle = [&](int a, int b, int c) {
    if (a == b || b == c || c == a) return;
    data.corners.insert(data.corners.end(), {a, b, c});
    data.first_corner.push_back(
        static_cast<std::uint32_t>(data.corners.size()));
  };
  for (int i = 0; i < ball.stacks; ++i) {
    for (int j = 0; j < ball.slices; ++j) {
      triangle(at(i, j), at(i + 1, j), at(i + 1, j + 1));
      triangle(at(i, j), at(i + 1, j + 1), at(i, j + 1));
    }
  }
  data.colors.resize(data.first_corner.size() - 1);
  Result<Scene> scene = make_scene(std::move(data));
  if (!scene) return std::nullopt;
  Result<GridSolid> solid = make_solid(*std::move(scene));
  if (!solid) return std::nullopt;
  return *std::move(solid);
}

/// A boolean of two such that nearly coincide, or do not.
fast::Solid some_result() {
  const auto real = [](int low, int high) {
    return static_cast<double>(*rc::gen::inRange(low, high)) / 997;
  };
  Ball ball;
  ball.stacks = *rc::gen::inRange(2, 7);
  ball.slices = *rc::gen::inRange(3, 10);
  ball.size = {real(400, 1500), real(400, 1500), real(400, 1500)};
  ball.angles = {real(0, 3000), real(0, 3000), real(0, 3000)};
  // Up to 64 out: at most 52 bits, and floats with 18 of them after the point.
  const double far = std::ldexp(1.0, *rc::gen::inRange(-3, 6));
  ball.shift = {far * real(500, 997), -far * real(500, 997),
                far * real(0, 997)};
  Ball other = ball;
  const double angle = std::pow(10.0, -*rc::gen::inRange(1, 13));
  for (std::size_t k = 0; k < 3; ++k)
    other.angles[k] += angle * real(-997, 998);
  for (std::size_t k = 0; k < 3; ++k) other.shift[k] += angle * real(-997, 998);
  const auto a = solid_of(ball), b = solid_of(other);
  RC_PRE(a.has_value() && b.has_value());
  const fast::Solid first = fast::to_solid(*a);
  const fast::Solid second = fast::to_solid(*b, first);
  RC_PRE(fast::check_operand(first) && fast::check_operand(second));
  const BooleanOp operation = *rc::gen::element(
      BooleanOp::kUnion, BooleanOp::kDifference, BooleanOp::kIntersection,
      BooleanOp::kSymmetricDifference);
  return fast::boolean(operation, first, second);
}

struct Rounded {
  fast::Solid solid;
  fast::FileNumber number = fast::FileNumber::kDouble;
  fast::RoundedMesh mesh;
};

Rounded some_rounded(law::Cases& cases) {
  Rounded rounded;
  rounded.solid = some_result();
  rounded.number =
      *rc::gen::element(fast::FileNumber::kDouble, fast::FileNumber::kFloat);
  const Result<fast::RoundedMesh> mesh = fast::rounded_mesh(
      rounded.solid,
      {.number = rounded.number, .triangles = *rc::gen::arbitrary<bool>()});
  HALFSPACE_LAW(mesh.has_value());
  rounded.mesh = *mesh;
  const std::string met =
      rounded.mesh.crossings > 0 ? "surfaces met" : "no surfaces met";
  law::note(met);
  cases.meet(met);
  return rounded;
}

/// The mesh read as it is; an error if import changes anything of it.
Result<io::Imported> read_again(const fast::RoundedMesh& mesh) {
  io::Mesh file;
  for (const FilePoint& v : mesh.vertices)
    file.vertices.push_back(
        {io::number_of(v[0]), io::number_of(v[1]), io::number_of(v[2])});
  file.first_corner = mesh.first_corner;
  file.corners = mesh.corners;
  return io::import_scene(file, {});
}

/// The polygons in triangles.
template <class Mesh>
std::vector<std::array<FilePoint, 3>> triangles_of(const Mesh& mesh) {
  std::vector<std::array<FilePoint, 3>> triangles;
  for (std::size_t p = 0; p < mesh.faces.size(); ++p) {
    const auto at = [&](std::size_t k) {
      return mesh.vertices[static_cast<std::size_t>(mesh.corners[k])];
    };
    const std::size_t first = mesh.first_corner[p];
    for (std::size_t i = first + 1; i + 1 < mesh.first_corner[p + 1]; ++i)
      triangles.push_back({at(first), at(i), at(i + 1)});
  }
  return triangles;
}

FilePoint minus(const FilePoint& p, const FilePoint& q) {
  return {p[0] - q[0], p[1] - q[1], p[2] - q[2]};
}
double dot(const FilePoint& p, const FilePoint& q) {
  return p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
}
FilePoint cross(const FilePoint& p, const FilePoint& q) {
  return {p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2],
          p[0] * q[1] - p[1] * q[0]};
}

double distance(const FilePoint& p, const FilePoint& a, const FilePoint& b) {
  const FilePoint ab = minus(b, a);
  const double length2 = dot(ab, ab);
  const double t =
      length2 > 0 ? std::clamp(dot(minus(p, a), ab) / length2, 0.0, 1.0) : 0;
  const FilePoint rest = {p[0] - a[0] - t * ab[0], p[1] - a[1] - t * ab[1],
                          p[2] - a[2] - t * ab[2]};
  return std::sqrt(dot(rest, rest));
}

double distance(const FilePoint& p, const std::array<FilePoint, 3>& t) {
  const FilePoint n = cross(minus(t[1], t[0]), minus(t[2], t[0]));
  bool inside = dot(n, n) > 0;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i) {
    const FilePoint& a = t[i];
    const FilePoint& b = t[(i + 1) % 3];
    inside = inside && dot(cross(minus(b, a), minus(p, a)), n) >= 0;
    nearest = std::min(nearest, distance(p, a, b));
  }
  if (!inside) return nearest;
  return std::min(nearest,
                  std::abs(dot(minus(p, t[0]), n)) / std::sqrt(dot(n, n)));
}

/// Of what is computed here, with coordinates up to 100.
constexpr double kSlack = 1e-12;

TEST(S6Rounding, L16ARoundedSolidIsASolid) {
  law::Cases cases({"surfaces met", "no surfaces met"});
  law::check(kRoundings, [&cases] {
    const Rounded rounded = some_rounded(cases);
    for (const FilePoint& v : rounded.mesh.vertices) {
      for (const double c : v) {
        HALFSPACE_LAW(rounded.number == fast::FileNumber::kDouble ||
                      double{static_cast<float>(c)} == c);
      }
    }
    std::vector<FilePoint> places = rounded.mesh.vertices;
    std::sort(places.begin(), places.end());
    HALFSPACE_LAW(std::adjacent_find(places.begin(), places.end()) ==
                  places.end());
    if (rounded.mesh.faces.empty()) return;
    const Result<io::Imported> again = read_again(rounded.mesh);
    HALFSPACE_LAW(again.has_value());
    HALFSPACE_LAW(again->report.moved == 0 && again->report.dropped == 0 &&
                  again->report.triangulated == 0);
    const Result<GridSolid> solid = make_solid(again->scene);
    HALFSPACE_LAW(solid.has_value());
    HALFSPACE_LAW(fast::check_operand(fast::to_solid(*solid)).has_value());
  });
  cases.expect_all();
}

TEST(S6Rounding, L17VerticesAreAsNearAsReported) {
  law::Cases cases({"surfaces met", "no surfaces met"});
  law::check(kRoundings, [&cases] {
    const Rounded rounded = some_rounded(cases);
    const auto exact =
        triangles_of(fast::to_mesh(rounded.solid, {.triangles = true}));
    // Along no axis is it farther, so it is at most the root of 3 times that.
    const double most = std::numbers::sqrt3 * rounded.mesh.max_move + kSlack;
    for (const FilePoint& v : rounded.mesh.vertices) {
      HALFSPACE_LAW(std::any_of(
          exact.begin(), exact.end(),
          [&](const auto& triangle) { return distance(v, triangle) <= most; }));
    }
  });
  cases.expect_all();
}

TEST(S6Rounding, L18VolumesDifferByWhatMoved) {
  law::Cases cases({"surfaces met", "no surfaces met"});
  law::check(kRoundings, [&cases] {
    const Rounded rounded = some_rounded(cases);
    const auto before =
        triangles_of(fast::to_mesh(rounded.solid, {.triangles = true}));
    const auto after = triangles_of(rounded.mesh);
    if (before.empty()) return;
    const FilePoint from = before[0][0];
    double area = 0, volume = 0;
    for (const auto* triangles : {&before, &after}) {
      for (const auto& t : *triangles) {
        const FilePoint a = minus(t[0], from), b = minus(t[1], from),
                        c = minus(t[2], from);
        const FilePoint n = cross(minus(b, a), minus(c, a));
        area += std::sqrt(dot(n, n)) / 2;
        volume += (triangles == &before ? 1 : -1) * dot(a, cross(b, c)) / 6;
      }
    }
    HALFSPACE_LAW(std::abs(volume) <=
                  std::numbers::sqrt3 * rounded.mesh.max_move * area + kSlack);
  });
  cases.expect_all();
}

/// The surface with its vertices on the grid of 26 bits, multiples of 2^-bits.
std::optional<Scene> on_coarse_grid(const fast::RoundedMesh& mesh, int bits) {
  io::Mesh file;
  for (const FilePoint& v : mesh.vertices) {
    std::array<io::Number, 3> at;
    for (std::size_t k = 0; k < 3; ++k)
      at[k] = io::number_of(std::nearbyint(std::ldexp(v[k], bits)));
    file.vertices.push_back(at);
  }
  file.first_corner = mesh.first_corner;
  file.corners = mesh.corners;
  const Result<io::Imported> imported =
      io::import_scene(file, {.grid_bits = 26});
  if (!imported || imported->report.moved > 0) return std::nullopt;
  return imported->scene;
}

/// The scene's polygons in triangles. Units: grid steps.
std::vector<std::array<FilePoint, 3>> triangles_of(const Scene& scene) {
  std::vector<std::array<FilePoint, 3>> triangles;
  for (std::size_t p = 0; p < scene.polygon_count(); ++p) {
    const auto corners = scene.corners(static_cast<PolygonId>(p));
    const auto at = [&](std::size_t i) {
      const GridPoint& v = scene.point(corners[i]);
      return FilePoint{static_cast<double>(v.x), static_cast<double>(v.y),
                       static_cast<double>(v.z)};
    };
    for (std::size_t i = 1; i + 1 < corners.size(); ++i)
      triangles.push_back({at(0), at(i), at(i + 1)});
  }
  return triangles;
}

TEST(S6Rounding, L19SurfacesOnACoarserGridBecomeSolids) {
  law::Cases cases({"it crosses itself", "it is a solid's"});
  law::check(kRoundings, [&cases] {
    const Result<fast::RoundedMesh> fine =
        fast::rounded_mesh(some_result(), {.triangles = true});
    HALFSPACE_LAW(fine.has_value());
    RC_PRE(!fine->faces.empty());
    const auto scene = on_coarse_grid(*fine, *rc::gen::inRange(3, 10));
    RC_PRE(scene.has_value() && scene->polygon_count() > 0);
    const Result<GridSolid> before = make_solid(*scene);
    RC_PRE(before.has_value());
    const bool is_fine =
        fast::check_operand(fast::to_solid(*before)).has_value();
    cases.meet(is_fine ? "it is a solid's" : "it crosses itself");
    const Result<fast::SettledScene> settled = fast::settled_scene(*scene);
    HALFSPACE_LAW(settled.has_value());
    HALFSPACE_LAW(!is_fine || settled->max_move == 0);
    const Result<GridSolid> after = make_solid(settled->scene);
    HALFSPACE_LAW(after.has_value());
    HALFSPACE_LAW(after->scene().polygon_count() == 0 ||
                  fast::check_operand(fast::to_solid(*after)).has_value());
    const auto near = triangles_of(*scene);
    const double most = std::numbers::sqrt3 * settled->max_move + 1e-6;
    for (const GridPoint& v : settled->scene.data().vertices) {
      const FilePoint p = {static_cast<double>(v.x), static_cast<double>(v.y),
                           static_cast<double>(v.z)};
      HALFSPACE_LAW(std::any_of(near.begin(), near.end(), [&](const auto& t) {
        return distance(p, t) <= most;
      }));
    }
  });
  cases.expect_all();
}

}  // namespace
}  // namespace halfspace
