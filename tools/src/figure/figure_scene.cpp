#include "figure/figure_scene.hpp"

#include <algorithm>
#include <cmath>
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

/// How opaque a file says that its faces are, of 255: their materials times
/// they themselves or, in the mean, their corners. Corners of face f begin at
/// first_corner[f].
std::vector<std::uint8_t> alphas_of(
    const io::Attributes& attributes,
    const std::vector<std::uint32_t>& first_corner) {
  // The fourth number of colours, or what a PLY calls alpha, of 255 or of 1.
  const auto opacities = [](const std::vector<io::Channel>& channels) {
    const io::Channel* color = io::channel_named(channels, "color");
    if (color != nullptr && color->width == 4) return color;
    const io::Channel* alpha = io::channel_named(channels, "alpha");
    return alpha != nullptr && alpha->width == 1 ? alpha : nullptr;
  };
  const auto opacity = [](const io::Channel& channel, std::size_t place) {
    const double scale = channel.width == 1 && channel.is_integer ? kOpaque : 1;
    const double value = channel.at(place).back() / scale;
    return value >= 0 && value <= 1 ? value : 1;  // also where there is none
  };
  const io::Channel* faces = opacities(attributes.faces);
  const io::Channel* corners = opacities(attributes.corners);
  std::vector<std::uint8_t> alphas;
  for (std::size_t f = 0; f + 1 < first_corner.size(); ++f) {
    double share = 1;
    if (!attributes.face_materials.empty() && attributes.face_materials[f] >= 0)
      share =
          attributes
              .materials[static_cast<std::size_t>(attributes.face_materials[f])]
              .opacity;
    if (faces != nullptr) {
      share *= opacity(*faces, f);
    } else if (corners != nullptr) {
      double sum = 0;
      for (std::uint32_t c = first_corner[f]; c < first_corner[f + 1]; ++c)
        sum += opacity(*corners, c);
      share *= sum / (first_corner[f + 1] - first_corner[f]);
    }
    share = std::clamp(share, 0.0, 1.0);
    alphas.push_back(
        static_cast<std::uint8_t>(std::floor(kOpaque * share + 0.5)));
  }
  return alphas;
}

/// Gives polygons what the faces have that they are of; nothing where all are
/// opaque.
void set_alphas(const std::vector<std::uint8_t>& alphas,
                const std::vector<PolygonId>& faces, FigureScene& figure) {
  if (std::all_of(alphas.begin(), alphas.end(),
                  [](std::uint8_t alpha) { return alpha == kOpaque; }))
    return;
  for (const PolygonId face : faces)
    figure.alphas.push_back(alphas[static_cast<std::size_t>(face)]);
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
  std::vector<std::uint8_t> alphas;
  for (std::size_t k = 0; k < paths.size(); ++k) {
    if (io::is_scene_name(paths[k])) {
      return Error{ErrorCode::kUnknownFormat,
                   paths[k] + ": a .scene is drawn alone; give meshes only"};
    }
    const Result<io::Mesh> mesh = read_mesh_file(paths[k]);
    if (!mesh) return io::error_about(paths[k], mesh.error());
    append(all, *mesh);
    const auto own = alphas_of(mesh->attributes, mesh->first_corner);
    alphas.insert(alphas.end(), own.begin(), own.end());
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
  set_alphas(alphas, imported->faces, figure);
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
  FigureScene figure = figure_of(paths[0], std::move(loaded->file));
  if (const auto faces = loaded->attributed) {
    set_alphas(alphas_of(faces->attributes, faces->first_corner),
               loaded->polygons, figure);
  }
  return figure;
}

FigureScene figure_of(const std::string& path, SceneFile file) {
  FigureScene figure;
  figure.name = path;
  figure.file = std::move(file);
  figure.files.assign(figure.scene().polygon_count(), 0);
  return figure;
}

}  // namespace halfspace::tools
