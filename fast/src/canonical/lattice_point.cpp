#include "canonical/lattice_point.hpp"

#include <cstddef>
#include <utility>

#include "canonical/big_vector.hpp"

namespace halfspace::fast {
namespace {

using Big = BigInteger;
using Vector = BigVector;

void add(Vector& to, const Big& times, const Vector& vector) {
  for (std::size_t k = 0; k < 3; ++k) to[k] += times * vector[k];
}

/// Rounded down. Requires: b > 0.
Big quotient(const Big& a, const Big& b) {
  Big result = a / b;
  if (a < 0 && result * b != a) --result;
  return result;
}

/// The greatest common divisor g > 0 of a and b, and a x + b y = g.
struct Bezout {
  Big divisor, x, y;
};
Bezout bezout(const Big& a, const Big& b) {
  Bezout now = {a, 1, 0}, next = {b, 0, 1};
  while (next.divisor != 0) {
    const Big times = now.divisor / next.divisor;
    const Bezout rest = {now.divisor - times * next.divisor,
                         now.x - times * next.x, now.y - times * next.y};
    now = std::exchange(next, rest);
  }
  if (now.divisor < 0) {
    now.divisor = -now.divisor;
    now.x = -now.x;
    now.y = -now.y;
  }
  return now;
}

/// The points of integers with n x = d: one of them, and two vectors by which
/// they lie apart.
class PlaneLattice {
 public:
  /// Requires: n has no common divisor, and two components that are not 0.
  explicit PlaneLattice(const Vector& n) {
    i_ = n[0] == 0 ? 0 : n[1] == 0 ? 1 : n[2] == 0 ? 2 : 0;
    j_ = (i_ + 1) % 3;
    k_ = (i_ + 2) % 3;
    a_ = n[i_];
    pair_ = bezout(n[j_], n[k_]);
    u_[i_] = pair_.divisor;
    u_[j_] = -a_ * pair_.x;
    u_[k_] = -a_ * pair_.y;
    v_[j_] = n[k_] / pair_.divisor;
    v_[k_] = -n[j_] / pair_.divisor;
    reduce();
  }

  /// The one with n x = d that is nearest to the origin, and least of these.
  Vector nearest(const Big& d) const {
    const Vector some = any(d);
    const Big pu = dot(some, u_), pv = dot(some, v_);
    const Big below = uu_ * vv_ - uv_ * uv_;
    const Big s = quotient(pv * uv_ - pu * vv_, below);
    const Big t = quotient(pu * uv_ - pv * uu_, below);
    Vector best;
    Big least = -1;
    // Of a reduced basis no more are near.
    for (int p = -1; p <= 2; ++p) {
      for (int q = -1; q <= 2; ++q) {
        Vector x = some;
        add(x, s + p, u_);
        add(x, t + q, v_);
        const Big size = dot(x, x);
        if (least >= 0 && (size > least || (size == least && x > best)))
          continue;
        best = std::move(x);
        least = size;
      }
    }
    return best;
  }

 private:
  Vector any(const Big& d) const {
    Vector x;
    // a and the divisor have none in common.
    const Bezout with = bezout(a_, pair_.divisor);
    x[i_] = d * with.x % pair_.divisor;
    const Big rest = (d - a_ * x[i_]) / pair_.divisor;
    x[j_] = rest * pair_.x;
    x[k_] = rest * pair_.y;
    return x;
  }

  /// Makes the vectors as short as they can be.
  void reduce() {
    for (;;) {
      uu_ = dot(u_, u_);
      uv_ = dot(u_, v_);
      const Big times = quotient(2 * uv_ + uu_, 2 * uu_);
      add(v_, -times, u_);
      uv_ -= times * uu_;
      vv_ = dot(v_, v_);
      if (vv_ >= uu_) return;
      std::swap(u_, v_);
    }
  }

  std::size_t i_, j_, k_;
  Big a_;
  Bezout pair_;
  Vector u_, v_;
  Big uu_, uv_, vv_;
};

}  // namespace

std::optional<GridPoint> lattice_point(const Vector3<Int128>& normal,
                                       const BigInteger& offset) {
  const Vector n = to_big_vector(normal);
  Vector at;
  if (offset != 0) {
    const int zeros = int{n[0] == 0} + int{n[1] == 0} + int{n[2] == 0};
    if (zeros == 2) {
      for (std::size_t k = 0; k < 3; ++k) at[k] = n[k] * offset;
    } else {
      at = PlaneLattice(n).nearest(offset);
    }
  }
  const Big limit = Big(1) << 53;
  for (const Big& c : at) {
    if (c < -limit || c >= limit) return std::nullopt;
  }
  return GridPoint{at[0].convert_to<std::int64_t>(),
                   at[1].convert_to<std::int64_t>(),
                   at[2].convert_to<std::int64_t>()};
}

}  // namespace halfspace::fast
