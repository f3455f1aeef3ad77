#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "cli/options.hpp"
#include "halfspace/bsp_tree.hpp"
#include "halfspace/camera.hpp"
#include "halfspace/fast/simd.hpp"
#include "halfspace/image.hpp"
#include "halfspace/line_style.hpp"
#include "halfspace/result.hpp"
#include "halfspace/scalars.hpp"
#include "halfspace/scene.hpp"
#include "halfspace/screen_kind.hpp"
#include "halfspace/visible_map.hpp"

namespace halfspace::tools {

/// The size of the leaves of a tree whose leaves will be divided, which is done
/// at random. For a scan of 11,550 triangles leaves of 512, 32 and 8 take 0.19,
/// 0.11 and 0.15 s until they are, and 25,400, 22,400 and 21,700 fragments.
constexpr std::size_t kDividedLeaf = 32;

/// The library that does the work.
enum class Library : std::uint8_t { kRef, kFast };
inline constexpr Word<Library> kLibraryWords[] = {{"ref", Library::kRef},
                                                  {"fast", Library::kFast}};

/// How an image is made; all give the same one (S5.5).
enum class Method : std::uint8_t { kSpan, kPainter, kZBuffer, kRayCast };
inline constexpr Word<Method> kMethodWords[] = {{"span", Method::kSpan},
                                                {"painter", Method::kPainter},
                                                {"zbuffer", Method::kZBuffer},
                                                {"raycast", Method::kRayCast}};

/// What keeps the unlit part of the image (S4.9).
inline constexpr Word<ScreenKind> kScreenWords[] = {
    {"list", ScreenKind::kList},
    {"bsp1", ScreenKind::kBsp1},
    {"quad", ScreenKind::kQuad},
    {"bsp2", ScreenKind::kBsp2}};

/// What orders the fragments that span and painter display (S3.7, S3.9).
enum class Priority : std::uint8_t { kTree, kDepthSort };
inline constexpr Word<Priority> kPriorityWords[] = {
    {"bsp", Priority::kTree}, {"depthsort", Priority::kDepthSort}};

/// What of a pixel its colour is taken from: one sample, so many samples each
/// way (S5.7), or all of its area (S7.6).
enum class AntiAliasing : std::uint8_t {
  kNone = 1,
  k2 = 2,
  k4 = 4,
  k8 = 8,
  kExact
};
inline constexpr Word<AntiAliasing> kAntiAliasingWords[] = {
    {"2", AntiAliasing::k2},
    {"4", AntiAliasing::k4},
    {"8", AntiAliasing::k8},
    {"exact", AntiAliasing::kExact}};

/// Samples of a pixel each way.
constexpr std::int32_t samples_of(AntiAliasing anti_aliasing) {
  return anti_aliasing == AntiAliasing::kExact
             ? 1
             : static_cast<std::int32_t>(anti_aliasing);
}

/// Samples of a pixel each way for lines: many where its area counts.
constexpr std::int32_t line_samples_of(AntiAliasing anti_aliasing) {
  return anti_aliasing == AntiAliasing::kExact ? 8 : samples_of(anti_aliasing);
}

/// Whether the method needs a tree.
constexpr bool needs_tree(Method method) {
  return method == Method::kSpan || method == Method::kPainter;
}

/// The tree that is wanted.
struct TreeRequest {
  /// A rule of the papers; nothing: the library's own choice for images.
  std::optional<BuildOptions> rule;
  /// Whether leaves will do, lists of fragments that no plane orders: images of
  /// tiles need no more.
  bool leaves = true;
  /// Whether images shall build what of the tree they come to, and build() no
  /// more than planes between.
  bool lazy = false;
  int threads = 0;  ///< 0: as many as the machine has
  /// Gets the share that is done; where it returns false, the work stops.
  std::function<bool(double)> progress;
};

/// Lines of an image: `first` up to but not including `end`.
struct Rows {
  std::int32_t first = 0;
  std::int32_t end = 0;
};

/// The image that is wanted.
struct Shot {
  Method method = Method::kSpan;
  ImageOptions options;
  AntiAliasing anti_aliasing = AntiAliasing::kNone;
  bool items = true;  ///< false: the items of an anti-aliased image are not
                      ///< wanted, and may be missing
  std::optional<Rows> rows;  ///< nothing: all
  std::uint8_t alpha = kOpaque;
  std::optional<Rgb> mark;  ///< of what is seen from behind (S5.8)
  bool by_scalars = false;  ///< the colours are those of set_scalars() (S11)
  std::optional<ScreenKind> screen;  ///< nothing: the library's usual one
  Priority priority = Priority::kTree;
  int threads = 1;
  fast::SimdLevel simd = fast::SimdLevel::kBest;
};

/// The look of a shot that has samples.
inline Look look_of(const Shot& shot) {
  return {shot.alpha, samples_of(shot.anti_aliasing), shot.mark};
}

/// Whether the span buffer of the library, or what stands in for it where
/// polygons are blended, makes the shot: else it is a method or a screen that
/// makes opaque items of one sample, which are coloured afterwards.
inline bool is_of_look(const Shot& shot) {
  return shot.alpha != kOpaque ||
         (shot.method == Method::kSpan && !shot.screen);
}

/// How much of a lazy tree is there (S3.12).
struct BuiltCells {
  std::size_t cells = 0;
  std::size_t cells_built = 0;
  std::size_t polygons_built = 0;
  std::size_t fragments = 0;
  std::size_t bytes = 0;
};

/// An image, or the wanted rows of it, and what it took. Items are those of
/// samples, as many each way as there are in a pixel.
struct Picture {
  ItemImage items;
  ColorImage colors;
  std::size_t pixels_painted = 0;
  std::size_t fragments_displayed = 0;
  /// Of the fast library: how often a fragment set pixels of a tile, and
  /// decisions that took integers.
  std::size_t tiles_touched = 0;
  std::size_t exact_decisions = 0;
  /// Of depth sort: the fragments in its list, and what it took (S3.9).
  std::size_t listed = 0;
  std::size_t moves = 0;
  std::size_t cuts = 0;
  /// Of the tree: subtrees behind the viewer, and fragments in them (S3.10).
  std::size_t subtrees_behind = 0;
  std::size_t fragments_behind = 0;
  /// Pixels of exact areas that rationals decided.
  std::size_t exact_pixels = 0;
  /// After the image, of a lazy tree.
  std::optional<BuiltCells> cells = std::nullopt;
};

/// Those rows of an image, and of a picture; what it took stays that of the
/// whole.
template <class T>
Grid2<T> rows_of(const Grid2<T>& image, const Rows& rows) {
  const auto at = [&](std::int32_t row) {
    return image.pixels.begin() + std::ptrdiff_t{row} * image.width_px;
  };
  Grid2<T> part;
  part.width_px = image.width_px;
  part.height_px = rows.end - rows.first;
  part.pixels.assign(at(rows.first), at(rows.end));
  return part;
}
Picture rows_of(const Picture& whole, const Rows& rows);

/// What of a tree is behind the viewer (S3.10).
struct Behind {
  std::size_t subtrees = 0;
  std::size_t fragments = 0;
};

/// One library, as the commands see it.
class Engine {
 public:
  virtual ~Engine() = default;

  /// Makes the tree that stats() and render() are about; false where
  /// request.progress stopped that.
  virtual bool build(const Scene& scene, const TreeRequest& request) = 0;

  /// The size of the tree; nothing but zeros before build().
  virtual TreeStats stats() const = 0;

  /// What the tree takes; 0 where the library does not tell. Units: bytes.
  virtual std::size_t tree_bytes() const = 0;

  /// What is there of the tree, if it is lazy.
  virtual std::optional<BuiltCells> built_cells() const { return std::nullopt; }

  /// Whether trees can be saved and loaded.
  virtual bool has_tree_files() const = 0;

  /// Writes the tree, or reads it instead of building it; as for a request, it
  /// may have leaves or not.
  ///
  /// Requires: has_tree_files().
  /// Errors: those of fast::save_tree() and fast::load_tree().
  virtual Result<Done> save_tree(const std::string& path,
                                 const Scene& scene) const = 0;
  virtual Result<Done> load_tree(const std::string& path, const Scene& scene,
                                 bool leaves) = 0;

  /// Whether the library makes images this way.
  virtual bool has(Method method) const = 0;

  /// The numbers that images of the scene are coloured by from now on.
  virtual void set_scalars(const Scene& scene, ScalarField field,
                           ColorScale scale) = 0;

  /// Requires: has(shot.method); for anti-aliasing is_of_look(shot), and a
  /// number of samples that the camera has room for; of a lazy tree neither a
  /// screen nor exact areas; where the method needs a
  /// tree and depth sort does not make a list instead, that is this scene's,
  /// and without leaves for a screen; an alpha for the painter alone; no mark
  /// where there are scalars.
  virtual Picture render(const Scene& scene, const Camera& camera,
                         const Shot& shot) const = 0;

  /// What of the tree a display leaves out as behind the viewer.
  virtual Behind count_behind(const Scene& scene,
                              const Camera& camera) const = 0;

  /// The image of exact areas (S7.6), and its items if shot.items.
  ///
  /// Requires: a tree without leaves, where the library has trees for it; no
  ///           rows.
  virtual Picture render_area(const Scene& scene, const Camera& camera,
                              const Shot& shot) const = 0;

  /// Draws lines over the picture of a scene, or over the rows of it that the
  /// shot asks for (S14).
  /// Errors: those of fast::draw().
  virtual Result<Done> add_lines(const Scene& scene, const Camera& camera,
                                 const Shot& shot,
                                 const DrawingOptions& drawing,
                                 const LineStyle& style,
                                 ColorImage& image) const = 0;

  /// What is said, to someone who waits, before a scene of so many polygons is
  /// built or rendered; empty where it takes no time.
  virtual std::string warning(std::size_t polygons) const = 0;
};

/// The library's engine.
std::unique_ptr<Engine> make_engine(Library library);

/// The engine of the reference.
std::unique_ptr<Engine> make_ref_engine();

/// The engine of the fast library: the same trees and images, sooner.
std::unique_ptr<Engine> make_fast_engine();

}  // namespace halfspace::tools
