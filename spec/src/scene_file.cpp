#include "halfspace/scene_file.hpp"

#include <algorithm>
#include <limits>

#include "halfspace/boolean.hpp"
#include "halfspace/cap_parts.hpp"
#include "token_lines.hpp"

namespace halfspace {
namespace {

constexpr std::string_view kMagic = "halfspace-scene";
constexpr std::string_view kVersion = "1";
constexpr std::size_t kMaxCount = std::numeric_limits<std::int32_t>::max();

/// Reads one file: a line at a time, into what will become its parts.
class Reader : private TokenLines {
 public:
  using TokenLines::TokenLines;
  Result<SceneFile> read();

 private:
  bool once(bool& seen);
  bool header();
  bool header_line(std::string_view keyword, std::size_t values);
  bool body_line();
  bool camera_line();
  bool option_line();
  bool clip_line();
  bool caps_line();
  bool cap_line();
  bool part_line();
  bool style(CapStyle& value);
  Result<Done> add_parts(const Scene& scene);
  bool vertex();
  bool polygon();
  bool color(std::size_t token, Rgb& value);
  bool lattice_vector(LatticeVector& value);
  bool corner_colors(std::size_t token, std::size_t corners);
  bool check_camera();
  Result<SceneFile> finish();

  SceneData scene_;
  std::vector<std::int64_t> polygon_lines_;
  CameraData camera_;
  ImageOptions options_;
  /// So many polygons, from one on, belong to a part.
  struct PartRun {
    std::size_t part = 0;
    std::size_t from = 0;
    std::size_t count = 0;
  };
  CapParts parts_;
  std::vector<PartRun> part_runs_;
  struct {
    bool eye = false, s0 = false, sx = false, sy = false, near = false,
         size = false, cull = false, shade = false, background = false,
         caps = false;
  } seen_;
};

bool Reader::once(bool& seen) {
  if (seen) {
    return fail(ErrorCode::kSyntax,
                "there is a second " + in_quotes(tokens_[0]) + " line");
  }
  seen = true;
  return true;
}

bool Reader::header_line(std::string_view keyword, std::size_t values) {
  if (!next_line()) {
    ++line_;
    return fail(ErrorCode::kTruncated, "the file ends where its '" +
                                           std::string(keyword) +
                                           "' line should be");
  }
  if (tokens_[0] != keyword) {
    return fail(ErrorCode::kSyntax, "there should be '" + std::string(keyword) +
                                        "', not " + in_quotes(tokens_[0]));
  }
  return count_is(values);
}

bool Reader::header() {
  if (!header_line(kMagic, 1)) return false;
  if (tokens_[1] != kVersion) {
    return fail(ErrorCode::kSyntax,
                "version " + in_quotes(tokens_[1]) + " is not known");
  }
  if (!header_line("unit", 2)) return false;
  if (!integer(1, 2, 10, scene_.unit.base)) return false;
  if (scene_.unit.base != 2 && scene_.unit.base != 10) {
    return fail(ErrorCode::kOutOfRange,
                "the base of a unit is 2 or 10, not " + in_quotes(tokens_[1]));
  }
  if (!integer(2, -4096, 4096, scene_.unit.exponent)) return false;
  if (!header_line("grid", 1)) return false;
  if (!integer(1, 26, 54, scene_.grid_bits)) return false;
  if (std::count(std::begin(kGridBits), std::end(kGridBits),
                 scene_.grid_bits) == 0) {
    return fail(ErrorCode::kOutOfRange,
                "a grid has 26, 40 or 54 bits, not " + in_quotes(tokens_[1]));
  }
  return true;
}

bool Reader::vertex() {
  const Int128 limit = Int128{1} << (scene_.grid_bits - 1);
  GridPoint point;
  if (!count_is(3) || !integer(1, -limit, limit - 1, point.x) ||
      !integer(2, -limit, limit - 1, point.y) ||
      !integer(3, -limit, limit - 1, point.z)) {
    return false;
  }
  if (scene_.vertices.size() >= kMaxCount) {
    return fail(ErrorCode::kOutOfRange, "there are over 2147483647 vertices");
  }
  scene_.vertices.push_back(point);
  return true;
}

bool Reader::color(std::size_t token, Rgb& value) {
  if (token + 3 > tokens_.size()) {
    return fail(ErrorCode::kSyntax, "a colour has three values");
  }
  return integer(token, 0, 255, value.r) &&
         integer(token + 1, 0, 255, value.g) &&
         integer(token + 2, 0, 255, value.b);
}

/// The colours of the corners of the newest polygon, from a token on.
///
/// The first polygon that has any gives them to all before it, too: there, as
/// in every polygon without, the corners have the polygon's colour.
bool Reader::corner_colors(std::size_t token, std::size_t corners) {
  const bool given = token < tokens_.size();
  if (given && (tokens_[token] != "colors" ||
                tokens_.size() != token + 1 + 3 * corners)) {
    return fail(ErrorCode::kSyntax,
                "after its colour a polygon of " + std::to_string(corners) +
                    " corners has nothing, or 'colors' and " +
                    std::to_string(3 * corners) + " values");
  }
  if (given && scene_.corner_colors.empty()) {
    for (std::size_t p = 0; p + 1 < scene_.colors.size(); ++p) {
      scene_.corner_colors.resize(scene_.first_corner[p + 1], scene_.colors[p]);
    }
  } else if (!given && !scene_.corner_colors.empty()) {
    scene_.corner_colors.resize(scene_.corners.size(), scene_.colors.back());
  }
  for (++token; token < tokens_.size(); token += 3) {
    if (!color(token, scene_.corner_colors.emplace_back())) return false;
  }
  return true;
}

bool Reader::polygon() {
  const auto vertices = static_cast<Int128>(scene_.vertices.size());
  std::size_t token = 1;
  for (; token < tokens_.size() && tokens_[token] != "color"; ++token) {
    VertexId vertex = 0;
    if (!is_integer(tokens_[token])) {
      return fail(ErrorCode::kSyntax,
                  in_quotes(tokens_[token]) + " is not a vertex, nor 'color'");
    }
    if (!integer(token, 0, vertices - 1, vertex)) {
      return fail(ErrorCode::kBadIndex,
                  "there is no vertex " + in_quotes(tokens_[token]) +
                      " above, only " + to_string(vertices) + " vertices");
    }
    scene_.corners.push_back(vertex);
  }
  if (scene_.corners.size() > kMaxCount) {
    return fail(ErrorCode::kOutOfRange, "there are over 2147483647 corners");
  }
  if (token == tokens_.size()) {
    return fail(ErrorCode::kSyntax, "the polygon has no 'color'");
  }
  scene_.first_corner.push_back(
      static_cast<std::uint32_t>(scene_.corners.size()));
  polygon_lines_.push_back(line_);
  return color(token + 1, scene_.colors.emplace_back()) &&
         corner_colors(token + 4, token - 1);
}

bool Reader::lattice_vector(LatticeVector& value) {
  // Wider than any camera's range, so that make_camera has the last word.
  constexpr Int128 kLimit = Int128{1} << 120;
  return integer(1, -kLimit, kLimit, value.x) &&
         integer(2, -kLimit, kLimit, value.y) &&
         integer(3, -kLimit, kLimit, value.z);
}

bool Reader::camera_line() {
  const std::string_view keyword = tokens_[0];
  if (keyword == "eye") {
    int w = 0;
    if (!once(seen_.eye) || !count_is(4) || !lattice_vector(camera_.eye) ||
        !integer(4, 0, 1, w)) {
      return false;
    }
    camera_.perspective = w == 1;
    return true;
  }
  const auto vector = [this](bool& seen, LatticeVector& value) {
    return once(seen) && count_is(3) && lattice_vector(value);
  };
  if (keyword == "s0") return vector(seen_.s0, camera_.s0);
  if (keyword == "sx") return vector(seen_.sx, camera_.sx);
  if (keyword == "sy") return vector(seen_.sy, camera_.sy);
  if (keyword == "size") {
    return once(seen_.size) && count_is(2) &&
           integer(1, 1, kMaxImageSize, camera_.width_px) &&
           integer(2, 1, kMaxImageSize, camera_.height_px);
  }
  constexpr Int128 kLimit = Int128{1} << 62;
  return once(seen_.near) && count_is(1) &&
         integer(1, -kLimit, kLimit, camera_.near.emplace());
}

bool Reader::option_line() {
  if (tokens_[0] == "cull") {
    options_.cull = true;
    return once(seen_.cull) && count_is(0);
  }
  if (tokens_[0] == "background") {
    return once(seen_.background) && count_is(3) &&
           color(1, options_.background);
  }
  if (!once(seen_.shade) || !count_is(1)) return false;
  if (tokens_[1] != "flat" && tokens_[1] != "gouraud") {
    return fail(ErrorCode::kSyntax,
                "shading is 'flat' or 'gouraud', not " + in_quotes(tokens_[1]));
  }
  options_.shading = tokens_[1] == "flat" ? Shading::kFlat : Shading::kGouraud;
  return true;
}

bool Reader::clip_line() {
  // Wider than any budget, so that make_clips has the last word.
  constexpr Int128 kLimit = Int128{1} << 126;
  ClipPlane plane;
  if (!count_is(4) || !integer(1, -kLimit, kLimit, plane.a) ||
      !integer(2, -kLimit, kLimit, plane.b) ||
      !integer(3, -kLimit, kLimit, plane.c) ||
      !integer(4, -kLimit, kLimit, plane.d)) {
    return false;
  }
  std::vector<ClipPlane> clips = options_.clips;
  clips.push_back(plane);
  const auto made = make_clips(clips, scene_.grid_bits);
  if (!made) return fail(made.error().code, made.error().message);
  options_.clips = *made;
  return true;
}

/// A colour, and maybe that of hatching, after the first token.
bool Reader::style(CapStyle& value) {
  const bool has_hatch = tokens_.size() == 8 && tokens_[4] == "hatch";
  if (tokens_.size() != 4 && !has_hatch) {
    return fail(ErrorCode::kSyntax,
                "after " + in_quotes(tokens_[0]) +
                    " comes a colour, and maybe 'hatch' and another");
  }
  return color(1, value.color) &&
         (!has_hatch || color(5, value.hatch.emplace()));
}

bool Reader::caps_line() {
  return once(seen_.caps) && style(options_.caps.emplace());
}

bool Reader::cap_line() { return style(parts_.styles.emplace_back()); }

bool Reader::part_line() {
  PartRun run;
  constexpr Int128 kLimit = kMaxCount;
  if (!count_is(3) || !integer(1, 0, kLimit, run.part) ||
      !integer(2, 0, kLimit, run.from) || !integer(3, 1, kLimit, run.count))
    return false;
  part_runs_.push_back(run);
  return true;
}

/// The parts whose caps are told apart (S10.6), if any.
Result<Done> Reader::add_parts(const Scene& scene) {
  if (parts_.styles.empty() && part_runs_.empty()) return Done{};
  const auto bad = [](const std::string& message) {
    return Error{ErrorCode::kSyntax, message};
  };
  if (!options_.caps) return bad("parts are told apart by caps: give 'caps'");
  if (parts_.styles.size() < (scene.polygon_count() == 0 ? 1u : 2u))
    return bad("a 'cap' line for each part comes before one for several");
  parts_.part_of.assign(scene.polygon_count(), 0);
  for (const PartRun& run : part_runs_) {
    if (run.part >= parts_.count() ||
        run.from + run.count > scene.polygon_count()) {
      return Error{ErrorCode::kBadIndex,
                   "a 'part' line names parts without a 'cap' line, or "
                   "polygons that there are not"};
    }
    std::fill_n(parts_.part_of.begin() + static_cast<std::ptrdiff_t>(run.from),
                run.count, static_cast<std::uint32_t>(run.part));
  }
  if (!are_parts_closed(scene, parts_.part_of))
    return Error{ErrorCode::kOpen,
                 "caps fill solids, and a part is not closed"};
  options_.parts = std::make_shared<const CapParts>(std::move(parts_));
  return Done{};
}

bool Reader::body_line() {
  const auto is_one_of = [this](std::initializer_list<std::string_view> words) {
    return std::find(words.begin(), words.end(), tokens_[0]) != words.end();
  };
  if (tokens_[0] == "v") return vertex();
  if (tokens_[0] == "p") return polygon();
  if (is_one_of({"eye", "s0", "sx", "sy", "near", "size"})) {
    return camera_line();
  }
  if (is_one_of({"cull", "shade", "background"})) return option_line();
  if (tokens_[0] == "clip") return clip_line();
  if (tokens_[0] == "caps") return caps_line();
  if (tokens_[0] == "cap") return cap_line();
  if (tokens_[0] == "part") return part_line();
  if (is_one_of({kMagic, "unit", "grid"})) {
    bool seen = true;
    return once(seen);
  }
  return fail(ErrorCode::kSyntax, in_quotes(tokens_[0]) + " is no keyword");
}

/// Whether the camera is there as a whole, or not at all.
bool Reader::check_camera() {
  const struct {
    const char* name;
    bool seen;
  } parts[] = {{"eye", seen_.eye},
               {"s0", seen_.s0},
               {"sx", seen_.sx},
               {"sy", seen_.sy},
               {"size", seen_.size}};
  const auto seen = std::count_if(std::begin(parts), std::end(parts),
                                  [](const auto& part) { return part.seen; });
  if (seen == 0 && !seen_.near) return true;
  for (const auto& part : parts) {
    if (!part.seen) {
      return fail(ErrorCode::kSyntax,
                  std::string("the camera has no '") + part.name + "' line");
    }
  }
  return true;
}

Result<SceneFile> Reader::finish() {
  SceneFile file;
  Result<Scene> scene = make_scene(std::move(scene_));
  if (!scene) {
    Error error = scene.error();
    const auto polygon = static_cast<std::size_t>(error.index);
    if (error.index >= 0 && polygon < polygon_lines_.size()) {
      error.message = "line " + std::to_string(polygon_lines_[polygon]) + ": " +
                      error.message;
    }
    return error;
  }
  if (seen_.eye) {
    Result<Camera> camera = make_camera(camera_, scene->grid_bits());
    if (!camera) return camera.error();
    file.camera = *camera;
  }
  if (options_.caps && !bad_edges(*scene).empty()) {
    return Error{ErrorCode::kOpen,
                 "caps fill solids, and the scene is not closed"};
  }
  const Result<Done> parted = add_parts(*scene);
  if (!parted) return parted.error();
  file.options = options_;
  file.scene = *std::move(scene);
  return file;
}

Result<SceneFile> Reader::read() {
  if (!header()) return *error_;
  while (true) {
    if (!next_line()) {
      ++line_;
      fail(ErrorCode::kTruncated, "the file ends without 'end'");
      return *error_;
    }
    if (tokens_[0] == "end") break;
    if (!body_line()) return *error_;
  }
  line_ended_ = true;
  if (!count_is(0) || !check_camera()) return *error_;
  if (next_line()) {
    fail(ErrorCode::kSyntax, "there is more after 'end'");
    return *error_;
  }
  return finish();
}

}  // namespace

Result<SceneFile> read_scene(std::string_view text) {
  return Reader(text).read();
}

}  // namespace halfspace
