#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

#include "generate/generate.hpp"
#include "generate/shapes.hpp"
#include "halfspace/assert.hpp"

namespace halfspace::generate {
namespace {

namespace gen = rc::gen;

constexpr Rgb kFirst = {0, 0, 0};
constexpr Rgb kSecond = {255, 255, 255};

/// How the second solid lies against the first.
enum class PairKind {
  kFree,
  kEqual,
  kMoved,
  kTouching,
  kNested,
  kSheared,
  kEmpty
};

struct PairRecipe {
  PairKind kind = PairKind::kFree;
  Shape first;
  Shape second;
  int shear = 0;
  std::vector<int> move;  ///< three, from -4 to 4
  int scale_bits = 0;     ///< both are stretched by two to this power
};

/// Integer matrices that keep volumes' signs; the first changes nothing.
constexpr std::array<std::array<int, 9>, 4> kShears = {{
    {1, 0, 0, 0, 1, 0, 0, 0, 1},
    {1, 1, 0, 0, 1, 0, 0, 0, 1},
    {2, 1, 0, -1, 1, 1, 0, 1, 2},
    {1, 0, 2, 3, 1, 0, 1, 1, 1},
}};

Polygons sheared(Polygons polygons, int which) {
  const auto& m = kShears[static_cast<std::size_t>(which)];
  for (auto& polygon : polygons) {
    for (GridPoint& p : polygon) {
      p = {m[0] * p.x + m[1] * p.y + m[2] * p.z,
           m[3] * p.x + m[4] * p.y + m[5] * p.z,
           m[6] * p.x + m[7] * p.y + m[8] * p.z};
    }
  }
  return polygons;
}

Polygons moved(Polygons polygons, const std::vector<int>& by) {
  for (auto& polygon : polygons) {
    for (GridPoint& p : polygon) p = {p.x + by[0], p.y + by[1], p.z + by[2]};
  }
  return polygons;
}

Polygons scaled(Polygons polygons, std::int64_t by) {
  for (auto& polygon : polygons) {
    for (GridPoint& p : polygon) p = {by * p.x, by * p.y, by * p.z};
  }
  return polygons;
}

Polygons polygons_of(const Shape& shape) {
  Polygons polygons;
  add(shape, polygons);
  return polygons;
}

/// The second, moved along the x axis to where it touches the first.
Polygons beside(const Polygons& first, Polygons second) {
  std::int64_t right = -100, left = 100;
  for (const auto& polygon : first) {
    for (const GridPoint& p : polygon) right = std::max(right, p.x);
  }
  for (const auto& polygon : second) {
    for (const GridPoint& p : polygon) left = std::min(left, p.x);
  }
  const auto by = static_cast<int>(right - left);
  return moved(std::move(second), {by, 0, 0});
}

/// A box round everything that small numbers make.
Polygons room() {
  Polygons polygons;
  add(Shape{ShapeKind::kBox, 0, {0, 0, 0, 0, 0, 0, 0, 0, 0}}, polygons);
  return moved(scaled(std::move(polygons), 40), {-20, -20, -20});
}

GridSolid solid_of(const Polygons& polygons, Rgb color) {
  auto solid = make_solid(scene_of(polygons, color));
  HALFSPACE_ASSERT(solid.has_value());
  return *solid;
}

SolidPair make(const PairRecipe& recipe) {
  const Polygons first = polygons_of(recipe.first);
  Polygons second;
  switch (recipe.kind) {
    case PairKind::kFree:
      second = polygons_of(recipe.second);
      break;
    case PairKind::kEqual:
      second = first;
      break;
    case PairKind::kMoved:
      second = moved(first, recipe.move);
      break;
    case PairKind::kTouching:
      second = beside(first, polygons_of(recipe.second));
      break;
    case PairKind::kNested:
      second = room();
      break;
    case PairKind::kSheared:
      second = sheared(polygons_of(recipe.second), 3 - recipe.shear);
      break;
    case PairKind::kEmpty:
      break;
  }
  const std::int64_t scale = std::int64_t{1} << recipe.scale_bits;
  return {solid_of(scaled(sheared(first, recipe.shear), scale), kFirst),
          solid_of(scaled(sheared(second, recipe.shear), scale), kSecond)};
}

}  // namespace

void showValue(const SolidPair& solids, std::ostream& out) {
  out << write_scene(both_of(solids));
}

SceneFile both_of(const SolidPair& solids) {
  SceneData data = solids.a.scene().data();
  const SceneData& more = solids.b.scene().data();
  const auto vertices = static_cast<VertexId>(data.vertices.size());
  const auto corners = static_cast<std::uint32_t>(data.corners.size());
  data.vertices.insert(data.vertices.end(), more.vertices.begin(),
                       more.vertices.end());
  for (const VertexId v : more.corners) data.corners.push_back(vertices + v);
  for (std::size_t p = 1; p < more.first_corner.size(); ++p)
    data.first_corner.push_back(corners + more.first_corner[p]);
  data.colors.insert(data.colors.end(), more.colors.begin(), more.colors.end());
  data.grid_bits = grid_bits_for(data.vertices);
  auto scene = make_scene(std::move(data));
  HALFSPACE_ASSERT(scene.has_value());
  return {*scene, std::nullopt, {}};
}

SolidPair solids_of(const SceneFile& file) {
  Polygons operands[2];
  for (std::size_t p = 0; p < file.scene.polygon_count(); ++p) {
    const auto id = static_cast<PolygonId>(p);
    auto& polygons = operands[file.scene.color(id) == kFirst ? 0 : 1];
    polygons.emplace_back();
    for (const VertexId v : file.scene.corners(id))
      polygons.back().push_back(file.scene.point(v));
  }
  return {solid_of(operands[0], kFirst), solid_of(operands[1], kSecond)};
}

rc::Gen<SolidPair> solid_pairs() {
  const auto any = [](int count) {
    return gen::resize(rc::kNominalSize, gen::inRange(0, count));
  };
  const auto number =
      gen::map(any(9), [](int k) { return k % 2 == 0 ? k / 2 : -(k + 1) / 2; });
  const auto numbers = [number](std::size_t count) {
    return gen::container<std::vector<int>>(count, number);
  };
  const auto shape =
      gen::map(gen::tuple(any(4), any(2), numbers(9)), [](auto drawn) {
        auto [kind, other, values] = std::move(drawn);
        constexpr ShapeKind kKinds[] = {ShapeKind::kBox, ShapeKind::kCubes,
                                        ShapeKind::kCubes,
                                        ShapeKind::kTetrahedron};
        return Shape{kKinds[kind], other, std::move(values)};
      });
  return gen::map(
      gen::tuple(any(12), shape, shape, any(8), numbers(3), any(8)),
      [](auto drawn) {
        auto [kind, first, second, shear, move, scale] = std::move(drawn);
        constexpr PairKind kKinds[] = {
            PairKind::kTouching, PairKind::kTouching, PairKind::kFree,
            PairKind::kFree,     PairKind::kFree,     PairKind::kFree,
            PairKind::kMoved,    PairKind::kMoved,    PairKind::kSheared,
            PairKind::kEqual,    PairKind::kNested,   PairKind::kEmpty};
        return make(PairRecipe{kKinds[kind], std::move(first),
                               std::move(second), shear < 4 ? 0 : shear - 4,
                               std::move(move), scale == 7 ? 44 : 0});
      });
}

}  // namespace halfspace::generate
