#include <algorithm>
#include <map>
#include <random>
#include <set>
#include <tuple>
#include <vector>

#include "adapters/both.hpp"
#include "adapters/scenes.hpp"
#include "definition/definition.hpp"
#include "generate/random_scenes.hpp"
#include "halfspace/fast/area_image.hpp"
#include "halfspace/fast/display_tree.hpp"
#include "halfspace/fast/visible_map.hpp"
#include "halfspace/ref/area_image.hpp"
#include "halfspace/ref/visible_map.hpp"
#include "laws/law.hpp"
#include "laws/map/map_arcs.hpp"

/// Laws of the visible map (S7). Maps of both implementations are compared as
/// lists of arcs between exact points.
namespace halfspace {
namespace {

using namespace map_arcs;

constexpr int kMaps = 150;

struct RefMap {
  static Arcs arcs_of(const SceneFile& view, const MapOptions& options,
                      const BuildOptions&) {
    return exact_arcs(ref::visible_map(view.scene, *view.camera, options));
  }
};

/// What a map says of itself beside its arcs: loops, regions, order.
void expect_consistent(const fast::VisibleMap& map,
                       const std::vector<Place>& places) {
  HALFSPACE_LAW(std::is_sorted(places.begin(), places.end()));
  HALFSPACE_LAW(std::adjacent_find(places.begin(), places.end()) ==
                places.end());
  for (std::size_t v = 0; v < places.size(); ++v) {
    HALFSPACE_LAW(map.vertices[v].x == places[v].x.convert_to<double>());
    HALFSPACE_LAW(map.vertices[v].y == places[v].y.convert_to<double>());
  }
  // Every side of an arc that is a region's is a step of one of its loops.
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> region_of_step;
  std::size_t loops = 0;
  for (std::size_t r = 0; r < map.regions.size(); ++r) {
    const fast::MapRegion& region = map.regions[r];
    HALFSPACE_LAW(region.loop_count >= 1);
    HALFSPACE_LAW(region.first_loop == static_cast<std::int32_t>(loops));
    for (std::int32_t l = 0; l < region.loop_count; ++l, ++loops) {
      const std::size_t first = map.first_corner[loops];
      const std::size_t end = map.first_corner[loops + 1];
      Fraction twice = 0;
      for (std::size_t k = first; k < end; ++k) {
        const std::int32_t p = map.corners[k];
        const std::int32_t q = map.corners[k + 1 == end ? first : k + 1];
        HALFSPACE_LAW(map.corners[first] <= p);
        const Place& f = places[static_cast<std::size_t>(p)];
        const Place& g = places[static_cast<std::size_t>(q)];
        twice += f.x * g.y - f.y * g.x;
        HALFSPACE_LAW(
            region_of_step.emplace(std::pair{p, q}, static_cast<int>(r))
                .second);
      }
      // The first loop is the outer one.
      HALFSPACE_LAW(l == 0 ? twice > 0 : twice < 0);
    }
  }
  std::size_t sides = 0;
  const auto side = [&](std::int32_t p, std::int32_t q, std::int32_t region) {
    const auto found = region_of_step.find({p, q});
    HALFSPACE_LAW((found == region_of_step.end()) == (region < 0));
    if (region < 0) return;
    ++sides;
    HALFSPACE_LAW(found->second == region);
  };
  for (const fast::MapArc& arc : map.arcs) {
    side(arc.from, arc.to, arc.right);
    side(arc.to, arc.from, arc.left);
  }
  HALFSPACE_LAW(sides == region_of_step.size());
}

struct FastMap {
  static Arcs arcs_of(const SceneFile& view, const MapOptions& options,
                      const BuildOptions& build) {
    const auto tree = fast::build(view.scene, build);
    const auto map = fast::visible_map(view.scene, tree, *view.camera, options);
    HALFSPACE_LAW(map.has_value());
    expect_consistent(*map, exact_places(*map));
    // Leaves are divided when the map comes to them.
    fast::DisplayTreeOptions leaves;
    leaves.leaf_size = 1 + view.scene.polygon_count() / 2;
    leaves.threads = 1;
    const auto same = fast::visible_map(
        view.scene, fast::build_display_tree(view.scene, leaves), *view.camera,
        options);
    HALFSPACE_LAW(same.has_value());
    HALFSPACE_LAW(same->arcs == map->arcs && same->regions == map->regions &&
                  same->corners == map->corners);
    return exact_arcs(*map);
  }
};

template <class Impl>
class S7Map : public ::testing::Test {};
using MapImplementations = ::testing::Types<RefMap, FastMap>;
TYPED_TEST_SUITE(S7Map, MapImplementations);

MapOptions options_of(const SceneFile& view) { return {view.options.cull, {}}; }

template <class Impl>
Arcs map_of(const SceneFile& view) {
  return Impl::arcs_of(view, options_of(view), {});
}

Fraction area_of(const Arcs& arcs, std::int32_t key) {
  Fraction twice = 0;
  for (const Arc& arc : arcs) {
    const Fraction part = arc.from.x * arc.to.y - arc.from.y * arc.to.x;
    if (arc.right == key) twice += part;
    if (arc.left == key) twice -= part;
  }
  return twice / 2;
}

std::map<std::int32_t, Fraction> areas_of(const Arcs& arcs) {
  std::map<std::int32_t, Fraction> areas;
  for (const Arc& arc : arcs) {
    for (const std::int32_t key : {arc.left, arc.right})
      areas.try_emplace(key, 0);
  }
  for (auto& [key, area] : areas) area = area_of(arcs, key);
  return areas;
}

TYPED_TEST(S7Map, L1SamplesLieInTheRegionOfTheirItem) {
  std::size_t several = 0;
  law::for_all_views(
      [&](const SceneFile& view) {
        const Arcs arcs = map_of<TypeParam>(view);
        const Image image =
            oracle::zbuffer(view.scene, *view.camera, view.options);
        for (std::int32_t j = 0; j < image.items.height_px; ++j) {
          for (std::int32_t i = 0; i < image.items.width_px; ++i)
            HALFSPACE_LAW(key_at(arcs, i, j) == image.items.at(i, j));
        }
        if (arcs.size() > 12) ++several;
      },
      kMaps);
  EXPECT_GT(several, 20u);
}

int turn(const Place& p, const Place& q, const Place& r) {
  const Fraction area = (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
  return area > 0 ? 1 : area < 0 ? -1 : 0;
}

/// Whether a point of an arc, not one of its ends, is on another arc.
bool meet_within(const Arc& f, const Arc& g) {
  const int from = turn(f.from, f.to, g.from);
  const int to = turn(f.from, f.to, g.to);
  if (from == 0 && to == 0) {
    const auto within = [](const Arc& a, const Place& p) {
      return a.from < p && p < a.to;
    };
    return f == g || within(f, g.from) || within(f, g.to) ||
           within(g, f.from) || within(g, f.to);
  }
  if (from * to > 0) return false;
  const int first = turn(g.from, g.to, f.from);
  const int second = turn(g.from, g.to, f.to);
  if (first * second > 0) return false;
  // They meet in a point: an end of both, or not.
  return !(f.from == g.from || f.from == g.to || f.to == g.from ||
           f.to == g.to);
}

TYPED_TEST(S7Map, L2ArcsMeetInVerticesAlone) {
  law::for_all_views(
      [](const SceneFile& view) {
        const Arcs arcs = map_of<TypeParam>(view);
        for (std::size_t f = 0; f < arcs.size(); ++f) {
          HALFSPACE_LAW(arcs[f].from < arcs[f].to);
          for (std::size_t g = 0; g < f; ++g)
            HALFSPACE_LAW(!meet_within(arcs[f], arcs[g]));
        }
      },
      kMaps);
}

TYPED_TEST(S7Map, L3NothingIsThereForNothing) {
  law::for_all_views(
      [](const SceneFile& view) {
        const Arcs arcs = map_of<TypeParam>(view);
        std::map<Place, std::vector<const Arc*>> ending;
        for (const Arc& arc : arcs) {
          HALFSPACE_LAW(arc.left != arc.right);
          ending[arc.from].push_back(&arc);
          ending[arc.to].push_back(&arc);
        }
        for (const auto& [place, ends] : ending) {
          HALFSPACE_LAW(ends.size() >= 2);
          if (ends.size() > 2) continue;
          const auto other = [&place = place](const Arc& arc) {
            return arc.from == place ? arc.to : arc.from;
          };
          HALFSPACE_LAW(turn(other(*ends[0]), place, other(*ends[1])) != 0);
        }
      },
      kMaps);
}

TYPED_TEST(S7Map, L4AreasAddUpToTheImage) {
  law::for_all_views(
      [](const SceneFile& view) {
        const Fraction all = Fraction((*view.camera)->width_px) *
                             Fraction((*view.camera)->height_px);
        Fraction sum = 0;
        for (const auto& [key, area] : areas_of(map_of<TypeParam>(view))) {
          if (key == kOutsideKey) {
            HALFSPACE_LAW(area == -all);
            continue;
          }
          HALFSPACE_LAW(area > 0);
          sum += area;
        }
        HALFSPACE_LAW(sum == all);
      },
      kMaps);
}

TYPED_TEST(S7Map, L5TheMapDependsOnNeitherTreeNorFirstCorner) {
  law::for_all_views(
      [](const SceneFile& view) {
        const Arcs arcs = map_of<TypeParam>(view);
        BuildOptions build;
        build.rule = RootRule::kFirst;
        HALFSPACE_LAW(TypeParam::arcs_of(view, options_of(view), build) ==
                      arcs);
        SceneData data = view.scene.data();
        for (std::size_t p = 0; p < view.scene.polygon_count(); ++p) {
          std::rotate(data.corners.begin() + data.first_corner[p],
                      data.corners.begin() + data.first_corner[p] + 1,
                      data.corners.begin() + data.first_corner[p + 1]);
        }
        data.corner_colors.clear();
        SceneFile turned = view;
        turned.scene = *make_scene(std::move(data));
        HALFSPACE_LAW(map_of<TypeParam>(turned) == arcs);
      },
      kMaps);
}

TYPED_TEST(S7Map, L6JoinedKeysHaveTheSumOfTheAreas) {
  law::for_all_views(
      [](const SceneFile& view) {
        MapOptions joined = options_of(view);
        for (std::size_t p = 0; p < view.scene.polygon_count(); ++p)
          joined.keys.push_back(static_cast<std::int32_t>(p % 2));
        std::map<std::int32_t, Fraction> sums;
        for (const auto& [key, area] : areas_of(map_of<TypeParam>(view)))
          sums[key < 0 ? key : key % 2] += area;
        HALFSPACE_LAW(areas_of(TypeParam::arcs_of(view, joined, {})) == sums);
      },
      kMaps);
}

TEST(S7MapAgree, RefAndFastGiveTheSameMap) {
  law::for_all_views(
      [](const SceneFile& view) {
        MapOptions options = options_of(view);
        HALFSPACE_LAW(FastMap::arcs_of(view, options, {}) ==
                      RefMap::arcs_of(view, options, {}));
        options.keys.assign(view.scene.polygon_count(), 0);
        HALFSPACE_LAW(FastMap::arcs_of(view, options, {}) ==
                      RefMap::arcs_of(view, options, {}));
      },
      kMaps);
}

/// Some triangles between rays from one corner, which is seen farthest to the
/// left, in any order: the hole that they are of the background passes that
/// corner several times.
SceneFile triangles_round_a_corner(agree::Draws& draws) {
  std::vector<std::int64_t> rays = {0, 1, 2, 3};
  std::shuffle(rays.begin(), rays.end(), std::mt19937_64(draws.next()));
  rays.resize(static_cast<std::size_t>(draws.from_to(2, 4)));
  SceneData data;
  for (const std::int64_t k : rays) {
    const auto first = static_cast<VertexId>(data.vertices.size());
    const std::int64_t a = draws.from_to(1, 3);
    const std::int64_t b = draws.from_to(1, 3);
    data.vertices.insert(data.vertices.end(), {GridPoint{0, 0, 0},
                                               {4 * a, (6 * k - 9) * a, 0},
                                               {4 * b, (6 * k - 6) * b, 0}});
    const auto turn = static_cast<VertexId>(draws.from_to(0, 2));
    for (VertexId v = 0; v < 3; ++v)
      data.corners.push_back(first + (v + turn) % 3);
    data.first_corner.push_back(static_cast<std::uint32_t>(first) + 3);
    data.colors.push_back({1, 2, 3});
  }
  CameraData camera;
  camera.perspective = false;
  camera.eye = {0, 0, 256};
  camera.s0 = {-256 * 8, -256 * 32, 0};
  camera.sx = {256, 0, 0};
  camera.sy = {0, 256, 0};
  camera.width_px = 64;
  camera.height_px = 64;
  SceneFile view;
  view.scene = *make_scene(std::move(data));
  view.camera = *make_camera(camera, view.scene.grid_bits());
  return view;
}

TEST(S7MapAgree, ALoopBeginsAtItsFirstVertexSoThatItIsLeast) {
  std::size_t passed_twice = 0;
  law::check(kMaps, [&] {
    agree::Draws draws(*rc::gen::arbitrary<std::uint64_t>());
    const SceneFile view = triangles_round_a_corner(draws);
    const auto tree = fast::build(view.scene, {});
    const auto map = fast::visible_map(view.scene, tree, *view.camera, {});
    HALFSPACE_LAW(map.has_value());
    for (std::size_t l = 0; l + 1 < map->first_corner.size(); ++l) {
      const std::vector<std::int32_t> loop(
          map->corners.begin() + map->first_corner[l],
          map->corners.begin() + map->first_corner[l + 1]);
      for (std::size_t k = 1; k < loop.size(); ++k) {
        std::vector<std::int32_t> turned = loop;
        std::rotate(turned.begin(),
                    turned.begin() + static_cast<std::ptrdiff_t>(k),
                    turned.end());
        HALFSPACE_LAW(loop <= turned);
        if (loop[k] == loop[0]) ++passed_twice;
      }
    }
  });
  EXPECT_GT(passed_twice, 50u);
}

/// The area that a key has in a pixel, and its first moments.
struct PixelMoments {
  Fraction area = 0, x = 0, y = 0;
};

/// Adds the moments of the triangle, negative if it turns the other way.
void add_triangle(const Place& p, const Place& q, const Place& r,
                  PixelMoments& sum) {
  const Fraction area =
      ((q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x)) / 2;
  sum.area += area;
  sum.x += area * (p.x + q.x + r.x) / 3;
  sum.y += area * (p.y + q.y + r.y) / 3;
}

/// The part of a polygon where sign (coordinate - at) >= 0 (Sutherland and
/// Hodgman).
std::vector<Place> clipped(const std::vector<Place>& polygon,
                           Fraction Place::*of, std::int32_t at, int side) {
  std::vector<Place> result;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Place& p = polygon[k];
    const Place& q = polygon[(k + 1) % polygon.size()];
    const Fraction f = side * (p.*of - at);
    const Fraction g = side * (q.*of - at);
    if (f >= 0) result.push_back(p);
    if ((f < 0) == (g < 0)) continue;
    const Fraction t = f / (f - g);
    result.push_back({p.x + t * (q.x - p.x), p.y + t * (q.y - p.y)});
  }
  return result;
}

/// The moments of a key in pixel (i, j): of the triangles from the pixel's own
/// corner over all arcs, each clipped to the pixel.
PixelMoments moments_in(const Arcs& arcs, std::int32_t key, std::int32_t i,
                        std::int32_t j) {
  PixelMoments sum;
  const Place corner = {Fraction(i), Fraction(j)};
  for (const Arc& arc : arcs) {
    if ((arc.left == key) == (arc.right == key)) continue;
    const Fraction count = arc.right == key ? 1 : -1;
    std::vector<Place> part = {corner, arc.from, arc.to};
    for (const auto of : {&Place::x, &Place::y}) {
      const std::int32_t at = of == &Place::x ? i : j;
      part = clipped(part, of, at, 1);
      part = clipped(part, of, at + 1, -1);
    }
    PixelMoments own;
    for (std::size_t k = 2; k < part.size(); ++k)
      add_triangle(part[0], part[k - 1], part[k], own);
    sum.area += count * own.area;
    sum.x += count * own.x;
    sum.y += count * own.y;
  }
  return sum;
}

/// A channel of a polygon's colour at an image point (S5.4), not rounded.
Fraction value_at(const SceneFile& view, std::int32_t id, const Place& at,
                  std::uint8_t Rgb::*channel) {
  if (id == kBackground) return view.options.background.*channel;
  const auto colors = view.scene.corner_colors(id);
  if (view.options.shading == Shading::kFlat || colors.empty())
    return view.scene.color(id).*channel;
  if (std::all_of(colors.begin(), colors.end(),
                  [&](const Rgb& c) { return c == colors.front(); }))
    return colors.front().*channel;
  const definition::Projection seen = definition::project(
      definition::facet_of(view.scene, definition::whole(view.scene, id)),
      *view.camera, false);
  Fraction weights = 0;
  Fraction sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const definition::Affine& f = seen.edges[k];
    const Fraction weight =
        Fraction(f.c) + at.x * Fraction(f.x) + at.y * Fraction(f.y);
    // The edge that leaves corner k is opposite corner k + 2.
    weights += weight;
    sum += weight * int{colors[(k + 2) % 3].*channel};
  }
  return sum / weights;
}

std::uint8_t rounded_level(const Fraction& value) {
  const Integer twice = 2 * numerator(value) + denominator(value);
  return static_cast<std::uint8_t>(twice / (2 * denominator(value)));
}

ColorImage area_image(const RefMap*, const SceneFile& view) {
  return ref::render_area(view.scene, *view.camera, view.options);
}
/// From one to three.
int threads_of(const SceneFile& view) {
  return 1 + static_cast<int>(view.scene.polygon_count() % 3);
}
ColorImage area_image(const FastMap*, const SceneFile& view) {
  return fast::render_area(view.scene, fast::build(view.scene, {}),
                           *view.camera, view.options, threads_of(view))
      .colors;
}

TYPED_TEST(S7Map, L7APixelIsTheIntegralOfWhatIsSeenInIt) {
  std::size_t mixed = 0;
  law::for_all_views(
      [&](const SceneFile& view) {
        const Arcs arcs = map_of<TypeParam>(view);
        const ColorImage image =
            area_image(static_cast<const TypeParam*>(nullptr), view);
        std::set<std::int32_t> keys;
        for (const Arc& arc : arcs) keys.insert({arc.left, arc.right});
        keys.erase(kOutsideKey);
        for (std::int32_t j = 0; j < image.height_px; ++j) {
          for (std::int32_t i = 0; i < image.width_px; ++i) {
            Fraction all = 0;
            std::map<std::int32_t, PixelMoments> seen;
            for (const std::int32_t key : keys) {
              const PixelMoments own = moments_in(arcs, key, i, j);
              HALFSPACE_LAW(own.area >= 0);
              all += own.area;
              if (own.area > 0) seen.emplace(key, own);
            }
            HALFSPACE_LAW(all == 1);
            if (seen.size() > 2) ++mixed;
            for (const auto channel : {&Rgb::r, &Rgb::g, &Rgb::b}) {
              Fraction sum = 0;
              for (const auto& [key, own] : seen) {
                const Place centroid = {own.x / own.area, own.y / own.area};
                sum += own.area * value_at(view, key, centroid, channel);
              }
              HALFSPACE_LAW(image.at(i, j).*channel == rounded_level(sum));
            }
          }
        }
      },
      kMaps);
  EXPECT_GT(mixed, 100u);
}

}  // namespace
}  // namespace halfspace
