#include "figure/notes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <sstream>

#include "cli/arguments.hpp"
#include "halfspace/io/file.hpp"

namespace halfspace::tools {
namespace {

constexpr std::uint64_t kMostNoteBytes = std::uint64_t{1} << 26;

double note_unit(const Scene& scene) {
  return std::pow(static_cast<double>(scene.unit().base),
                  scene.unit().exponent);
}

/// The grid point next to a point in the model's units; nothing beyond the
/// grid.
std::optional<GridPoint> on_grid(const Scene& scene, const glm::dvec3& p) {
  std::int64_t steps[3] = {};
  const double limit = std::ldexp(1, scene.grid_bits() - 1) - 1;
  for (int k = 0; k < 3; ++k) {
    const double value = std::round(p[k] / note_unit(scene));
    if (!(std::abs(value) <= limit)) return std::nullopt;
    steps[k] = static_cast<std::int64_t>(value);
  }
  return GridPoint{steps[0], steps[1], steps[2]};
}

/// Where points are seen, as far as doubles go.
class NoteCamera {
 public:
  explicit NoteCamera(const Camera& camera) {
    const auto vector = [](const LatticeVector& v) {
      return glm::dvec3(static_cast<double>(v.x), static_cast<double>(v.y),
                        static_cast<double>(v.z));
    };
    const CameraData& data = camera.data();
    perspective_ = data.perspective;
    from_ = perspective_ ? vector(data.eye) : vector(data.s0);
    const glm::dvec3 depth =
        perspective_ ? vector(data.s0) - vector(data.eye) : vector(data.eye);
    to_image_ =
        glm::inverse(glm::dmat3(vector(data.sx), vector(data.sy), depth));
  }
  /// Requires: in perspective the point is before the eye.
  glm::dvec2 at(const glm::dvec3& grid) const {
    const double lattice = std::ldexp(1, kLatticeBits);
    const glm::dvec3 p = to_image_ * (lattice * grid - from_);
    return perspective_ ? glm::dvec2(p.x / p.z, p.y / p.z)
                        : glm::dvec2(p.x, p.y);
  }

 private:
  bool perspective_ = false;
  glm::dvec3 from_ = glm::dvec3(0);
  glm::dmat3 to_image_ = glm::dmat3(1);
};

/// A step of 1, 2 or 5 times a power of ten that divides a length in some five.
double nice_step(double length) {
  const double rough = length / 5;
  const double power = std::pow(10, std::floor(std::log10(rough)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= rough * 0.999) return factor * power;
  }
  return 10 * power;
}

/// The axes of the box round a scene.
class AxisMaker {
 public:
  AxisMaker(Notes& notes, const Scene& scene, const Camera& camera)
      : notes_(notes), scene_(scene), camera_(camera) {
    low_ = glm::dvec3(std::numeric_limits<double>::max());
    high_ = -low_;
    for (const VertexId v : scene.data().corners) {
      const GridPoint& g = scene.point(v);
      const glm::dvec3 p(static_cast<double>(g.x), static_cast<double>(g.y),
                         static_cast<double>(g.z));
      low_ = glm::min(low_, p);
      high_ = glm::max(high_, p);
    }
  }

  void run() {
    const glm::dvec3 across = high_ - low_;
    tick_ = 0.02 * std::max({across.x, across.y, across.z});
    // Along x and y the bottom edge that is seen lower, along z the one that is
    // farthest to the left; ticks point away from the box.
    for (int axis = 0; axis < 2; ++axis) {
      const int other = 1 - axis;
      glm::dvec3 from = low_;
      from[other] = is_lower(axis, other) ? high_[other] : low_[other];
      glm::dvec3 out(0);
      out[other] = from[other] == high_[other] && across[other] > 0 ? 1 : -1;
      add(axis, from, out);
    }
    glm::dvec3 left = low_;
    for (int k = 1; k < 4; ++k) {
      glm::dvec3 corner = low_;
      for (int a = 0; a < 2; ++a) {
        if ((k >> a & 1) != 0) corner[a] = high_[a];
      }
      if (camera_.at(corner).x < camera_.at(left).x) left = corner;
    }
    glm::dvec3 out(0);
    const int side =
        camera_.at(left - glm::dvec3(tick_, 0, 0)).x < camera_.at(left).x - 1e-9
            ? -1
            : 1;
    out.x = side;
    add(2, left, out);
  }

 private:
  bool is_lower(int axis, int other) const {
    glm::dvec3 p = low_;
    p[axis] = (low_[axis] + high_[axis]) / 2;
    glm::dvec3 q = p;
    q[other] = high_[other];
    return camera_.at(q).y > camera_.at(p).y;
  }

  /// Beyond the grid there is nothing to draw on: then a point is left out.
  std::optional<GridPoint> grid_point(const glm::dvec3& p) const {
    return on_grid(scene_, p * note_unit(scene_));
  }

  void add(int axis, const glm::dvec3& from, const glm::dvec3& out) {
    glm::dvec3 to = from;
    to[axis] = high_[axis];
    if (to[axis] == from[axis]) return;
    line(from, to);
    const double unit = note_unit(scene_);
    const double first = from[axis] * unit;
    const double last = to[axis] * unit;
    const double step = nice_step(last - first);
    for (double k = std::ceil(first / step - 1e-9);
         k * step <= last + 1e-9 * step; ++k) {
      glm::dvec3 at = from;
      at[axis] = k * step / unit;
      line(at, at + tick_ * out);
      text(at + 3.0 * tick_ * out, fmt::format("{:g}", k * step + 0.0), "tick");
    }
    constexpr const char* kNames[] = {"x", "y", "z"};
    glm::dvec3 middle = from;
    middle[axis] = (from[axis] + to[axis]) / 2;
    text(middle + 6.5 * tick_ * out, kNames[axis], "axis");
  }

  void line(const glm::dvec3& from, const glm::dvec3& to) {
    const auto p = grid_point(from);
    const auto q = grid_point(to);
    if (p && q) notes_.lines.push_back({*p, *q});
  }
  void text(const glm::dvec3& at, const std::string& words,
            const char* class_of) {
    const auto p = grid_point(at);
    if (!p) return;
    notes_.texts.push_back({notes_.points.size(), words, class_of, false});
    notes_.points.push_back(*p);
  }

  Notes& notes_;
  const Scene& scene_;
  NoteCamera camera_;
  glm::dvec3 low_{};
  glm::dvec3 high_{};
  double tick_ = 0;
};

}  // namespace

Result<Notes> read_notes(const std::string& path, const Scene& scene) {
  const Result<std::string> text = io::read_file(path, kMostNoteBytes);
  if (!text) return text.error();
  Notes notes;
  std::istringstream lines(*text);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    const auto wrong = [&](ErrorCode code, const std::string& what) {
      return Error{code, fmt::format("line {}: {}", number, what)};
    };
    std::istringstream words(line.substr(0, line.find('#')));
    std::string word;
    if (!(words >> word)) continue;
    if (word != "line" && word != "point" && word != "text") {
      return wrong(ErrorCode::kSyntax,
                   "begins with '" + word + "', not line, point or text");
    }
    std::array<std::optional<GridPoint>, 2> points;
    for (std::size_t k = 0; k < (word == "line" ? 2u : 1u); ++k) {
      glm::dvec3 p(0);
      for (int c = 0; c < 3; ++c) {
        std::string number_text;
        words >> number_text;
        const std::optional<double> value = parse_number<double>(number_text);
        if (!value) {
          return wrong(ErrorCode::kSyntax,
                       "'" + number_text + "' is no finite number");
        }
        p[c] = *value;
      }
      points[k] = on_grid(scene, p);
      if (!points[k])
        return wrong(ErrorCode::kOutOfRange, "the point is beyond the grid");
    }
    std::string rest;
    std::getline(words >> std::ws, rest);
    rest.erase(rest.find_last_not_of(" \t\r") + 1);
    const bool has_text = !rest.empty();
    if (has_text == (word == "line") && word != "point") {
      return wrong(ErrorCode::kSyntax, word == "line"
                                           ? "'" + rest + "' is too much"
                                           : "the text has no letters");
    }
    if (std::any_of(rest.begin(), rest.end(),
                    [](char c) { return c < ' ' || c > '~'; }))
      return wrong(ErrorCode::kSyntax, "texts are of printable ASCII");
    if (word == "line") {
      notes.lines.push_back({*points[0], *points[1]});
      continue;
    }
    if (word == "point") notes.marks.push_back(notes.points.size());
    if (has_text) {
      notes.texts.push_back(
          {notes.points.size(), rest, "label", word == "point"});
    }
    notes.points.push_back(*points[0]);
  }
  return notes;
}

void add_axes(Notes& notes, const Scene& scene, const Camera& camera) {
  if (scene.polygon_count() > 0) AxisMaker(notes, scene, camera).run();
}

void add_notes(io::Figure& figure, const fast::Drawing& drawing,
               const Notes& notes, double text_size, const StrokeStyle& style,
               const Placing& placing) {
  add_strokes(figure, drawing, style, placing);
  io::FigureStrokes marks;
  marks.name = "points";
  marks.width = 2 * style.width;
  const double arm = 2 * style.width;
  for (const std::size_t mark : notes.marks) {
    const fast::SeenPoint& point = drawing.points[mark];
    if (!point.visible) continue;
    const io::FigurePoint at = placing.at(point.at.x, point.at.y);
    marks.strokes.push_back({{at[0] - arm, at[1]}, {at[0] + arm, at[1]}, {}});
    marks.strokes.push_back({{at[0], at[1] - arm}, {at[0], at[1] + arm}, {}});
  }
  if (!marks.strokes.empty()) figure.strokes.push_back(std::move(marks));
  for (const NoteText& text : notes.texts) {
    const fast::SeenPoint& point = drawing.points[text.point];
    if (!point.visible) continue;
    io::FigureText written;
    written.at = placing.at(point.at.x, point.at.y);
    if (text.beside) written.at[0] += 0.5 * text_size;
    // Capitals of Helvetica are 0.72 high.
    written.at[1] += 0.36 * text_size;
    written.text = text.text;
    written.size = text_size;
    written.class_of = text.class_of;
    written.anchor =
        text.beside ? io::TextAnchor::kStart : io::TextAnchor::kMiddle;
    figure.texts.push_back(std::move(written));
  }
}

}  // namespace halfspace::tools
