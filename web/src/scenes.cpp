#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "answer.hpp"
#include "figure/figure_scene.hpp"
#include "figure/figures.hpp"
#include "halfspace/boolean.hpp"
#include "halfspace/cap_parts.hpp"
#include "halfspace/csg/exact.hpp"
#include "halfspace/fast/display_tree.hpp"
#include "halfspace/fast/drawing.hpp"
#include "halfspace/fast/image/transparent_map.hpp"
#include "halfspace/fast/order_feed.hpp"
#include "halfspace/fast/painter.hpp"
#include "halfspace/fast/ray.hpp"
#include "halfspace/fast/render.hpp"
#include "halfspace/fast/shade/back_faces.hpp"
#include "halfspace/fast/shade/scalars.hpp"
#include "halfspace/fast/visible_map.hpp"
#include "halfspace/io/clip.hpp"
#include "halfspace/io/color_map.hpp"
#include "halfspace/io/figure.hpp"
#include "halfspace/io/ray.hpp"
#include "halfspace/io/read_mesh.hpp"
#include "halfspace/io/scalars.hpp"
#include "halfspace/io/view.hpp"

namespace halfspace::tools {

Result<io::LoadedScene> load(const std::string& path,
                             const io::ImportOptions& options) {
  return csg::load_scene(path, options);
}

/// Where memory ends, the module stops: there is nothing to be said of a file.
Result<io::Mesh> read_mesh_file(const std::string&);
Result<io::Mesh> read_mesh_file(const std::string& path) {
  return io::read_mesh(path);
}

}  // namespace halfspace::tools

namespace halfspace::web {
namespace {

/// A scene of files, as the program's `render` and `draw` make it, and its
/// trees, made when they are first needed.
struct WebScene {
  tools::FigureScene figure;
  std::optional<fast::BspTree> tree;     ///< for pictures
  std::optional<fast::BspTree> divided;  ///< without leaves
  std::optional<bool> is_closed;
  std::optional<bool> files_closed;  ///< each by itself
  fast::FragmentVertices fragments;
  std::optional<ScalarField> field;           ///< of a mesh with numbers
  std::optional<fast::ScalarColors> scalars;  ///< its colours
  ColorImage colors;
  std::vector<std::uint32_t> opaque;  ///< the colours with alphas
  ItemImage items;

  const Scene& scene() const { return figure.scene(); }

  /// Null: it was stopped.
  const fast::BspTree* picture_tree() {
    if (tree) return &*tree;
    fast::DisplayTreeOptions options;
    options.progress = goes_on;
    fast::BspTree made = fast::build_display_tree(scene(), options);
    if (made.nodes.empty() && scene().polygon_count() > 0) return nullptr;
    tree = std::move(made);
    return &*tree;
  }
  const fast::BspTree* divided_tree() {
    const fast::BspTree* made = picture_tree();
    if (made == nullptr) return nullptr;
    if (!divided) {
      divided = *made;
      fast::divide_leaves(*divided, scene());
    }
    return &*divided;
  }
};

Error stopped() { return {ErrorCode::kStopped, "the work was stopped"}; }

/// Reads numbers one after another.
class Numbers {
 public:
  explicit Numbers(const double* at) : at_(at) {}
  double next() { return *at_++; }
  glm::dvec3 vector() {
    const double x = next(), y = next(), z = next();
    return {x, y, z};
  }
  Rgb color() {
    const auto channel = [this] { return static_cast<std::uint8_t>(next()); };
    const std::uint8_t r = channel(), g = channel(), b = channel();
    return {r, g, b};
  }

 private:
  const double* at_;
};

/// What JavaScript says about a view: eye, target, up, angle, whether it is
/// orthographic, its height, near, columns, rows, whether to cull, the
/// background; clip planes and whether they have caps, with what colour, one
/// for all or one for each file; whether back faces are marked, with what
/// colour; and how opaque polygons are.
struct AskedView {
  io::ViewOptions camera;
  bool cull = false;
  Rgb background{};
  std::vector<std::array<double, 4>> clips;
  std::optional<CapStyle> caps;
  bool caps_by_file = false;
  std::optional<Rgb> back_color;
  std::uint8_t alpha = kOpaque;
};

AskedView view_from(const double* numbers) {
  Numbers from(numbers);
  AskedView view;
  view.camera.eye = from.vector();
  view.camera.target = from.vector();
  view.camera.up = from.vector();
  view.camera.fov_deg = from.next();
  view.camera.orthographic = from.next() != 0;
  view.camera.ortho_height = from.next();
  const double near = from.next();
  if (!std::isnan(near)) view.camera.near = near;
  view.camera.width_px = static_cast<std::int32_t>(from.next());
  view.camera.height_px = static_cast<std::int32_t>(from.next());
  view.cull = from.next() != 0;
  view.background = from.color();
  const double clips = from.next();
  for (double k = 0; k < clips; ++k)
    view.clips.push_back({from.next(), from.next(), from.next(), from.next()});
  const double caps = from.next();
  if (caps == 1) view.caps = CapStyle{from.color(), std::nullopt};
  if (caps == 2) view.caps = CapStyle{{235, 235, 225}, Rgb{60, 60, 60}};
  view.caps_by_file = from.next() != 0;
  if (from.next() != 0) view.back_color = from.color();
  view.alpha = static_cast<std::uint8_t>(from.next());
  return view;
}

/// The number that a double's shortest decimal is, as on a command line.
io::Number decimal_of(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  const auto parsed =
      io::parse_number({text, static_cast<std::size_t>(end - text)});
  return parsed ? *parsed : io::Number{};
}

Result<ImageOptions> image_options(WebScene& shown, const AskedView& view) {
  ImageOptions options;
  options.cull = view.cull;
  options.background = view.background;
  std::vector<ClipPlane> planes;
  for (const auto& clip : view.clips) {
    const auto plane = io::clip_plane(
        shown.scene(), {decimal_of(clip[0]), decimal_of(clip[1]),
                        decimal_of(clip[2]), decimal_of(clip[3])});
    if (!plane) return plane.error();
    planes.push_back(*plane);
  }
  const auto made = make_clips(planes, shown.scene().grid_bits());
  if (!made) return made.error();
  options.clips = *made;
  if (!view.caps) return options;
  options.caps = view.caps;
  std::vector<std::uint32_t> parts;
  if (view.caps_by_file)
    parts.assign(shown.figure.files.begin(), shown.figure.files.end());
  std::optional<bool>& is_closed =
      view.caps_by_file ? shown.files_closed : shown.is_closed;
  if (!is_closed) {
    is_closed = view.caps_by_file ? are_parts_closed(shown.scene(), parts)
                                  : bad_edges(shown.scene()).empty();
  }
  if (!*is_closed) {
    return Error{ErrorCode::kOpen,
                 "caps fill solids, and what is shown is not closed"};
  }
  if (view.caps_by_file)
    options.parts = told_apart(std::move(parts), *view.caps);
  return options;
}

Error no_alpha(const char* where) {
  return {ErrorCode::kOutOfRange,
          std::string("polygons are opaque ") + where + "; leave out alpha"};
}

Result<Done> rendered(WebScene& shown, const AskedView& view, int samples) {
  const bool is_opaque = view.alpha == kOpaque;
  if (!is_opaque && (samples != 1 || view.back_color || shown.scalars)) {
    return no_alpha(
        "in pictures of many samples a pixel or by numbers, and with marked "
        "back faces");
  }
  if (view.back_color && (samples != 1 || shown.scalars)) {
    return Error{ErrorCode::kOutOfRange,
                 "back faces are marked in pictures of one sample a pixel, and "
                 "not where numbers are the colours"};
  }
  const auto viewed = io::look_at(shown.scene(), view.camera);
  if (!viewed) return viewed.error();
  const auto options = image_options(shown, view);
  if (!options) return options.error();
  const fast::BspTree* tree = shown.picture_tree();
  if (tree == nullptr) return stopped();
  if (std::max(view.camera.width_px, view.camera.height_px) >
      kMaxImageSize / samples)
    return Error{ErrorCode::kOutOfRange, "the picture is too large"};
  fast::RenderOptions how;
  how.threads = 1;
  how.items = true;
  how.colors = !shown.scalars;
  fast::Rendering image =
      !is_opaque ? fast::blend(shown.scene(), *tree, viewed->camera, *options,
                               view.alpha, how)
      : samples == 1
          ? fast::render(shown.scene(), *tree, viewed->camera, *options, how)
          : fast::render_samples(shown.scene(), *tree, viewed->camera, *options,
                                 samples, how);
  if (shown.scalars) {
    fast::ScalarOptions by;
    by.samples = samples;
    image.colors = fast::color_scalars(shown.scene(), viewed->camera, *options,
                                       image.items, *shown.scalars, by);
  }
  if (view.back_color) {
    fast::mark_back_faces(shown.scene(), viewed->camera, image.items,
                          *view.back_color, how.threads, image.colors);
  }
  shown.items = std::move(image.items);
  shown.colors = std::move(image.colors);
  return Done{};
}

/// How a figure is drawn: by what regions are joined, or none; whether with
/// their borders, or with edges, hidden ones dashed; and the edges' crease.
struct AskedFigure {
  std::string by;
  int lines = 0;  ///< 0 none, 1 borders, 2 edges, 3 hidden edges dashed too
  double crease_deg = 20;
  double line_width = 1;
  int decimals = 3;
};

/// Adds the regions that are seen, or their borders, or both.
Result<Done> add_map(WebScene& shown, const Camera& camera,
                     const AskedFigure& asked, const ImageOptions& image,
                     std::uint8_t alpha, io::Figure& figure) {
  const fast::BspTree* tree = shown.divided_tree();
  if (tree == nullptr) return stopped();
  const std::string by = asked.by.empty() ? "face" : asked.by;
  const bool is_opaque = alpha == kOpaque;
  const auto map =
      is_opaque
          ? fast::section_map(
                shown.scene(), *tree, camera,
                {image.cull, tools::keys_of(shown.figure, by, false, image)},
                image, {})
          : fast::transparent_section(shown.scene(), *tree, camera,
                                      {image.cull, alpha, image.background},
                                      image);
  if (!map) return map.error();
  if (!asked.by.empty()) {
    tools::FillStyle style;
    style.by = is_opaque ? by : "composed";
    style.background = image.background;
    style.caps = &image;
    tools::add_regions(figure, *map, shown.figure, style, {});
  }
  if (asked.lines == 1) tools::add_borders(figure, *map, asked.line_width, {});
  return Done{};
}

Result<Done> add_edges(WebScene& shown, const Camera& camera,
                       const AskedFigure& asked, const ImageOptions& image,
                       io::Figure& figure) {
  DrawingOptions options;
  options.cull = image.cull;
  options.clips = image.clips;
  options.caps = image.caps.has_value();
  options.crease_cosine = static_cast<std::int32_t>(std::lround(std::ldexp(
      std::cos(asked.crease_deg * std::numbers::pi / 180), kCosineBits)));
  const auto drawing = fast::draw(shown.scene(), camera, options);
  if (!drawing) return drawing.error();
  tools::StrokeStyle style;
  style.width = asked.line_width;
  style.hidden =
      asked.lines == 3 ? tools::Hidden::kDashed : tools::Hidden::kGone;
  tools::add_strokes(figure, *drawing, style, {});
  return Done{};
}

Result<std::string> drawn(WebScene& shown, const AskedView& view,
                          const AskedFigure& asked, std::string_view ending) {
  if (view.back_color) {
    return Error{ErrorCode::kOutOfRange,
                 "back faces are marked in pictures, not in figures"};
  }
  if (asked.lines >= 2 && view.caps && view.clips.size() > 1) {
    return Error{ErrorCode::kOutOfRange,
                 "where caps of several planes meet, no edge is drawn: one "
                 "plane, no caps or no edges"};
  }
  const auto viewed = io::look_at(shown.scene(), view.camera);
  if (!viewed) return viewed.error();
  const auto image = image_options(shown, view);
  if (!image) return image.error();
  io::Figure figure;
  figure.width = view.camera.width_px;
  figure.height = view.camera.height_px;
  if (!asked.by.empty() || asked.lines == 1) {
    const auto done =
        add_map(shown, viewed->camera, asked, *image, view.alpha, figure);
    if (!done) return done.error();
  }
  if (asked.lines >= 2) {
    const auto done = add_edges(shown, viewed->camera, asked, *image, figure);
    if (!done) return done.error();
  }
  return io::figure_bytes(ending, figure, {asked.decimals});
}

/// What a file has to say, in place of the range that is asked for.
Result<io::ScaleRange> whole_range(const ScalarField& field,
                                   io::ScaleRange range) {
  std::optional<double> low, high;
  for (const double value : field.values) {
    if (std::isnan(value) || (range.logarithmic && !(value > 0))) continue;
    low = std::min(low.value_or(value), value);
    high = std::max(high.value_or(value), value);
  }
  const bool asks = std::isnan(range.low) || std::isnan(range.high);
  if (asks && !low)
    return Error{ErrorCode::kEmpty, "there is no number to make a range of"};
  // One number alone is in the middle of a range.
  if (asks && *low == *high) {
    const double half = *low == 0 ? 1 : std::abs(*low) / 2;
    low = *low - half;
    high = *high + half;
  }
  if (std::isnan(range.low)) range.low = *low;
  if (std::isnan(range.high)) range.high = *high;
  return range;
}

Result<std::unique_ptr<WebScene>> scene_by_scalars(const std::string& path,
                                                   const std::string& source) {
  io::ImportOptions options;
  options.refine_bits = 20;
  // As color_by_scalars() in tools/src/image/scalars.cpp.
  options.triangles = true;
  options.keep_vertices = true;
  options.surface = Rgb{255, 255, 255};
  options.light_colors = true;
  Result<io::LoadedScene> loaded = tools::load(path, options);
  if (!loaded) return loaded.error();
  const bool is_file = io::is_scalar_file_name(source);
  const Result<io::ScalarColumn> column =
      is_file ? io::read_scalars(source) : io::read_ply_scalars(path, source);
  if (!column) return column.error();
  Result<ScalarField> field = io::scalars_of(*loaded, *column);
  if (!field) return io::error_about(is_file ? source : path, field.error());
  auto shown = std::make_unique<WebScene>();
  shown->figure.name = path;
  shown->figure.file = std::move(loaded->file);
  shown->figure.files.assign(shown->scene().polygon_count(), 0);
  shown->field = *std::move(field);
  return shown;
}

/// Colours of four bytes, as canvases take them: the least byte is red.
void make_opaque(const ColorImage& colors, std::vector<std::uint32_t>& to) {
  to.resize(colors.pixels.size());
  for (std::size_t k = 0; k < to.size(); ++k) {
    const Rgb& c = colors.pixels[k];
    to[k] = 0xff000000u | static_cast<std::uint32_t>(c.b) << 16 |
            static_cast<std::uint32_t>(c.g) << 8 | c.r;
  }
}

double step_of_scene(const Scene& scene) {
  return std::pow(static_cast<double>(scene.unit().base),
                  static_cast<double>(scene.unit().exponent));
}

}  // namespace

/// Loads files in memory, whose names are lines.
HALFSPACE_EXPORT(hs_scene)
int hs_scene(const char* names, std::uint32_t size) {
  std::vector<std::string> paths(1);
  for (const char c : std::string_view(names, size)) {
    if (c == '\n') {
      paths.emplace_back();
    } else {
      paths.back() += c;
    }
  }
  io::ImportOptions options;
  options.refine_bits = 20;  // as tools/src/image/viewing.cpp
  options.light_colors = true;
  return answered(tools::load_figure(paths, options),
                  [](tools::FigureScene figure) {
                    auto shown = std::make_unique<WebScene>();
                    shown->figure = std::move(figure);
                    answer().integers = {handle_of(shown.release())};
                  });
}
/// Loads a mesh in memory with numbers: a property of the PLY file that it is,
/// or a file of numbers in memory.
HALFSPACE_EXPORT(hs_scene_by_scalars)
int hs_scene_by_scalars(const char* name, std::uint32_t size,
                        const char* source, std::uint32_t source_size) {
  return answered(scene_by_scalars({name, size}, {source, source_size}),
                  [](std::unique_ptr<WebScene> shown) {
                    answer().integers = {handle_of(shown.release())};
                  });
}
/// The properties of a PLY file in memory, a line each.
HALFSPACE_EXPORT(hs_scalar_names)
void hs_scalar_names(const char* name, std::uint32_t size) {
  begin_answer();
  for (const std::string& property :
       io::ply_scalar_names(std::string(name, size)))
    answer().bytes += property + "\n";
}
/// Colours a scene with numbers by a map, of NaN: from the least to the
/// greatest number. The answer has the range, and the map's colours as bytes.
/// Error: kEmpty, too (the scene has no numbers).
HALFSPACE_EXPORT(hs_scene_colors)
int hs_scene_colors(WebScene* shown, const char* map, std::uint32_t size,
                    double low, double high, int logarithmic, int steps,
                    int clamp) {
  if (!shown->field)
    return fail_with({ErrorCode::kEmpty, "the scene has no numbers"});
  const auto colors = io::named_color_map({map, size});
  if (!colors) {
    return fail_with(
        {ErrorCode::kUnknownFormat,
         std::string(map, size) + " is no map: " + io::color_map_names()});
  }
  io::ScaleRange asked;
  asked.low = low;
  asked.high = high;
  asked.logarithmic = logarithmic != 0;
  asked.steps = steps;
  asked.clamp = clamp != 0;
  const auto range = whole_range(*shown->field, asked);
  if (!range) return fail_with(range.error());
  return answered(io::make_scale(*colors, *range), [&](ColorScale scale) {
    answer().numbers = {range->low, range->high};
    for (const Rgb& c : scale.colors)
      answer().bytes += {static_cast<char>(c.r), static_cast<char>(c.g),
                         static_cast<char>(c.b)};
    shown->scalars =
        fast::prepare_scalars(shown->scene(), *shown->field, std::move(scale));
  });
}
HALFSPACE_EXPORT(hs_free_scene) void hs_free_scene(WebScene* shown) {
  delete shown;
}
HALFSPACE_EXPORT(hs_scene_polygons)
std::uint32_t hs_scene_polygons(const WebScene* shown) {
  return shown->scene().polygon_count();
}
/// By polygon the file that it is of.
HALFSPACE_EXPORT(hs_scene_files) void hs_scene_files(const WebScene* shown) {
  begin_answer();
  answer().integers = shown->figure.files;
}
/// The view in which all is seen from a direction: eye, target, up, angle,
/// height.
HALFSPACE_EXPORT(hs_scene_view)
int hs_scene_view(const WebScene* shown, double x, double y, double z,
                  double up_x, double up_y, double up_z, std::int32_t width,
                  std::int32_t height, std::int32_t orthographic) {
  return answered(
      io::automatic_options(shown->scene(), {{x, y, z}, {up_x, up_y, up_z}},
                            width, height, orthographic != 0),
      [](const io::ViewOptions& view) {
        answer().numbers = {view.eye.x,    view.eye.y,       view.eye.z,
                            view.target.x, view.target.y,    view.target.z,
                            view.up.x,     view.up.y,        view.up.z,
                            view.fov_deg,  view.ortho_height};
      });
}
/// The addresses of ids and of colours with alphas, which the next picture
/// overwrites.
HALFSPACE_EXPORT(hs_scene_render)
int hs_scene_render(WebScene* shown, const double* view, int samples) {
  return answered(rendered(*shown, view_from(view), samples), [&](Done) {
    make_opaque(shown->colors, shown->opaque);
    answer().integers = {handle_of(shown->items.pixels.data()),
                         shown->items.width_px,
                         shown->items.height_px,
                         handle_of(shown->opaque.data()),
                         shown->colors.width_px,
                         shown->colors.height_px};
  });
}
/// The polygon at a pixel, or -1; its file; the point seen and its distance.
HALFSPACE_EXPORT(hs_scene_pick)
int hs_scene_pick(WebScene* shown, const double* numbers, std::int32_t x,
                  std::int32_t y) {
  const AskedView view = view_from(numbers);
  const auto viewed = io::look_at(shown->scene(), view.camera);
  if (!viewed) return fail_with(viewed.error());
  const auto options = image_options(*shown, view);
  if (!options) return fail_with(options.error());
  const fast::BspTree* tree = shown->picture_tree();
  if (tree == nullptr) return fail_with(stopped());
  begin_answer();
  answer().numbers = {-1, -1, 0, 0, 0, 0};
  if (x < 0 || y < 0 || x >= view.camera.width_px || y >= view.camera.height_px)
    return 0;
  const PolygonId seen =
      fast::pick(shown->scene(), *tree, viewed->camera, *options, x, y);
  if (seen == kBackground) return 0;
  answer().numbers[0] = seen;
  if (seen >= static_cast<PolygonId>(shown->scene().polygon_count())) return 0;
  const io::PixelPoint at =
      io::pixel_point(shown->scene(), viewed->camera, seen, x, y);
  answer().numbers = {
      static_cast<double>(seen),
      static_cast<double>(shown->figure.files[static_cast<std::size_t>(seen)]),
      at.point.x,
      at.point.y,
      at.point.z,
      at.distance};
  return 0;
}
/// The bytes of a figure: SVG or another format by the ending.
HALFSPACE_EXPORT(hs_scene_draw)
int hs_scene_draw(WebScene* shown, const double* view, const char* ending,
                  std::uint32_t ending_size, const char* by,
                  std::uint32_t by_size, int lines, double crease_deg,
                  double line_width, int decimals) {
  const AskedFigure asked = {
      {by, by_size}, lines, crease_deg, line_width, decimals};
  return answered(drawn(*shown, view_from(view), asked, {ending, ending_size}),
                  [](std::string bytes) { answer().bytes = std::move(bytes); });
}

/// The fragments for an order feed (S3.8): positions in model units as floats,
/// in the bytes, and by vertex the polygon.
HALFSPACE_EXPORT(hs_scene_fragments) int hs_scene_fragments(WebScene* shown) {
  const fast::BspTree* tree = shown->divided_tree();
  if (tree == nullptr) return fail_with(stopped());
  begin_answer();
  shown->fragments = fast::fragment_vertices(shown->scene(), *tree);
  const double step = step_of_scene(shown->scene());
  std::vector<float> positions;
  for (const auto& position : shown->fragments.positions) {
    for (const double c : position)
      positions.push_back(static_cast<float>(step * c));
  }
  answer().bytes.assign(reinterpret_cast<const char*>(positions.data()),
                        positions.size() * sizeof(float));
  answer().integers = shown->fragments.polygons;
  return 0;
}
/// Indices of the triangles in order, as seen from an eye.
/// Requires: hs_scene_fragments().
HALFSPACE_EXPORT(hs_scene_order)
int hs_scene_order(WebScene* shown, const double* view, int front_to_back) {
  const fast::BspTree* tree = shown->divided_tree();
  if (tree == nullptr) return fail_with(stopped());
  const auto viewed = io::look_at(shown->scene(), view_from(view).camera);
  return answered(viewed, [&](const io::Viewed& seen) {
    const auto indices = fast::order_indices(
        shown->scene(), *tree, shown->fragments, seen.camera,
        front_to_back != 0 ? FeedOrder::kFrontToBack : FeedOrder::kBackToFront);
    answer().integers.assign(indices.begin(), indices.end());
  });
}

}  // namespace halfspace::web
