#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <utility>

#include "display_state.hpp"
#include "halfspace/fast/scan.hpp"
#include "halfspace/fast/traverse.hpp"
#include "halfspace/io/number.hpp"

/// A display's polygons in order, and a screen for who draws them.
namespace halfspace {
namespace {

using glm::dvec3;

/// What a camera's image point is in the image, as a matrix: with it the
/// direction to a point becomes (t x, t y, t).
class Projection {
 public:
  Projection(const Camera& camera, double step) : data_(camera.data()) {
    const dvec3 sx = vector_of(data_.sx), sy = vector_of(data_.sy);
    const dvec3 eye = vector_of(data_.eye);
    const dvec3 s0 = vector_of(data_.s0);
    origin_ = data_.perspective ? eye : s0;
    to_image_ =
        glm::inverse(glm::dmat3(sx, sy, data_.perspective ? s0 - eye : -eye));
    scale_ = kSteps / step;
  }

  /// The polygon in the image, cut where it reaches behind the eye.
  std::vector<Point2> projected(const std::vector<Point>& points) const {
    std::vector<dvec3> at;
    for (const Point& p : points)
      at.push_back(to_image_ * (scale_ * dvec3(p.x, p.y, p.z) - origin_));
    std::vector<Point2> result;
    if (!data_.perspective) {
      for (const dvec3& p : at) result.push_back({p.x, p.y});
      return result;
    }
    double most = 0;
    for (const dvec3& p : at) most = std::max(most, std::abs(p.z));
    const double least = most * 1e-9;
    for (std::size_t i = 0; i < at.size(); ++i) {
      const dvec3& p = at[i];
      const dvec3& q = at[(i + 1) % at.size()];
      if (p.z > least) result.push_back({p.x / p.z, p.y / p.z});
      if ((p.z > least) != (q.z > least)) {
        const dvec3 cut = p + (least - p.z) / (q.z - p.z) * (q - p);
        result.push_back({cut.x / least, cut.y / least});
      }
    }
    return result;
  }

 private:
  static constexpr double kSteps = 1 << kLatticeBits;
  static dvec3 vector_of(const LatticeVector& v) {
    return {static_cast<double>(v.x), static_cast<double>(v.y),
            static_cast<double>(v.z)};
  }

  const CameraData& data_;
  dvec3 origin_;
  glm::dmat3 to_image_;
  double scale_ = 1;
};

}  // namespace

struct SeenPolygon::Source {
  const Scene& scene;
  const fast::BspTree& tree;
  const fast::TreeFragment& fragment;
  const Camera& camera;
};

std::vector<PixelSpan> SeenPolygon::spans() const {
  fast::FilterStats stats;
  std::vector<PixelSpan> result;
  for (const fast::ObjectSegment& segment :
       fast::scan_convert(source->scene, source->tree, source->fragment,
                          source->camera, stats))
    result.push_back({segment.line, segment.span.first, segment.span.last});
  return result;
}

namespace {

/// Hands out the fragments that a traversal finds.
template <class Traverse>
Result<Done> visit_all(const Scene& scene, const fast::BspTree* made,
                       const std::vector<PolygonId>& faces, const View& view,
                       const Visit& visit, const Traverse& traverse) {
  if (!view.clips.empty()) {
    return Error{ErrorCode::kOutOfRange,
                 "traversals do not cut by clip planes; cut solids by "
                 "Solid::split()"};
  }
  if (view.back_color) return detail::no_marks();
  if (made == nullptr) return detail::stopped();
  const fast::BspTree& tree = *made;
  const Result<Camera> camera = detail::camera_of(scene, view);
  if (!camera) return camera.error();
  const double step = detail::step_of(scene.unit());
  const Projection projection(*camera, step);
  const auto point_count = scene.data().vertices.size();
  const auto point_of = [&](std::int32_t vertex) -> Point {
    const auto v = static_cast<std::size_t>(vertex);
    if (v < point_count) {
      const GridPoint& p = scene.data().vertices[v];
      return {step * static_cast<double>(p.x), step * static_cast<double>(p.y),
              step * static_cast<double>(p.z)};
    }
    const fast::Vertex& p = tree.cut_vertices[v - point_count];
    return {step * p.x, step * p.y, step * p.z};
  };
  SeenPolygon seen;
  fast::FilterStats stats;
  traverse(tree, scene, *camera,
           [&](const fast::Node&, const fast::TreeFragment& fragment) {
             if (view.cull && fast::side_of_eye(scene, fragment.source, *camera,
                                                stats) == Side::kNegative)
               return true;
             const SeenPolygon::Source source{scene, tree, fragment, *camera};
             seen.polygon = faces[static_cast<std::size_t>(fragment.source)];
             seen.color = scene.color(fragment.source);
             seen.points.clear();
             for (std::uint32_t k = 0; k < fragment.corner_count; ++k)
               seen.points.push_back(
                   point_of(tree.corners[fragment.first_corner + k].vertex));
             seen.projected = projection.projected(seen.points);
             seen.source = &source;
             return visit(seen);
           });
  return Done{};
}

}  // namespace

Result<Done> Display::front_to_back(const View& view,
                                    const Visit& visit) const {
  return visit_all(state_->scene, state_->ordered_tree(view), state_->faces,
                   view, visit, fast::front_to_back);
}

Result<Done> Display::back_to_front(const View& view,
                                    const Visit& visit) const {
  return visit_all(state_->scene, state_->ordered_tree(view), state_->faces,
                   view, visit, fast::back_to_front);
}

Result<Done> Display::scan(const View& view, const Paint& paint) const {
  if (view.width_px < 1 || view.height_px < 1) return detail::no_pixels();
  DynamicScreen screen(view.width_px, view.height_px);
  return front_to_back(view, [&](const SeenPolygon& polygon) {
    for (const PixelSpan& span : screen.light(polygon.spans()))
      paint(polygon, span);
    return !screen.is_full();
  });
}

struct DynamicScreen::State {
  fast::DynamicScreen screen;
};

DynamicScreen::DynamicScreen(std::int32_t width_px, std::int32_t height_px)
    : state_(new State{fast::DynamicScreen(width_px, height_px)}) {}
DynamicScreen::DynamicScreen(DynamicScreen&&) noexcept = default;
DynamicScreen& DynamicScreen::operator=(DynamicScreen&&) noexcept = default;
DynamicScreen::~DynamicScreen() = default;

std::vector<PixelSpan> DynamicScreen::light(std::span<const PixelSpan> spans) {
  std::vector<fast::ObjectSegment> objects;
  for (const PixelSpan& s : spans)
    objects.push_back({s.line, {s.first, s.last}});
  std::vector<PixelSpan> lit;
  for (const fast::ObjectSegment& s : state_->screen.light(objects))
    lit.push_back({s.line, s.span.first, s.span.last});
  return lit;
}

bool DynamicScreen::is_full() const { return state_->screen.full(); }

}  // namespace halfspace
