#include "halfspace/fast/rounded_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <span>
#include <string>
#include <utility>

#include "base/disjoint_sets.hpp"
#include "base/parallel.hpp"
#include "base/radix_sort.hpp"
#include "halfspace/fast/to_mesh.hpp"
#include "rounding/drop_corners.hpp"
#include "rounding/file_grid.hpp"
#include "rounding/flip_thin.hpp"
#include "rounding/grid_mesh.hpp"
#include "rounding/mesh_contacts.hpp"
#include "rounding/mesh_polygons.hpp"
#include "rounding/settle.hpp"

namespace halfspace::fast {
namespace {

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
    if (!grid_.choose(greatest, least_exponent(), options_.number)) {
      return Error{ErrorCode::kOutOfRange, out_of_range(greatest)};
    }
    // Loose points are known to half a unit in their last place, and with a
    // long power of ten to a few.
    exact_.error =
        grid_.steps(greatest) *
        (exported_.max_move <= greatest * 0x1p-53 ? 0x1p-53 : 0x1p-50);
    begin();
    moved_ = exact_.loose.size();
    turn_thin_ones();
    drop_corners();
    settled_ = settle(exact_, grid_, options_.threads);
    if (settled_.end == Settling::kDone) return finished();
    const std::string where = place_of(settled_.contact);
    if (settled_.end == Settling::kOpen) {
      return Error{ErrorCode::kOpen,
                   "the surface is open, or crosses itself, " + where};
    }
    return Error{ErrorCode::kOutOfRange,
                 "no rounding of the surface was found that does not cross "
                 "itself; it still does " +
                     where};
  }

 private:
  static std::string text(double value) {
    char digits[32];
    std::snprintf(digits, sizeof digits, "%.9g", value);
    return digits;
  }
  /// Why coordinates up to `greatest` in size are refused.
  std::string out_of_range(double greatest) const {
    const std::string sentence = "the solid's coordinates ";
    const std::string unit = std::to_string(solid_.unit.base) + "^" +
                             std::to_string(solid_.unit.exponent);
    if (std::isinf(greatest)) {
      return sentence +
             "are beyond the greatest double, 1.8e308: a step of its "
             "grid is " +
             unit;
    }
    if (greatest == 0) {
      return sentence +
             "are below the least double, 4.9e-324: a step of its "
             "grid is " +
             unit;
    }
    return sentence + "go up to " + text(greatest) +
           ", which the file's numbers do not hold";
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

  int least_exponent() const;
  void begin();
  void turn_thin_ones();
  double drop_limit() const;
  void drop_corners();
  Result<RoundedMesh> finished();
  std::vector<VertexId> take_vertices(RoundedMesh& result) const;
  std::vector<MeshPolygon> polygons_left(const std::vector<VertexId>& number);
  void count_losses(RoundedMesh& result) const;

  const Solid& solid_;
  RoundingOptions options_;
  ExportedMesh exported_;
  FileGrid grid_;
  LooseMesh exact_;        ///< polygons in fans, loose points not yet rounded
  std::size_t moved_ = 0;  ///< loose points, before any was dropped
  double drop_move_ = 0;   ///< by dropping corners; in steps
  Settled settled_;
};

/// The exponent of the last digit of vertices that are doubles, whatever the
/// solid's grid is.
int Rounding::least_exponent() const {
  int least = std::numeric_limits<int>::max();
  for (std::size_t v = 0; v < exported_.vertices.size(); ++v) {
    if (exported_.is_rounded[v] != 0) continue;
    for (const double c : exported_.vertices[v]) {
      if (c != 0) least = std::min(least, last_digit(c));
    }
  }
  return least;
}

void Rounding::begin() {
  const std::size_t count = exported_.vertices.size();
  exact_.mesh.points.resize(count);
  exact_.mesh.moved.resize(count);
  for (std::size_t v = 0; v < count; ++v) {
    StepPoint at;
    for (std::size_t k = 0; k < 3; ++k)
      at[k] = grid_.steps(exported_.vertices[v][k]);
    if (exported_.is_rounded[v] == 0) {
      const GridPoint p = {static_cast<std::int64_t>(at[0]),
                           static_cast<std::int64_t>(at[1]),
                           static_cast<std::int64_t>(at[2])};
      exact_.mesh.points[v] = p;
      if (distance(at, p) == 0 && grid_.holds(p)) continue;
    }
    exact_.loose.push_back({static_cast<std::int32_t>(v), at});
  }
  const std::size_t polygons = exported_.faces.size();
  exact_.mesh.triangles.reserve(exported_.corners.size() - 2 * polygons);
  for (std::size_t p = 0; p < polygons; ++p) {
    const auto of = corners(p);
    for (std::size_t i = 1; i + 1 < of.size(); ++i) {
      exact_.mesh.triangles.push_back(
          {{of[0], of[i], of[i + 1]}, static_cast<std::int32_t>(p)});
    }
  }
}

/// Exchanges edges of thin triangles. Polygons of a face become one source
/// where triangles of two were exchanged.
void Rounding::turn_thin_ones() {
  GridMesh& mesh = exact_.mesh;
  std::vector<std::int32_t> plane;
  plane.reserve(mesh.triangles.size());
  for (const GridTriangle& t : mesh.triangles)
    plane.push_back(exported_.faces[static_cast<std::size_t>(t.source)]);
  const auto flipped =
      flip_thin(mesh, exact_.loose, plane, grid_.safe_height());
  if (flipped.empty()) return;
  DisjointSets sources(exported_.faces.size());
  for (const auto& [t, u] : flipped) {
    sources.unite(mesh.triangles[static_cast<std::size_t>(t)].source,
                  mesh.triangles[static_cast<std::size_t>(u)].source);
  }
  for (GridTriangle& t : mesh.triangles) t.source = sources.root(t.source);
}

/// How far dropping corners may move the surface. Corners stay where a bound
/// that was asked for leaves no room besides that for rounding.
double Rounding::drop_limit() const {
  if (options_.keep_corners) return 0;
  constexpr double kSpacings = 4;
  const double limit = kSpacings * static_cast<double>(grid_.spacing());
  if (options_.max_move && *options_.max_move < 2 * limit * grid_.step())
    return 0;
  return limit;
}

/// Drops corners on straight creases. Borders of colours and operands stay.
void Rounding::drop_corners() {
  std::vector<std::uint64_t> kind;
  kind.reserve(exact_.mesh.triangles.size());
  for (const GridTriangle& t : exact_.mesh.triangles) {
    const auto f = exported_.faces[static_cast<std::size_t>(t.source)];
    const Face& face = solid_.faces[static_cast<std::size_t>(f)];
    kind.push_back(static_cast<std::uint64_t>(face.part) << 24 |
                   static_cast<std::uint64_t>(face.color.r) << 16 |
                   static_cast<std::uint64_t>(face.color.g) << 8 |
                   face.color.b);
  }
  drop_move_ =
      drop_straight_corners(exact_.mesh, exact_.loose, kind, drop_limit());
}

/// Takes the vertices in their order. Returns, by point of the mesh, which of
/// them it is.
std::vector<VertexId> Rounding::take_vertices(RoundedMesh& result) const {
  const GridMesh& mesh = settled_.mesh;
  List<KeyedIndex> row;
  row.reserve(mesh.points.size());
  for (const GridPoint& at : mesh.points)
    row.push_back({key_of(at.x), static_cast<std::uint32_t>(row.size())});
  sort_by_key(row, [&](const KeyedIndex& i, const KeyedIndex& j) {
    return mesh.points[i.index] < mesh.points[j.index];
  });
  std::vector<VertexId> number(row.size());
  result.vertices.reserve(row.size());
  for (const KeyedIndex& place : row) {
    number[place.index] = static_cast<VertexId>(result.vertices.size());
    const GridPoint& at = mesh.points[place.index];
    result.vertices.push_back({grid_.coordinate(at.x), grid_.coordinate(at.y),
                               grid_.coordinate(at.z)});
  }
  return number;
}

/// The polygons, by their corners' numbers, the least first.
std::vector<MeshPolygon> Rounding::polygons_left(
    const std::vector<VertexId>& number) {
  std::vector<MeshPolygon> polygons;
  if (options_.triangles) {
    for (const GridTriangle& t : settled_.mesh.triangles)
      polygons.push_back({{t.corners.begin(), t.corners.end()}, t.source});
  } else {
    polygons = polygons_of(settled_.mesh);
  }
  for (MeshPolygon& polygon : polygons) {
    auto& c = polygon.corners;
    for (std::int32_t& corner : c)
      corner = number[static_cast<std::size_t>(corner)];
    std::rotate(c.begin(), std::min_element(c.begin(), c.end()), c.end());
  }
  return polygons;
}

/// The polygons in the order of their corners, by number, and of their sources.
List<KeyedIndex> in_order(const std::vector<MeshPolygon>& polygons) {
  const auto key_of = [](const MeshPolygon& p) {
    return static_cast<std::uint64_t>(p.corners[0]) << 32 |
           static_cast<std::uint64_t>(p.corners[1]);
  };
  List<KeyedIndex> row;
  row.reserve(polygons.size());
  for (const MeshPolygon& p : polygons)
    row.push_back({key_of(p), static_cast<std::uint32_t>(row.size())});
  sort_by_key(row, [&](const KeyedIndex& i, const KeyedIndex& j) {
    const MeshPolygon& x = polygons[i.index];
    const MeshPolygon& y = polygons[j.index];
    return x.corners != y.corners ? x.corners < y.corners : x.source < y.source;
  });
  return row;
}

/// What was there before, and is not now.
void Rounding::count_losses(RoundedMesh& result) const {
  // Faces that dropped corners joined to others in their plane are not lost.
  std::vector<std::uint8_t> is_lost(solid_.faces.size());
  for (const GridTriangle& t : exact_.mesh.triangles) {
    const auto source = static_cast<std::size_t>(t.source);
    is_lost[static_cast<std::size_t>(exported_.faces[source])] = 1;
  }
  for (const std::int32_t face : result.faces)
    is_lost[static_cast<std::size_t>(face)] = 0;
  result.faces_lost = static_cast<std::size_t>(
      std::count(is_lost.begin(), is_lost.end(), std::uint8_t{1}));
  // Where nothing met or fell together all parts are there.
  if (!settled_.collapsed) return;
  result.parts_before = part_count(exact_.mesh);
  result.parts_after = part_count(settled_.mesh);
}

Result<RoundedMesh> Rounding::finished() {
  RoundedMesh result;
  result.moved = moved_;
  result.max_move = (drop_move_ + settled_.max_move) * grid_.step();
  result.spacing = grid_.step() * static_cast<double>(grid_.spacing());
  if (options_.max_move && result.max_move > *options_.max_move) {
    return Error{ErrorCode::kOutOfRange,
                 "rounding moves the surface by up to " +
                     text(result.max_move) + ", farthest " +
                     place_of(settled_.farthest) + ", which is more than " +
                     text(*options_.max_move)};
  }
  result.rounds = settled_.rounds;
  result.crossings = settled_.first_contacts;
  drop_unused_points(settled_.mesh);
  const std::vector<MeshPolygon> polygons =
      polygons_left(take_vertices(result));
  for (const KeyedIndex& place : in_order(polygons)) {
    const MeshPolygon& polygon = polygons[place.index];
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
