#include "halfspace/viewer/model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include "core/combine.hpp"
#include "core/numbers.hpp"
#include "halfspace/boolean.hpp"
#include "halfspace/cap_parts.hpp"
#include "halfspace/fast/display_tree.hpp"
#include "halfspace/fast/tree_file.hpp"
#include "halfspace/io/clip.hpp"
#include "halfspace/io/import.hpp"
#include "halfspace/io/read_mesh.hpp"
#include "halfspace/io/scalars.hpp"

namespace halfspace::viewer {
namespace {

/// The refinement of the grid for meshes that `halfspace render` asks for: a
/// camera's lattice is 2^8 times finer than the grid (S4.1), and with 20 bits
/// more an eye moves by less than a millionth of the scene.
constexpr int kRefineBits = 20;

/// What is asked, again and again, whether that work is to stop.
io::Stop stop_of(const Report& report, const std::string& work, double share) {
  return [&report, work, share] { return !report(work, share); };
}

io::ImportOptions import_options(const Looks& looks, const Report& report) {
  io::ImportOptions options;
  options.stop = stop_of(report, "import", 0);
  options.refine_bits = kRefineBits;
  options.gouraud = looks.is_smooth;
  options.light_colors = true;
  options.ambient = looks.ambient.value_or(options.ambient);
  if (looks.scalar) {
    // As `halfspace render --scalar` does: the colours are the light alone.
    options.triangles = true;
    options.keep_vertices = true;
    options.surface = Rgb{255, 255, 255};
  }
  if (looks.light) {
    const auto& v = *looks.light;
    const glm::dvec3 light = glm::normalize(glm::dvec3(v[0], v[1], v[2]));
    options.lights = {{{light.x, light.y, light.z}}};
  }
  return options;
}

using io::stopped;

/// The parts that are seen, read.
Result<std::vector<ReadPart>> read_parts(const State& state, MeshCache& cache,
                                         const Report& report) {
  std::vector<ReadPart> parts;
  for (std::size_t i = 0; i < state.parts.size(); ++i) {
    const Part& part = state.parts[i];
    if (!part.is_visible) continue;
    const double share =
        static_cast<double>(i) / static_cast<double>(state.parts.size());
    const std::string work = "reading " + part.path;
    if (!report(work, share)) return stopped();
    auto mesh = cache.mesh_of(part.path, stop_of(report, work, share));
    if (!mesh) return mesh.error();
    parts.push_back({static_cast<std::uint32_t>(i), &part, *std::move(mesh)});
  }
  if (parts.empty()) {
    return Error{ErrorCode::kEmpty, state.parts.empty()
                                        ? "no file is open"
                                        : "all parts are hidden"};
  }
  return parts;
}

/// The file alone, as a `.scene` that keeps its own grid and colours.
Result<Model> model_of_scene_file(const std::string& path, const Looks& looks,
                                  const Report& report) {
  Result<io::LoadedScene> loaded =
      io::load_scene(path, import_options(looks, report));
  if (!loaded) return loaded.error();
  Model model;
  model.loaded = *std::move(loaded);
  return model;
}

Result<Model> imported(const io::Mesh& mesh, const io::ImportOptions& options,
                       const std::string& name) {
  Result<io::Imported> done = io::import_scene(mesh, options);
  if (!done) return io::error_about(name, done.error());
  Model model;
  model.loaded = {{std::move(done->scene), std::nullopt, {}},
                  std::move(done->faces),
                  done->report,
                  false,
                  std::move(done->corner_vertices)};
  return model;
}

/// Says which face of which part each polygon is.
void note_parts(Model& model, const CombinedMesh& mesh) {
  for (const PolygonId face : model.loaded.polygons) {
    model.parts.push_back(mesh.parts[static_cast<std::size_t>(face)]);
    model.faces.push_back(mesh.faces[static_cast<std::size_t>(face)]);
  }
}

Result<Model> scene_of_one(const ReadPart& part, const Looks& looks,
                           const Report& report) {
  if (io::is_scene_name(part.part->path) && !part.part->color)
    return model_of_scene_file(part.part->path, looks, report);
  io::ImportOptions options = import_options(looks, report);
  if (part.part->color) options.surface = part.part->color;
  return imported(*part.mesh, options, part.part->path);
}

}  // namespace

Result<std::shared_ptr<const io::Mesh>> MeshCache::mesh_of(
    const std::string& path, const io::Stop& stop) {
  std::error_code code;
  const auto time = std::filesystem::last_write_time(path, code);
  const auto size = std::filesystem::file_size(path, code);
  const auto found = entries_.find(path);
  if (!code && found != entries_.end() && found->second.time == time &&
      found->second.size == size)
    return found->second.mesh;
  // Its end may never come, and it would not be read again.
  std::error_code ignored;
  if (std::filesystem::is_fifo(path, ignored))
    return Error{ErrorCode::kUnreadable, path + ": is a pipe, not a file"};
  std::shared_ptr<const io::Mesh> result;
  if (io::is_scene_name(path)) {
    io::ImportOptions options;
    options.stop = stop;
    const Result<io::LoadedScene> loaded = io::load_scene(path, options);
    if (!loaded) return loaded.error();
    result =
        std::make_shared<const io::Mesh>(viewer::mesh_of(loaded->file.scene));
  } else {
    const bool is_solid = io::is_solid_name(path);
    Result<io::Mesh> mesh =
        is_solid ? mesh_of_solid(path) : io::read_mesh(path, stop);
    if (!mesh && (is_solid || mesh.error().code == ErrorCode::kStopped))
      return mesh.error();
    if (!mesh) return io::error_about(path, mesh.error());
    result = std::make_shared<const io::Mesh>(*std::move(mesh));
  }
  if (!code)
    entries_[path] = {time, size, result, io::ply_scalar_names(path, stop)};
  return result;
}

std::vector<std::string> MeshCache::scalar_names_of(
    const std::string& path) const {
  const auto found = entries_.find(path);
  return found != entries_.end() ? found->second.scalar_names
                                 : std::vector<std::string>();
}

namespace {

/// The box round the points of parts, as they are moved.
void note_box(Model& model, const std::vector<ReadPart>& parts) {
  model.low.fill(std::numeric_limits<double>::infinity());
  model.high.fill(-std::numeric_limits<double>::infinity());
  for (const ReadPart& part : parts) {
    for (const auto& point : part.mesh->vertices) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double at = io::to_double(point[axis]) + part.part->shift[axis];
        model.low[axis] = std::min(model.low[axis], at);
        model.high[axis] = std::max(model.high[axis], at);
      }
    }
  }
}

/// How caps look, those of several parts if they are told apart.
constexpr CapStyle kCaps = {{0xc9, 0x4f, 0x4f}, Rgb{0x8e, 0x2f, 0x2f}};
constexpr Rgb kCapLines = {0x50, 0x50, 0x50};

/// Model::cap_parts, for a model that has the rest. `known` is one of the same
/// polygons and parts.
std::shared_ptr<const CapParts> cap_parts_of(const State& state,
                                             const Model& model,
                                             const Model* known) {
  const std::vector<std::uint32_t>& part_of = model.parts;
  const auto is_first = [&](std::uint32_t p) { return p == part_of.front(); };
  if (!model.is_closed ||
      part_of.size() != model.loaded.file.scene.polygon_count() ||
      std::all_of(part_of.begin(), part_of.end(), is_first) ||
      std::count(part_of.begin(), part_of.end(), kCapPart) > 0)
    return nullptr;
  const bool are_closed =
      known != nullptr ? known->cap_parts != nullptr
                       : are_parts_closed(model.loaded.file.scene, part_of);
  if (!are_closed) return nullptr;
  CapParts parts = *told_apart(part_of, kCaps);
  for (std::size_t k = 0; k < parts.count(); ++k) {
    parts.styles[k].hatch = kCapLines;
    if (k < state.parts.size() && state.parts[k].color)
      parts.styles[k].color = *state.parts[k].color;
  }
  return std::make_shared<const CapParts>(std::move(parts));
}

}  // namespace

std::array<double, 2> Model::extent_along(const glm::dvec3& axis) const {
  std::array<double, 2> result = {0, 0};
  for (int i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double a = axis[i] * low[k], b = axis[i] * high[k];
    result[0] += std::min(a, b);
    result[1] += std::max(a, b);
  }
  return result;
}

Result<Model> make_scene_of(const State& state, Sections sections,
                            MeshCache& cache, const Report& report) {
  const Result<std::vector<ReadPart>> parts = read_parts(state, cache, report);
  if (!parts) return parts.error();
  if (!report("import", 0)) return stopped();
  const ReadPart& first = parts->front();
  const bool is_alone =
      parts->size() == 1 && first.part->shift == std::array<double, 3>{} &&
      (state.looks.coloring == Coloring::kFile || state.looks.scalar);
  Result<Model> model = Error{ErrorCode::kEmpty, ""};
  const bool are_cut = sections == Sections::kOfSolids && has_sections(state);
  if (state.combination != Combination::kNone || are_cut) {
    Result<CombinedMesh> all = combined(*parts, state, sections, report);
    if (!all) return all.error();
    color_faces(*parts, state.looks.coloring, *all);
    model = imported(all->mesh, import_options(state.looks, report), "");
    if (model) note_parts(*model, *all);
  } else if (is_alone) {
    model = scene_of_one(first, state.looks, report);
    if (model) {
      model->parts.assign(model->loaded.polygons.size(), first.index);
      model->faces = model->loaded.polygons;
    }
    if (model && state.looks.scalar) {
      const auto numbers =
          numbers_of(first.part->path, model->loaded, *state.looks.scalar);
      if (!numbers) return numbers.error();
      model->numbers = *numbers;
    }
  } else {
    CombinedMesh all = joined(*parts);
    color_faces(*parts, state.looks.coloring, all);
    model = imported(all.mesh, import_options(state.looks, report), "");
    if (model) note_parts(*model, all);
  }
  if (model && state.looks.scalar && !model->numbers) {
    return Error{ErrorCode::kUnknownFormat,
                 "numbers colour one file that is not moved or combined"};
  }
  if (model && !report("import", 1)) return stopped();
  if (model) note_box(*model, *parts);
  if (model && state.parts.size() == 1)
    model->scalar_names = cache.scalar_names_of(first.part->path);
  if (model) {
    // Coordinates come last: they are seen without colours.
    std::stable_partition(model->scalar_names.begin(),
                          model->scalar_names.end(),
                          [](const std::string& name) {
                            return name != "x" && name != "y" && name != "z";
                          });
  }
  if (model && model->loaded.file.scene.polygon_count() == 0) {
    return Error{ErrorCode::kEmpty,
                 first.part->path + ": there are no polygons to see"};
  }
  return model;
}

Result<std::shared_ptr<const Model>> make_model(const State& state,
                                                MeshCache& cache,
                                                const Model* before,
                                                const Report& report) {
  Result<Model> model =
      make_scene_of(state, Sections::kByPlanes, cache, report);
  if (!model) return model.error();
  const std::string work = "import";
  if (!report(work, 1)) return stopped();
  const Scene& scene = model->loaded.file.scene;
  model->fingerprint = fast::fingerprint_of(scene);
  if (before != nullptr && before->fingerprint == model->fingerprint &&
      before->loaded.file.scene.data().corners == scene.data().corners) {
    model->tree = before->tree;
    model->is_closed = before->is_closed;
    model->cap_parts = cap_parts_of(
        state, *model, before->parts == model->parts ? before : nullptr);
  } else {
    if (!report(work, 1)) return stopped();
    model->is_closed = bad_edges(scene).empty();
    if (!report(work, 1)) return stopped();
    model->cap_parts = cap_parts_of(state, *model, nullptr);
    if (!report(work, 1)) return stopped();
    bool is_stopped = false;
    fast::DisplayTreeOptions options;
    options.progress = [&](double share) {
      is_stopped = is_stopped || !report("building the tree", share);
      return !is_stopped;
    };
    auto tree = std::make_shared<fast::BspTree>(
        fast::build_display_tree(scene, options));
    if (is_stopped) return stopped();
    model->tree = std::move(tree);
  }
  return std::shared_ptr<const Model>(
      std::make_shared<Model>(*std::move(model)));
}

Result<io::LoadedScene> load_view(const std::filesystem::path& path,
                                  Sections sections) {
  const Result<State> state = read_state(path);
  if (!state) return state.error();
  MeshCache cache;
  Result<Model> model = make_scene_of(
      *state, sections, cache, [](const std::string&, double) { return true; });
  if (!model) return io::error_about(path.string(), model.error());
  SceneFile& file = model->loaded.file;
  if (sections == Sections::kByPlanes) {
    model->is_closed = has_sections(*state) && bad_edges(file.scene).empty();
    model->cap_parts = cap_parts_of(*state, *model, nullptr);
    file.options = image_options(*state, *model);
  } else {
    State whole = *state;
    whole.sections.clear();
    file.options = image_options(whole, *model);
  }
  file.camera.reset();
  if (state->camera) {
    const Result<io::Viewed> viewed = io::look_at(file.scene, *state->camera);
    if (!viewed) return io::error_about(path.string(), viewed.error());
    file.camera = viewed->camera;
  }
  // Its colours are the view's.
  model->loaded.is_scene_file = true;
  return std::move(model->loaded);
}

namespace {

/// The plane of a section, whose normal points to what is not there; nothing
/// where the plane is beyond the scene's numbers.
std::optional<ClipPlane> clip_of(const Scene& scene, const Section& section) {
  const auto& [x, y, z] = section.normal;
  const Result<ClipPlane> plane = io::clip_plane(
      scene, {io::number_of(0 - x), io::number_of(0 - y), io::number_of(0 - z),
              io::number_of(section.offset)});
  return plane ? std::optional(*plane) : std::nullopt;
}

}  // namespace

ImageOptions image_options(const State& state, const Model& model) {
  const Looks& looks = state.looks;
  const Scene& scene = model.loaded.file.scene;
  ImageOptions options;
  options.cull = looks.cull;
  options.shading = looks.is_smooth ? Shading::kGouraud : Shading::kFlat;
  options.background = looks.background;
  for (const Section& section : state.sections) {
    const auto plane =
        section.is_on ? clip_of(scene, section) : std::optional<ClipPlane>();
    if (plane) options.clips.push_back(*plane);
  }
  const auto clips = make_clips(options.clips, scene.grid_bits());
  options.clips = clips ? *clips : std::vector<ClipPlane>();
  if (!options.clips.empty() && model.is_closed) {
    options.caps = kCaps;
    options.parts = model.cap_parts;
  }
  return options;
}

}  // namespace halfspace::viewer
