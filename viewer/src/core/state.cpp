#include "halfspace/viewer/state.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "halfspace/io/file.hpp"
#include "halfspace/io/load_scene.hpp"
#include "halfspace/io/scalars.hpp"

namespace halfspace::viewer {
namespace {

using nlohmann::json;

template <class T>
struct Name {
  const char* name;
  T value;
};

constexpr Name<Combination> kCombinations[] = {
    {"none", Combination::kNone},
    {"union", Combination::kUnion},
    {"difference", Combination::kDifference},
    {"intersection", Combination::kIntersection},
    {"symmetric-difference", Combination::kSymmetricDifference}};

constexpr Name<Coloring> kColorings[] = {{"file", Coloring::kFile},
                                         {"parts", Coloring::kParts},
                                         {"faces", Coloring::kFaces}};

constexpr Name<Lines> kLines[] = {{"none", Lines::kNone},
                                  {"outline", Lines::kOutline},
                                  {"features", Lines::kFeatures},
                                  {"wire", Lines::kWire}};

template <class T, std::size_t N>
const char* name_of(const Name<T> (&names)[N], T value) {
  for (const Name<T>& name : names) {
    if (name.value == value) return name.name;
  }
  return "";
}

json to_json(const Rgb& color) {
  return fmt::format("#{:02x}{:02x}{:02x}", color.r, color.g, color.b);
}

json to_json(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

json to_json(const io::ViewOptions& camera) {
  json result = {{"eye", to_json(camera.eye)},
                 {"target", to_json(camera.target)},
                 {"up", to_json(camera.up)},
                 {"fov", camera.fov_deg},
                 {"orthographic", camera.orthographic},
                 {"height", camera.ortho_height},
                 {"size", {camera.width_px, camera.height_px}}};
  if (camera.near) result["near"] = *camera.near;
  return result;
}

/// Reads entries. The first that is not what it must be leaves a sentence in
/// `fault`, and zeros in its place.
class Reader {
 public:
  Reader(const json& object, std::string name, std::string& fault)
      : object_(object), name_(std::move(name)), fault_(fault) {
    if (!object.is_object()) fail("", "is no object in braces");
  }

  bool has(const char* key) const {
    return object_.is_object() && object_.contains(key);
  }

  bool flag(const char* key, bool usual) const {
    if (!has(key)) return usual;
    if (object_[key].is_boolean()) return object_[key].get<bool>();
    fail(key, "must be true or false");
    return usual;
  }

  std::string text(const char* key) const {
    if (has(key) && object_[key].is_string())
      return object_[key].get<std::string>();
    fail(key, "must be a text");
    return {};
  }

  /// Requires: has(key).
  double number(const char* key) const { return number(object_[key], key); }

  std::array<double, 3> vector(const char* key) const {
    const json& value = has(key) ? object_[key] : json();
    if (value.is_array() && value.size() == 3) {
      return {number(value[0], key), number(value[1], key),
              number(value[2], key)};
    }
    fail(key, "must be three numbers");
    return {};
  }

  std::array<double, 2> pair(const char* key) const {
    const json& value = has(key) ? object_[key] : json();
    if (value.is_array() && value.size() == 2)
      return {number(value[0], key), number(value[1], key)};
    fail(key, "must be two numbers");
    return {0, 1};
  }

  std::array<std::int32_t, 2> size(const char* key) const {
    const json& value = has(key) ? object_[key] : json();
    const auto is_size = [](const json& n) {
      return n.is_number_integer() && n.get<std::int64_t>() >= 1 &&
             n.get<std::int64_t>() <= kMaxImageSize;
    };
    if (value.is_array() && value.size() == 2 && is_size(value[0]) &&
        is_size(value[1]))
      return {value[0].get<std::int32_t>(), value[1].get<std::int32_t>()};
    fail(key, "must be two numbers from 1 to 65536");
    return {1, 1};
  }

  Rgb color(const char* key) const {
    const std::string hex = text(key);
    unsigned value = 0;
    int length = 0;
    if (hex.size() != 7 ||
        std::sscanf(hex.c_str(), "#%6x%n", &value, &length) != 1 || length != 7)
      fail(key, "must be a colour such as #3f6fb0");
    return {static_cast<std::uint8_t>(value >> 16),
            static_cast<std::uint8_t>(value >> 8 & 255),
            static_cast<std::uint8_t>(value & 255)};
  }

  template <class T, std::size_t N>
  T choice(const char* key, const Name<T> (&names)[N], T usual) const {
    if (!has(key)) return usual;
    const std::string word = text(key);
    std::string all;
    for (const Name<T>& name : names) {
      if (word == name.name) return name.value;
      all += (all.empty() ? "" : ", ") + std::string(name.name);
    }
    fail(key, "must be one of " + all);
    return usual;
  }

  void fail(const std::string& key, const std::string& what) const {
    if (fault_.empty())
      fault_ = name_ + (key.empty() ? "" : "." + key) + " " + what;
  }

 private:
  double number(const json& value, const char* key) const {
    if (value.is_number() && std::isfinite(value.get<double>()))
      return value.get<double>();
    fail(key, "must be a finite number");
    return 0;
  }

  const json& object_;
  std::string name_;
  std::string& fault_;
};

glm::dvec3 to_glm(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

Part parse_part(const json& object, const std::string& name,
                const std::filesystem::path& folder, std::string& fault) {
  const Reader reader(object, name, fault);
  Part part;
  part.path = reader.text("file");
  if (!folder.empty() && !std::filesystem::path(part.path).is_absolute())
    part.path = (folder / part.path).string();
  part.is_visible = reader.flag("visible", true);
  if (reader.has("color")) part.color = reader.color("color");
  if (reader.has("shift")) part.shift = reader.vector("shift");
  return part;
}

io::ViewOptions parse_camera(const json& object, std::string& fault) {
  const Reader reader(object, "camera", fault);
  io::ViewOptions camera;
  camera.eye = to_glm(reader.vector("eye"));
  camera.target = to_glm(reader.vector("target"));
  camera.up = to_glm(reader.vector("up"));
  if (reader.has("fov")) camera.fov_deg = reader.number("fov");
  camera.orthographic = reader.flag("orthographic", false);
  if (reader.has("height")) camera.ortho_height = reader.number("height");
  if (reader.has("near")) camera.near = reader.number("near");
  if (!(camera.fov_deg > 0 && camera.fov_deg < 180))
    reader.fail("fov", "must be above 0 and below 180");
  if (!(camera.ortho_height > 0)) reader.fail("height", "must be above 0");
  const auto [width, height] = reader.size("size");
  camera.width_px = width;
  camera.height_px = height;
  return camera;
}

void parse_sections(const json& list, State& state, std::string& fault) {
  if (!list.is_array() || list.size() > kMostSections) {
    if (fault.empty()) fault = "view.sections must be a list of at most three";
    return;
  }
  for (const json& entry : list) {
    const Reader reader(
        entry, fmt::format("sections[{}]", state.sections.size()), fault);
    Section section;
    section.normal = reader.vector("normal");
    if (to_glm(section.normal) == glm::dvec3(0))
      reader.fail("normal", "must not be zero");
    if (reader.has("offset")) section.offset = reader.number("offset");
    section.is_on = reader.flag("on", true);
    state.sections.push_back(section);
  }
}

ScalarLook parse_scalar(const json& object, const std::filesystem::path& folder,
                        std::string& fault) {
  const Reader reader(object, "scalar", fault);
  ScalarLook look;
  look.source = reader.text("source");
  if (!folder.empty() && io::is_scalar_file_name(look.source) &&
      !std::filesystem::path(look.source).is_absolute())
    look.source = (folder / look.source).string();
  if (reader.has("map")) look.map = reader.text("map");
  look.is_logarithmic = reader.flag("log", false);
  look.has_legend = reader.flag("legend", true);
  if (reader.has("steps")) {
    const double steps = reader.number("steps");
    if (steps != 0 && !(steps >= 2 && steps <= 4096))
      reader.fail("steps", "must be 0, or from 2 to 4096");
    else
      look.steps = static_cast<std::int32_t>(steps);
  }
  if (reader.has("range")) {
    const auto range = reader.pair("range");
    if (!(range[0] < range[1])) reader.fail("range", "must go upwards");
    look.range = range;
  }
  return look;
}

State parse_all(const json& object, const std::filesystem::path& folder,
                std::string& fault) {
  const Reader reader(object, "view", fault);
  State state;
  if (!reader.has("parts") || !object["parts"].is_array()) {
    reader.fail("parts", "must be a list");
    return state;
  }
  for (const json& part : object["parts"]) {
    state.parts.push_back(parse_part(
        part, fmt::format("parts[{}]", state.parts.size()), folder, fault));
  }
  state.combination =
      reader.choice("combination", kCombinations, Combination::kNone);
  state.looks.is_smooth = reader.flag("smooth", false);
  state.looks.cull = reader.flag("cull", false);
  if (reader.has("background"))
    state.looks.background = reader.color("background");
  if (reader.has("alpha")) {
    const double alpha = reader.number("alpha");
    if (alpha >= 0 && alpha <= kOpaque && alpha == std::floor(alpha))
      state.looks.alpha = static_cast<std::uint8_t>(alpha);
    else
      reader.fail("alpha", "must be a whole number from 0 to 255");
  }
  if (reader.has("light")) {
    state.looks.light = reader.vector("light");
    if (to_glm(*state.looks.light) == glm::dvec3(0))
      reader.fail("light", "must not be zero");
  }
  if (reader.has("ambient")) {
    state.looks.ambient = reader.number("ambient");
    if (!(*state.looks.ambient >= 0 && *state.looks.ambient <= 1))
      reader.fail("ambient", "must be from 0 to 1");
  }
  state.looks.coloring = reader.choice("coloring", kColorings, Coloring::kFile);
  state.looks.lines = reader.choice("lines", kLines, Lines::kNone);
  if (reader.has("back_color"))
    state.looks.back_color = reader.color("back_color");
  if (reader.has("scalar"))
    state.looks.scalar = parse_scalar(object["scalar"], folder, fault);
  if (reader.has("sections")) parse_sections(object["sections"], state, fault);
  if (reader.has("camera"))
    state.camera = parse_camera(object["camera"], fault);
  return state;
}

}  // namespace

bool is_same(const io::ViewOptions& a, const io::ViewOptions& b) {
  return a.eye == b.eye && a.target == b.target && a.up == b.up &&
         a.fov_deg == b.fov_deg && a.orthographic == b.orthographic &&
         a.ortho_height == b.ortho_height && a.near == b.near &&
         a.width_px == b.width_px && a.height_px == b.height_px;
}

namespace {

std::string source_of(const Looks& looks) {
  return looks.scalar ? looks.scalar->source : std::string();
}

}  // namespace

bool have_same_scene(const State& a, const State& b) {
  return a.parts == b.parts && a.combination == b.combination &&
         a.looks.is_smooth == b.looks.is_smooth &&
         a.looks.light == b.looks.light && a.looks.ambient == b.looks.ambient &&
         a.looks.coloring == b.looks.coloring &&
         source_of(a.looks) == source_of(b.looks);
}

std::optional<Rgb> back_color_of(const State& state) {
  return state.looks.scalar ? std::nullopt : state.looks.back_color;
}

Rgb line_color_of(const State& state) {
  constexpr int kDark = 3 * 90;
  const Rgb paper = state.looks.background;
  const bool is_dark = paper.r + paper.g + paper.b < kDark;
  return is_dark ? Rgb{235, 238, 242} : Rgb{20, 20, 24};
}

bool has_sections(const State& state) {
  return std::any_of(state.sections.begin(), state.sections.end(),
                     [](const Section& section) { return section.is_on; });
}

std::string to_text(const State& state) {
  json parts = json::array();
  for (const Part& part : state.parts) {
    json entry = {{"file", part.path}};
    if (!part.is_visible) entry["visible"] = false;
    if (part.color) entry["color"] = to_json(*part.color);
    if (part.shift != std::array<double, 3>{}) entry["shift"] = part.shift;
    parts.push_back(std::move(entry));
  }
  json result = {{"parts", std::move(parts)},
                 {"background", to_json(state.looks.background)}};
  if (state.combination != Combination::kNone)
    result["combination"] = name_of(kCombinations, state.combination);
  if (state.looks.is_smooth) result["smooth"] = true;
  if (state.looks.cull) result["cull"] = true;
  if (state.looks.alpha != kOpaque) result["alpha"] = state.looks.alpha;
  for (const Section& section : state.sections) {
    result["sections"].push_back({{"normal", section.normal},
                                  {"offset", section.offset},
                                  {"on", section.is_on}});
  }
  if (state.looks.light) result["light"] = *state.looks.light;
  if (state.looks.ambient) result["ambient"] = *state.looks.ambient;
  if (state.looks.coloring != Coloring::kFile)
    result["coloring"] = name_of(kColorings, state.looks.coloring);
  if (state.looks.lines != Lines::kNone)
    result["lines"] = name_of(kLines, state.looks.lines);
  if (state.looks.back_color)
    result["back_color"] = to_json(*state.looks.back_color);
  if (state.looks.scalar) {
    const ScalarLook& look = *state.looks.scalar;
    result["scalar"] = {{"source", look.source},
                        {"map", look.map},
                        {"log", look.is_logarithmic},
                        {"steps", look.steps},
                        {"legend", look.has_legend}};
    if (look.range) result["scalar"]["range"] = *look.range;
  }
  if (state.camera) result["camera"] = to_json(*state.camera);
  return result.dump(2) + '\n';
}

Result<State> parse_state(std::string_view text,
                          const std::filesystem::path& folder) {
  const json object = json::parse(text, nullptr, /*allow_exceptions=*/false);
  if (object.is_discarded())
    return Error{ErrorCode::kSyntax, "this is no JSON, as .view files are"};
  std::string fault;
  State state = parse_all(object, folder, fault);
  if (!fault.empty()) return Error{ErrorCode::kSyntax, fault};
  return state;
}

bool is_view_name(const std::filesystem::path& path) {
  return io::has_extension(path, ".view");
}

Result<State> read_state(const std::filesystem::path& path) {
  // A view of ten thousand parts is smaller.
  constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 24;
  const Result<std::string> text = io::read_file(path, kMostBytes);
  if (!text) return text.error();
  Result<State> state = parse_state(*text, path.parent_path());
  if (!state) return io::error_about(path.string(), state.error());
  return state;
}

Result<Done> write_state(const std::filesystem::path& path,
                         const State& state) {
  // Whoever reads the file may stand elsewhere.
  State absolute = state;
  for (Part& part : absolute.parts) {
    std::error_code ignored;
    const auto full = std::filesystem::absolute(part.path, ignored);
    if (!ignored) part.path = full.string();
  }
  auto& scalar = absolute.looks.scalar;
  if (scalar && io::is_scalar_file_name(scalar->source)) {
    std::error_code ignored;
    const auto full = std::filesystem::absolute(scalar->source, ignored);
    if (!ignored) scalar->source = full.string();
  }
  return io::write_file(path, to_text(absolute));
}

}  // namespace halfspace::viewer
