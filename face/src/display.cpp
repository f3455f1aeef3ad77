#include "halfspace/display.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <numbers>
#include <string>
#include <utility>

#include "halfspace/boolean.hpp"
#include "halfspace/csg/exact.hpp"
#include "halfspace/fast/area_image.hpp"
#include "halfspace/fast/display_tree.hpp"
#include "halfspace/fast/drawing.hpp"
#include "halfspace/fast/ray.hpp"
#include "halfspace/fast/render.hpp"
#include "halfspace/fast/scan.hpp"
#include "halfspace/fast/traverse.hpp"
#include "halfspace/io/clip.hpp"
#include "halfspace/io/figure.hpp"
#include "halfspace/io/import.hpp"
#include "halfspace/io/load_scene.hpp"
#include "halfspace/io/picture.hpp"
#include "halfspace/io/ray.hpp"
#include "halfspace/io/read_mesh.hpp"
#include "halfspace/io/view.hpp"
#include "halfspace/threads.hpp"
#include "import.hpp"
#include "node.hpp"
#include "number.hpp"

namespace halfspace {
namespace {

using glm::dvec3;

/// A camera's lattice is 2^8 times finer than the grid (S4.1), so small
/// integers need a finer grid for a smooth choice of eyes: of 20 bits an eye
/// moves by less than a millionth of the scene.
constexpr int kRefineBits = 20;

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

double step_of(const Unit& unit) {
  return io::to_double({1, unit.exponent, unit.base == 10 ? unit.exponent : 0});
}

dvec3 vector_of(const Point& p) { return {p.x, p.y, p.z}; }

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
                       : dvec3(0, vertical ? 1 : 0, vertical ? 0 : 1);
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

/// The clip planes of a view (S10.1): a normal of 1 and its offset in the steps
/// of the scene.
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

std::int32_t samples_of(const View& view) {
  return view.anti_aliasing == AntiAliasing::kExactArea
             ? 1
             : static_cast<std::int32_t>(view.anti_aliasing);
}

Error stopped() { return {ErrorCode::kStopped, "the work was stopped"}; }

io::Mesh exact_mesh(const Mesh& mesh) {
  detail::ExactPoints exact = detail::exact_points(mesh.vertices);
  io::Mesh result;
  result.vertices = std::move(exact.points);
  result.decimal = exact.decimal;
  result.first_corner = mesh.first_corner;
  result.corners = mesh.corners;
  result.face_colors.assign(mesh.colors.begin(), mesh.colors.end());
  return result;
}

/// Adds the polygons of one mesh to another.
void append(const io::Mesh& from, io::Mesh& to) {
  const auto first = static_cast<VertexId>(to.vertices.size());
  to.face_colors.resize(to.face_count());
  to.vertex_colors.clear();
  to.vertices.insert(to.vertices.end(), from.vertices.begin(),
                     from.vertices.end());
  for (std::size_t p = 0; p < from.face_count(); ++p) {
    for (std::size_t i = from.first_corner[p]; i < from.first_corner[p + 1];
         ++i)
      to.corners.push_back(first + from.corners[i]);
    to.first_corner.push_back(static_cast<std::uint32_t>(to.corners.size()));
    to.face_colors.push_back(from.face_colors.empty() ? std::nullopt
                                                      : from.face_colors[p]);
  }
}

}  // namespace

struct Display::State {
  io::Mesh mesh;  ///< empty of a scene file
  Scene scene;
  std::vector<PolygonId> faces;  ///< by polygon of the scene
  std::size_t polygon_count = 0;
  std::vector<std::int32_t> solid_starts = {0};  ///< its first polygon

  /// The tree for pictures, and one without leaves; made when first needed.
  Mutex mutex;
  std::optional<fast::BspTree> tree;
  std::optional<fast::BspTree> ordered;
  std::optional<bool> closed;

  /// What a view says about its image; whether caps can be is looked at once.
  Result<ImageOptions> options_of(const View& view) {
    ImageOptions options;
    options.cull = view.cull;
    options.background = view.background;
    const auto clips = clips_of(scene, view);
    if (!clips) return clips.error();
    options.clips = *clips;
    if (!view.caps) return options;
    options.caps = view.caps;
    const Lock lock(mutex);
    if (!closed) closed = bad_edges(scene).empty();
    if (*closed) return options;
    return Error{ErrorCode::kOpen,
                 "caps fill solids, and what is displayed is not closed"};
  }

  static Result<std::unique_ptr<State>> of(io::Mesh mesh) {
    auto state = std::make_unique<State>();
    io::ImportOptions options;
    options.refine_bits = kRefineBits;
    Result<io::Imported> imported = io::import_scene(mesh, options);
    if (!imported) return imported.error();
    if (imported->scene.polygon_count() == 0) {
      return Error{ErrorCode::kEmpty, "there are no polygons to look at"};
    }
    state->polygon_count = mesh.face_count();
    state->mesh = std::move(mesh);
    state->scene = std::move(imported->scene);
    state->faces = std::move(imported->faces);
    return state;
  }

  /// Null where view.progress stopped it.
  const fast::BspTree* picture_tree(const View& view) {
    const Lock lock(mutex);
    if (tree) return &*tree;
    fast::DisplayTreeOptions options;
    options.threads = std::max(view.threads, 0);
    options.progress = view.progress;
    fast::BspTree made = fast::build_display_tree(scene, options);
    if (made.nodes.empty()) return nullptr;
    tree = std::move(made);
    return &*tree;
  }
  const fast::BspTree& picture_tree() { return *picture_tree(View{}); }
  const fast::BspTree* ordered_tree(const View& view) {
    const fast::BspTree* made = picture_tree(view);
    if (made == nullptr) return nullptr;
    const Lock lock(mutex);
    if (!ordered) {
      ordered = *made;
      fast::divide_leaves(*ordered, scene);
    }
    return &*ordered;
  }
  /// The polygon of the display that a polygon of the scene is part of, and its
  /// solid. Solids without polygons begin where the next one does.
  std::int32_t polygon_of(PolygonId id) const {
    const auto index = static_cast<std::size_t>(id);
    if (index < faces.size()) return faces[index];
    return static_cast<std::int32_t>(polygon_count + index - faces.size());
  }
  std::int32_t solid_of(std::int32_t polygon) const {
    const auto next =
        std::upper_bound(solid_starts.begin(), solid_starts.end(), polygon);
    return static_cast<std::int32_t>(next - solid_starts.begin()) - 1;
  }
  Hit hit_of(const RayHit& hit, const Ray& ray) const {
    const std::int32_t polygon = polygon_of(hit.polygon);
    const dvec3 point = io::point_of(hit, ray, scene.unit());
    return {polygon,
            solid_of(polygon),
            {point.x, point.y, point.z},
            io::distance_of(hit, ray, scene.unit()),
            io::parameter_of(hit),
            io::exact_parameter_of(hit)};
  }
  std::vector<Hit> hits_of(const Ray& ray) {
    std::vector<Hit> result;
    for (const RayHit& hit : fast::all_hits(scene, picture_tree(), ray))
      result.push_back(hit_of(hit, ray));
    return result;
  }

  Result<fast::Rendering> rendered(const View& view,
                                   const std::optional<fast::Rectangle>& part) {
    const Result<Camera> camera = camera_of(scene, view);
    if (!camera) return camera.error();
    const Result<ImageOptions> options = options_of(view);
    if (!options) return options.error();
    fast::RenderOptions how;
    how.threads = detail::thread_count(view.threads);
    how.rectangle = part;
    const auto samples = part ? 1 : samples_of(view);
    if (std::max(view.width_px, view.height_px) > kMaxImageSize / samples) {
      return Error{ErrorCode::kOutOfRange,
                   "a picture with " + std::to_string(samples) +
                       " samples a pixel each way has at most " +
                       std::to_string(kMaxImageSize / samples) +
                       " columns and rows"};
    }
    const fast::BspTree* made = picture_tree(view);
    if (made == nullptr) return stopped();
    if (view.anti_aliasing != AntiAliasing::kNone && !options->clips.empty()) {
      return Error{ErrorCode::kOutOfRange,
                   "anti-aliasing is not for clip planes; leave out either"};
    }
    fast::Rendering image =
        samples == 1 ? fast::render(scene, *made, *camera, *options, how)
                     : fast::render_samples(scene, *made, *camera, *options,
                                            samples, how);
    if (!part && view.anti_aliasing == AntiAliasing::kExactArea) {
      const fast::BspTree* divided = ordered_tree(view);
      if (divided == nullptr) return stopped();
      Result<fast::AreaImage> areas =
          fast::render_area(scene, *divided, *camera, *options);
      if (!areas) return areas.error();
      image.colors = std::move(areas->colors);
    }
    for (PolygonId& id : image.items.pixels) {
      if (id != kBackground) id = polygon_of(id);
    }
    return image;
  }
};

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

Result<Done> Picture::save(const std::filesystem::path& path) const {
  return io::write_png(path, colors);
}

Display::Display(std::unique_ptr<State> state) : state_(std::move(state)) {}
Display::Display(Display&&) noexcept = default;
Display& Display::operator=(Display&&) noexcept = default;
Display::~Display() = default;

Result<Display> Display::of(Mesh mesh) {
  if (const auto fault = detail::fault_of(mesh)) return *fault;
  auto state = State::of(exact_mesh(mesh));
  if (!state) return state.error();
  return Display(*std::move(state));
}

Result<Display> Display::of(const Solid& solid) {
  return of(std::span(&solid, 1));
}

Result<Display> Display::of(std::span<const Solid> solids) {
  io::Mesh all;
  std::vector<std::int32_t> starts;
  for (const Solid& solid : solids) {
    const Result<Mesh> mesh = solid.mesh();
    if (!mesh) return mesh.error();
    const io::Mesh exact = exact_mesh(*mesh);
    all.decimal = exact.decimal && (starts.empty() || all.decimal);
    starts.push_back(static_cast<std::int32_t>(all.face_count()));
    append(exact, all);
  }
  auto state = State::of(std::move(all));
  if (!state) return state.error();
  (*state)->solid_starts = std::move(starts);
  return Display(*std::move(state));
}

Result<Display> Display::of_file(const std::filesystem::path& path) {
  const std::string name = path.string();
  if (!io::is_scene_name(path) && !io::is_solid_name(path)) {
    Result<io::Mesh> mesh = io::read_mesh(path);
    if (!mesh) return mesh.error();
    auto state = State::of(*std::move(mesh));
    if (!state) return io::error_about(name, state.error());
    return Display(*std::move(state));
  }
  Result<io::LoadedScene> loaded = csg::load_scene(name, {});
  if (!loaded) return loaded.error();
  auto state = std::make_unique<State>();
  state->scene = std::move(loaded->file.scene);
  state->faces = std::move(loaded->polygons);
  state->polygon_count = state->scene.polygon_count();
  return Display(std::move(state));
}

std::size_t Display::polygon_count() const { return state_->polygon_count; }

const Scene& Display::scene() const { return state_->scene; }

std::span<const std::int32_t> Display::polygons_of_scene() const {
  return state_->faces;
}

Result<Camera> Display::camera(const View& view) const {
  return camera_of(state_->scene, view);
}

Result<Picture> Display::render(const View& view) const {
  Result<fast::Rendering> image = state_->rendered(view, std::nullopt);
  if (!image) return image.error();
  return Picture{std::move(image->colors), std::move(image->items)};
}

Result<Done> LineDrawing::save(const std::filesystem::path& path,
                               bool with_hidden) const {
  io::Figure figure;
  figure.width = width_px;
  figure.height = height_px;
  for (const bool hidden : {true, false}) {
    if (hidden && !with_hidden) continue;
    io::FigureStrokes strokes;
    strokes.name = hidden ? "hidden" : "visible";
    strokes.width = hidden ? 0.5 : 1;
    if (hidden) strokes.dashes = {4, 3};
    for (const DrawnLine& line : lines) {
      if ((line.layers > 0) != hidden) continue;
      strokes.strokes.push_back(
          {{line.from.x, line.from.y}, {line.to.x, line.to.y}, {}});
    }
    io::order_for_pen(strokes.strokes);
    figure.strokes.push_back(std::move(strokes));
  }
  return io::write_figure(path, figure);
}

Result<LineDrawing> Display::draw(const View& view, double crease_deg) const {
  if (!(crease_deg >= 0 && crease_deg <= 180)) {
    return Error{ErrorCode::kOutOfRange,
                 "the crease angle is not from 0 to 180 degrees"};
  }
  const Result<Camera> camera = camera_of(state_->scene, view);
  if (!camera) return camera.error();
  DrawingOptions options;
  options.cull = view.cull;
  options.crease_cosine = static_cast<std::int32_t>(std::lround(
      std::ldexp(std::cos(crease_deg * std::numbers::pi / 180), kCosineBits)));
  const auto drawing = fast::draw(state_->scene, *camera, options);
  if (!drawing) return drawing.error();
  LineDrawing result{view.width_px, view.height_px, {}};
  for (const fast::Stroke& stroke : drawing->strokes) {
    result.lines.push_back({{stroke.from.x, stroke.from.y},
                            {stroke.to.x, stroke.to.y},
                            stroke.edge_class,
                            stroke.layers});
  }
  return result;
}

Result<std::optional<Pick>> Display::pick(const View& view, std::int32_t x,
                                          std::int32_t y) const {
  if (x < 0 || y < 0 || x >= view.width_px || y >= view.height_px)
    return std::optional<Pick>();
  const Scene& scene = state_->scene;
  const Result<Camera> camera = camera_of(scene, view);
  if (!camera) return camera.error();
  const Result<ImageOptions> options = state_->options_of(view);
  if (!options) return options.error();
  const fast::BspTree* tree = state_->picture_tree(view);
  if (tree == nullptr) return stopped();
  const PolygonId seen = fast::pick(scene, *tree, *camera, *options, x, y);
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

Result<std::optional<Hit>> Display::first_hit(const Point& from,
                                              const Point& along) const {
  const auto made =
      io::ray_along(state_->scene, vector_of(from), vector_of(along));
  if (!made) return made.error();
  const auto hit =
      fast::first_hit(state_->scene, state_->picture_tree(), made->ray);
  if (!hit) return std::optional<Hit>();
  return std::optional(state_->hit_of(*hit, made->ray));
}

Result<std::vector<Hit>> Display::all_hits(const Point& from,
                                           const Point& along) const {
  const auto made =
      io::ray_along(state_->scene, vector_of(from), vector_of(along));
  if (!made) return made.error();
  return state_->hits_of(made->ray);
}

Result<std::vector<Hit>> Display::hits_between(const Point& from,
                                               const Point& to) const {
  const auto made = io::ray_between(state_->scene, vector_of(from),
                                    vector_of(to), Reach::kSegment);
  if (!made) return made.error();
  return state_->hits_of(made->ray);
}

Result<bool> Display::see_each_other(const Point& a, const Point& b) const {
  const auto made = io::ray_between(state_->scene, vector_of(a), vector_of(b),
                                    Reach::kBetween);
  if (!made) return made.error();
  return fast::see_each_other(state_->scene, state_->picture_tree(), made->ray);
}

namespace {

/// Hands out the fragments that a traversal finds.
template <class Traverse>
Result<Done> visit_all(const Scene& scene, const fast::BspTree* made,
                       const std::vector<PolygonId>& faces, const View& view,
                       const Visit& visit, const Traverse& traverse) {
  if (made == nullptr) return stopped();
  const fast::BspTree& tree = *made;
  const Result<Camera> camera = camera_of(scene, view);
  if (!camera) return camera.error();
  const double step = step_of(scene.unit());
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
  traverse(tree, scene, *camera,
           [&](const fast::Node&, const fast::TreeFragment& fragment) {
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
  if (view.width_px < 1 || view.height_px < 1) return no_pixels();
  DynamicScreen screen(view.width_px, view.height_px);
  return front_to_back(view, [&](const SeenPolygon& polygon) {
    for (const PixelSpan& span : screen.light(polygon.spans()))
      paint(polygon, span);
    return !screen.is_full();
  });
}

Result<Done> Display::insert(const Mesh& mesh) {
  if (const auto fault = detail::fault_of(mesh)) return *fault;
  if (state_->mesh.face_count() == 0) {
    return Error{ErrorCode::kUnknownFormat,
                 "a display of a scene file takes no more polygons"};
  }
  const io::Mesh more = exact_mesh(mesh);
  io::Mesh all = state_->mesh;
  all.decimal = all.decimal && more.decimal;
  append(more, all);
  auto next = State::of(std::move(all));
  if (!next) return next.error();
  (*next)->solid_starts = state_->solid_starts;
  const Scene& before = state_->scene;
  const Scene& after = (*next)->scene;
  // The polygons that were there are the first ones, in the same steps.
  if (state_->ordered && before.unit() == after.unit() &&
      before.grid_bits() == after.grid_bits()) {
    fast::BspTree tree = std::move(*state_->ordered);
    // Vertices are numbered anew, for cuts come after those of the scene.
    const auto more_points = static_cast<std::int32_t>(
        after.data().vertices.size() - before.data().vertices.size());
    const auto points =
        static_cast<std::int32_t>(before.data().vertices.size());
    const auto polygons = static_cast<std::int32_t>(before.polygon_count());
    const auto more_polygons =
        static_cast<std::int32_t>(after.polygon_count()) - polygons;
    for (fast::Corner& corner : tree.corners) {
      if (corner.vertex >= points) corner.vertex += more_points;
      if (-1 - corner.edge >= polygons) corner.edge -= more_polygons;
    }
    for (fast::Node& node : tree.nodes) {
      if (node.splitter >= polygons) node.splitter += more_polygons;
    }
    tree.boxes.clear();
    tree.triangles.clear();
    tree.quadrangles.clear();
    tree.first_blocks.clear();
    for (std::int32_t p = 0; p < more_polygons; ++p)
      fast::insert(tree, after, polygons + p);
    (*next)->tree = tree;
    (*next)->ordered = std::move(tree);
  }
  state_ = *std::move(next);
  return Done{};
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
