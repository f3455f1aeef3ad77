#include "halfspace/ref/visible_map.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <utility>

#include "covering.hpp"
#include "frames/caps.hpp"
#include "halfspace/cap_parts.hpp"
#include "halfspace/ref/clip.hpp"

namespace halfspace::ref {
namespace {

bool are_equal(const ImagePoint& p, const ImagePoint& q) {
  return p.x == q.x && p.y == q.y;
}
bool before(const ImagePoint& p, const ImagePoint& q) {
  return p.x == q.x ? p.y < q.y : p.x < q.x;
}

/// The line c + a x + b y = 0, scaled so that a, or else b, is 1: equal lines
/// are equal numbers.
struct Line {
  Rational a, b, c;
  friend bool operator==(const Line&, const Line&) = default;
};

std::optional<Line> line_of(const Affine& f) {
  const Rational& scale = sign(f.dx) != 0 ? f.dx : f.dy;
  if (sign(scale) == 0) return std::nullopt;
  return Line{f.dx / scale, f.dy / scale, f.value / scale};
}

std::optional<ImagePoint> meet(const Line& l, const Line& m) {
  const Rational w = l.a * m.b - l.b * m.a;
  if (sign(w) == 0) return std::nullopt;
  return ImagePoint{(l.b * m.c - l.c * m.b) / w, (l.c * m.a - l.a * m.c) / w};
}

/// The key of a cell, by the polygons that cover it from front to back.
using KeyOf = std::function<std::int32_t(const std::vector<PolygonId>&)>;

/// What the map is decided by (S7.1).
class Forms {
 public:
  Forms(const Scene& scene, const Camera& camera, bool cull, KeyOf key_of)
      : width_(camera->width_px),
        height_(camera->height_px),
        key_of_(std::move(key_of)) {
    for (PolygonId id = 0; id < static_cast<PolygonId>(scene.polygon_count());
         ++id)
      polygons_.push_back(covering_of(whole(scene, id), camera, cull));
  }

  /// Of what clip planes and caps leave.
  Forms(const Scene& scene, const Camera& camera, const ImageOptions& options,
        KeyOf key_of)
      : width_(camera->width_px),
        height_(camera->height_px),
        key_of_(std::move(key_of)),
        options_(options) {
    for (PolygonId id = 0; id < static_cast<PolygonId>(scene.polygon_count());
         ++id) {
      polygons_.emplace_back();
      const Fragment polygon = whole(scene, id);
      if (!is_there(plane_of(polygon.vertices), options)) continue;
      if (const auto left = clipped(polygon, options))
        polygons_.back() = covering_of(*left, camera, options.cull);
    }
    if (options.caps && !options.clips.empty())
      caps_.emplace(scene, camera, options, 1);
  }

  /// All lines that meet the image rectangle, each once.
  std::vector<Line> lines() const {
    std::vector<Line> lines = {
        {1, 0, 0}, {1, 0, -width_}, {0, 1, 0}, {0, 1, -height_}};
    const auto add = [&lines](const Affine& f) {
      const auto line = line_of(f);
      if (line && std::find(lines.begin(), lines.end(), *line) == lines.end())
        lines.push_back(*line);
    };
    for (std::size_t p = 0; p < polygons_.size(); ++p) {
      if (!polygons_[p]) continue;
      for (const Affine& inside : polygons_[p]->insides) add(inside);
      for (std::size_t q = 0; q < p; ++q) {
        if (polygons_[q]) add(polygons_[p]->nearness - polygons_[q]->nearness);
      }
    }
    if (caps_) {
      for (const Affine& form : caps_->forms()) add(form);
      for (std::size_t k = 0; k < caps_->count(); ++k) {
        for (const auto& polygon : polygons_) {
          if (polygon) add(nearness_of(caps_->plane(k)) - polygon->nearness);
        }
      }
      add_stripes(add);
    }
    return lines;
  }

  /// The key of what is seen right beside a point, in a direction from it: no
  /// line runs through the point in that direction.
  std::int32_t key_beside(const ImagePoint& p, const Rational& dx,
                          const Rational& dy) const {
    const auto is_inside = [](const Rational& at, const Rational& d,
                              std::int32_t size) {
      if (sign(at) == 0) return sign(d) > 0;
      if (at == Rational(size)) return sign(d) < 0;
      return sign(at) > 0 && at < Rational(size);
    };
    if (!is_inside(p.x, dx, width_) || !is_inside(p.y, dy, height_))
      return kOutsideKey;
    std::vector<PolygonId> covering;
    for (std::size_t q = 0; q < polygons_.size(); ++q) {
      if (!polygons_[q]) continue;
      const auto covers = [&](const Affine& f) {
        return sign_beside(f, p, dx, dy) > 0;
      };
      const auto& insides = polygons_[q]->insides;
      if (std::all_of(insides.begin(), insides.end(), covers))
        covering.push_back(static_cast<PolygonId>(q));
    }
    const auto nearness = [&](PolygonId id) -> const Affine& {
      return polygons_[static_cast<std::size_t>(id)]->nearness;
    };
    // Where polygons share a plane, the first stays in front.
    std::stable_sort(
        covering.begin(), covering.end(), [&](PolygonId f, PolygonId g) {
          return sign_beside(nearness(f) - nearness(g), p, dx, dy) > 0;
        });
    if (caps_) add_caps(p, dx, dy, covering);
    return key_of_(covering);
  }

  bool holds(const ImagePoint& p) const {
    return sign(p.x) >= 0 && p.x <= Rational(width_) && sign(p.y) >= 0 &&
           p.y <= Rational(height_);
  }

 private:
  /// The greater, the nearer, as that of Covering.
  static Affine nearness_of(const SeenPlane& plane) {
    const Rational scale =
        sign(plane.at_eye) == 0 ? Rational(0) : Rational(-1) / plane.at_eye;
    return scale * plane.at_image;
  }

  /// The lines at which hatching may begin and end: what has a period of 16
  /// pixels is at some of those of 8.
  template <class Add>
  void add_stripes(const Add& add) const {
    bool has_hatch = options_.caps->hatch.has_value();
    if (options_.parts) {
      for (const CapStyle& style : options_.parts->styles)
        has_hatch = has_hatch || style.hatch;
    }
    if (!has_hatch) return;
    const std::int32_t most = width_ + height_;
    for (std::int32_t start = -8 * (most / 8 + 1); start <= most; start += 8) {
      for (const std::int32_t at : {start, start + 2}) {
        add({Rational(-1) / Rational(2) - Rational(at), 1, 1});
        add({Rational(1) / Rational(2) - Rational(at), 1, -1});
      }
    }
  }

  /// Whether the point beside p is in a stripe of the cap's hatching.
  bool is_hatched(const CapItem& cap, const ImagePoint& p, const Rational& dx,
                  const Rational& dy) const {
    if (!style_of(options_, cap).hatch) return false;
    const CapStripes stripes = stripes_of(options_, cap);
    const Rational half = Rational(1) / Rational(2);
    return (stripes.by_sum &&
            is_in_stripe(p.x + p.y - half, dx + dy, stripes.period)) ||
           (stripes.by_difference &&
            is_in_stripe(p.x - p.y + half, dx - dy, stripes.period));
  }
  static bool is_in_stripe(Rational rest, const Rational& grows,
                           std::int32_t every) {
    // By steps: exact, and no division with rest is needed.
    const Rational period = every;
    while (rest >= period) rest = rest - period;
    while (sign(rest) < 0) rest = rest + period;
    if (sign(rest) == 0) return sign(grows) > 0;
    if (rest == Rational(2)) return sign(grows) < 0;
    return rest < Rational(2);
  }

  /// Puts the caps there among what covers the point beside p, as ids.
  void add_caps(const ImagePoint& p, const Rational& dx, const Rational& dy,
                std::vector<PolygonId>& covering) const {
    const auto sign_of = [&](const Affine& f) {
      return sign_beside(f, p, dx, dy);
    };
    const auto count = static_cast<std::int32_t>(polygons_.size());
    const auto nearness = [&](PolygonId id) {
      if (id < count) return polygons_[static_cast<std::size_t>(id)]->nearness;
      return nearness_of(
          caps_->plane(cap_item(static_cast<std::size_t>(id - count)).plane));
    };
    for (std::size_t k = 0; k < caps_->count(); ++k) {
      const auto part = caps_->part_at(k, sign_of);
      if (!part) continue;
      CapItem cap = {k, *part, false};
      cap.is_hatched = is_hatched(cap, p, dx, dy);
      const Affine own = nearness_of(caps_->plane(k));
      const auto behind = std::find_if(
          covering.begin(), covering.end(),
          [&](PolygonId id) { return sign_of(own - nearness(id)) > 0; });
      covering.insert(behind, count + number_of(cap));
    }
  }

  std::int32_t width_, height_;
  KeyOf key_of_;
  std::vector<std::optional<Covering>> polygons_;
  ImageOptions options_;
  std::optional<Caps> caps_;
};

/// The parts of one line at which keys differ, neighbours with the same keys
/// not yet joined.
std::vector<MapArc> parts_of(const Line& line, const std::vector<Line>& lines,
                             const Forms& forms) {
  std::vector<ImagePoint> points;
  for (const Line& other : lines) {
    const auto point = meet(line, other);
    if (point && forms.holds(*point)) points.push_back(*point);
  }
  std::sort(points.begin(), points.end(), before);
  points.erase(std::unique(points.begin(), points.end(), are_equal),
               points.end());
  std::vector<MapArc> parts;
  for (std::size_t k = 1; k < points.size(); ++k) {
    const ImagePoint& from = points[k - 1];
    const ImagePoint& to = points[k];
    const Rational half = Rational(1) / Rational(2);
    const ImagePoint middle = {half * (from.x + to.x), half * (from.y + to.y)};
    const Rational dx = to.x - from.x;
    const Rational dy = to.y - from.y;
    MapArc arc = {from, to, forms.key_beside(middle, dy, -dx),
                  forms.key_beside(middle, -dy, dx)};
    if (arc.left != arc.right) parts.push_back(std::move(arc));
  }
  return parts;
}

struct Before {
  bool operator()(const ImagePoint& p, const ImagePoint& q) const {
    return before(p, q);
  }
};

std::vector<MapArc> map_of(const Forms& forms) {
  const std::vector<Line> lines = forms.lines();
  // Step 1: cut every line where another one meets it; keep what has different
  // keys on its two sides.
  std::vector<std::vector<MapArc>> parts;
  std::map<ImagePoint, int, Before> ends;
  for (const Line& line : lines) {
    parts.push_back(parts_of(line, lines, forms));
    for (const MapArc& arc : parts.back()) {
      ++ends[arc.from];
      ++ends[arc.to];
    }
  }
  // Step 2: join two parts of one line where nothing else ends (S7.4).
  std::vector<MapArc> map;
  for (const std::vector<MapArc>& along : parts) {
    for (std::size_t k = 0; k < along.size(); ++k) {
      const bool goes_on = k > 0 && are_equal(along[k - 1].to, along[k].from) &&
                           ends[along[k].from] == 2;
      if (goes_on) {
        map.back().to = along[k].to;
      } else {
        map.push_back(along[k]);
      }
    }
  }
  std::sort(map.begin(), map.end(), [](const MapArc& f, const MapArc& g) {
    return are_equal(f.from, g.from) ? before(f.to, g.to)
                                     : before(f.from, g.from);
  });
  return map;
}

}  // namespace

std::vector<MapArc> visible_map(const Scene& scene, const Camera& camera,
                                const MapOptions& options) {
  return map_of(Forms(scene, camera, options.cull, [&](const auto& covering) {
    if (covering.empty()) return kBackgroundKey;
    const PolygonId front = covering.front();
    return options.keys.empty() ? front
                                : options.keys[static_cast<std::size_t>(front)];
  }));
}

std::vector<MapArc> transparent_map(const Scene& scene, const Camera& camera,
                                    const TransparentOptions& options) {
  return transparent_section(scene, camera, options, ImageOptions());
}

std::vector<MapArc> transparent_section(const Scene& scene,
                                        const Camera& camera,
                                        const TransparentOptions& options,
                                        const ImageOptions& section) {
  ImageOptions clips = section;
  clips.cull = options.cull;
  const auto count = static_cast<PolygonId>(scene.polygon_count());
  return map_of(Forms(scene, camera, clips, [&](const auto& covering) {
    if (covering.empty()) return kBackgroundKey;
    Rgb color = options.background;
    for (auto id = covering.rbegin(); id != covering.rend(); ++id) {
      if (*id < count) {
        color = composed_color(scene.color(*id), color, options.alpha_of(*id));
        continue;
      }
      const CapItem cap = cap_item(static_cast<std::size_t>(*id - count));
      color = composed_color(color_of(section, cap), color,
                             options.alpha_of_cap(cap.part));
    }
    return color_key(color);
  }));
}

std::vector<MapArc> section_map(const Scene& scene, const Camera& camera,
                                const ImageOptions& options) {
  return map_of(Forms(scene, camera, options, [](const auto& covering) {
    return covering.empty() ? kBackgroundKey : covering.front();
  }));
}

Rational area_of_key(const std::vector<MapArc>& map, std::int32_t key) {
  Rational twice = 0;
  for (const MapArc& arc : map) {
    const Rational part = arc.from.x * arc.to.y - arc.from.y * arc.to.x;
    if (arc.right == key) twice += part;
    if (arc.left == key) twice -= part;
  }
  return twice / Rational(2);
}

}  // namespace halfspace::ref
