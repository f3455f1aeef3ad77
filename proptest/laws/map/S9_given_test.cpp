#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "adapters/both.hpp"
#include "adapters/scenes.hpp"
#include "halfspace/boolean.hpp"
#include "halfspace/fast/drawing.hpp"
#include "halfspace/ref/drawing.hpp"
#include "halfspace/ref/ray.hpp"
#include "laws/frames/cap_looks.hpp"
#include "laws/frames/clipped_views.hpp"
#include "laws/frames/cut_beforehand.hpp"
#include "laws/frames/cut_scenes.hpp"
#include "laws/law.hpp"
#include "laws/map/points_in_view.hpp"

/// Laws of given lines and points of sections (S9.8).
namespace halfspace::given {
namespace {

using definition::Fraction;
using definition::Integer;

constexpr int kViewsWithPoints = 200;

/// What is seen of given lines and points.
struct Seen {
  /// Ends in the image, the lower one first, and layers.
  std::vector<std::tuple<double, double, double, double, int>> intervals;
  std::vector<bool> points;
  void add(std::array<double, 2> from, std::array<double, 2> to, int layers) {
    if (to < from) std::swap(from, to);
    intervals.emplace_back(from[0], from[1], to[0], to[1], layers);
  }
  friend bool operator==(const Seen&, const Seen&) = default;
};

struct RefGiven {
  static Seen seen(const SceneFile& view, const DrawingOptions& options) {
    const ref::Drawing drawing = ref::draw(view.scene, *view.camera, options);
    Seen seen;
    const auto spot = [](const ref::ImagePoint& p) {
      return std::array{nearest_double(p.x), nearest_double(p.y)};
    };
    for (const ref::DrawnInterval& i : drawing.intervals)
      seen.add(spot(i.from), spot(i.to), i.layers);
    std::sort(seen.intervals.begin(), seen.intervals.end());
    seen.points = drawing.points_visible;
    return seen;
  }
};

struct FastGiven {
  static Seen seen(const SceneFile& view, const DrawingOptions& options) {
    const auto drawing = fast::draw(view.scene, *view.camera, options);
    HALFSPACE_LAW(drawing.has_value());
    Seen seen;
    for (const fast::EdgeInterval& i : drawing->intervals)
      seen.add({i.from.x, i.from.y}, {i.to.x, i.to.y}, i.layers);
    std::sort(seen.intervals.begin(), seen.intervals.end());
    for (const fast::SeenPoint& point : drawing->points)
      seen.points.push_back(point.visible);
    return seen;
  }
};

/// Points at and between corners, and lines between corners.
DrawingOptions given_in(const SceneFile& view) {
  DrawingOptions options;
  options.cull = view.options.cull;
  options.edges = false;
  options.clips = view.options.clips;
  options.caps = view.options.caps.has_value();
  const auto& vertices = view.scene.data().vertices;
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    const GridPoint& p = vertices[k];
    const GridPoint& q = vertices[(k + 1) % vertices.size()];
    const GridPoint& r = vertices[(7 * k + 3) % vertices.size()];
    options.points.push_back(p);
    options.points.push_back(
        {q.x / 2 + r.x / 2, q.y / 2 + r.y / 2, q.z / 2 + r.z / 2});
    if (k % 2 == 0) options.lines.push_back({p, r});
  }
  return options;
}

template <class Impl>
class S9Given : public ::testing::Test {};
using GivenImplementations = ::testing::Types<RefGiven, FastGiven>;
TYPED_TEST_SUITE(S9Given, GivenImplementations);

/// What a section has on a point's way to the eye.
class WayToEye {
 public:
  explicit WayToEye(const SceneFile& view) : view_(view) {
    for (const ClipPlane& clip : view.options.clips)
      planes_.push_back(cut_beforehand::to_plane(clip));
    for (const PolygonId id : ids_of(view.scene)) {
      auto points =
          definition::points_of(view.scene, definition::whole(view.scene, id));
      facets_.push_back(definition::facet_of(points));
      bool is_left = true;
      for (const definition::Plane& plane : planes_) {
        const bool lies_there =
            std::all_of(points.begin(), points.end(), [&](const auto& p) {
              return cut_beforehand::value_at(plane, p) == 0;
            });
        points = cut_beforehand::cut(points, plane);
        is_left =
            is_left && !points.empty() && !(lies_there && view.options.caps);
        if (!is_left) break;
      }
      are_left_.push_back(is_left);
    }
  }

  bool is_kept(const GridPoint& p) const {
    return std::all_of(
        planes_.begin(), planes_.end(), [&](const definition::Plane& plane) {
          return cut_beforehand::value_at(plane, {p.x, p.y, p.z, 1}) >= 0;
        });
  }

  /// Whether nothing hides a point that is kept; nothing where a cap's border
  /// or a plane's may be on the way.
  std::optional<bool> is_free(const GridPoint& p) const {
    const Ray ray = ray_to_eye(view_, p);
    for (const ref::Hit& hit : ref::all_hits(view_.scene, ray)) {
      const Fraction share = fraction(hit.parameter);
      if (share <= 0 || share >= 1) continue;
      if (!are_left_[static_cast<std::size_t>(hit.polygon)]) continue;
      const definition::Point at = point_at(ray, share);
      if (std::all_of(planes_.begin(), planes_.end(),
                      [&](const definition::Plane& plane) {
                        return cut_beforehand::value_at(plane, at) >= 0;
                      }))
        return false;
    }
    if (!view_.options.caps) return true;
    bool sure = true;
    for (std::size_t k = 0; k < planes_.size(); ++k) {
      const std::optional<int> winding = winding_on(ray, k);
      if (winding && *winding > 0) return false;
      sure = sure && winding.has_value();
    }
    return sure ? std::optional(true) : std::nullopt;
  }

 private:
  static Fraction fraction(const ref::Rational& value) {
    const auto big = value.big();
    return Fraction(Integer(numerator(big).str()),
                    Integer(denominator(big).str()));
  }
  static Fraction big(Int128 value) {
    return Fraction(static_cast<std::int64_t>(value >> 40)) *
               Fraction(std::int64_t{1} << 40) +
           Fraction(static_cast<std::int64_t>(value & ((Int128{1} << 40) - 1)));
  }
  static definition::Point point_at(const Ray& ray, const Fraction& share) {
    const RayData& data = ray.data();
    const Fraction step = 1 << kLatticeBits;
    const Fraction p[3] = {
        (big(data.origin.x) + share * big(data.direction.x)) / step,
        (big(data.origin.y) + share * big(data.direction.y)) / step,
        (big(data.origin.z) + share * big(data.direction.z)) / step};
    Integer w = 1;
    for (const Fraction& x : p) w = lcm(w, denominator(x));
    const auto whole = [&](const Fraction& x) -> Integer {
      return numerator(x) * (w / denominator(x));
    };
    return {whole(p[0]), whole(p[1]), whole(p[2]), w};
  }

  /// The winding number of the solid where the ray leaves what a plane keeps,
  /// or 0 where it does not, or other planes remove that; nothing where that is
  /// in doubt.
  std::optional<int> winding_on(const Ray& ray, std::size_t k) const {
    const auto value = [&](std::size_t plane, const definition::Point& p) {
      return Fraction(cut_beforehand::value_at(planes_[plane], p)) /
             Fraction(p.w);
    };
    const Fraction here = value(k, point_at(ray, 0));
    const Fraction there = value(k, point_at(ray, 1));
    if (!(here > 0 && there < 0)) return 0;
    const definition::Point at = point_at(ray, here / (here - there));
    for (std::size_t other = 0; other < planes_.size(); ++other) {
      if (other == k) continue;
      const Fraction side = value(other, at);
      if (side < 0) return 0;
      if (side == 0) return std::nullopt;
    }
    return cut_beforehand::winding_beside(facets_, at, planes_[k]);
  }

  const SceneFile& view_;
  std::vector<definition::Plane> planes_;
  std::vector<definition::Facet> facets_;
  std::vector<bool> are_left_;
};

TYPED_TEST(S9Given, L8AGivenPointIsVisibleWhereItSeesTheEyeInASection) {
  std::size_t seen = 0, hidden = 0, by_caps = 0;
  const auto property = [&](const SceneFile& changed) {
    SceneFile view = clipped(changed);
    if (view.scene.polygon_count() > 60 || view.options.clips.empty()) return;
    if (!bad_edges(view.scene).empty()) return;
    CameraData camera = view.camera->data();
    camera.near.reset();
    const auto made = make_camera(camera, view.scene.grid_bits());
    HALFSPACE_LAW(made.has_value());
    view.camera = *made;
    view.options.cull = false;
    if (seed_of(view) % 3 != 0) {
      view.options.caps = CapStyle{{1, 2, 3}, {}};
    } else {
      view.options.caps.reset();
    }
    const DrawingOptions options = given_in(view);
    const std::vector<bool> visible = TypeParam::seen(view, options).points;
    const ref::Projection projection = ref::projection_of(*view.camera);
    const WayToEye way(view);
    SceneFile open = view;
    open.options.caps.reset();
    const WayToEye open_way(open);
    for (std::size_t k = 0; k < visible.size(); ++k) {
      const GridPoint& p = options.points[k];
      if (!is_in_view(projection, p) || !way.is_kept(p)) {
        HALFSPACE_LAW(!visible[k]);
        continue;
      }
      const std::optional<bool> expected = way.is_free(p);
      if (!expected) continue;
      HALFSPACE_LAW(visible[k] == *expected);
      ++(visible[k] ? seen : hidden);
      if (!visible[k] && view.options.caps &&
          open_way.is_free(p).value_or(false))
        ++by_caps;
    }
  };
  law::for_all(closed_views(), kViewsWithPoints, property);
  law::check(kViewsWithPoints, [&] {
    property(cut_boxes(*rc::gen::arbitrary<std::uint64_t>(), 3, 16, 12));
  });
  EXPECT_GT(seen, 100u);
  EXPECT_GT(hidden, 100u);
  EXPECT_GT(by_caps, 20u);
}

TYPED_TEST(S9Given, L9WholeLinesAreHiddenByTheSceneCutBeforehand) {
  std::size_t changed = 0;
  law::for_all(closed_views(), kViewsWithPoints, [&](const SceneFile& whole) {
    if (!cut_scenes::is_of_boxes(whole.scene)) return;
    const cut_scenes::AxisCut cut = cut_scenes::cut_of(whole);
    const auto beforehand =
        cut_scenes::cut_beforehand_of(whole, cut, {1, 2, 3});
    if (!beforehand) return;  // a part is too thin for the grid
    SceneFile view = whole;
    view.options.clips = {cut_scenes::clip_of(cut)};
    view.options.caps = CapStyle{{1, 2, 3}, {}};
    DrawingOptions options = given_in(view);
    options.points.clear();
    options.whole = true;
    const Seen section = TypeParam::seen(view, options);
    options.whole = false;
    const Seen kept = TypeParam::seen(view, options);
    options.clips.clear();
    options.caps = false;
    HALFSPACE_LAW(section == TypeParam::seen(beforehand->view, options));
    if (beforehand->has_cap && section != kept) ++changed;
  });
  EXPECT_GT(changed, 4u);
}

TEST(S9GivenAgree, RefAndFastGiveTheSameOfSections) {
  std::size_t hidden = 0, behind_caps = 0;
  const auto agree = [&](const SceneFile& changed) {
    SceneFile view = clipped(changed);
    if (view.scene.polygon_count() == 0 || view.scene.polygon_count() > 30 ||
        view.options.clips.empty())
      return;
    const bool closed = bad_edges(view.scene).empty();
    if (!closed) view.options.caps.reset();
    if (closed && seed_of(view) % 3 != 0)
      view.options.caps = CapStyle{{1, 2, 3}, {}};
    for (const bool is_whole : {false, true}) {
      DrawingOptions options = given_in(view);
      options.whole = is_whole;
      const Seen f = FastGiven::seen(view, options);
      HALFSPACE_LAW(f == RefGiven::seen(view, options));
      for (const bool visible : f.points) hidden += visible ? 0u : 1u;
      if (!options.caps) continue;
      options.caps = false;
      behind_caps += f == FastGiven::seen(view, options) ? 0u : 1u;
    }
  };
  law::for_all_views(agree, kViewsWithPoints);
  law::for_all(closed_views(), kViewsWithPoints, agree);
  law::check(kViewsWithPoints, [&] {
    SceneFile view = cut_boxes(*rc::gen::arbitrary<std::uint64_t>(), 2, 16, 12);
    view.options.clips.clear();
    agree(view);
  });
  EXPECT_GT(hidden, 100u);
  EXPECT_GT(behind_caps, 10u);
}

}  // namespace
}  // namespace halfspace::given
