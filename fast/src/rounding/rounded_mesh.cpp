#include "halfspace/fast/rounded_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <span>
#include <string>
#include <utility>

#include "base/parallel.hpp"
#include "halfspace/fast/to_mesh.hpp"
#include "rounding/file_grid.hpp"
#include "rounding/grid_mesh.hpp"
#include "rounding/mesh_contacts.hpp"
#include "rounding/resolve_mesh.hpp"
#include "rounding/snap.hpp"

namespace halfspace::fast {
namespace {

/// How rounding goes on where what it moved meets. The second way begins again
/// from the exact surface where the first came to no end.
enum class Way : std::uint8_t {
  kNear,   ///< in vain, what meets is coarsened a bit
  kMerge,  ///< in vain, by the width that makes most of it fall together
};
/// The widths of coarsening, in spacings.
constexpr std::int64_t kFirstWidth = 4;
constexpr std::int64_t kLastNear = 64;
/// How often merging is tried in vain.
constexpr std::size_t kMostMerges = 24;
/// Contacts become fewer by a good share if by this factor. More than so many
/// take longer to resolve than to be counted anew.
constexpr std::size_t kFewer = 3;
constexpr std::size_t kMany = 1000;

class Rounding {
 public:
  Rounding(const Solid& solid, const RoundingOptions& options)
      : solid_(solid), options_(options) {
    options_.threads = thread_count(options.threads);
  }

  Result<RoundedMesh> run() {
    exported_ = to_mesh(solid_, {.triangles = options_.triangles,
                                 .threads = options_.threads,
                                 .straight_corners = false});
    RoundedMesh result;
    if (exported_.vertices.empty()) return result;
    double greatest = 0;
    for (const auto& at : exported_.vertices) {
      for (const double c : at) greatest = std::max(greatest, std::abs(c));
    }
    if (!grid_.choose(greatest, solid_.unit, options_.number)) {
      return Error{ErrorCode::kOutOfRange,
                   "the solid's coordinates go up to " + text(greatest) +
                       ", which the file's numbers do not hold"};
    }
    // Loose points are known to half a unit in their last place, and with a
    // power of ten to a few.
    error_ =
        grid_.steps(greatest) * (solid_.unit.base == 2 ? 0x1p-53 : 0x1p-50);
    begin();
    for (const Way way : {Way::kNear, Way::kMerge}) {
      if (round(way)) return finished();
      if (!is_open_) continue;
      return Error{
          ErrorCode::kOpen,
          "the surface is open, or crosses itself, " + place_of(contact_)};
    }
    return Error{ErrorCode::kOutOfRange,
                 "no rounding of the surface was found that does not cross "
                 "itself; it still does " +
                     place_of(contact_)};
  }

 private:
  struct Polygon {
    std::vector<VertexId> corners;  ///< the least first
    std::int32_t source = 0;        ///< of the exported ones
  };

  static std::string text(double value) {
    char digits[32];
    std::snprintf(digits, sizeof digits, "%.9g", value);
    return digits;
  }
  std::string place_of(const GridPoint& p) const {
    return "near " + text(grid_.coordinate(p.x)) + ", " +
           text(grid_.coordinate(p.y)) + ", " + text(grid_.coordinate(p.z));
  }
  std::span<const VertexId> corners(std::size_t polygon) const {
    const std::uint32_t first = exported_.first_corner[polygon];
    return std::span(exported_.corners)
        .subspan(first, exported_.first_corner[polygon + 1] - first);
  }

  void begin();
  bool coarsen(const MeshContacts& contacts, std::int64_t first,
               std::int64_t last);
  bool go_on(Way way, const MeshContacts& contacts, std::size_t in_vain);
  bool round(Way way);
  void clean_mesh();
  void note_move(const LargestMove& move);
  Result<RoundedMesh> finished();
  std::vector<GridPoint> take_vertices(RoundedMesh& result,
                                       std::vector<VertexId>& number);
  bool is_whole(std::int32_t source,
                std::span<const GridTriangle> triangles) const;
  std::vector<Polygon> polygons_left(const std::vector<GridPoint>& points,
                                     const std::vector<VertexId>& number);
  void count_losses(RoundedMesh& result) const;

  const Solid& solid_;
  RoundingOptions options_;
  ExportedMesh exported_;
  FileGrid grid_;
  GridMesh exact_;  ///< polygons in fans, loose points not yet rounded
  std::vector<LoosePoint> loose_;
  std::vector<std::uint8_t> is_loose_;  ///< by exported vertex
  GridMesh mesh_;
  GridPoint contact_;    ///< where the last surface crossed itself
  double max_move_ = 0;  ///< in steps
  double error_ = 0;     ///< of loose points; in steps
  GridPoint farthest_;   ///< what was moved farthest, in one round
  double farthest_move_ = 0;
  std::size_t rounds_ = 0;
  std::size_t first_contacts_ = 0;
  bool collapsed_ = false;
  bool is_open_ = false;
};

void Rounding::begin() {
  const std::size_t count = exported_.vertices.size();
  exact_.points.resize(count);
  exact_.moved.resize(count);
  is_loose_.resize(count);
  for (std::size_t v = 0; v < count; ++v) {
    StepPoint at;
    for (std::size_t k = 0; k < 3; ++k)
      at[k] = grid_.steps(exported_.vertices[v][k]);
    if (is_exact(solid_, exported_.points[v])) {
      const GridPoint p = {static_cast<std::int64_t>(at[0]),
                           static_cast<std::int64_t>(at[1]),
                           static_cast<std::int64_t>(at[2])};
      exact_.points[v] = p;
      if (distance(at, p) == 0 && grid_.holds(p)) continue;
    }
    loose_.push_back({static_cast<std::int32_t>(v), at});
    is_loose_[v] = 1;
  }
  const std::size_t polygons = exported_.faces.size();
  exact_.triangles.reserve(exported_.corners.size() - 2 * polygons);
  for (std::size_t p = 0; p < polygons; ++p) {
    const auto of = corners(p);
    for (std::size_t i = 1; i + 1 < of.size(); ++i) {
      exact_.triangles.push_back(
          {{of[0], of[i], of[i + 1]}, static_cast<std::int32_t>(p)});
    }
  }
}

/// A surface point moves no farther than the farthest vertex, in each round.
void Rounding::note_move(const LargestMove& move) {
  max_move_ += move.distance;
  if (move.distance <= farthest_move_) return;
  farthest_move_ = move.distance;
  farthest_ = move.to;
}

void Rounding::clean_mesh() {
  const Collapse collapse = clean(mesh_);
  collapsed_ = collapsed_ || collapse.points + collapse.triangles > 0;
}

/// Coarsens what meets, by the least width of up to `last` with which far fewer
/// triangles meet, or else by that which leaves the fewest. Sheets that nearly
/// coincide fall together where the width is more than their distance, and
/// cross the more where it is less. False: too many are left even so.
bool Rounding::coarsen(const MeshContacts& contacts, std::int64_t first,
                       std::int64_t last) {
  GridMesh best;
  LargestMove best_move;
  std::size_t fewest = static_cast<std::size_t>(-1);
  for (std::int64_t width = first; width <= last; width *= 4) {
    GridMesh mesh = mesh_;
    const LargestMove move =
        coarsened(mesh, contacts, grid_, width * grid_.spacing());
    clean(mesh);
    const std::size_t count = contacts_of(mesh, options_.threads).size();
    if (count >= fewest) continue;
    best = std::move(mesh);
    best_move = move;
    fewest = count;
    if (kFewer * count <= contacts.size()) break;
  }
  if (fewest > kMany && fewest > 2 * contacts.size()) return false;
  mesh_ = std::move(best);
  note_move(best_move);
  return true;
}

/// Does something against contacts that do not become fewer for the `in_vain`th
/// time. False: nothing is left to be done.
bool Rounding::go_on(Way way, const MeshContacts& contacts,
                     std::size_t in_vain) {
  if (way == Way::kNear) {
    const std::int64_t width = kFirstWidth << (in_vain - 1);
    return width <= kLastNear && coarsen(contacts, width, width);
  }
  return in_vain <= kMostMerges &&
         coarsen(contacts, kFirstWidth, grid_.widest());
}

/// Whether it came to an end. Contacts become fewer by a good share from round
/// to round, or something else is done in so many of them.
bool Rounding::round(Way way) {
  mesh_ = exact_;
  max_move_ = farthest_move_ = 0;
  std::vector<LoosePoint> loose = loose_;
  std::size_t fewest = static_cast<std::size_t>(-1);
  std::size_t in_vain = 0;
  while (true) {
    ++rounds_;
    if (!loose.empty()) max_move_ += error_;
    note_move(snap(mesh_, loose, grid_));
    clean_mesh();
    const MeshContacts contacts = contacts_of(mesh_, options_.threads);
    if (contacts.empty()) return true;
    collapsed_ = true;
    contacts.for_triangles([&](std::int32_t t) {
      contact_ =
          mesh_.at(mesh_.triangles[static_cast<std::size_t>(t)].corners[0]);
    });
    if (rounds_ == 1) {
      first_contacts_ = contacts.size();
      is_open_ = !is_closed(exact_);
      if (is_open_) return false;
    }
    const bool too_many =
        contacts.size() > std::max(kMany, 2 * mesh_.triangles.size());
    if ((too_many || fewest < kFewer * contacts.size()) &&
        !go_on(way, contacts, ++in_vain))
      return false;
    fewest = std::min(fewest, contacts.size());
    loose = resolve_mesh(mesh_, grid_, options_.threads);
    if (loose.empty()) return true;
  }
}

/// The vertices in their order. `number`: by point of the mesh, which it is.
std::vector<GridPoint> Rounding::take_vertices(RoundedMesh& result,
                                               std::vector<VertexId>& number) {
  std::vector<std::int32_t> row(mesh_.points.size());
  std::iota(row.begin(), row.end(), 0);
  const auto before = [&](std::int32_t p, std::int32_t q) {
    return mesh_.at(p) < mesh_.at(q);
  };
  if (!std::is_sorted(row.begin(), row.end(), before))
    std::sort(row.begin(), row.end(), before);
  std::vector<GridPoint> points;
  number.resize(row.size());
  for (const std::int32_t p : row) {
    number[static_cast<std::size_t>(p)] = static_cast<VertexId>(points.size());
    points.push_back(mesh_.at(p));
    result.vertices.push_back({grid_.coordinate(points.back().x),
                               grid_.coordinate(points.back().y),
                               grid_.coordinate(points.back().z)});
  }
  return points;
}

/// The corners of a polygon of which none moved, if the triangles are its own.
bool Rounding::is_whole(std::int32_t source,
                        std::span<const GridTriangle> triangles) const {
  const auto of = corners(static_cast<std::size_t>(source));
  if (of.size() == 3 || triangles.size() + 2 != of.size()) return false;
  using Points = std::array<GridPoint, 3>;
  const auto sorted = [](const GridMesh& mesh, const GridTriangle& t) {
    Points points = {mesh.at(t.corners[0]), mesh.at(t.corners[1]),
                     mesh.at(t.corners[2])};
    std::sort(points.begin(), points.end());
    return points;
  };
  std::vector<Points> before, after;
  for (std::size_t i = 1; i + 1 < of.size(); ++i) {
    for (const VertexId v : {of[0], of[i], of[i + 1]}) {
      if (is_loose_[static_cast<std::size_t>(v)] != 0) return false;
    }
    before.push_back(sorted(exact_, {{of[0], of[i], of[i + 1]}, source}));
    after.push_back(sorted(mesh_, triangles[i - 1]));
  }
  std::sort(before.begin(), before.end());
  std::sort(after.begin(), after.end());
  return before == after;
}

/// The polygons that are there yet, or else their triangles.
std::vector<Rounding::Polygon> Rounding::polygons_left(
    const std::vector<GridPoint>& points, const std::vector<VertexId>& number) {
  std::stable_sort(mesh_.triangles.begin(), mesh_.triangles.end(),
                   [](const GridTriangle& x, const GridTriangle& y) {
                     return x.source < y.source;
                   });
  std::vector<Polygon> polygons;
  const auto add = [&](Polygon polygon) {
    auto& c = polygon.corners;
    std::rotate(c.begin(), std::min_element(c.begin(), c.end()), c.end());
    polygons.push_back(std::move(polygon));
  };
  const std::span<const GridTriangle> all(mesh_.triangles);
  for (std::size_t t = 0; t < all.size();) {
    const std::int32_t source = all[t].source;
    std::size_t end = t;
    while (end < all.size() && all[end].source == source) ++end;
    if (is_whole(source, all.subspan(t, end - t))) {
      Polygon polygon{{}, source};
      for (const VertexId v : corners(static_cast<std::size_t>(source))) {
        const auto at =
            std::lower_bound(points.begin(), points.end(), exact_.at(v));
        polygon.corners.push_back(static_cast<VertexId>(at - points.begin()));
      }
      add(std::move(polygon));
      t = end;
    }
    for (; t < end; ++t) {
      Polygon polygon{{}, source};
      for (const std::int32_t c : all[t].corners)
        polygon.corners.push_back(number[static_cast<std::size_t>(c)]);
      add(std::move(polygon));
    }
  }
  return polygons;
}

/// What was there before, and is not now.
void Rounding::count_losses(RoundedMesh& result) const {
  std::vector<std::int32_t> before = exported_.faces, after = result.faces;
  for (auto* faces : {&before, &after}) {
    std::sort(faces->begin(), faces->end());
    faces->erase(std::unique(faces->begin(), faces->end()), faces->end());
  }
  result.faces_lost = before.size() - after.size();
  // Where nothing met or fell together all parts are there.
  if (!collapsed_) return;
  result.parts_before = part_count(exact_);
  result.parts_after = part_count(mesh_);
}

Result<RoundedMesh> Rounding::finished() {
  RoundedMesh result;
  result.moved = loose_.size();
  result.max_move = max_move_ * grid_.step();
  result.spacing = grid_.step() * static_cast<double>(grid_.spacing());
  if (options_.max_move && result.max_move > *options_.max_move) {
    return Error{ErrorCode::kOutOfRange,
                 "rounding moves the surface by up to " +
                     text(result.max_move) + ", farthest " +
                     place_of(farthest_) + ", which is more than " +
                     text(*options_.max_move)};
  }
  result.rounds = rounds_;
  result.crossings = first_contacts_;
  drop_unused_points(mesh_);
  std::vector<VertexId> number;
  const std::vector<GridPoint> points = take_vertices(result, number);
  std::vector<Polygon> polygons = polygons_left(points, number);
  const auto before = [](const Polygon& x, const Polygon& y) {
    return x.corners != y.corners ? x.corners < y.corners : x.source < y.source;
  };
  if (!std::is_sorted(polygons.begin(), polygons.end(), before))
    std::sort(polygons.begin(), polygons.end(), before);
  for (const Polygon& polygon : polygons) {
    const auto source = static_cast<std::size_t>(polygon.source);
    result.corners.insert(result.corners.end(), polygon.corners.begin(),
                          polygon.corners.end());
    result.first_corner.push_back(
        static_cast<std::uint32_t>(result.corners.size()));
    result.faces.push_back(exported_.faces[source]);
    result.colors.push_back(exported_.colors[source]);
  }
  count_losses(result);
  return result;
}

}  // namespace

Result<RoundedMesh> rounded_mesh(const Solid& solid,
                                 const RoundingOptions& options) {
  return Rounding(solid, options).run();
}

}  // namespace halfspace::fast
