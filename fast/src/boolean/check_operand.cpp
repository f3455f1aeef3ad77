#include "halfspace/fast/check_operand.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <string>
#include <utility>

#include "intersect/self_intersections.hpp"
#include "intersect/self_radial_order.hpp"
#include "solid/move_to_table.hpp"

namespace halfspace::fast {
namespace {

std::string near(const std::array<double, 3>& place) {
  char text[96];
  std::snprintf(text, sizeof text, " near %.9g, %.9g, %.9g", place[0], place[1],
                place[2]);
  return text;
}

std::string near(const Solid& solid, std::int32_t vertex) {
  return near(place_of(solid, vertex));
}

std::string polygon_of(const Solid& solid, std::int32_t face) {
  return std::to_string(solid.faces[static_cast<std::size_t>(face)].polygon);
}

/// The first face with the edge, one way or the other.
std::int32_t face_at(const Solid& solid, std::int32_t u, std::int32_t v) {
  for (std::size_t f = 0; f < solid.faces.size(); ++f) {
    const Face& face = solid.faces[f];
    for (std::uint32_t i = 0; i < face.edge_count; ++i) {
      const SolidEdge& edge = solid.edges[face.first_edge + i];
      if (std::minmax(edge.from, edge.to) == std::minmax(u, v))
        return static_cast<std::int32_t>(f);
    }
  }
  return -1;
}

Error open_at(const std::string& sentence, std::int32_t face) {
  return {ErrorCode::kOpen, sentence, face};
}

Error crossed(const Solid& solid, const std::vector<SelfIntersection>& found) {
  const SelfIntersection& first = found.front();
  std::string sentence =
      "the surface crosses itself: polygons " + polygon_of(solid, first.first) +
      " and " + polygon_of(solid, first.second) +
      (first.in_plane ? " overlap" : " cross") + near(first.place);
  if (found.size() > 1) {
    sentence += ", and " + std::to_string(found.size() - 1) +
                " more pairs do such things";
  }
  return {ErrorCode::kSelfCrossing, sentence, first.first};
}

/// The first face of each connected part of the surface.
std::vector<std::int32_t> first_of_parts(const Solid& solid,
                                         const SurfaceEdges& edges) {
  const std::vector<std::int32_t> parts = parts_of_surface(solid, edges);
  std::vector<std::int32_t> first;
  for (std::size_t f = 0; f < parts.size(); ++f) {
    const auto id = static_cast<std::int32_t>(f);
    if (parts[f] == id && solid.faces[f].edge_count != 0) first.push_back(id);
  }
  return first;
}

/// Where a surface does not pass through itself, each connected part of it has
/// one winding number in front of all its faces, which must be 0 (S6.6).
Result<Done> check_windings(const Solid& solid,
                            const std::vector<std::int32_t>& parts,
                            SelfRadialOrder& half_faces) {
  std::size_t wrong = 0;
  Error error;
  for (const std::int32_t id : parts) {
    const Face& face = solid.faces[static_cast<std::size_t>(id)];
    const int winding = half_faces.winding_outside(id);
    if (winding == 0 || ++wrong > 1) continue;
    const std::string polygon = "polygon " + polygon_of(solid, id);
    error = {winding < 0 ? ErrorCode::kInsideOut : ErrorCode::kSelfCrossing,
             winding < 0
                 ? "the surface is inside out: " + polygon + " faces inwards"
                 : "the surface winds round a place twice: " + polygon +
                       " is within the solid, and faces outwards",
             id};
    error.message += near(solid, solid.edges[face.first_edge].from);
  }
  if (wrong == 0) return Done{};
  if (wrong > 1) {
    error.message += ", and so do " + std::to_string(wrong - 1) +
                     (wrong == 2 ? " other part" : " other parts") + " of it";
  }
  return error;
}

/// Of a surface that is closed.
Result<Done> check_surface(const Solid& solid, const SurfaceEdges& edges,
                           const CheckOptions& options, TableLease& lease) {
  bool stopped = false;
  CheckOptions how = options;
  if (options.progress) {
    how.progress = [&](double share) {
      stopped = stopped || !options.progress(share);
      return !stopped;
    };
  }
  DynamicBvh index = index_of(solid);
  const FacePairs pairs =
      undecided_pairs(solid, lease.table(), edges, index, how);
  if (stopped) return Error{ErrorCode::kStopped, "stopped while checking", -1};
  const std::vector<std::int32_t> parts = first_of_parts(solid, edges);
  SelfRadialOrder half_faces(solid, lease,
                             self_contacts(solid, lease, edges, pairs, parts),
                             std::move(index));
  const auto found = self_intersections_of(half_faces.contacts());
  if (!found.empty()) return crossed(solid, found);
  return check_windings(solid, parts, half_faces);
}

}  // namespace

Result<Done> check_operand(const Solid& solid, const CheckOptions& options) {
  const SurfaceEdges edges(solid);
  if (!edges.is_closed()) {
    const auto bad = bad_edges(solid);
    const BadEdge& first = bad.front();
    const std::int32_t face = face_at(solid, first.from, first.to);
    return open_at("the surface is not closed or not consistently oriented: " +
                       std::to_string(bad.size()) +
                       (bad.size() == 1 ? " bad edge" : " bad edges") +
                       ", the first at polygon " + polygon_of(solid, face) +
                       near(solid, first.from),
                   face);
  }
  const auto open = open_faces(solid);
  if (!open.empty()) {
    const Face& face = solid.faces[static_cast<std::size_t>(open.front())];
    return open_at("the edges of a face make no loops: of polygon " +
                       polygon_of(solid, open.front()) +
                       near(solid, solid.edges[face.first_edge].from),
                   open.front());
  }
  return with_lease(solid,
                    [&](const Solid& same, TableLease& lease) -> Result<Done> {
                      return check_surface(same, edges, options, lease);
                    });
}

}  // namespace halfspace::fast
