#include "halfspace/ref/moving.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <string>

#include "halfspace/cap_parts.hpp"
#include "halfspace/ref/clip.hpp"
#include "halfspace/ref/projection.hpp"
#include "halfspace/ref/scan.hpp"
#include "halfspace/ref/screen.hpp"
#include "halfspace/ref/shade.hpp"
#include "halfspace/ref/split.hpp"
#include "halfspace/ref/traverse.hpp"
#include "vector.hpp"

namespace halfspace::ref {
namespace {

Rational power_of_two(int exponent) { return Int128{1} << exponent; }

/// (M p + t) / 2^shift (S12.2).
Point moved(const Point& p, const ObjectMap& map) {
  const auto row = [&](std::size_t k) {
    const Rational sum = Rational(map.m[3 * k]) * p.x +
                         Rational(map.m[3 * k + 1]) * p.y +
                         Rational(map.m[3 * k + 2]) * p.z + Rational(map.t[k]);
    return sum / power_of_two(map.shift);
  };
  return {row(0), row(1), row(2)};
}

/// The faces of a region, positive inside: what is on the positive side of all
/// of them is the region.
std::vector<Plane> faces_of(const ObjectRegion& region) {
  const Point low = to_point(region.low);
  const Point high = to_point(region.high);
  std::vector<Plane> faces = {Plane{1, 0, 0, -low.x}, Plane{-1, 0, 0, high.x},
                              Plane{0, 1, 0, -low.y}, Plane{0, -1, 0, high.y},
                              Plane{0, 0, 1, -low.z}, Plane{0, 0, -1, high.z}};
  for (const RegionFace& face : region.slanted) {
    faces.push_back(
        plane_of({to_point(face[0]), to_point(face[1]), to_point(face[2])}));
  }
  return faces;
}

/// A fragment less what is inside of a region (S12.4).
struct Carved {
  std::vector<Fragment> left;
  bool is_cut = false;  ///< whether there was something inside
};
Carved carved(Fragment fragment, const ObjectRegion& region) {
  Carved result;
  for (const Plane& face : faces_of(region)) {
    switch (relation(fragment, face)) {
      case Relation::kPositive:
        break;
      case Relation::kSpanning: {
        auto parts = split(fragment, face, fragment.source);
        result.left.push_back(std::move(parts.negative));
        fragment = std::move(parts.positive);
        break;
      }
      case Relation::kCoincident:  // on the boundary
      case Relation::kNegative:
        result.left.push_back(std::move(fragment));
        return result;
    }
  }
  result.is_cut = true;
  return result;
}

/// What is left of a model's polygon outside of all regions in it.
std::vector<Fragment> left_of(const Model& model, PolygonId polygon) {
  std::vector<Fragment> left = {whole(model.scene, polygon)};
  for (const MovingObject& object : model.objects) {
    std::vector<Fragment> next;
    for (const Fragment& fragment : left) {
      Carved parts = carved(fragment, object.region);
      // Nothing of it is inside: it stays in one.
      if (!parts.is_cut) parts.left = {fragment};
      next.insert(next.end(), parts.left.begin(), parts.left.end());
    }
    left = std::move(next);
  }
  return left;
}

const Occurrence& occurrence_of(const Assembly& assembly, PolygonId id) {
  // A polygon is of the occurrence whose own polygons begin last before it.
  const auto& all = assembly.occurrences();
  const Occurrence* found = nullptr;
  for (const Occurrence& o : all) {
    const auto count =
        static_cast<PolygonId>(assembly.model(o.model).scene.polygon_count());
    if (o.first_polygon <= id && id - o.first_polygon < count) found = &o;
  }
  return *found;
}

/// The colour at the pixel's centre (S5.4): the affine function over the moved
/// triangle's plane that has the corners' colours.
Rgb gouraud_color(const std::vector<Point>& corners,
                  std::span<const Rgb> colors, const Camera& camera,
                  std::int32_t i, std::int32_t j) {
  const Rational step = 1 << kLatticeBits;
  const Rational x = Rational(2 * i + 1) / Rational(2);
  const Rational y = Rational(2 * j + 1) / Rational(2);
  const auto at = [&](Rational Point::*of) {
    return to_point(camera->s0).*of + x * to_point(camera->sx).*of +
           y * to_point(camera->sy).*of;
  };
  const Point s = {at(&Point::x), at(&Point::y), at(&Point::z)};
  const Point eye = to_point(camera->eye);
  const Point start = camera->perspective ? eye : s;
  const Point ray = camera->perspective ? difference(s, eye) : eye;
  // Where the volumes that the edges span with the ray have one sign.
  std::array<Rational, 3> weights;
  std::array<Point, 3> from_start;
  for (std::size_t k = 0; k < 3; ++k) {
    from_start[k] = difference(
        {step * corners[k].x, step * corners[k].y, step * corners[k].z}, start);
  }
  Rational total = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    weights[k] =
        dot(cross(from_start[(k + 1) % 3], from_start[(k + 2) % 3]), ray);
    total += weights[k];
  }
  const auto channel = [&](std::uint8_t Rgb::*of) {
    Rational sum = 0;
    for (std::size_t k = 0; k < 3; ++k)
      sum += weights[k] * Rational(colors[k].*of);
    return sum / total;
  };
  return rounded_color({channel(&Rgb::r), channel(&Rgb::g), channel(&Rgb::b)});
}

Rgb moved_color(const Assembly& assembly, const Placement& placement,
                const Camera& camera, PolygonId id, std::int32_t i,
                std::int32_t j, Shading shading) {
  const Occurrence& here = occurrence_of(assembly, id);
  const Scene& scene = assembly.model(here.model).scene;
  const PolygonId polygon = id - here.first_polygon;
  const auto colors = scene.corner_colors(polygon);
  if (shading == Shading::kFlat || colors.empty()) return scene.color(polygon);
  if (std::adjacent_find(colors.begin(), colors.end(), std::not_equal_to<>()) ==
      colors.end()) {
    return colors.front();
  }
  const auto o =
      static_cast<std::size_t>(&here - assembly.occurrences().data());
  std::vector<Point> corners;
  for (const VertexId v : scene.corners(polygon)) {
    corners.push_back(
        moved(to_point(scene.point(v)), *placement.to_world()[o]));
  }
  return gouraud_color(corners, colors, camera, i, j);
}

/// Colours what shows caps, whose ids begin at `count`.
void color_caps(std::size_t count, const ImageOptions& options,
                Rendering& image) {
  for (std::int32_t j = 0; j < image.items.height_px; ++j) {
    for (std::int32_t i = 0; i < image.items.width_px; ++i) {
      const PolygonId item = image.items.at(i, j);
      if (item == kBackground || static_cast<std::size_t>(item) < count)
        continue;
      image.colors.at(i, j) = cap_color_at_sample(
          options, cap_item(static_cast<std::size_t>(item) - count), i, j, 1);
    }
  }
}

/// The occurrences that are there, by their first ids.
std::vector<std::size_t> in_order(const Assembly& assembly,
                                  const Placement& placement) {
  std::vector<std::size_t> order;
  for (std::size_t o = 0; o < assembly.occurrences().size(); ++o) {
    if (placement.to_world()[o]) order.push_back(o);
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) {
                     return assembly.occurrences()[a].first_polygon <
                            assembly.occurrences()[b].first_polygon;
                   });
  return order;
}

}  // namespace

Result<Done> check_free(const Assembly& assembly) {
  for (std::size_t m = 0; m < assembly.models().size(); ++m) {
    const Model& model = assembly.models()[m];
    for (std::size_t k = 0; k < model.objects.size(); ++k) {
      const auto count = static_cast<PolygonId>(model.scene.polygon_count());
      for (PolygonId id = 0; id < count; ++id) {
        if (!carved(whole(model.scene, id), model.objects[k].region).is_cut)
          continue;
        return Error{ErrorCode::kOutOfRange,
                     "the region of object " + std::to_string(k) +
                         " of model " + std::to_string(m) +
                         " is not free: polygon " + std::to_string(id) +
                         " reaches into it; move it, or ask to cut",
                     id};
      }
    }
  }
  return Done{};
}

MovedPolygons moved_polygons(const Assembly& assembly,
                             const Placement& placement) {
  MovedPolygons result;
  result.planes.resize(assembly.polygon_count());
  for (const std::size_t o : in_order(assembly, placement)) {
    const Occurrence& here = assembly.occurrences()[o];
    const Model& model = assembly.model(here.model);
    const ObjectMap& map = *placement.to_world()[o];
    const auto count = static_cast<PolygonId>(model.scene.polygon_count());
    for (PolygonId polygon = 0; polygon < count; ++polygon) {
      const PolygonId id = here.first_polygon + polygon;
      for (Fragment fragment : left_of(model, polygon)) {
        fragment.source = id;
        for (Point& p : fragment.vertices) p = moved(p, map);
        // A reflection turns corners round: backwards they face outwards.
        if (orientation_of(map) < 0)
          std::reverse(fragment.vertices.begin(), fragment.vertices.end());
        result.planes[static_cast<std::size_t>(id)] =
            plane_of(fragment.vertices);
        result.fragments.push_back(std::move(fragment));
      }
    }
  }
  return result;
}

Rendering render_moving(const Assembly& assembly, const Placement& placement,
                        const Camera& camera, const ImageOptions& options) {
  MovedPolygons moved = moved_polygons(assembly, placement);
  const std::vector<Fragment> of_caps = moved.fragments;
  const BspTree tree = build(moved.planes, std::move(moved.fragments), {});
  const Projection projection = projection_of(camera);
  DynamicScreen screen(camera->width_px, camera->height_px);
  Rendering image;
  image.items = ItemImage(camera->width_px, camera->height_px, kBackground);
  image.colors =
      ColorImage(camera->width_px, camera->height_px, options.background);
  front_to_back(tree, camera, [&](const Node&, const Fragment& fragment) {
    const Plane& plane =
        moved.planes[static_cast<std::size_t>(fragment.source)];
    if (options.cull && side_of_eye(plane, camera) == Side::kNegative)
      return true;
    if (!is_there(plane, options)) return true;
    const auto left = clipped(fragment, options);
    if (!left) return true;
    ++image.fragments_displayed;
    for (const auto& [line, span] : scan_convert(*left, projection)) {
      screen.merge(line, {span}, [&, row = line](Span lit) {
        for (std::int32_t i = lit.first; i <= lit.last; ++i) {
          image.items.at(i, row) = fragment.source;
          image.colors.at(i, row) =
              moved_color(assembly, placement, camera, fragment.source, i, row,
                          options.shading);
          ++image.pixels_painted;
        }
      });
    }
    return !screen.full();
  });
  add_caps_of(of_caps, assembly.polygon_count(), camera, options, image.items);
  color_caps(assembly.polygon_count(), options, image);
  return image;
}

Result<FlatScene> flat_scene(const Assembly& assembly,
                             const Placement& placement, const Camera& camera) {
  const int finest = flat_shift(placement);
  bool has_colors = false;
  for (const Occurrence& here : assembly.occurrences()) {
    has_colors = has_colors ||
                 !assembly.model(here.model).scene.data().corner_colors.empty();
  }
  const Rational scale = power_of_two(finest);
  const Rational limit = power_of_two(kFlatGrid - 1);
  SceneData data;
  data.unit = assembly.models()[0].scene.unit();
  data.grid_bits = kFlatGrid;
  std::vector<PolygonId> ids;
  std::vector<std::uint32_t> of_models;
  for (const std::size_t o : in_order(assembly, placement)) {
    const Occurrence& here = assembly.occurrences()[o];
    const Scene& scene = assembly.model(here.model).scene;
    const ObjectMap& map = *placement.to_world()[o];
    for (PolygonId id = 0; id < static_cast<PolygonId>(scene.polygon_count());
         ++id) {
      std::vector<std::size_t> order;
      for (std::size_t k = 0; k < scene.corners(id).size(); ++k)
        order.push_back(k);
      if (orientation_of(map) < 0) std::reverse(order.begin(), order.end());
      for (const std::size_t k : order) {
        const Point p = moved(to_point(scene.point(scene.corners(id)[k])), map);
        GridPoint on_grid;
        const auto put = [&](const Rational& value, std::int64_t& to) {
          const Rational fine = scale * value;
          if (!(-limit <= fine && fine < limit)) return false;
          to = fine.to_int64();
          return true;
        };
        if (!put(p.x, on_grid.x) || !put(p.y, on_grid.y) ||
            !put(p.z, on_grid.z)) {
          return off_flat_grid();
        }
        data.corners.push_back(static_cast<VertexId>(data.vertices.size()));
        of_models.push_back(static_cast<std::uint32_t>(
            scene.data().first_corner[static_cast<std::size_t>(id)] + k));
        data.vertices.push_back(on_grid);
        if (!has_colors) continue;
        const auto colors = scene.corner_colors(id);
        data.corner_colors.push_back(colors.empty() ? scene.color(id)
                                                    : colors[k]);
      }
      data.first_corner.push_back(
          static_cast<std::uint32_t>(data.corners.size()));
      data.colors.push_back(scene.color(id));
      ids.push_back(here.first_polygon + id);
    }
  }
  Result<Scene> scene = make_scene(std::move(data));
  if (!scene) return scene.error();
  const Result<Camera> fine = flat_camera(camera, finest);
  if (!fine) return fine.error();
  return FlatScene{*std::move(scene), *fine, std::move(ids),
                   std::move(of_models), finest};
}

}  // namespace halfspace::ref
