#include <algorithm>
#include <optional>
#include <span>

#include "base/id_map.hpp"
#include "halfspace/fast/solid/merged_copy.hpp"
#include "solid/loops.hpp"
#include "solid/merge_groups.hpp"
#include "solid/vertex_stars.hpp"

namespace halfspace::fast {
namespace {

/// Whether three edges go round.
bool is_triangle(const SolidEdge* edges) {
  return edges[0].to == edges[1].from && edges[1].to == edges[2].from &&
         edges[2].to == edges[0].from;
}

/// The edge with which trace_loops() begins: that of the least vertex.
std::uint32_t first_of_loop(const SolidEdge* edges, std::uint32_t count) {
  if (count == 3) {
    const std::uint32_t least = edges[1].from < edges[0].from ? 1 : 0;
    return edges[2].from < edges[least].from ? 2 : least;
  }
  return static_cast<std::uint32_t>(
      std::min_element(edges, edges + count,
                       [](const SolidEdge& x, const SolidEdge& y) {
                         return x.from < y.from;
                       }) -
      edges);
}

/// Makes each face's loop begin with the edge that trace_loops() has first.
void turn_loops(std::span<const Face> faces, List<SolidEdge>& list) {
  for (const Face& face : faces) {
    SolidEdge* edges = list.data() + face.first_edge;
    const std::uint32_t first = first_of_loop(edges, face.edge_count);
    // Most do already.
    if (first != 0) std::rotate(edges, edges + first, edges + face.edge_count);
  }
}

/// Moves what stands from `first` to before `last` down the list.
template <class T>
void move_down(List<T>& list, std::size_t first, std::size_t last,
               std::size_t to) {
  if (first == to) return;
  const auto at = [&](std::size_t i) {
    return list.begin() + static_cast<std::ptrdiff_t>(i);
  };
  std::copy(at(first), at(last), at(to));
}

/// Whether turn_loops() would do nothing but to triangles.
bool are_turned(const Solid& solid) {
  const SolidEdge* edges = solid.edges.data();
  return std::all_of(
      solid.faces.begin(), solid.faces.end(), [edges](const Face& face) {
        return face.edge_count == 3 || face.edge_count == 0 ||
               first_of_loop(edges + face.first_edge, face.edge_count) == 0;
      });
}

/// Merges the faces of a solid whose edges are packed. Most faces have no
/// neighbour in their plane and no collinear vertex: they are only moved.
class FaceMerger {
 public:
  FaceMerger(const Solid& solid, Merge rule)
      : solid_(solid), groups_(solid, rule) {
    find_others();
    stars_.emplace(stars_of_others());
    for (const std::int32_t f : others_) {
      const auto at = static_cast<std::size_t>(f);
      staying_[at] = stays(at, *stars_);
      all_stay_ = all_stay_ && staying_[at] != 0;
    }
  }

  /// Whether the solid is as it would be merged, as merged_copy() says.
  bool is_done() const { return all_stay_ && are_turned(solid_); }

  /// Merges the faces of the solid itself, or of a copy.
  void merge(Solid& solid) {
    if (all_stay_) {
      turn_loops(solid.faces, solid.edges);
    } else {
      put_together(*stars_, solid);
    }
  }

 private:
  /// Calls `visit(face's number, face, edge)` for the edges of the others that
  /// are not dropped, of faces that are not to be left out.
  template <class LeftOut, class Visit>
  void for_edges(const LeftOut& is_left_out, const Visit& visit) const {
    for (const std::int32_t f : others_) {
      if (is_left_out(static_cast<std::size_t>(f))) continue;
      const Face& face = solid_.faces[static_cast<std::size_t>(f)];
      const std::uint32_t last = face.first_edge + face.edge_count;
      for (std::uint32_t at = face.first_edge; at < last; ++at) {
        if (!groups_.is_dropped(at)) visit(f, face, solid_.edges[at]);
      }
    }
  }

  void find_others();
  VertexStars stars_of_others() const;
  bool stays(std::size_t f, const VertexStars& stars) const;
  std::size_t pass_on(std::size_t first, Solid& solid);
  void put_together(const VertexStars& stars, Solid& solid);

  const Solid& solid_;
  CoplanarGroups groups_;
  std::optional<VertexStars> stars_;  ///< of the others
  bool all_stay_ = true;
  /// By face: whether it is a triangle that keeps its edges; in the end, of the
  /// others too, as stays() says.
  std::vector<std::uint8_t> staying_;
  List<std::int32_t> others_;
  std::size_t face_count_ = 0;  ///< passed on
  std::size_t edge_count_ = 0;
};

void FaceMerger::find_others() {
  staying_.resize(solid_.faces.size());
  for (std::size_t f = 0; f < staying_.size(); ++f) {
    const Face& face = solid_.faces[f];
    staying_[f] = !groups_.merges(f) && face.edge_count == 3 &&
                  is_triangle(solid_.edges.data() + face.first_edge);
    if (staying_[f] == 0) others_.push_back(static_cast<std::int32_t>(f));
  }
}

/// A closed surface has every edge in either direction: there is a incident
/// from each end to each other one without looking back along edges.
VertexStars FaceMerger::stars_of_others() const {
  const auto for_incident_edges = [this](const auto& visit) {
    const auto none = [](std::size_t) { return false; };
    for_edges(none, [&](std::int32_t, const Face& face, const SolidEdge& edge) {
      visit(IncidentEdge{edge.from, edge.to, face.plane, edge.other});
    });
  };
  const auto for_ends = [&](const auto& visit) {
    for_incident_edges([&](const IncidentEdge& incident) {
      visit(incident.center, incident.end);
    });
  };
  // Two edges of a triangle are on no line. Theirs are all between the others'.
  const auto for_corners = [this](const auto& visit) {
    std::uint32_t at = 0;
    const auto visit_up_to = [&](std::uint32_t last) {
      for (; at < last; ++at) visit(solid_.edges[at].from);
    };
    for (const std::int32_t f : others_) {
      const Face& face = solid_.faces[static_cast<std::size_t>(f)];
      visit_up_to(face.first_edge);
      at += face.edge_count;
    }
    visit_up_to(static_cast<std::uint32_t>(solid_.edges.size()));
  };
  IdRange extent;
  for_ends([&](std::int32_t center, std::int32_t) { extent.add(center); });
  return VertexStars(
      extent, for_ends, for_incident_edges, for_corners,
      [](std::int32_t) { return false; }, *solid_.table);
}

/// Whether trace_loops() would leave the face as it is, but for the edge that
/// it begins with if it is one loop: small loops that visit nothing twice. So
/// does a face of no edges, which is all of its plane.
bool FaceMerger::stays(std::size_t f, const VertexStars& stars) const {
  constexpr std::uint32_t kFew = 24;
  const Face& face = solid_.faces[f];
  if (groups_.merges(f) || face.edge_count > kFew) return false;
  const SolidEdge* edges = solid_.edges.data() + face.first_edge;
  std::uint32_t loops = 0;
  std::uint32_t first = 0;  // of this loop
  bool is_in_order = true;
  for (std::uint32_t i = 0; i < face.edge_count; ++i) {
    if (stars.is_straight(edges[i].from)) return false;
    for (std::uint32_t k = 0; k < i; ++k) {
      if (edges[k].from == edges[i].from) return false;
    }
    // The first loop's first vertex is the least of all, and so on.
    is_in_order = is_in_order && edges[first].from <= edges[i].from;
    const std::uint32_t next = i + 1;
    if (edges[i].to == edges[first].from) {
      is_in_order = is_in_order && (next == face.edge_count ||
                                    edges[first].from < edges[next].from);
      first = next;
      ++loops;
    } else if (next == face.edge_count || edges[i].to != edges[next].from) {
      return false;
    }
  }
  return is_in_order || loops == 1;
}

/// Moves up to 256 unchanged faces from number `first` on, few enough that they
/// are still in the cache when they have been moved. Returns the number of the
/// next face.
std::size_t FaceMerger::pass_on(std::size_t first, Solid& solid) {
  constexpr std::size_t kMostAtOnce = 256;
  const std::size_t end = std::min(first + kMostAtOnce, staying_.size());
  std::size_t last = first;
  while (last < end && staying_[last] != 0) ++last;
  const std::uint32_t first_edge = solid.faces[first].first_edge;
  const std::uint32_t last_edge =
      solid.faces[last - 1].first_edge + solid.faces[last - 1].edge_count;
  move_down(solid.edges, first_edge, last_edge, edge_count_);
  move_down(solid.faces, first, last, face_count_);
  const auto faces = std::span(solid.faces).subspan(face_count_, last - first);
  const auto moved = static_cast<std::uint32_t>(first_edge - edge_count_);
  for (Face& face : faces) face.first_edge -= moved;
  turn_loops(faces, solid.edges);
  face_count_ += faces.size();
  edge_count_ += last_edge - first_edge;
  return last;
}

/// Unchanged faces move together, and their edges do. Merged faces stand among
/// them; their edges, no more than before, follow after all others.
void FaceMerger::put_together(const VertexStars& stars, Solid& solid) {
  // The remaining edges of the merged faces, by the first face of each group.
  List<DirectedEdge> pieces;
  const auto stays_on = [this](std::size_t f) { return staying_[f] != 0; };
  for_edges(
      stays_on, [&](std::int32_t f, const Face& face, const SolidEdge& edge) {
        pieces.push_back(
            {groups_.first_of(f), face.plane, edge.from, edge.to, edge.other});
      });
  trace_loops(pieces, stars);
  std::vector<std::size_t> wholes;  // where those stand that are merged
  auto piece = pieces.begin();
  for (std::size_t f = 0; f < staying_.size();) {
    if (staying_[f] != 0) {
      f = pass_on(f, solid);
      continue;
    }
    const std::size_t whole = f++;
    const auto first = piece;
    while (piece != pieces.end() &&
           piece->bucket == static_cast<std::int64_t>(whole))
      ++piece;
    if (piece == first) continue;
    wholes.push_back(face_count_);
    Face& face = solid.faces[face_count_++] = solid.faces[whole];
    face.edge_count = static_cast<std::uint32_t>(piece - first);
  }
  solid.faces.resize(face_count_);
  solid.edges.resize(edge_count_);
  piece = pieces.begin();
  for (const std::size_t at : wholes) {
    Face& face = solid.faces[at];
    face.first_edge = static_cast<std::uint32_t>(solid.edges.size());
    for (std::uint32_t i = 0; i < face.edge_count; ++i, ++piece)
      solid.edges.push_back({piece->from, piece->to, piece->other});
    face.box = face_box(solid, face);
  }
}

}  // namespace

Solid merge_faces(Solid solid, Merge rule) {
  // A solid without faces need not have a table.
  if (solid.faces.empty()) return solid;
  pack_edges(solid);
  FaceMerger(solid, rule).merge(solid);
  return solid;
}

std::optional<Solid> merged_copy(const Solid& solid, Merge rule) {
  if (solid.faces.empty()) return std::nullopt;
  if (!are_packed(solid)) return merge_faces(solid, rule);
  FaceMerger merger(solid, rule);
  if (merger.is_done()) return std::nullopt;
  Solid copy = solid;
  merger.merge(copy);
  return copy;
}

}  // namespace halfspace::fast
