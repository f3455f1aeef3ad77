#include "drawing/sight.hpp"

#include <algorithm>
#include <limits>

#include "drawing/short_product.hpp"
#include "exact/nearest_double.hpp"
#include "halfspace/fast/predicate.hpp"

namespace halfspace::fast {
namespace {

Wide<8> dot(const Vector3<Wide<8>>& u, const LatticeVector& v) {
  return short_product<8>(u.x, Wide<2>(v.x)) +
         short_product<8>(u.y, Wide<2>(v.y)) +
         short_product<8>(u.z, Wide<2>(v.z));
}

Vector3<Wide<8>> cross(const Vector3<Wide<4>>& u, const Vector3<Wide<4>>& v) {
  return {short_product<8>(u.y, v.z) - short_product<8>(u.z, v.y),
          short_product<8>(u.z, v.x) - short_product<8>(u.x, v.z),
          short_product<8>(u.x, v.y) - short_product<8>(u.y, v.x)};
}

Vector3<Wide<4>> wide(const LatticeVector& v) {
  return {Wide<4>(v.x), Wide<4>(v.y), Wide<4>(v.z)};
}

LatticeVector minus(const LatticeVector& u, const LatticeVector& v) {
  return {u.x - v.x, u.y - v.y, u.z - v.z};
}

constexpr Int128 kStep = Int128{1} << kLatticeBits;

Form scaled(const Form& f, Int128 factor) {
  const auto times = [factor](const FormInt& value) {
    return short_product<7>(value, Wide<2>(factor));
  };
  return {times(f.a), times(f.b), times(f.c), times(f.d)};
}

Form difference(const Form& f, const Form& g) {
  return {f.a - g.a, f.b - g.b, f.c - g.c, f.d - g.d};
}

}  // namespace

FormValue value_at(const Form& form, const SpacePoint& p) {
  // A vertex has coordinates of one word, and w is 1.
  if (p.vertex >= 0) {
    const auto word = [](const Wide<5>& value) {
      return Wide<2>(static_cast<std::int64_t>(value.words[0]));
    };
    return short_product<11>(form.a, word(p.x)) +
           short_product<11>(form.b, word(p.y)) +
           short_product<11>(form.c, word(p.z)) + FormValue(form.d);
  }
  return short_product<11>(form.a, p.x) + short_product<11>(form.b, p.y) +
         short_product<11>(form.c, p.z) + short_product<11>(form.d, p.w);
}

bool is_before(const SpacePoint& p, const SpacePoint& q) {
  const auto order = [&](const Wide<5>& a, const Wide<5>& b) {
    return sign(short_product<9>(a, q.w) - short_product<9>(b, p.w));
  };
  const int x = order(p.x, q.x);
  const int y = order(p.y, q.y);
  return (x != 0 ? x : y != 0 ? y : order(p.z, q.z)) < 0;
}

Sight::Sight(const Scene& scene, const Camera& camera)
    : scene_(scene),
      camera_(camera.data()),
      view_(make_view(camera, scene.grid_bits())),
      rounding_(rounding_of_values(scene.grid_bits())) {
  for (const Plane& plane : planes_of(scene))
    planes_.push_back(fast::filter_plane(plane));
  make_forms();
}

/// As make_view() has them, by Cramer's rule: a coordinate is
/// row.(256 p - origin) / determinant. The determinant's sign goes into the
/// rows.
void Sight::make_forms() {
  const CameraData& data = camera_;
  const LatticeVector origin = data.perspective ? data.eye : data.s0;
  const LatticeVector depth =
      data.perspective ? minus(data.s0, data.eye) : minus({}, data.eye);
  const Vector3<Wide<8>> across = cross(wide(data.sx), wide(data.sy));
  const Wide<8> determinant = dot(across, depth);
  const int orientation = sign(determinant);
  const auto coordinate = [&](const Vector3<Wide<8>>& row) {
    const auto slope = [&](const Wide<8>& value) {
      return FormInt(short_product<8>(value, Wide<2>(orientation * kStep)));
    };
    return Form{
        slope(row.x), slope(row.y), slope(row.z),
        FormInt(short_product<8>(dot(row, origin), Wide<2>(-orientation)))};
  };
  const Form one = {
      {}, {}, {}, FormInt(short_product<8>(determinant, Wide<2>(orientation)))};
  x_ = coordinate(cross(wide(data.sy), wide(depth)));
  y_ = coordinate(cross(wide(depth), wide(data.sx)));
  depth_ = coordinate(across);
  w_ = data.perspective ? depth_ : one;
  limits_[0] = difference(scaled(depth_, Int128{1} << kNearBits),
                          scaled(one, Int128{data.near.value_or(0)}));
  limits_[1] = x_;
  limits_[2] = difference(scaled(w_, Int128{data.width_px}), x_);
  limits_[3] = y_;
  limits_[4] = difference(scaled(w_, Int128{data.height_px}), y_);
}

void Sight::set_doubles(SpacePoint& p) const {
  const Vertex& v = p.near;
  p.across = view_.x.at(v.x, v.y, v.z);
  p.down = view_.y.at(v.x, v.y, v.z);
  p.depth = view_.t.at(v.x, v.y, v.z);
  p.image_error = view_.xy_error + view_.xy_growth * v.error;
  p.depth_error = view_.t_error + view_.t_growth * v.error;
}

SpacePoint Sight::point_of(VertexId vertex) const {
  const GridPoint& g = scene_.point(vertex);
  SpacePoint p;
  p.vertex = vertex;
  p.x = g.x;
  p.y = g.y;
  p.z = g.z;
  p.near = to_vertex(g);
  set_doubles(p);
  return p;
}

SpacePoint Sight::point_of(const Wide<5>& x, const Wide<5>& y, const Wide<5>& z,
                           const Wide<4>& w) const {
  SpacePoint p;
  p.x = x;
  p.y = y;
  p.z = z;
  p.w = w;
  const auto nearest = [&w](const Wide<5>& value) {
    bool rounded = false;
    return quotient(value, Wide<5>(w), rounded);
  };
  p.near = {nearest(x), nearest(y), nearest(z), 0};
  p.near.error =
      2 * kRounding *
      std::max({std::abs(p.near.x), std::abs(p.near.y), std::abs(p.near.z)});
  set_doubles(p);
  return p;
}

SpacePoint Sight::crossing(VertexId u, VertexId v, const Form& plane) const {
  // With the values f and g there it is (p (-g) + q f) / (f - g).
  const SpacePoint p = point_of(u);
  const SpacePoint q = point_of(v);
  Wide<4> f(value_at(plane, p));
  Wide<4> g(value_at(plane, q));
  if (f.is_negative()) {
    f = -f;
    g = -g;
  }
  const auto part = [&](const Wide<5>& a, const Wide<5>& b) {
    return short_product<5>(b, f) - short_product<5>(a, g);
  };
  return point_of(part(p.x, q.x), part(p.y, q.y), part(p.z, q.z), f - g);
}

int Sight::eye_sign(PolygonId polygon) {
  if (const int known =
          filtered_sign(view_.eye_value(filter_plane(polygon).plane))) {
    ++stats_.filtered;
    return known;
  }
  ++stats_.exact;
  return with_grid(scene_.grid_bits(), [&](auto bits) {
    return sign(
        projected(exact_plane<bits()>(plane_corners(scene_, polygon)), camera_)
            .eye);
  });
}

Form Sight::plane_form(PolygonId polygon) const {
  return with_grid(scene_.grid_bits(), [&](auto bits) {
    const auto plane = exact_plane<bits()>(plane_corners(scene_, polygon));
    return Form{FormInt(Int128{plane.normal.x}),
                FormInt(Int128{plane.normal.y}),
                FormInt(Int128{plane.normal.z}),
                FormInt(Wide<4>(value_at(plane, GridPoint{})))};
  });
}

/// In perspective det[b - e, a - e, p - e], else det[eye, b - a, p - a]: see
/// edge_function(). In doubles the determinant of the camera coordinates, whose
/// rows turn it by the camera's own.
///
/// With m and t bounding the sizes of image coordinates and depths and with
/// both errors among them, each of six products is at most m m t; it is off by
/// the share of each factor's error, and by 8u for the roundings.
Bounded Sight::side_value(const SpacePoint& a, const SpacePoint& b,
                          const SpacePoint& p) const {
  const double image_error =
      std::max({a.image_error, b.image_error, p.image_error});
  const int turn = -view_.orientation;
  if (!view_.perspective) {
    const double x = b.across - a.across;
    const double y = b.down - a.down;
    const double u = p.across - a.across;
    const double v = p.down - a.down;
    const double value = x * v - y * u;
    const double size = std::abs(x) + std::abs(y) + std::abs(u) + std::abs(v);
    const double error = 2 * image_error * (size + 4 * image_error) +
                         8 * kRounding * (std::abs(x * v) + std::abs(y * u));
    return {turn * value, error * (1 + 0x1p-40)};
  }
  const double depth_error =
      std::max({a.depth_error, b.depth_error, p.depth_error});
  const auto size_of_image = [image_error](const SpacePoint& q) {
    return std::max(std::abs(q.across), std::abs(q.down)) + image_error;
  };
  const auto size_of_depth = [depth_error](const SpacePoint& q) {
    return std::abs(q.depth) + depth_error;
  };
  const double value = a.across * (b.down * p.depth - b.depth * p.down) -
                       a.down * (b.across * p.depth - b.depth * p.across) +
                       a.depth * (b.across * p.down - b.down * p.across);
  const double ma = size_of_image(a), mb = size_of_image(b),
               mp = size_of_image(p);
  const double ta = size_of_depth(a), tb = size_of_depth(b),
               tp = size_of_depth(p);
  const double products = 2 * (ma * mb * tp + ma * mp * tb + mb * mp * ta);
  const double slopes =
      2 * image_error * ((ma + mb) * tp + (ma + mp) * tb + (mb + mp) * ta) +
      2 * depth_error * (ma * mb + ma * mp + mb * mp);
  return {turn * value, (slopes + 8 * kRounding * products) * (1 + 0x1p-40)};
}

Form Sight::side_form(VertexId a, VertexId b) const {
  const auto lattice = [&](VertexId vertex) {
    const GridPoint& g = scene_.point(vertex);
    return LatticeVector{kStep * g.x, kStep * g.y, kStep * g.z};
  };
  const LatticeVector from = lattice(a);
  const LatticeVector to = lattice(b);
  const bool perspective = camera_.perspective;
  const Vector3<Wide<8>> normal =
      perspective
          ? cross(wide(minus(to, camera_.eye)), wide(minus(from, camera_.eye)))
          : cross(wide(camera_.eye), wide(minus(to, from)));
  const auto slope = [](const Wide<8>& value) {
    return short_product<7>(value, Wide<2>(kStep));
  };
  return {slope(normal.x), slope(normal.y), slope(normal.z),
          -FormInt(dot(normal, perspective ? camera_.eye : from))};
}

FormValue Sight::at_eye(const Form& form) const {
  const FormValue along = short_product<11>(form.a, Wide<2>(camera_.eye.x)) +
                          short_product<11>(form.b, Wide<2>(camera_.eye.y)) +
                          short_product<11>(form.c, Wide<2>(camera_.eye.z));
  return camera_.perspective ? along + short_product<11>(form.d, Wide<2>(kStep))
                             : along;
}

/// P(e) f - f(e) P is 0 at the eye, for a form f.
Form Sight::through_eye(const Form& plane, const Form& form) const {
  const FormValue p = at_eye(plane);
  const FormValue f = at_eye(form);
  const auto part = [&](const FormInt& a, const FormInt& b) {
    return FormInt(short_product<11>(p, a) - short_product<11>(f, b));
  };
  return {part(form.a, plane.a), part(form.b, plane.b), part(form.c, plane.c),
          part(form.d, plane.d)};
}

Form Sight::meet_form(PolygonId p, PolygonId q) const {
  return through_eye(plane_form(p), plane_form(q));
}

/// With the limit's value N and the plane's P, P(e) N - N(e) P is P(e) N(y) at
/// the point y of P on the ray.
Form Sight::near_form(PolygonId polygon) const {
  const Form plane = plane_form(polygon);
  const Form form = through_eye(plane, limits_[0]);
  return sign(at_eye(plane)) < 0 ? -form : form;
}

Bounded Sight::limit_value(int limit, const SpacePoint& p) const {
  const double w = view_.perspective ? p.depth : 1;
  const double w_error = view_.perspective ? p.depth_error : 0;
  const auto strip = [&](double size, double at) {
    return Bounded{size * w - at,
                   (size * w_error + p.image_error +
                    4 * kRounding * (std::abs(size * w) + std::abs(at))) *
                       (1 + 0x1p-40)};
  };
  switch (limit) {
    case 0:
      return {p.depth - view_.near,
              (p.depth_error +
               4 * kRounding * (std::abs(p.depth) + std::abs(view_.near))) *
                  (1 + 0x1p-40)};
    case 1:
      return {p.across, p.image_error};
    case 2:
      return strip(camera_.width_px, p.across);
    case 3:
      return {p.down, p.image_error};
    default:
      return strip(camera_.height_px, p.down);
  }
}

}  // namespace halfspace::fast
