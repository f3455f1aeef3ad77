#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "camera/edge_function.hpp"
#include "camera/view.hpp"
#include "exact/exact_plane.hpp"
#include "exact/filter.hpp"
#include "exact/wide.hpp"
#include "halfspace/fast/predicate.hpp"
#include "halfspace/scene.hpp"

namespace halfspace::fast {

/// Numbers of a drawing. An end of an edge is (x, y, z) / w; on the line of two
/// clip planes x, y and z have 5n + 8 bits and w 4n + 3: 278 and 219 at most.
/// The longest function of a point is the near limit of a polygon: slopes of
/// 6n + 52 bits and an offset of 7n + 44, 376 and 422 at most, so that its
/// value there has 656.
using FormInt = Wide<7>;
using FormValue = Wide<11>;
using CutProduct = Wide<22>;  ///< of two such values

/// A linear function of homogeneous points.
struct Form {
  FormInt a, b, c, d;
  friend Form operator-(const Form& f) { return {-f.a, -f.b, -f.c, -f.d}; }
};

/// A point of space, exactly and in doubles.
struct SpacePoint {
  VertexId vertex = -1;  ///< the lowest vertex of the scene there, if one
  Wide<5> x, y, z;
  Wide<4> w = Wide<4>(1);  ///< positive
  Vertex near;             ///< the point in doubles
  // Its camera coordinates (View), and how far off they are.
  double across = 0;
  double down = 0;
  double depth = 0;
  double image_error = 0;
  double depth_error = 0;
};

FormValue value_at(const Form& form, const SpacePoint& p);

/// Whether a point is before another one by x, then y, then z.
bool is_before(const SpacePoint& p, const SpacePoint& q);

/// The camera of a drawing: what is seen of points, planes and edges.
class Sight {
 public:
  Sight(const Scene& scene, const Camera& camera);

  const Scene& scene() const { return scene_; }
  const View& view() const { return view_; }
  const CameraData& camera() const { return camera_; }
  FilterStats& stats() { return stats_; }

  SpacePoint point_of(VertexId vertex) const;
  /// A point by its homogeneous coordinates, w positive.
  SpacePoint point_of(const Wide<5>& x, const Wide<5>& y, const Wide<5>& z,
                      const Wide<4>& w) const;
  /// Where a plane crosses the side between two corners, one on either side.
  SpacePoint crossing(VertexId u, VertexId v, const Form& plane) const;

  /// The sign of a polygon's plane at the eye (S4.2).
  int eye_sign(PolygonId polygon);
  const FilterPlane& filter_plane(PolygonId polygon) const {
    return planes_[static_cast<std::size_t>(polygon)];
  }
  /// The value of a polygon's plane at a point, off by its error.
  Bounded plane_value(PolygonId polygon, const SpacePoint& p) const {
    return value_at(filter_plane(polygon), p.near, rounding_);
  }
  Form plane_form(PolygonId polygon) const;

  /// On which side of the plane through the eye and two points another one is:
  /// positive on the inner side of a polygon's side from `a` to `b` if the eye
  /// is on the polygon's positive side.
  Bounded side_value(const SpacePoint& a, const SpacePoint& b,
                     const SpacePoint& p) const;
  Form side_form(VertexId a, VertexId b) const;
  /// The plane through the eye and the line in which two polygons' planes meet.
  Form meet_form(PolygonId p, PolygonId q) const;

  /// On which side of another plane sight rays meet a polygon: positive where
  /// they do so on the positive side, if the eye is on the polygon's.
  Form cut_form(PolygonId polygon, const Form& other) const {
    return through_eye(plane_form(polygon), other);
  }
  /// The plane through the eye and the line in which two planes meet.
  Form meet_form_of(const Form& f, const Form& g) const {
    return through_eye(f, g);
  }
  /// The sign of a plane at the eye.
  int eye_side(const Form& plane) const { return sign(at_eye(plane)); }

  /// Positive at points whose sight rays meet a plane beyond the near limit,
  /// for an eye on its negative side and points that are not.
  Form near_form_of(const Form& plane) const {
    return -through_eye(plane, limits_[0]);
  }

  /// Positive at points whose sight rays meet a polygon beyond the near limit,
  /// if they meet it before the point (S4.3). Requires: there is a near limit,
  /// and eye_sign(polygon) != 0.
  Form near_form(PolygonId polygon) const;

  /// What is seen are the points at which none of these is negative, and the
  /// first is positive: beyond near, right of the left side, and so on. An
  /// orthographic view without a near limit has no first one.
  static constexpr int kLimits = 5;
  bool has_limit(int limit) const {
    return limit > 0 || camera_.perspective || camera_.near.has_value();
  }
  Bounded limit_value(int limit, const SpacePoint& p) const;
  const Form& limit_form(int limit) const {
    return limits_[static_cast<std::size_t>(limit)];
  }
  /// A point is seen at (x / w, y / w) by these.
  const Form& x_form() const { return x_; }
  const Form& y_form() const { return y_; }
  const Form& w_form() const { return w_; }

 private:
  FormValue at_eye(const Form& form) const;
  Form through_eye(const Form& plane, const Form& form) const;
  void set_doubles(SpacePoint& p) const;
  void make_forms();

  const Scene& scene_;
  const CameraData& camera_;
  View view_;
  double rounding_;
  std::vector<FilterPlane> planes_;
  Form x_, y_, w_, depth_;  ///< times one positive number
  std::array<Form, kLimits> limits_;
  FilterStats stats_;
};

}  // namespace halfspace::fast
