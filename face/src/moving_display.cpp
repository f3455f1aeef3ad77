#include "halfspace/moving_display.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "display_state.hpp"
#include "halfspace/boolean.hpp"
#include "halfspace/cap_parts.hpp"
#include "halfspace/fast/area_image.hpp"
#include "halfspace/fast/display_tree.hpp"
#include "halfspace/fast/image/flat_scene.hpp"
#include "halfspace/fast/image/moving.hpp"
#include "halfspace/fast/shade/look.hpp"
#include "halfspace/io/import.hpp"
#include "halfspace/io/objects.hpp"
#include "halfspace/io/picture.hpp"
#include "halfspace/threads.hpp"
#include "import.hpp"
#include "number.hpp"

namespace halfspace {

struct [[gnu::visibility("hidden")]] MovingDisplay::State {
  /// Polygons as they were given.
  struct GivenModel {
    Scene scene;
    std::vector<PolygonId> faces;  ///< by polygon of the scene
    bool is_closed = false;
    bool is_changed = true;  ///< objects came or went since its tree
  };

  struct GivenObject {
    std::int32_t model = 0;
    std::int32_t owner = 0;
    io::RegionPoints points;
    ObjectRegion region;
    std::optional<AffineMap> map;
    bool is_gone = false;
  };

  /// What is drawn, made of what was given.
  struct Made {
    Assembly assembly;
    fast::MovingTrees trees;
    /// By model and object in it, the object's number.
    std::vector<std::vector<std::int32_t>> numbers;
  };

  std::vector<GivenModel> models;
  std::vector<GivenObject> objects;  ///< the first is the world
  Mutex mutex;
  std::optional<Made> made;

  Result<Done> known(std::int32_t object) const {
    if (object > 0 && object < std::ssize(objects) &&
        !objects[static_cast<std::size_t>(object)].is_gone)
      return Done{};
    return Error{ErrorCode::kBadIndex,
                 "there is no object " + std::to_string(object), object};
  }

  static Result<GivenModel> model_of(const Mesh& mesh);
  /// Makes what changed since the last picture.
  Result<Done> prepare(const View& view);
  Result<Placement> placed() const;
  Result<ImageOptions> options_of(const View& view) const;
  /// The picture by a look, or of exact areas: that of the scene of all that
  /// has moved (S12.7), with a tree of it.
  Result<fast::Rendering> flat_image(
      const View& view, const Look& look, const Placement& placement,
      const Camera& camera, const ImageOptions& options) const;
  /// The number of an occurrence's object.
  std::int32_t object_of(std::size_t occurrence) const;
  MovingPicture picture_of(fast::Rendering image, bool is_told_apart) const;
  /// An error of the assembly in the numbers of objects.
  Error named(Error error, std::int32_t object) const {
    error.message = "object " + std::to_string(object) + ": " + error.message;
    error.index = object;
    return error;
  }
};

auto MovingDisplay::State::model_of(const Mesh& mesh) -> Result<GivenModel> {
  if (const auto fault = detail::fault_of(mesh)) return *fault;
  Result<io::Imported> imported =
      io::import_scene(detail::exact_mesh(mesh), detail::import_options());
  if (!imported) return imported.error();
  if (imported->scene.polygon_count() == 0)
    return Error{ErrorCode::kEmpty, "there are no polygons to look at"};
  const bool is_closed = bad_edges(imported->scene).empty();
  return GivenModel{std::move(imported->scene), std::move(imported->faces),
                    is_closed};
}

Result<Done> MovingDisplay::State::prepare(const View& view) {
  const bool is_changed =
      std::any_of(models.begin(), models.end(),
                  [](const GivenModel& model) { return model.is_changed; });
  if (!is_changed) return Done{};
  Made next;
  std::vector<Model> all;
  for (std::size_t m = 0; m < models.size(); ++m) {
    std::vector<std::pair<std::int32_t, io::RegionPoints>> inner;
    auto& numbers = next.numbers.emplace_back();
    for (std::size_t k = 1; k < objects.size(); ++k) {
      const GivenObject& object = objects[k];
      if (object.is_gone || object.owner != static_cast<std::int32_t>(m))
        continue;
      inner.emplace_back(object.model, object.points);
      numbers.push_back(static_cast<std::int32_t>(k));
    }
    Result<Model> model = io::model_on_grid(models[m].scene, inner);
    if (!model) return model.error();
    all.push_back(*std::move(model));
  }
  Result<Assembly> assembly = make_assembly(std::move(all));
  if (!assembly) return assembly.error();
  next.assembly = *std::move(assembly);
  fast::DisplayTreeOptions options;
  options.threads = std::max(view.threads, 0);
  options.progress = view.progress;
  std::vector<std::optional<fast::ModelTree>> trees(models.size());
  for (std::size_t m = 0; m < models.size(); ++m) {
    if (!models[m].is_changed) continue;
    Result<fast::ModelTree> tree =
        fast::build_model_tree(next.assembly, static_cast<std::int32_t>(m),
                               fast::InRegion::kError, options);
    if (!tree) return tree.error();
    trees[m] = *std::move(tree);
  }
  // Nothing fails any more: trees that did not change are kept.
  for (std::size_t m = 0; m < models.size(); ++m) {
    next.trees.models.push_back(trees[m] ? *std::move(trees[m])
                                         : std::move(made->trees.models[m]));
    models[m].is_changed = false;
  }
  made = std::move(next);
  return Done{};
}

Result<Placement> MovingDisplay::State::placed() const {
  const Assembly& assembly = made->assembly;
  Pose pose = empty_pose(assembly);
  for (std::size_t m = 0; m < pose.maps.size(); ++m) {
    const Scene& owner = assembly.models()[m].scene;
    for (std::size_t k = 0; k < pose.maps[m].size(); ++k) {
      const auto number = static_cast<std::size_t>(made->numbers[m][k]);
      const GivenObject& object = objects[number];
      if (!object.map) continue;
      const Scene& inner = assembly.model(object.model).scene;
      pose.maps[m][k] = io::object_map(*object.map, inner.unit(), owner.unit(),
                                       io::most_shift(assembly));
    }
  }
  Result<Placement> placement = make_placement(assembly, pose);
  if (placement || placement.error().index < 0) return placement;
  const auto& occurrences = assembly.occurrences();
  const Occurrence& here =
      occurrences[static_cast<std::size_t>(placement.error().index)];
  const auto owner = static_cast<std::size_t>(
      occurrences[static_cast<std::size_t>(here.owner)].model);
  return named(placement.error(),
               made->numbers[owner][static_cast<std::size_t>(here.object)]);
}

Result<ImageOptions> MovingDisplay::State::options_of(const View& view) const {
  const Assembly& assembly = made->assembly;
  ImageOptions options;
  options.cull = view.cull;
  options.background = view.background;
  const auto clips = detail::clips_of(assembly.models()[0].scene, view);
  if (!clips) return clips.error();
  options.clips = *clips;
  if (!view.caps) return options;
  options.caps = view.caps;
  for (const GivenModel& model : models) {
    if (model.is_closed) continue;
    return Error{ErrorCode::kOpen,
                 "caps fill solids, and one of the models is not closed"};
  }
  if (!view.caps_by_solid) return options;
  std::vector<std::uint32_t> owners(assembly.polygon_count());
  const auto& all = assembly.occurrences();
  for (std::size_t o = 0; o < all.size(); ++o) {
    std::fill_n(owners.begin() + all[o].first_polygon,
                assembly.model(all[o].model).scene.polygon_count(),
                static_cast<std::uint32_t>(o));
  }
  options.parts = told_apart(std::move(owners), *view.caps);
  return options;
}

Result<fast::Rendering> MovingDisplay::State::flat_image(
    const View& view, const Look& look, const Placement& placement,
    const Camera& camera, const ImageOptions& options) const {
  const auto flat = fast::flat_scene(made->assembly, placement, camera);
  if (!flat) return flat.error();
  const auto own = flat_options(*flat, options);
  if (!own) return own.error();
  fast::DisplayTreeOptions building;
  building.threads = std::max(view.threads, 0);
  building.progress = view.progress;
  fast::BspTree tree = fast::build_display_tree(flat->scene, building);
  if (tree.nodes.empty()) return detail::stopped();
  fast::RenderOptions how;
  how.threads = building.threads;
  fast::Rendering image =
      fast::render_look(flat->scene, tree, flat->camera, *own, look, how);
  if (view.anti_aliasing == AntiAliasing::kExactArea) {
    fast::divide_leaves(tree, flat->scene);
    image.colors =
        fast::render_area(flat->scene, tree, flat->camera, *own, how.threads)
            .colors;
  }
  for (PolygonId& item : image.items.pixels)
    item = moved_item(made->assembly, *flat, item);
  return image;
}

std::int32_t MovingDisplay::State::object_of(std::size_t occurrence) const {
  if (occurrence == 0) return 0;
  const auto& all = made->assembly.occurrences();
  const Occurrence& here = all[occurrence];
  const auto owner =
      static_cast<std::size_t>(all[static_cast<std::size_t>(here.owner)].model);
  return made->numbers[owner][static_cast<std::size_t>(here.object)];
}

MovingPicture MovingDisplay::State::picture_of(fast::Rendering image,
                                               bool is_told_apart) const {
  const Assembly& assembly = made->assembly;
  MovingPicture picture{std::move(image.colors), image.items,
                        std::move(image.items)};
  // Occurrences by the ids of their first polygons.
  std::vector<std::pair<PolygonId, std::size_t>> firsts;
  const auto& occurrences = assembly.occurrences();
  for (std::size_t o = 0; o < occurrences.size(); ++o) {
    if (assembly.model(occurrences[o].model).scene.polygon_count() > 0)
      firsts.emplace_back(occurrences[o].first_polygon, o);
  }
  std::sort(firsts.begin(), firsts.end());
  const auto count = static_cast<PolygonId>(assembly.polygon_count());
  for (std::size_t i = 0; i < picture.polygons.pixels.size(); ++i) {
    std::int32_t& object = picture.objects.pixels[i];
    std::int32_t& polygon = picture.polygons.pixels[i];
    if (polygon == kBackground) continue;
    if (polygon >= count) {
      const CapItem cap = cap_item(static_cast<std::size_t>(polygon - count));
      const bool is_told = is_told_apart && cap.part < occurrences.size();
      object = is_told ? object_of(cap.part) : kBackground;
      polygon = kFirstCap - static_cast<std::int32_t>(cap.plane);
      continue;
    }
    const auto after = std::upper_bound(
        firsts.begin(), firsts.end(), polygon,
        [](PolygonId id, const auto& first) { return id < first.first; });
    const auto& [first, o] = *std::prev(after);
    const GivenModel& model =
        models[static_cast<std::size_t>(occurrences[o].model)];
    object = object_of(o);
    polygon = model.faces[static_cast<std::size_t>(polygon - first)];
  }
  return picture;
}

MovingDisplay::MovingDisplay(std::unique_ptr<State> state)
    : state_(std::move(state)) {}
MovingDisplay::MovingDisplay(MovingDisplay&&) noexcept = default;
MovingDisplay& MovingDisplay::operator=(MovingDisplay&&) noexcept = default;
MovingDisplay::~MovingDisplay() = default;

Result<MovingDisplay> MovingDisplay::of(const Mesh& world) {
  Result<State::GivenModel> model = State::model_of(world);
  if (!model) return model.error();
  auto state = std::make_unique<State>();
  state->models.push_back(*std::move(model));
  state->objects.emplace_back();
  return MovingDisplay(std::move(state));
}

Result<std::int32_t> MovingDisplay::add_model(const Mesh& mesh) {
  Result<State::GivenModel> model = State::model_of(mesh);
  if (!model) return model.error();
  const Lock lock(state_->mutex);
  state_->models.push_back(*std::move(model));
  return static_cast<std::int32_t>(state_->models.size()) - 1;
}

Result<std::int32_t> MovingDisplay::insert(std::int32_t model,
                                           std::span<const Point> region,
                                           std::int32_t owner) {
  State& state = *state_;
  const Lock lock(state.mutex);
  if (owner < 0 || model <= owner || model >= std::ssize(state.models)) {
    return Error{ErrorCode::kBadIndex,
                 "an object of model " + std::to_string(model) + " in model " +
                     std::to_string(owner) +
                     ": a model is added before what is in it",
                 model};
  }
  State::GivenObject object{model, owner, {}, {}, {}};
  for (const Point& point : region) {
    if (!detail::is_finite(point))
      return Error{ErrorCode::kNotFinite, "a point of a region is not finite"};
    object.points.push_back(detail::vector_of(point));
  }
  if (region.size() < 2 || region.size() == 3) {
    return Error{ErrorCode::kOutOfRange,
                 "a region is a box of 2 corners or a hull of at least 4 "
                 "points"};
  }
  State::GivenModel& in = state.models[static_cast<std::size_t>(owner)];
  const std::pair<std::int32_t, io::RegionPoints> only = {model, object.points};
  const Result<Model> alone = io::model_on_grid(in.scene, {&only, 1});
  if (!alone) return alone.error();
  object.region = alone->objects[0].region;
  const ObjectRegion& box = object.region;
  if (box.low.x >= box.high.x || box.low.y >= box.high.y ||
      box.low.z >= box.high.z)
    return Error{ErrorCode::kOutOfRange, "a region is empty"};
  for (std::size_t k = 1; k < state.objects.size(); ++k) {
    const State::GivenObject& other = state.objects[k];
    if (other.is_gone || other.owner != owner ||
        !share_space(other.region, object.region))
      continue;
    return Error{ErrorCode::kOutOfRange,
                 "the region shares space with that of object " +
                     std::to_string(k) + "; move them apart",
                 static_cast<std::int64_t>(k)};
  }
  in.is_changed = true;
  state.objects.push_back(std::move(object));
  return static_cast<std::int32_t>(state.objects.size()) - 1;
}

Result<Done> MovingDisplay::remove(std::int32_t object) {
  const Lock lock(state_->mutex);
  const Result<Done> known = state_->known(object);
  if (!known) return known;
  State::GivenObject& gone = state_->objects[static_cast<std::size_t>(object)];
  gone.is_gone = true;
  state_->models[static_cast<std::size_t>(gone.owner)].is_changed = true;
  return Done{};
}

Result<Done> MovingDisplay::place(std::int32_t object, const AffineMap& map) {
  const Lock lock(state_->mutex);
  const Result<Done> known = state_->known(object);
  if (!known) return known;
  for (const auto& row : map) {
    for (const double entry : row) {
      if (!std::isfinite(entry))
        return Error{ErrorCode::kNotFinite, "a number of a map is not finite"};
    }
  }
  state_->objects[static_cast<std::size_t>(object)].map = map;
  return Done{};
}

Result<Done> MovingDisplay::hide(std::int32_t object) {
  const Lock lock(state_->mutex);
  const Result<Done> known = state_->known(object);
  if (known) state_->objects[static_cast<std::size_t>(object)].map.reset();
  return known;
}

Result<MovingPicture> MovingDisplay::render(const View& view) const {
  State& state = *state_;
  const bool is_exact = view.anti_aliasing == AntiAliasing::kExactArea;
  if (view.back_color && is_exact) return detail::no_marks();
  if (view.alpha != kOpaque && is_exact)
    return detail::no_alpha("in pictures of exact areas");
  const Result<Look> look = detail::look_of(view);
  if (!look) return look.error();
  const Lock lock(state.mutex);
  const Result<Done> prepared = state.prepare(view);
  if (!prepared) return prepared.error();
  const Assembly& assembly = state.made->assembly;
  const Result<Camera> camera =
      detail::camera_of(assembly.models()[0].scene, view);
  if (!camera) return camera.error();
  const Result<Placement> placement = state.placed();
  if (!placement) return placement.error();
  const Result<ImageOptions> options = state.options_of(view);
  if (!options) return options.error();
  const bool is_plain =
      look->alpha == kOpaque && look->samples == 1 && !look->mark && !is_exact;
  if (!is_plain) {
    Result<fast::Rendering> image =
        state.flat_image(view, *look, *placement, *camera, *options);
    if (!image) return image.error();
    return state.picture_of(*std::move(image), view.caps_by_solid);
  }
  fast::RenderOptions how;
  how.threads = std::max(view.threads, 0);
  return state.picture_of(
      fast::render_moving(assembly, state.made->trees, *placement, *camera,
                          *options, how),
      view.caps_by_solid);
}

Result<Done> MovingPicture::save(const std::filesystem::path& path) const {
  return io::write_png(path, colors);
}

}  // namespace halfspace
