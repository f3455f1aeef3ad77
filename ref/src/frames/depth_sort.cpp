#include "halfspace/ref/depth_sort.hpp"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "../vector.hpp"
#include "halfspace/assert.hpp"
#include "halfspace/ref/behind.hpp"
#include "halfspace/ref/projection.hpp"
#include "halfspace/ref/split.hpp"

namespace halfspace::ref {
namespace {

/// A closed run of numbers.
struct Extent {
  Rational least, greatest;
};

/// How far an image reaches.
struct ImageExtents {
  Extent x, y;
};

/// A fragment that is not listed yet.
struct Unlisted {
  Fragment fragment;
  Extent depth;
  std::optional<ImageExtents> image;  ///< unless it reaches behind the eye
  bool is_marked = false;
};

Extent extent_of(const std::vector<Rational>& values) {
  const auto [least, greatest] =
      std::minmax_element(values.begin(), values.end());
  return {*least, *greatest};
}

Extent extent_of(const Fragment& fragment, const Plane& function) {
  std::vector<Rational> values;
  for (const Point& vertex : fragment.vertices)
    values.push_back(value_at(function, vertex));
  return extent_of(values);
}

/// The ray parameter, but for a positive factor and a constant (S4.3).
Plane depth_of(const Camera& camera) {
  const Point across = cross(to_point(camera->sx), to_point(camera->sy));
  const Point eye = to_point(camera->eye);
  const Point along = camera->perspective
                          ? difference(to_point(camera->s0), eye)
                          : difference({0, 0, 0}, eye);
  const Rational turn = sign(dot(across, along));
  return {turn * across.x, turn * across.y, turn * across.z, 0};
}

class Sorter {
 public:
  Sorter(const Scene& scene, const Camera& camera)
      : planes_(planes_of(scene)),
        camera_(camera),
        projection_(projection_of(camera)),
        depth_(depth_of(camera)) {
    for (std::size_t p = 0; p < scene.polygon_count(); ++p) {
      const Fragment polygon = whole(scene, static_cast<PolygonId>(p));
      // What is in a plane through the eye, in one that no ray meets, or behind
      // the eye, covers nothing.
      const Side eye = eye_side(polygon);
      if (eye == Side::kOn) continue;
      const Side far =
          eye == Side::kPositive ? Side::kNegative : Side::kPositive;
      if (ref::is_behind(plane(polygon), camera, far)) continue;
      const Extent w = extent_of(polygon, projection_.w);
      if (sign(w.greatest) <= 0) continue;
      add(polygon);
    }
    sort();
  }

  DepthSort run() {
    while (!unlisted_.empty()) {
      const std::optional<std::size_t> q = in_the_way();
      if (!q) {
        listed_.push_back(std::move(unlisted_.back().fragment));
        unlisted_.pop_back();
      } else if (!unlisted_[*q].is_marked && is_behind_last(*q)) {
        move_to_end(*q);
      } else {
        cut_a_cycle(*q);
      }
    }
    return {chain(), moves_, cuts_};
  }

 private:
  const Plane& plane(const Fragment& fragment) const {
    return planes_[static_cast<std::size_t>(fragment.source)];
  }
  Side eye_side(const Fragment& fragment) const {
    return side_of_eye(plane(fragment), camera_);
  }

  void add(Fragment fragment) {
    const Extent depth = extent_of(fragment, depth_);
    std::optional<ImageExtents> image = image_extents_of(fragment);
    unlisted_.push_back({std::move(fragment), depth, std::move(image)});
  }

  void sort() {
    std::stable_sort(unlisted_.begin(), unlisted_.end(),
                     [](const Unlisted& a, const Unlisted& b) {
                       return a.depth.greatest < b.depth.greatest;
                     });
  }

  /// Whether `p` is on the far side of `q`'s plane, or in it and not lower.
  bool is_behind(const Fragment& p, const Fragment& q) const {
    const Relation relation = ref::relation(p, plane(q));
    if (relation == Relation::kCoincident) return p.source >= q.source;
    return relation == (eye_side(q) == Side::kPositive ? Relation::kNegative
                                                       : Relation::kPositive);
  }

  /// Whether `q` is on the eye's side of `p`'s plane.
  bool is_before(const Fragment& q, const Fragment& p) const {
    return ref::relation(q, plane(p)) == (eye_side(p) == Side::kPositive
                                              ? Relation::kPositive
                                              : Relation::kNegative);
  }

  std::optional<ImageExtents> image_extents_of(const Fragment& fragment) const {
    if (sign(extent_of(fragment, projection_.w).least) <= 0)
      return std::nullopt;
    std::vector<Rational> x, y;
    for (const Point& vertex : fragment.vertices) {
      const ImagePoint point = image_of(vertex, projection_);
      x.push_back(point.x);
      y.push_back(point.y);
    }
    return ImageExtents{extent_of(x), extent_of(y)};
  }

  /// Whether the images have no common x or no common y, inner points' that is.
  static bool have_apart_extents(const Unlisted& p, const Unlisted& q) {
    if (!p.image || !q.image) return false;
    const auto are_apart = [](const Extent& a, const Extent& b) {
      return a.greatest <= b.least || b.greatest <= a.least;
    };
    return are_apart(p.image->x, q.image->x) ||
           are_apart(p.image->y, q.image->y);
  }

  /// The plane through the eye and two points.
  Plane sight(const Point& u, const Point& v) const {
    const Rational scale = 1 << kLatticeBits;
    const Point eye = to_point(camera_->eye);
    const Point to_u =
        camera_->perspective
            ? difference({scale * u.x, scale * u.y, scale * u.z}, eye)
            : eye;
    return plane_through(cross(to_u, difference(v, u)), u);
  }

  /// Whether a plane through the eye and two of the vertices separates them.
  bool have_apart_images(const Fragment& p, const Fragment& q) const {
    std::vector<Point> points = p.vertices;
    points.insert(points.end(), q.vertices.begin(), q.vertices.end());
    for (const Point& u : points) {
      for (const Point& v : points) {
        const Plane plane = sight(u, v);
        if (normal_of(plane) == Point{0, 0, 0}) continue;
        if (relation(p, plane) == Relation::kPositive &&
            relation(q, plane) == Relation::kNegative)
          return true;
      }
    }
    return false;
  }

  /// Step 1: whether `p` may be listed before `q`.
  bool may_precede(const Unlisted& p, const Unlisted& q) const {
    return q.depth.greatest < p.depth.least || have_apart_extents(p, q) ||
           is_behind(p.fragment, q.fragment) ||
           is_before(q.fragment, p.fragment) ||
           have_apart_images(p.fragment, q.fragment);
  }

  /// Step 2: a fragment that the last one may hide.
  std::optional<std::size_t> in_the_way() const {
    for (std::size_t q = unlisted_.size() - 1; q-- > 0;) {
      if (!may_precede(unlisted_.back(), unlisted_[q])) return q;
    }
    return std::nullopt;
  }

  bool is_behind_last(std::size_t q) const {
    const Fragment& p = unlisted_.back().fragment;
    return is_behind(unlisted_[q].fragment, p) ||
           is_before(p, unlisted_[q].fragment);
  }

  /// Step 3.
  void move_to_end(std::size_t q) {
    const auto place = unlisted_.begin() + static_cast<std::ptrdiff_t>(q);
    place->is_marked = true;
    std::rotate(place, place + 1, unlisted_.end());
    ++moves_;
  }

  /// Step 4.
  void cut_a_cycle(std::size_t q) {
    const std::size_t p = unlisted_.size() - 1;
    if (cut(p, q) || cut(q, p)) return;
    for (std::size_t a = 0; a <= p; ++a) {
      for (std::size_t b = 0; b <= p; ++b) {
        if (unlisted_[a].is_marked && unlisted_[b].is_marked && cut(a, b))
          return;
      }
    }
    HALFSPACE_ASSERT(false && "a cycle has something to cut");
  }

  /// Cuts fragment `a` by the plane of `b`, if it spans that.
  bool cut(std::size_t a, std::size_t b) {
    const Fragment& by = unlisted_[b].fragment;
    if (relation(unlisted_[a].fragment, plane(by)) != Relation::kSpanning)
      return false;
    SplitResult parts = split(unlisted_[a].fragment, plane(by), by.source);
    unlisted_.erase(unlisted_.begin() + static_cast<std::ptrdiff_t>(a));
    add(std::move(parts.positive));
    add(std::move(parts.negative));
    for (Unlisted& each : unlisted_) each.is_marked = false;
    sort();
    ++cuts_;
    return true;
  }

  /// The list as a tree: each fragment's node is the far child of the one in
  /// front of it.
  BspTree chain() const {
    BspTree tree;
    for (auto it = listed_.rbegin(); it != listed_.rend(); ++it) {
      Node node;
      node.splitter = it->source;
      node.plane = plane(*it);
      node.coincident = {*it};
      if (it + 1 != listed_.rend()) {
        (eye_side(*it) == Side::kPositive ? node.negative : node.positive) =
            static_cast<NodeId>(tree.nodes.size()) + 1;
      }
      tree.nodes.push_back(std::move(node));
    }
    return tree;
  }

  const std::vector<Plane> planes_;
  const Camera& camera_;
  const Projection projection_;
  const Plane depth_;
  std::vector<Unlisted> unlisted_;
  std::vector<Fragment> listed_;  ///< back to front
  std::size_t moves_ = 0;
  std::size_t cuts_ = 0;
};

}  // namespace

DepthSort depth_sort(const Scene& scene, const Camera& camera) {
  return Sorter(scene, camera).run();
}

}  // namespace halfspace::ref
