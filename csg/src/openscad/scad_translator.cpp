#include "scad_translator.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include "../functions.hpp"
#include "../numbers.hpp"
#include "halfspace/csg/hull.hpp"
#include "halfspace/csg/lexer.hpp"
#include "halfspace/csg/primitives.hpp"

namespace halfspace::csg {

using io::Number;

namespace {

constexpr std::size_t kMostFragments = 10'000;
constexpr std::size_t kMostScadNodes = std::size_t{1} << 22;

}  // namespace

bool ScadTranslator::fail(const Place& place, ErrorCode code,
                          const std::string& sentence) {
  error_ = error_at(place, code, sentence);
  return false;
}

bool ScadTranslator::wrong(const ScadCall& call, const std::string& wanted) {
  return fail(call.place, ErrorCode::kSyntax,
              std::string(call.name) + " needs " + wanted);
}

/// How many corners OpenSCAD gives a circle of this radius.
std::optional<std::size_t> ScadTranslator::fragments(
    const ScadCall& call, const Number& radius) const {
  const auto special = [&](std::string_view name, double usual) {
    const auto number = call.number(name);
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

std::int32_t ScadTranslator::add(Node node) {
  script_.nodes.push_back(node);
  return static_cast<std::int32_t>(script_.nodes.size()) - 1;
}

std::int32_t ScadTranslator::add_mesh(const ScadCall& call, io::Mesh mesh) {
  File file;
  file.name = std::string(call.name) + " at " + to_string(call.place);
  file.mesh = std::make_shared<const io::Mesh>(std::move(mesh));
  Node node{.place = call.place};
  node.item = static_cast<std::int32_t>(script_.files.size());
  script_.files.push_back(std::move(file));
  return add(node);
}

/// The nodes combined from left to right; -1 for none.
std::int32_t ScadTranslator::joined(NodeKind kind, const ScadCall& call,
                                    const std::vector<std::int32_t>& nodes) {
  if (kind == NodeKind::kSymmetricDifference) return paired(call, nodes);
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

/// The symmetric difference, two by two: plans leave their order.
std::int32_t ScadTranslator::paired(const ScadCall& call,
                                    std::vector<std::int32_t> nodes) {
  while (nodes.size() > 1) {
    std::vector<std::int32_t> pairs;
    for (std::size_t i = 0; i + 1 < nodes.size(); i += 2) {
      Node made{.kind = NodeKind::kSymmetricDifference, .place = call.place};
      made.left = nodes[i];
      made.right = nodes[i + 1];
      pairs.push_back(add(made));
    }
    if (nodes.size() % 2 == 1) pairs.push_back(nodes.back());
    nodes = std::move(pairs);
  }
  return nodes.empty() ? -1 : nodes.front();
}

bool ScadTranslator::begin_extrusion(const ScadCall& call) {
  const auto height = call.number("height");
  if (!height || height->mantissa <= 0) return wrong(call, "a height above 0");
  const auto twist = call.number("twist");
  const ScadArgument* const scale = call.argument("scale");
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
  extrusions_.push_back(call.is_true("center") ? Extrusion{negative(half), half}
                                               : Extrusion{Number{}, *height});
  return true;
}

bool ScadTranslator::cube(const ScadCall& call, std::int32_t& node) {
  const ScadArgument* const size = call.argument("size");
  if (size == nullptr || size->rows.size() != 1 ||
      (size->rows[0].size() != 3 && size->is_list))
    return wrong(call, "a size of 3 numbers");
  std::array<Number, 3> most, least;
  for (std::size_t i = 0; i < 3; ++i) {
    most[i] = size->rows[0][size->is_list ? i : 0];
    if (most[i].mantissa <= 0) return true;  // OpenSCAD makes nothing of it
    if (!call.is_true("center")) continue;
    most[i] = product(most[i], Number{1, -1, 0});
    least[i] = negative(most[i]);
  }
  node = add_mesh(call, box_mesh(least, most));
  return true;
}

bool ScadTranslator::sphere(const ScadCall& call, std::int32_t& node) {
  const auto radius = call.number("r");
  if (!radius) return wrong(call, "a radius");
  if (radius->mantissa <= 0) return true;
  const auto count = fragments(call, *radius);
  if (!count) return wrong(call, "3 to 10000 fragments");
  node = add_mesh(
      call, ringed_ball_mesh(*radius, static_cast<std::uint32_t>(*count)));
  return true;
}

bool ScadTranslator::cylinder(const ScadCall& call, std::int32_t& node) {
  const auto height = call.number("h");
  const auto low = call.number("r1");
  const auto high = call.number("r2");
  if (!height || !low || !high) return wrong(call, "h, r1 and r2");
  if (height->mantissa <= 0 || low->mantissa < 0 || high->mantissa < 0 ||
      (low->mantissa == 0 && high->mantissa == 0))
    return true;
  const auto count = fragments(call, is_less(*low, *high) ? *high : *low);
  if (!count) return wrong(call, "3 to 10000 fragments");
  const Number half = product(*height, Number{1, -1, 0});
  const bool is_centred = call.is_true("center");
  node = add_mesh(
      call, frustum_mesh(*low, *high, is_centred ? negative(half) : Number{},
                         is_centred ? half : *height,
                         static_cast<std::uint32_t>(*count)));
  return true;
}

bool ScadTranslator::polyhedron(const ScadCall& call, std::int32_t& node) {
  const ScadArgument* const points = call.argument("points");
  const ScadArgument* faces = call.argument("faces");
  if (faces == nullptr) faces = call.argument("triangles");
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

bool ScadTranslator::file(const ScadCall& call, std::int32_t& node) {
  const ScadArgument* const name = call.argument("file");
  if (name == nullptr || !name->is_text || name->word.empty())
    return wrong(call, "a file");
  Node made{.place = call.place};
  made.item = static_cast<std::int32_t>(script_.files.size());
  script_.files.push_back({std::string(name->word), {}, {}, false});
  node = add(made);
  return true;
}

bool ScadTranslator::prism(const ScadCall& call,
                           const std::vector<std::array<Number, 2>>& points,
                           std::int32_t& node) {
  if (extrusions_.empty()) {
    // What makes a solid of it in another way is the better word.
    for (const ScadCall& open : calls_) {
      if (open.name == "rotate_extrude") {
        return fail(open.place, ErrorCode::kUnknownFormat,
                    "rotate_extrude is not read");
      }
    }
    return fail(call.place, ErrorCode::kUnknownFormat,
                std::string(call.name) +
                    " outside of linear_extrude is flat, and not read");
  }
  if (points.size() < 3) return true;
  node = add_mesh(call, prism_mesh(points, extrusions_.back().bottom,
                                   extrusions_.back().top));
  return true;
}

bool ScadTranslator::square(const ScadCall& call, std::int32_t& node) {
  const ScadArgument* const size = call.argument("size");
  if (size == nullptr || size->rows.size() != 1 ||
      (size->rows[0].size() != 2 && size->is_list))
    return wrong(call, "a size of 2 numbers");
  std::array<Number, 2> most, least;
  for (std::size_t i = 0; i < 2; ++i) {
    most[i] = size->rows[0][size->is_list ? i : 0];
    if (most[i].mantissa <= 0) return true;
    if (!call.is_true("center")) continue;
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

bool ScadTranslator::circle(const ScadCall& call, std::int32_t& node) {
  const auto radius = call.number("r");
  if (!radius) return wrong(call, "a radius");
  if (radius->mantissa <= 0) return true;
  const auto count = fragments(call, *radius);
  if (!count) return wrong(call, "3 to 10000 fragments");
  return prism(call, circle_points(*radius, static_cast<std::uint32_t>(*count)),
               node);
}

bool ScadTranslator::polygon(const ScadCall& call, std::int32_t& node) {
  const ScadArgument* const points = call.argument("points");
  if (points == nullptr) return wrong(call, "points");
  const ScadArgument* const paths = call.argument("paths");
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

bool ScadTranslator::transform(const ScadCall& call, std::int32_t& node) {
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
bool ScadTranslator::corners_of(const ScadCall& call,
                                std::vector<Numbers3>& corners) {
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

bool ScadTranslator::hull(const ScadCall& call, std::int32_t& node) {
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
bool ScadTranslator::shape(const ScadCall& call, std::int32_t& node) {
  using Make = bool (ScadTranslator::*)(const ScadCall&, std::int32_t&);
  constexpr std::pair<std::string_view, Make> kShapes[] = {
      {"cube", &ScadTranslator::cube},
      {"sphere", &ScadTranslator::sphere},
      {"cylinder", &ScadTranslator::cylinder},
      {"polyhedron", &ScadTranslator::polyhedron},
      {"import", &ScadTranslator::file},
      {"square", &ScadTranslator::square},
      {"circle", &ScadTranslator::circle},
      {"polygon", &ScadTranslator::polygon},
      {"multmatrix", &ScadTranslator::transform},
      {"hull", &ScadTranslator::hull}};
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

/// Gives the solid of a call, which is open no more, to its parent.
bool ScadTranslator::finish(const ScadCall& call) {
  std::int32_t node = -1;
  if (!shape(call, node)) return false;
  if (call.name == "linear_extrude") extrusions_.pop_back();
  if (script_.nodes.size() > kMostScadNodes)
    return fail(call.place, ErrorCode::kOutOfRange, "there are too many parts");
  if (call.is_hidden) return true;
  // An empty first operand leaves nothing of a difference, and any leaves
  // nothing of an intersection.
  ScadCall& parent = calls_.back();
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

std::optional<Error> ScadTranslator::open(ScadCall call) {
  if (call.name == "linear_extrude" && !begin_extrusion(call)) return error_;
  calls_.push_back(std::move(call));
  return std::nullopt;
}

std::optional<Error> ScadTranslator::close() {
  const ScadCall call = std::move(calls_.back());
  calls_.pop_back();
  return finish(call) ? std::nullopt : error_;
}

Result<Script> ScadTranslator::script() {
  script_.result =
      joined(NodeKind::kUnion, calls_.front(), calls_.front().children);
  if (script_.result < 0)
    return Error{ErrorCode::kEmpty, "there is nothing solid", -1};
  return std::move(script_);
}

}  // namespace halfspace::csg
