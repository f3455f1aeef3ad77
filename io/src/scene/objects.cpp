#include "halfspace/io/objects.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

namespace halfspace::io {
namespace {

/// The bits that the greatest entry of a map gets: at three levels of nesting
/// maps stay within S12.3.
constexpr int kEntryBits = 20;

/// The bits that a limit of shifts leaves it at least: a corner that is turned
/// about a point moves by 2^-15 of its distance, a sixtieth of a pixel where
/// that is 500 of them.
constexpr int kLeastEntryBits = 14;

/// How deep an assembly's occurrences are nested.
int depth_of(const Assembly& assembly) {
  const auto& all = assembly.occurrences();
  std::vector<int> depths(all.size(), 0);
  int most = 0;
  // Each comes after its owner.
  for (std::size_t o = 1; o < all.size(); ++o) {
    depths[o] = depths[static_cast<std::size_t>(all[o].owner)] + 1;
    most = std::max(most, depths[o]);
  }
  return most;
}

double length_of(const Unit& unit) {
  return std::pow(unit.base, unit.exponent);
}

/// Rounded; beyond every limit of S12.2, but within the type's.
double whole(double value, double most) {
  return std::nearbyint(std::clamp(value, -most, most));
}

}  // namespace

int most_shift(const Assembly& assembly) {
  const int depth = depth_of(assembly);
  const auto& extent = assembly.extent(0);
  if (depth == 0 || !extent) return kMapBits;
  std::int64_t most = 1;
  for (const GridPoint& p : {extent->low, extent->high})
    most = std::max({most, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  const int bits = std::ilogb(static_cast<double>(most)) + 1;
  return std::clamp((kFlatGrid - 1 - bits) / depth, 0, kMapBits);
}

ObjectMap object_map(const std::array<std::array<double, 4>, 3>& rows,
                     const Unit& inner, const Unit& outer, int most_shift) {
  const double size = length_of(inner) / length_of(outer);
  double greatest = 0;
  for (const auto& row : rows) {
    for (std::size_t k = 0; k < 3; ++k)
      greatest = std::max(greatest, std::abs(row[k] * size));
  }
  ObjectMap map;
  if (greatest > 0 && std::isfinite(greatest)) {
    const int bits = std::ilogb(greatest);
    map.shift = std::clamp(kEntryBits - bits, 0, kMapBits);
    if (most_shift + bits >= kLeastEntryBits)
      map.shift = std::min(map.shift, most_shift);
  }
  const double scale = std::ldexp(1.0, map.shift);
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t k = 0; k < 3; ++k) {
      map.m[3 * row + k] =
          static_cast<std::int64_t>(whole(rows[row][k] * size * scale, 0x1p60));
    }
    map.t[row] = static_cast<Int128>(
        whole(rows[row][3] / length_of(outer) * scale, 0x1p100));
  }
  return map;
}

Result<Model> model_on_grid(
    Scene scene,
    std::span<const std::pair<std::int32_t, RegionPoints>> objects) {
  Model model;
  const double unit = length_of(scene.unit());
  std::vector<GridPoint> all;
  for (const auto& [of, points] : objects) {
    const auto index = static_cast<std::int64_t>(model.objects.size());
    const std::string name = "the region of object " + std::to_string(index);
    std::vector<GridPoint> on;
    for (const glm::dvec3& point : points) {
      const glm::dvec3 at = point / unit;
      if (!(glm::length(at) < 0x1p52))
        return Error{ErrorCode::kOutOfRange, name + " is beyond every grid",
                     index};
      on.push_back(
          {std::llround(at.x), std::llround(at.y), std::llround(at.z)});
    }
    all.insert(all.end(), on.begin(), on.end());
    Result<ObjectRegion> region = on.size() == 2 ? ObjectRegion{on[0], on[1]}
                                                 : hull_region(std::move(on));
    if (!region)
      return Error{ErrorCode::kOutOfRange, name + ": " + region.error().message,
                   index};
    model.objects.push_back({of, *std::move(region)});
  }
  const int bits = grid_bits_for(all);
  if (bits > scene.grid_bits()) {
    SceneData data = scene.data();
    data.grid_bits = bits;
    Result<Scene> grown = make_scene(std::move(data));
    if (!grown) return grown.error();
    scene = *std::move(grown);
  }
  model.scene = std::move(scene);
  return model;
}

}  // namespace halfspace::io
