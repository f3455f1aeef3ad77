#include "rounding/resolve_mesh.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <utility>

#include "base/disjoint_sets.hpp"
#include "boolean/resolve.hpp"
#include "halfspace/boolean.hpp"
#include "halfspace/fast/solid.hpp"
#include "halfspace/fast/to_mesh.hpp"
#include "intersect/point_location.hpp"
#include "rounding/flip_thin.hpp"
#include "rounding/mesh_edges.hpp"
#include "rounding/mesh_winding.hpp"

namespace halfspace::fast {
namespace {

/// Triangles of a mesh as faces of a solid.
class FaceMaker {
 public:
  FaceMaker(const GridMesh& mesh, TableLease& lease)
      : mesh_(mesh), lease_(lease) {}

  Solid empty_solid() const {
    Solid solid;
    solid.unit = {2, 0};
    solid.table = lease_.shared();
    return solid;
  }

  void add(std::int32_t t, Solid& solid) {
    const GridTriangle& triangle = mesh_.triangles[static_cast<std::size_t>(t)];
    const auto& c = triangle.corners;
    Face& face = solid.faces.emplace_back();
    const OrientedPlane plane = lease_.table().add_plane(
        {mesh_.at(c[0]), mesh_.at(c[1]), mesh_.at(c[2])});
    face.plane = plane.plane;
    face.flipped = plane.flipped;
    face.source = t;
    face.polygon = t;
    face.first_edge = static_cast<std::uint32_t>(solid.edges.size());
    face.edge_count = 3;
    face.box = box_of(mesh_, triangle);
    for (std::size_t i = 0; i < 3; ++i)
      solid.edges.push_back({vertex_of(c[i]), vertex_of(c[(i + 1) % 3])});
  }

  /// The point of the mesh that a vertex of an added face is; or -1.
  std::int32_t point_of(std::int32_t vertex) const {
    const auto at = points_.find(vertex);
    return at == points_.end() ? -1 : at->second;
  }

 private:
  std::int32_t vertex_of(std::int32_t point) {
    const std::int32_t vertex = lease_.table().add_point(mesh_.at(point));
    points_.try_emplace(vertex, point);
    return vertex;
  }

  const GridMesh& mesh_;
  TableLease& lease_;
  std::unordered_map<std::int32_t, std::int32_t> points_;  ///< by vertex
};

/// The triangles that are not in the patch, as far as rays pass them.
class RestOfMesh {
 public:
  RestOfMesh(const MeshIndex& index,
             const std::vector<std::uint8_t>& is_in_patch, FaceMaker& maker,
             const GeometryTable& table)
      : index_(index),
        is_in_patch_(is_in_patch),
        maker_(maker),
        table_(table),
        seen_(maker.empty_solid()),
        locator_(seen_, table, nullptr, nullptr) {}

  /// What they add to what PointLocator::winding() finds.
  int winding(std::int32_t vertex, std::int32_t target) {
    Box ray = kEmptyBox;
    extend(ray, table_.vertex(vertex).approximate);
    ray.high[0] = std::numeric_limits<float>::max();
    int winding = 0;
    index_.find(ray, [&](std::int32_t t) {
      if (is_in_patch_[static_cast<std::size_t>(t)] != 0) return;
      const auto next = static_cast<std::int32_t>(seen_.faces.size());
      const auto [at, is_new] = faces_.try_emplace(t, next);
      if (is_new) maker_.add(t, seen_);
      winding += locator_.ray_contribution(0, at->second, vertex, target);
    });
    return winding;
  }

 private:
  const MeshIndex& index_;
  const std::vector<std::uint8_t>& is_in_patch_;
  FaceMaker& maker_;
  const GeometryTable& table_;
  Solid seen_;
  PointLocator locator_;
  std::unordered_map<std::int32_t, std::int32_t> faces_;  ///< by triangle
};

/// Resolves a mesh where its triangles meet.
///
/// A triangle is clean if it meets others in shared corners and edges alone.
/// That the result is the whole surface's: in front of a clean triangle the
/// winding number is the same everywhere, for no triangle parts what is right
/// in front of it; so all of it stays or goes (S6.7). It is the same for two
/// that share an edge which no other has; so it takes one ray for a part of
/// such triangles. Along the edges of the others, and along the segments in
/// which they meet, the half-planes of the radial order are of triangles that
/// are not clean and of clean ones at a shared edge: the patch has them all.
/// The winding numbers there are those of the whole mesh, as rays pass the rest
/// as well. So every fragment is decided upon as it would be without the patch.
class MeshResolver {
 public:
  MeshResolver(GridMesh& mesh, const MeshContacts& contacts, MeshIndex& index,
               const FileGrid& grid, int threads)
      : mesh_(mesh), index_(index), grid_(grid), threads_(threads) {
    const std::size_t count = mesh.triangles.size();
    is_clean_.assign(count, 1);
    for (const auto& [first, second] : contacts.pairs) {
      is_clean_[static_cast<std::size_t>(first)] = 0;
      is_clean_[static_cast<std::size_t>(second)] = 0;
    }
    any_meet_ = !contacts.pairs.empty();
  }

  std::vector<LoosePoint> run() {
    find_what_stays();
    std::vector<LoosePoint> loose;
    GridMesh pieces;
    std::vector<std::int32_t> points;
    if (any_meet_) loose = resolve_patch(pieces, points);
    assemble(pieces, points, loose);
    return loose;
  }

 private:
  const GridTriangle& triangle(std::int32_t t) const {
    return mesh_.triangles[static_cast<std::size_t>(t)];
  }
  bool is_clean(std::int32_t t) const {
    return is_clean_[static_cast<std::size_t>(t)] != 0;
  }

  std::vector<std::int32_t> clean_parts() const;
  void find_what_stays();
  std::vector<std::int32_t> find_patch();
  std::vector<LoosePoint> resolve_patch(GridMesh& pieces,
                                        std::vector<std::int32_t>& points);
  std::vector<LoosePoint> take_pieces(const Solid& pieces,
                                      const FaceMaker& maker, GridMesh& mesh,
                                      std::vector<std::int32_t>& points) const;
  void assemble(const GridMesh& pieces, std::vector<std::int32_t>& points,
                std::vector<LoosePoint>& loose);

  GridMesh& mesh_;
  MeshIndex& index_;
  const FileGrid& grid_;
  int threads_;
  bool any_meet_ = false;
  std::vector<std::uint8_t> is_clean_;  ///< by triangle
  std::vector<std::uint8_t> stays_;     ///< by triangle: as it is
  std::vector<std::uint8_t> is_in_patch_;
};

/// By triangle: the least one of its part, or -1 if it is not clean.
std::vector<std::int32_t> MeshResolver::clean_parts() const {
  DisjointSets sets(mesh_.triangles.size());
  MeshEdges(mesh_).for_edges(
      [&](std::int32_t, const MeshEdgeUse* first, const MeshEdgeUse* last) {
        if (last - first != 2) return;
        if (is_clean(first[0].triangle) && is_clean(first[1].triangle))
          sets.unite(first[0].triangle, first[1].triangle);
      });
  std::vector<std::int32_t> part(mesh_.triangles.size(), -1);
  for (std::size_t t = 0; t < part.size(); ++t) {
    if (is_clean_[t] != 0) part[t] = sets.root(static_cast<std::int32_t>(t));
  }
  return part;
}

/// Decides upon the clean triangles. If one of them has something at its middle
/// all the same, as surfaces may that touched from the beginning, none is taken
/// to be clean.
void MeshResolver::find_what_stays() {
  stays_.assign(mesh_.triangles.size(), 0);
  const std::vector<std::int32_t> part = clean_parts();
  const std::vector<FacingTriangle> facing = facing_triangles(mesh_, part);
  if (facing.empty()) return;
  index_.keep_up(mesh_);
  std::vector<std::uint8_t> part_stays(part.size());
  bool all_sure = true;
  for_windings(mesh_, index_, facing,
               [&](std::size_t i, const std::optional<int>& winding) {
                 all_sure = all_sure && winding.has_value();
                 const auto t = static_cast<std::size_t>(facing[i].triangle);
                 part_stays[static_cast<std::size_t>(part[t])] = winding == 0;
               });
  if (!all_sure) {
    is_clean_.assign(is_clean_.size(), 0);
    any_meet_ = true;
    return;
  }
  for (std::size_t t = 0; t < part.size(); ++t) {
    if (part[t] >= 0) stays_[t] = part_stays[static_cast<std::size_t>(part[t])];
  }
}

/// The triangles that are not clean, and those that have a corner of theirs.
std::vector<std::int32_t> MeshResolver::find_patch() {
  std::vector<std::uint8_t> is_near(mesh_.points.size());
  for (std::size_t t = 0; t < is_clean_.size(); ++t) {
    if (is_clean_[t] != 0) continue;
    for (const std::int32_t c : mesh_.triangles[t].corners)
      is_near[static_cast<std::size_t>(c)] = 1;
  }
  std::vector<std::int32_t> patch;
  is_in_patch_.assign(is_clean_.size(), 0);
  for (std::size_t t = 0; t < is_clean_.size(); ++t) {
    const auto& c = mesh_.triangles[t].corners;
    if (std::none_of(c.begin(), c.end(), [&](std::int32_t p) {
          return is_near[static_cast<std::size_t>(p)] != 0;
        }))
      continue;
    is_in_patch_[t] = 1;
    patch.push_back(static_cast<std::int32_t>(t));
  }
  return patch;
}

/// Returns the loose points of the pieces of triangles that were cut. `points`:
/// by point of theirs, which of the mesh it is; or -1.
std::vector<LoosePoint> MeshResolver::resolve_patch(
    GridMesh& pieces, std::vector<std::int32_t>& points) {
  TableLease lease = TableLease::of_new(grid_bits_for(mesh_.points));
  FaceMaker maker(mesh_, lease);
  Solid patch = maker.empty_solid();
  RestOfSurface rest;
  for (const std::int32_t t : find_patch()) {
    maker.add(t, patch);
    rest.stays.push_back(
        !is_clean(t)
            ? std::int8_t{-1}
            : static_cast<std::int8_t>(stays_[static_cast<std::size_t>(t)]));
  }
  std::optional<RestOfMesh> rest_of_mesh;
  if (patch.faces.size() < mesh_.triangles.size()) {
    rest_of_mesh.emplace(index_, is_in_patch_, maker, lease.table());
    rest.winding = [&](std::int32_t vertex, std::int32_t target) {
      return rest_of_mesh->winding(vertex, target);
    };
  }
  Resolved resolved = resolved_patch(patch, lease, rest);
  auto& faces = resolved.solid.faces;
  const auto first_cut =
      faces.end() - static_cast<std::ptrdiff_t>(resolved.faces_cut);
  for (auto face = faces.begin(); face != first_cut; ++face)
    stays_[static_cast<std::size_t>(face->polygon)] = 1;
  faces.erase(faces.begin(), first_cut);
  return take_pieces(resolved.solid, maker, pieces, points);
}

/// The pieces in triangles.
std::vector<LoosePoint> MeshResolver::take_pieces(
    const Solid& pieces, const FaceMaker& maker, GridMesh& mesh,
    std::vector<std::int32_t>& points) const {
  const ExportedMesh triangles =
      to_mesh(pieces, {.triangles = true, .threads = threads_});
  std::vector<LoosePoint> loose;
  mesh.points.resize(triangles.vertices.size());
  mesh.moved.resize(triangles.vertices.size());
  points.resize(triangles.vertices.size());
  for (std::size_t v = 0; v < triangles.vertices.size(); ++v) {
    points[v] = maker.point_of(triangles.points[v]);
    const SolidVertex vertex = vertex_at(pieces, triangles.points[v]);
    mesh.points[v] = vertex.point;
    if (vertex.is_grid && grid_.holds(vertex.point)) continue;
    loose.push_back({static_cast<std::int32_t>(v), triangles.vertices[v]});
  }
  mesh.triangles.reserve(triangles.faces.size());
  for (std::size_t t = 0; t < triangles.faces.size(); ++t) {
    const auto f = static_cast<std::size_t>(triangles.faces[t]);
    const VertexId* c = &triangles.corners[3 * t];
    mesh.triangles.push_back(
        {{c[0], c[1], c[2]}, triangle(pieces.faces[f].polygon).source});
  }
  flip_thin(mesh, loose, triangles.faces, grid_.safe_height());
  return loose;
}

/// What stays, and the pieces.
void MeshResolver::assemble(const GridMesh& pieces,
                            std::vector<std::int32_t>& points,
                            std::vector<LoosePoint>& loose) {
  std::size_t kept = 0;
  for (std::size_t t = 0; t < stays_.size(); ++t) {
    if (stays_[t] != 0) mesh_.triangles[kept++] = mesh_.triangles[t];
  }
  mesh_.triangles.resize(kept);
  for (std::size_t v = 0; v < points.size(); ++v) {
    if (points[v] >= 0) continue;
    points[v] = static_cast<std::int32_t>(mesh_.points.size());
    mesh_.points.push_back(pieces.points[v]);
  }
  mesh_.moved.assign(mesh_.points.size(), 0);
  for (GridTriangle t : pieces.triangles) {
    for (std::int32_t& c : t.corners) c = points[static_cast<std::size_t>(c)];
    mesh_.triangles.push_back(t);
  }
  for (LoosePoint& p : loose)
    p.point = points[static_cast<std::size_t>(p.point)];
  // The new points are the last ones, and all are used.
  const std::size_t before = mesh_.points.size();
  drop_unused_points(mesh_);
  for (LoosePoint& p : loose)
    p.point -= static_cast<std::int32_t>(before - mesh_.points.size());
}

}  // namespace

std::vector<LoosePoint> resolve_mesh(GridMesh& mesh,
                                     const MeshContacts& contacts,
                                     MeshIndex& index, const FileGrid& grid,
                                     int threads) {
  if (mesh.triangles.empty()) return {};
  return MeshResolver(mesh, contacts, index, grid, threads).run();
}

}  // namespace halfspace::fast
