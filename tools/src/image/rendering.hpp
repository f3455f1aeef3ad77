#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "cli/arguments.hpp"
#include "cli/command.hpp"
#include "cli/loading.hpp"
#include "halfspace/io/picture.hpp"
#include "image/building.hpp"
#include "image/clipping.hpp"
#include "image/engine.hpp"
#include "image/lines.hpp"
#include "image/scalars.hpp"
#include "image/viewing.hpp"

namespace halfspace::tools {

/// What the command line of `render` says.
struct RenderArguments {
  std::string path;
  std::optional<std::string> picture_file;
  std::optional<std::string> ids_file;
  std::optional<std::string> tree_file;
  bool lazy = false;  ///< build of the tree what is looked at
  std::optional<std::string> camera_path_file;
  std::optional<std::uint32_t> turntable;  ///< so many frames once round
  std::optional<Range> frames;
  std::optional<Range> rows;
  std::optional<std::uint8_t> alpha;
  std::optional<Rgb> back_color;  ///< of what is seen from behind (S5.8)
  std::optional<AntiAliasing> anti_aliasing;
  std::optional<Method> method;
  std::optional<ScreenKind> screen;
  std::optional<Priority> priority;
  std::optional<fast::SimdLevel> simd;
  std::optional<std::uint32_t> repeat;
  std::optional<int> grid_bits;
  std::optional<double> shadow;  ///< the share of the pixels to be checked
  std::string shadow_file = "halfspace-shadow.scene";
  ViewArguments view;
  std::optional<io::ViewOptions> own_view;  ///< of a .view file
  ClipArguments clip;
  ScalarArguments scalars;
  LineArguments lines;
  BuildArguments build;
};

/// The method asked for; if none is, the painter where there is an alpha, else
/// the span buffer.
Method method_of(const RenderArguments& arguments);

/// Whether a tree is asked for: the method needs one, and it is the tree that
/// orders what is displayed.
bool needs_tree(const RenderArguments& arguments);

/// The library asked for; if none is, the fast one where it has the method.
Library library_of(const RenderArguments& arguments);

inline constexpr Word<fast::SimdLevel> kSimdWords[] = {
    {"portable", fast::SimdLevel::kPortable},
    {"avx2", fast::SimdLevel::kAvx2},
    {"avx512", fast::SimdLevel::kAvx512},
    {"best", fast::SimdLevel::kBest}};

/// What is wrong with the options taken together; empty if nothing.
std::string complaint(const RenderArguments& arguments, const Engine& engine);

/// A picture, and what it took.
struct Frame {
  Picture picture;
  ImageOptions options;                   ///< that it was made with
  std::optional<io::PartOfPicture> part;  ///< nothing: it is the whole
  /// How much of a pixel is seen, where the background is not there.
  std::optional<io::CoverageImage> coverage;
  double frame_ms = 0;  ///< median of the repeats
};

/// Makes or loads the tree that the method needs, if it needs one.
Status make_tree(Engine& engine, const Scene& scene,
                 const RenderArguments& arguments, BuildMeasure& tree);

/// What is rendered: a scene, and the numbers that colour it, which the engine
/// knows, if there are any.
struct Subject {
  const io::LoadedScene& loaded;
  std::optional<ShownScalars> scalars = std::nullopt;
};

/// The rows asked for. Errors: kOutOfRange (there are no such rows).
Result<std::optional<Rows>> asked_rows(const RenderArguments& arguments,
                                       std::int32_t height_px);

/// Paints a gradient behind a picture of one sample a pixel, or takes what is
/// behind it away.
void add_background(const RenderArguments& arguments, std::int32_t height_px,
                    Frame& frame);

/// The options of an image: the file's, but for what the arguments say, clip
/// planes too. Errors: those of add_clips().
Result<ImageOptions> image_options(const SceneFile& file, const Camera& camera,
                                   const RenderArguments& arguments);

/// The picture of a scene by these options, or the rows asked for: its image,
/// then what is laid over it. `legend` is that of numbers the engine knows, or
/// null.
/// Errors: kOutOfRange (there are no such rows); those of Engine::add_lines().
Result<Frame> make_frame(const Engine& engine, const Scene& scene,
                         const Camera& camera, const ImageOptions& options,
                         const io::Legend* legend,
                         const RenderArguments& arguments);

/// The same by image_options().
Result<Frame> make_frame(const Engine& engine, const Subject& subject,
                         const Camera& camera,
                         const RenderArguments& arguments);

/// The files of one image.
struct Outputs {
  std::optional<std::string> picture_file;
  std::optional<std::string> ids_file;
  int threads = 0;  ///< of write_png()
};

Status write_frame(const Frame& frame, const Outputs& outputs);

/// What was done, line by line, on standard output: `frames` of them, of which
/// this was the last.
void print_summary(const io::LoadedScene& loaded, const BuildMeasure& tree,
                   const Frame& frame, std::int64_t frames,
                   const RenderArguments& arguments);

/// The same for --stats.
nlohmann::json stats_of(const io::LoadedScene& loaded, const BuildMeasure& tree,
                        const Frame& frame, std::int64_t frames,
                        const RenderArguments& arguments);

}  // namespace halfspace::tools
