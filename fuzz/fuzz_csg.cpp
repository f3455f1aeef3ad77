#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "csg_points.hpp"
#include "csg_text.hpp"
#include "fuzz.hpp"
#include "generate/shapes.hpp"
#include "halfspace/csg/evaluate.hpp"
#include "halfspace/fast/boolean.hpp"

namespace halfspace {
namespace {

using csg::HalfSpace;
using csg::Matrix;
using csg::NodeKind;
using csg::Plan;
using csg::Script;
using fuzz::Mask;

/// The number, where it is an integer of a few digits.
std::optional<std::int64_t> small_integer(const io::Number& number) {
  const double value = io::to_double(number);
  if (number.two < 0 || number.five < 0 || !(std::abs(value) <= 100))
    return std::nullopt;
  return static_cast<std::int64_t>(value);
}

/// A map that takes boxes with corners on the grid to such boxes.
using GridMap = std::array<std::array<std::int64_t, 4>, 3>;

std::optional<GridMap> grid_map_of(const Matrix& matrix) {
  GridMap map;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      const auto entry = small_integer(matrix.rows[i][j]);
      if (!entry) return std::nullopt;
      map[i][j] = *entry;
    }
    if (std::count(map[i].begin(), map[i].begin() + 3, 0) != 2)
      return std::nullopt;
  }
  return map;
}

/// Three points of a plane across an axis; nothing if it is no such plane.
std::optional<std::array<GridPoint, 3>> grid_plane_of(const HalfSpace& half) {
  std::array<std::array<std::int64_t, 3>, 3> at;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto value = small_integer(half[i][k]);
      if (!value) return std::nullopt;
      at[i][k] = *value;
    }
  }
  bool is_across = false;
  for (std::size_t k = 0; k < 3; ++k) {
    is_across = is_across || (at[0][k] == at[1][k] && at[0][k] == at[2][k]);
  }
  if (!is_across) return std::nullopt;
  const auto point = [&at](std::size_t i) {
    return GridPoint{at[i][0], at[i][1], at[i][2]};
  };
  return std::array{point(0), point(1), point(2)};
}

/// The box, moved.
GridSolid solid_of(const fuzz::Box& box, const GridMap& map) {
  std::array<std::int64_t, 3> low, high;
  for (std::size_t i = 0; i < 3; ++i) {
    low[i] = high[i] = map[i][3];
    for (std::size_t j = 0; j < 3; ++j) {
      low[i] += std::min(map[i][j] * box.low[j], map[i][j] * box.high[j]);
      high[i] += std::max(map[i][j] * box.low[j], map[i][j] * box.high[j]);
    }
  }
  generate::Polygons faces;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t u = (axis + 1) % 3;
    const std::size_t v = (axis + 2) % 3;
    for (const bool up : {false, true}) {
      std::vector<GridPoint> face;
      for (const std::size_t corner : {0u, 1u, 3u, 2u}) {
        auto at = low;
        if (up) at[axis] = high[axis];
        if ((corner & 1) != 0) at[u] = high[u];
        if ((corner & 2) != 0) at[v] = high[v];
        face.push_back({at[0], at[1], at[2]});
      }
      if (!up) std::reverse(face.begin(), face.end());
      faces.push_back(std::move(face));
    }
  }
  auto solid = make_solid(generate::scene_of(faces, {}));
  HALFSPACE_FUZZ_EXPECT(solid.has_value());
  return *solid;
}

/// The plan's solids by the fast library.
struct FastAlgebra {
  using Value = fast::Solid;
  const Script& script;
  const Plan& plan;
  const fast::Solid nothing =
      fast::to_solid(*make_solid(generate::scene_of({}, {})));

  Result<Value> leaf(std::int32_t id) const {
    const auto& leaf = plan.leaves[static_cast<std::size_t>(id)];
    const auto& file = script.files[static_cast<std::size_t>(leaf.file)];
    const Matrix& matrix = plan.matrices[static_cast<std::size_t>(leaf.matrix)];
    return fast::to_solid(solid_of(fuzz::box_of(file), *grid_map_of(matrix)),
                          nothing, id);
  }
  Result<Value> plane(std::int32_t id) const {
    const HalfSpace& half = plan.planes[static_cast<std::size_t>(id)].points;
    return fast::half_space(*grid_plane_of(half), nothing);
  }
  static Value complement(Value value) {
    return fast::complement(std::move(value));
  }
  static Value combine(NodeKind kind, const Value& a, const Value& b) {
    switch (kind) {
      case NodeKind::kIntersection:
        return fast::boolean(BooleanOp::kIntersection, a, b);
      case NodeKind::kDifference:
        return fast::boolean(BooleanOp::kDifference, a, b);
      case NodeKind::kSymmetricDifference:
        return fast::boolean(BooleanOp::kSymmetricDifference, a, b);
      default:
        return fast::boolean(BooleanOp::kUnion, a, b);
    }
  }
};

/// Where a vertex is: all planes are across axes.
std::array<std::int64_t, 3> place_of(const fast::Solid& solid,
                                     std::int32_t id) {
  const fast::SolidVertex vertex = fast::vertex_at(solid, id);
  if (vertex.is_grid) return {vertex.point.x, vertex.point.y, vertex.point.z};
  std::array<std::int64_t, 3> at{};
  for (const std::int32_t id_of_plane : vertex.planes) {
    const fast::SolidPlane plane = fast::plane_at(solid, id_of_plane);
    if (plane.normal[0] != 0) at[0] = plane.origin.x;
    if (plane.normal[1] != 0) at[1] = plane.origin.y;
    if (plane.normal[2] != 0) at[2] = plane.origin.z;
  }
  return at;
}

/// Whether a ray from the point along x meets the face, which lies across it.
bool meets(const fast::Solid& solid, const fast::Face& face,
           const std::array<std::int64_t, 3>& twice) {
  bool inside = false;
  for (std::uint32_t k = 0; k < face.edge_count; ++k) {
    const fast::SolidEdge& edge = solid.edges[face.first_edge + k];
    const auto from = place_of(solid, edge.from);
    const auto to = place_of(solid, edge.to);
    // Edges along z, for the others are in no line with a centre.
    if ((2 * from[2] < twice[2]) == (2 * to[2] < twice[2])) continue;
    inside ^= 2 * from[1] > twice[1];
    if (2 * from[0] < twice[0]) return false;
  }
  return inside;
}

/// The near points in a solid: what faces a ray meets on its way outwards.
Mask near_mask_of(const fast::Solid& solid) {
  Mask mask = 0;
  for (std::size_t k = 0; k < fuzz::kNearPoints; ++k) {
    int winding = solid.unbounded ? 1 : 0;
    for (const fast::Face& face : solid.faces) {
      if (fast::plane_at(solid, face.plane).normal[0] == 0) continue;
      if (!meets(solid, face, fuzz::twice_near_point(k))) continue;
      winding += face.flipped ? -1 : 1;
    }
    HALFSPACE_FUZZ_EXPECT(winding == 0 || winding == 1);
    mask |= static_cast<Mask>(winding) << k;
  }
  return mask;
}

/// Where all that the plan needs is boxes on the grid, the fast library's
/// result has the points that the script says.
void expect_solid(const Script& script, const Plan& plan, Mask mask,
                  const std::string& text) {
  if (plan.steps.size() > 30) return;
  for (const auto& leaf : plan.leaves) {
    if (!grid_map_of(plan.matrices[static_cast<std::size_t>(leaf.matrix)]))
      return;
  }
  for (const auto& plane : plan.planes) {
    if (!grid_plane_of(plane.points)) return;
  }
  FastAlgebra algebra{script, plan};
  csg::Evaluator<FastAlgebra> evaluator(plan, algebra,
                                        [](double) { return true; });
  const fast::Solid solid = **evaluator.result();
  HALFSPACE_FUZZ_EXPECT(fast::bad_edges(solid).empty(), text);
  HALFSPACE_FUZZ_EXPECT(near_mask_of(solid) == (mask & fuzz::kNear), text);
  const fast::Solid least = fast::merge_faces(solid, fast::Merge::kPlane);
  HALFSPACE_FUZZ_EXPECT(near_mask_of(least) == (mask & fuzz::kNear), text);
}

/// The script means the same by its nodes as by its plan.
void expect_plan(const Script& script, const std::string& text) {
  const auto plan = csg::make_plan(script, /*most_steps=*/256);
  if (!plan) {
    HALFSPACE_FUZZ_EXPECT(plan.error().message.starts_with("line "), text);
    return;
  }
  const auto mask = fuzz::mask_of(script);
  if (!mask) return;
  HALFSPACE_FUZZ_EXPECT(fuzz::mask_of(script, *plan) == *mask, text);
  // A result is bounded, whatever its half-spaces are far away.
  HALFSPACE_FUZZ_EXPECT((*mask & ~fuzz::kNear) == 0, text);
  expect_solid(script, *plan, *mask, text);
}

Script parsed(const std::string& text) {
  const auto bindings = fuzz::bindings_of(text);
  auto script = csg::parse_script(text, bindings);
  HALFSPACE_FUZZ_EXPECT(script.has_value(), text + script.error().message);
  return *std::move(script);
}

/// The script reads back from what is written of it, in either way.
void expect_script(const Script& script) {
  const std::string text = fuzz::statements_of(script);
  const Script again = parsed(text);
  HALFSPACE_FUZZ_EXPECT(fuzz::same_nodes(script, again), text);
  const auto expression = fuzz::expression_of(script, /*most=*/1 << 13);
  if (expression) {
    HALFSPACE_FUZZ_EXPECT(fuzz::same_result(script, parsed(*expression)),
                          *expression);
  }
  expect_plan(again, text);
}

/// Takes what the bytes say for nodes, each of those before it.
class Maker {
 public:
  explicit Maker(fuzz::Bytes bytes) : bytes_(bytes) {}

  Script script() {
    add_file();
    while (!bytes_.empty() && script_.nodes.size() < 40) add_node();
    script_.result = last();
    return std::move(script_);
  }

 private:
  std::int32_t last() const {
    return static_cast<std::int32_t>(script_.nodes.size()) - 1;
  }
  io::Number number() { return io::number_of(bytes_.below(9) - 3); }

  void add(NodeKind kind, std::int32_t left, std::int32_t right,
           std::int32_t item) {
    script_.nodes.push_back({kind, left, right, item, {}});
  }

  /// Each file, by path and name, is one node.
  void add_file() {
    const int which = bytes_.below(8);
    const std::string name(1, static_cast<char>('a' + which % 4));
    const csg::File file{name + ".off", which < 4 ? name : ""};
    for (const csg::File& other : script_.files) {
      if (other.path == file.path && other.name == file.name) return;
    }
    add(NodeKind::kFile, -1, -1,
        static_cast<std::int32_t>(script_.files.size()));
    script_.files.push_back(file);
  }

  void add_half() {
    const auto axis = static_cast<std::size_t>(bytes_.below(3));
    const bool less = bytes_.below(2) == 0;
    HalfSpace half;
    const io::Number value = number();
    for (auto& point : half) point[axis] = value;
    // Seen from where it does not reach, they go round counterclockwise.
    half[less ? 1 : 2][(axis + 1) % 3] = io::number_of(1);
    half[less ? 2 : 1][(axis + 2) % 3] = io::number_of(1);
    add(NodeKind::kHalf, -1, -1,
        static_cast<std::int32_t>(script_.halves.size()));
    script_.halves.push_back(half);
  }

  /// A signed permutation of the axes, or now and then a scale, and a move.
  void add_transform(std::int32_t of) {
    const int turn = bytes_.below(64);
    Matrix matrix = csg::scaling({});
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t shift = static_cast<std::size_t>(turn) / 16 % 3;
      matrix.rows[i][(i + shift) % 3] =
          io::number_of((turn >> i & 1) != 0 ? -1 : 1);
      matrix.rows[i][3] = (turn & 8) != 0 ? number() : io::Number{};
    }
    if (turn >= 48) matrix.rows[1][1] = io::number_of((turn - 47) / 2.0);
    add(NodeKind::kTransform, of, -1,
        static_cast<std::int32_t>(script_.transforms.size()));
    script_.transforms.push_back(matrix);
  }

  void add_node() {
    const int what = bytes_.below(16);
    const auto earlier = [this](int back) {
      return std::max(last() - back, std::int32_t{0});
    };
    if (what < 3) return add_file();
    if (what < 5) return add_half();
    if (what < 6) return add(NodeKind::kComplement, last(), -1, -1);
    if (what < 8) return add_transform(earlier(bytes_.below(3)));
    const auto kind = static_cast<NodeKind>(2 + (what - 8) % 4);
    const int operands = bytes_.next();
    add(kind, earlier(operands % 16), earlier(operands / 16), -1);
  }

  fuzz::Bytes bytes_;
  Script script_;
};

}  // namespace
}  // namespace halfspace

/// Bytes that begin with 0 or 1 are nodes of a script, others its text. What it
/// is made of reads back from its nodes one by one and from one expression, and
/// nodes, plan and solids have the same points.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  using namespace halfspace;
  if (size > 0 && data[0] < 2) {
    expect_script(Maker(fuzz::Bytes(data + 1, size - 1)).script());
    return 0;
  }
  const auto text = fuzz::text_of(data, size);
  const auto script = csg::parse_script(text, fuzz::bindings_of(text));
  if (script) {
    // Primitives and flipped files have no text of their own.
    const bool has_text = std::none_of(
        script->files.begin(), script->files.end(),
        [](const csg::File& file) { return file.mesh || file.is_flipped; });
    if (has_text) expect_script(*script);
  } else {
    HALFSPACE_FUZZ_EXPECT(!script.error().message.empty());
  }
  return 0;
}
