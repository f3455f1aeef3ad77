#include "loading.hpp"

#include <cctype>
#include <cstdio>
#include <numeric>
#include <utility>

#include "halfspace/io/read_mesh.hpp"
#include "options.hpp"

namespace halfspace::tools {
namespace {

io::ImportReport unchanged(const Scene& scene) {
  io::ImportReport report;
  report.vertices = scene.data().vertices.size();
  report.polygons = scene.polygon_count();
  report.unit = scene.unit();
  report.grid_bits = scene.grid_bits();
  return report;
}

Result<Loaded> load_scene_file(const std::string& path,
                               const io::ImportOptions& options) {
  Result<std::string> text = io::read_file(path);
  if (!text) return about(path, text.error());
  Result<SceneFile> file = read_scene(*text);
  if (!file) return about(path, file.error());
  const int bits = file->scene.grid_bits();
  if (options.grid_bits && *options.grid_bits != bits) {
    return Error{ErrorCode::kOutOfRange,
                 path + ": the scene has its own grid of " +
                     std::to_string(bits) + " bits; --grid is for meshes only"};
  }
  std::vector<PolygonId> polygons(file->scene.polygon_count());
  std::iota(polygons.begin(), polygons.end(), PolygonId{0});
  io::ImportReport report = unchanged(file->scene);
  return Loaded{std::move(*file), std::move(polygons), report, true};
}

}  // namespace

Error about(const std::string& path, Error error) {
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

Result<Loaded> load(const std::string& path, const io::ImportOptions& options) {
  if (path.empty()) {
    return Error{ErrorCode::kUnreadable, "the name of the file is empty"};
  }
  if (is_scene_name(path)) return load_scene_file(path, options);
  const Result<io::Mesh> mesh = io::read_mesh(path);
  if (!mesh) return about(path, mesh.error());
  Result<io::Imported> imported = io::import_scene(*mesh, options);
  if (!imported) return about(path, imported.error());
  return Loaded{{std::move(imported->scene), std::nullopt, {}},
                std::move(imported->faces),
                imported->report,
                false};
}

std::string to_string(const Unit& unit) {
  return std::to_string(unit.base) + "^" + std::to_string(unit.exponent);
}

std::string to_string(const io::ImportReport& report) {
  char text[256];
  std::snprintf(text, sizeof text,
                "moved %zu coordinates (by at most %.3g), triangulated %zu, "
                "dropped %zu",
                report.moved, report.max_move, report.triangulated,
                report.dropped);
  return text;
}

void add_grid_option(CLI::App& app, std::optional<int>& bits) {
  add_parsed<int>(app, "--grid", "26|40|54", bits, parse_grid,
                  "Round the mesh to a grid of so many bits; without it, the "
                  "smallest that holds it exactly");
}

}  // namespace halfspace::tools
