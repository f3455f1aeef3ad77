#include "halfspace/csg/openscad.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "functions.hpp"
#include "halfspace/csg/hull.hpp"
#include "halfspace/csg/lexer.hpp"
#include "numbers.hpp"
#include "primitives.hpp"

namespace halfspace::csg {
namespace {

using io::Number;

constexpr std::size_t kMostFragments = 10'000;
constexpr std::size_t kMostNodes = std::size_t{1} << 22;

struct ScadToken {
  enum class Kind : std::uint8_t { kWord, kNumber, kText, kSymbol, kEnd } kind;
  std::string_view text;
  Place place;
  bool is(char symbol) const {
    return kind == Kind::kSymbol && text.front() == symbol;
  }
};

/// Takes the text apart; comments are passed over.
class ScadTokens {
 public:
  explicit ScadTokens(std::string_view text) : rest_(text) {}
  ScadToken next();

 private:
  void skip(std::size_t count);
  void pass_over();
  ScadToken taken(ScadToken::Kind kind, std::size_t length);

  std::string_view rest_;
  Place place_;
};

void ScadTokens::skip(std::size_t count) {
  for (const char c : rest_.substr(0, count)) {
    place_ = c == '\n' ? Place{place_.line + 1, 1}
                       : Place{place_.line, place_.column + 1};
  }
  rest_.remove_prefix(count);
}

void ScadTokens::pass_over() {
  while (true) {
    const std::size_t blanks =
        std::min(rest_.find_first_not_of(" \t\r\n"), rest_.size());
    skip(blanks);
    if (rest_.starts_with("//"))
      skip(std::min(rest_.find('\n'), rest_.size()));
    else if (rest_.starts_with("/*"))
      skip(std::min(rest_.find("*/") + 2, rest_.size()));
    else
      return;
  }
}

ScadToken ScadTokens::taken(ScadToken::Kind kind, std::size_t length) {
  const ScadToken token{kind, rest_.substr(0, length), place_};
  skip(length);
  return token;
}

ScadToken ScadTokens::next() {
  pass_over();
  if (rest_.empty()) return {ScadToken::Kind::kEnd, {}, place_};
  const char c = rest_[0];
  constexpr std::string_view kLetters =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_$";
  constexpr std::string_view kInWord =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_$0123456789";
  constexpr std::string_view kInNumber = "0123456789.eE+-";
  if (kLetters.find(c) != kLetters.npos)
    return taken(ScadToken::Kind::kWord,
                 std::min(rest_.find_first_not_of(kInWord), rest_.size()));
  if (kInNumber.substr(0, 11).find(c) != kInNumber.npos || c == '-')
    return taken(ScadToken::Kind::kNumber,
                 std::min(rest_.find_first_not_of(kInNumber, 1), rest_.size()));
  if (c == '"') {
    std::size_t end = 1;
    while (end < rest_.size() && rest_[end] != '"')
      end += rest_[end] == '\\' ? 2u : 1u;
    ScadToken text =
        taken(ScadToken::Kind::kText, std::min(end + 1, rest_.size()));
    text.text =
        text.text.substr(1, text.text.size() < 2 ? 0 : text.text.size() - 2);
    return text;
  }
  return taken(ScadToken::Kind::kSymbol, 1);
}

/// The value of an argument: a number, a word, or lists of numbers, at most a
/// list of lists.
struct Argument {
  std::string_view name;
  std::string_view word;  ///< of true, false, undef and texts
  bool is_text = false;
  std::vector<std::vector<Number>> rows;  ///< a number: one row of one
  bool is_list = false;
};

/// A call that is open, and the solids of its children.
struct Call {
  std::string_view name;
  Place place;
  std::vector<Argument> arguments;
  std::vector<std::int32_t> children;
  bool is_hidden = false;  ///< marked as background
};

/// The height of what is extruded.
struct Extrusion {
  Number bottom, top;
};

class Reader {
 public:
  explicit Reader(std::string_view text) : tokens_(text) {}
  Result<Script> read();

 private:
  bool fail(const Place& place, ErrorCode code, const std::string& sentence) {
    error_ = error_at(place, code, sentence);
    return false;
  }
  bool wrong(const Call& call, const std::string& wanted) {
    return fail(call.place, ErrorCode::kSyntax,
                std::string(call.name) + " needs " + wanted);
  }
  bool unexpected(const std::string& wanted);
  void advance() { token_ = tokens_.next(); }
  bool open();
  bool arguments(Call& call);
  bool value(Argument& argument);
  bool number(Number& value);
  bool close();
  bool shape(const Call& call, std::int32_t& node);
  bool begin_extrusion(const Call& call);
  bool transform(const Call& call, std::int32_t& node);
  bool hull(const Call& call, std::int32_t& node);
  bool corners_of(const Call& call, std::vector<Numbers3>& corners);
  bool cube(const Call& call, std::int32_t& node);
  bool sphere(const Call& call, std::int32_t& node);
  bool cylinder(const Call& call, std::int32_t& node);
  bool polyhedron(const Call& call, std::int32_t& node);
  bool file(const Call& call, std::int32_t& node);
  bool square(const Call& call, std::int32_t& node);
  bool circle(const Call& call, std::int32_t& node);
  bool polygon(const Call& call, std::int32_t& node);
  bool prism(const Call& call, const std::vector<std::array<Number, 2>>& points,
             std::int32_t& node);
  std::int32_t add(Node node);
  std::int32_t add_mesh(const Call& call, io::Mesh mesh);
  std::int32_t joined(NodeKind kind, const Call& call,
                      const std::vector<std::int32_t>& nodes);
  std::optional<Number> number_of(const Call& call, std::string_view name);
  const Argument* argument(const Call& call, std::string_view name);
  bool is_true(const Call& call, std::string_view name);
  std::optional<std::size_t> fragments(const Call& call, const Number& radius);

  ScadTokens tokens_;
  ScadToken token_{ScadToken::Kind::kEnd, {}, {}};
  Script script_;
  std::vector<Call> calls_;
  std::vector<Extrusion> extrusions_;
  std::optional<Error> error_;
};

bool Reader::unexpected(const std::string& wanted) {
  const std::string found =
      token_.kind == ScadToken::Kind::kEnd ? "the end" : in_quotes(token_.text);
  return fail(token_.place, ErrorCode::kSyntax,
              "expected " + wanted + ", not " + found);
}

bool Reader::number(Number& value) {
  Result<Number> read = io::parse_number(token_.text);
  if (token_.kind != ScadToken::Kind::kNumber || !read)
    return unexpected("a number");
  if (!is_handy(*read)) {
    return fail(token_.place, ErrorCode::kOutOfRange,
                in_quotes(token_.text) + " has too many digits");
  }
  value = *std::move(read);
  advance();
  return true;
}

bool Reader::value(Argument& argument) {
  if (token_.kind == ScadToken::Kind::kWord ||
      token_.kind == ScadToken::Kind::kText) {
    argument.is_text = token_.kind == ScadToken::Kind::kText;
    argument.word = token_.text;
    advance();
    return true;
  }
  if (!token_.is('[')) {
    argument.rows.resize(1);
    return number(argument.rows[0].emplace_back());
  }
  argument.is_list = true;
  std::size_t depth = 0;
  do {
    if (token_.is('[')) {
      if (++depth > 2) return unexpected("a number");
      argument.rows.emplace_back();
    } else if (token_.is(']')) {
      --depth;
    } else if (!token_.is(',')) {
      // Numbers after an inner list begin no row of their own.
      if (!number(argument.rows.back().emplace_back())) return false;
      continue;
    }
    advance();
  } while (depth > 0);
  // The first row is the outer list's own: empty where there are inner ones.
  if (argument.rows.size() > 1 && argument.rows.front().empty())
    argument.rows.erase(argument.rows.begin());
  return true;
}

bool Reader::arguments(Call& call) {
  if (!token_.is('(')) return unexpected("'('");
  advance();
  while (!token_.is(')')) {
    Argument& argument = call.arguments.emplace_back();
    if (token_.kind == ScadToken::Kind::kWord) {
      const ScadToken word = token_;
      advance();
      if (token_.is('=')) {
        argument.name = word.text;
        advance();
        if (!value(argument)) return false;
      } else {
        argument.word = word.text;
      }
    } else if (!value(argument)) {
      return false;
    }
    if (token_.is(',')) {
      advance();
    } else if (!token_.is(')')) {
      return unexpected("',' or ')'");
    }
  }
  advance();
  return true;
}

/// A call up to its `{` or `;`.
bool Reader::open() {
  Call call;
  while (token_.is('%') || token_.is('#') || token_.is('!') || token_.is('*')) {
    call.is_hidden = call.is_hidden || token_.is('%') || token_.is('*');
    advance();
  }
  if (token_.kind != ScadToken::Kind::kWord) return unexpected("a shape");
  call.name = token_.text;
  call.place = token_.place;
  advance();
  if (!arguments(call)) return false;
  if (call.name == "linear_extrude" && !begin_extrusion(call)) return false;
  calls_.push_back(std::move(call));
  if (token_.is('{')) {
    advance();
    return true;
  }
  if (!token_.is(';')) return unexpected("'{' or ';'");
  advance();
  return close();
}

const Argument* Reader::argument(const Call& call, std::string_view name) {
  for (const Argument& at : call.arguments) {
    if (at.name == name) return &at;
  }
  return nullptr;
}

std::optional<Number> Reader::number_of(const Call& call,
                                        std::string_view name) {
  const Argument* const at = argument(call, name);
  if (at == nullptr || at->is_list || at->rows.size() != 1) return std::nullopt;
  return at->rows[0][0];
}

bool Reader::is_true(const Call& call, std::string_view name) {
  const Argument* const at = argument(call, name);
  return at != nullptr && at->word == "true";
}

/// How many corners OpenSCAD gives a circle of this radius.
std::optional<std::size_t> Reader::fragments(const Call& call,
                                             const Number& radius) {
  const auto special = [&](std::string_view name, double usual) {
    const auto number = number_of(call, name);
    return number ? io::to_double(*number) : usual;
  };
  const double r = io::to_double(radius);
  const double fixed = special("$fn", 0);
  double count = 0;
  if (r < 1.0 / 1048576)
    count = 3;
  else if (fixed > 0)
    count = std::max(fixed, 3.0);
  else
    count = std::ceil(
        std::max(std::min(360 / special("$fa", 12),
                          r * 2 * std::numbers::pi / special("$fs", 2)),
                 5.0));
  if (!(count >= 3 && count <= static_cast<double>(kMostFragments)))
    return std::nullopt;
  return static_cast<std::size_t>(count);
}

std::int32_t Reader::add(Node node) {
  script_.nodes.push_back(node);
  return static_cast<std::int32_t>(script_.nodes.size()) - 1;
}

std::int32_t Reader::add_mesh(const Call& call, io::Mesh mesh) {
  File file;
  file.name = std::string(call.name) + " at " + to_string(call.place);
  file.mesh = std::make_shared<const io::Mesh>(std::move(mesh));
  Node node{.place = call.place};
  node.item = static_cast<std::int32_t>(script_.files.size());
  script_.files.push_back(std::move(file));
  return add(node);
}

/// The nodes combined from left to right; -1 for none.
std::int32_t Reader::joined(NodeKind kind, const Call& call,
                            const std::vector<std::int32_t>& nodes) {
  std::int32_t result = -1;
  for (const std::int32_t node : nodes) {
    if (result < 0) {
      result = node;
      continue;
    }
    Node made{.kind = kind, .place = call.place};
    made.left = result;
    made.right = node;
    result = add(made);
  }
  return result;
}

bool Reader::begin_extrusion(const Call& call) {
  const auto height = number_of(call, "height");
  if (!height || height->mantissa <= 0) return wrong(call, "a height above 0");
  const auto twist = number_of(call, "twist");
  const Argument* const scale = argument(call, "scale");
  bool is_scaled = false;
  if (scale != nullptr) {
    for (const auto& row : scale->rows) {
      for (const Number& number : row)
        is_scaled = is_scaled || number != Number{1, 0, 0};
    }
  }
  if ((twist && twist->mantissa != 0) || is_scaled) {
    return fail(call.place, ErrorCode::kUnknownFormat,
                "linear_extrude with twist or scale is not read");
  }
  const Number half = product(*height, Number{1, -1, 0});
  extrusions_.push_back(is_true(call, "center")
                            ? Extrusion{negative(half), half}
                            : Extrusion{Number{}, *height});
  return true;
}

bool Reader::cube(const Call& call, std::int32_t& node) {
  const Argument* const size = argument(call, "size");
  if (size == nullptr || size->rows.size() != 1 ||
      (size->rows[0].size() != 3 && size->is_list))
    return wrong(call, "a size of 3 numbers");
  std::array<Number, 3> most, least;
  for (std::size_t i = 0; i < 3; ++i) {
    most[i] = size->rows[0][size->is_list ? i : 0];
    if (most[i].mantissa <= 0) return true;  // OpenSCAD makes nothing of it
    if (!is_true(call, "center")) continue;
    most[i] = product(most[i], Number{1, -1, 0});
    least[i] = negative(most[i]);
  }
  node = add_mesh(call, box_mesh(least, most));
  return true;
}

bool Reader::sphere(const Call& call, std::int32_t& node) {
  const auto radius = number_of(call, "r");
  if (!radius) return wrong(call, "a radius");
  if (radius->mantissa <= 0) return true;
  const auto count = fragments(call, *radius);
  if (!count) return wrong(call, "3 to 10000 fragments");
  node = add_mesh(
      call, ringed_ball_mesh(*radius, static_cast<std::uint32_t>(*count)));
  return true;
}

bool Reader::cylinder(const Call& call, std::int32_t& node) {
  const auto height = number_of(call, "h");
  const auto low = number_of(call, "r1");
  const auto high = number_of(call, "r2");
  if (!height || !low || !high) return wrong(call, "h, r1 and r2");
  if (height->mantissa <= 0 || low->mantissa < 0 || high->mantissa < 0 ||
      (low->mantissa == 0 && high->mantissa == 0))
    return true;
  const auto count = fragments(call, is_less(*low, *high) ? *high : *low);
  if (!count) return wrong(call, "3 to 10000 fragments");
  const Number half = product(*height, Number{1, -1, 0});
  const bool is_centred = is_true(call, "center");
  node = add_mesh(
      call, frustum_mesh(*low, *high, is_centred ? negative(half) : Number{},
                         is_centred ? half : *height,
                         static_cast<std::uint32_t>(*count)));
  return true;
}

bool Reader::polyhedron(const Call& call, std::int32_t& node) {
  const Argument* const points = argument(call, "points");
  const Argument* faces = argument(call, "faces");
  if (faces == nullptr) faces = argument(call, "triangles");
  if (points == nullptr || faces == nullptr)
    return wrong(call, "points and faces");
  io::Mesh mesh;
  mesh.decimal = true;
  for (const auto& row : points->rows) {
    if (row.size() != 3) return wrong(call, "points of 3 numbers");
    mesh.vertices.push_back({row[0], row[1], row[2]});
  }
  for (const auto& row : faces->rows) {
    // They run clockwise as seen from outside.
    for (auto at = row.rbegin(); at != row.rend(); ++at) {
      const double index = io::to_double(*at);
      if (!(index >= 0 && index < static_cast<double>(mesh.vertices.size())) ||
          std::floor(index) != index)
        return wrong(call, "faces of indices of points");
      mesh.corners.push_back(static_cast<VertexId>(index));
    }
    mesh.first_corner.push_back(
        static_cast<std::uint32_t>(mesh.corners.size()));
  }
  node = add_mesh(call, std::move(mesh));
  return true;
}

bool Reader::file(const Call& call, std::int32_t& node) {
  const Argument* const name = argument(call, "file");
  if (name == nullptr || !name->is_text || name->word.empty())
    return wrong(call, "a file");
  Node made{.place = call.place};
  made.item = static_cast<std::int32_t>(script_.files.size());
  script_.files.push_back({std::string(name->word), {}, {}, false});
  node = add(made);
  return true;
}

bool Reader::prism(const Call& call,
                   const std::vector<std::array<Number, 2>>& points,
                   std::int32_t& node) {
  if (extrusions_.empty()) {
    return fail(call.place, ErrorCode::kUnknownFormat,
                std::string(call.name) +
                    " outside of linear_extrude is flat, and not read");
  }
  if (points.size() < 3) return true;
  node = add_mesh(call, prism_mesh(points, extrusions_.back().bottom,
                                   extrusions_.back().top));
  return true;
}

bool Reader::square(const Call& call, std::int32_t& node) {
  const Argument* const size = argument(call, "size");
  if (size == nullptr || size->rows.size() != 1 ||
      (size->rows[0].size() != 2 && size->is_list))
    return wrong(call, "a size of 2 numbers");
  std::array<Number, 2> most, least;
  for (std::size_t i = 0; i < 2; ++i) {
    most[i] = size->rows[0][size->is_list ? i : 0];
    if (most[i].mantissa <= 0) return true;
    if (!is_true(call, "center")) continue;
    most[i] = product(most[i], Number{1, -1, 0});
    least[i] = negative(most[i]);
  }
  return prism(call,
               {{least[0], least[1]},
                {most[0], least[1]},
                {most[0], most[1]},
                {least[0], most[1]}},
               node);
}

bool Reader::circle(const Call& call, std::int32_t& node) {
  const auto radius = number_of(call, "r");
  if (!radius) return wrong(call, "a radius");
  if (radius->mantissa <= 0) return true;
  const auto count = fragments(call, *radius);
  if (!count) return wrong(call, "3 to 10000 fragments");
  return prism(call, circle_points(*radius, static_cast<std::uint32_t>(*count)),
               node);
}

bool Reader::polygon(const Call& call, std::int32_t& node) {
  const Argument* const points = argument(call, "points");
  if (points == nullptr) return wrong(call, "points");
  const Argument* const paths = argument(call, "paths");
  std::vector<std::vector<Number>> rows;
  if (paths != nullptr) rows = paths->rows;
  if (rows.empty()) {
    rows.emplace_back();
    for (std::size_t i = 0; i < points->rows.size(); ++i)
      rows.back().push_back(io::number_of(static_cast<double>(i)));
  }
  // A point is inside if an odd number of paths go round it.
  std::vector<std::int32_t> prisms;
  for (const auto& row : rows) {
    std::vector<std::array<Number, 2>> path;
    for (const Number& at : row) {
      const double index = io::to_double(at);
      if (!(index >= 0 && index < static_cast<double>(points->rows.size())) ||
          std::floor(index) != index)
        return wrong(call, "paths of indices of points");
      const auto& point = points->rows[static_cast<std::size_t>(index)];
      if (point.size() != 2) return wrong(call, "points of 2 numbers");
      path.push_back({point[0], point[1]});
    }
    std::int32_t made = -1;
    if (!prism(call, path, made)) return false;
    if (made >= 0) prisms.push_back(made);
  }
  node = joined(NodeKind::kSymmetricDifference, call, prisms);
  return true;
}

bool Reader::transform(const Call& call, std::int32_t& node) {
  if (call.arguments.size() != 1 || call.arguments[0].rows.size() != 4)
    return wrong(call, "a matrix of 4 rows");
  const auto& rows = call.arguments[0].rows;
  Matrix matrix;
  for (std::size_t i = 0; i < 4; ++i) {
    if (rows[i].size() != 4) return wrong(call, "rows of 4 numbers");
    for (std::size_t j = 0; i < 3 && j < 4; ++j) matrix.rows[i][j] = rows[i][j];
  }
  node = joined(NodeKind::kUnion, call, call.children);
  if (node < 0) return true;
  if (determinant_sign(matrix) == 0) {
    return fail(call.place, ErrorCode::kZeroArea,
                "this matrix makes everything flat");
  }
  const auto is_zero = [&](std::size_t i, std::size_t j) {
    return matrix.rows[i][j].mantissa == 0;
  };
  if (!extrusions_.empty() &&
      (!is_zero(0, 2) || !is_zero(1, 2) || !is_zero(2, 0) || !is_zero(2, 1) ||
       !is_zero(2, 3))) {
    return fail(call.place, ErrorCode::kUnknownFormat,
                "a matrix that leaves the plane is not read in linear_extrude");
  }
  if (!extrusions_.empty()) matrix.rows[2][2] = Number{1, 0, 0};
  Node made{.kind = NodeKind::kTransform, .place = call.place};
  made.left = node;
  made.item = static_cast<std::int32_t>(script_.transforms.size());
  script_.transforms.push_back(matrix);
  node = add(made);
  return true;
}

/// The corners of all primitives below a call, moved as they are; false where
/// something else is there that only a boolean knows the corners of.
bool Reader::corners_of(const Call& call, std::vector<Numbers3>& corners) {
  std::vector<std::pair<std::int32_t, Matrix>> waiting;
  for (const std::int32_t child : call.children)
    waiting.emplace_back(child, identity_matrix());
  while (!waiting.empty()) {
    const auto [id, matrix] = std::move(waiting.back());
    waiting.pop_back();
    const Node& node = script_.nodes[static_cast<std::size_t>(id)];
    const auto item = static_cast<std::size_t>(node.item);
    if (node.kind == NodeKind::kFile && script_.files[item].mesh) {
      for (const auto& vertex : script_.files[item].mesh->vertices)
        corners.push_back(image_of(matrix, vertex));
    } else if (node.kind == NodeKind::kTransform) {
      const auto both = product(matrix, script_.transforms[item]);
      if (!both) return false;
      waiting.emplace_back(node.left, *both);
    } else if (node.kind == NodeKind::kUnion) {
      waiting.emplace_back(node.left, matrix);
      waiting.emplace_back(node.right, matrix);
    } else {
      return false;
    }
  }
  return true;
}

bool Reader::hull(const Call& call, std::int32_t& node) {
  std::vector<Numbers3> corners;
  if (!corners_of(call, corners)) {
    return fail(call.place, ErrorCode::kUnknownFormat,
                "hull is read of shapes and unions, not of differences, "
                "intersections and files");
  }
  if (corners.empty()) return true;
  Result<io::Mesh> mesh = hull_of(std::move(corners), true);
  if (!mesh) return fail(call.place, mesh.error().code, mesh.error().message);
  node = add_mesh(call, *std::move(mesh));
  return true;
}

/// The solid of a call whose children are there; -1 for nothing.
bool Reader::shape(const Call& call, std::int32_t& node) {
  using Make = bool (Reader::*)(const Call&, std::int32_t&);
  constexpr std::pair<std::string_view, Make> kShapes[] = {
      {"cube", &Reader::cube},
      {"sphere", &Reader::sphere},
      {"cylinder", &Reader::cylinder},
      {"polyhedron", &Reader::polyhedron},
      {"import", &Reader::file},
      {"square", &Reader::square},
      {"circle", &Reader::circle},
      {"polygon", &Reader::polygon},
      {"multmatrix", &Reader::transform},
      {"hull", &Reader::hull}};
  constexpr std::pair<std::string_view, NodeKind> kSets[] = {
      {"group", NodeKind::kUnion},
      {"union", NodeKind::kUnion},
      {"color", NodeKind::kUnion},
      {"render", NodeKind::kUnion},
      {"linear_extrude", NodeKind::kUnion},
      {"difference", NodeKind::kDifference},
      {"intersection", NodeKind::kIntersection}};
  for (const auto& [name, make] : kShapes) {
    if (call.name == name) return (this->*make)(call, node);
  }
  for (const auto& [name, kind] : kSets) {
    if (call.name != name) continue;
    node = joined(kind, call, call.children);
    return true;
  }
  return fail(call.place, ErrorCode::kUnknownFormat,
              std::string(call.name) + " is not read");
}

/// Closes the innermost call.
bool Reader::close() {
  const Call call = std::move(calls_.back());
  calls_.pop_back();
  std::int32_t node = -1;
  if (!shape(call, node)) return false;
  if (call.name == "linear_extrude") extrusions_.pop_back();
  if (script_.nodes.size() > kMostNodes)
    return fail(call.place, ErrorCode::kOutOfRange, "there are too many parts");
  if (call.is_hidden) return true;
  // An empty first operand leaves nothing of a difference, and any leaves
  // nothing of an intersection.
  Call& parent = calls_.back();
  const bool matters = parent.name == "intersection" ||
                       (parent.name == "difference" && parent.children.empty());
  if (node >= 0) {
    parent.children.push_back(node);
  } else if (matters) {
    // What is nowhere: a box less itself.
    const std::int32_t box = add_mesh(
        call,
        box_mesh({}, {Number{1, 0, 0}, Number{1, 0, 0}, Number{1, 0, 0}}));
    parent.children.push_back(joined(NodeKind::kDifference, call, {box, box}));
  }
  return true;
}

Result<Script> Reader::read() {
  calls_.push_back({"group", {}, {}, {}, false});
  advance();
  while (token_.kind != ScadToken::Kind::kEnd || calls_.size() > 1) {
    if (token_.is('}') && calls_.size() > 1) {
      advance();
      if (!close()) return *error_;
    } else if (token_.is(';')) {
      advance();
    } else if (!open()) {
      return *error_;
    }
  }
  script_.result =
      joined(NodeKind::kUnion, calls_.front(), calls_.front().children);
  if (script_.result < 0)
    return Error{ErrorCode::kEmpty, "there is nothing solid", -1};
  return std::move(script_);
}

}  // namespace

bool is_openscad(std::string_view text) {
  ScadTokens tokens(text);
  ScadToken token = tokens.next();
  while (token.is('%') || token.is('#') || token.is('!') || token.is('*'))
    token = tokens.next();
  if (token.kind != ScadToken::Kind::kWord || !tokens.next().is('('))
    return false;
  token = tokens.next();
  if (token.is(')')) {
    const ScadToken after = tokens.next();
    return after.is('{') || after.is(';');
  }
  if (token.kind == ScadToken::Kind::kWord) return tokens.next().is('=');
  return token.is('[') && tokens.next().is('[');
}

Result<Script> read_openscad(std::string_view text) {
  if (text.size() >= std::size_t{1} << 31) {
    return Error{ErrorCode::kOutOfRange,
                 "a script must have fewer than 2^31 bytes", -1};
  }
  return Reader(text).read();
}

}  // namespace halfspace::csg
