#include "halfspace/csg/measure.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <tuple>

namespace halfspace::csg {
namespace {

using Vector = std::array<double, 3>;

Vector difference(const Vector& a, const Vector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
          a[0] * b[1] - a[1] * b[0]};
}

double dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

constexpr std::size_t kNone = SIZE_MAX;

/// The corners of a scene, each with the edge that begins there.
class Corners {
 public:
  explicit Corners(const Scene& scene);

  std::size_t count() const { return scene_.data().corners.size(); }
  std::size_t polygon_of(std::size_t corner) const { return polygon_[corner]; }
  /// The corner after this one in its polygon.
  std::size_t next(std::size_t corner) const;
  /// The corner of the reverse edge, or kNone.
  std::size_t twin(std::size_t corner) const { return twin_[corner]; }
  /// Whether the edge has exactly two polygons.
  bool is_plain(std::size_t corner) const { return is_plain_[corner] != 0; }

 private:
  const Scene& scene_;
  std::vector<std::size_t> polygon_;
  std::vector<std::size_t> twin_;
  std::vector<std::uint8_t> is_plain_;
};

std::size_t Corners::next(std::size_t corner) const {
  const auto& first = scene_.data().first_corner;
  const std::size_t polygon = polygon_[corner];
  return corner + 1 < first[polygon + 1] ? corner + 1 : first[polygon];
}

/// Equal points are one, whatever their ids.
std::vector<VertexId> first_ids(const Scene& scene) {
  const auto& vertices = scene.data().vertices;
  std::vector<std::size_t> order(vertices.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::tie(vertices[a], a) < std::tie(vertices[b], b);
  });
  std::vector<VertexId> first(vertices.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool is_new = i == 0 || vertices[order[i]] != vertices[order[i - 1]];
    first[order[i]] =
        is_new ? static_cast<VertexId>(order[i]) : first[order[i - 1]];
  }
  return first;
}

Corners::Corners(const Scene& scene)
    : scene_(scene),
      polygon_(count()),
      twin_(count(), kNone),
      is_plain_(count()) {
  const std::vector<VertexId> ids = first_ids(scene);
  const auto& data = scene.data();
  for (std::size_t p = 0; p + 1 < data.first_corner.size(); ++p) {
    std::fill(polygon_.begin() + data.first_corner[p],
              polygon_.begin() + data.first_corner[p + 1], p);
  }
  struct Edge {
    VertexId low, high;
    bool is_down;  // from high to low
    std::size_t corner;
  };
  std::vector<Edge> edges;
  for (std::size_t c = 0; c < count(); ++c) {
    const VertexId from = ids[static_cast<std::size_t>(data.corners[c])];
    const VertexId to = ids[static_cast<std::size_t>(data.corners[next(c)])];
    edges.push_back({std::min(from, to), std::max(from, to), from > to, c});
  }
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
    return std::tie(a.low, a.high, a.is_down, a.corner) <
           std::tie(b.low, b.high, b.is_down, b.corner);
  });
  for (std::size_t i = 0; i < edges.size();) {
    std::size_t end = i;
    while (end < edges.size() && edges[end].low == edges[i].low &&
           edges[end].high == edges[i].high)
      ++end;
    const auto down = static_cast<std::size_t>(
        std::find_if(edges.begin() + static_cast<std::ptrdiff_t>(i),
                     edges.begin() + static_cast<std::ptrdiff_t>(end),
                     [](const Edge& edge) { return edge.is_down; }) -
        edges.begin());
    for (std::size_t k = 0; i + k < down && down + k < end; ++k) {
      const std::size_t a = edges[i + k].corner, b = edges[down + k].corner;
      twin_[a] = b;
      twin_[b] = a;
      is_plain_[a] = is_plain_[b] = end - i == 2;
    }
    i = end;
  }
}

/// The component of each polygon.
std::vector<std::size_t> components_of(const Corners& corners,
                                       const Scene& scene, std::size_t& count) {
  std::vector<std::size_t> component(scene.polygon_count(), kNone);
  std::vector<std::size_t> waiting;
  const auto& first = scene.data().first_corner;
  count = 0;
  for (std::size_t p = 0; p < component.size(); ++p) {
    if (component[p] != kNone) continue;
    component[p] = count;
    waiting.push_back(p);
    while (!waiting.empty()) {
      const std::size_t at = waiting.back();
      waiting.pop_back();
      for (std::size_t c = first[at]; c < first[at + 1]; ++c) {
        if (corners.twin(c) == kNone) continue;
        const std::size_t other = corners.polygon_of(corners.twin(c));
        if (component[other] != kNone) continue;
        component[other] = count;
        waiting.push_back(other);
      }
    }
    ++count;
  }
  return component;
}

/// Counts vertices less edges and faces (Euler), by component; nothing where
/// an edge has not exactly two polygons.
void set_genera(const Corners& corners,
                const std::vector<std::size_t>& component,
                std::vector<Component>& components) {
  std::vector<std::int64_t> euler(components.size());
  std::vector<std::uint8_t> is_plain(components.size(), 1);
  for (const std::size_t c : component) ++euler[c];
  for (std::size_t c = 0; c < corners.count(); ++c) {
    const std::size_t of = component[corners.polygon_of(c)];
    if (!corners.is_plain(c)) is_plain[of] = 0;
    if (corners.is_plain(c) && c < corners.twin(c)) --euler[of];
  }
  std::vector<std::uint8_t> is_seen(corners.count());
  for (std::size_t c = 0; c < corners.count(); ++c) {
    const std::size_t of = component[corners.polygon_of(c)];
    if (is_seen[c] != 0 || is_plain[of] == 0) continue;
    ++euler[of];
    // Round the vertex: across the edge, and on to the next one.
    for (std::size_t at = c; is_seen[at] == 0;
         at = corners.next(corners.twin(at)))
      is_seen[at] = 1;
  }
  for (std::size_t c = 0; c < components.size(); ++c) {
    if (is_plain[c] != 0) components[c].genus = (2 - euler[c]) / 2;
  }
}

}  // namespace

Measures measures_of(const Scene& scene) {
  Measures all;
  const auto& data = scene.data();
  if (scene.polygon_count() == 0) return all;
  all.unit = scene.unit();
  const auto exact = [&](std::size_t corner) {
    const GridPoint& p = scene.point(data.corners[corner]);
    return Vector{static_cast<double>(p.x), static_cast<double>(p.y),
                  static_cast<double>(p.z)};
  };
  all.least = all.most = exact(0);
  for (std::size_t c = 0; c < data.corners.size(); ++c) {
    const Vector point = exact(c);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      all.least[axis] = std::min(all.least[axis], point[axis]);
      all.most[axis] = std::max(all.most[axis], point[axis]);
    }
  }
  Vector middle;
  for (std::size_t axis = 0; axis < 3; ++axis)
    middle[axis] = all.least[axis] / 2 + all.most[axis] / 2;
  const Corners corners(scene);
  std::size_t count = 0;
  const auto component = components_of(corners, scene, count);
  all.components.resize(count);
  Vector by_volume{}, by_area{};
  for (std::size_t p = 0; p < scene.polygon_count(); ++p) {
    Component& part = all.components[component[p]];
    ++part.polygons;
    const Vector a = difference(exact(data.first_corner[p]), middle);
    for (std::size_t c = data.first_corner[p] + 2; c < data.first_corner[p + 1];
         ++c) {
      const Vector b = difference(exact(c - 1), middle);
      const Vector d = difference(exact(c), middle);
      const Vector normal = cross(difference(b, a), difference(d, a));
      const double area = std::sqrt(dot(normal, normal)) / 2;
      const double volume = dot(a, cross(b, d)) / 6;
      all.area += area;
      all.volume += volume;
      part.volume += volume;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double sum = a[axis] + b[axis] + d[axis];
        by_volume[axis] += volume * sum / 4;
        by_area[axis] += area * sum / 3;
      }
    }
  }
  set_genera(corners, component, all.components);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double from_middle = all.volume != 0 ? by_volume[axis] / all.volume
                                               : by_area[axis] / all.area;
    all.centre[axis] = middle[axis] + from_middle;
  }
  return all;
}

}  // namespace halfspace::csg
