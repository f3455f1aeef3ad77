#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "halfspace/image.hpp"
#include "halfspace/io/view.hpp"
#include "halfspace/polygon.hpp"
#include "halfspace/result.hpp"

namespace halfspace::viewer {

/// A file that is shown.
struct Part {
  std::string path;
  bool is_visible = true;
  std::optional<Rgb> color;          ///< instead of the file's own colours
  std::array<double, 3> shift = {};  ///< added to every point, exactly
  friend bool operator==(const Part&, const Part&) = default;
};

/// What is made of the visible parts before they are shown.
enum class Combination : std::uint8_t {
  kNone,  ///< all of them are shown as they are
  kUnion,
  kDifference,  ///< the first one without the others
  kIntersection,
  kSymmetricDifference,
};

/// A plane that cuts the parts: what has normal . p > offset is not there, and
/// the cut is closed by a cap.
struct Section {
  std::array<double, 3> normal = {1, 0, 0};
  double offset = 0;
  bool is_on = true;
  friend bool operator==(const Section&, const Section&) = default;
};

/// As many planes as cut at once.
constexpr std::size_t kMostSections = 3;

/// Numbers that colour a file (S11).
struct ScalarLook {
  std::string source;  ///< a property of a PLY, or a file of numbers
  std::string map = "viridis";
  std::optional<std::array<double, 2>> range;  ///< nothing: all there are
  bool is_logarithmic = false;
  std::int32_t steps = 0;  ///< 0: as many as the map has colours
  bool has_legend = true;
  friend bool operator==(const ScalarLook&, const ScalarLook&) = default;
};

/// What decides the colours of surfaces, where no numbers do.
enum class Coloring : std::uint8_t {
  kFile,   ///< the files' own colours
  kParts,  ///< each file has one
  kFaces,  ///< each face has one, so that neighbours are told apart
};

/// Which visible edges are drawn over the picture (S14), as `halfspace render
/// --lines` draws them.
enum class Lines : std::uint8_t { kNone, kOutline, kFeatures, kWire };

/// How the parts look.
struct Looks {
  bool is_smooth = false;  ///< Gouraud shading
  bool cull = false;       ///< polygons seen from behind are not there
  Rgb background = {255, 255, 255};
  std::optional<std::array<double, 3>> light;  ///< nothing: the usual one
  std::optional<double> ambient = {};          ///< nothing: the usual share
  Coloring coloring = Coloring::kFile;
  Lines lines = Lines::kNone;          ///< none where planes cut the parts
  std::optional<Rgb> back_color = {};  ///< of what is seen from behind (S5.8)
  std::optional<ScalarLook> scalar = {};  ///< of a file that is alone
  /// How much polygons hide of what is behind them (S5.6), where no numbers
  /// colour them.
  std::uint8_t alpha = kOpaque;
  friend bool operator==(const Looks&, const Looks&) = default;
};

/// All that a picture depends on.
struct State {
  std::vector<Part> parts;
  Combination combination = Combination::kNone;
  std::vector<Section> sections;  ///< at most kMostSections
  Looks looks;
  /// Nothing: from above and to one side, so that all is seen.
  std::optional<io::ViewOptions> camera;
};

/// Whether two cameras are the same in every number.
bool is_same(const io::ViewOptions& a, const io::ViewOptions& b);

/// Whether the pictures of two states need the same scene.
bool have_same_scene(const State& a, const State& b);

/// The mark of the state's picture (S5.8): numbers have none.
std::optional<Rgb> back_color_of(const State& state);

/// The colour of the lines of the state's picture, which the background is seen
/// beside.
Rgb line_color_of(const State& state);

/// Whether any plane cuts the parts.
bool has_sections(const State& state);

/// The text of a `.view` file: parse_state(to_text(s)) is s.
std::string to_text(const State& state);

/// The state that the text of a `.view` file describes. Paths that are not
/// absolute are taken from `folder`.
///
/// Errors: kSyntax, kOutOfRange, naming the entry.
Result<State> parse_state(std::string_view text,
                          const std::filesystem::path& folder = {});

/// Whether the name ends in `.view`.
bool is_view_name(const std::filesystem::path& path);

/// Reads and writes the file. Errors: also kUnreadable, kUnwritable.
Result<State> read_state(const std::filesystem::path& path);
Result<Done> write_state(const std::filesystem::path& path, const State& state);

}  // namespace halfspace::viewer
