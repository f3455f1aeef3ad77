#include "generate/moving_views.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "halfspace/splitmix.hpp"

namespace halfspace::generate {
namespace {

std::int64_t coordinate(const GridPoint& p, std::size_t axis) {
  return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
}

/// Those polygons of the scene as a scene.
Scene part_of(const Scene& scene, const std::vector<PolygonId>& ids) {
  SceneData data;
  data.unit = scene.unit();
  data.grid_bits = scene.grid_bits();
  data.vertices = scene.data().vertices;
  for (const PolygonId id : ids) {
    const auto corners = scene.corners(id);
    data.corners.insert(data.corners.end(), corners.begin(), corners.end());
    data.first_corner.push_back(
        static_cast<std::uint32_t>(data.corners.size()));
    data.colors.push_back(scene.color(id));
    const auto colors = scene.corner_colors(id);
    data.corner_colors.insert(data.corner_colors.end(), colors.begin(),
                              colors.end());
  }
  return *make_scene(std::move(data));
}

std::int64_t small(std::uint64_t seed, std::int64_t most) {
  const auto count = static_cast<std::uint64_t>(2 * most + 1);
  return static_cast<std::int64_t>(mix(seed) % count) - most;
}

/// A matrix of one of the kinds, and its shift.
AffineMap matrix_of(std::uint64_t seed) {
  AffineMap map;
  const std::uint64_t kind = mix(seed) % 5;
  if (kind == 1) {
    // An exchange of axes, and reflections.
    std::array<std::size_t, 3> to = {0, 1, 2};
    std::swap(to[mix(seed + 1) % 3], to[mix(seed + 2) % 3]);
    map.m.fill(0);
    for (std::size_t k = 0; k < 3; ++k)
      map.m[3 * k + to[k]] = mix(seed + 3 + k) % 2 == 0 ? 1 : -1;
  } else if (kind >= 2) {
    const int shift = kind == 2 ? 1 : kind == 3 ? 20 : 31;
    map.shift = shift;
    do {
      for (std::int64_t& entry : map.m) {
        const std::int64_t size = std::int64_t{1} << shift;
        const std::int64_t about = small(seed += 7, 4) * (size / 4);
        entry = std::clamp<std::int64_t>(about + small(seed + 1, 2), 1 - size,
                                         size - 1);
      }
    } while (orientation_of(map) == 0);
  }
  return map;
}

/// The map, moved so that `p` stands at `q`, or next to it.
AffineMap placed(AffineMap map, const GridPoint& p, const GridPoint& q,
                 std::uint64_t seed) {
  for (std::size_t k = 0; k < 3; ++k) {
    map.t[k] = (Int128{coordinate(q, k)} << map.shift) -
               Int128{map.m[3 * k]} * p.x - Int128{map.m[3 * k + 1]} * p.y -
               Int128{map.m[3 * k + 2]} * p.z;
    if (mix(seed) % 2 == 0) map.t[k] += small(seed + k, 3);
  }
  return map;
}

void extend_moved(std::optional<Region>& box, const GridPoint& p,
                  const AffineMap& map) {
  GridPoint low, high;
  for (std::size_t k = 0; k < 3; ++k) {
    const Int128 at = Int128{map.m[3 * k]} * p.x +
                      Int128{map.m[3 * k + 1]} * p.y +
                      Int128{map.m[3 * k + 2]} * p.z + map.t[k];
    // Beyond the point, and not on it: the floor less 1, and 2 more.
    const auto below = static_cast<std::int64_t>((at >> map.shift) - 1);
    std::int64_t* const to[2][3] = {{&low.x, &low.y, &low.z},
                                    {&high.x, &high.y, &high.z}};
    *to[0][k] = below;
    *to[1][k] = below + ((at & ((Int128{1} << map.shift) - 1)) == 0 ? 2 : 3);
  }
  if (!box) box = Region{low, high};
  box->low = {std::min(box->low.x, low.x), std::min(box->low.y, low.y),
              std::min(box->low.z, low.z)};
  box->high = {std::max(box->high.x, high.x), std::max(box->high.y, high.y),
               std::max(box->high.z, high.z)};
}

std::optional<Region> region_of(const Model& model, const AffineMap& map) {
  std::optional<Region> box;
  for (const VertexId v : model.scene.data().corners)
    extend_moved(box, model.scene.point(v), map);
  for (const MovingObject& object : model.objects) {
    for (std::size_t k = 0; k < 8; ++k) {
      const Region& r = object.region;
      extend_moved(box,
                   {k & 1u ? r.high.x : r.low.x, k & 2u ? r.high.y : r.low.y,
                    k & 4u ? r.high.z : r.low.z},
                   map);
    }
  }
  return box;
}

bool share_space(const Region& a, const Region& b) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (coordinate(a.high, k) <= coordinate(b.low, k) ||
        coordinate(b.high, k) <= coordinate(a.low, k))
      return false;
  }
  return true;
}

/// The scene without the polygons whose boxes share space with a region.
Scene freed(const Scene& scene, const std::vector<MovingObject>& objects) {
  std::vector<PolygonId> left;
  for (PolygonId id = 0; id < static_cast<PolygonId>(scene.polygon_count());
       ++id) {
    std::optional<Region> box;
    for (const VertexId v : scene.corners(id))
      extend_moved(box, scene.point(v), {});
    const bool is_near = std::any_of(
        objects.begin(), objects.end(),
        [&](const auto& object) { return share_space(*box, object.region); });
    if (!is_near) left.push_back(id);
  }
  return part_of(scene, left);
}

using Direction = std::array<double, 3>;

Direction cross(const Direction& u, const Direction& v) {
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
          u[0] * v[1] - u[1] * v[0]};
}

/// A camera that sees the region from a small direction.
std::optional<Camera> camera_at(const Region& region, int grid_bits,
                                std::uint64_t seed) {
  Direction from = {static_cast<double>(small(seed, 2)),
                    static_cast<double>(small(seed + 1, 2)),
                    static_cast<double>(small(seed + 2, 2))};
  if (from == Direction{0, 0, 0}) from[mix(seed) % 3] = 1;
  Direction middle;
  double extent = 1;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::int64_t low = coordinate(region.low, k);
    const std::int64_t high = coordinate(region.high, k);
    middle[k] = static_cast<double>(low + (high - low) / 2);
    extent = std::max(extent, std::floor(static_cast<double>(high - low) / 2));
  }
  Direction across = {from[1], -from[0], 0};
  if (from[0] == 0 && from[1] == 0) across = {1, 0, 0};
  const Direction down = cross(from, across);
  const auto lattice = [](const Direction& v, double scale) {
    const auto part = [scale](double x) {
      return static_cast<Int128>(std::nearbyint(256 * scale * x));
    };
    return LatticeVector{part(v[0]), part(v[1]), part(v[2])};
  };
  const auto length = [](const Direction& v) {
    return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  };
  CameraData data;
  data.width_px = 13;
  data.height_px = 11;
  data.perspective = mix(seed + 3) % 3 != 0;
  const double distance = extent * static_cast<double>(1 + mix(seed + 4) % 3);
  data.sx = lattice(across, 2.2 * extent / 13 / length(across));
  data.sy = lattice(down, 2.2 * extent / 11 / length(down));
  data.s0 = lattice(middle, 1);
  data.eye = lattice(from, distance);
  const auto add = [](LatticeVector& to, const LatticeVector& v, int times,
                      int parts) {
    to.x += v.x * times / parts;
    to.y += v.y * times / parts;
    to.z += v.z * times / parts;
  };
  if (data.perspective) add(data.eye, data.s0, 1, 1);
  add(data.s0, data.sx, -13, 2);
  add(data.s0, data.sy, -11, 2);
  const Result<Camera> camera = make_camera(data, grid_bits);
  return camera ? std::optional(*camera) : std::nullopt;
}

}  // namespace

std::optional<MovingView> moving_view(const SceneFile& view,
                                      std::uint64_t seed) {
  const Scene& scene = view.scene;
  const auto count = scene.polygon_count();
  if (count == 0) return std::nullopt;
  std::array<std::vector<PolygonId>, 3> ids;
  for (std::size_t p = 0; p < count; ++p)
    ids[mix(seed + p) % 3].push_back(static_cast<PolygonId>(p));
  for (std::size_t k = 1; k < 3; ++k) {
    if (ids[k].empty())
      ids[k].push_back(static_cast<PolygonId>(mix(seed + k) % count));
  }
  const auto vertex = [&](std::uint64_t number) {
    const auto& vertices = scene.data().vertices;
    return vertices[mix(seed + number) % vertices.size()];
  };
  std::vector<Model> models(3);
  for (std::size_t k = 0; k < 3; ++k) models[k].scene = part_of(scene, ids[k]);
  const auto map = [&](std::uint64_t number) {
    return placed(matrix_of(mix(seed + number)), vertex(number + 1),
                  vertex(number + 2), mix(seed + number + 3));
  };
  const AffineMap inner = map(10);
  models[1].objects.push_back({2, *region_of(models[2], inner)});
  const AffineMap outer = map(20);
  models[0].objects.push_back({1, *region_of(models[1], outer)});
  const AffineMap other = map(30);
  const MovingObject beside = {2, *region_of(models[2], other)};
  const bool has_beside =
      !share_space(beside.region, models[0].objects[0].region);
  if (has_beside) models[0].objects.push_back(beside);
  for (std::size_t k = 0; k < 2; ++k) {
    if (mix(seed + 40) % 2 != 0)
      models[k].scene = freed(models[k].scene, models[k].objects);
  }
  Result<Assembly> assembly = make_assembly(std::move(models));
  if (!assembly) return std::nullopt;
  Pose pose = empty_pose(*assembly);
  pose.maps[0][0] = outer;
  pose.maps[1][0] = inner;
  if (has_beside) pose.maps[0][1] = other;
  const Result<Placement> placement = make_placement(*assembly, pose);
  if (!placement) return std::nullopt;
  std::optional<Camera> camera = view.camera;
  if (mix(seed + 50) % 4 != 0) {
    // At the object's first polygon, or all of the object.
    const Scene& object = assembly->models()[1].scene;
    std::optional<Region> box;
    if (object.polygon_count() > 0 && mix(seed + 52) % 3 != 0) {
      for (const VertexId v : object.corners(0))
        extend_moved(box, object.point(v), outer);
    }
    const auto aimed =
        camera_at(box.value_or(assembly->models()[0].objects[0].region),
                  assembly->models()[0].scene.grid_bits(), mix(seed + 51));
    if (aimed) camera = aimed;
  }
  return MovingView{*std::move(assembly), std::move(pose), *placement, *camera};
}

}  // namespace halfspace::generate
