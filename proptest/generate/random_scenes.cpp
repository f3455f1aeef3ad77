#include "generate/random_scenes.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "halfspace/assert.hpp"
#include "halfspace/bsp_tree.hpp"

namespace halfspace::agree {
namespace {

using Corners = std::vector<GridPoint>;

GridPoint random_point(Draws& draws, std::int64_t size) {
  return {draws.from_to(-size, size), draws.from_to(-size, size),
          draws.from_to(-size, size)};
}

GridPoint moved(const GridPoint& p, std::int64_t by, Draws& draws) {
  const GridPoint step = random_point(draws, by);
  return {p.x + step.x, p.y + step.y, p.z + step.z};
}

Corners small(Draws& draws) {
  return {random_point(draws, 4), random_point(draws, 4),
          random_point(draws, 4)};
}

/// A rectangle parallel to two axes, some of its edges with a corner amid.
Corners face(Draws& draws) {
  const std::int64_t u0 = draws.from_to(-6, 4);
  const std::int64_t u1 = draws.from_to(u0 + 2, 6);
  const std::int64_t v0 = draws.from_to(-6, 4);
  const std::int64_t v1 = draws.from_to(v0 + 2, 6);
  const std::int64_t w = draws.from_to(-5, 5);
  std::vector<std::pair<std::int64_t, std::int64_t>> outline = {{u0, v0}};
  if (draws.one_in(3)) outline.push_back({u0 + 1, v0});
  outline.push_back({u1, v0});
  if (draws.one_in(3)) outline.push_back({u1, v0 + 1});
  outline.push_back({u1, v1});
  if (draws.one_in(3)) outline.push_back({u1 - 1, v1});
  outline.push_back({u0, v1});
  const std::int64_t axis = draws.from_to(0, 2);
  Corners corners;
  for (const auto& [u, v] : outline) {
    corners.push_back(axis == 0   ? GridPoint{w, u, v}
                      : axis == 1 ? GridPoint{v, w, u}
                                  : GridPoint{u, v, w});
  }
  if (draws.one_in(2)) corners = Corners(corners.rbegin(), corners.rend());
  return corners;
}

Corners sliver(Draws& draws, std::int64_t size) {
  const GridPoint p = random_point(draws, size - 8);
  const GridPoint q = random_point(draws, size - 8);
  const GridPoint middle = {p.x / 2 + q.x / 2, p.y / 2 + q.y / 2,
                            p.z / 2 + q.z / 2};
  return {p, q, draws.one_in(2) ? moved(middle, 2, draws) : moved(q, 3, draws)};
}

/// A triangle in one of a few parallel planes x + 2 y + 3 z = constant.
Corners parallel(Draws& draws) {
  const std::int64_t offset = draws.from_to(-3, 3);
  Corners corners;
  for (int k = 0; k < 3; ++k) {
    const std::int64_t y = draws.from_to(-500, 500);
    const std::int64_t z = draws.from_to(-500, 500);
    corners.push_back({offset - 2 * y - 3 * z, y, z});
  }
  return corners;
}

/// A triangle whose corners are those of a fixed one, or a step or two off.
Corners fine(Draws& draws, std::int64_t size) {
  const std::int64_t s = size - 8;
  const GridPoint base[] = {
      {-s, -s, -s}, {s, s / 3, -s / 5}, {-s / 7, s, s}, {s / 2, -s / 3, s}};
  Corners corners;
  const std::int64_t left_out = draws.from_to(0, 3);
  for (std::int64_t k = 0; k < 4; ++k) {
    if (k == left_out) continue;
    corners.push_back(moved(base[k], draws.from_to(0, 2), draws));
  }
  return corners;
}

Corners random_corners(Kind kind, int grid_bits, Draws& draws) {
  const std::int64_t size = (std::int64_t{1} << (grid_bits - 1)) - 1;
  switch (kind) {
    case Kind::kSmall:
      return small(draws);
    case Kind::kFaces:
      return face(draws);
    case Kind::kWide:
      return {random_point(draws, size), random_point(draws, size),
              random_point(draws, size)};
    case Kind::kSlivers:
      return sliver(draws, size);
    case Kind::kParallel:
      return parallel(draws);
    case Kind::kFine:
      return fine(draws, size);
  }
  HALFSPACE_ASSERT(false && "a kind");
  return {};
}

Rgb random_color(Draws& draws) {
  const std::uint64_t bits = draws.next();
  return {static_cast<std::uint8_t>(bits), static_cast<std::uint8_t>(bits >> 8),
          static_cast<std::uint8_t>(bits >> 16)};
}

/// The half side of a cube about the origin that holds most of the scene.
/// Units: lattice steps.
std::int64_t lattice_size(Kind kind, int grid_bits) {
  const std::int64_t steps = std::int64_t{1} << kLatticeBits;
  switch (kind) {
    case Kind::kSmall:
    case Kind::kFaces:
      return 8 * steps;
    case Kind::kParallel:
      return 1024 * steps;
    default:
      return (std::int64_t{1} << (grid_bits - 1)) * steps;
  }
}

LatticeVector to_lattice(const GridPoint& p) {
  const Int128 step = Int128{1} << kLatticeBits;
  return {step * p.x, step * p.y, step * p.z};
}

LatticeVector random_lattice(std::int64_t size, Draws& draws) {
  const GridPoint p = random_point(draws, size);
  return {p.x, p.y, p.z};
}

/// The step from one pixel to the next, about `size` long.
LatticeVector random_axis(std::int64_t size, bool along_grid, Draws& draws) {
  if (!along_grid) return random_lattice(size, draws);
  const std::int64_t s = draws.one_in(2) ? size : -size;
  const std::int64_t axis = draws.from_to(0, 2);
  return {axis == 0 ? s : 0, axis == 1 ? s : 0, axis == 2 ? s : 0};
}

/// A corner of the scene, or a point of an edge's middle, or anywhere.
LatticeVector random_eye(const Scene& scene, std::int64_t size, Draws& draws) {
  const auto count = static_cast<std::int64_t>(scene.data().vertices.size());
  if (count > 0 && draws.one_in(4)) {
    const auto corner = static_cast<VertexId>(draws.from_to(0, count - 1));
    return to_lattice(scene.point(corner));
  }
  if (count > 0 && draws.one_in(4)) {
    // On a polygon's plane: p + (q - p) - (r - p) is, for corners p, q, r.
    const auto polygons = static_cast<std::int64_t>(scene.polygon_count());
    const auto corners =
        scene.corners(static_cast<PolygonId>(draws.from_to(0, polygons - 1)));
    const LatticeVector p = to_lattice(scene.point(corners[0]));
    const LatticeVector q = to_lattice(scene.point(corners[1]));
    const LatticeVector r = to_lattice(scene.point(corners[2]));
    return {p.x + q.x - r.x, p.y + q.y - r.y, p.z + q.z - r.z};
  }
  if (draws.one_in(3)) return random_lattice(size, draws);
  if (size <= std::int64_t{1} << 60) return random_lattice(4 * size, draws);
  // So far away there are points that 64 bits do not hold.
  const LatticeVector p = random_lattice(size, draws);
  return {4 * p.x, 4 * p.y, 4 * p.z};
}

}  // namespace

Camera random_camera(Kind kind, const Scene& scene, std::int32_t width_px,
                     std::int32_t height_px, Draws& draws) {
  const std::int64_t size = lattice_size(kind, scene.grid_bits());
  while (true) {
    CameraData data;
    data.width_px = width_px;
    data.height_px = height_px;
    data.perspective = !draws.one_in(3);
    data.eye = random_eye(scene, size, draws);
    const bool along_grid = draws.one_in(2);
    std::int64_t step = 2 * size / std::max(width_px, height_px) + 1;
    if (along_grid && step > 128) step = step / 128 * 128;
    step *= draws.from_to(1, 2);
    data.sx = random_axis(step, along_grid, draws);
    data.sy = random_axis(step, along_grid, draws);
    if (!data.perspective && draws.one_in(2)) {
      data.eye = random_axis(size, true, draws);
    }
    LatticeVector centre = random_lattice(size / 3, draws);
    if (along_grid && size > 1024) {
      centre = {centre.x / 128 * 128, centre.y / 128 * 128,
                centre.z / 128 * 128};
    }
    const Int128 right = width_px / 2;
    const Int128 down = height_px / 2;
    data.s0 = {centre.x - right * data.sx.x - down * data.sy.x,
               centre.y - right * data.sx.y - down * data.sy.y,
               centre.z - right * data.sx.z - down * data.sy.z};
    if (draws.one_in(3)) {
      const std::int64_t one = std::int64_t{1} << kNearBits;
      data.near = draws.from_to(data.perspective ? 0 : -one, 2 * one);
      if (draws.one_in(3)) data.near = one;
    }
    if (auto camera = make_camera(data, scene.grid_bits())) return *camera;
  }
}

std::uint64_t Draws::next() {
  state_ = mix(state_);
  return state_;
}

std::int64_t Draws::from_to(std::int64_t low, std::int64_t high) {
  const auto count = static_cast<std::uint64_t>(high - low) + 1;
  return low + static_cast<std::int64_t>(next() % count);
}

const char* name_of(Kind kind) {
  switch (kind) {
    case Kind::kSmall:
      return "small";
    case Kind::kFaces:
      return "faces";
    case Kind::kWide:
      return "wide";
    case Kind::kSlivers:
      return "slivers";
    case Kind::kParallel:
      return "parallel";
    case Kind::kFine:
      return "fine";
  }
  return "";
}

Scene random_scene(Kind kind, int grid_bits, int polygons, Draws& draws,
                   bool corner_colors) {
  SceneData data;
  data.grid_bits = grid_bits;
  for (int p = 0; p < polygons; ++p) {
    const Corners corners = random_corners(kind, grid_bits, draws);
    SceneData one;
    one.grid_bits = grid_bits;
    one.vertices = corners;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      one.corners.push_back(static_cast<VertexId>(k));
    }
    one.first_corner = {0, static_cast<std::uint32_t>(corners.size())};
    one.colors = {Rgb{}};
    if (!make_scene(one)) continue;
    for (const GridPoint& corner : corners) {
      data.corners.push_back(static_cast<VertexId>(data.vertices.size()));
      data.vertices.push_back(corner);
    }
    data.first_corner.push_back(
        static_cast<std::uint32_t>(data.corners.size()));
    data.colors.push_back(random_color(draws));
    if (!corner_colors) continue;
    const Rgb color = random_color(draws);
    const bool triangle = corners.size() == 3;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      data.corner_colors.push_back(triangle ? random_color(draws) : color);
    }
  }
  Result<Scene> scene = make_scene(std::move(data));
  HALFSPACE_ASSERT(scene.has_value());
  return *std::move(scene);
}

}  // namespace halfspace::agree
