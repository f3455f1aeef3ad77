#include "image/camera_path.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <iterator>
#include <numbers>
#include <optional>
#include <sstream>
#include <utility>

#include "cli/loading.hpp"
#include "halfspace/io/file.hpp"

namespace halfspace::tools {
namespace {

constexpr std::int64_t kMostFrames = 10'000'000;
/// Ten times as much as kMostFrames lines have.
constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 30;

Error line_error(std::int64_t line, ErrorCode code, const std::string& what) {
  return {code, "line " + std::to_string(line) + ": " + what, line};
}

/// Reads one value and stores it; false where the text is none.
template <class T>
bool store(std::optional<T>& place, const std::string& text,
           std::optional<T> (*parse)(std::string_view)) {
  const std::optional<T> value = parse(text);
  if (value) place = value;
  return value.has_value();
}

/// Sets what `word` names; nothing where it names nothing, else whether the
/// value was understood.
std::optional<bool> set(ViewArguments& view, const std::string& word,
                        const std::string& value) {
  if (word == "eye") return store(view.eye, value, parse_vector);
  if (word == "target") return store(view.target, value, parse_vector);
  if (word == "up") return store(view.up, value, parse_vector);
  if (word == "fov") return store(view.fov_deg, value, parse_number<double>);
  if (word == "height")
    return store(view.ortho_height, value, parse_number<double>);
  if (word == "near") return store(view.near, value, parse_number<double>);
  return std::nullopt;
}

/// Sets what `word`, an object's name, a dot and a word of set_stand(), says.
std::optional<bool> set_object(KeyFrame& key, const std::string& word,
                               const std::string& value) {
  const std::size_t dot = word.find('.');
  if (dot == std::string::npos) return std::nullopt;
  Stand tried;
  const std::string said = word.substr(dot + 1);
  const auto understood = set_stand(tried, said, value);
  if (understood == true) key.objects[word.substr(0, dot)][said] = value;
  return understood;
}

std::optional<std::int64_t> parse_frame(const std::string& text) {
  const auto frame = parse_number<std::int64_t>(text);
  return frame && *frame >= 0 && *frame < kMostFrames ? frame : std::nullopt;
}

/// Sets what cuts, as set() does. The planes of a line are all that there are.
std::optional<bool> set_clip(KeyFrame& key, bool& has_planes,
                             const std::string& word,
                             const std::string& value) {
  if (word == "yon") return store(key.yon, value, parse_yon);
  if (word != "clip") return std::nullopt;
  if (!has_planes) key.planes.clear();
  has_planes = true;
  const std::optional<ClipNumbers> plane = parse_clip_numbers(value);
  if (plane) key.planes.push_back(*plane);
  return plane.has_value();
}

/// What the value of a word that is known must be.
std::string wanted_of(const std::string& word) {
  const std::size_t dot = word.find('.');
  if (dot != std::string::npos) return stand_value_of(word.substr(dot + 1));
  if (word == "eye" || word == "target" || word == "up")
    return "X,Y,Z, three finite numbers";
  if (word == "clip") return "A,B,C,D, four numbers";
  return word == "yon" ? "a number above 0" : "a finite number";
}

/// One line's words into a key frame.
std::optional<Error> parse_line(const std::vector<std::string>& words,
                                std::int64_t line, KeyFrame& key) {
  const std::optional<std::int64_t> frame = parse_frame(words[0]);
  if (!frame) {
    return line_error(line, ErrorCode::kSyntax,
                      "begins with the number of a frame, 0 to " +
                          std::to_string(kMostFrames - 1) + ", not '" +
                          words[0] + "'");
  }
  key.frame = *frame;
  bool has_planes = false;
  for (std::size_t k = 1; k < words.size(); k += 2) {
    const std::string& word = words[k];
    const std::string value = k + 1 < words.size() ? words[k + 1] : "";
    std::optional<bool> understood = set(key.view, word, value);
    if (!understood) understood = set_clip(key, has_planes, word, value);
    if (!understood) understood = set_object(key, word, value);
    if (!understood) {
      return line_error(
          line, ErrorCode::kSyntax,
          "knows eye, target, up, fov, height, near, clip, yon and, of "
          "objects, NAME.move, NAME.turn, NAME.scale and NAME.there, not '" +
              word + "'");
    }
    if (!*understood) {
      return line_error(
          line, ErrorCode::kSyntax,
          word + " must be " + wanted_of(word) + ", not '" + value + "'");
    }
  }
  return std::nullopt;
}

/// A word that the later of two key frames says and the earlier one does not.
std::optional<std::string> news(const KeyFrame& first, const KeyFrame& next) {
  if (!next.planes.empty() && first.planes.empty()) return "clip";
  if (next.yon && !first.yon) return "yon";
  const ViewArguments& before = first.view;
  const ViewArguments& after = next.view;
  if (after.eye && !before.eye) return "eye";
  if (after.target && !before.target) return "target";
  if (after.up && !before.up) return "up";
  if (after.fov_deg && !before.fov_deg) return "fov";
  if (after.ortho_height && !before.ortho_height) return "height";
  if (after.near && !before.near) return "near";
  return std::nullopt;
}

/// The value at `share` of the way from a to b; a and b themselves where they
/// are equal, so that what stands still stands still.
double between(double a, double b, double share) {
  return a == b ? a : a + (b - a) * share;
}

glm::dvec3 between(const glm::dvec3& a, const glm::dvec3& b, double share) {
  return {between(a.x, b.x, share), between(a.y, b.y, share),
          between(a.z, b.z, share)};
}

ClipNumbers between(const ClipNumbers& a, const ClipNumbers& b, double share) {
  ClipNumbers plane = a;
  for (std::size_t k = 0; k < plane.size(); ++k) {
    const double from = io::to_double(a[k]);
    const double to = io::to_double(b[k]);
    if (from != to) plane[k] = io::number_of(between(from, to, share));
  }
  return plane;
}

template <class T>
std::optional<T> between(const std::optional<T>& a, const std::optional<T>& b,
                         double share) {
  if (!a || !b) return a;
  return between(*a, *b, share);
}

}  // namespace

CameraPath::CameraPath(std::vector<KeyFrame> keys) : keys_(std::move(keys)) {}

CameraPath::Place CameraPath::place_of(std::int64_t frame) const {
  const auto after =
      std::lower_bound(keys_.begin(), keys_.end(), frame,
                       [](const KeyFrame& key, std::int64_t wanted) {
                         return key.frame < wanted;
                       });
  if (after->frame == frame) return {*after, *after, 0};
  const KeyFrame& before = *std::prev(after);
  return {before, *after,
          static_cast<double>(frame - before.frame) /
              static_cast<double>(after->frame - before.frame)};
}

ViewArguments CameraPath::at(std::int64_t frame) const {
  const auto [a, b, share] = place_of(frame);
  ViewArguments view = a.view;
  view.eye = between(a.view.eye, b.view.eye, share);
  view.target = between(a.view.target, b.view.target, share);
  view.up = between(a.view.up, b.view.up, share);
  view.fov_deg = between(a.view.fov_deg, b.view.fov_deg, share);
  view.ortho_height = between(a.view.ortho_height, b.view.ortho_height, share);
  view.near = between(a.view.near, b.view.near, share);
  return view;
}

ClipArguments CameraPath::clip_at(std::int64_t frame,
                                  ClipArguments start) const {
  const auto [a, b, share] = place_of(frame);
  if (a.yon) start.yon = between(a.yon, b.yon, share);
  if (a.planes.empty()) return start;
  start.planes.clear();
  for (std::size_t k = 0; k < a.planes.size(); ++k)
    start.planes.push_back(between(a.planes[k], b.planes[k], share));
  return start;
}

Stand CameraPath::stand_at(const std::string& object, std::int64_t frame,
                           Stand start) const {
  const auto of = [&](const KeyFrame& key) {
    Stand stand = start;
    const auto words = key.objects.find(object);
    if (words == key.objects.end()) return stand;
    for (const auto& [word, value] : words->second)
      set_stand(stand, word, value);
    return stand;
  };
  const auto [a, b, share] = place_of(frame);
  return share == 0 ? of(a) : between(of(a), of(b), share);
}

std::set<std::string> CameraPath::objects() const {
  std::set<std::string> names;
  for (const KeyFrame& key : keys_) {
    for (const auto& [name, words] : key.objects) names.insert(name);
  }
  return names;
}

std::optional<ChosenCamera> CameraPath::camera_at(std::int64_t frame) const {
  const Place place = place_of(frame);
  return place.share == 0 ? place.before.camera : std::nullopt;
}

namespace {

/// The angle of a frame of a turn.
double turntable_angle(std::uint32_t frame, std::uint32_t frames) {
  return 2 * std::numbers::pi * frame / frames;
}

/// The turn of a camera, which `camera_of` gives for each angle.
Result<CameraPath> turntable_of(
    std::uint32_t frames, const ViewArguments& start,
    const std::function<Result<ChosenCamera>(double angle)>& camera_of) {
  std::vector<KeyFrame> keys;
  for (std::uint32_t k = 0; k < frames; ++k) {
    const auto camera = camera_of(turntable_angle(k, frames));
    if (!camera) return camera.error();
    keys.push_back({std::int64_t{k}, start, {}, *camera});
  }
  return CameraPath(std::move(keys));
}

/// The turn that begins at a view.
Result<CameraPath> turntable_from(const Scene& scene,
                                  const io::ViewOptions& first,
                                  std::uint32_t frames,
                                  const ViewArguments& start,
                                  const glm::dvec3& axis) {
  return turntable_of(frames, start, [&](double angle) -> Result<ChosenCamera> {
    const auto viewed =
        io::look_at(scene, io::turned_about(first, axis, angle));
    if (!viewed) return viewed.error();
    return ChosenCamera{viewed->camera, viewed->max_move, false};
  });
}

/// The turn that begins at the file's own camera.
Result<CameraPath> turntable_from_own(
    const SceneFile& file, const std::optional<io::ViewOptions>& own_view,
    std::uint32_t frames, const ViewArguments& start) {
  // A part of another camera, or another size, is refused as for a still.
  const Result<ChosenCamera> first = choose_camera(file, start);
  if (!first) return first.error();
  const glm::dvec3 axis(0, 0, 1);
  if (own_view)
    return turntable_from(file.scene, *own_view, frames, start, axis);
  return turntable_of(frames, start, [&](double angle) -> Result<ChosenCamera> {
    const auto camera =
        io::turned_about(file.scene, first->camera, axis, angle);
    if (!camera) return camera.error();
    return ChosenCamera{*camera, 0, true};
  });
}

/// The turn that has all of the scene in every picture.
Result<CameraPath> turntable_of_all(const Scene& scene, std::uint32_t frames,
                                    const ViewArguments& start,
                                    const glm::dvec3& up) {
  const io::ViewDirection first = start.view.value_or(io::ViewDirection());
  const Size size = start.size.value_or(kUsualSize);
  const bool is_parallel = start.orthographic || start.ortho_height;
  std::vector<glm::dvec3> directions;
  double distance = 0;
  double height = 0;
  double fov_deg = 0;
  for (std::uint32_t k = 0; k < frames; ++k) {
    const double angle = turntable_angle(k, frames);
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    const auto turn = [&](const glm::dvec3& v) {
      return glm::dvec3(c * v.x - s * v.y, s * v.x + c * v.y, v.z);
    };
    const io::ViewDirection direction =
        io::turned({turn(first.to_eye), turn(first.up)}, up);
    const Result<io::ViewOptions> fitted = io::automatic_options(
        scene, direction, size.width_px, size.height_px, is_parallel);
    if (!fitted) return fitted.error();
    distance = std::max(distance, glm::distance(fitted->eye, fitted->target));
    height = std::max(height, fitted->ortho_height);
    fov_deg = start.fov_deg.value_or(fitted->fov_deg);
    directions.push_back(glm::normalize(direction.to_eye));
  }
  // So far from the middle that each picture has its own fit and some more.
  constexpr double kMargin = 1.15;
  const glm::dvec3 middle = io::middle_of(scene);
  std::vector<KeyFrame> keys;
  for (std::uint32_t k = 0; k < frames; ++k) {
    KeyFrame key{std::int64_t{k}, start};
    key.view.view = std::nullopt;
    key.view.target = middle;
    key.view.eye = middle + kMargin * distance * directions[k];
    if (start.fov_deg || !is_parallel) key.view.fov_deg = fov_deg;
    if (is_parallel && !start.ortho_height)
      key.view.ortho_height = kMargin * height;
    keys.push_back(std::move(key));
  }
  return CameraPath(std::move(keys));
}

}  // namespace

Result<CameraPath> turntable(const SceneFile& file,
                             const std::optional<io::ViewOptions>& own_view,
                             std::uint32_t frames, const ViewArguments& start) {
  const glm::dvec3 up = start.up.value_or(glm::dvec3(0, 0, 1));
  if (up == glm::dvec3(0)) {
    return Error{ErrorCode::kBadCamera,
                 "the camera's up is zero, which points nowhere"};
  }
  if (start.eye) {
    ViewArguments sized = start;
    sized.size = start.size.value_or(kUsualSize);
    const Result<io::ViewOptions> first = complete_view(file.scene, sized);
    if (!first) return first.error();
    return turntable_from(file.scene, *first, frames, start,
                          glm::normalize(up));
  }
  if (file.camera && !start.view)
    return turntable_from_own(file, own_view, frames, start);
  return turntable_of_all(file.scene, frames, start, up);
}

Result<CameraPath> parse_camera_path(const std::string& text,
                                     const ViewArguments& start,
                                     const ClipArguments& clip) {
  std::vector<KeyFrame> keys;
  std::istringstream lines(text);
  std::string content;
  for (std::int64_t line = 1; std::getline(lines, content); ++line) {
    std::istringstream tokens(content.substr(0, content.find('#')));
    const std::vector<std::string> words{
        std::istream_iterator<std::string>(tokens), {}};
    if (words.empty()) continue;
    KeyFrame key;
    if (keys.empty()) {
      key.view = start;
      key.planes = clip.planes;
      key.yon = clip.yon;
    } else {
      key = keys.back();
    }
    if (const auto error = parse_line(words, line, key)) return *error;
    if (!keys.empty() && key.frame <= keys.back().frame) {
      return line_error(line, ErrorCode::kOutOfRange,
                        "frame " + std::to_string(key.frame) +
                            " comes after frame " +
                            std::to_string(keys.back().frame));
    }
    if (!keys.empty()) {
      const auto word = news(keys.back(), key);
      if (word) {
        return line_error(line, ErrorCode::kSyntax,
                          *word +
                              " is said here, but neither by the lines "
                              "before nor as an option --" +
                              *word);
      }
    }
    if (!keys.empty() && key.planes.size() != keys.back().planes.size()) {
      return line_error(line, ErrorCode::kSyntax,
                        "clip is said " + std::to_string(key.planes.size()) +
                            " times here, and " +
                            std::to_string(keys.back().planes.size()) +
                            " times before: planes move, and none comes or "
                            "goes");
    }
    keys.push_back(std::move(key));
  }
  if (keys.empty()) return Error{ErrorCode::kEmpty, "there are no cameras"};
  return CameraPath(std::move(keys));
}

Result<CameraPath> read_camera_path(const std::string& path,
                                    const ViewArguments& start,
                                    const ClipArguments& clip) {
  const Result<std::string> text = io::read_file(path, kMostBytes);
  if (!text) return io::error_about(path, text.error());
  Result<CameraPath> parsed = parse_camera_path(*text, start, clip);
  if (!parsed) return io::error_about(path, parsed.error());
  return parsed;
}

}  // namespace halfspace::tools
