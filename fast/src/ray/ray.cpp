#include "halfspace/fast/ray.hpp"

#include <algorithm>
#include <limits>

#include "halfspace/assert.hpp"
#include "halfspace/fast/image/lazy_tree.hpp"
#include "halfspace/fast/render.hpp"
#include "ray/ray_walk.hpp"
#include "ray/sample_ray.hpp"

namespace halfspace::fast {
namespace {

/// A ray parameter, exactly; the denominator is positive.
///
/// Bits, on the grid of 54: a normal has 2n + 1, a point from the origin n + 14
/// in lattice steps, so the numerator 3n + 17, 179 at most; the denominator
/// 3n + 16. A product of both has 357.
struct Parameter {
  Wide<4> numerator;
  Wide<4> denominator = 1;
};

int compare(const Parameter& a, const Parameter& b) {
  return sign(multiply<8>(a.numerator, b.denominator) -
              multiply<8>(b.numerator, a.denominator));
}

LatticeVector from(const LatticeVector& origin, const GridPoint& p) {
  constexpr Int128 kStep = Int128{1} << kLatticeBits;
  return {kStep * p.x - origin.x, kStep * p.y - origin.y,
          kStep * p.z - origin.z};
}

/// A ray against polygons, exactly (S8.2).
template <int kBits>
class ExactRay {
 public:
  ExactRay(const TreeReader& reader, const RayData& ray)
      : reader_(reader), ray_(ray) {}

  /// Where the ray meets the plane of a polygon, if within its reach.
  std::optional<Parameter> meet(PolygonId polygon) const {
    const auto plane = reader_.planes().template exact<kBits>(polygon);
    const auto along = [&](const LatticeVector& v) {
      return multiply<4>(Int128{plane.normal.x}, v.x) +
             multiply<4>(Int128{plane.normal.y}, v.y) +
             multiply<4>(Int128{plane.normal.z}, v.z);
    };
    Parameter t = {along(from(ray_.origin, plane.origin)),
                   along(ray_.direction)};
    const int direction = sign(t.denominator);
    if (direction == 0) return std::nullopt;
    if (direction < 0) t = {-t.numerator, -t.denominator};
    return reaches(t) ? std::optional(t) : std::nullopt;
  }

  /// Whether the ray passes within a polygon, or through its boundary; it does
  /// not run along its plane.
  ///
  /// Bits: direction . (p x q) has 2 (n + 14) + 1 and n + 13 and 2: 3n + 44.
  bool passes(PolygonId polygon) const {
    const auto corners = reader_.scene().corners(polygon);
    const LatticeVector& d = ray_.direction;
    LatticeVector p = from(ray_.origin, reader_.scene().point(corners.back()));
    bool some_left = false;
    bool some_right = false;
    for (const VertexId corner : corners) {
      const LatticeVector q = from(ray_.origin, reader_.scene().point(corner));
      const Wide<3> x = multiply<3>(p.y, q.z) - multiply<3>(p.z, q.y);
      const Wide<3> y = multiply<3>(p.z, q.x) - multiply<3>(p.x, q.z);
      const Wide<3> z = multiply<3>(p.x, q.y) - multiply<3>(p.y, q.x);
      const int side =
          sign(multiply<4>(d.x, x) + multiply<4>(d.y, y) + multiply<4>(d.z, z));
      some_left = some_left || side > 0;
      some_right = some_right || side < 0;
      if (some_left && some_right) return false;
      p = q;
    }
    return true;
  }

 private:
  bool reaches(const Parameter& t) const {
    const int after_begin = sign(t.numerator);
    const int before_end = sign(t.denominator - t.numerator);
    switch (ray_.reach) {
      case Reach::kRay:
        return after_begin >= 0;
      case Reach::kSegment:
        return after_begin >= 0 && before_end >= 0;
      case Reach::kBetween:
        return after_begin > 0 && before_end > 0;
      case Reach::kLine:
        return true;
    }
    return false;
  }

  const TreeReader& reader_;
  const RayData& ray_;
};

/// A polygon that a ray hits, or may hit.
struct Candidate {
  PolygonId polygon = kBackground;
  ParameterRange near;  ///< the parameter is in it
  bool is_exact = false;
  Parameter parameter;  ///< if it is
};

/// What a ray hits, and what it hits first: fragments are offered one by one.
template <int kBits>
class Hits {
 public:
  Hits(const TreeReader& reader, const RayLine& line, const RayData& ray,
       FilterStats& stats)
      : line_(line),
        exact_(reader, ray),
        is_between_(ray.reach == Reach::kSegment ||
                    ray.reach == Reach::kBetween),
        has_begin_(ray.reach != Reach::kLine),
        stats_(stats) {}

  /// The hit with a fragment of the reader's tree, if there is one nearer than
  /// `limit`.
  std::optional<Candidate> hit(const TreeReader& reader,
                               const TreeFragment& fragment, double limit) {
    const int passes = line_.passes(reader, fragment);
    if (passes < 0) {
      ++stats_.filtered;
      return std::nullopt;
    }
    Candidate found;
    found.polygon = fragment.source;
    const auto near =
        line_.meet(filter_plane(reader.planes().plane(fragment.source)));
    found.near = near.value_or(ParameterRange{-kInfinity, kInfinity});
    if (found.near.first > limit) return std::nullopt;
    const bool is_within = near && (!has_begin_ || near->first > 0) &&
                           (!is_between_ || near->last < 1);
    ++(is_within && passes > 0 ? stats_.filtered : stats_.exact);
    if (!is_within && !settle(found)) return std::nullopt;
    if (passes == 0) {
      // A ray along the plane passes within nothing.
      if (!settle(found) || !exact_.passes(fragment.source))
        return std::nullopt;
    }
    return found;
  }

  /// Makes the parameter exact; whether there is one.
  bool settle(Candidate& candidate) const {
    if (candidate.is_exact) return true;
    const auto parameter = exact_.meet(candidate.polygon);
    if (!parameter) return false;
    candidate.parameter = *parameter;
    candidate.is_exact = true;
    return true;
  }

  /// Whether `a` comes before `b` (S8.3).
  bool is_before(Candidate& a, Candidate& b) const {
    if (a.near.last < b.near.first) return true;
    if (b.near.last < a.near.first) return false;
    settle(a);
    settle(b);
    const int order = compare(a.parameter, b.parameter);
    return order != 0 ? order < 0 : a.polygon < b.polygon;
  }

 private:
  const RayLine& line_;
  ExactRay<kBits> exact_;
  bool is_between_;
  bool has_begin_;
  FilterStats& stats_;
};

RayHit to_hit(const Candidate& candidate) {
  return {candidate.polygon, candidate.parameter.numerator.words,
          candidate.parameter.denominator.words};
}

RayLine line_of(const RayData& ray, int grid_bits) {
  return RayLine(ray.origin, ray.direction, ray.reach, kLatticeBits, grid_bits);
}

/// The first hit; any hit where `any` will do.
template <int kBits, class Tree>
std::optional<Candidate> first_of(const Tree& tree, const RayData& ray,
                                  bool any, FilterStats& stats) {
  const RayLine line = line_of(ray, kBits);
  Hits<kBits> hits(tree.reader(), line, ray, stats);
  Candidate best;
  best.near = {kInfinity, kInfinity};
  const auto limit = [&] { return best.near.last; };
  tree.walk(line, limit,
            [&](const TreeReader& reader, const TreeFragment& fragment) {
              if (fragment.source == best.polygon) return;
              auto found = hits.hit(reader, fragment, limit());
              if (!found) return;
              if (best.polygon != kBackground && !hits.is_before(*found, best))
                return;
              best = *found;
              if (any) best.near.last = -kInfinity;
            });
  if (best.polygon == kBackground) return std::nullopt;
  hits.settle(best);
  return best;
}

template <class Tree>
std::optional<RayHit> first_hit_in(const Tree& tree, const Ray& ray,
                                   FilterStats& stats) {
  const auto found =
      with_grid(tree.reader().scene().grid_bits(), [&](auto bits) {
        return first_of<bits()>(tree, ray.data(), false, stats);
      });
  return found ? std::optional(to_hit(*found)) : std::nullopt;
}

template <class Tree>
std::vector<RayHit> all_hits_in(const Tree& tree, const Ray& ray) {
  const int grid_bits = tree.reader().scene().grid_bits();
  const RayLine line = line_of(ray.data(), grid_bits);
  std::vector<RayHit> result;
  with_grid(grid_bits, [&](auto bits) {
    FilterStats stats;
    Hits<bits()> hits(tree.reader(), line, ray.data(), stats);
    std::vector<Candidate> found;
    tree.walk(
        line, [] { return kInfinity; },
        [&](const TreeReader& reader, const TreeFragment& fragment) {
          auto hit = hits.hit(reader, fragment, kInfinity);
          if (!hit) return;
          hits.settle(*hit);
          found.push_back(*hit);
        });
    std::sort(found.begin(), found.end(),
              [&](const Candidate& a, const Candidate& b) {
                const int order = compare(a.parameter, b.parameter);
                return order != 0 ? order < 0 : a.polygon < b.polygon;
              });
    // A polygon is hit in each of its fragments that hold the point.
    for (const Candidate& hit : found) {
      if (result.empty() || result.back().polygon != hit.polygon)
        result.push_back(to_hit(hit));
    }
  });
  return result;
}

/// Requires: no caps.
template <class Tree>
PolygonId pick_in(const Tree& tree, const CameraData& camera,
                  const ImageOptions& options, std::int32_t i, std::int32_t j) {
  const int grid_bits = tree.reader().scene().grid_bits();
  const RayLine line = ray_of_centre(camera, i, j, grid_bits);
  return with_grid(grid_bits, [&](auto bits) {
    SampleRay<bits()> sample(tree.reader(), camera, options, i, j);
    double limit = kInfinity;
    tree.walk(
        line, [&] { return limit; },
        [&](const TreeReader& reader, const TreeFragment& fragment) {
          if (line.passes(reader, fragment) < 0) return;
          sample.offer(fragment.source);
          if (sample.seen() != fragment.source) return;
          const auto near =
              line.meet(filter_plane(reader.planes().plane(fragment.source)));
          limit = near ? near->last : kInfinity;
        });
    return sample.seen();
  });
}

template <class Tree>
bool see_each_other_in(const Tree& tree, const Ray& between) {
  HALFSPACE_ASSERT(between->reach == Reach::kBetween);
  FilterStats stats;
  return !with_grid(tree.reader().scene().grid_bits(), [&](auto bits) {
    return first_of<bits()>(tree, between.data(), true, stats);
  });
}

void require_pixel(const CameraData& camera, std::int32_t i, std::int32_t j) {
  HALFSPACE_ASSERT(0 <= i && i < camera.width_px);
  HALFSPACE_ASSERT(0 <= j && j < camera.height_px);
}

/// The image of one pixel, where what is seen need not be a polygon.
RenderOptions only(std::int32_t i, std::int32_t j) {
  RenderOptions one;
  one.rectangle = Rectangle{i, j, i + 1, j + 1};
  one.colors = false;
  return one;
}

}  // namespace

std::optional<RayHit> first_hit(const Scene& scene, const BspTree& tree,
                                const Ray& ray, FilterStats& stats) {
  return first_hit_in(BuiltTree(scene, tree), ray, stats);
}

std::optional<RayHit> first_hit(const Scene& scene, const BspTree& tree,
                                const Ray& ray) {
  FilterStats stats;
  return first_hit(scene, tree, ray, stats);
}

std::vector<RayHit> all_hits(const Scene& scene, const BspTree& tree,
                             const Ray& ray) {
  return all_hits_in(BuiltTree(scene, tree), ray);
}

PolygonId pick(const Scene& scene, const BspTree& tree, const Camera& camera,
               const ImageOptions& options, std::int32_t i, std::int32_t j) {
  require_pixel(camera.data(), i, j);
  if (options.caps)
    return render(scene, tree, camera, options, only(i, j))
        .items.pixels.front();
  return pick_in(BuiltTree(scene, tree), camera.data(), options, i, j);
}

bool see_each_other(const Scene& scene, const BspTree& tree,
                    const Ray& between) {
  return see_each_other_in(BuiltTree(scene, tree), between);
}

std::optional<RayHit> first_hit(const LazyTree& tree, const Ray& ray) {
  FilterStats stats;
  return first_hit_in(OpenedTree(tree), ray, stats);
}

std::vector<RayHit> all_hits(const LazyTree& tree, const Ray& ray) {
  return all_hits_in(OpenedTree(tree), ray);
}

PolygonId pick(const LazyTree& tree, const Camera& camera,
               const ImageOptions& options, std::int32_t i, std::int32_t j) {
  require_pixel(camera.data(), i, j);
  if (options.caps)
    return render(tree, camera, options, only(i, j)).items.pixels.front();
  return pick_in(OpenedTree(tree), camera.data(), options, i, j);
}

bool see_each_other(const LazyTree& tree, const Ray& between) {
  return see_each_other_in(OpenedTree(tree), between);
}

}  // namespace halfspace::fast
