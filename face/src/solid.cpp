#include "halfspace/solid.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "halfspace/csg/part_names.hpp"
#include "halfspace/csg/script.hpp"
#include "halfspace/io/load_scene.hpp"
#include "import.hpp"
#include "node.hpp"
#include "number.hpp"

namespace halfspace {
namespace {

using csg::Matrix;
using csg::NodeKind;
using detail::SolidNode;
using NodePointer = std::shared_ptr<const SolidNode>;

Solid combined(NodeKind kind, const Solid& a, const Solid& b) {
  auto node = std::make_shared<SolidNode>();
  node->kind = kind;
  node->left = SolidNode::shared(a);
  node->right = SolidNode::shared(b);
  return SolidNode::solid_of(std::move(node));
}

Solid moved(const Solid& solid, Matrix matrix) {
  auto node = std::make_shared<SolidNode>();
  node->kind = NodeKind::kTransform;
  node->left = SolidNode::shared(solid);
  if (csg::determinant_sign(matrix) == 0) {
    node->error = Error{ErrorCode::kZeroArea,
                        solid.name() + ": a transform makes it flat"};
  }
  node->matrix = std::move(matrix);
  return SolidNode::solid_of(std::move(node));
}

Solid not_finite(const Solid& solid) {
  return detail::faulty_solid(solid.name(), ErrorCode::kNotFinite,
                              "a number of a transform is not finite");
}

bool is_zero(const Point& p) { return p == Point{}; }

/// The point where the plane meets an axis: one where that is exact, if any.
csg::Numbers3 point_on(const std::array<double, 3>& n, double offset,
                       std::size_t longest) {
  const io::Number wanted = detail::number_of(offset);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t axis = (longest + i) % 3;
    if (n[axis] == 0) continue;
    const io::Number at = detail::number_of(offset / n[axis]);
    if (csg::product(at, detail::number_of(n[axis])) != wanted) continue;
    csg::Numbers3 point;
    point[axis] = at;
    return point;
  }
  csg::Numbers3 point;
  point[longest] = detail::number_of(offset / n[longest]);
  return point;
}

/// Three points of a plane, seen counterclockwise from its positive side.
csg::HalfSpace points_of(const Plane& plane) {
  const std::array<double, 3> n = {plane.normal.x, plane.normal.y,
                                   plane.normal.z};
  const auto axis = static_cast<std::size_t>(
      std::max_element(
          n.begin(), n.end(),
          [](double a, double b) { return std::abs(a) < std::abs(b); }) -
      n.begin());
  const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
  const io::Number one{1, 0, 0};
  // Along u and v by the normal's largest component, the plane rises by the
  // other ones: no division.
  csg::HalfSpace points;
  points[0] = point_on(n, plane.offset, axis);
  points[1] = points[2] = points[0];
  const io::Number most = detail::number_of(std::abs(n[axis]));
  const double sign = n[axis] > 0 ? 1 : -1;
  const auto rise = [&](csg::Numbers3& point, std::size_t along) {
    if (n[along] == 0) {
      point[along] = csg::sum(point[along], one);
      return;
    }
    point[along] = csg::sum(point[along], most);
    point[axis] = csg::sum(point[axis], detail::number_of(-sign * n[along]));
  };
  rise(points[1], u);
  rise(points[2], v);
  if (sign < 0) std::swap(points[1], points[2]);
  return points;
}

/// The leaf of a primitive of a script, or of a file that it turns round.
Solid leaf_of(const csg::File& file, const std::filesystem::path& path) {
  auto node = std::make_shared<SolidNode>();
  node->name = file.mesh ? file.name : path.string();
  node->leaf = std::make_shared<const detail::Leaf>(
      [file, path]() -> Result<detail::LeafData> {
        // Numbers of a script are meant as they are: not free.
        if (file.mesh) {
          auto made = detail::imported_leaf(file.name, *file.mesh, nullptr, {});
          if (made) {
            // Where it stands in the script is not what it is.
            made->part = csg::primitive_name(
                file.name.substr(0, file.name.find(" at ")), *file.mesh);
          }
          return made;
        }
        Result<csg::Source> source =
            csg::read_source(path.string(), {}, file.is_flipped);
        if (!source) return source.error();
        detail::LeafData data;
        data.source = std::make_shared<const csg::Source>(*std::move(source));
        return data;
      });
  return SolidNode::solid_of(std::move(node));
}

/// The expression of a script.
Solid solid_of(const csg::Script& script, const std::string& folder) {
  std::vector<Solid> solids;
  for (const csg::Node& from : script.nodes) {
    const auto item = static_cast<std::size_t>(from.item);
    if (from.kind == NodeKind::kFile) {
      const csg::File& file = script.files[item];
      std::filesystem::path path = file.path;
      if (!folder.empty()) path = std::filesystem::path(folder) / path;
      const bool is_plain = !file.mesh && !file.is_flipped;
      solids.push_back(is_plain ? Solid::from_file(path) : leaf_of(file, path));
      continue;
    }
    auto node = std::make_shared<SolidNode>();
    node->kind = from.kind;
    const auto solid = [&](std::int32_t id) {
      return SolidNode::shared(solids[static_cast<std::size_t>(id)]);
    };
    if (from.left >= 0) node->left = solid(from.left);
    if (from.right >= 0) node->right = solid(from.right);
    if (from.kind == NodeKind::kHalf) node->half = script.halves[item];
    if (from.kind == NodeKind::kTransform)
      node->matrix = script.transforms[item];
    solids.push_back(SolidNode::solid_of(std::move(node)));
  }
  return solids[static_cast<std::size_t>(script.result)];
}

}  // namespace

Solid Solid::from_text(std::string_view script, std::string folder) {
  const Result<csg::Script> parsed = csg::parse_script(script);
  if (parsed) return solid_of(*parsed, folder);
  auto node = std::make_shared<SolidNode>();
  node->name = "script";
  node->error = parsed.error();
  return Solid(std::move(node));
}

Solid Solid::half_space(const Plane& plane) {
  if (!detail::is_finite(plane.normal) || !std::isfinite(plane.offset)) {
    return detail::faulty_solid("half-space", ErrorCode::kNotFinite,
                                "a number of its plane is not finite");
  }
  if (is_zero(plane.normal)) {
    return detail::faulty_solid("half-space", ErrorCode::kZeroArea,
                                "its plane has no normal");
  }
  auto node = std::make_shared<SolidNode>();
  node->kind = NodeKind::kHalf;
  node->half = points_of(plane);
  node->name = "half-space";
  return Solid(std::move(node));
}

Solid Solid::translated(Point by) const {
  if (!detail::is_finite(by)) return not_finite(*this);
  return moved(*this, csg::translation(detail::numbers_of(by)));
}

Solid Solid::scaled(double factor) const {
  return scaled(Point{factor, factor, factor});
}

Solid Solid::scaled(Point factors) const {
  if (!detail::is_finite(factors)) return not_finite(*this);
  return moved(*this, csg::scaling(detail::numbers_of(factors)));
}

Solid Solid::rotated(Point axis, double degrees) const {
  if (!detail::is_finite(axis) || !std::isfinite(degrees))
    return not_finite(*this);
  if (is_zero(axis)) {
    return detail::faulty_solid(name(), ErrorCode::kZeroArea,
                                "the axis of a turn has no direction");
  }
  return moved(*this, csg::rotation(detail::numbers_of(axis),
                                    detail::number_of(degrees)));
}

Solid Solid::mirrored(const Plane& plane) const {
  const std::array<double, 3> n = {plane.normal.x, plane.normal.y,
                                   plane.normal.z};
  if (!detail::is_finite(plane.normal) || !std::isfinite(plane.offset))
    return not_finite(*this);
  const auto used =
      std::count_if(n.begin(), n.end(), [](double c) { return c != 0; });
  if (used == 0) {
    return detail::faulty_solid(name(), ErrorCode::kZeroArea,
                                "the plane of a mirror has no normal");
  }
  Matrix matrix = csg::identity_matrix();
  if (used == 1) {
    const auto axis = static_cast<std::size_t>(
        std::find_if(n.begin(), n.end(), [](double c) { return c != 0; }) -
        n.begin());
    matrix.rows[axis][axis] = io::number_of(-1);
    matrix.rows[axis][3] = csg::product(
        io::number_of(2), detail::number_of(plane.offset / n[axis]));
    return moved(*this, std::move(matrix));
  }
  const double length2 = n[0] * n[0] + n[1] * n[1] + n[2] * n[2];
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const double less = 2 * n[i] * n[j] / length2;
      matrix.rows[i][j] = io::number_of((i == j ? 1 : 0) - less);
    }
    matrix.rows[i][3] = io::number_of(2 * n[i] * plane.offset / length2);
  }
  return moved(*this, std::move(matrix));
}

Solid Solid::transformed(const AffineMap& map) const {
  Matrix matrix;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      if (!std::isfinite(map[i][j])) return not_finite(*this);
      matrix.rows[i][j] = detail::number_of(map[i][j]);
    }
  }
  return moved(*this, std::move(matrix));
}

Solid Solid::named(std::string name) const {
  const auto copy_of = [&name](const SolidNode& from) {
    auto node = std::make_shared<SolidNode>();
    node->kind = from.kind;
    node->left = from.left;
    node->right = from.right;
    node->leaf = from.leaf;
    node->half = from.half;
    node->matrix = from.matrix;
    node->point = from.point;
    node->error = from.error;
    node->name = name;
    return node;
  };
  // What is moved names what it moves, too: origins are operands unmoved.
  const auto top = copy_of(*node_);
  for (SolidNode* node = top.get(); node->kind == NodeKind::kTransform;) {
    auto below = copy_of(*node->left);
    SolidNode* const next = below.get();
    node->left = std::move(below);
    node = next;
  }
  return Solid(top);
}

std::string Solid::name() const {
  const SolidNode* node = node_.get();
  while (node->name.empty() && node->kind == NodeKind::kTransform)
    node = node->left.get();
  return node->name.empty() ? "solid" : node->name;
}

Solid operator+(const Solid& a, const Solid& b) {
  return combined(NodeKind::kUnion, a, b);
}

Solid operator-(const Solid& a, const Solid& b) {
  return combined(NodeKind::kDifference, a, b);
}

Solid operator&(const Solid& a, const Solid& b) {
  return combined(NodeKind::kIntersection, a, b);
}

Solid operator^(const Solid& a, const Solid& b) {
  return combined(NodeKind::kSymmetricDifference, a, b);
}

Solid operator~(const Solid& a) {
  auto node = std::make_shared<SolidNode>();
  node->kind = NodeKind::kComplement;
  node->left = SolidNode::shared(a);
  return SolidNode::solid_of(std::move(node));
}

Solid Solid::union_of(std::span<const Solid> solids) {
  if (solids.empty()) return Solid();
  Solid all = solids.front();
  for (const Solid& solid : solids.subspan(1)) all += solid;
  return all;
}

Solid Solid::intersection_of(std::span<const Solid> solids) {
  if (solids.empty()) return Solid();
  Solid all = solids.front();
  for (const Solid& solid : solids.subspan(1)) all &= solid;
  return all;
}

std::pair<Solid, Solid> Solid::split(const Plane& plane) const {
  const Solid half = half_space(plane);
  return {*this & half, *this - half};
}

}  // namespace halfspace
