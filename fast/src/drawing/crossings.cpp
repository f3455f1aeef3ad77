#include "drawing/crossings.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "drawing/short_product.hpp"
#include "halfspace/fast/predicate.hpp"

namespace halfspace::fast {
namespace {

/// What a polygon has in common with the plane of another one: two points, and
/// whether the segment between them is a side of it.
struct Common {
  SpacePoint low;  ///< before `high` along the line of both planes
  SpacePoint high;
  bool is_side = false;
};

/// Looks for crossings.
class Crossings {
 public:
  Crossings(Sight& sight, const SceneEdges& edges,
            const std::vector<bool>& present)
      : sight_(sight),
        edges_(edges),
        present_(present),
        table_(intern_planes(sight.scene())) {}

  std::vector<Line> run() {
    const Scene& scene = sight_.scene();
    std::vector<std::int32_t> items;
    for (std::size_t p = 0; p < present_.size(); ++p) {
      if (present_[p]) items.push_back(static_cast<std::int32_t>(p));
    }
    const auto box_of = [&scene](std::int32_t p) {
      Bounds bounds;
      for (const VertexId v : scene.corners(p))
        bounds.add(to_vertex(scene.point(v)));
      return bounds.box();
    };
    const BoxTree tree(box_of, items);
    std::vector<PolygonId> others;
    for (const std::int32_t p : items) {
      others.clear();
      tree.find(box_of(p), [&](std::int32_t q) {
        if (q > p) others.push_back(q);
      });
      std::sort(others.begin(), others.end());
      for (const PolygonId q : others) add(p, q);
    }
    return std::move(lines_);
  }

 private:
  /// Both planes' values are affine along the line in which they meet; so is
  /// its direction's product with a point. Bits: a component of the direction
  /// has 4n + 3, so the product 8n + 10 and, with the other point's weight,
  /// 11n + 15: 609.
  void set_direction(PolygonId p, PolygonId q) {
    const Form f = sight_.plane_form(p);
    const Form g = sight_.plane_form(q);
    const auto minor = [](const FormInt& a, const FormInt& b, const FormInt& c,
                          const FormInt& d) {
      return short_product<7>(a, d) - short_product<7>(b, c);
    };
    direction_ = {minor(f.b, f.c, g.b, g.c),
                  minor(f.c, f.a, g.c, g.a),
                  minor(f.a, f.b, g.a, g.b),
                  {}};
    // Along it points are in the order of their coordinates.
    const int x = sign(direction_.a);
    const int y = sign(direction_.b);
    if ((x != 0 ? x : y != 0 ? y : sign(direction_.c)) < 0)
      direction_ = -direction_;
  }

  bool before(const SpacePoint& p, const SpacePoint& q) const {
    if (p.vertex >= 0 && p.vertex == q.vertex) return false;
    const FormValue f = value_at(direction_, p);
    const FormValue g = value_at(direction_, q);
    if (p.vertex >= 0 && q.vertex >= 0) return (f - g).is_negative();
    return (short_product<11>(f, q.w) - short_product<11>(g, p.w))
        .is_negative();
  }

  int side_of(PolygonId polygon, const SpacePoint& p) {
    const Bounded value = sight_.plane_value(polygon, p);
    if (const int known = filtered_sign(value)) {
      ++sight_.stats().filtered;
      return known;
    }
    ++sight_.stats().exact;
    return sign(value_at(sight_.plane_form(polygon), p));
  }

  /// The signs of another polygon's plane at the corners of `p`; whether they
  /// touch or cross the plane at more than one corner.
  bool signs_of(PolygonId p, PolygonId plane, std::vector<std::int8_t>& signs) {
    const auto corners = sight_.scene().corners(p);
    const auto others = sight_.scene().corners(plane);
    int positive = 0;
    int negative = 0;
    int on = 0;
    signs.clear();
    for (const VertexId v : corners) {
      const VertexId first = edges_.first_of(v);
      const auto is_shared = [&](VertexId other) {
        return edges_.first_of(other) == first;
      };
      const int side = std::any_of(others.begin(), others.end(), is_shared)
                           ? 0
                           : side_of(plane, sight_.point_of(first));
      signs.push_back(static_cast<std::int8_t>(side));
      (side > 0 ? positive : side < 0 ? negative : on) += 1;
    }
    return (positive > 0 && negative > 0) || on > 1;
  }

  std::optional<Common> common_of(PolygonId p, PolygonId plane,
                                  const std::vector<std::int8_t>& signs) {
    const auto corners = sight_.scene().corners(p);
    std::optional<Common> common;
    const auto extend = [&](const SpacePoint& point) {
      if (!common) {
        common = Common{point, point, false};
      } else if (before(point, common->low)) {
        common->low = point;
      } else if (before(common->high, point)) {
        common->high = point;
      }
    };
    bool any_positive = false;
    bool any_negative = false;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const std::size_t next = k + 1 == corners.size() ? 0 : k + 1;
      any_positive |= signs[k] > 0;
      any_negative |= signs[k] < 0;
      if (signs[k] == 0) {
        extend(sight_.point_of(edges_.first_of(corners[k])));
      } else if (signs[k] * signs[next] < 0) {
        extend(sight_.crossing(corners[k], corners[next],
                               sight_.plane_form(plane)));
      }
    }
    if (!common || !before(common->low, common->high)) return std::nullopt;
    common->is_side = !(any_positive && any_negative);
    return common;
  }

  void add(PolygonId p, PolygonId q) {
    if (table_.plane_of[static_cast<std::size_t>(p)] ==
        table_.plane_of[static_cast<std::size_t>(q)])
      return;
    if (!signs_of(p, q, p_signs_) || !signs_of(q, p, q_signs_)) return;
    set_direction(p, q);
    const auto f = common_of(p, q, p_signs_);
    if (!f) return;
    const auto g = common_of(q, p, q_signs_);
    if (!g || (f->is_side && g->is_side)) return;
    const SpacePoint& low = before(f->low, g->low) ? g->low : f->low;
    const SpacePoint& high = before(f->high, g->high) ? f->high : g->high;
    if (!before(low, high)) return;
    lines_.push_back({low, high, {p, q}, true});
  }

  Sight& sight_;
  const SceneEdges& edges_;
  const std::vector<bool>& present_;
  PlaneTable table_;
  Form direction_;
  std::vector<Line> lines_;
  std::vector<std::int8_t> p_signs_;
  std::vector<std::int8_t> q_signs_;
};

}  // namespace

std::vector<Line> crossings(Sight& sight, const SceneEdges& edges,
                            const std::vector<bool>& present) {
  return Crossings(sight, edges, present).run();
}

}  // namespace halfspace::fast
