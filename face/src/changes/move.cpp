#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "display_state.hpp"
#include "halfspace/csg/matrix.hpp"
#include "halfspace/display.hpp"
#include "import.hpp"
#include "number.hpp"

/// Vertices of a display that move, and polygons with them (S3.13).
namespace halfspace {

/// Where vertices go.
struct detail::VertexMoves {
  std::span<const std::int32_t> vertices;
  std::span<const Point> to;
  ExactPoints points;  ///< the same

  void apply(io::Mesh& mesh) const {
    mesh.decimal = mesh.decimal && points.decimal;
    for (std::size_t k = 0; k < vertices.size(); ++k)
      mesh.vertices[static_cast<std::size_t>(vertices[k])] = points.points[k];
  }
  /// Whether they can be rounded to a grid in these steps.
  bool are_within_reach(const Unit& unit) const {
    const double most = std::ldexp(step_of(unit), 60);
    return std::all_of(to.begin(), to.end(), [most](const Point& p) {
      return std::abs(p.x) < most && std::abs(p.y) < most &&
             std::abs(p.z) < most;
    });
  }
};

/// A scene, and which of its polygons are not as they were.
struct detail::MovedScene {
  Scene scene;
  std::vector<PolygonId> polygons;
};

namespace {

/// The faces at the vertices that move, as a mesh of their own.
class MovedPart {
 public:
  MovedPart(const io::Mesh& mesh, const detail::VertexMoves& moves) {
    std::vector<bool> moves_away(mesh.vertices.size());
    for (const std::int32_t vertex : moves.vertices)
      moves_away[static_cast<std::size_t>(vertex)] = true;
    part_of_vertex_.assign(mesh.vertices.size(), -1);
    part_of_face_.assign(mesh.face_count(), -1);
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
      const auto begin = mesh.corners.begin() + mesh.first_corner[f];
      const auto end = mesh.corners.begin() + mesh.first_corner[f + 1];
      if (std::any_of(begin, end, [&](VertexId v) {
            return moves_away[static_cast<std::size_t>(v)];
          }))
        add(mesh, f, {begin, end});
    }
    for (std::size_t k = 0; k < moves.vertices.size(); ++k) {
      const auto v = static_cast<std::size_t>(moves.vertices[k]);
      if (part_of_vertex_[v] < 0) continue;
      mesh_.vertices[static_cast<std::size_t>(part_of_vertex_[v])] =
          moves.points.points[k];
    }
  }

  const io::Mesh& mesh() const { return mesh_; }
  /// By face of the whole mesh the one of the part, or -1.
  const std::vector<std::int32_t>& part_of_face() const {
    return part_of_face_;
  }
  /// The vertex of the whole mesh.
  VertexId whole(VertexId vertex) const {
    return whole_vertices_[static_cast<std::size_t>(vertex)];
  }

 private:
  void add(const io::Mesh& mesh, std::size_t face,
           std::span<const VertexId> corners) {
    part_of_face_[face] = static_cast<std::int32_t>(mesh_.face_count());
    for (const VertexId v : corners) {
      std::int32_t& part = part_of_vertex_[static_cast<std::size_t>(v)];
      if (part < 0) {
        part = static_cast<std::int32_t>(whole_vertices_.size());
        whole_vertices_.push_back(v);
        mesh_.vertices.push_back(mesh.vertices[static_cast<std::size_t>(v)]);
      }
      mesh_.corners.push_back(part);
    }
    mesh_.first_corner.push_back(
        static_cast<std::uint32_t>(mesh_.corners.size()));
    mesh_.face_colors.push_back(
        mesh.face_colors.empty() ? std::nullopt : mesh.face_colors[face]);
  }

  io::Mesh mesh_;
  std::vector<std::int32_t> part_of_vertex_;
  std::vector<std::int32_t> part_of_face_;
  std::vector<VertexId> whole_vertices_;  ///< by vertex of the part
};

/// The options that put polygons on a grid, by the mesh's vertices.
io::ImportOptions options_for(const Unit& unit, int grid_bits) {
  io::ImportOptions options = detail::import_options();
  options.unit = unit;
  options.grid_bits = grid_bits;
  options.keep_vertices = true;
  return options;
}

/// Coordinates of what moves have this many bits where their grid has room for
/// them: so points are rounded to a millionth or so of the greatest, and on the
/// least grid they may go four times as far.
constexpr int kMovedBits = 24;

/// The unit of a scene, divided that far.
Unit fine_unit(const Scene& scene) {
  Unit unit = scene.unit();
  std::int64_t most = 1;
  for (const GridPoint& p : scene.data().vertices)
    most = std::max({most, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  for (; fits(most * unit.base, kMovedBits) && unit.exponent > -4096;
       most *= unit.base)
    --unit.exponent;
  return unit;
}

/// What is wrong with what was asked for, if anything is.
std::optional<Error> fault_of(const io::Mesh& mesh,
                              std::span<const std::int32_t> vertices,
                              std::span<const Point> points) {
  if (mesh.face_count() == 0) {
    return Error{ErrorCode::kUnknownFormat,
                 "a display of a scene file keeps its polygons in place"};
  }
  if (vertices.size() != points.size()) {
    return Error{ErrorCode::kOutOfRange,
                 std::to_string(vertices.size()) + " vertices cannot go to " +
                     std::to_string(points.size()) + " points"};
  }
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    const std::int32_t v = vertices[k];
    if (v < 0 || static_cast<std::size_t>(v) >= mesh.vertices.size()) {
      return Error{ErrorCode::kBadIndex,
                   "there is no vertex " + std::to_string(v) + ", of " +
                       std::to_string(mesh.vertices.size()),
                   v};
    }
    if (!detail::is_finite(points[k])) {
      return Error{
          ErrorCode::kNotFinite,
          "the point for vertex " + std::to_string(v) + " is not finite", v};
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<detail::MovedScene> Display::State::moved(
    const detail::VertexMoves& moves) const {
  if (!is_by_vertex || !moves.are_within_reach(scene.unit()))
    return std::nullopt;
  // Step 1: the polygons at the vertices, on the scene's grid.
  const MovedPart part(mesh, moves);
  const auto imported = io::import_scene(
      part.mesh(), options_for(scene.unit(), scene.grid_bits()));
  if (!imported) return std::nullopt;
  // By polygon of the display the face of the part.
  std::vector<std::int32_t> face_of(polygon_count, -1);
  for (std::size_t f = 0; f < part.part_of_face().size(); ++f) {
    const std::size_t number =
        numbers.empty() ? f : static_cast<std::size_t>(numbers[f]);
    face_of[number] = part.part_of_face()[f];
  }
  // Step 2: they take their places, corner by corner.
  const SceneData& now = imported->scene.data();
  SceneData data = scene.data();
  detail::MovedScene result;
  std::size_t q = 0;
  for (std::size_t p = 0; p < faces.size(); ++p) {
    const std::int32_t face = face_of[static_cast<std::size_t>(faces[p])];
    if (face < 0) continue;
    const std::uint32_t first = data.first_corner[p];
    const std::uint32_t count = data.first_corner[p + 1] - first;
    if (q == imported->faces.size() || imported->faces[q] != face ||
        now.first_corner[q + 1] - now.first_corner[q] != count)
      return std::nullopt;
    for (std::uint32_t k = 0; k < count; ++k) {
      const std::uint32_t from = now.first_corner[q] + k;
      const VertexId v = part.whole(imported->corner_vertices[from]);
      data.corners[first + k] = v;
      data.vertices[static_cast<std::size_t>(v)] =
          now.vertices[static_cast<std::size_t>(now.corners[from])];
    }
    data.colors[p] = now.colors[q++];
    result.polygons.push_back(static_cast<PolygonId>(p));
  }
  if (q != imported->faces.size()) return std::nullopt;
  Result<Scene> made = make_scene(std::move(data));
  if (!made) return std::nullopt;
  result.scene = *std::move(made);
  return result;
}

/// On the grid of before, which gets finer the first time; where that does not
/// hold all of it, on one of its own.
Result<std::unique_ptr<Display::State>> Display::State::made_anew(
    const detail::VertexMoves& moves) const {
  io::Mesh all = mesh;
  moves.apply(all);
  const Unit unit = is_by_vertex ? scene.unit() : fine_unit(scene);
  if (moves.are_within_reach(unit)) {
    auto next = of(all, options_for(unit, scene.grid_bits()));
    if (next) return next;
  }
  io::ImportOptions options = detail::import_options();
  options.keep_vertices = true;
  return of(std::move(all), options);
}

Result<Done> Display::move_to(std::span<const std::int32_t> vertices,
                              std::span<const Point> points) {
  State& before = *state_;
  if (const auto fault = fault_of(before.mesh, vertices, points)) return *fault;
  if (vertices.empty()) return Done{};
  const detail::VertexMoves moves = {vertices, points,
                                     detail::exact_points(points)};
  auto moved = before.moved(moves);
  if (!moved) {
    auto next = before.made_anew(moves);
    if (!next) return next.error();
    (*next)->continue_numbers(before);
    state_ = *std::move(next);
    return Done{};
  }
  auto next = std::make_unique<State>();
  next->scene = std::move(moved->scene);
  if (before.lazy) {
    before.lazy->move_to(next->scene, moved->polygons);
    next->lazy = std::move(before.lazy);
  }
  next->mesh = std::move(before.mesh);
  moves.apply(next->mesh);
  next->numbers = std::move(before.numbers);
  next->is_by_vertex = true;
  next->faces = std::move(before.faces);
  next->polygon_count = before.polygon_count;
  next->solid_starts = std::move(before.solid_starts);
  next->built_count = next->scene.polygon_count();
  state_ = std::move(next);
  return Done{};
}

}  // namespace halfspace
