#include "halfspace/io/load_scene.hpp"

#include <cctype>
#include <numeric>
#include <optional>
#include <utility>

#include "base/side_by_side.hpp"
#include "halfspace/io/file.hpp"
#include "halfspace/io/mesh_input.hpp"
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

Result<LoadedScene> scene_of_text(const std::string& path,
                                  std::string_view text,
                                  const ImportOptions& options) {
  Result<SceneFile> file = read_scene(text);
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
  return LoadedScene{std::move(*file), std::move(polygons), report, true, {},
                     nullptr};
}

Result<LoadedScene> load_scene_file(const std::string& path,
                                    const ImportOptions& options) {
  Result<std::string> text = read_file(path, kMostFileBytes, options.stop);
  if (!text && text.error().code == ErrorCode::kStopped) return text.error();
  if (!text) return error_about(path, text.error());
  return scene_of_text(path, *text, options);
}

Result<LoadedScene> scene_of_mesh(const std::string& path,
                                  const Result<Mesh>& mesh,
                                  const ImportOptions& options) {
  if (!mesh) return error_about(path, mesh.error());
  Result<Imported> imported = import_scene(*mesh, options);
  if (!imported) return error_about(path, imported.error());
  LoadedScene loaded{{std::move(imported->scene), std::nullopt, {}},
                     std::move(imported->faces),
                     imported->report,
                     false,
                     std::move(imported->corner_vertices),
                     nullptr,
                     std::move(imported->has_color)};
  if (!mesh->attributes.empty() || !mesh->face_colors.empty() ||
      !mesh->vertex_colors.empty()) {
    auto faces =
        std::make_shared<const AttributedFaces>(attributed_faces(*mesh));
    if (!faces->attributes.empty()) loaded.attributed = std::move(faces);
  }
  return loaded;
}

/// The format that the first bytes look like; OBJ, which has no sign of its
/// own, if none.
Format format_of_bytes(std::string_view bytes) {
  constexpr std::size_t kStlHead = 84, kStlTriangle = 50;
  if (bytes.starts_with("ply")) return Format::kPly;
  if (bytes.starts_with("glTF")) return Format::kGlb;
  if (bytes.starts_with("{")) return Format::kGltf;
  if (bytes.starts_with("PK")) return Format::k3mf;
  const std::string_view word = bytes.substr(0, bytes.find_first_of(" \t\r\n"));
  if (word.ends_with("OFF") && word.size() <= 6) return Format::kOff;
  const bool is_binary_stl =
      bytes.size() >= kStlHead &&
      (bytes.size() - kStlHead) % kStlTriangle == 0 &&
      bytes.substr(0, kStlHead).find('\0') != std::string_view::npos;
  return is_binary_stl || word == "solid" ? Format::kStl : Format::kObj;
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
  return has_extension(has_extension(path, ".gz") ? path.stem() : path,
                       ".scene");
}

bool is_solid_name(const std::filesystem::path& path) {
  return has_extension(has_extension(path, ".gz") ? path.stem() : path,
                       ".hsolid");
}

Result<std::string> read_input() {
  Result<std::string> bytes = read_file("/dev/stdin");
  if (bytes) return bytes;
  Error error = bytes.error();
  error.message =
      kInputName + error.message.substr(std::string("/dev/stdin").size());
  return error;
}

Result<Mesh> mesh_of_input(std::string_view bytes) {
  Result<Mesh> mesh = read_mesh(bytes, format_of_bytes(bytes));
  if (!mesh) return error_about(kInputName, mesh.error());
  return mesh;
}

Result<LoadedScene> scene_of_input(std::string_view bytes,
                                   const ImportOptions& options) {
  if (bytes.starts_with("halfspace-scene"))
    return scene_of_text(kInputName, bytes, options);
  return scene_of_mesh(kInputName, read_mesh(bytes, format_of_bytes(bytes)),
                       options);
}

Result<LoadedScene> load_scene(const std::string& path,
                               const ImportOptions& options) {
  if (path.empty()) {
    return Error{ErrorCode::kUnreadable, "the name of the file is empty"};
  }
  if (path == "-") {
    const Result<std::string> bytes = read_input();
    if (!bytes) return bytes.error();
    return scene_of_input(*bytes, options);
  }
  if (is_scene_name(path)) return load_scene_file(path, options);
  return scene_of_mesh(path, read_mesh(path, options.stop), options);
}

std::vector<Result<LoadedScene>> load_scenes(
    const std::vector<std::string>& paths, const ImportOptions& options,
    int threads) {
  std::vector<std::optional<Result<LoadedScene>>> loaded(paths.size());
  side_by_side(
      paths.size(), threads > 0 ? threads : machine_threads(),
      [&](std::size_t i) { loaded[i] = load_scene(paths[i], options); });
  std::vector<Result<LoadedScene>> result;
  for (auto& one : loaded) result.push_back(*std::move(one));
  return result;
}

std::string to_string(const Unit& unit) {
  return std::to_string(unit.base) + "^" + std::to_string(unit.exponent);
}

}  // namespace halfspace::io
