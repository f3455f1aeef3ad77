#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "halfspace/camera.hpp"
#include "halfspace/image.hpp"
#include "halfspace/io/number.hpp"
#include "halfspace/result.hpp"
#include "halfspace/scene.hpp"
#include "halfspace/scene_file.hpp"

namespace CLI {
class App;
}

namespace halfspace::tools {

/// What caps are told apart by (S10.6).
enum class CapsBy : std::uint8_t { kNothing, kPart, kFile };

/// How caps look, those of several parts if they are told apart.
struct CapChoice {
  CapStyle style;
  CapsBy by = CapsBy::kNothing;
};

/// A clip plane's A, B, C and D, in model units.
using ClipNumbers = std::array<io::Number, 4>;

/// A,B,C,D; nothing where that is no such text.
std::optional<ClipNumbers> parse_clip_numbers(std::string_view text);
/// A number above 0, else nothing.
std::optional<double> parse_yon(std::string_view text);

/// What the command line says about clip planes and caps (S10).
struct ClipArguments {
  std::vector<ClipNumbers> planes;
  std::optional<double> yon;
  std::optional<CapChoice> caps;
  bool cuts() const { return !planes.empty() || yon; }
  bool is_used() const { return cuts() || caps; }
};

/// Adds --clip, --yon and --cap.
/// Requires: `arguments` outlives the parsing.
void add_clip_options(CLI::App& app, ClipArguments& arguments);

/// The planes of --clip. Errors: those of io::clip_plane(), in words about it.
Result<std::vector<ClipPlane>> clip_planes(const Scene& scene,
                                           const ClipArguments& arguments);

/// Adds the planes and caps asked for to the options of an image.
///
/// Errors: those of io::clip_plane() and make_clips(), in words about the
///         options.
Result<Done> add_clips(const Scene& scene, const Camera& camera,
                       const ClipArguments& arguments, ImageOptions& options);

/// What is wrong where caps are asked for and nothing cuts, or where nothing is
/// left between the near distance and the far one; else empty.
std::string cut_complaint(const ClipArguments& arguments,
                          std::optional<double> near = {});

/// What is wrong with caps for the scene; empty if nothing. Where they are
/// asked for, the file's options are given the parts that they are told apart
/// by; of several files the scene's polygons say which they are of. Cost: where
/// caps are asked for, a sort of the scene's edges.
std::string prepare_caps(SceneFile& file, const ClipArguments& arguments,
                         const std::vector<std::int32_t>& files = {});

}  // namespace halfspace::tools
