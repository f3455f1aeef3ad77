#include <algorithm>
#include <array>
#include <set>

#include "adapters/both.hpp"
#include "adapters/scenes.hpp"
#include "definition/definition.hpp"
#include "generate/shapes.hpp"
#include "laws/changed_views.hpp"
#include "laws/law.hpp"

namespace halfspace {
namespace {

template <class Impl>
class S5Symmetry : public ::testing::Test {};
TYPED_TEST_SUITE(S5Symmetry, Implementations);

/// Number of views for laws that make several pictures of each.
constexpr int kFewerViews = 150;

/// An exchange of axes, some of them turned over.
struct AxisMap {
  std::array<std::size_t, 3> from;
  std::array<int, 3> sign;

  template <class Vector>
  Vector operator()(const Vector& v) const {
    const decltype(v.x) old[] = {v.x, v.y, v.z};
    return {sign[0] * old[from[0]], sign[1] * old[from[1]],
            sign[2] * old[from[2]]};
  }
  /// Whether left hands become right hands.
  bool is_reflection() const {
    const bool even = (from[0] + 1) % 3 == from[1];
    return (sign[0] * sign[1] * sign[2] < 0) == even;
  }
};

/// All 48 of them, by number.
AxisMap axis_map(std::size_t number) {
  AxisMap map{{0, 1, 2}, {1, 1, 1}};
  for (std::size_t k = number / 8; k > 0; --k)
    std::next_permutation(map.from.begin(), map.from.end());
  for (std::size_t k = 0; k < 3; ++k)
    map.sign[k] = (number >> k & 1u) != 0 ? -1 : 1;
  return map;
}

/// Whether both are the same pixel for pixel.
void expect_same(const Image& image, const Image& other) {
  HALFSPACE_LAW(other.items == image.items);
  HALFSPACE_LAW(other.colors == image.colors);
  HALFSPACE_LAW(other.pixels_painted == image.pixels_painted);
}

/// The view as the map has it; nothing if a coordinate leaves the grid.
std::optional<SceneFile> mapped(const SceneFile& view, const AxisMap& map) {
  SceneData scene = view.scene.data();
  for (GridPoint& p : scene.vertices) p = map(p);
  auto made = make_scene(std::move(scene));
  if (!made) return std::nullopt;
  CameraData camera = view.camera->data();
  for (LatticeVector* v : {&camera.eye, &camera.s0, &camera.sx, &camera.sy})
    *v = map(*v);
  return with_camera(
      with_scene(view, map.is_reflection() ? reversed(*made) : *made), camera);
}

TYPED_TEST(S5Symmetry, L15ExchangedAndTurnedAxesChangeNoPixel) {
  std::set<std::size_t> met;
  std::size_t number = 0;
  law::for_all_views(
      [&](const SceneFile& view) {
        const Image image = picture<TypeParam>(view);
        for (int k = 0; k < 5; ++k) {
          number = (number + 11) % 48;
          const auto other = mapped(view, axis_map(number));
          if (!other) continue;
          expect_same(image, picture<TypeParam>(*other));
          met.insert(number);
        }
      },
      kFewerViews);
  EXPECT_EQ(met.size(), 48u);
}

TYPED_TEST(S5Symmetry, L16ScalingByAPowerOfTwoChangesNoPixel) {
  std::set<int> grids;
  std::size_t scaled = 0;
  law::for_all_views(
      [&](const SceneFile& view) {
        const Image image = picture<TypeParam>(view);
        for (const int bits : {1, 9, 20, 40}) {
          SceneData scene = view.scene.data();
          const std::int64_t room = (std::int64_t{1} << 53) >> bits;
          bool fits = true;
          for (GridPoint& p : scene.vertices) {
            fits = fits && std::max({std::abs(p.x), std::abs(p.y),
                                     std::abs(p.z)}) < room;
            if (!fits) break;
            p = {p.x << bits, p.y << bits, p.z << bits};
          }
          if (!fits) continue;
          scene.grid_bits =
              std::max(scene.grid_bits, grid_bits_for(scene.vertices));
          CameraData camera = view.camera->data();
          for (LatticeVector* v :
               {&camera.eye, &camera.s0, &camera.sx, &camera.sy})
            *v = {v->x << bits, v->y << bits, v->z << bits};
          if (!make_camera(camera, scene.grid_bits)) continue;
          grids.insert(scene.grid_bits);
          const SceneFile other = with_camera(
              with_scene(view, *make_scene(std::move(scene))), camera);
          expect_same(image, picture<TypeParam>(other));
          ++scaled;
        }
      },
      kFewerViews);
  EXPECT_EQ(grids.size(), 3u);
  EXPECT_GT(scaled, 200u);
}

/// The scene with the corners of each polygon from another one on.
Scene rotated(const Scene& scene) {
  SceneData data = scene.data();
  for (std::size_t p = 0; p < scene.polygon_count(); ++p) {
    const auto first = static_cast<std::ptrdiff_t>(data.first_corner[p]);
    const auto end = static_cast<std::ptrdiff_t>(data.first_corner[p + 1]);
    const std::ptrdiff_t by =
        1 + static_cast<std::ptrdiff_t>(p) % (end - first - 1);
    const auto rotate = [&](auto& list) {
      std::rotate(list.begin() + first, list.begin() + first + by,
                  list.begin() + end);
    };
    rotate(data.corners);
    if (!data.corner_colors.empty()) rotate(data.corner_colors);
  }
  return *make_scene(std::move(data));
}

TYPED_TEST(S5Symmetry, L17CornersMayBeListedFromAnyOneAndBackwards) {
  law::for_all_views(
      [&](const SceneFile& view) {
        expect_same(picture<TypeParam>(view),
                    picture<TypeParam>(with_scene(view, rotated(view.scene))));
        SceneFile seen = view;
        seen.options.cull = false;
        const Image image = picture<TypeParam>(seen);
        expect_same(image,
                    picture<TypeParam>(with_scene(seen, reversed(view.scene))));
        expect_same(image, picture<TypeParam>(with_scene(
                               seen, rotated(reversed(view.scene)))));
      },
      kFewerViews);
}

/// The parts of a polygon cut along a line between two of its grid points;
/// itself where there is no such line.
generate::Polygons parts_of(const std::vector<GridPoint>& polygon) {
  const GridPoint& p = polygon[0];
  const GridPoint& q = polygon[1];
  std::vector<GridPoint> ring = polygon;
  std::size_t from = 0;
  if (ring.size() == 3) {
    // A corner to the middle of the edge across, if that is on the grid.
    const GridPoint sum{p.x + q.x, p.y + q.y, p.z + q.z};
    if (sum.x % 2 != 0 || sum.y % 2 != 0 || sum.z % 2 != 0) return {polygon};
    ring.insert(ring.begin() + 1, {sum.x / 2, sum.y / 2, sum.z / 2});
    from = 1;
  }
  std::rotate(ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(from),
              ring.end());
  const std::vector<GridPoint> one(ring.begin(), ring.begin() + 3);
  std::vector<GridPoint> other(ring.begin() + 2, ring.end());
  other.push_back(ring.front());
  if (!generate::is_valid(one) || !generate::is_valid(other)) return {polygon};
  return {one, other};
}

TYPED_TEST(S5Symmetry, L18SplittingPolygonsBeforehandChangesIdsOnly) {
  std::size_t cut = 0;
  law::for_all_views(
      [&](const SceneFile& view) {
        SceneData data;
        data.unit = view.scene.unit();
        data.grid_bits = view.scene.grid_bits();
        std::vector<PolygonId> sources;
        for (const PolygonId id : ids_of(view.scene)) {
          std::vector<GridPoint> polygon;
          for (const VertexId v : view.scene.corners(id))
            polygon.push_back(view.scene.point(v));
          const generate::Polygons parts = parts_of(polygon);
          cut += parts.size() - 1;
          for (const auto& part : parts) {
            for (const GridPoint& p : part) {
              data.corners.push_back(
                  static_cast<VertexId>(data.vertices.size()));
              data.vertices.push_back(p);
            }
            data.first_corner.push_back(
                static_cast<std::uint32_t>(data.corners.size()));
            data.colors.push_back(view.scene.color(id));
            sources.push_back(id);
          }
        }
        SceneFile flat = view;
        flat.options.shading = Shading::kFlat;
        const Image image = picture<TypeParam>(flat);
        Image parts =
            picture<TypeParam>(with_scene(flat, *make_scene(std::move(data))));
        for (PolygonId& id : parts.items.pixels) {
          if (id != kBackground) id = sources[static_cast<std::size_t>(id)];
        }
        expect_same(image, parts);
      },
      kFewerViews);
  EXPECT_GT(cut, 300u);
}

/// A machine whose state is the polygons inserted so far; every insertion is
/// followed by a look at the whole.
TYPED_TEST(S5Symmetry, L19AfterEveryInsertionTheImageIsOfWhatIsThere) {
  std::size_t insertions = 0;
  law::for_all_views(
      [&](const SceneFile& view) {
        auto order = ids_of(view.scene);
        std::stable_sort(order.begin(), order.end(),
                         [&](PolygonId a, PolygonId b) {
                           return mix(static_cast<std::uint64_t>(a)) <
                                  mix(static_cast<std::uint64_t>(b));
                         });
        auto tree = TypeParam::build(Scene(), {});
        std::vector<PolygonId> there;
        for (const PolygonId id : order) {
          TypeParam::insert(tree, view.scene, id);
          there.insert(std::lower_bound(there.begin(), there.end(), id), id);
          const Image image =
              TypeParam::render(view.scene, tree, *view.camera, view.options);
          auto expected = definition::item_image(chosen(view.scene, there),
                                                 *view.camera, view.options);
          for (PolygonId& seen : expected.pixels) {
            if (seen != kBackground)
              seen = there[static_cast<std::size_t>(seen)];
          }
          HALFSPACE_LAW(image.items == expected);
          HALFSPACE_LAW(TypeParam::stats(tree).fragments -
                            TypeParam::stats(tree).splits ==
                        there.size());
          ++insertions;
        }
      },
      kFewerViews);
  EXPECT_GT(insertions, 500u);
}

}  // namespace
}  // namespace halfspace
