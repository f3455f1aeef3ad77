#include "base/text.hpp"
#include "mesh/mesh_builder.hpp"
#include "mesh/readers.hpp"

namespace halfspace::io {
namespace {

class OffReader {
 public:
  OffReader(std::string_view text, const Stop& stop)
      : text_(text, {.comments = true, .continued = false}), builder_(stop) {}
  Result<Mesh> read();

 private:
  using Tokens = std::span<const std::string_view>;

  bool fail(ErrorCode code, const std::string& what) {
    error_ = text_.error(code, what);
    return false;
  }
  bool fail(const Error& error) { return fail(error.code, error.message); }
  bool take(std::string_view& token, const char* what, std::int64_t index,
            std::int64_t count);
  bool magic(std::string_view& glued);
  bool counts(std::string_view glued);
  bool vertex(std::int64_t index);
  bool face(std::int64_t index);
  bool color(Tokens tokens, std::optional<Rgb>& value);
  bool finish();

  TextReader text_;
  MeshBuilder builder_;
  bool has_texture_ = false;
  bool has_color_ = false;
  bool has_normal_ = false;
  std::int64_t vertices_ = 0;
  std::int64_t faces_ = 0;
  std::optional<Error> error_;
};

bool OffReader::take(std::string_view& token, const char* what,
                     std::int64_t index, std::int64_t count) {
  if (text_.next(token)) return true;
  return fail(ErrorCode::kTruncated, std::string("the file ends in ") + what +
                                         " " + std::to_string(index) + " of " +
                                         std::to_string(count));
}

/// The first word, `OFF` after any of ST, C, N; `glued` is what follows it.
bool OffReader::magic(std::string_view& glued) {
  std::string_view token;
  if (!text_.next(token)) {
    return fail(ErrorCode::kTruncated, "the file has no 'OFF'");
  }
  const std::string_view whole = token;
  const auto take_prefix = [&token](std::string_view prefix) {
    if (!token.starts_with(prefix)) return false;
    token.remove_prefix(prefix.size());
    return true;
  };
  has_texture_ = take_prefix("ST");
  has_color_ = take_prefix("C");
  has_normal_ = take_prefix("N");
  const bool other_space = token.starts_with("4") || token.starts_with("n");
  if (other_space && token.substr(1).find("OFF") != std::string_view::npos) {
    return fail(ErrorCode::kUnknownFormat,
                in_quotes(whole) + " has other than 3 dimensions");
  }
  if (!take_prefix("OFF")) {
    return fail(ErrorCode::kUnknownFormat,
                "an OFF file starts with 'OFF', not " + in_quotes(whole));
  }
  glued = token;
  if (glued == "BINARY" ||
      (glued.empty() && !text_.left().empty() && text_.left()[0] == "BINARY")) {
    return fail(ErrorCode::kUnknownFormat, "binary OFF is not read");
  }
  return true;
}

/// The numbers of vertices, faces and edges; some files lack the last.
bool OffReader::counts(std::string_view glued) {
  std::int64_t values[3] = {0, 0, 0};
  for (int i = 0; i < 3; ++i) {
    if (i == 2 && text_.left().empty()) break;
    std::string_view token = glued;
    if ((i > 0 || glued.empty()) && !take(token, "count", i, 3)) return false;
    const Result<std::int64_t> value = parse_integer(token);
    if (!value) return fail(value.error());
    values[i] = *value;
    if (values[i] < 0 ||
        (i < 2 && values[i] > static_cast<std::int64_t>(kMaxCount))) {
      return fail(ErrorCode::kOutOfRange, "there cannot be " +
                                              in_quotes(token) +
                                              (i == 0   ? " vertices"
                                               : i == 1 ? " faces"
                                                        : " edges"));
    }
  }
  if (!text_.left().empty()) {
    return fail(ErrorCode::kSyntax, "there are more than 3 counts");
  }
  vertices_ = values[0];
  faces_ = values[1];
  return true;
}

/// A colour of the rest of a line: nothing, an index into a table that is not
/// there, or 3 or 4 values, from 0 to 1 if any has a point and to 255 if not.
bool OffReader::color(Tokens tokens, std::optional<Rgb>& value) {
  if (tokens.size() < 2) return true;
  if (tokens.size() > 4 || tokens.size() == 2) {
    return fail(ErrorCode::kSyntax, "a colour has 3 or 4 values, not " +
                                        std::to_string(tokens.size()));
  }
  int range = 255;
  std::array<Number, 4> numbers;
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    Result<Number> number = parse_number(tokens[i]);
    if (!number) return fail(number.error());
    numbers[i] = *std::move(number);
    if (tokens[i].find_first_of(".eE") != std::string_view::npos) range = 1;
  }
  const Result<Rgb> rgb = color_of({numbers[0], numbers[1], numbers[2]}, range);
  if (!rgb) return fail(rgb.error());
  value = *rgb;
  return true;
}

bool OffReader::vertex(std::int64_t index) {
  std::array<Number, 3> point;
  std::string_view token;
  for (Number& coordinate : point) {
    if (!take(token, "vertex", index, vertices_)) return false;
    Result<Number> number = parse_number(token);
    if (!number) return fail(number.error());
    coordinate = *std::move(number);
  }
  for (int i = 0; has_normal_ && i < 3; ++i) {
    if (!take(token, "vertex", index, vertices_)) return false;
  }
  Tokens rest = text_.left();
  const std::size_t texture = has_texture_ ? 2 : 0;
  if (rest.size() < texture || (!has_color_ && rest.size() > texture)) {
    return fail(ErrorCode::kSyntax, "vertex " + std::to_string(index) +
                                        " has " + std::to_string(rest.size()) +
                                        " values more than its coordinates");
  }
  rest = rest.first(rest.size() - texture);
  if (has_color_) {
    std::optional<Rgb> value;
    if (!color(rest, value)) return false;
    builder_.mesh.vertex_colors.push_back(value);
  }
  text_.skip_line();
  if (auto error = builder_.add_vertex(std::move(point))) return fail(*error);
  return true;
}

bool OffReader::face(std::int64_t index) {
  std::string_view token;
  if (!take(token, "face", index, faces_)) return false;
  const Result<std::int64_t> count = parse_integer(token);
  if (!count) return fail(count.error());
  if (*count < 0) {
    return fail(ErrorCode::kOutOfRange, "face " + std::to_string(index) +
                                            " has " + in_quotes(token) +
                                            " corners");
  }
  for (std::int64_t i = 0; i < *count; ++i) {
    if (!take(token, "face", index, faces_)) return false;
    const Result<std::int64_t> vertex = parse_integer(token);
    if (!vertex) return fail(vertex.error());
    if (*vertex < 0 || *vertex >= vertices_) {
      return fail(ErrorCode::kBadIndex, "face " + std::to_string(index) +
                                            ": there is no vertex " +
                                            in_quotes(token) + ", only 0 to " +
                                            std::to_string(vertices_ - 1));
    }
    if (auto error = builder_.add_corner(*vertex)) return fail(*error);
  }
  builder_.end_face();
  std::optional<Rgb> value;
  if (!color(text_.left(), value)) return false;
  text_.skip_line();
  std::vector<std::optional<Rgb>>& colors = builder_.mesh.face_colors;
  if (value || !colors.empty()) {
    colors.resize(builder_.mesh.face_count() - 1);
    colors.push_back(value);
  }
  return true;
}

bool OffReader::finish() {
  std::string_view token;
  if (!text_.next(token)) return true;
  error_ = text_.error(ErrorCode::kSyntax,
                       "the file goes on after its last "
                       "face");
  return false;
}

Result<Mesh> OffReader::read() {
  builder_.mesh.decimal = true;
  std::string_view glued;
  if (!magic(glued) || !counts(glued)) return *error_;
  for (std::int64_t i = 0; i < vertices_; ++i) {
    if (!vertex(i)) return *error_;
  }
  for (std::int64_t i = 0; i < faces_; ++i) {
    if (!face(i)) return *error_;
  }
  if (!finish()) return *error_;
  return std::move(builder_.mesh);
}

}  // namespace

Result<Mesh> read_off(std::string_view bytes, const Stop& stop) {
  if (auto error = not_plain_text(bytes)) return *error;
  return OffReader(bytes, stop).read();
}

}  // namespace halfspace::io
