#include "halfspace/io/view.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "display_state.hpp"
#include "halfspace/boolean.hpp"
#include "halfspace/cap_parts.hpp"
#include "halfspace/fast/area_image.hpp"
#include "halfspace/fast/ray.hpp"
#include "halfspace/fast/shade/look.hpp"
#include "halfspace/io/clip.hpp"
#include "halfspace/io/number.hpp"
#include "halfspace/io/picture.hpp"
#include "halfspace/io/ray.hpp"
#include "number.hpp"

/// Pictures of a display, cut open by clip planes or whole, and what is seen at
/// a pixel.
namespace halfspace {
namespace detail {

glm::dvec3 vector_of(const Point& p) { return {p.x, p.y, p.z}; }

Error no_pixels() {
  return {ErrorCode::kOutOfRange, "the picture has no columns or no rows"};
}

Result<Camera> camera_of(const Scene& scene, const View& view) {
  if (view.width_px < 1 || view.height_px < 1) return no_pixels();
  io::ViewOptions options;
  if (!view.eye || !view.target) {
    const auto automatic =
        io::automatic_view(scene, view.width_px, view.height_px);
    if (!automatic) return automatic.error();
    options = automatic->options;
  }
  if (view.eye) options.eye = vector_of(*view.eye);
  if (view.target) options.target = vector_of(*view.target);
  const bool vertical =
      options.eye.x == options.target.x && options.eye.y == options.target.y;
  options.up = view.up ? vector_of(*view.up)
                       : glm::dvec3(0, vertical ? 1 : 0, vertical ? 0 : 1);
  options.fov_deg = view.fov_deg;
  options.orthographic = view.orthographic;
  options.ortho_height = view.ortho_height;
  options.near = view.near;
  options.width_px = view.width_px;
  options.height_px = view.height_px;
  auto viewed = io::look_at(scene, options);
  if (!viewed) return viewed.error();
  return viewed->camera;
}

double step_of(const Unit& unit) {
  return io::to_double({1, unit.exponent, unit.base == 10 ? unit.exponent : 0});
}

Error stopped() { return {ErrorCode::kStopped, "the work was stopped"}; }

Error no_marks() {
  return {ErrorCode::kOutOfRange,
          "back faces are marked in pictures of samples alone"};
}

Error no_alpha(const char* where) {
  return {ErrorCode::kOutOfRange,
          std::string("polygons are opaque ") + where + "; leave out alpha"};
}

Result<std::vector<ClipPlane>> clips_of(const Scene& scene, const View& view) {
  std::vector<ClipPlane> planes;
  for (const Plane& plane : view.clips) {
    if (!detail::is_finite(plane.normal) || !std::isfinite(plane.offset)) {
      return Error{ErrorCode::kNotFinite,
                   "a number of a clip plane is not finite"};
    }
    const Result<ClipPlane> made = io::clip_plane(
        scene,
        {detail::number_of(plane.normal.x), detail::number_of(plane.normal.y),
         detail::number_of(plane.normal.z), detail::number_of(-plane.offset)});
    if (!made) return made.error();
    planes.push_back(*made);
  }
  return make_clips(planes, scene.grid_bits());
}

Result<Look> look_of(const View& view) {
  const std::int32_t samples =
      view.anti_aliasing == AntiAliasing::kExactArea
          ? 1
          : static_cast<std::int32_t>(view.anti_aliasing);
  if (std::max(view.width_px, view.height_px) > kMaxImageSize / samples) {
    return Error{ErrorCode::kOutOfRange,
                 "a picture with " + std::to_string(samples) +
                     " samples a pixel each way has at most " +
                     std::to_string(kMaxImageSize / samples) +
                     " columns and rows"};
  }
  return Look{view.alpha, samples, view.back_color};
}

}  // namespace detail

Result<ImageOptions> Display::State::options_of(const View& view) {
  ImageOptions options;
  options.cull = view.cull;
  options.background = view.background;
  const auto clips = detail::clips_of(scene, view);
  if (!clips) return clips.error();
  options.clips = *clips;
  if (!view.caps) return options;
  options.caps = view.caps;
  const Lock lock(mutex);
  if (!closed) closed = bad_edges(scene).empty();
  if (!*closed) {
    return Error{ErrorCode::kOpen,
                 "caps fill solids, and what is displayed is not closed"};
  }
  if (!view.caps_by_solid) return options;
  auto parts = cap_parts_of(view);
  if (!parts) return parts.error();
  options.parts = *std::move(parts);
  return options;
}

Result<std::shared_ptr<const CapParts>> Display::State::cap_parts_of(
    const View& view) {
  if (!solids) {
    std::vector<std::uint32_t> own;
    for (std::size_t p = 0; p < scene.polygon_count(); ++p) {
      const std::int32_t polygon = polygon_of(static_cast<PolygonId>(p));
      own.push_back(static_cast<std::uint32_t>(solid_of(polygon)));
    }
    solids_closed = are_parts_closed(scene, own);
    solids = std::move(own);
  }
  if (solids_closed) return told_apart(*solids, *view.caps);
  return Error{ErrorCode::kOpen,
               "caps fill solids, and one of those displayed is not closed"};
}

Result<fast::Rendering> Display::State::rendered(
    const View& view, const fast::ScalarColors* scalars) {
  const bool is_exact = view.anti_aliasing == AntiAliasing::kExactArea;
  if (view.back_color && is_exact) return detail::no_marks();
  if (view.alpha != kOpaque && is_exact)
    return detail::no_alpha("in pictures of exact areas");
  const Result<Camera> camera = detail::camera_of(scene, view);
  if (!camera) return camera.error();
  const Result<ImageOptions> options = options_of(view);
  if (!options) return options.error();
  fast::RenderOptions how;
  how.threads = std::max(view.threads, 0);
  const Result<Look> look = detail::look_of(view);
  if (!look) return look.error();
  fast::Rendering image;
  const fast::LazyTree* opened =
      view.lazy && !is_exact ? opened_tree(view.threads) : nullptr;
  if (opened != nullptr) {
    image = fast::render_look(*opened, *camera, *options, *look, how, scalars);
  } else {
    const fast::BspTree* made = picture_tree(view);
    if (made == nullptr) return detail::stopped();
    image =
        fast::render_look(scene, *made, *camera, *options, *look, how, scalars);
  }
  if (is_exact) {
    const fast::BspTree* divided = ordered_tree(view);
    if (divided == nullptr) return detail::stopped();
    image.colors =
        fast::render_area(scene, *divided, *camera, *options, how.threads)
            .colors;
  }
  for (PolygonId& id : image.items.pixels) {
    if (id != kBackground) id = polygon_of(id);
  }
  return image;
}

Result<Done> Picture::save(const std::filesystem::path& path) const {
  return io::write_png(path, colors);
}

Result<Camera> Display::camera(const View& view) const {
  return detail::camera_of(state_->scene, view);
}

Result<Picture> Display::render(const View& view) const {
  Result<fast::Rendering> image = state_->rendered(view);
  if (!image) return image.error();
  return Picture{std::move(image->colors), std::move(image->items)};
}

Result<std::optional<Pick>> Display::pick(const View& view, std::int32_t x,
                                          std::int32_t y) const {
  if (x < 0 || y < 0 || x >= view.width_px || y >= view.height_px)
    return std::optional<Pick>();
  const Scene& scene = state_->scene;
  const Result<Camera> camera = detail::camera_of(scene, view);
  if (!camera) return camera.error();
  const Result<ImageOptions> options = state_->options_of(view);
  if (!options) return options.error();
  const fast::LazyTree* opened =
      view.lazy ? state_->opened_tree(view.threads) : nullptr;
  const fast::BspTree* tree =
      opened != nullptr ? nullptr : state_->picture_tree(view);
  if (opened == nullptr && tree == nullptr) return detail::stopped();
  const PolygonId seen =
      opened != nullptr ? fast::pick(*opened, *camera, *options, x, y)
                        : fast::pick(scene, *tree, *camera, *options, x, y);
  if (seen == kBackground) return std::optional<Pick>();
  const std::int32_t polygon = state_->polygon_of(seen);
  if (seen >= static_cast<PolygonId>(scene.polygon_count()))
    return std::optional(Pick{polygon, -1, {}, 0});
  const io::PixelPoint at = io::pixel_point(scene, *camera, seen, x, y);
  return std::optional(Pick{polygon,
                            state_->solid_of(polygon),
                            {at.point.x, at.point.y, at.point.z},
                            at.distance});
}

}  // namespace halfspace
