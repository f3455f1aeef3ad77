#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <vector>

#include "adapters/both.hpp"
#include "adapters/scenes.hpp"
#include "halfspace/fast/drawing.hpp"
#include "halfspace/ray.hpp"
#include "halfspace/ref/drawing.hpp"
#include "halfspace/ref/ray.hpp"
#include "halfspace/ref/visible_map.hpp"
#include "laws/law.hpp"
#include "laws/map/points_in_view.hpp"

/// Laws of drawings (S9). Those of both implementations are compared by the
/// nearest doubles to their points, of which exact points have one each.
namespace halfspace {
namespace {

constexpr int kDrawings = 150;

using Spot = std::pair<double, double>;

struct Interval {
  EdgeClass edge_class;
  std::array<double, 6> edge;  ///< the ends in space, as far as doubles go
  std::int32_t layers;
  double from_share, to_share;
  Spot from, to;
  auto key() const {
    return std::tie(edge, from_share, to_share, edge_class, layers, from, to);
  }
  friend bool operator==(const Interval& f, const Interval& g) {
    return f.key() == g.key();
  }
};
/// A line of the image, a x + b y + c = 0, the first coefficient that is not 0
/// being 1.
using ImageLine = std::array<ref::Rational, 3>;

/// The line through two points with homogeneous coordinates.
ImageLine line_through(const ImageLine& p, const ImageLine& q) {
  const ImageLine l = {p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2],
                       p[0] * q[1] - p[1] * q[0]};
  const ref::Rational scale = sign(l[0]) != 0 ? l[0] : l[1];
  return {l[0] / scale, l[1] / scale, l[2] / scale};
}

struct Pen {
  EdgeClass edge_class;
  std::int32_t layers;
  Spot from, to;
  std::optional<ImageLine> line;  ///< if an edge of the scene is drawn there
  auto key() const { return std::tie(from, to, edge_class, layers); }
  friend bool operator==(const Pen& f, const Pen& g) {
    return f.key() == g.key();
  }
};
struct Drawn {
  std::vector<Interval> intervals;
  std::vector<Pen> strokes;
  void sort() {
    // Of ends that differ by less than doubles do either may be the first.
    for (Pen& stroke : strokes) {
      if (stroke.to < stroke.from) std::swap(stroke.from, stroke.to);
    }
    const auto before = [](const auto& f, const auto& g) {
      return f.key() < g.key();
    };
    std::sort(intervals.begin(), intervals.end(), before);
    std::sort(strokes.begin(), strokes.end(), before);
  }
  friend bool operator==(const Drawn&, const Drawn&) = default;
};

struct RefDrawing {
  static Drawn draw(const SceneFile& view, const DrawingOptions& options) {
    const auto spot = [](const ref::ImagePoint& p) {
      return Spot{nearest_double(p.x), nearest_double(p.y)};
    };
    const ref::Drawing drawing = ref::draw(view.scene, *view.camera, options);
    Drawn drawn;
    for (const ref::DrawnInterval& i : drawing.intervals) {
      // Intersections have no names: their ends are left out.
      std::array<double, 6> edge{};
      if (i.edge_class != EdgeClass::kIntersection) {
        edge = {nearest_double(i.edge_from.x), nearest_double(i.edge_from.y),
                nearest_double(i.edge_from.z), nearest_double(i.edge_to.x),
                nearest_double(i.edge_to.y),   nearest_double(i.edge_to.z)};
      }
      drawn.intervals.push_back(
          {i.edge_class, edge, i.layers, nearest_double(i.from_share),
           nearest_double(i.to_share), spot(i.from), spot(i.to)});
    }
    for (const ref::DrawnStroke& s : drawing.strokes)
      drawn.strokes.push_back(
          {s.edge_class, s.layers, spot(s.from), spot(s.to),
           line_through({s.from.x, s.from.y, 1}, {s.to.x, s.to.y, 1})});
    return drawn;
  }
};

struct FastDrawing {
  static Drawn draw(const SceneFile& view, const DrawingOptions& options) {
    const auto spot = [](const fast::DrawingPoint& p) {
      return Spot{p.x, p.y};
    };
    const auto drawing = fast::draw(view.scene, *view.camera, options);
    HALFSPACE_LAW(drawing.has_value());
    Drawn drawn;
    for (const fast::EdgeInterval& i : drawing->intervals) {
      const fast::DrawingEdge& e =
          drawing->edges[static_cast<std::size_t>(i.edge)];
      std::array<double, 6> edge{};
      if (e.edge_class != EdgeClass::kIntersection) {
        const bool given = e.edge_class == EdgeClass::kGiven;
        const GridPoint& p =
            given ? options.lines[static_cast<std::size_t>(e.other)].from
                  : view.scene.point(e.from);
        const GridPoint& q =
            given ? options.lines[static_cast<std::size_t>(e.other)].to
                  : view.scene.point(e.to);
        const auto real = [](std::int64_t v) { return static_cast<double>(v); };
        edge = {real(p.x), real(p.y), real(p.z),
                real(q.x), real(q.y), real(q.z)};
      }
      drawn.intervals.push_back({e.edge_class, edge, i.layers, i.from_share,
                                 i.to_share, spot(i.from), spot(i.to)});
    }
    // A stroke names just its pieces.
    const ref::Projection projection = ref::projection_of(*view.camera);
    const auto seen = [&](VertexId vertex) {
      const ref::Point p = ref::to_point(view.scene.point(vertex));
      return ImageLine{value_at(projection.x, p), value_at(projection.y, p),
                       value_at(projection.w, p)};
    };
    for (const fast::Stroke& s : drawing->strokes) {
      HALFSPACE_LAW(s.piece_count > 0);
      std::optional<ImageLine> line;
      std::int32_t least = INT32_MAX;
      for (std::uint32_t k = 0; k < s.piece_count; ++k) {
        const auto piece = drawing->pieces[s.first_piece + k];
        const auto& i = drawing->intervals[static_cast<std::size_t>(piece)];
        const auto& e = drawing->edges[static_cast<std::size_t>(i.edge)];
        HALFSPACE_LAW(e.edge_class == s.edge_class);
        HALFSPACE_LAW((i.layers == 0) == (s.layers == 0));
        least = std::min(least, i.layers);
        if (e.from >= 0) line = line_through(seen(e.from), seen(e.to));
      }
      HALFSPACE_LAW(least == s.layers);
      drawn.strokes.push_back(
          {s.edge_class, s.layers, spot(s.from), spot(s.to), line});
    }
    return drawn;
  }
};

template <class Impl>
class S9Drawing : public ::testing::Test {};
using DrawingImplementations = ::testing::Types<RefDrawing, FastDrawing>;
TYPED_TEST_SUITE(S9Drawing, DrawingImplementations);

DrawingOptions drawing_options_of(const SceneFile& view) {
  DrawingOptions options;
  options.cull = view.options.cull;
  return options;
}

TYPED_TEST(S9Drawing, L1IntervalsAreWhatIsInTheView) {
  std::size_t hidden = 0;
  law::for_all_views(
      [&](const SceneFile& view) {
        const Drawn drawn = TypeParam::draw(view, drawing_options_of(view));
        // With nothing in front an edge has one interval: the part in view.
        std::map<std::array<double, 6>, std::vector<Interval>> edges;
        for (const Interval& i : drawn.intervals) {
          if (i.layers > 0) ++hidden;
          HALFSPACE_LAW(i.from_share <= i.to_share);
          if (i.edge_class != EdgeClass::kIntersection)
            edges[i.edge].push_back(i);
        }
        for (auto& [ends, parts] : edges) {
          for (std::size_t k = 1; k < parts.size(); ++k) {
            HALFSPACE_LAW(parts[k - 1].to_share == parts[k].from_share);
            HALFSPACE_LAW(parts[k - 1].to == parts[k].from);
            HALFSPACE_LAW(parts[k - 1].layers != parts[k].layers);
          }
          const ref::Point p = {static_cast<std::int64_t>(ends[0]),
                                static_cast<std::int64_t>(ends[1]),
                                static_cast<std::int64_t>(ends[2])};
          const ref::Point q = {static_cast<std::int64_t>(ends[3]),
                                static_cast<std::int64_t>(ends[4]),
                                static_cast<std::int64_t>(ends[5])};
          ref::Rational low = 0;
          ref::Rational high = 1;
          for (const ref::Plane& limit :
               ref::projection_of(*view.camera).view_volume) {
            const ref::Rational f = value_at(limit, p);
            const ref::Rational g = value_at(limit, q);
            if (sign(f) < 0) low = std::max(low, f / (f - g));
            if (sign(g) < 0) high = std::min(high, f / (f - g));
          }
          HALFSPACE_LAW(parts.front().from_share == nearest_double(low));
          HALFSPACE_LAW(parts.back().to_share == nearest_double(high));
        }
      },
      kDrawings);
  EXPECT_GT(hidden, 50u);
}

/// Twice the area of a triangle.
double turn(const Spot& p, const Spot& q, const Spot& r) {
  return (q.first - p.first) * (r.second - p.second) -
         (q.second - p.second) * (r.first - p.first);
}

double length_of(const Spot& p, const Spot& q) {
  return std::hypot(q.first - p.first, q.second - p.second);
}

/// How far a spot is from a segment.
double distance(const Spot& p, const Spot& a, const Spot& b) {
  const double length = length_of(a, b);
  if (length == 0) return length_of(p, a);
  const double along = ((p.first - a.first) * (b.first - a.first) +
                        (p.second - a.second) * (b.second - a.second)) /
                       length;
  if (along < 0) return length_of(p, a);
  if (along > length) return length_of(p, b);
  return std::abs(turn(a, b, p)) / length;
}

constexpr double kNear = 1e-6;  ///< pixels: far more than doubles move a spot

/// Whether spots all along a segment lie on one of the strokes.
bool is_covered(const Spot& from, const Spot& to,
                const std::vector<Pen>& strokes, bool visible) {
  for (const double share : {0.21, 0.5, 0.83}) {
    const Spot p = {from.first + share * (to.first - from.first),
                    from.second + share * (to.second - from.second)};
    if (std::none_of(strokes.begin(), strokes.end(), [&](const Pen& s) {
          return (s.layers == 0 || !visible) &&
                 distance(p, s.from, s.to) < kNear;
        }))
      return false;
  }
  return true;
}

TYPED_TEST(S9Drawing, L2StrokesCoverTheIntervalsOnce) {
  std::size_t joined = 0;
  std::size_t pairs = 0;  // of strokes on one line
  law::for_all_views(
      [&](const SceneFile& view) {
        const Drawn drawn = TypeParam::draw(view, drawing_options_of(view));
        for (const Interval& i : drawn.intervals)
          HALFSPACE_LAW(is_covered(i.from, i.to, drawn.strokes, i.layers == 0));
        for (const Pen& s : drawn.strokes) {
          // Its middle is on an interval of its kind.
          const Spot middle = {(s.from.first + s.to.first) / 2,
                               (s.from.second + s.to.second) / 2};
          HALFSPACE_LAW(
              std::any_of(drawn.intervals.begin(), drawn.intervals.end(),
                          [&](const Interval& i) {
                            return (i.layers == 0) == (s.layers == 0) &&
                                   i.edge_class == s.edge_class &&
                                   distance(middle, i.from, i.to) < kNear;
                          }));
        }
        for (std::size_t f = 0; f < drawn.strokes.size(); ++f) {
          for (std::size_t g = 0; g < f; ++g) {
            const Pen& p = drawn.strokes[f];
            const Pen& q = drawn.strokes[g];
            if (!p.line || !q.line || *p.line != *q.line) continue;
            // Nearest doubles are in the order of what they are nearest to.
            const auto overlap = [](double a, double b, double c, double d) {
              return std::max(std::min(a, b), std::min(c, d)) <
                     std::min(std::max(a, b), std::max(c, d));
            };
            HALFSPACE_LAW(
                !overlap(p.from.first, p.to.first, q.from.first, q.to.first));
            HALFSPACE_LAW(!overlap(p.from.second, p.to.second, q.from.second,
                                   q.to.second));
            ++pairs;
          }
        }
        if (drawn.strokes.size() < drawn.intervals.size()) ++joined;
      },
      kDrawings);
  EXPECT_GT(joined, 20u);
  EXPECT_GT(pairs, 20u);
}

TYPED_TEST(S9Drawing, L3BordersOfTheMapAreDrawn) {
  std::size_t several = 0;
  law::for_all_views(
      [&](const SceneFile& view) {
        if ((*view.camera)->near) return;
        MapOptions keys;
        keys.cull = view.options.cull;
        keys.keys = fast::intern_planes(view.scene).plane_of;
        const Drawn drawn = TypeParam::draw(view, drawing_options_of(view));
        for (const ref::MapArc& arc :
             ref::visible_map(view.scene, *view.camera, keys)) {
          if (arc.left == kOutsideKey || arc.right == kOutsideKey) continue;
          const Spot from = {nearest_double(arc.from.x),
                             nearest_double(arc.from.y)};
          const Spot to = {nearest_double(arc.to.x), nearest_double(arc.to.y)};
          HALFSPACE_LAW(is_covered(from, to, drawn.strokes, true));
          ++several;
        }
      },
      kDrawings);
  EXPECT_GT(several, 100u);
}

TYPED_TEST(S9Drawing, L4CornersAndOrientationDoNotMatter) {
  law::for_all_views(
      [](const SceneFile& view) {
        Drawn drawn = TypeParam::draw(view, drawing_options_of(view));
        drawn.sort();
        const auto same = [&](const Scene& scene) {
          SceneFile changed = view;
          changed.scene = scene;
          Drawn other = TypeParam::draw(changed, drawing_options_of(view));
          other.sort();
          HALFSPACE_LAW(other == drawn);
        };
        SceneData data = view.scene.data();
        for (std::size_t p = 0; p < view.scene.polygon_count(); ++p) {
          std::rotate(data.corners.begin() + data.first_corner[p],
                      data.corners.begin() + data.first_corner[p] + 1,
                      data.corners.begin() + data.first_corner[p + 1]);
        }
        data.corner_colors.clear();
        same(*make_scene(std::move(data)));
        if (!view.options.cull) same(reversed(view.scene));
      },
      kDrawings);
}

TYPED_TEST(S9Drawing, L5AGivenLineAlongAnEdgeHasItsIntervals) {
  std::size_t hidden = 0;
  law::for_all_views(
      [&](const SceneFile& view) {
        DrawingOptions options = drawing_options_of(view);
        Drawn plain = TypeParam::draw(view, options);
        std::set<std::array<double, 6>> edges;
        std::erase_if(plain.intervals, [](const Interval& i) {
          return i.edge_class == EdgeClass::kIntersection;
        });
        for (const Interval& i : plain.intervals) edges.insert(i.edge);
        const auto whole = [](double c) {
          return static_cast<std::int64_t>(c);
        };
        for (const auto& e : edges) {
          options.lines.push_back({{whole(e[0]), whole(e[1]), whole(e[2])},
                                   {whole(e[3]), whole(e[4]), whole(e[5])}});
        }
        Drawn given = TypeParam::draw(view, options);
        std::erase_if(given.intervals, [](const Interval& i) {
          return i.edge_class != EdgeClass::kGiven;
        });
        for (Interval& i : plain.intervals) {
          i.edge_class = EdgeClass::kGiven;
          hidden += i.layers > 0 ? 1 : 0;
        }
        plain.sort();
        given.sort();
        HALFSPACE_LAW(plain.intervals == given.intervals);
      },
      kDrawings);
  EXPECT_GT(hidden, 50u);
}

/// Points and lines about the corners of a view's scene.
DrawingOptions given_of(const SceneFile& view) {
  DrawingOptions options = drawing_options_of(view);
  const auto& vertices = view.scene.data().vertices;
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    const GridPoint& p = vertices[k];
    const GridPoint& q = vertices[(k + 1) % vertices.size()];
    const GridPoint& r = vertices[(7 * k + 3) % vertices.size()];
    options.points.push_back(p);
    options.points.push_back(
        {p.x / 2 + q.x / 2, p.y / 2 + q.y / 2, p.z / 2 + q.z / 2});
    if (k % 2 == 0) options.lines.push_back({p, r});
  }
  return options;
}

std::vector<bool> points_visible(const RefDrawing*, const SceneFile& view,
                                 const DrawingOptions& options) {
  return ref::draw(view.scene, *view.camera, options).points_visible;
}
std::vector<bool> points_visible(const FastDrawing*, const SceneFile& view,
                                 const DrawingOptions& options) {
  const auto drawing = fast::draw(view.scene, *view.camera, options);
  HALFSPACE_LAW(drawing.has_value());
  std::vector<bool> visible;
  for (const fast::SeenPoint& point : drawing->points)
    visible.push_back(point.visible);
  return visible;
}

TYPED_TEST(S9Drawing, L6AGivenPointIsVisibleWhereItSeesTheEye) {
  std::size_t counts[2] = {0, 0};
  law::for_all_views(
      [&](const SceneFile& changed) {
        SceneFile view = changed;
        CameraData camera = view.camera->data();
        camera.near.reset();
        view.options.cull = false;
        const Result<Camera> made = make_camera(camera, view.scene.grid_bits());
        HALFSPACE_LAW(made.has_value());
        view.camera = *made;
        const DrawingOptions options = given_of(view);
        const std::vector<bool> visible = points_visible(
            static_cast<const TypeParam*>(nullptr), view, options);
        const ref::Projection projection = ref::projection_of(*view.camera);
        for (std::size_t k = 0; k < visible.size(); ++k) {
          const GridPoint& p = options.points[k];
          const bool in_view = is_in_view(projection, p);
          if (!in_view) {
            HALFSPACE_LAW(!visible[k]);
            continue;
          }
          HALFSPACE_LAW(visible[k] ==
                        ref::see_each_other(view.scene, ray_to_eye(view, p)));
          ++counts[visible[k] ? 1 : 0];
        }
      },
      kDrawings);
  EXPECT_GT(counts[0], 100u);
  EXPECT_GT(counts[1], 100u);
}

TEST(S9DrawingAgree, RefAndFastDrawTheSame) {
  std::set<EdgeClass> met;
  law::for_all_views(
      [&met](const SceneFile& view) {
        for (const std::int32_t cosine : {1 << kCosineBits, 0, 759250125}) {
          DrawingOptions options =
              cosine == 0 ? given_of(view) : drawing_options_of(view);
          options.crease_cosine = cosine;
          options.edges = cosine != 0 || view.scene.polygon_count() % 2 == 0;
          if (cosine == 0) {
            for (std::size_t p = 0; p < view.scene.polygon_count(); ++p)
              options.cuts.push_back(p % 3 == 0);
          }
          Drawn f = FastDrawing::draw(view, options);
          Drawn r = RefDrawing::draw(view, options);
          f.sort();
          r.sort();
          HALFSPACE_LAW(f.intervals.size() == r.intervals.size());
          HALFSPACE_LAW(f.intervals == r.intervals);
          HALFSPACE_LAW(f.strokes == r.strokes);
          for (const Interval& i : f.intervals) met.insert(i.edge_class);
        }
        const DrawingOptions given = given_of(view);
        HALFSPACE_LAW(
            points_visible(static_cast<FastDrawing*>(nullptr), view, given) ==
            points_visible(static_cast<RefDrawing*>(nullptr), view, given));
      },
      kDrawings);
  EXPECT_EQ(met.size(), kEdgeClassCount);
}

}  // namespace
}  // namespace halfspace
