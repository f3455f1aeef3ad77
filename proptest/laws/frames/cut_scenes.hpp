#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "adapters/scenes.hpp"
#include "definition/definition.hpp"
#include "halfspace/boolean.hpp"
#include "halfspace/scene_file.hpp"
#include "halfspace/splitmix.hpp"

/// Scenes of boxes that are cut beforehand, so that they are scenes again, with
/// caps as polygons (S10.L6, S9.L9).
namespace halfspace::cut_scenes {

/// Where one coordinate is `at`; what is beyond that is kept if `side` is 1.
struct AxisCut {
  std::size_t axis = 0;
  std::int64_t at = 0;
  std::int64_t side = 1;
};

using Coordinates = std::array<std::int64_t, 3>;

inline Coordinates of_point(const GridPoint& p) { return {p.x, p.y, p.z}; }

/// Polygons under way to a scene.
struct Pieces {
  SceneData data;
  std::map<Coordinates, VertexId> known;

  void corner(const Coordinates& p) {
    const auto next = static_cast<VertexId>(data.vertices.size());
    const auto [found, is_new] = known.try_emplace(p, next);
    if (is_new) data.vertices.push_back({p[0], p[1], p[2]});
    data.corners.push_back(found->second);
  }
  void close(const Rgb& color) {
    data.first_corner.push_back(
        static_cast<std::uint32_t>(data.corners.size()));
    data.colors.push_back(color);
  }
};

/// Adds what the cut leaves of a polygon; false if that is not on the grid.
inline bool add_cut(const Scene& scene, PolygonId id, const AxisCut& cut,
                    Pieces& pieces) {
  std::vector<Coordinates> left;
  bool some_kept = false;
  const auto corners = scene.corners(id);
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Coordinates p = of_point(scene.point(corners[k]));
    const Coordinates q =
        of_point(scene.point(corners[(k + 1) % corners.size()]));
    const std::int64_t at_p = cut.side * (p[cut.axis] - cut.at);
    const std::int64_t at_q = cut.side * (q[cut.axis] - cut.at);
    if (at_p >= 0) left.push_back(p);
    some_kept = some_kept || at_p > 0;
    if ((at_p < 0 && at_q > 0) || (at_p > 0 && at_q < 0)) {
      Coordinates between{};
      for (std::size_t a = 0; a < 3; ++a) {
        const auto above = Int128{at_p} * q[a] - Int128{at_q} * p[a];
        const auto below = Int128{at_p} - at_q;
        if (above % below != 0) return false;
        between[a] = static_cast<std::int64_t>(above / below);
      }
      left.push_back(between);
    }
  }
  if (!some_kept) return true;
  for (const Coordinates& p : left) pieces.corner(p);
  pieces.close(scene.color(id));
  return true;
}

/// Adds the cap: the rectangles between all coordinates of the scene in which
/// the winding number is positive, facing what is removed.
inline void add_cap(const Scene& scene, const AxisCut& cut, const Rgb& color,
                    Pieces& pieces) {
  const std::size_t u = (cut.axis + 1) % 3;
  const std::size_t v = (cut.axis + 2) % 3;
  std::array<std::vector<std::int64_t>, 3> at;
  for (const GridPoint& p : scene.data().vertices) {
    for (std::size_t a = 0; a < 3; ++a) at[a].push_back(of_point(p)[a]);
  }
  for (auto& list : at) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  std::vector<definition::Facet> facets;
  for (const PolygonId id : ids_of(scene))
    facets.push_back(definition::facet_of(scene, definition::whole(scene, id)));
  for (std::size_t i = 0; i + 1 < at[u].size(); ++i) {
    for (std::size_t j = 0; j + 1 < at[v].size(); ++j) {
      std::array<definition::Integer, 3> middle;
      middle[u] = 2 * (definition::Integer(at[u][i]) + at[u][i + 1]);
      middle[v] = 2 * (definition::Integer(at[v][j]) + at[v][j + 1]);
      middle[cut.axis] = 4 * definition::Integer(cut.at) + cut.side;
      if (definition::winding(facets, {middle[0], middle[1], middle[2], 4}) <=
          0)
        continue;
      // Counterclockwise seen from above the axis, or from below.
      std::array<std::array<std::size_t, 2>, 4> ring = {
          {{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
      if (cut.side > 0) std::reverse(ring.begin(), ring.end());
      for (const auto& [a, b] : ring) {
        Coordinates p{};
        p[cut.axis] = cut.at;
        p[u] = at[u][i + a];
        p[v] = at[v][j + b];
        pieces.corner(p);
      }
      pieces.close(color);
    }
  }
}

/// Boxes are closed scenes whose cuts across axes are on the grid.
inline bool is_of_boxes(const Scene& scene) {
  for (const PolygonId id : ids_of(scene)) {
    const auto corners = scene.corners(id);
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Coordinates p = of_point(scene.point(corners[k]));
      const Coordinates q =
          of_point(scene.point(corners[(k + 1) % corners.size()]));
      const auto same =
          int{p[0] == q[0]} + int{p[1] == q[1]} + int{p[2] == q[2]};
      if (same != 2) return false;
    }
  }
  return scene.polygon_count() != 0 && bad_edges(scene).empty();
}

inline std::uint64_t section_number_of(const SceneFile& view) {
  std::uint64_t number = 0;
  for (const GridPoint& p : view.scene.data().vertices)
    number = mix(number + static_cast<std::uint64_t>(p.x + 3 * p.y + 7 * p.z));
  return number;
}

/// A cut across an axis at a coordinate of the scene, or next to one.
inline AxisCut cut_of(const SceneFile& view) {
  const std::uint64_t number = section_number_of(view);
  const auto& vertices = view.scene.data().vertices;
  AxisCut cut;
  cut.axis = number % 3;
  cut.side = number / 3 % 2 == 0 ? 1 : -1;
  const auto k = mix(number) % vertices.size();
  cut.at = of_point(vertices[k])[cut.axis] +
           static_cast<std::int64_t>(mix(number + 1) % 3) - 1;
  return cut;
}

inline ClipPlane clip_of(const AxisCut& cut) {
  ClipPlane clip;
  (cut.axis == 0 ? clip.a : cut.axis == 1 ? clip.b : clip.c) = cut.side;
  clip.d = -Int128{cut.side} * cut.at;
  return clip;
}

/// A view of the scene cut beforehand.
struct CutView {
  SceneFile view;
  bool has_cap = false;
};

/// Nothing if a part is too thin for the grid.
inline std::optional<CutView> cut_beforehand_of(const SceneFile& view,
                                                const AxisCut& cut,
                                                const Rgb& color) {
  Pieces pieces;
  pieces.data.unit = view.scene.unit();
  pieces.data.grid_bits = view.scene.grid_bits();
  for (const PolygonId id : ids_of(view.scene)) {
    if (!add_cut(view.scene, id, cut, pieces)) return std::nullopt;
  }
  const std::size_t open = pieces.data.colors.size();
  add_cap(view.scene, cut, color, pieces);
  const bool has_cap = pieces.data.colors.size() > open;
  auto made = make_scene(std::move(pieces.data));
  if (!made) return std::nullopt;
  CutView result{view, has_cap};
  result.view.scene = std::move(*made);
  return result;
}

}  // namespace halfspace::cut_scenes
