#include <algorithm>
#include <utility>

#include "base/text.hpp"
#include "mesh/label_maker.hpp"
#include "mesh/mesh_builder.hpp"
#include "mesh/readers.hpp"

namespace halfspace::io {
namespace {

/// What stands beside faces and does not change them.
constexpr std::string_view kPassedOver[] = {
    "vp",         "l",         "p",   "s",     "mg",       "usemap",   "maplib",
    "shadow_obj", "trace_obj", "lod", "bevel", "c_interp", "d_interp", "vc"};

/// Free-form geometry, and what only belongs to it.
constexpr std::string_view kFreeForm[] = {
    "cstype", "deg",  "bmat", "step", "curv", "curv2", "surf",
    "parm",   "trim", "hole", "scrv", "sp",   "end",   "con",
    "bsp",    "bzp",  "cdc",  "cdp",  "res",  "ctech", "stech"};

/// Numbers that corners refer to, `width` each: texture points, or normals.
class References {
 public:
  explicit References(std::size_t width) : width_(width) {}

  std::int64_t count() const {
    return static_cast<std::int64_t>(values_.size() / width_);
  }
  void add(std::span<const std::string_view> values) {
    for (std::size_t i = 0; i < width_; ++i)
      values_.push_back(i < values.size() ? value_or_none(values[i])
                                          : kNoValue);
  }
  /// Corner number `corner` refers to the numbers at `place`.
  void refer(std::size_t corner, std::int64_t place) {
    if (place < 0 && of_corner_.empty()) return;
    of_corner_.resize(corner, -1);
    of_corner_.push_back(place);
  }
  /// Adds the channel, if a corner refers to something; counts the references
  /// to what is not there.
  void finish(Channel channel, std::size_t corner_count, Mesh& mesh,
              std::size_t& dangling) {
    if (of_corner_.empty()) return;
    of_corner_.resize(corner_count, -1);
    channel.width = width_;
    channel.values.reserve(corner_count * width_);
    for (const std::int64_t place : of_corner_) {
      const bool is_there = place >= 0 && place < count();
      if (place >= count()) ++dangling;
      for (std::size_t i = 0; i < width_; ++i) {
        channel.values.push_back(
            is_there ? values_[static_cast<std::size_t>(place) * width_ + i]
                     : kNoValue);
      }
    }
    mesh.attributes.corners.push_back(std::move(channel));
  }

 private:
  std::size_t width_;
  std::vector<double> values_;
  std::vector<std::int64_t> of_corner_;
};

class ObjReader {
 public:
  ObjReader(std::string_view text, const Stop& stop)
      : text_(text, {.comments = true, .continued = true}), builder_(stop) {}
  Result<Mesh> read();

 private:
  using Tokens = std::span<const std::string_view>;

  bool fail(ErrorCode code, const std::string& what) {
    error_ = text_.error(code, what);
    return false;
  }
  bool fail(const Error& error) { return fail(error.code, error.message); }
  bool statement(std::string_view keyword, Tokens values);
  bool vertex(Tokens values);
  bool face(Tokens values);
  bool corner(std::string_view token);
  bool refer(std::string_view token, References& references);
  bool names(std::string_view keyword, Tokens values);
  bool check_forward_references();
  void add_attributes();

  /// An index that names a vertex not there yet: that may still come.
  struct ForwardReference {
    std::int64_t index;
    std::int64_t line;
  };

  TextReader text_;
  MeshBuilder builder_;
  std::vector<ForwardReference> forward_;
  References texture_{2};
  References normals_{3};
  LabelMaker objects_;
  LabelMaker groups_;
  LabelMaker materials_;
  std::optional<Error> error_;
};

bool ObjReader::vertex(Tokens values) {
  const std::size_t count = values.size();
  if (count != 3 && count != 4 && count != 6 && count != 7) {
    return fail(ErrorCode::kSyntax, "a vertex has 3 coordinates, not " +
                                        std::to_string(count) + " values");
  }
  std::array<Number, 7> numbers;
  for (std::size_t i = 0; i < count; ++i) {
    Result<Number> number = parse_number(values[i]);
    if (!number) return fail(number.error());
    numbers[i] = *std::move(number);
  }
  if (count == 4 && numbers[3] != Number{1, 0, 0}) {
    return fail(ErrorCode::kOutOfRange, "the vertex has the weight " +
                                            in_quotes(values[3]) +
                                            ", but only 1 is read");
  }
  Mesh& mesh = builder_.mesh;
  if (count >= 6) {
    // After a weight, if there is one (7 values).
    const Result<Rgb> color = color_of(
        {numbers[count - 3], numbers[count - 2], numbers[count - 1]}, 1);
    if (!color) return fail(color.error());
    mesh.vertex_colors.resize(mesh.vertices.size());
    mesh.vertex_colors.emplace_back(*color);
  }
  if (auto error =
          builder_.add_vertex({std::move(numbers[0]), std::move(numbers[1]),
                               std::move(numbers[2])})) {
    return fail(*error);
  }
  return true;
}

/// Notes a corner's index of a texture point or normal: any integer but 0, or
/// none.
bool ObjReader::refer(std::string_view token, References& references) {
  const std::size_t corner = builder_.mesh.corners.size();
  if (token.empty()) {
    references.refer(corner, -1);
    return true;
  }
  const Result<std::int64_t> index = parse_integer(token);
  if (!index) return fail(index.error());
  if (*index == 0) {
    return fail(ErrorCode::kBadIndex,
                "an index is 0, but indices count from 1");
  }
  references.refer(
      corner, *index > 0
                  ? *index - 1
                  : std::max<std::int64_t>(
                        -1, references.count() +
                                std::max(*index, -references.count() - 1)));
  return true;
}

bool ObjReader::corner(std::string_view token) {
  const std::size_t slash = token.find('/');
  const Result<std::int64_t> index = parse_integer(token.substr(0, slash));
  if (!index) return fail(index.error());
  if (slash != std::string_view::npos) {
    const std::string_view rest = token.substr(slash + 1);
    const std::size_t second = rest.find('/');
    if (!refer(rest.substr(0, second), texture_)) return false;
    if (second != std::string_view::npos &&
        !refer(rest.substr(second + 1), normals_)) {
      return false;
    }
  }
  const auto count = static_cast<std::int64_t>(builder_.mesh.vertices.size());
  if (*index == 0) {
    return fail(ErrorCode::kBadIndex,
                "an index is 0, but indices count from 1");
  }
  if (*index < -count || *index > static_cast<std::int64_t>(kMaxCount)) {
    return fail(ErrorCode::kBadIndex, "there is no vertex " + in_quotes(token) +
                                          ", only " + std::to_string(count) +
                                          " so far");
  }
  if (*index > count) forward_.push_back({*index, text_.line()});
  if (auto error =
          builder_.add_corner(*index > 0 ? *index - 1 : count + *index)) {
    return fail(*error);
  }
  return true;
}

bool ObjReader::face(Tokens values) {
  if (values.size() < 3) {
    // A cut line is too short because of that.
    return fail(
        text_.is_cut() ? ErrorCode::kSyntax : ErrorCode::kTooFewVertices,
        "a face has " + std::to_string(values.size()) + " corners");
  }
  for (const std::string_view token : values) {
    if (!corner(token)) return false;
  }
  const std::size_t face = builder_.mesh.face_count();
  for (LabelMaker* labels : {&objects_, &groups_, &materials_})
    labels->add_face(face);
  builder_.end_face();
  return true;
}

/// A statement that names the faces after it, or a file of materials.
bool ObjReader::names(std::string_view keyword, Tokens values) {
  std::string name = joined(values);
  // What stands for having none again.
  if (name == (keyword == "g" ? "default" : "none")) name.clear();
  if (keyword == "mtllib") {
    builder_.mesh.attributes.files.emplace_back(name);
  } else if (keyword == "o") {
    objects_.name_from_here(name);
  } else if (keyword == "g") {
    groups_.name_from_here(name);
  } else {
    materials_.name_from_here(name);
  }
  return true;
}

bool ObjReader::statement(std::string_view keyword, Tokens values) {
  if (keyword == "v") return vertex(values);
  if (keyword == "f" || keyword == "fo") return face(values);
  const auto is_one_of = [keyword](std::span<const std::string_view> words) {
    return std::find(words.begin(), words.end(), keyword) != words.end();
  };
  if (keyword == "vt" || keyword == "vn") {
    (keyword == "vt" ? texture_ : normals_).add(values);
    return true;
  }
  if (keyword == "o" || keyword == "g" || keyword == "usemtl" ||
      keyword == "mtllib") {
    return names(keyword, values);
  }
  if (is_one_of(kPassedOver)) return true;
  if (is_one_of(kFreeForm)) {
    return fail(ErrorCode::kUnknownFormat, "free-form curves and surfaces (" +
                                               in_quotes(keyword) +
                                               ") are not read");
  }
  return fail(ErrorCode::kSyntax, in_quotes(keyword) + " is no OBJ statement");
}

bool ObjReader::check_forward_references() {
  const auto count = static_cast<std::int64_t>(builder_.mesh.vertices.size());
  for (const auto& [index, line] : forward_) {
    if (index <= count) continue;
    error_ = Error{ErrorCode::kBadIndex,
                   "line " + std::to_string(line) + ": there is no vertex " +
                       std::to_string(index) + ", only " +
                       std::to_string(count) + " in the file",
                   line};
    return false;
  }
  return true;
}

void ObjReader::add_attributes() {
  Mesh& mesh = builder_.mesh;
  Attributes& attributes = mesh.attributes;
  const std::size_t faces = mesh.face_count();
  attributes.objects = objects_.taken(faces);
  attributes.groups = groups_.taken(faces);
  Labels materials = materials_.taken(faces);
  for (std::string& name : materials.names)
    attributes.materials.push_back({std::move(name)});
  attributes.face_materials = std::move(materials.of_face);
  std::size_t dangling = 0;
  texture_.finish({"uv", ChannelKind::kTexture}, mesh.corners.size(), mesh,
                  dangling);
  normals_.finish({"normal", ChannelKind::kNormal}, mesh.corners.size(), mesh,
                  dangling);
  if (dangling > 0) {
    attributes.notes.push_back(std::to_string(dangling) +
                               " corners name texture points or normals that "
                               "are not there; they have none");
  }
}

Result<Mesh> ObjReader::read() {
  builder_.mesh.decimal = true;
  while (text_.next_line()) {
    const Tokens tokens = text_.left();
    if (!statement(tokens[0], tokens.subspan(1))) return *error_;
  }
  if (!check_forward_references()) return *error_;
  Mesh& mesh = builder_.mesh;
  if (!mesh.vertex_colors.empty()) {
    mesh.vertex_colors.resize(mesh.vertices.size());
  }
  add_attributes();
  return std::move(mesh);
}

}  // namespace

Result<Mesh> read_obj(std::string_view bytes, const Stop& stop) {
  if (auto error = not_plain_text(bytes)) return *error;
  return ObjReader(bytes, stop).read();
}

}  // namespace halfspace::io
