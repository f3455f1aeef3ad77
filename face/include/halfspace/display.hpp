#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "halfspace/api.hpp"
#include "halfspace/camera.hpp"
#include "halfspace/drawing.hpp"
#include "halfspace/image.hpp"
#include "halfspace/mesh.hpp"
#include "halfspace/progress.hpp"
#include "halfspace/result.hpp"
#include "halfspace/scene.hpp"
#include "halfspace/solid.hpp"

namespace halfspace {

/// What of a pixel its colour is taken from: one sample, the mean of so many
/// each way (S5.7), or the integral of all that is seen in it (S7.6).
enum class AntiAliasing : std::uint8_t {
  kNone = 1,
  k2 = 2,
  k4 = 4,
  k8 = 8,
  kExactArea
};

/// From where something is seen, and how. The default sees all of it from above
/// and to one side, z upwards. Units: model units, degrees, pixels.
struct View {
  std::optional<Point> eye = {};     ///< nothing: so that all is seen
  std::optional<Point> target = {};  ///< in the middle of the image
  std::optional<Point> up = {};      ///< upwards there; nothing: z, or else y
  double fov_deg = 30;               ///< of perspective views, top to bottom
  bool orthographic = false;
  double ortho_height = 2;          ///< of orthographic views, top to bottom
  std::optional<double> near = {};  ///< what is not farther is not seen
  std::int32_t width_px = 640;
  std::int32_t height_px = 480;
  bool cull = false;  ///< polygons seen from behind are not there
  /// What is on the negative side of any is not there (S10): up to eight, and
  /// others in the next picture for nothing.
  std::vector<Plane> clips = {};
  /// Fills the cuts of what is closed; nothing: they stay open.
  std::optional<CapStyle> caps = {};
  /// Tells the caps of the display's solids apart (S10.6): each has a colour of
  /// its own, and lines in another direction or at another distance if there
  /// are any; caps look as `caps` says where several solids are. Not where
  /// scalars are seen.
  bool caps_by_solid = false;
  Rgb background = {255, 255, 255};
  /// Marks what is seen from behind, in its own light (S5.8); nothing: it is
  /// coloured as from before.
  std::optional<Rgb> back_color = {};
  /// How much of what is behind a polygon it hides, in pictures and figures:
  /// all of it, or alpha / 255 of it, one polygon or cap over the other (S5.6,
  /// S7.8, S10.7). Elsewhere polygons hide all.
  std::uint8_t alpha = kOpaque;
  AntiAliasing anti_aliasing = AntiAliasing::kNone;
  int threads = 0;  ///< 0: as many as the machine has
  /// Of the display's tree, which the first view makes.
  Progress progress = {};
  /// Makes of the tree what render() and pick() come to, as they do, where
  /// there is no whole one yet (S3.12): the first picture of many polygons is
  /// there sooner, and the same. `progress` is not called then. Exact areas
  /// need a whole tree.
  bool lazy = false;
};

/// A picture: at each pixel its colour, and the polygon that is seen at its
/// centre, or at each of its samples.
struct HALFSPACE_API Picture {
  ColorImage colors;
  ItemImage polygons;  ///< kBackground where there is none

  /// Writes the colours as PNG, large ones in all threads that the machine has.
  /// Error: kUnwritable.
  Result<Done> save(const std::filesystem::path& path) const;
};

/// A straight line of a drawing (S9.6). Units: pixels; nearest doubles.
struct DrawnLine {
  Point2 from;
  Point2 to;
  EdgeClass edge_class = EdgeClass::kCrease;
  std::int32_t layers = 0;  ///< how many polygons hide it; 0: it is visible
};

/// The lines of what is displayed: visible and hidden, none twice.
struct HALFSPACE_API LineDrawing {
  std::int32_t width_px = 0;
  std::int32_t height_px = 0;
  std::vector<DrawnLine> lines;

  /// Writes the visible lines, and the hidden ones dashed if asked for: as SVG,
  /// PDF, EPS, PGF, DXF or HPGL, by the ending of the name.
  /// Errors: kUnknownFormat, kUnwritable.
  Result<Done> save(const std::filesystem::path& path,
                    bool with_hidden = false) const;
};

/// What of a figure is one region where parts of it meet (S7.3).
enum class FigureKey : std::uint8_t { kPolygon, kSolid, kColor };

/// A part of the image in which one polygon, solid or colour is seen (S7.3).
struct SeenRegion {
  /// The first of those that are seen in it, as in Picture::polygons; with
  /// View::alpha, which shows several, kComposed.
  std::int32_t polygon = 0;
  Rgb color;  ///< of that polygon, or what the eye gets of all of them
  /// The outer one first, then those of holes. Units: pixels; nearest doubles.
  std::vector<std::vector<Point2>> loops = {};
};

/// What is seen in a region where polygons are transparent.
constexpr std::int32_t kComposed = -2;

/// All that is seen: regions that fill the image, and lines over them.
struct HALFSPACE_API Figure {
  std::int32_t width_px = 0;
  std::int32_t height_px = 0;
  std::vector<SeenRegion> regions;
  /// Nothing unless put there, such as those of Display::draw().
  std::vector<DrawnLine> lines = {};

  /// Writes the regions and the visible lines as SVG, PDF, EPS or PGF, by the
  /// ending of the name: a path a region, and no seams between them.
  /// Errors: kUnknownFormat, kUnwritable.
  Result<Done> save(const std::filesystem::path& path) const;
};

/// A run of pixels of one line: `first` to `last`, both in it.
struct PixelSpan {
  std::int32_t line = 0;
  std::int32_t first = 0;
  std::int32_t last = 0;
  std::int32_t size() const { return last - first + 1; }
  friend bool operator==(const PixelSpan&, const PixelSpan&) = default;
};

/// A part of a polygon, as a traversal hands it out. Valid during the call.
struct HALFSPACE_API SeenPolygon {
  std::int32_t polygon = 0;  ///< of the display's mesh
  Rgb color;
  /// Its corners, and those of what is in front of the eye in the image, where
  /// y grows downwards: maybe none, maybe beyond the image's edges. Within a
  /// few ulps.
  std::vector<Point> points;
  std::vector<Point2> projected;

  /// The pixels whose centres it covers, line by line. Exact.
  /// Cost: that of a small picture.
  std::vector<PixelSpan> spans() const;

  struct Source;
  const Source* source = nullptr;  ///< for spans()
};

/// Receives parts of polygons in order: a function of them that returns
/// nothing, or whether the traversal is to go on.
class Visit {
 public:
  template <class Function>
  requires std::is_invocable_v<Function&, const SeenPolygon&> &&
      (!std::is_same_v<std::remove_cvref_t<Function>, Visit>)
          Visit(Function function) {
    using Answer = std::invoke_result_t<Function&, const SeenPolygon&>;
    if constexpr (std::is_void_v<Answer>) {
      visit_ = [function](const SeenPolygon& seen) mutable {
        function(seen);
        return true;
      };
    } else {
      visit_ = std::move(function);
    }
  }
  bool operator()(const SeenPolygon& seen) const { return visit_(seen); }

 private:
  std::function<bool(const SeenPolygon&)> visit_;
};

/// Receives the pixels in which a polygon is seen.
using Paint = std::function<void(const SeenPolygon&, const PixelSpan&)>;

/// The polygon seen at a pixel, and the solid that it belongs to.
struct Pick {
  std::int32_t polygon = 0;
  /// Of those that the display was made of; -1 for a cap.
  std::int32_t solid = 0;
  Point point{};        ///< that the pixel's centre sees; nearest doubles
  double distance = 0;  ///< from the eye; orthographic: from its plane
};

/// What a ray hits: each number but the fraction is the nearest double to the
/// exact one.
struct Hit {
  std::int32_t polygon = 0;
  std::int32_t solid = 0;  ///< of those that the display was made of
  Point point{};
  double distance = 0;        ///< from where the ray begins
  double parameter = 0;       ///< the share of `along`, or of the way
  std::string fraction = {};  ///< the same exactly, such as `3/7`
};

/// Polygons to look at, with a BSP tree of them: made once, for any number of
/// views. All that is asked of it may be asked from several threads at once.
///
/// Units:  model units; pixels from the upper left corner, whose first one is
///         0, 0; degrees.
/// Cost:   n log n for the tree, of n polygons, the first time that one is
///         needed; then what is said at the functions.
/// Source: S3 to S5, S8 to S10 of spec/, with the papers that they name.
class HALFSPACE_API Display {
 public:
  /// Takes polygons, which need not bound a solid. What is not planar or not
  /// convex is cut into triangles. Errors: kEmpty, kBadIndex, kNotFinite,
  /// kOutOfRange.
  static Result<Display> of(Mesh mesh);
  /// Shows solids. Errors: theirs; kEmpty.
  static Result<Display> of(const Solid& solid);
  static Result<Display> of(std::span<const Solid> solids);
  /// Shows an OBJ, STL, PLY, OFF, 3MF, GLB, glTF or scene file. Errors: those
  /// of reading; kEmpty.
  static Result<Display> of_file(const std::filesystem::path& path);

  Display(Display&&) noexcept;
  Display& operator=(Display&&) noexcept;
  ~Display();

  /// How many polygons there were; they are numbered as they were given.
  std::size_t polygon_count() const;

  /// The picture. Exact, whatever the number of threads: at each pixel the
  /// nearest polygon (S5.1), an exact mean (View::anti_aliasing), or as
  /// polygon_count() + k the cap of the k-th different clip plane (S10.3); with
  /// View::caps_by_solid 16 s more for that of solid s, or, where several are,
  /// of their number.
  /// Cost: what is seen. Errors, here and below:
  /// kBadCamera, kNotFinite, kStopped (by view.progress); kOutOfRange (also for
  /// a ninth clip plane, and for a colour of back faces or an alpha together
  /// with exact areas); kZeroArea (a clip plane's normal is 0);
  /// kOpen (caps for what is not closed).
  Result<Picture> render(const View& view = {}) const;
  /// The edges that the view shows (S9): silhouettes, borders, intersections,
  /// and creases where faces turn by more than an angle; of a section what clip
  /// planes leave of them, and the outlines of what they cut (S9.8). Exact.
  /// Cost: n log n, and the edges' crossings in the image.
  /// Errors: also kOutOfRange, where there are too many.
  Result<LineDrawing> draw(const View& view = {}, double crease_deg = 20) const;
  /// The picture as regions (S7.4, S10.5), clip planes and caps too: what is
  /// seen at any point of the image, not only at pixels' centres. Exact;
  /// corners are rounded once. Cost: what is seen; with an alpha all that is in
  /// the image, up to the square of the polygons. Errors: also kOutOfRange,
  /// where there is too much to be seen.
  Result<Figure> figure(const View& view = {},
                        FigureKey by = FigureKey::kColor) const;
  /// What is seen at a pixel; nothing at the background, and off the image.
  /// Exact; the point is rounded once. Cost: a way through the tree.
  Result<std::optional<Pick>> pick(const View& view, std::int32_t x,
                                   std::int32_t y) const;

  /// What the ray from a point on in a direction hits, edges of polygons
  /// included (S8.2): first, or all in order; and what the way from one point
  /// to another hits, its ends included. Polygons in whose plane the ray runs
  /// are not hit. Exact, once points are rounded to the camera's lattice.
  /// Cost: a way through the tree, and what is hit. Where there is no whole
  /// tree a ray makes what of it is on its way (S3.12), as far as it has to go.
  /// Errors: kNotFinite, kOutOfRange, kBadRay.
  Result<std::optional<Hit>> first_hit(const Point& from,
                                       const Point& along) const;
  Result<std::vector<Hit>> all_hits(const Point& from,
                                    const Point& along) const;
  Result<std::vector<Hit>> hits_between(const Point& from,
                                        const Point& to) const;
  /// Whether nothing is between two points (S8.5).
  Result<bool> see_each_other(const Point& a, const Point& b) const;

  /// Hands out parts of polygons so that none hides one before it, or one after
  /// it (S3.7). Polygons seen edge-on may be left out.
  /// Errors, of scan() too: also kOutOfRange, for clip planes.
  /// Cost: the first time, a tree without leaves.
  Result<Done> front_to_back(const View& view, const Visit& visit) const;
  Result<Done> back_to_front(const View& view, const Visit& visit) const;
  /// Hands out each pixel in which something is seen once, in spans: front to
  /// back, on a dynamic screen, until that is full (F2B).
  Result<Done> scan(const View& view, const Paint& paint) const;

  /// Adds polygons, numbered after those that are there, to the tree (S3.6), or
  /// makes a new tree where they need another grid.
  /// Errors: kBadIndex, kNotFinite, kOutOfRange; nothing is changed then.
  Result<Done> insert(const Mesh& mesh);
  /// Takes polygons out of the tree (S3.11); the others keep their numbers. One
  /// that is gone already may be named again. A tree that has changed as often
  /// as it had polygons is made anew when it is needed next, by insert() too.
  /// Cost: linear. Errors: kBadIndex; kEmpty, where none would be left; nothing
  /// is changed then.
  Result<Done> remove(std::span<const std::int32_t> polygons);
  /// Takes vertices to other points, and with them the polygons there, which
  /// keep their numbers and colours; what has no colour is lit anew. Vertices
  /// are numbered as they were given, of solids as Solid::mesh() has them, one
  /// after the other, and so those of inserted polygons. One that is named
  /// twice goes to the last point.
  ///
  /// Points are rounded to the display's grid: to a millionth or so of its
  /// greatest coordinate.
  /// Where one is beyond the grid the display is made anew, and so it is the
  /// first time, and where polygons are cut otherwise, which stay planar no
  /// more.
  /// A tree that was opened for View::lazy, or for rays, goes on: of it is made
  /// again what polygons leave or come to (S3.13). Others are made anew when
  /// they are needed.
  /// Cost:   a copy of the polygons, and of trees what moves; the first time
  ///         that of Display::of().
  /// Errors: kBadIndex (no such vertex); kNotFinite; kOutOfRange (not as many
  ///         points as vertices; those of Display::of()); kUnknownFormat (a
  ///         scene file's); kEmpty (nothing has an area any more); nothing is
  ///         changed then.
  Result<Done> move_to(std::span<const std::int32_t> vertices,
                       std::span<const Point> points);

  /// The exact polygons behind the display, for who goes on with them by
  /// `spec/` and `fast/`: on their grid, polygons in pieces where they were cut
  /// into triangles. Valid until the display changes.
  const Scene& scene() const;
  /// By polygon of the scene, the polygon of the display.
  std::span<const std::int32_t> polygons_of_scene() const;
  /// The camera of a view, for that scene. Errors: those of render().
  Result<Camera> camera(const View& view) const;

 private:
  friend class ScalarDisplay;
  struct State;
  explicit Display(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

/// Which pixels of an image are still unlit (F2B's dynamic screen, S4.8), for
/// renderers of one's own that go from front to back.
class HALFSPACE_API DynamicScreen {
 public:
  /// Requires: 1 <= width_px, height_px <= 65,536.
  DynamicScreen(std::int32_t width_px, std::int32_t height_px);
  DynamicScreen(DynamicScreen&&) noexcept;
  DynamicScreen& operator=(DynamicScreen&&) noexcept;
  ~DynamicScreen();

  /// Lights spans, and gives those parts of them that were unlit.
  std::vector<PixelSpan> light(std::span<const PixelSpan> spans);
  /// Whether every pixel is lit.
  bool is_full() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace halfspace
