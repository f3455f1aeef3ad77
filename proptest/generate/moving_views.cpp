#include "generate/moving_views.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include "halfspace/cap_parts.hpp"
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
ObjectMap matrix_of(std::uint64_t seed) {
  ObjectMap map;
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
ObjectMap placed(ObjectMap map, const GridPoint& p, const GridPoint& q,
                 std::uint64_t seed) {
  for (std::size_t k = 0; k < 3; ++k) {
    map.t[k] = (Int128{coordinate(q, k)} << map.shift) -
               Int128{map.m[3 * k]} * p.x - Int128{map.m[3 * k + 1]} * p.y -
               Int128{map.m[3 * k + 2]} * p.z;
    if (mix(seed) % 2 == 0) map.t[k] += small(seed + k, 3);
  }
  return map;
}

void extend_moved(std::optional<ObjectRegion>& box, const GridPoint& p,
                  const ObjectMap& map) {
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
  if (!box) box = ObjectRegion{low, high};
  box->low = {std::min(box->low.x, low.x), std::min(box->low.y, low.y),
              std::min(box->low.z, low.z)};
  box->high = {std::max(box->high.x, high.x), std::max(box->high.y, high.y),
               std::max(box->high.z, high.z)};
}

using Moved = std::array<Int128, 3>;

/// The places of all that a region has to hold, in steps of 2^-shift.
std::vector<Moved> moved_corners(const Model& model, const ObjectMap& map) {
  std::vector<Moved> places;
  const auto take = [&](const GridPoint& p) {
    Moved at;
    for (std::size_t k = 0; k < 3; ++k) {
      at[k] = Int128{map.m[3 * k]} * p.x + Int128{map.m[3 * k + 1]} * p.y +
              Int128{map.m[3 * k + 2]} * p.z + map.t[k];
    }
    places.push_back(at);
  };
  for (const VertexId v : model.scene.data().corners)
    take(model.scene.point(v));
  for (const MovingObject& object : model.objects) {
    for (const GridPoint& p : corners_of(object.region)) take(p);
  }
  return places;
}

/// Whole numbers below and above a form's values at all places.
std::pair<std::int64_t, std::int64_t> range_of(const std::vector<Moved>& places,
                                               const std::array<int, 3>& form,
                                               int shift) {
  std::optional<std::pair<Int128, Int128>> range;
  for (const Moved& at : places) {
    const Int128 value = form[0] * at[0] + form[1] * at[1] + form[2] * at[2];
    if (!range) range = {value, value};
    range->first = std::min(range->first, value);
    range->second = std::max(range->second, value);
  }
  return {static_cast<std::int64_t>((range->first >> shift) - 1),
          static_cast<std::int64_t>((range->second >> shift) + 2)};
}

/// A corner of a box and the plane that its three neighbours are in.
std::vector<GridPoint> tetrahedron(const std::vector<Moved>& places, int shift,
                                   std::uint64_t seed) {
  std::array<int, 3> sign;
  std::array<std::int64_t, 3> corner;
  for (std::size_t k = 0; k < 3; ++k) {
    sign[k] = mix(seed + k) % 2 == 0 ? 1 : -1;
    std::array<int, 3> form = {0, 0, 0};
    form[k] = 1;
    const auto [low, high] = range_of(places, form, shift);
    corner[k] = sign[k] > 0 ? low : high;
  }
  std::int64_t size = range_of(places, sign, shift).second;
  for (std::size_t k = 0; k < 3; ++k) size -= sign[k] * corner[k];
  std::vector<GridPoint> points = {{corner[0], corner[1], corner[2]}};
  for (std::size_t k = 0; k < 3; ++k) {
    std::array<std::int64_t, 3> p = corner;
    p[k] += sign[k] * size;
    points.push_back({p[0], p[1], p[2]});
  }
  return points;
}

/// A box in a frame whose x leans along z: a parallelepiped, and a point in it.
std::vector<GridPoint> leaning_box(const std::vector<Moved>& places, int shift,
                                   std::uint64_t seed) {
  const int lean = mix(seed) % 2 == 0 ? 1 : -2;
  const auto x = range_of(places, {1, 0, -lean}, shift);
  const auto y = range_of(places, {0, 1, 0}, shift);
  const auto z = range_of(places, {0, 0, 1}, shift);
  std::vector<GridPoint> points;
  for (unsigned k = 0; k < 8; ++k) {
    const std::int64_t at = k & 4u ? z.second : z.first;
    points.push_back({(k & 1u ? x.second : x.first) + lean * at,
                      k & 2u ? y.second : y.first, at});
  }
  points.push_back(
      {x.first + 1 + lean * (z.first + 1), y.first + 1, z.first + 1});
  return points;
}

/// A region that holds all of a model: a box, or a hull where it fits the grid.
std::optional<ObjectRegion> region_of(const Model& model, const ObjectMap& map,
                                      int grid_bits, std::uint64_t seed) {
  std::optional<ObjectRegion> box;
  for (const VertexId v : model.scene.data().corners)
    extend_moved(box, model.scene.point(v), map);
  for (const MovingObject& object : model.objects) {
    for (const GridPoint& p : corners_of(object.region))
      extend_moved(box, p, map);
  }
  const std::uint64_t kind = mix(seed) % 4;
  if (kind < 2 || !box) return box;
  const std::vector<Moved> places = moved_corners(model, map);
  const std::vector<GridPoint> points =
      kind == 2 ? tetrahedron(places, map.shift, mix(seed + 1))
                : leaning_box(places, map.shift, mix(seed + 1));
  for (const GridPoint& p : points) {
    if (!fits(p.x, grid_bits) || !fits(p.y, grid_bits) || !fits(p.z, grid_bits))
      return box;
  }
  const Result<ObjectRegion> hull = hull_region(points);
  return hull ? std::optional(*hull) : box;
}

/// The scene without the polygons whose boxes share space with a region.
Scene freed(const Scene& scene, const std::vector<MovingObject>& objects) {
  std::vector<PolygonId> left;
  for (PolygonId id = 0; id < static_cast<PolygonId>(scene.polygon_count());
       ++id) {
    std::optional<ObjectRegion> box;
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
std::optional<Camera> camera_at(const ObjectRegion& region, int grid_bits,
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

namespace {

/// The ids of the polygons of the three models.
using Divided = std::array<std::vector<PolygonId>, 3>;

/// Takes the polygons away that reach into regions.
using Free = std::function<Scene(const Scene& scene,
                                 const std::vector<MovingObject>& objects)>;

std::optional<MovingView> moving_view(const SceneFile& view, std::uint64_t seed,
                                      const Divided& ids, bool frees,
                                      const Free& free) {
  const Scene& scene = view.scene;
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
  const ObjectMap inner = map(10);
  const int bits = scene.grid_bits();
  models[1].objects.push_back(
      {2, *region_of(models[2], inner, bits, mix(seed + 60))});
  const ObjectMap outer = map(20);
  models[0].objects.push_back(
      {1, *region_of(models[1], outer, bits, mix(seed + 61))});
  const ObjectMap other = map(30);
  const MovingObject beside = {
      2, *region_of(models[2], other, bits, mix(seed + 62))};
  const bool has_beside =
      !share_space(beside.region, models[0].objects[0].region);
  if (has_beside) models[0].objects.push_back(beside);
  for (std::size_t k = 0; k < 2; ++k) {
    if (frees) models[k].scene = free(models[k].scene, models[k].objects);
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
    std::optional<ObjectRegion> box;
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

}  // namespace

std::optional<MovingView> moving_view(const SceneFile& view,
                                      std::uint64_t seed) {
  const auto count = view.scene.polygon_count();
  if (count == 0) return std::nullopt;
  Divided ids;
  for (std::size_t p = 0; p < count; ++p)
    ids[mix(seed + p) % 3].push_back(static_cast<PolygonId>(p));
  for (std::size_t k = 1; k < 3; ++k) {
    if (ids[k].empty())
      ids[k].push_back(static_cast<PolygonId>(mix(seed + k) % count));
  }
  return moving_view(view, seed, ids, mix(seed + 40) % 2 != 0, freed);
}

std::optional<MovingView> moving_parts(const SceneFile& view,
                                       std::uint64_t seed) {
  const std::vector<std::uint32_t> parts = connected_parts(view.scene);
  if (parts.empty()) return std::nullopt;
  const std::uint32_t last = *std::max_element(parts.begin(), parts.end());
  Divided ids;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const auto id = static_cast<PolygonId>(p);
    // The first two parts are of objects, the same one where there is no other.
    if (parts[p] == 0) ids[1].push_back(id);
    if (parts[p] == std::min(last, 1u)) ids[2].push_back(id);
    if (parts[p] > 1) ids[mix(seed + parts[p]) % 3].push_back(id);
  }
  return moving_view(
      view, seed, ids, true,
      [](const Scene& scene, const std::vector<MovingObject>& objects) {
        Scene left = freed(scene, objects);
        return left.polygon_count() == scene.polygon_count()
                   ? left
                   : part_of(scene, {});
      });
}

}  // namespace halfspace::generate
