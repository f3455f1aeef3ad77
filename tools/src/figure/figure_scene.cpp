#include "figure/figure_scene.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "cli/loading.hpp"

namespace halfspace::tools {
namespace {

/// Makes room for the colours of `count` things if any of them has one.
void extend(std::vector<std::optional<Rgb>>& colors,
            const std::vector<std::optional<Rgb>>& more, std::size_t before,
            std::size_t count) {
  if (colors.empty() && more.empty()) return;
  colors.resize(before);
  colors.insert(colors.end(), more.begin(), more.end());
  colors.resize(before + count);
}

/// Adds a mesh to others.
void append(io::Mesh& all, const io::Mesh& mesh) {
  const std::size_t vertices = all.vertices.size();
  const std::size_t faces = all.face_count();
  all.decimal = faces == 0 ? mesh.decimal : all.decimal && mesh.decimal;
  extend(all.vertex_colors, mesh.vertex_colors, vertices, mesh.vertices.size());
  extend(all.face_colors, mesh.face_colors, faces, mesh.face_count());
  const auto corners = static_cast<std::uint32_t>(all.corners.size());
  all.vertices.insert(all.vertices.end(), mesh.vertices.begin(),
                      mesh.vertices.end());
  for (const VertexId corner : mesh.corners)
    all.corners.push_back(corner + static_cast<VertexId>(vertices));
  for (std::size_t f = 1; f < mesh.first_corner.size(); ++f)
    all.first_corner.push_back(corners + mesh.first_corner[f]);
}

Result<FigureScene> load_meshes(const std::vector<std::string>& paths,
                                const io::ImportOptions& options) {
  io::Mesh all;
  std::vector<std::int32_t> file_of_face;
  for (std::size_t k = 0; k < paths.size(); ++k) {
    if (io::is_scene_name(paths[k])) {
      return Error{ErrorCode::kUnknownFormat,
                   paths[k] + ": a .scene is drawn alone; give meshes only"};
    }
    const Result<io::Mesh> mesh = read_mesh_file(paths[k]);
    if (!mesh) return io::error_about(paths[k], mesh.error());
    append(all, *mesh);
    file_of_face.resize(all.face_count(), static_cast<std::int32_t>(k));
  }
  FigureScene figure;
  figure.name = paths[0];
  Result<io::Imported> imported = io::import_scene(all, options);
  if (!imported && imported.error().code == ErrorCode::kEmpty) return figure;
  if (!imported) return io::error_about(paths[0], imported.error());
  figure.file.scene = std::move(imported->scene);
  for (const PolygonId face : imported->faces) {
    figure.files.push_back(file_of_face[static_cast<std::size_t>(face)]);
  }
  return figure;
}

}  // namespace

Result<FigureScene> load_figure(const std::vector<std::string>& paths,
                                const io::ImportOptions& options) {
  if (paths.size() > 1) return load_meshes(paths, options);
  Result<io::LoadedScene> loaded = load(paths[0], options);
  if (!loaded && loaded.error().code == ErrorCode::kEmpty &&
      !io::is_scene_name(paths[0])) {
    FigureScene nothing;
    nothing.name = paths[0];
    return nothing;
  }
  if (!loaded) return loaded.error();
  return figure_of(paths[0], std::move(loaded->file));
}

FigureScene figure_of(const std::string& path, SceneFile file) {
  FigureScene figure;
  figure.name = path;
  figure.file = std::move(file);
  figure.files.assign(figure.scene().polygon_count(), 0);
  return figure;
}

}  // namespace halfspace::tools
