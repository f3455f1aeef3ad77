#include "halfspace/ref/drawing.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "covering.hpp"
#include "frames/cap_corners.hpp"
#include "frames/caps.hpp"
#include "halfspace/ref/clip.hpp"
#include "vector.hpp"

namespace halfspace::ref {
namespace {

/// A polygon at an edge, and whether it passes the edge forwards.
struct PolygonAt {
  std::size_t polygon = 0;
  bool forwards = true;
};

/// An edge or an intersection, `from` before `to`, or a given line.
struct Edge {
  Point from;
  Point to;
  EdgeClass edge_class = EdgeClass::kCrease;
  std::vector<std::size_t> polygons = {};  ///< those at it
  /// The two clip planes of an edge at which caps meet (S9.8).
  std::optional<std::pair<std::size_t, std::size_t>> caps = {};
};

bool is_on_line(const Point& p, const Point& a, const Point& b) {
  return cross(difference(p, a), difference(b, a)) == Point{0, 0, 0};
}

/// a + share (b - a).
Point between(const Point& a, const Point& b, const Rational& share) {
  const auto mean = [&share](const Rational& x, const Rational& y) {
    return x + share * (y - x);
  };
  return {mean(a.x, b.x), mean(a.y, b.y), mean(a.z, b.z)};
}

/// What a polygon has in common with a plane: a segment of positive length, and
/// whether it lies on a side of the polygon.
struct Common {
  Point low;
  Point high;
  bool is_side = false;
};

std::optional<Common> common_of(const Fragment& polygon, const Plane& plane) {
  std::vector<Point> points;
  bool any_positive = false;
  bool any_negative = false;
  const std::size_t n = polygon.vertices.size();
  for (std::size_t k = 0; k < n; ++k) {
    const Point& p = polygon.vertices[k];
    const Point& q = polygon.vertices[(k + 1) % n];
    const Rational f = value_at(plane, p);
    const Rational g = value_at(plane, q);
    any_positive = any_positive || sign(f) > 0;
    any_negative = any_negative || sign(f) < 0;
    if (sign(f) == 0) points.push_back(p);
    if (sign(f) * sign(g) < 0) points.push_back(between(p, q, f / (f - g)));
  }
  if (points.empty()) return std::nullopt;
  const auto [low, high] = std::minmax_element(points.begin(), points.end());
  if (!(*low < *high)) return std::nullopt;
  return Common{*low, *high, !(any_positive && any_negative)};
}

/// The way in which an interval is drawn: the less, the sooner (S9.6).
constexpr int kHidden = 8;
constexpr int kNoWay = 2 * kHidden;
int way_of(const DrawnInterval& interval) {
  return (interval.layers > 0 ? kHidden : 0) +
         static_cast<int>(interval.edge_class);
}

bool before(const ImagePoint& p, const ImagePoint& q) {
  return p.x == q.x ? p.y < q.y : p.x < q.x;
}
bool are_equal(const ImagePoint& p, const ImagePoint& q) {
  return p.x == q.x && p.y == q.y;
}
bool is_on_line(const ImagePoint& p, const ImagePoint& a, const ImagePoint& b) {
  return (p.x - a.x) * (b.y - a.y) == (p.y - a.y) * (b.x - a.x);
}

/// The scene of a drawing.
class Drawer {
 public:
  Drawer(const Scene& scene, const Camera& camera,
         const DrawingOptions& options)
      : camera_(camera), options_(options), projection_(projection_of(camera)) {
    section_.clips = options.clips;
    section_.cull = options.cull;
    if (options.caps) {
      section_.caps.emplace();
      caps_.emplace(scene, camera, section_, 1);
    }
    for (PolygonId id = 0; id < static_cast<PolygonId>(scene.polygon_count());
         ++id) {
      const Fragment polygon = whole(scene, id);
      const Plane plane = plane_of(polygon.vertices);
      const Side eye = side_of_eye(plane, camera);
      const bool is_culled = options.cull && eye == Side::kNegative;
      all_polygons_.push_back(polygon);
      are_culled_.push_back(is_culled);
      if (is_culled) continue;
      polygons_.push_back(polygon);
      planes_.push_back(plane);
      coverings_.emplace_back();
      if (is_there(plane, section_)) {
        if (const auto left = clipped(polygon, section_))
          coverings_.back() = covering_of(*left, camera, false);
      }
      eyes_.push_back(eye == Side::kOn ? 0 : eye == Side::kPositive ? 1 : -1);
    }
  }

  Drawing run() {
    if (options_.edges) {
      find_edges();
      find_intersections();
      std::erase_if(edges_, [&](const Edge& e) { return is_in_clip(e); });
      find_sections();
      if (caps_) find_corners();
    }
    for (const GivenLine& line : options_.lines) {
      edges_.push_back(
          {to_point(line.from), to_point(line.to), EdgeClass::kGiven});
    }
    for (const GridPoint& point : options_.points)
      drawing_.points_visible.push_back(is_visible(to_point(point)));
    std::stable_sort(edges_.begin(), edges_.end(),
                     [](const Edge& f, const Edge& g) {
                       return f.from == g.from ? f.to < g.to : f.from < g.from;
                     });
    for (const Edge& edge : edges_) divide(edge);
    join();
    return std::move(drawing_);
  }

 private:
  /// S9.1: every side is cut at the ends of all sides on its line.
  void find_edges() {
    struct PolygonSide {
      Point from, to;
      std::size_t polygon;
    };
    std::vector<PolygonSide> sides;
    for (std::size_t p = 0; p < polygons_.size(); ++p) {
      const auto& vertices = polygons_[p].vertices;
      for (std::size_t k = 0; k < vertices.size(); ++k) {
        sides.push_back({vertices[k], vertices[(k + 1) % vertices.size()], p});
      }
    }
    std::map<std::pair<Point, Point>, std::vector<PolygonAt>> found;
    for (const PolygonSide& side : sides) {
      const bool forwards = side.from < side.to;
      const Point& low = forwards ? side.from : side.to;
      const Point& high = forwards ? side.to : side.from;
      std::vector<Point> points = {low, high};
      for (const PolygonSide& other : sides) {
        if (!is_on_line(other.from, low, high) ||
            !is_on_line(other.to, low, high))
          continue;
        for (const Point& p : {other.from, other.to}) {
          if (low < p && p < high) points.push_back(p);
        }
      }
      std::sort(points.begin(), points.end());
      points.erase(std::unique(points.begin(), points.end()), points.end());
      for (std::size_t k = 1; k < points.size(); ++k) {
        found[{points[k - 1], points[k]}].push_back({side.polygon, forwards});
      }
    }
    for (const auto& [ends, at] : found) {
      const auto edge_class = class_of(at);
      if (!edge_class) continue;
      edges_.push_back({ends.first, ends.second, *edge_class});
      for (const PolygonAt& side : at)
        edges_.back().polygons.push_back(side.polygon);
    }
  }

  bool are_coplanar(std::size_t p, std::size_t q) const {
    return std::all_of(
        polygons_[q].vertices.begin(), polygons_[q].vertices.end(),
        [&](const Point& v) { return sign(value_at(planes_[p], v)) == 0; });
  }

  /// S9.2.
  std::optional<EdgeClass> class_of(const std::vector<PolygonAt>& at) const {
    const auto all = [&at](const auto& holds) {
      return std::all_of(at.begin(), at.end(), holds);
    };
    const std::size_t first = at[0].polygon;
    // The side of an edge in the common plane, then that in the image.
    const auto is_same_side = [&](const PolygonAt& p) {
      const bool turned = !same_direction(planes_[first], planes_[p.polygon]);
      return (p.forwards == at[0].forwards) != turned;
    };
    if (all([&](const PolygonAt& p) {
          return are_coplanar(first, p.polygon);
        }) &&
        !all(is_same_side))
      return std::nullopt;
    const auto is_cut = [&](const PolygonAt& p) {
      const auto id = static_cast<std::size_t>(polygons_[p.polygon].source);
      return !options_.cuts.empty() && options_.cuts[id];
    };
    if (std::any_of(at.begin(), at.end(), is_cut)) return EdgeClass::kSection;
    if (at.size() == 1) return EdgeClass::kBorder;
    const auto seen_side = [&](const PolygonAt& p) {
      return eyes_[p.polygon] * (p.forwards ? 1 : -1);
    };
    if (all([&](const PolygonAt& p) { return seen_side(p) >= 0; }) ||
        all([&](const PolygonAt& p) { return seen_side(p) <= 0; }))
      return EdgeClass::kSilhouette;
    if (at.size() > 2 || is_crease(at[0], at[1])) return EdgeClass::kCrease;
    return std::nullopt;
  }

  bool is_crease(const PolygonAt& p, const PolygonAt& q) const {
    const Point m = normal_of(planes_[p.polygon]);
    const Point n = normal_of(planes_[q.polygon]);
    const Rational product =
        Rational(p.forwards == q.forwards ? -1 : 1) * dot(m, n);
    const Rational cosine = Rational(options_.crease_cosine) /
                            Rational(std::int64_t{1} << kCosineBits);
    // product < cosine |m| |n|, by signs and squares.
    const Rational left = product * product;
    const Rational right = cosine * cosine * dot(m, m) * dot(n, n);
    if (sign(product) < 0) return sign(cosine) >= 0 || left > right;
    return sign(cosine) > 0 && left < right;
  }

  /// S9.3.
  void find_intersections() {
    for (std::size_t p = 0; p < polygons_.size(); ++p) {
      for (std::size_t q = 0; q < p; ++q) {
        if (are_coplanar(p, q)) continue;
        const auto f = common_of(polygons_[p], planes_[q]);
        const auto g = common_of(polygons_[q], planes_[p]);
        if (!f || !g || (f->is_side && g->is_side)) continue;
        const Point& low = std::max(f->low, g->low);
        const Point& high = std::min(f->high, g->high);
        if (low < high)
          edges_.push_back({low, high, EdgeClass::kIntersection, {p, q}});
      }
    }
  }

  /// S9.8.
  bool is_in_clip(const Edge& edge) const {
    return std::any_of(
        options_.clips.begin(), options_.clips.end(), [&](const auto& clip) {
          const Plane plane = function_of(clip);
          const auto is_on = [&](const Point& p) {
            return sign(value_at(plane, p)) == 0;
          };
          const auto lies_there = [&](std::size_t p) {
            const auto& vertices = polygons_[p].vertices;
            return std::all_of(vertices.begin(), vertices.end(), is_on);
          };
          return is_on(edge.from) && is_on(edge.to) &&
                 (caps_ || std::none_of(edge.polygons.begin(),
                                        edge.polygons.end(), lies_there));
        });
  }
  void find_sections() {
    for (std::size_t p = 0; p < all_polygons_.size(); ++p) {
      for (std::size_t k = 0; k < options_.clips.size(); ++k) {
        if (are_culled_[p] && !is_before_cap(k)) continue;
        const auto common =
            common_of(all_polygons_[p], function_of(options_.clips[k]));
        if (common && leaves_section(all_polygons_[p], k, *common))
          edges_.push_back({common->low, common->high, EdgeClass::kSection});
      }
    }
  }
  bool is_before_cap(std::size_t k) const {
    return caps_ && sign(caps_->plane(k).at_eye) < 0;
  }
  /// Whether what is left of a polygon, by plane k and all that hold the
  /// segment, has that segment.
  bool leaves_section(const Fragment& polygon, std::size_t k,
                      const Common& common) const {
    const auto value = [&](std::size_t plane, const Point& p) {
      return sign(value_at(function_of(options_.clips[plane]), p));
    };
    const auto& vertices = polygon.vertices;
    const auto any_kept = [&](std::size_t other) {
      return std::any_of(vertices.begin(), vertices.end(), [&](const Point& p) {
        return value(k, p) > 0 && value(other, p) > 0;
      });
    };
    for (std::size_t other = 0; other < options_.clips.size(); ++other) {
      if (other != k &&
          (value(other, common.low) != 0 || value(other, common.high) != 0))
        continue;
      const bool lies_there =
          std::all_of(vertices.begin(), vertices.end(),
                      [&](const Point& p) { return value(other, p) == 0; });
      if (other != k && lies_there && !caps_) continue;
      if (!any_kept(other)) return false;
    }
    return true;
  }

  /// S9.8: the lines in which two clip planes meet, within a box that has the
  /// scene inside.
  void find_corners() {
    for (std::size_t k = 0; k < options_.clips.size(); ++k) {
      for (std::size_t l = k + 1; l < options_.clips.size(); ++l) {
        if (options_.cull && !is_before_cap(k) && !is_before_cap(l)) continue;
        const auto line =
            corner_line(all_polygons_, options_.clips[k], options_.clips[l]);
        if (!line) continue;
        Edge edge = {line->first, line->second, EdgeClass::kSection};
        edge.caps = {k, l};
        edges_.push_back(std::move(edge));
      }
    }
  }

  /// Whether an edge is seen as a point: its line passes through the eye.
  bool is_point(const Edge& edge) const {
    if (edge.from == edge.to) return true;
    const Point eye = to_point(camera_->eye);
    if (!camera_->perspective)
      return cross(difference(edge.to, edge.from), eye) == Point{0, 0, 0};
    const Rational step = 1 << kLatticeBits;
    const auto scaled = [&](const Point& p) {
      return Point{step * p.x, step * p.y, step * p.z};
    };
    return is_on_line(eye, scaled(edge.from), scaled(edge.to));
  }

  /// S9.7: whether a given point is visible.
  bool is_visible(const Point& p) const {
    if (!options_.whole &&
        std::any_of(options_.clips.begin(), options_.clips.end(),
                    [&](const ClipPlane& clip) {
                      return sign(value_at(function_of(clip), p)) < 0;
                    }))
      return false;
    for (std::size_t k = 0; k < projection_.view_volume.size(); ++k) {
      const int side = sign(value_at(projection_.view_volume[k], p));
      // At the near distance itself nothing is seen.
      const bool is_near = k == 0 && projection_.view_volume.size() == 5;
      if (side < 0 || (is_near && side == 0)) return false;
    }
    const ImagePoint image = image_of(p, projection_);
    const Rational nearness = nearness_of(p);
    const auto sign_of = [&](const Affine& f) {
      if (const int s = sign(at(f, image))) return s;
      return sign(f.dx) != 0 ? sign(f.dx) : sign(f.dy);
    };
    for (std::size_t k = 0; caps_ && k < caps_->count(); ++k) {
      if (is_cap_nearer(k, image, nearness) && caps_->shows(k, sign_of))
        return false;
    }
    return std::none_of(
        coverings_.begin(), coverings_.end(), [&](const auto& covering) {
          if (!covering || at(covering->nearness, image) <= nearness)
            return false;
          // At its near limit, which comes last, a polygon is not there.
          if (camera_->near && sign(at(covering->insides.back(), image)) <= 0)
            return false;
          return std::all_of(
              covering->insides.begin(), covering->insides.end(),
              [&](const Affine& f) { return sign(at(f, image)) >= 0; });
        });
  }

  /// S9.5: the intervals of one edge.
  void divide(const Edge& edge) {
    if (is_point(edge)) return;
    // Step 1: the part that is in the view.
    Rational low = 0;
    Rational high = 1;
    bool is_first = true;
    for (const Plane& limit : projection_.view_volume) {
      const Rational f = value_at(limit, edge.from);
      const Rational g = value_at(limit, edge.to);
      // At the near distance itself nothing is seen.
      const bool is_near = is_first && projection_.view_volume.size() == 5;
      is_first = false;
      if (sign(f) < 0 && sign(g) < 0) return;
      if (is_near && sign(f) <= 0 && sign(g) <= 0) return;
      if (sign(f) == 0 && sign(g) == 0) continue;
      if (sign(f) < 0) low = std::max(low, f / (f - g));
      if (sign(g) < 0) high = std::min(high, f / (f - g));
    }
    const bool is_whole =
        options_.whole && edge.edge_class == EdgeClass::kGiven;
    for (const ClipPlane& clip : options_.clips) {
      if (is_whole) break;
      const Rational f = value_at(function_of(clip), edge.from);
      const Rational g = value_at(function_of(clip), edge.to);
      if (sign(f) == 0 && sign(g) == 0) continue;
      if (sign(f) <= 0 && sign(g) <= 0) return;
      if (sign(f) < 0) low = std::max(low, f / (f - g));
      if (sign(g) < 0) high = std::min(high, f / (f - g));
    }
    if (!(low < high)) return;
    const Point from = between(edge.from, edge.to, low);
    const Point to = between(edge.from, edge.to, high);
    // Step 2: cut the image where a form of any polygon is 0.
    const Segment image = {image_of(from, projection_),
                           image_of(to, projection_), nearness_of(from),
                           nearness_of(to)};
    std::vector<Rational> cuts = {0, 1};
    const auto cut = [&](const Rational& f, const Rational& g) {
      if (sign(f) * sign(g) < 0) cuts.push_back(f / (f - g));
    };
    const Rational w = value_at(projection_.w, from);
    const Rational v = value_at(projection_.w, to);
    if (edge.caps) {
      for (const Fragment& polygon : all_polygons_) {
        const Plane plane = plane_of(polygon.vertices);
        cut(value_at(plane, from) / w, value_at(plane, to) / v);
      }
    }
    if (caps_) {
      for (const Affine& form : caps_->forms())
        cut(at(form, image.from), at(form, image.to));
      // A whole line passes the planes.
      for (const ClipPlane& clip : options_.clips) {
        const Plane plane = function_of(clip);
        cut(value_at(plane, from) / w, value_at(plane, to) / v);
      }
    }
    for (const auto& covering : coverings_) {
      if (!covering) continue;
      for (const Affine& inside : covering->insides)
        cut(at(inside, image.from), at(inside, image.to));
      cut(at(covering->nearness, image.from) - image.from_nearness,
          at(covering->nearness, image.to) - image.to_nearness);
    }
    std::sort(cuts.begin(), cuts.end());
    cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
    // Step 3: count what is in front of each part; join parts with one count.
    const auto share_of = [&](const Rational& s) {
      return low + (high - low) * (s * w / (s * w + (Rational(1) - s) * v));
    };
    constexpr std::int32_t kNone = -1;
    std::int32_t last = kNone;
    for (std::size_t k = 1; k < cuts.size(); ++k) {
      const Rational middle =
          Rational(1) / Rational(2) * (cuts[k - 1] + cuts[k]);
      if (edge.caps &&
          !do_caps_meet(all_polygons_, options_.clips, edge.caps->first,
                        edge.caps->second,
                        between(edge.from, edge.to, share_of(middle)))) {
        last = kNone;
        continue;
      }
      const std::int32_t layers = layers_at(image, middle);
      if (last == layers) {
        drawing_.intervals.back().to_share = share_of(cuts[k]);
        drawing_.intervals.back().to = along(image, cuts[k]);
      } else {
        drawing_.intervals.push_back(
            {edge.edge_class, layers, edge.from, edge.to, share_of(cuts[k - 1]),
             share_of(cuts[k]), along(image, cuts[k - 1]),
             along(image, cuts[k])});
      }
      last = layers;
    }
  }

  /// A part of an edge in the image.
  struct Segment {
    ImagePoint from, to;
    Rational from_nearness, to_nearness;
  };

  static Rational at(const Affine& f, const ImagePoint& p) {
    return f.value + p.x * f.dx + p.y * f.dy;
  }

  static ImagePoint along(const Segment& image, const Rational& share) {
    return {image.from.x + share * (image.to.x - image.from.x),
            image.from.y + share * (image.to.y - image.from.y)};
  }

  /// As Covering has it: 1/t - 1 in perspective, else -t, with t the ray
  /// parameter of the point (S4.3).
  Rational nearness_of(const Point& p) const {
    const Rational step = 1 << kLatticeBits;
    const Point lattice = {step * p.x, step * p.y, step * p.z};
    const Point s0 = to_point(camera_->s0);
    const Point eye = to_point(camera_->eye);
    const Point across = cross(to_point(camera_->sx), to_point(camera_->sy));
    if (camera_->perspective) {
      const Rational t = dot(across, difference(lattice, eye)) /
                         dot(across, difference(s0, eye));
      return Rational(1) / t - Rational(1);
    }
    return dot(across, difference(lattice, s0)) / dot(across, eye);
  }

  /// S9.4.
  std::int32_t layers_at(const Segment& image, const Rational& share) const {
    const ImagePoint p = along(image, share);
    const Rational nearness =
        image.from_nearness + share * (image.to_nearness - image.from_nearness);
    const Rational dx = image.to.x - image.from.x;
    const Rational dy = image.to.y - image.from.y;
    std::int32_t left = 0;
    std::int32_t right = 0;
    for (const auto& covering : coverings_) {
      if (!covering || at(covering->nearness, p) <= nearness) continue;
      const auto covers = [&](const Rational& x, const Rational& y) {
        return std::all_of(
            covering->insides.begin(), covering->insides.end(),
            [&](const Affine& f) { return sign_beside(f, p, x, y) > 0; });
      };
      left += covers(dy, -dx) ? 1 : 0;
      right += covers(-dy, dx) ? 1 : 0;
    }
    for (std::size_t k = 0; caps_ && k < caps_->count(); ++k) {
      if (!is_cap_nearer(k, p, nearness)) continue;
      const auto shows = [&](const Rational& x, const Rational& y) {
        return caps_->shows(
            k, [&](const Affine& f) { return sign_beside(f, p, x, y); });
      };
      left += shows(dy, -dx) ? 1 : 0;
      right += shows(-dy, dx) ? 1 : 0;
    }
    return std::min(left, right);
  }

  /// Whether the plane of a cap is nearer than that at an image point; an eye
  /// in the plane sees no cap.
  bool is_cap_nearer(std::size_t k, const ImagePoint& p,
                     const Rational& nearness) const {
    const SeenPlane& plane = caps_->plane(k);
    return sign(plane.at_eye) != 0 &&
           Rational(-1) / plane.at_eye * at(plane.at_image, p) > nearness;
  }

  /// S9.6: line by line of the image.
  void join() {
    std::vector<bool> done(drawing_.intervals.size());
    for (std::size_t i = 0; i < done.size(); ++i) {
      if (done[i]) continue;
      const DrawnInterval& first = drawing_.intervals[i];
      std::vector<const DrawnInterval*> on_line;
      for (std::size_t j = i; j < done.size(); ++j) {
        const DrawnInterval& other = drawing_.intervals[j];
        if (!is_on_line(other.from, first.from, first.to) ||
            !is_on_line(other.to, first.from, first.to))
          continue;
        done[j] = true;
        on_line.push_back(&other);
      }
      join_line(on_line);
    }
    std::sort(drawing_.strokes.begin(), drawing_.strokes.end(),
              [](const DrawnStroke& f, const DrawnStroke& g) {
                return are_equal(f.from, g.from) ? before(f.to, g.to)
                                                 : before(f.from, g.from);
              });
  }

  void join_line(const std::vector<const DrawnInterval*>& intervals) {
    const auto low = [](const DrawnInterval& i) {
      return before(i.from, i.to) ? i.from : i.to;
    };
    const auto high = [](const DrawnInterval& i) {
      return before(i.from, i.to) ? i.to : i.from;
    };
    std::vector<ImagePoint> points;
    for (const DrawnInterval* interval : intervals) {
      points.push_back(interval->from);
      points.push_back(interval->to);
    }
    std::sort(points.begin(), points.end(), before);
    points.erase(std::unique(points.begin(), points.end(), are_equal),
                 points.end());
    int last = kNoWay;
    for (std::size_t k = 1; k < points.size(); ++k) {
      int best = kNoWay;
      std::int32_t layers = 0;
      for (const DrawnInterval* interval : intervals) {
        if (before(points[k - 1], low(*interval)) ||
            before(high(*interval), points[k]))
          continue;
        const int way = way_of(*interval);
        if (best < way) continue;
        layers =
            best == way ? std::min(layers, interval->layers) : interval->layers;
        best = way;
      }
      if (best == last && best != kNoWay) {
        DrawnStroke& stroke = drawing_.strokes.back();
        stroke.to = points[k];
        stroke.layers = std::min(stroke.layers, layers);
      } else if (best != kNoWay) {
        drawing_.strokes.push_back({static_cast<EdgeClass>(best % kHidden),
                                    layers, points[k - 1], points[k]});
      }
      last = best;
    }
  }

  const Camera& camera_;
  const DrawingOptions& options_;
  ImageOptions section_;  ///< its clip planes and caps
  std::optional<Caps> caps_;
  Projection projection_;
  std::vector<Fragment> polygons_;
  std::vector<Fragment> all_polygons_;  ///< those that are culled, too
  std::vector<bool> are_culled_;
  std::vector<Plane> planes_;
  std::vector<std::optional<Covering>> coverings_;
  std::vector<int> eyes_;  ///< the sides of the planes that hold the eye
  std::vector<Edge> edges_;
  Drawing drawing_;
};

}  // namespace

Drawing draw(const Scene& scene, const Camera& camera,
             const DrawingOptions& options) {
  return Drawer(scene, camera, options).run();
}

}  // namespace halfspace::ref
