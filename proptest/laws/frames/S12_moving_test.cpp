#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "adapters/both.hpp"
#include "generate/cut_boxes.hpp"
#include "generate/moving_views.hpp"
#include "halfspace/big_integer.hpp"
#include "halfspace/boolean.hpp"
#include "halfspace/fast/display_tree.hpp"
#include "halfspace/fast/image/flat_scene.hpp"
#include "halfspace/fast/image/moving.hpp"
#include "halfspace/fast/render.hpp"
#include "halfspace/ref/moving.hpp"
#include "halfspace/splitmix.hpp"
#include "laws/frames/clipped_views.hpp"
#include "laws/law.hpp"

/// Laws of moving objects (S12).
namespace halfspace {
namespace {

using generate::MovingView;

constexpr int kMovingViews = 900;

std::uint64_t seed_of_moves(const SceneFile& view) {
  std::uint64_t seed = view.scene.data().vertices.size() + 99;
  for (const GridPoint& p : view.scene.data().vertices)
    seed = mix(seed + static_cast<std::uint64_t>(p.x + 3 * p.y + 7 * p.z));
  return seed;
}

ImageOptions plain_options(const SceneFile& view) {
  ImageOptions options = view.options;
  options.clips.clear();
  options.caps = std::nullopt;
  return options;
}

struct RefMoving {
  static Result<Done> check_free(const Assembly& assembly) {
    return ref::check_free(assembly);
  }
  static Result<FlatScene> flat_scene(const Assembly& assembly,
                                      const Placement& placement,
                                      const Camera& camera) {
    return ref::flat_scene(assembly, placement, camera);
  }
  static std::vector<Image> images(const Assembly& assembly,
                                   const Placement& placement,
                                   const Camera& camera,
                                   const ImageOptions& options) {
    auto image = ref::render_moving(assembly, placement, camera, options);
    return {{std::move(image.items), std::move(image.colors),
             image.pixels_painted}};
  }
};

struct FastMoving {
  static Result<Done> check_free(const Assembly& assembly) {
    const auto trees =
        fast::build_moving_trees(assembly, fast::InRegion::kError, {});
    if (!trees) return trees.error();
    return Done{};
  }
  static Result<FlatScene> flat_scene(const Assembly& assembly,
                                      const Placement& placement,
                                      const Camera& camera) {
    return fast::flat_scene(assembly, placement, camera);
  }
  static std::vector<Image> images(const Assembly& assembly,
                                   const Placement& placement,
                                   const Camera& camera,
                                   const ImageOptions& options) {
    std::vector<Image> images;
    for (const std::size_t leaf : {1u, 3u, 500u}) {
      fast::DisplayTreeOptions display;
      display.leaf_size = leaf;
      display.threads = 1;
      const auto trees =
          fast::build_moving_trees(assembly, fast::InRegion::kCut, display);
      fast::RenderOptions how;
      how.threads = leaf == 3u ? 2 : 1;
      if (leaf == 500u) how.simd = fast::SimdLevel::kPortable;
      auto image = fast::render_moving(assembly, *trees, placement, camera,
                                       options, how);
      images.push_back({std::move(image.items), std::move(image.colors),
                        image.pixels_painted});
    }
    return images;
  }
};

/// Calls the property for views of which parts move.
void for_all_moving(
    const std::function<void(const SceneFile&, const MovingView&)>& property) {
  std::size_t drawn = 0;
  law::for_all_views(
      [&](const SceneFile& view) {
        const auto moving = generate::moving_view(view, seed_of_moves(view));
        if (!moving) return;
        // Of regions that are interlocked fast makes no tree, which it says.
        if (!fast::build_moving_trees(moving->assembly, fast::InRegion::kCut,
                                      {}))
          return;
        ++drawn;
        property(view, *moving);
      },
      kMovingViews);
  // The others do not fit a grid at whose limits they are.
  EXPECT_GT(drawn, static_cast<std::size_t>(law::runs(kMovingViews)) / 2);
}

template <class Impl>
class S12Moving : public ::testing::Test {};
using MovingImplementations = ::testing::Types<RefMoving, FastMoving>;
TYPED_TEST_SUITE(S12Moving, MovingImplementations);

/// The image of the moved polygons as an ordinary scene, by all oracles.
std::optional<Image> flat_image(const MovingView& moving, const Camera& camera,
                                const ImageOptions& options) {
  if (!ref::check_free(moving.assembly)) return std::nullopt;
  const auto flat = ref::flat_scene(moving.assembly, moving.placement, camera);
  if (!flat) return std::nullopt;
  const auto own = flat_options(*flat, options);
  if (!own) return std::nullopt;
  Image image = oracle::zbuffer(flat->scene, flat->camera, *own);
  const auto tree = ref::build(flat->scene, {});
  HALFSPACE_LAW(ref::paint(flat->scene, tree, flat->camera, *own).items ==
                image.items);
  HALFSPACE_LAW(ref::raycast(flat->scene, flat->camera, *own).items ==
                image.items);
  for (PolygonId& item : image.items.pixels)
    item = moved_item(moving.assembly, *flat, item);
  return image;
}

TYPED_TEST(S12Moving, L1TheImageIsThatOfTheMovedPolygons) {
  std::size_t compared = 0;
  std::size_t objects_seen = 0;
  std::size_t slanted = 0;
  for_all_moving([&](const SceneFile& view, const MovingView& moving) {
    const ImageOptions options = plain_options(view);
    const auto expected = flat_image(moving, moving.camera, options);
    if (!expected) return;
    ++compared;
    for (const MovingObject& object : moving.assembly.models()[0].objects)
      slanted += object.region.slanted.empty() ? 0u : 1u;
    const auto own = static_cast<PolygonId>(
        moving.assembly.models()[0].scene.polygon_count());
    objects_seen += static_cast<std::size_t>(std::count_if(
        expected->items.pixels.begin(), expected->items.pixels.end(),
        [own](PolygonId item) { return item >= own; }));
    for (const Image& image : TypeParam::images(
             moving.assembly, moving.placement, moving.camera, options)) {
      HALFSPACE_LAW(image.items == expected->items);
      HALFSPACE_LAW(image.colors == expected->colors);
    }
  });
  EXPECT_GT(compared, 200u);
  EXPECT_GT(slanted, 100u);
  EXPECT_GT(objects_seen, 800u);
}

/// The occurrence of every polygon.
std::vector<std::uint32_t> occurrences_of(const Assembly& assembly) {
  std::vector<std::uint32_t> parts(assembly.polygon_count());
  const auto& all = assembly.occurrences();
  for (std::size_t o = 0; o < all.size(); ++o) {
    const auto count = assembly.model(all[o].model).scene.polygon_count();
    for (std::size_t p = 0; p < count; ++p) {
      parts[static_cast<std::size_t>(all[o].first_polygon) + p] =
          static_cast<std::uint32_t>(o);
    }
  }
  return parts;
}

/// Whether caps can be put there.
bool is_closed(const MovingView& moving) {
  const auto& models = moving.assembly.models();
  return std::all_of(models.begin(), models.end(), [](const Model& model) {
    return bad_edges(model.scene).empty();
  });
}

/// A plane through the middle of where the first object stands, mostly with the
/// eye on the side that is taken away, so that the cap is seen.
ClipPlane plane_through_object(const MovingView& moving, std::uint64_t number) {
  const ObjectMap& map = *moving.pose.maps[0][0];
  const Scene& object = moving.assembly.model(1).scene;
  std::array<Int128, 3> low{}, high{};
  bool is_first = true;
  for (const VertexId v : object.data().corners) {
    const GridPoint& p = object.point(v);
    for (std::size_t k = 0; k < 3; ++k) {
      const Int128 at =
          (Int128{map.m[3 * k]} * p.x + Int128{map.m[3 * k + 1]} * p.y +
           Int128{map.m[3 * k + 2]} * p.z + map.t[k]) >>
          map.shift;
      low[k] = is_first ? at : std::min(low[k], at);
      high[k] = is_first ? at : std::max(high[k], at);
    }
    is_first = false;
  }
  const auto part = [&](std::uint64_t salt) {
    return static_cast<std::int64_t>(mix(number + salt) % 5) - 2;
  };
  ClipPlane plane = {part(31), part(32), part(33), 0};
  if (plane.a == 0 && plane.b == 0 && plane.c == 0) plane.c = 1;
  const std::array<Int128, 3> normal = {plane.a, plane.b, plane.c};
  for (std::size_t k = 0; k < 3; ++k)
    plane.d -= normal[k] * ((low[k] + high[k]) / 2);
  const CameraData& camera = moving.camera.data();
  const Int128 step = camera.perspective ? Int128{1} << kLatticeBits : 0;
  const Int128 at_eye = plane.a * camera.eye.x + plane.b * camera.eye.y +
                        plane.c * camera.eye.z + step * plane.d;
  if (at_eye > 0 && mix(number + 34) % 5 != 0)
    plane = {-plane.a, -plane.b, -plane.c, -plane.d};
  return plane;
}

TYPED_TEST(S12Moving, L6ClipPlanesCutTheMovedSceneAndItsCaps) {
  std::size_t cut = 0, caps = 0, parts = 0, turned = 0;
  const auto compare = [&](const MovingView& moving,
                           const ImageOptions& options) {
    const auto expected = flat_image(moving, moving.camera, options);
    if (!expected) return;
    ImageOptions whole = options;
    whole.clips.clear();
    const auto without = ref::render_moving(moving.assembly, moving.placement,
                                            moving.camera, whole);
    cut += without.items != expected->items;
    const auto first = static_cast<PolygonId>(moving.assembly.polygon_count());
    for (const PolygonId item : expected->items.pixels) {
      if (item < first) continue;
      ++caps;
      parts += item >= first + 16;
    }
    turned += orientation_of(*moving.pose.maps[0][0]) < 0;
    for (const Image& image : TypeParam::images(
             moving.assembly, moving.placement, moving.camera, options)) {
      HALFSPACE_LAW(image.items == expected->items);
      HALFSPACE_LAW(image.colors == expected->colors);
    }
  };
  for_all_moving([&](const SceneFile& view, const MovingView& moving) {
    ImageOptions options = plain_options(view);
    options.clips = clips_of(view, seed_of(view));
    compare(moving, options);
  });
  law::check(kMovingViews / 3, [&] {
    const auto number = *rc::gen::arbitrary<std::uint64_t>();
    const SceneFile view = cut_boxes(number, 3, 16, 12);
    const auto moving = generate::moving_parts(view, number);
    if (!moving || !is_closed(*moving)) return;
    ImageOptions options = view.options;
    options.parts = nullptr;
    options.cull = number % 7 == 0;
    options.caps = CapStyle{{9, 8, 7}, Rgb{1, 250, 3}};
    if (mix(number + 3) % 4 != 0)
      options.clips = {plane_through_object(*moving, number)};
    if (mix(number + 4) % 2 == 0) {
      const auto more = clips_of(view, number);
      options.clips.insert(options.clips.end(), more.begin(), more.end());
    }
    options.clips = *make_clips(options.clips, view.scene.grid_bits());
    if (number % 2 == 0) {
      options.parts =
          told_apart(occurrences_of(moving->assembly), *options.caps);
    }
    compare(*moving, options);
  });
  EXPECT_GT(cut, 200u);
  EXPECT_GT(caps, 300u);
  EXPECT_GT(parts, 100u);
  EXPECT_GT(turned, 50u);
}

TYPED_TEST(S12Moving, L2WhatIsInsideOfRegionsIsCutAway) {
  std::size_t cut = 0;
  for_all_moving([&](const SceneFile& view, const MovingView& moving) {
    const ImageOptions options = plain_options(view);
    const auto expected = ref::render_moving(moving.assembly, moving.placement,
                                             moving.camera, options);
    cut += ref::check_free(moving.assembly) ? 0u : 1u;
    for (const Image& image : TypeParam::images(
             moving.assembly, moving.placement, moving.camera, options)) {
      HALFSPACE_LAW(image.items == expected.items);
      HALFSPACE_LAW(image.colors == expected.colors);
    }
  });
  EXPECT_GT(cut, 30u);
}

TYPED_TEST(S12Moving, L3ARegionIsFreeOrTheFirstPolygonInItIsNamed) {
  std::size_t refused = 0;
  for_all_moving([&](const SceneFile&, const MovingView& moving) {
    const auto expected = ref::check_free(moving.assembly);
    const auto found = TypeParam::check_free(moving.assembly);
    HALFSPACE_LAW(found.has_value() == expected.has_value());
    if (expected) return;
    ++refused;
    HALFSPACE_LAW(found.error().message == expected.error().message);
    HALFSPACE_LAW(found.error().index == expected.error().index);
  });
  EXPECT_GT(refused, 30u);
}

/// The pose with one number of one map changed.
Pose shifted(const Pose& pose, std::size_t axis, Int128 by) {
  Pose result = pose;
  result.maps[0][0]->t[axis] += by;
  return result;
}

using Big = boost::multiprecision::cpp_int;
using BigPoint = std::array<Big, 3>;

BigPoint big(const GridPoint& p) { return {p.x, p.y, p.z}; }

/// Where a point stands, in steps of 2^-shift.
BigPoint place_of(const GridPoint& p, const ObjectMap& map) {
  BigPoint at;
  for (std::size_t k = 0; k < 3; ++k) {
    at[k] = to_big<Big>(map.t[k]) + Big(map.m[3 * k]) * p.x +
            Big(map.m[3 * k + 1]) * p.y + Big(map.m[3 * k + 2]) * p.z;
  }
  return at;
}

/// How a face's value at a place changes with a step along an axis, and what it
/// is there.
std::pair<Big, Big> going_along(std::size_t axis, const RegionFace& face,
                                const BigPoint& at, int shift) {
  const BigPoint p = big(face[0]);
  const BigPoint q = big(face[1]);
  const BigPoint r = big(face[2]);
  BigPoint normal;
  Big value = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t u = (k + 1) % 3;
    const std::size_t v = (k + 2) % 3;
    normal[k] = (q[u] - p[u]) * (r[v] - p[v]) - (q[v] - p[v]) * (r[u] - p[u]);
    value += normal[k] * (at[k] - (p[k] << shift));
  }
  return {normal[axis], value};
}

TYPED_TEST(S12Moving, L4AnObjectStaysStrictlyInItsRegion) {
  std::size_t slanted = 0;
  for_all_moving([&](const SceneFile&, const MovingView& moving) {
    const ObjectMap& map = *moving.pose.maps[0][0];
    const Model& model = moving.assembly.model(1);
    const ObjectRegion& region = moving.assembly.models()[0].objects[0].region;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      // How far the object may go along the axis, in steps of 2^-shift.
      std::optional<Big> room;
      const auto reach = [&](const GridPoint& p, int margin) {
        const auto at = place_of(p, map);
        const auto take = [&](const Big& left) {
          if (!room || left < *room) room = left;
        };
        const std::int64_t high = axis == 0   ? region.high.x
                                  : axis == 1 ? region.high.y
                                              : region.high.z;
        take((Big(high) << map.shift) - at[axis] - margin);
        for (const RegionFace& face : region.slanted) {
          const auto [speed, value] = going_along(axis, face, at, map.shift);
          if (speed < 0) take((value - margin) / -speed);
        }
      };
      for (const VertexId v : model.scene.data().corners)
        reach(model.scene.point(v), 1);
      for (const MovingObject& object : model.objects) {
        for (const GridPoint& p : corners_of(object.region)) reach(p, 0);
      }
      slanted += region.slanted.empty() ? 0u : 1u;
      const auto is_valid = [&](Int128 by) {
        const auto placed =
            make_placement(moving.assembly, shifted(moving.pose, axis, by));
        if (placed) return true;
        HALFSPACE_LAW(placed.error().code == ErrorCode::kOutOfRange);
        return false;
      };
      HALFSPACE_LAW(is_valid(halfspace::to_int128<Big>(*room)));
      HALFSPACE_LAW(!is_valid(halfspace::to_int128<Big>(*room) + 1));
    }
    Pose flat = moving.pose;
    for (std::size_t k = 0; k < 3; ++k) flat.maps[0][0]->m[k] = 0;
    const auto refused = make_placement(moving.assembly, flat);
    HALFSPACE_LAW(!refused && refused.error().code == ErrorCode::kZeroArea);
  });
  EXPECT_GT(slanted, 100u);
}

TYPED_TEST(S12Moving, L5WithoutAnObjectTheOthersStayAsTheyAre) {
  for_all_moving([&](const SceneFile& view, const MovingView& moving) {
    const ImageOptions options = plain_options(view);
    Pose pose = moving.pose;
    pose.maps[0][0].reset();
    const auto placement = make_placement(moving.assembly, pose);
    HALFSPACE_LAW(placement.has_value());
    const auto with = TypeParam::images(moving.assembly, moving.placement,
                                        moving.camera, options)[0];
    const auto without = TypeParam::images(moving.assembly, *placement,
                                           moving.camera, options)[0];
    // Its polygons, and those in it, follow each other.
    const auto& all = moving.assembly.occurrences();
    const PolygonId first = all[1].first_polygon;
    const auto end =
        static_cast<PolygonId>(static_cast<std::size_t>(first) +
                               moving.assembly.model(1).scene.polygon_count() +
                               moving.assembly.model(2).scene.polygon_count());
    for (std::size_t k = 0; k < with.items.pixels.size(); ++k) {
      const PolygonId before = with.items.pixels[k];
      const PolygonId after = without.items.pixels[k];
      HALFSPACE_LAW(after < first || after >= end);
      if (before < first || before >= end) HALFSPACE_LAW(after == before);
    }
  });
}

/// Whether the flat scene's polygons are the moved ones, with the colours and
/// the corners that they have in their models.
void compare_polygons(const MovingView& moving, const FlatScene& flat) {
  const Assembly& assembly = moving.assembly;
  const auto polygons = ref::moved_polygons(assembly, moving.placement);
  const auto owner = occurrences_of(assembly);
  const ref::Rational scale = Int128{1} << flat.shift;
  HALFSPACE_LAW(flat.ids.size() == polygons.fragments.size());
  HALFSPACE_LAW(flat.ids.size() == flat.scene.polygon_count());
  HALFSPACE_LAW(flat.corners.size() == flat.scene.data().corners.size());
  for (std::size_t p = 0; p < flat.ids.size(); ++p) {
    const auto id = static_cast<PolygonId>(p);
    const ref::Fragment& fragment = polygons.fragments[p];
    HALFSPACE_LAW(fragment.source == flat.ids[p]);
    const Occurrence& here =
        assembly.occurrences()[owner[static_cast<std::size_t>(flat.ids[p])]];
    const Scene& model = assembly.model(here.model).scene;
    const PolygonId own = flat.ids[p] - here.first_polygon;
    const auto corners = flat.scene.corners(id);
    HALFSPACE_LAW(corners.size() == fragment.vertices.size());
    HALFSPACE_LAW(flat.scene.color(id) == model.color(own));
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const ref::Point at = ref::to_point(flat.scene.point(corners[k]));
      const ref::Point& expected = fragment.vertices[k];
      HALFSPACE_LAW(at.x == scale * expected.x && at.y == scale * expected.y &&
                    at.z == scale * expected.z);
      const std::size_t first =
          model.data().first_corner[static_cast<std::size_t>(own)];
      const std::size_t corner =
          flat.corners[flat.scene.data().first_corner[p] + k];
      HALFSPACE_LAW(first <= corner && corner < first + corners.size());
      // The corner of the model stands where that of the flat scene is.
      const GridPoint& q = model.point(model.data().corners[corner]);
      const auto map = *moving.placement.to_world()[static_cast<std::size_t>(
          &here - assembly.occurrences().data())];
      const BigPoint placed = place_of(q, map);
      HALFSPACE_LAW(placed[0] << (flat.shift - map.shift) ==
                    flat.scene.point(corners[k]).x);
      if (!flat.scene.data().corner_colors.empty() &&
          !model.data().corner_colors.empty()) {
        HALFSPACE_LAW(flat.scene.corner_colors(id)[k] ==
                      model.corner_colors(own)[corner - first]);
      }
    }
  }
}

TYPED_TEST(S12Moving, L7TheFlatSceneHasTheMovedPolygonsAndTheirImage) {
  std::size_t compared = 0, refused = 0, turned = 0, cut = 0;
  for_all_moving([&](const SceneFile& view, const MovingView& moving) {
    if (!ref::check_free(moving.assembly)) return;
    const auto flat =
        TypeParam::flat_scene(moving.assembly, moving.placement, moving.camera);
    const auto expected =
        ref::flat_scene(moving.assembly, moving.placement, moving.camera);
    HALFSPACE_LAW(flat.has_value() == expected.has_value());
    if (!flat) {
      ++refused;
      HALFSPACE_LAW(flat.error().code == expected.error().code);
      return;
    }
    ++compared;
    turned += orientation_of(*moving.pose.maps[0][0]) < 0;
    compare_polygons(moving, *flat);
    HALFSPACE_LAW(flat->camera.data() == expected->camera.data());
    ImageOptions options = plain_options(view);
    if (compared % 2 == 0) options.clips = clips_of(view, seed_of(view));
    const auto own = flat_options(*flat, options);
    if (!own) return;
    cut += !own->clips.empty();
    auto image =
        fast::render(flat->scene, fast::build_display_tree(flat->scene, {}),
                     flat->camera, *own);
    for (PolygonId& item : image.items.pixels)
      item = moved_item(moving.assembly, *flat, item);
    const auto moved = ref::render_moving(moving.assembly, moving.placement,
                                          moving.camera, options);
    HALFSPACE_LAW(image.items == moved.items);
    HALFSPACE_LAW(image.colors == moved.colors);
  });
  EXPECT_GT(compared, 200u);
  EXPECT_GT(turned, 50u);
  EXPECT_GT(cut, 50u);
  EXPECT_GT(refused, 0u);
}

}  // namespace
}  // namespace halfspace
