#include <utility>

#include "display_state.hpp"
#include "halfspace/fast/image/lazy_tree.hpp"
#include "halfspace/fast/ray.hpp"
#include "halfspace/io/ray.hpp"

/// Rays through a display: through the whole tree where there is one, and else
/// through one that is built as they go (S3.12).
namespace halfspace {

Hit Display::State::hit_of(const RayHit& hit, const Ray& ray) const {
  const std::int32_t polygon = polygon_of(hit.polygon);
  const glm::dvec3 point = io::point_of(hit, ray, scene.unit());
  return {polygon,
          solid_of(polygon),
          {point.x, point.y, point.z},
          io::distance_of(hit, ray, scene.unit()),
          io::parameter_of(hit),
          io::exact_parameter_of(hit)};
}

std::vector<Hit> Display::State::hits_of(const Ray& ray) {
  const fast::LazyTree* opened = opened_tree(0);
  const auto hits = opened != nullptr
                        ? fast::all_hits(*opened, ray)
                        : fast::all_hits(scene, picture_tree(), ray);
  std::vector<Hit> result;
  for (const RayHit& hit : hits) result.push_back(hit_of(hit, ray));
  return result;
}

Result<std::optional<Hit>> Display::first_hit(const Point& from,
                                              const Point& along) const {
  const auto made = io::ray_along(state_->scene, detail::vector_of(from),
                                  detail::vector_of(along));
  if (!made) return made.error();
  const fast::LazyTree* opened = state_->opened_tree(0);
  const auto hit =
      opened != nullptr
          ? fast::first_hit(*opened, made->ray)
          : fast::first_hit(state_->scene, state_->picture_tree(), made->ray);
  if (!hit) return std::optional<Hit>();
  return std::optional(state_->hit_of(*hit, made->ray));
}

Result<std::vector<Hit>> Display::all_hits(const Point& from,
                                           const Point& along) const {
  const auto made = io::ray_along(state_->scene, detail::vector_of(from),
                                  detail::vector_of(along));
  if (!made) return made.error();
  return state_->hits_of(made->ray);
}

Result<std::vector<Hit>> Display::hits_between(const Point& from,
                                               const Point& to) const {
  const auto made = io::ray_between(state_->scene, detail::vector_of(from),
                                    detail::vector_of(to), Reach::kSegment);
  if (!made) return made.error();
  return state_->hits_of(made->ray);
}

Result<bool> Display::see_each_other(const Point& a, const Point& b) const {
  const auto made = io::ray_between(state_->scene, detail::vector_of(a),
                                    detail::vector_of(b), Reach::kBetween);
  if (!made) return made.error();
  const fast::LazyTree* opened = state_->opened_tree(0);
  return opened != nullptr
             ? fast::see_each_other(*opened, made->ray)
             : fast::see_each_other(state_->scene, state_->picture_tree(),
                                    made->ray);
}

}  // namespace halfspace
