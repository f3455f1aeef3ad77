#include "halfspace/cap_parts.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <tuple>
#include <utility>

namespace halfspace {
namespace {

/// By vertex the least vertex with the same point.
std::vector<VertexId> first_with_point(const Scene& scene) {
  const std::vector<GridPoint>& points = scene.data().vertices;
  std::vector<VertexId> ids(points.size());
  std::iota(ids.begin(), ids.end(), VertexId{0});
  const auto point = [&](VertexId v) -> const GridPoint& {
    return points[static_cast<std::size_t>(v)];
  };
  std::sort(ids.begin(), ids.end(), [&](VertexId u, VertexId v) {
    return std::tie(point(u), u) < std::tie(point(v), v);
  });
  std::vector<VertexId> firsts(points.size());
  VertexId first = 0;
  for (std::size_t k = 0; k < ids.size(); ++k) {
    if (k == 0 || point(ids[k]) != point(first)) first = ids[k];
    firsts[static_cast<std::size_t>(ids[k])] = first;
  }
  return firsts;
}

}  // namespace

std::vector<std::uint32_t> connected_parts(const Scene& scene) {
  std::vector<VertexId> parents = first_with_point(scene);
  const auto root_of = [&](VertexId v) {
    while (parents[static_cast<std::size_t>(v)] != v) {
      VertexId& parent = parents[static_cast<std::size_t>(v)];
      parent = parents[static_cast<std::size_t>(parent)];
      v = parent;
    }
    return v;
  };
  const auto count = static_cast<PolygonId>(scene.polygon_count());
  for (PolygonId p = 0; p < count; ++p) {
    const auto corners = scene.corners(p);
    for (const VertexId corner : corners) {
      const VertexId a = root_of(corner);
      const VertexId b = root_of(corners[0]);
      parents[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
    }
  }
  constexpr std::uint32_t kNone = 0xffffffff;
  std::vector<std::uint32_t> number_of(parents.size(), kNone);
  std::vector<std::uint32_t> parts;
  std::uint32_t next = 0;
  for (PolygonId p = 0; p < count; ++p) {
    std::uint32_t& number =
        number_of[static_cast<std::size_t>(root_of(scene.corners(p)[0]))];
    if (number == kNone) number = next++;
    parts.push_back(number);
  }
  return parts;
}

bool are_parts_closed(const Scene& scene,
                      const std::vector<std::uint32_t>& part_of) {
  // By part and ends of an edge, the lesser first, whether it goes down.
  using Use = std::tuple<std::uint32_t, VertexId, VertexId, bool>;
  const std::vector<VertexId> firsts = first_with_point(scene);
  std::vector<Use> uses;
  uses.reserve(scene.data().corners.size());
  for (std::size_t p = 0; p < part_of.size(); ++p) {
    const auto corners = scene.corners(static_cast<PolygonId>(p));
    VertexId from = firsts[static_cast<std::size_t>(corners.back())];
    for (const VertexId corner : corners) {
      const VertexId to = firsts[static_cast<std::size_t>(corner)];
      uses.emplace_back(part_of[p], std::min(from, to), std::max(from, to),
                        from > to);
      from = to;
    }
  }
  std::sort(uses.begin(), uses.end());
  std::int64_t excess = 0;
  for (std::size_t k = 0; k < uses.size(); ++k) {
    const auto& [part, low, high, down] = uses[k];
    excess += down ? -1 : 1;
    const bool is_last =
        k + 1 == uses.size() ||
        std::tie(part, low, high) != std::tie(std::get<0>(uses[k + 1]),
                                              std::get<1>(uses[k + 1]),
                                              std::get<2>(uses[k + 1]));
    if (is_last && excess != 0) return false;
  }
  return true;
}

std::shared_ptr<const CapParts> told_apart(std::vector<std::uint32_t> part_of,
                                           const CapStyle& several) {
  // Light tints, on which lines are seen, of Okabe and Ito's colours (2008).
  constexpr std::array<Rgb, 7> kTints = {{{242, 207, 127},
                                          {170, 217, 244},
                                          {127, 206, 185},
                                          {247, 241, 160},
                                          {127, 184, 216},
                                          {229, 188, 211},
                                          {204, 204, 204}}};
  CapParts parts;
  std::size_t count = 0;
  for (const std::uint32_t part : part_of)
    count = std::max(count, std::size_t{part} + 1);
  for (std::size_t k = 0; k < count; ++k)
    parts.styles.push_back({kTints[k % kTints.size()], several.hatch});
  parts.styles.push_back(several);
  parts.part_of = std::move(part_of);
  return std::make_shared<const CapParts>(std::move(parts));
}

}  // namespace halfspace
