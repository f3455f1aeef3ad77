#include "halfspace/io/load_scene.hpp"

#include <cctype>
#include <numeric>
#include <optional>
#include <utility>

#include "halfspace/io/read_mesh.hpp"

namespace halfspace::io {
namespace {

ImportReport unchanged(const Scene& scene) {
  ImportReport report;
  report.vertices = scene.data().vertices.size();
  report.polygons = scene.polygon_count();
  report.unit = scene.unit();
  report.grid_bits = scene.grid_bits();
  return report;
}

Result<LoadedScene> load_scene_file(const std::string& path,
                                    const ImportOptions& options) {
  Result<std::string> text = read_file(path);
  if (!text) return error_about(path, text.error());
  Result<SceneFile> file = read_scene(*text);
  if (!file) return error_about(path, file.error());
  const int bits = file->scene.grid_bits();
  if (options.grid_bits && *options.grid_bits != bits) {
    return Error{ErrorCode::kOutOfRange,
                 path + ": the scene has its own grid of " +
                     std::to_string(bits) +
                     " bits; another grid is for meshes only"};
  }
  std::vector<PolygonId> polygons(file->scene.polygon_count());
  std::iota(polygons.begin(), polygons.end(), PolygonId{0});
  ImportReport report = unchanged(file->scene);
  return LoadedScene{std::move(*file), std::move(polygons), report, true};
}

}  // namespace

Error error_about(const std::string& path, Error error) {
  if (!path.empty() && !error.message.starts_with(path))
    error.message = path + ": " + error.message;
  return error;
}

bool has_extension(const std::filesystem::path& path,
                   std::string_view extension) {
  std::string found = path.extension().string();
  for (char& c : found) {
    c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return found == extension;
}

bool is_scene_name(const std::filesystem::path& path) {
  return has_extension(path, ".scene");
}

Result<LoadedScene> load_scene(const std::string& path,
                               const ImportOptions& options) {
  if (path.empty()) {
    return Error{ErrorCode::kUnreadable, "the name of the file is empty"};
  }
  if (is_scene_name(path)) return load_scene_file(path, options);
  const Result<Mesh> mesh = read_mesh(path);
  if (!mesh) return error_about(path, mesh.error());
  Result<Imported> imported = import_scene(*mesh, options);
  if (!imported) return error_about(path, imported.error());
  return LoadedScene{{std::move(imported->scene), std::nullopt, {}},
                     std::move(imported->faces),
                     imported->report,
                     false};
}

std::string to_string(const Unit& unit) {
  return std::to_string(unit.base) + "^" + std::to_string(unit.exponent);
}

}  // namespace halfspace::io
