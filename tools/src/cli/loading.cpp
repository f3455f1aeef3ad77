#include "cli/loading.hpp"

#include <fmt/format.h>

#include <new>

#include "cli/options.hpp"
#include "halfspace/csg/exact.hpp"
#include "halfspace/io/load_scene.hpp"
#include "halfspace/io/mesh_input.hpp"
#include "halfspace/io/read_mesh.hpp"
#include "halfspace/solid_file.hpp"
#include "halfspace/viewer/model.hpp"

namespace halfspace::tools {

Result<io::LoadedScene> load(const std::string& path,
                             const io::ImportOptions& options) {
  std::optional<SolidData> exact;
  return load_with_solid(path, options, exact);
}

Result<io::LoadedScene> load_with_solid(const std::string& path,
                                        const io::ImportOptions& options,
                                        std::optional<SolidData>& exact) {
  try {
    if (viewer::is_view_name(path))
      return viewer::load_view(path, viewer::Sections::kOfSolids);
    return csg::load_scene(path, options, &exact);
  } catch (const std::bad_alloc&) {
    return no_room_for({path});
  }
}

Result<io::Mesh> read_mesh_file(const std::string& path) {
  try {
    if (path != "-") return io::read_mesh(path);
    const Result<std::string> bytes = io::read_input();
    if (!bytes) return bytes.error();
    if (is_solid_file(*bytes)) {
      return Error{ErrorCode::kUnknownFormat,
                   io::kInputName +
                       ": an exact file is no mesh, and needs no repair; "
                       "halfspace csg A A=- -o OUT writes it in any format"};
    }
    return io::mesh_of_input(*bytes);
  } catch (const std::bad_alloc&) {
    return no_room_for({path});
  }
}

Error no_room_for(const std::vector<std::string>& paths) {
  return {
      ErrorCode::kOutOfRange,
      fmt::format("{}: there is not enough memory to read {}",
                  fmt::join(paths, ", "), paths.size() == 1 ? "it" : "them")};
}

std::string to_string(const io::ImportReport& report) {
  return fmt::format(
      "moved {} coordinates (by at most {:.3g}), triangulated {}, dropped {}",
      report.moved, report.max_move, report.triangulated, report.dropped);
}

void add_grid_option(CLI::App& app, std::optional<int>& bits) {
  static constexpr Word<int> kGrids[] = {{"26", 26}, {"40", 40}, {"54", 54}};
  add_choice(app, "--grid", kGrids, bits,
             "Round the mesh to a grid of so many bits; without it, the "
             "smallest that holds it exactly");
}

}  // namespace halfspace::tools
