#include "sah/polygon_split.hpp"

namespace halfspace::fast {
namespace {

/// A longer list is judged by a sample of this size. Untuned.
constexpr std::size_t kSample = 192;

struct Point2 {
  double u;
  double v;
};

/// The area of the part of the unit square on which a function is positive
/// that is affine and has these values at (0,0), (1,0), (1,1), (0,1).
double positive_area(const std::array<double, 4>& values) {
  constexpr std::array<Point2, 4> kCorners = {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  std::array<Point2, 8> outline;
  std::size_t count = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t next = (k + 1) % 4;
    if (values[k] > 0) outline[count++] = kCorners[k];
    if ((values[k] > 0) != (values[next] > 0)) {
      const double t = values[k] / (values[k] - values[next]);
      outline[count++] = {
          kCorners[k].u + t * (kCorners[next].u - kCorners[k].u),
          kCorners[k].v + t * (kCorners[next].v - kCorners[k].v)};
    }
  }
  double twice = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const Point2& p = outline[k];
    const Point2& q = outline[(k + 1) % count];
    twice += p.u * q.v - q.u * p.v;
  }
  return twice / 2;
}

/// The vertices of a sample of a list, in a row.
struct Sample {
  std::vector<std::array<double, 3>> points;
  std::vector<std::size_t> first = {0};
  const Primitive* largest = nullptr;
};

Sample sample_of(const PrimitiveReader& reader, const PrimitiveList& list) {
  Sample sample;
  const std::size_t count = std::min(list.count, kSample);
  sample.points.reserve(4 * count);
  sample.first.reserve(count + 1);
  double largest = -1;
  for (std::size_t i = 0; i < count; ++i) {
    const Primitive& primitive = list.primitives[i * list.count / count];
    reader.for_vertices(primitive, [&](double x, double y, double z) {
      sample.points.push_back({x, y, z});
    });
    sample.first.push_back(sample.points.size());
    const double size =
        half_surface(double{primitive.high[0]} - primitive.low[0],
                     double{primitive.high[1]} - primitive.low[1],
                     double{primitive.high[2]} - primitive.low[2]);
    if (size > largest) {
      largest = size;
      sample.largest = &primitive;
    }
  }
  return sample;
}

/// How many primitives of a sample have a part on either side.
struct Counts {
  double positive = 0;
  double negative = 0;
  double neither = 0;
};

Counts count_sides(const Sample& sample, const FilterPlane& plane,
                   double rounding) {
  Counts counts;
  const double doubt = plane.size * rounding;
  for (std::size_t i = 0; i + 1 < sample.first.size(); ++i) {
    bool positive = false;
    bool negative = false;
    for (std::size_t k = sample.first[i]; k < sample.first[i + 1]; ++k) {
      const auto& p = sample.points[k];
      const double value = plane.plane.a * p[0] + plane.plane.b * p[1] +
                           plane.plane.c * p[2] + plane.plane.d;
      positive = positive || value > doubt;
      negative = negative || value < -doubt;
    }
    counts.positive += positive ? 1 : 0;
    counts.negative += negative ? 1 : 0;
    counts.neither += positive || negative ? 0 : 1;
  }
  return counts;
}

double area_of(const PrimitiveReader& reader, const Primitive& primitive) {
  std::array<double, 3> first{};
  std::array<double, 3> last{};
  std::array<double, 3> twice{};
  std::size_t k = 0;
  reader.for_vertices(primitive, [&](double x, double y, double z) {
    if (k == 0) first = {x, y, z};
    const std::array<double, 3> here = {x - first[0], y - first[1],
                                        z - first[2]};
    twice[0] += last[1] * here[2] - last[2] * here[1];
    twice[1] += last[2] * here[0] - last[0] * here[2];
    twice[2] += last[0] * here[1] - last[1] * here[0];
    last = here;
    ++k;
  });
  return std::sqrt(twice[0] * twice[0] + twice[1] * twice[1] +
                   twice[2] * twice[2]) /
         2;
}

/// The probabilities that a ray through the box meets its parts on either side
/// of a plane: the ratios of their surfaces to its own (GS87).
struct HitProbabilities {
  double positive = 1;
  double negative = 1;
};

HitProbabilities hit_probabilities(const std::array<double, 3>& low,
                                   const std::array<double, 3>& high,
                                   const Plane& plane) {
  const std::array<double, 3> normal = {plane.a, plane.b, plane.c};
  // The area vectors of a closed surface add up to zero. So those of the
  // positive part's share of the box's faces give that of the section.
  double positive = 0;
  double whole = 0;
  std::array<double, 3> section{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t u = (axis + 1) % 3;
    const std::size_t v = (axis + 2) % 3;
    const double area = (high[u] - low[u]) * (high[v] - low[v]);
    for (const bool upper : {false, true}) {
      const double base = plane.d +
                          normal[axis] * (upper ? high[axis] : low[axis]) +
                          normal[u] * low[u] + normal[v] * low[v];
      const double du = normal[u] * (high[u] - low[u]);
      const double dv = normal[v] * (high[v] - low[v]);
      const double here =
          area * positive_area({base, base + du, base + du + dv, base + dv});
      positive += here;
      whole += area;
      section[axis] += upper ? here : -here;
    }
  }
  const double cut =
      std::sqrt(section[0] * section[0] + section[1] * section[1] +
                section[2] * section[2]);
  if (!(whole > 0)) return {};
  return {std::min(1.0, (positive + cut) / whole),
          std::min(1.0, (whole - positive + cut) / whole)};
}

}  // namespace

PolygonSplit best_polygon_split(const PrimitiveReader& reader,
                                const PrimitiveList& list, const Box& box,
                                const std::array<double, 3>& origin,
                                std::size_t tried, double cut_weight) {
  const Sample sample = sample_of(reader, list);
  const std::size_t sampled = sample.first.size() - 1;
  const double rounding = rounding_of_values(reader.scene.grid_bits());
  std::array<double, 3> low;
  std::array<double, 3> high;
  for (std::size_t a = 0; a < 3; ++a) {
    low[a] = origin[a] + double{box.low[a]};
    high[a] = origin[a] + double{box.high[a]};
  }
  const auto all = static_cast<double>(list.count);
  const double scale = all / static_cast<double>(sampled);
  PolygonSplit best;
  const std::size_t count = std::min(tried, list.count);
  for (std::size_t k = 0; k <= count; ++k) {
    // Spread over the list, then the largest.
    const Primitive& primitive =
        k < count ? list.primitives[(2 * k + 1) * list.count / (2 * count)]
                  : *sample.largest;
    const Plane plane = plane_of(reader.scene, primitive.source);
    const Counts counts = count_sides(sample, filter_plane(plane), rounding);
    const HitProbabilities hit = hit_probabilities(low, high, plane);
    const SplitCost cost = cost_of(
        all - counts.neither * scale, counts.positive * scale,
        counts.negative * scale, hit.positive, hit.negative, cut_weight);
    if (cost.cost < best.cost.cost) best = {cost, primitive.source};
  }
  return best;
}

double overdraw_of(const PrimitiveReader& reader, const PrimitiveList& list,
                   const Box& box) {
  const double shown = half_surface(double{box.high[0]} - box.low[0],
                                    double{box.high[1]} - box.low[1],
                                    double{box.high[2]} - box.low[2]) /
                       2;
  double area = 0;
  for (const Primitive& primitive : list)
    area += area_of(reader, primitive) / 2;
  if (!(shown > 0)) return 0;
  return area * area / shown;
}

double distinct_vertex_ratio(const PrimitiveReader& reader,
                             const PrimitiveList& list,
                             std::vector<VertexId>& scratch) {
  scratch.clear();
  for (const Primitive& primitive : list) {
    const auto corners = reader.scene.corners(primitive.source);
    scratch.insert(scratch.end(), corners.begin(), corners.end());
  }
  std::sort(scratch.begin(), scratch.end());
  const auto own = std::unique(scratch.begin(), scratch.end());
  return static_cast<double>(own - scratch.begin()) /
         static_cast<double>(scratch.size());
}

}  // namespace halfspace::fast
