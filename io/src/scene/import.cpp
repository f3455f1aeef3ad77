#include "halfspace/io/import.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "base/point_table.hpp"
#include "polygon/ear_clipping.hpp"
#include "scene/grid.hpp"
#include "scene/lost_area.hpp"
#include "scene/shade.hpp"

namespace halfspace::io {
namespace {

struct GridPointHash {
  std::size_t operator()(const GridPoint& p) const {
    std::uint64_t hash = mixed(static_cast<std::uint64_t>(p.x));
    hash = mixed(hash + static_cast<std::uint64_t>(p.y));
    return mixed(hash + static_cast<std::uint64_t>(p.z));
  }
};

Rgb mean(std::span<const Rgb> colors) {
  std::size_t r = 0;
  std::size_t g = 0;
  std::size_t b = 0;
  for (const Rgb& color : colors) {
    r += color.r;
    g += color.g;
    b += color.b;
  }
  const std::size_t count = colors.size();
  const auto rounded = [count](std::size_t sum) {
    return static_cast<std::uint8_t>((2 * sum + count) / (2 * count));
  };
  return {rounded(r), rounded(g), rounded(b)};
}

/// The channel of colours at the corners, but not one that says nothing: all
/// white.
const Channel* colors_of(const Mesh& mesh) {
  for (const Channel& channel : mesh.attributes.corners) {
    if (channel.kind != ChannelKind::kColor || channel.width < 3 ||
        channel.values.size() != channel.width * mesh.corners.size())
      continue;
    const bool is_white =
        std::all_of(channel.values.begin(), channel.values.end(),
                    [](double value) { return !(value < 1); });
    return is_white ? nullptr : &channel;
  }
  return nullptr;
}

class Importer {
 public:
  Importer(const Mesh& mesh, const ImportOptions& options)
      : mesh_(mesh),
        options_(options),
        check_(options.stop),
        corner_channel_(colors_of(mesh)) {}
  Result<Imported> import();

 private:
  bool fail(ErrorCode code, const std::string& what, std::size_t face) {
    error_ = Error{code, "polygon " + std::to_string(face) + " " + what,
                   static_cast<std::int64_t>(face)};
    return false;
  }
  std::span<const VertexId> corners_of(std::size_t face) const {
    const std::size_t first = mesh_.first_corner[face];
    return std::span(mesh_.corners)
        .subspan(first, mesh_.first_corner[face + 1] - first);
  }
  /// Notes a step; whether to stop, which is the error then.
  bool stops() {
    if (!check_.stops()) return false;
    error_ = stopped();
    return true;
  }
  bool find_used();
  bool choose();
  bool place_vertices();
  bool take_face(std::size_t face);
  bool sum_normals();
  void note_faces_at(const Direction& normal);
  Direction corner_normal(std::size_t vertex, const Direction& own) const;
  bool add_face(std::size_t face);
  void add_polygon(std::size_t face, std::span<const std::size_t> of_face);
  void color_corners(std::size_t face);
  std::optional<Rgb> color_in_file(std::size_t face) const;
  std::optional<Rgb> color_of_material(std::size_t face) const;
  std::optional<Rgb> color_at_corner(std::size_t face,
                                     std::size_t corner) const;
  Rgb color_of(const std::optional<Rgb>& in_file,
               const Direction& normal) const;

  const Mesh& mesh_;
  const ImportOptions& options_;
  StopCheck check_;
  const Channel* corner_channel_;   // null: corners have no colours
  std::vector<bool> used_;          // by vertex of the mesh
  std::vector<VertexId> scene_id_;  // by vertex of the mesh
  std::vector<Direction> normals_;  // by vertex of the scene
  // With a crease angle: by vertex of the scene the normals of its faces.
  std::vector<std::vector<Direction>> face_normals_;
  SceneData data_;
  std::vector<PolygonId> faces_;  // by polygon of the scene
  std::vector<VertexId> corner_vertices_;
  std::vector<bool> has_color_;  // by face of the mesh
  ImportReport report_;
  std::optional<Error> error_;

  // The face being imported, without its repeated corners.
  std::vector<VertexId> face_;            // vertices of the mesh
  std::vector<std::size_t> face_places_;  // of them in mesh_.corners
  std::vector<GridPoint> points_;
  std::vector<std::size_t> all_;  // 0, 1, 2, ..., as far as was needed
  Rgb color_;
  std::vector<Rgb> corner_colors_;
};

bool Importer::find_used() {
  used_.resize(mesh_.vertices.size());
  for (std::size_t face = 0; face < mesh_.face_count(); ++face) {
    if (stops()) return false;
    const auto corners = corners_of(face);
    for (const VertexId corner : corners) {
      if (corner < 0 ||
          static_cast<std::size_t>(corner) >= mesh_.vertices.size()) {
        return fail(ErrorCode::kBadIndex,
                    "names vertex " + std::to_string(corner) + " of " +
                        std::to_string(mesh_.vertices.size()),
                    face);
      }
      if (corners.size() >= 3) used_[static_cast<std::size_t>(corner)] = true;
    }
  }
  return true;
}

bool Importer::choose() {
  if (options_.unit) {
    data_.unit = report_.unit = *options_.unit;
    data_.grid_bits = report_.grid_bits =
        options_.grid_bits.value_or(report_.grid_bits);
    return true;
  }
  const Result<GridChoice> choice = choose_grid(mesh_, used_, options_);
  if (!choice) {
    error_ = choice.error();
    return false;
  }
  data_.unit = report_.unit = choice->unit;
  data_.grid_bits = report_.grid_bits = choice->bits;
  return true;
}

/// Puts the used vertices on the grid, equal points on one vertex.
bool Importer::place_vertices() {
  PointTable<GridPoint, GridPointHash> table;
  const auto points =
      static_cast<std::size_t>(std::count(used_.begin(), used_.end(), true));
  table.reserve(points);
  data_.vertices.reserve(points);
  scene_id_.resize(mesh_.vertices.size());
  for (std::size_t v = 0; v < mesh_.vertices.size(); ++v) {
    if (stops()) return false;
    if (!used_[v]) continue;
    GridPoint point;
    std::int64_t* const axes[] = {&point.x, &point.y, &point.z};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const GridCoordinate coordinate =
          to_grid(mesh_.vertices[v][axis], data_.unit);
      *axes[axis] = coordinate.steps;
      report_.moved += coordinate.moved ? 1 : 0;
      report_.max_move = std::max(report_.max_move, coordinate.move);
    }
    scene_id_[v] = table.index_of(point, data_.vertices);
  }
  return true;
}

/// Makes `face_` and `points_` those of a face; says whether it has area.
bool Importer::take_face(std::size_t face) {
  const auto id = [this](VertexId vertex) {
    return scene_id_[static_cast<std::size_t>(vertex)];
  };
  face_.clear();
  face_places_.clear();
  points_.clear();
  const auto corners = corners_of(face);
  if (corners.size() < 3) return false;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (!face_.empty() && id(face_.back()) == id(corners[i])) continue;
    face_.push_back(corners[i]);
    face_places_.push_back(mesh_.first_corner[face] + i);
  }
  while (face_.size() > 1 && id(face_.back()) == id(face_.front())) {
    face_.pop_back();
    face_places_.pop_back();
  }
  for (const VertexId corner : face_) {
    points_.push_back(data_.vertices[static_cast<std::size_t>(id(corner))]);
  }
  return points_.size() >= 3;
}

/// Sums up the normals of the faces at each vertex, by their areas.
bool Importer::sum_normals() {
  normals_.resize(data_.vertices.size());
  for (std::size_t face = 0; face < mesh_.face_count(); ++face) {
    if (stops()) return false;
    if (!take_face(face)) continue;
    const Direction normal = normal_of(points_);
    if (options_.crease_deg) note_faces_at(normal);
    for (const VertexId corner : face_) {
      Direction& sum = normals_[static_cast<std::size_t>(
          scene_id_[static_cast<std::size_t>(corner)])];
      for (std::size_t axis = 0; axis < 3; ++axis) sum[axis] += normal[axis];
    }
  }
  return true;
}

/// Notes the face's normal at all of its vertices.
void Importer::note_faces_at(const Direction& normal) {
  face_normals_.resize(data_.vertices.size());
  for (const VertexId corner : face_) {
    face_normals_[static_cast<std::size_t>(
                      scene_id_[static_cast<std::size_t>(corner)])]
        .push_back(normal);
  }
}

/// What lights a corner at a vertex of the scene, of a face with this normal.
Direction Importer::corner_normal(std::size_t vertex,
                                  const Direction& own) const {
  if (!options_.crease_deg) return normals_[vertex];
  const auto dot = [](const Direction& u, const Direction& v) {
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
  };
  const double least =
      std::cos(*options_.crease_deg * std::numbers::pi / 180) - 1e-9;
  Direction sum{};
  for (const Direction& normal : face_normals_[vertex]) {
    const double size = std::sqrt(dot(own, own) * dot(normal, normal));
    if (!(dot(own, normal) >= least * size)) continue;
    for (std::size_t axis = 0; axis < 3; ++axis) sum[axis] += normal[axis];
  }
  return sum;
}

std::optional<Rgb> Importer::color_in_file(std::size_t face) const {
  if (!mesh_.face_colors.empty() && mesh_.face_colors[face]) {
    return *mesh_.face_colors[face];
  }
  if (!mesh_.vertex_colors.empty()) {
    std::vector<Rgb> colors;
    for (const VertexId corner : face_) {
      const auto& color = mesh_.vertex_colors[static_cast<std::size_t>(corner)];
      if (color) colors.push_back(*color);
    }
    if (colors.size() == face_.size()) return mean(colors);
  }
  if (corner_channel_ != nullptr) {
    std::vector<Rgb> colors;
    for (std::size_t i = 0; i < face_.size(); ++i) {
      const auto color = color_at_corner(face, i);
      if (color) colors.push_back(*color);
    }
    if (colors.size() == face_.size() && !colors.empty()) return mean(colors);
  }
  return color_of_material(face);
}

/// The colour at a corner of the face in `face_`. White leaves that of a
/// material as it is.
std::optional<Rgb> Importer::color_at_corner(std::size_t face,
                                             std::size_t corner) const {
  if (corner_channel_ == nullptr) return std::nullopt;
  const std::optional<Rgb> color =
      rgb_of(corner_channel_->at(face_places_[corner]));
  return color == Rgb{255, 255, 255} && color_of_material(face) ? std::nullopt
                                                                : color;
}

std::optional<Rgb> Importer::color_of_material(std::size_t face) const {
  const Attributes& attributes = mesh_.attributes;
  if (attributes.face_materials.empty()) return std::nullopt;
  const std::int32_t material = attributes.face_materials[face];
  if (material < 0) return std::nullopt;
  return attributes.materials[static_cast<std::size_t>(material)].color;
}

/// The colour of what has `in_file` in the file and faces that way.
Rgb Importer::color_of(const std::optional<Rgb>& in_file,
                       const Direction& normal) const {
  if (in_file && !options_.surface && !options_.light_colors) return *in_file;
  const Rgb unlit = options_.surface.value_or(in_file.value_or(kUsualSurface));
  return lit(unlit, normal, options_);
}

/// Makes `corner_colors_` those of the face's corners.
void Importer::color_corners(std::size_t face) {
  corner_colors_.clear();
  const Direction own = normal_of(points_);
  for (std::size_t i = 0; i < face_.size(); ++i) {
    const auto vertex = static_cast<std::size_t>(face_[i]);
    std::optional<Rgb> in_file;
    if (!mesh_.vertex_colors.empty()) in_file = mesh_.vertex_colors[vertex];
    if (!in_file) in_file = color_at_corner(face, i);
    if (!in_file && !mesh_.face_colors.empty())
      in_file = mesh_.face_colors[face];
    if (!in_file) in_file = color_of_material(face);
    const auto at = static_cast<std::size_t>(scene_id_[vertex]);
    corner_colors_.push_back(color_of(in_file, corner_normal(at, own)));
  }
}

/// Adds a polygon that has these corners of the face.
void Importer::add_polygon(std::size_t face,
                           std::span<const std::size_t> of_face) {
  for (const std::size_t corner : of_face) {
    data_.corners.push_back(scene_id_[static_cast<std::size_t>(face_[corner])]);
    if (options_.gouraud) {
      data_.corner_colors.push_back(corner_colors_[corner]);
    }
    if (options_.keep_vertices) corner_vertices_.push_back(face_[corner]);
  }
  data_.first_corner.push_back(
      static_cast<std::uint32_t>(data_.corners.size()));
  data_.colors.push_back(color_);
  faces_.push_back(static_cast<PolygonId>(face));
}

bool Importer::add_face(std::size_t face) {
  const Shape shape = take_face(face) ? shape_of(points_) : Shape::kNoArea;
  if (shape == Shape::kNoArea) {
    ++report_.dropped;
    return true;
  }
  const std::optional<Rgb> in_file = color_in_file(face);
  if (in_file) {
    has_color_.resize(mesh_.face_count());
    has_color_[face] = true;
  }
  color_ = color_of(in_file, normal_of(points_));
  if (options_.gouraud) color_corners(face);
  const bool only_triangles = options_.gouraud || options_.triangles;
  const bool whole =
      shape == Shape::kConvex && (!only_triangles || points_.size() == 3);
  if (whole) {
    while (all_.size() < points_.size()) all_.push_back(all_.size());
    add_polygon(face, std::span(all_).first(points_.size()));
    return true;
  }
  if (points_.size() > kMaxEarCorners) {
    return fail(ErrorCode::kOutOfRange,
                "has to be cut into triangles, but has " +
                    std::to_string(points_.size()) + " corners, over " +
                    std::to_string(kMaxEarCorners),
                face);
  }
  const auto triangles = triangulate(points_);
  ++(triangles.empty() ? report_.dropped : report_.triangulated);
  for (const auto& triangle : triangles) add_polygon(face, triangle);
  return true;
}

Result<Imported> Importer::import() {
  report_.vertices = mesh_.vertices.size();
  report_.polygons = mesh_.face_count();
  if (mesh_.face_count() == 0 && !mesh_.vertices.empty()) {
    return Error{ErrorCode::kEmpty, "there are " +
                                        std::to_string(mesh_.vertices.size()) +
                                        " vertices, but no faces"};
  }
  if (!find_used() || !choose() || !place_vertices()) return *error_;
  if (options_.gouraud && !sum_normals()) return *error_;
  data_.corners.reserve(mesh_.corners.size());
  data_.first_corner.reserve(mesh_.face_count() + 1);
  data_.colors.reserve(mesh_.face_count());
  faces_.reserve(mesh_.face_count());
  for (std::size_t face = 0; face < mesh_.face_count(); ++face) {
    if (stops() || !add_face(face)) return *error_;
  }
  if (report_.moved > 0 && report_.dropped > 0) {
    std::vector<bool> kept(mesh_.face_count());
    for (const PolygonId face : faces_)
      kept[static_cast<std::size_t>(face)] = true;
    if (auto lost = lost_area_error(mesh_, kept, report_)) return *lost;
  }
  Result<Scene> scene = make_scene(std::move(data_));
  if (!scene) return scene.error();
  return Imported{*std::move(scene), std::move(faces_), report_,
                  std::move(corner_vertices_), std::move(has_color_)};
}

}  // namespace

ImportOptions unlit() {
  ImportOptions options;
  options.lights.clear();
  options.ambient = 1;
  return options;
}

Result<Imported> import_scene(const Mesh& mesh, const ImportOptions& options) {
  return Importer(mesh, options).import();
}

}  // namespace halfspace::io
