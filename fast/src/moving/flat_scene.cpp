#include "halfspace/fast/image/flat_scene.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

namespace halfspace::fast {
namespace {

/// Moves points onto the grid of the flat scene.
class FlatGrid {
 public:
  FlatGrid(const ObjectMap& map, int shift)
      : map_(map), finer_(shift - map.shift) {}

  /// Bits: an entry of M has 62, a coordinate 54, three products and t 120.
  std::optional<GridPoint> moved(const GridPoint& p) const {
    GridPoint at;
    const std::array<std::int64_t*, 3> to = {&at.x, &at.y, &at.z};
    for (std::size_t k = 0; k < 3; ++k) {
      const Int128 value = Int128{map_.m[3 * k]} * p.x +
                           Int128{map_.m[3 * k + 1]} * p.y +
                           Int128{map_.m[3 * k + 2]} * p.z + map_.t[k];
      const Int128 most = (Int128{1} << (kFlatGrid - 1)) >> finer_;
      if (value < -most || value > most) return std::nullopt;
      const Int128 fine = value * (Int128{1} << finer_);
      if (!fits(static_cast<std::int64_t>(fine), kFlatGrid))
        return std::nullopt;
      *to[k] = static_cast<std::int64_t>(fine);
    }
    return at;
  }

 private:
  const ObjectMap& map_;
  int finer_;
};

/// Adds the occurrences' polygons one after another.
class FlatMaker {
 public:
  FlatMaker(const Scene& world, int shift, bool has_colors)
      : shift_(shift), has_colors_(has_colors) {
    data_.unit = world.unit();
    data_.grid_bits = kFlatGrid;
  }

  /// False where a corner is beyond the grid.
  bool add(const Scene& scene, const ObjectMap& map, PolygonId first_id) {
    const FlatGrid grid(map, shift_);
    const auto first_vertex = static_cast<VertexId>(data_.vertices.size());
    const SceneData& from = scene.data();
    data_.vertices.reserve(data_.vertices.size() + from.vertices.size());
    std::vector<bool> is_corner(from.vertices.size(), false);
    for (const VertexId v : from.corners)
      is_corner[static_cast<std::size_t>(v)] = true;
    for (std::size_t v = 0; v < from.vertices.size(); ++v) {
      // What is no corner need not fit.
      const auto at = is_corner[v] ? grid.moved(from.vertices[v]) : GridPoint{};
      if (!at) return false;
      data_.vertices.push_back(*at);
    }
    const bool is_turned = orientation_of(map) < 0;
    for (std::size_t p = 0; p < scene.polygon_count(); ++p) {
      const std::uint32_t first = from.first_corner[p];
      const std::uint32_t end = from.first_corner[p + 1];
      const Rgb color = from.colors[p];
      for (std::uint32_t k = first; k < end; ++k) {
        const std::uint32_t corner = is_turned ? first + end - 1 - k : k;
        data_.corners.push_back(first_vertex + from.corners[corner]);
        corners_.push_back(corner);
        if (!has_colors_) continue;
        data_.corner_colors.push_back(
            from.corner_colors.empty() ? color : from.corner_colors[corner]);
      }
      data_.first_corner.push_back(
          static_cast<std::uint32_t>(data_.corners.size()));
      data_.colors.push_back(color);
      ids_.push_back(first_id + static_cast<PolygonId>(p));
    }
    return true;
  }

  Result<FlatScene> finish(const Camera& camera) {
    Result<Scene> scene = make_scene(std::move(data_));
    if (!scene) return scene.error();
    const Result<Camera> fine = flat_camera(camera, shift_);
    if (!fine) return fine.error();
    return FlatScene{*std::move(scene), *fine, std::move(ids_),
                     std::move(corners_), shift_};
  }

 private:
  int shift_;
  bool has_colors_;
  SceneData data_;
  std::vector<PolygonId> ids_;
  std::vector<std::uint32_t> corners_;
};

}  // namespace

Result<FlatScene> flat_scene(const Assembly& assembly,
                             const Placement& placement, const Camera& camera) {
  const auto& occurrences = assembly.occurrences();
  std::vector<std::size_t> order;
  bool has_colors = false;
  for (std::size_t o = 0; o < occurrences.size(); ++o) {
    if (placement.to_world()[o]) order.push_back(o);
    const Scene& scene = assembly.model(occurrences[o].model).scene;
    has_colors = has_colors || !scene.data().corner_colors.empty();
  }
  std::stable_sort(
      order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return occurrences[a].first_polygon < occurrences[b].first_polygon;
      });
  FlatMaker maker(assembly.models()[0].scene, flat_shift(placement),
                  has_colors);
  for (const std::size_t o : order) {
    const Occurrence& here = occurrences[o];
    if (!maker.add(assembly.model(here.model).scene, *placement.to_world()[o],
                   here.first_polygon))
      return off_flat_grid();
  }
  return maker.finish(camera);
}

}  // namespace halfspace::fast
