#include <algorithm>
#include <array>
#include <limits>
#include <utility>
#include <vector>

#include "drawing/hiding.hpp"
#include "drawing/short_product.hpp"
#include "exact/big_rational.hpp"

/// What clip planes leave that hides given points (S9.8).
namespace halfspace::fast {

/// A polygon that one plane cuts is left on both sides of where it does, and
/// what others leave near there is decided by those that pass there, too.
bool Hiding::is_left_at(const SpacePoint& p, PolygonId polygon) const {
  int passing = 0;
  for (std::int32_t k = 0; k < clips_.count(); ++k) {
    if (!clips_.is_cut_by(polygon, k)) continue;
    const Form form = sight_.cut_form(polygon, clips_.form(k));
    const int side = eye_sign(polygon) * sign(value_at(form, p));
    if (side < 0) return false;
    if (side == 0) ++passing;
  }
  return passing < 2 || has_area_left(polygon);
}

bool Hiding::has_area_left(PolygonId polygon) const {
  using Corner = std::array<BigRational, 3>;
  std::vector<Corner> corners;
  for (const VertexId v : sight_.scene().corners(polygon)) {
    const GridPoint& g = sight_.scene().point(v);
    corners.push_back({BigRational(g.x), BigRational(g.y), BigRational(g.z)});
  }
  for (std::int32_t k = 0; k < clips_.count(); ++k) {
    const Form& form = clips_.form(k);
    const auto value = [&](const Corner& c) -> BigRational {
      return BigRational(to_big_integer(form.a)) * c[0] +
             BigRational(to_big_integer(form.b)) * c[1] +
             BigRational(to_big_integer(form.c)) * c[2] +
             BigRational(to_big_integer(form.d));
    };
    std::vector<Corner> left;
    bool any_positive = false;
    bool any_negative = false;
    for (std::size_t c = 0; c < corners.size(); ++c) {
      const Corner& a = corners[c];
      const Corner& b = corners[c + 1 == corners.size() ? 0 : c + 1];
      const BigRational f = value(a);
      const BigRational g = value(b);
      any_positive = any_positive || f > 0;
      any_negative = any_negative || f < 0;
      if (f >= 0) left.push_back(a);
      if ((f < 0 && g > 0) || (f > 0 && g < 0)) {
        const BigRational share = f / (f - g);
        const auto between = [&](std::size_t x) -> BigRational {
          return a[x] + share * (b[x] - a[x]);
        };
        left.push_back({between(0), between(1), between(2)});
      }
    }
    // What lies in the plane is not cut.
    if (any_negative && !any_positive) return false;
    corners.swap(left);
  }
  return true;
}

int Hiding::sign_at_sample(const Form& form, const SpacePoint& p) const {
  if (const int s = sign(value_at(form, p))) return s;
  const auto along = [&](const LatticeVector& v) {
    return sign(short_product<11>(form.a, Wide<2>(v.x)) +
                short_product<11>(form.b, Wide<2>(v.y)) +
                short_product<11>(form.c, Wide<2>(v.z)));
  };
  if (const int s = along(sight_.camera().sx)) return s;
  return along(sight_.camera().sy);
}

int Hiding::turns_at(const SpacePoint& p, std::int32_t cap, PolygonId polygon) {
  const int eye = eye_sign(polygon);
  const auto corners = sight_.scene().corners(polygon);
  for (std::size_t k = 0; k < corners.size(); ++k) {
    Bounded value;
    int side = side_sign(p, polygon, k, value);
    if (side == 0) {
      const VertexId v = corners[k + 1 == corners.size() ? 0 : k + 1];
      side = eye * sign_at_sample(sight_.side_form(corners[k], v), p);
    }
    if (side <= 0) return 0;
  }
  if (clips_.is_cut_by(polygon, cap)) {
    const Form form = sight_.cut_form(polygon, clips_.form(cap));
    if (cap_side(cap) * eye * sign_at_sample(form, p) <= 0) return 0;
  }
  return -eye;
}

bool Hiding::is_behind_cap(const SpacePoint& p, std::int32_t cap) {
  if (cap_side(cap) * sign(value_at(clips_.form(cap), p)) <= 0) return false;
  if (sight_.camera().near && sign_at_sample(cap_near_limit(cap), p) <= 0)
    return false;
  for (std::int32_t other = 0; other < clips_.count(); ++other) {
    if (other != cap && sign_at_sample(cap_limit(cap, other), p) <= 0)
      return false;
  }
  Box box = box_of(p);
  box.low[2] = std::numeric_limits<float>::lowest();
  box.high[2] = std::numeric_limits<float>::max();
  int winding = 0;
  cap_tree_->find(box, [&](std::int32_t polygon) {
    if (clips_.is_beyond(PolygonId{polygon}, cap))
      winding += turns_at(p, cap, PolygonId{polygon});
  });
  return winding > 0;
}

bool Hiding::is_behind_a_cap(const SpacePoint& p) {
  for (std::int32_t k = 0; k < clips_.count(); ++k) {
    if ((clips_.has_cap_in_front(k) || clips_.has_cap_behind(k)) &&
        is_behind_cap(p, k))
      return true;
  }
  return false;
}

}  // namespace halfspace::fast
