#include "rounding/flip_thin.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <unordered_map>
#include <unordered_set>

namespace halfspace::fast {
namespace {

StepPoint offset(const StepPoint& from, const StepPoint& to) {
  return {to[0] - from[0], to[1] - from[1], to[2] - from[2]};
}
double inner(const StepPoint& u, const StepPoint& v) {
  return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}

class ThinFlipper {
 public:
  ThinFlipper(GridMesh& mesh, std::span<const LoosePoint> loose,
              std::span<const std::int32_t> plane, double thin)
      : mesh_(mesh), plane_(plane), thin_(thin) {
    is_loose_.resize(mesh.points.size());
    places_.resize(mesh.points.size());
    for (std::size_t p = 0; p < places_.size(); ++p) {
      const GridPoint& at = mesh.points[p];
      places_[p] = {static_cast<double>(at.x), static_cast<double>(at.y),
                    static_cast<double>(at.z)};
    }
    for (const LoosePoint& p : loose) {
      is_loose_[static_cast<std::size_t>(p.point)] = 1;
      places_[static_cast<std::size_t>(p.point)] = p.at;
    }
  }

  std::vector<std::pair<std::int32_t, std::int32_t>> run() {
    std::vector<std::int32_t> todo;
    std::unordered_set<std::int32_t> planes;
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      const auto& c = mesh_.triangles[t].corners;
      if (std::none_of(c.begin(), c.end(), [&](std::int32_t p) {
            return is_loose_[static_cast<std::size_t>(p)] != 0;
          }))
        continue;
      if (shape_of(c).height >= thin_) continue;
      todo.push_back(static_cast<std::int32_t>(t));
      planes.insert(plane_[t]);
    }
    if (todo.empty()) return {};
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      if (planes.contains(plane_[t])) note_edges(static_cast<std::int32_t>(t));
    }
    // The lesser heights grow with each exchange; the bound is for doubles.
    std::size_t left = 64 * todo.size();
    while (!todo.empty() && left-- > 0) {
      const std::int32_t t = todo.back();
      todo.pop_back();
      flip(t, todo);
    }
    return std::move(flipped_);
  }

 private:
  using Corners = std::array<std::int32_t, 3>;
  /// The area, as a vector, twice; the least height; and at which corner it is.
  struct Shape {
    StepPoint normal;
    double height = 0;
    std::size_t apex = 0;
  };

  const StepPoint& at(std::int32_t p) const {
    return places_[static_cast<std::size_t>(p)];
  }
  Corners& corners(std::int32_t t) {
    return mesh_.triangles[static_cast<std::size_t>(t)].corners;
  }

  Shape shape_of(const Corners& c) const {
    const StepPoint u = offset(at(c[0]), at(c[1]));
    const StepPoint v = offset(at(c[0]), at(c[2]));
    Shape shape;
    shape.normal = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                    u[0] * v[1] - u[1] * v[0]};
    double longest = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const StepPoint edge = offset(at(c[i]), at(c[(i + 1) % 3]));
      const double length = std::sqrt(inner(edge, edge));
      if (length <= longest) continue;
      longest = length;
      shape.apex = (i + 2) % 3;
    }
    if (longest > 0)
      shape.height = std::sqrt(inner(shape.normal, shape.normal)) / longest;
    return shape;
  }

  static std::uint64_t key_of(std::int32_t from, std::int32_t to) {
    return static_cast<std::uint64_t>(static_cast<std::uint32_t>(from)) << 32 |
           static_cast<std::uint32_t>(to);
  }
  /// Of edges that a plane has twice none is exchanged.
  void note_edges(std::int32_t t) {
    const Corners& c = corners(t);
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [place, is_new] =
          of_edge_.try_emplace(key_of(c[i], c[(i + 1) % 3]), t);
      if (!is_new) place->second = kTwice;
    }
  }
  std::int32_t across(std::int32_t from, std::int32_t to) const {
    const auto found = of_edge_.find(key_of(to, from));
    return found == of_edge_.end() ? kTwice : found->second;
  }

  /// Exchanges the longest edge of a triangle, if that makes the lesser height
  /// of the two at the edge greater.
  void flip(std::int32_t t, std::vector<std::int32_t>& todo) {
    const Corners c = corners(t);
    const Shape own = shape_of(c);
    if (own.height >= thin_) return;
    const std::int32_t x = c[own.apex];
    const std::int32_t u = c[(own.apex + 1) % 3], v = c[(own.apex + 2) % 3];
    const std::int32_t other = across(u, v);
    if (other == kTwice || across(v, u) != t ||
        plane_[static_cast<std::size_t>(other)] !=
            plane_[static_cast<std::size_t>(t)])
      return;
    const Corners d = corners(other);
    const auto far = std::find_if(
        d.begin(), d.end(), [&](std::int32_t p) { return p != u && p != v; });
    if (far == d.end() || *far == x) return;
    const std::int32_t y = *far;
    if (of_edge_.contains(key_of(x, y)) || of_edge_.contains(key_of(y, x)))
      return;
    const Corners first = {x, u, y}, second = {y, v, x};
    const Shape old = shape_of(d), a = shape_of(first), b = shape_of(second);
    StepPoint normal = own.normal;
    for (std::size_t k = 0; k < 3; ++k) normal[k] += old.normal[k];
    if (inner(a.normal, normal) <= 0 || inner(b.normal, normal) <= 0) return;
    // Twice as high, for places are known to a share of a step.
    const double height = std::min(a.height, b.height);
    if (height <= 1 || height <= 2 * std::min(own.height, old.height)) return;
    of_edge_.erase(key_of(u, v));
    of_edge_.erase(key_of(v, u));
    corners(t) = first;
    corners(other) = second;
    for (const std::int32_t changed : {t, other}) {
      const Corners& now = corners(changed);
      for (std::size_t i = 0; i < 3; ++i)
        of_edge_[key_of(now[i], now[(i + 1) % 3])] = changed;
    }
    // Those beside them may find a better neighbour now.
    for (const Corners& now : {first, second}) {
      for (std::size_t i = 0; i < 3; ++i) {
        const std::int32_t beside = across(now[i], now[(i + 1) % 3]);
        if (beside != kTwice) todo.push_back(beside);
      }
    }
    flipped_.emplace_back(t, other);
  }

  static constexpr std::int32_t kTwice = -1;

  GridMesh& mesh_;
  std::span<const std::int32_t> plane_;
  double thin_;
  std::vector<std::uint8_t> is_loose_;
  std::vector<StepPoint> places_;
  std::unordered_map<std::uint64_t, std::int32_t> of_edge_;
  std::vector<std::pair<std::int32_t, std::int32_t>> flipped_;
};

}  // namespace

std::vector<std::pair<std::int32_t, std::int32_t>> flip_thin(
    GridMesh& mesh, std::span<const LoosePoint> loose,
    std::span<const std::int32_t> plane, double thin) {
  if (loose.empty()) return {};
  return ThinFlipper(mesh, loose, plane, thin).run();
}

}  // namespace halfspace::fast
