#include "halfspace/moving.hpp"

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <memory>
#include <numeric>
#include <string>
#include <utility>

#include "halfspace/big_integer.hpp"
#include "halfspace/cap_parts.hpp"
#include "halfspace/clip.hpp"

namespace halfspace {
namespace {

using BigInt = boost::multiprecision::cpp_int;

constexpr std::size_t kMostOccurrences = std::size_t{1} << 24;
constexpr std::size_t kMostPolygons = 2147483647;

std::int64_t coordinate_on(const GridPoint& p, std::size_t axis) {
  return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
}

std::string name_of_object(std::int32_t model, std::size_t object) {
  return "object " + std::to_string(object) + " of model " +
         std::to_string(model);
}

/// What is wrong with the regions of a model.
std::optional<Error> fault_of_regions(const Model& model, std::int32_t index) {
  const auto& objects = model.objects;
  for (std::size_t k = 0; k < objects.size(); ++k) {
    const ObjectRegion& r = objects[k].region;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::int64_t low = coordinate_on(r.low, axis);
      const std::int64_t high = coordinate_on(r.high, axis);
      if (low < high && fits(low, model.scene.grid_bits()) &&
          fits(high, model.scene.grid_bits())) {
        continue;
      }
      return Error{ErrorCode::kOutOfRange,
                   "the region of " + name_of_object(index, k) +
                       " is empty, or reaches out of the grid",
                   static_cast<std::int64_t>(k)};
    }
    if (r.hull.empty() && r.slanted.empty()) continue;
    const Result<ObjectRegion> made = hull_region(r.hull);
    if (made && *made == r) continue;
    return Error{ErrorCode::kOutOfRange,
                 "the region of " + name_of_object(index, k) +
                     (made ? " is not the hull of its points"
                           : " is none: " + made.error().message),
                 static_cast<std::int64_t>(k)};
  }
  // Sweep along x: only regions that overlap there are compared.
  std::vector<std::size_t> order(objects.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::pair(objects[a].region.low.x, a) <
           std::pair(objects[b].region.low.x, b);
  });
  for (std::size_t i = 0; i < order.size(); ++i) {
    const ObjectRegion& first = objects[order[i]].region;
    for (std::size_t j = i + 1; j < order.size(); ++j) {
      const ObjectRegion& second = objects[order[j]].region;
      if (second.low.x >= first.high.x) break;
      if (!share_space(first, second)) continue;
      return Error{ErrorCode::kOutOfRange,
                   "the regions of " +
                       name_of_object(index, std::min(order[i], order[j])) +
                       " and of " +
                       name_of_object(index, std::max(order[i], order[j])) +
                       " share space; move them apart",
                   static_cast<std::int64_t>(std::min(order[i], order[j]))};
    }
  }
  return std::nullopt;
}

void extend(std::optional<ObjectRegion>& box, const GridPoint& p) {
  if (!box) box = ObjectRegion{p, p};
  box->low = {std::min(box->low.x, p.x), std::min(box->low.y, p.y),
              std::min(box->low.z, p.z)};
  box->high = {std::max(box->high.x, p.x), std::max(box->high.y, p.y),
               std::max(box->high.z, p.z)};
}

std::optional<ObjectRegion> extent_of(const Model& model) {
  std::optional<ObjectRegion> box;
  for (const VertexId v : model.scene.data().corners)
    extend(box, model.scene.point(v));
  for (const MovingObject& object : model.objects) {
    extend(box, object.region.low);
    extend(box, object.region.high);
  }
  return box;
}

/// Totals of a model with all that is in it; beyond the limits they stay there.
struct Totals {
  std::size_t polygons = 0;
  std::size_t occurrences = 1;
  int depth = 0;
};

Int128 map_size(Int128 value) { return value < 0 ? -value : value; }
Int128 map_power(int exponent) { return Int128{1} << exponent; }

/// Whether the point that stands at `at` / 2^shift is on the inner side of the
/// face, and not on it where `strictly`. Bits: a normal of 112, an `at` of 88,
/// and 54 + 31 for the face's point.
bool is_within(const std::array<Int128, 3>& at, int shift,
               const RegionFace& face, bool strictly) {
  using Wide = boost::multiprecision::int256_t;
  std::array<std::array<Wide, 3>, 3> p;
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      p[k][axis] = coordinate_on(face[k], axis);
  }
  Wide value = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t u = (axis + 1) % 3;
    const std::size_t v = (axis + 2) % 3;
    const Wide normal = (p[1][u] - p[0][u]) * (p[2][v] - p[0][v]) -
                        (p[1][v] - p[0][v]) * (p[2][u] - p[0][u]);
    value += normal * (to_big<Wide>(at[axis]) - (p[0][axis] << shift));
  }
  return strictly ? value > 0 : value >= 0;
}

/// Whether the point's place is in the region, and not on its boundary where
/// `strictly`. Bits: 3 products of 31 and 54, and a `t` of 86, against 54 and
/// 31.
bool stays_in(const GridPoint& p, const ObjectMap& map,
              const ObjectRegion& region, bool strictly) {
  const Int128 margin = strictly ? 1 : 0;
  std::array<Int128, 3> at;
  for (std::size_t row = 0; row < 3; ++row) {
    const std::int64_t* m = &map.m[3 * row];
    at[row] = Int128{m[0]} * p.x + Int128{m[1]} * p.y + Int128{m[2]} * p.z +
              map.t[row];
    if (at[row] - margin <
            coordinate_on(region.low, row) * map_power(map.shift) ||
        at[row] + margin >
            coordinate_on(region.high, row) * map_power(map.shift)) {
      return false;
    }
  }
  return std::all_of(region.slanted.begin(), region.slanted.end(),
                     [&](const RegionFace& face) {
                       return is_within(at, map.shift, face, strictly);
                     });
}

/// A model whose box stays in stays in; else its corners decide, and the boxes
/// of its regions.
bool stays_in(const Model& model, const std::optional<ObjectRegion>& extent,
              const ObjectMap& map, const ObjectRegion& region) {
  const auto all = [&](const ObjectRegion& box, bool strictly) {
    const auto corners = corners_of(box);
    return std::all_of(corners.begin(), corners.end(), [&](const auto& p) {
      return stays_in(p, map, region, strictly);
    });
  };
  if (!extent || all(*extent, true)) return true;
  const auto& corners = model.scene.data().corners;
  return std::all_of(corners.begin(), corners.end(),
                     [&](VertexId v) {
                       return stays_in(model.scene.point(v), map, region, true);
                     }) &&
         std::all_of(
             model.objects.begin(), model.objects.end(),
             [&](const MovingObject& o) { return all(o.region, false); });
}

/// What is wrong with a map by itself (S12.2), in words; empty if nothing.
std::string fault_of_map(const ObjectMap& map, ErrorCode& code) {
  code = ErrorCode::kOutOfRange;
  for (const std::int64_t entry : map.m) {
    if (map_size(entry) >= map_power(kMapBits))
      return "has a map with an entry of 2^31 or more; use a smaller shift";
  }
  for (const Int128 offset : map.t) {
    if (map_size(offset) >= map_power(kMapOffsetBits))
      return "has a map that moves by 2^86 or more";
  }
  if (map.shift < 0 || map.shift > kMapBits)
    return "has a map whose shift is not from 0 to 31";
  if (orientation_of(map) == 0) {
    code = ErrorCode::kZeroArea;
    return "has a singular map, which flattens it";
  }
  return {};
}

/// `outer` after `inner`, shared powers of two taken out; nothing beyond the
/// limits of S12.3.
std::optional<ObjectMap> composed(const ObjectMap& outer,
                                  const ObjectMap& inner) {
  std::array<BigInt, 12> all;
  for (std::size_t row = 0; row < 3; ++row) {
    BigInt offset = to_big<BigInt>(outer.t[row]) << inner.shift;
    for (std::size_t k = 0; k < 3; ++k) {
      const BigInt entry = outer.m[3 * row + k];
      for (std::size_t column = 0; column < 3; ++column)
        all[3 * row + column] += entry * inner.m[3 * k + column];
      offset += entry * to_big<BigInt>(inner.t[k]);
    }
    all[9 + row] = offset;
  }
  int shift = outer.shift + inner.shift;
  const auto is_even = [](const BigInt& v) { return v % 2 == 0; };
  while (shift > 0 && std::all_of(all.begin(), all.end(), is_even)) {
    for (BigInt& v : all) v /= 2;
    --shift;
  }
  ObjectMap map;
  map.shift = shift;
  bool fits_all = shift <= kComposedBits;
  for (std::size_t k = 0; k < 12 && fits_all; ++k) {
    const BigInt limit = BigInt(1)
                         << (k < 9 ? kComposedBits : kComposedOffsetBits);
    fits_all = abs(all[k]) < limit;
    if (!fits_all) break;
    const auto value = to_int128(all[k]);
    if (k < 9) map.m[k] = static_cast<std::int64_t>(value);
    if (k >= 9) map.t[k - 9] = value;
  }
  return fits_all ? std::optional(map) : std::nullopt;
}

}  // namespace

Result<Assembly> make_assembly(std::vector<Model> models) {
  if (models.empty())
    return Error{ErrorCode::kEmpty, "there is no world for objects"};
  const auto count = static_cast<std::int32_t>(models.size());
  std::vector<Totals> totals(models.size());
  Assembly assembly;
  for (std::int32_t m = count - 1; m >= 0; --m) {
    const Model& model = models[static_cast<std::size_t>(m)];
    Totals& total = totals[static_cast<std::size_t>(m)];
    total.polygons = model.scene.polygon_count();
    for (std::size_t k = 0; k < model.objects.size(); ++k) {
      const std::int32_t inner = model.objects[k].model;
      if (inner <= m || inner >= count) {
        return Error{ErrorCode::kBadIndex,
                     name_of_object(m, k) + " is of model " +
                         std::to_string(inner) +
                         "; models come after those they are in",
                     static_cast<std::int64_t>(k)};
      }
      const Totals& other = totals[static_cast<std::size_t>(inner)];
      total.polygons =
          std::min(total.polygons + other.polygons, kMostPolygons + 1);
      total.occurrences =
          std::min(total.occurrences + other.occurrences, kMostOccurrences + 1);
      total.depth = std::max(total.depth, other.depth + 1);
    }
    if (total.polygons > kMostPolygons ||
        total.occurrences > kMostOccurrences || total.depth > kMostNesting) {
      return Error{ErrorCode::kOutOfRange,
                   "the objects of model " + std::to_string(m) +
                       " have more than 2^31 - 1 polygons, are more than 2^24 "
                       "or nested deeper than 16",
                   m};
    }
    if (const auto fault = fault_of_regions(model, m)) return *fault;
  }
  assembly.occurrences_.push_back({});
  for (std::size_t o = 0; o < assembly.occurrences_.size(); ++o) {
    const Model& model =
        models[static_cast<std::size_t>(assembly.occurrences_[o].model)];
    assembly.occurrences_[o].first_child =
        static_cast<std::int32_t>(assembly.occurrences_.size());
    std::size_t next =
        static_cast<std::size_t>(assembly.occurrences_[o].first_polygon) +
        model.scene.polygon_count();
    for (std::size_t k = 0; k < model.objects.size(); ++k) {
      const std::int32_t inner = model.objects[k].model;
      assembly.occurrences_.push_back({inner, static_cast<std::int32_t>(o),
                                       static_cast<std::int32_t>(k), 0,
                                       static_cast<PolygonId>(next)});
      next += totals[static_cast<std::size_t>(inner)].polygons;
    }
  }
  for (const Model& model : models)
    assembly.extents_.push_back(extent_of(model));
  assembly.polygon_count_ = totals[0].polygons;
  assembly.models_ = std::move(models);
  return assembly;
}

Pose empty_pose(const Assembly& assembly) {
  Pose pose;
  for (const Model& model : assembly.models())
    pose.maps.emplace_back(model.objects.size());
  return pose;
}

int orientation_of(const ObjectMap& map) {
  std::array<BigInt, 9> m;
  std::copy(map.m.begin(), map.m.end(), m.begin());
  const BigInt determinant = m[0] * (m[4] * m[8] - m[5] * m[7]) -
                             m[1] * (m[3] * m[8] - m[5] * m[6]) +
                             m[2] * (m[3] * m[7] - m[4] * m[6]);
  return determinant.sign();
}

Result<Placement> make_placement(const Assembly& assembly, const Pose& pose) {
  const auto& models = assembly.models();
  bool agrees = pose.maps.size() == models.size();
  for (std::size_t m = 0; agrees && m < models.size(); ++m)
    agrees = pose.maps[m].size() == models[m].objects.size();
  if (!agrees) {
    return Error{ErrorCode::kBadIndex,
                 "the pose is of other models than the objects"};
  }
  Placement placement;
  const auto& occurrences = assembly.occurrences();
  placement.to_world_.resize(occurrences.size());
  placement.to_world_[0] = ObjectMap{};
  for (std::size_t o = 1; o < occurrences.size(); ++o) {
    const Occurrence& here = occurrences[o];
    const auto owner = static_cast<std::size_t>(here.owner);
    if (!placement.to_world_[owner]) continue;
    const std::int32_t in = occurrences[owner].model;
    const auto object = static_cast<std::size_t>(here.object);
    const auto& map = pose.maps[static_cast<std::size_t>(in)][object];
    if (!map) continue;
    const auto index = static_cast<std::int64_t>(o);
    ErrorCode code;
    const std::string fault = fault_of_map(*map, code);
    if (!fault.empty())
      return Error{code, name_of_object(in, object) + " " + fault, index};
    if (!stays_in(assembly.model(here.model), assembly.extent(here.model), *map,
                  assembly.model(in).objects[object].region)) {
      return Error{ErrorCode::kOutOfRange,
                   name_of_object(in, object) + " leaves its region", index};
    }
    placement.to_world_[o] =
        owner == 0 ? map : composed(*placement.to_world_[owner], *map);
    if (!placement.to_world_[o]) {
      return Error{ErrorCode::kOutOfRange,
                   name_of_object(in, object) +
                       " has a map that, after those it is in, has numbers "
                       "beyond 62 bits; use smaller shifts",
                   index};
    }
  }
  return placement;
}

namespace {

/// The sizes of a camera's numbers (S4.1) on the grid of flat scenes.
constexpr int kFlatCameraBits = kFlatGrid + 13;

/// Makes a vector 2^shift times as long, if its numbers stay in size.
bool lengthen(LatticeVector& v, int shift) {
  const Int128 most = (Int128{1} << kFlatCameraBits) >> shift;
  for (Int128* x : {&v.x, &v.y, &v.z}) {
    if (*x > most || -*x > most) return false;
    *x *= Int128{1} << shift;
  }
  return true;
}

}  // namespace

int flat_shift(const Placement& placement) {
  int finest = 0;
  for (const auto& map : placement.to_world()) {
    if (map) finest = std::max(finest, map->shift);
  }
  return finest;
}

Error off_flat_grid() {
  return {ErrorCode::kOutOfRange,
          "moved corners, or the camera among them, do not fit a grid of 54 "
          "bits: maps have too many bits after each other"};
}

Result<Camera> flat_camera(const Camera& camera, int shift) {
  CameraData view = camera.data();
  for (LatticeVector* v : {&view.eye, &view.s0, &view.sx, &view.sy}) {
    // An eye at infinity is a direction: t counts its length, and only a near
    // distance counts t.
    if (v == &view.eye && !view.perspective && !view.near) continue;
    if (!lengthen(*v, shift)) return off_flat_grid();
  }
  return make_camera(view, kFlatGrid);
}

Result<ImageOptions> flat_options(const FlatScene& flat,
                                  const ImageOptions& options) {
  ImageOptions result = options;
  const Int128 scale = Int128{1} << flat.shift;
  const Int128 most = (Int128{1} << 126) / scale;
  for (ClipPlane& clip : result.clips) {
    if (clip.d > most || -clip.d > most) {
      return Error{ErrorCode::kOutOfRange,
                   "a clip plane is too far away for so fine a grid"};
    }
    clip.d *= scale;
  }
  const auto clips = make_clips(result.clips, flat.scene.grid_bits());
  if (!clips) return clips.error();
  result.clips = *clips;
  if (options.parts) {
    CapParts parts = *options.parts;
    parts.part_of.clear();
    for (const PolygonId id : flat.ids)
      parts.part_of.push_back(
          options.parts->part_of[static_cast<std::size_t>(id)]);
    result.parts = std::make_shared<const CapParts>(std::move(parts));
  }
  return result;
}

PolygonId moved_item(const Assembly& assembly, const FlatScene& flat,
                     PolygonId item) {
  if (item == kBackground) return item;
  const auto count = static_cast<PolygonId>(flat.ids.size());
  return item < count
             ? flat.ids[static_cast<std::size_t>(item)]
             : static_cast<PolygonId>(assembly.polygon_count()) + item - count;
}

}  // namespace halfspace
