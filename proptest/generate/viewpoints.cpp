#include "generate/viewpoints.hpp"

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

#include "halfspace/assert.hpp"

namespace halfspace::generate {
namespace {

using Vector = LatticeVector;

Vector operator+(const Vector& u, const Vector& v) {
  return {u.x + v.x, u.y + v.y, u.z + v.z};
}

Vector operator-(const Vector& u, const Vector& v) {
  return {u.x - v.x, u.y - v.y, u.z - v.z};
}

Vector operator*(Int128 k, const Vector& v) {
  return {k * v.x, k * v.y, k * v.z};
}

Vector halved(const Vector& v) { return {v.x / 2, v.y / 2, v.z / 2}; }

Vector lattice(const GridPoint& p) {
  return Int128{1 << kLatticeBits} * Vector{p.x, p.y, p.z};
}

Int128 size_of(const Vector& v) {
  const auto size = [](Int128 c) { return c < 0 ? -c : c; };
  return std::max({size(v.x), size(v.y), size(v.z)});
}

/// The vector of length `size` along an axis: 0, 1, 2 for x, y, z.
Vector along(int axis, Int128 size) {
  const int a = axis % 3;
  return {a == 0 ? size : 0, a == 1 ? size : 0, a == 2 ? size : 0};
}

/// The axis along which `v` is longest.
int axis_of(const Vector& v) {
  if (size_of({v.x, 0, 0}) == size_of(v)) return 0;
  return size_of({0, v.y, 0}) == size_of(v) ? 1 : 2;
}

/// The polygon that the recipe names, as lattice points.
std::vector<Vector> polygon_of(const Scene& scene, const ViewRecipe& recipe) {
  if (scene.polygon_count() == 0) {
    return {{0, 0, 0}, {1024, 0, 0}, {0, 1024, 0}};
  }
  const auto count = static_cast<int>(scene.polygon_count());
  std::vector<Vector> points;
  for (const VertexId vertex : scene.corners(recipe.other % count))
    points.push_back(lattice(scene.point(vertex)));
  // The chosen edge becomes the first.
  const auto first = static_cast<std::size_t>(recipe.edge) % points.size();
  std::rotate(points.begin(),
              points.begin() + static_cast<std::ptrdiff_t>(first),
              points.end());
  return points;
}

struct Maker {
  const ViewRecipe& recipe;
  std::vector<Vector> polygon;
  Int128 unit;  ///< a grid step of the scene before it was stretched

  Int128 number(std::size_t i) const { return recipe.numbers[i]; }

  Vector eye() const {
    const Vector u = polygon[1] - polygon[0];
    const Vector v = polygon.back() - polygon[0];
    const Vector small{number(0), number(1), number(2)};
    switch (recipe.eye) {
      case EyeKind::kFree:
        return 3 * unit * small;
      case EyeKind::kOnSplitter:
        return polygon[0] + number(0) * halved(u) + number(1) * halved(v);
      case EyeKind::kOnEdge:
        return polygon[0] + number(0) * halved(u);
      case EyeKind::kAtVertex:
        return polygon[0];
      case EyeKind::kInside:
        return (unit / 2) * small;
      case EyeKind::kInPolygon:
        return polygon[0] + halved(halved(u) + halved(v));
    }
    return {};
  }

  /// The direction towards an eye at infinity.
  Vector direction() const {
    const Vector u = polygon[1] - polygon[0];
    const Vector v = polygon.back() - polygon[0];
    switch (recipe.eye) {
      case EyeKind::kFree:
        return {number(0), number(1), number(2)};
      case EyeKind::kOnSplitter:
        return number(0) * u + number(1) * v;
      case EyeKind::kOnEdge:
        return u;
      case EyeKind::kAtVertex:
      case EyeKind::kInside:
      case EyeKind::kInPolygon:
        return along(recipe.edge, number(0) < 0 ? -1 : 1);
    }
    return {};
  }

  /// The vectors of a column and a row, both even, across `forward`.
  std::pair<Vector, Vector> across(const Vector& forward) const {
    const int axis = axis_of(forward);
    // The image's width is from an eighth to a half of the whole depth.
    const Int128 reach = recipe.perspective ? size_of(forward) : 16 * unit;
    const Int128 step = std::max<Int128>(
        1, reach * (2 + std::abs(recipe.numbers[6])) / (16 * recipe.width_px));
    const Vector skew{number(7), number(8), number(9)};
    const Int128 even = 8 * (step / 8 + 1);
    return {along(axis + 1, even) + (even / 4) * skew,
            along(axis + 2, number(10) < 0 ? -even : even)};
  }

  /// Lays the pixel that the numbers name over the point.
  static Vector origin(const Vector& point, const Vector& sx, const Vector& sy,
                       int i, int j) {
    return point - i * sx - j * sy - halved(sx + sy);
  }

  CameraData camera() const {
    CameraData data;
    data.perspective = recipe.perspective;
    data.width_px = recipe.width_px;
    data.height_px = recipe.height_px;
    data.eye = recipe.perspective ? eye() : direction();
    if (data.eye == Vector{} && !recipe.perspective) data.eye = {0, 0, 1};
    const Vector target =
        recipe.aim == AimKind::kTarget
            ? polygon[0] + unit * Vector{number(3), number(4), number(5)}
            : polygon[0];
    Vector forward = recipe.perspective ? target - data.eye : data.eye;
    if (forward == Vector{}) forward = along(recipe.edge, 8 * unit);
    std::tie(data.sx, data.sy) = across(forward);
    const int i = (recipe.edge + 3) % recipe.width_px;
    const int j = (recipe.other + 2) % recipe.height_px;
    // The edge's eighth, or more of it: a grid step has 256 lattice steps.
    const Vector edge = polygon[1] - polygon[0];
    const Vector part = {edge.x / 8, edge.y / 8, edge.z / 8};
    switch (recipe.aim) {
      case AimKind::kTarget:
        data.s0 = (recipe.perspective ? data.eye + forward : target) -
                  (recipe.width_px / 2) * data.sx -
                  (recipe.height_px / 2) * data.sy;
        break;
      case AimKind::kVertexOnCentre:
        data.s0 = origin(target, data.sx, data.sy, i, j);
        break;
      case AimKind::kEdgeOnRow:
        data.sx = part;
        data.s0 = origin(target, data.sx, data.sy, i / 2, j);
        break;
      case AimKind::kEdgeOnColumn:
        data.sy = part;
        data.s0 = origin(target, data.sx, data.sy, i, j / 2);
        break;
      case AimKind::kEdgeOnDiagonal:
        data.sy = part - data.sx;
        data.s0 = origin(target, data.sx, data.sy, i / 2, j / 2);
        break;
    }
    near(data);
    return data;
  }

  void near(CameraData& data) const {
    if (recipe.near == NearKind::kFree) {
      const std::int64_t k = 9000 * recipe.numbers[11];
      data.near = recipe.perspective ? std::abs(k) : k;
    } else if (recipe.near == NearKind::kThroughImage) {
      // The image plane holds the target, so this is through a vertex.
      data.near = recipe.perspective ? std::int64_t{1} << kNearBits : 0;
    }
  }
};

CameraData from_the_side(Int128 unit, const ViewRecipe& recipe) {
  CameraData data;
  data.eye = {20 * unit, 0, 0};
  data.s0 = {10 * unit, -4 * unit, -4 * unit};
  data.sx = {0, unit, 0};
  data.sy = {0, 0, unit};
  data.width_px = recipe.width_px;
  data.height_px = recipe.height_px;
  return data;
}

}  // namespace

SceneFile make(const MadeScene& made, const ViewRecipe& recipe) {
  const Int128 unit = Int128{made.scale} << kLatticeBits;
  const Maker maker{recipe, polygon_of(made.scene, recipe), unit};
  const int bits = made.scene.grid_bits();
  SceneFile file;
  file.scene = made.scene;
  file.options.cull = recipe.cull;
  file.options.shading = recipe.gouraud ? Shading::kGouraud : Shading::kFlat;
  auto camera = make_camera(maker.camera(), bits);
  if (!camera) camera = make_camera(from_the_side(unit, recipe), bits);
  HALFSPACE_ASSERT(camera.has_value());
  file.camera = *camera;
  return file;
}

}  // namespace halfspace::generate
