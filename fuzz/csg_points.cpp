#include "csg_points.hpp"

#include <cmath>
#include <cstdlib>
#include <utility>

#include "halfspace/csg/evaluate.hpp"

namespace halfspace::fuzz {
namespace {

using csg::Matrix;
using csg::NodeKind;
using csg::Numbers3;
using csg::Plan;
using csg::Script;
using io::Number;

/// The point at / w, or, where w is 0, what is far away in a direction.
struct Point {
  Numbers3 at;
  Number w;
};
using Points = std::vector<Point>;

Number integer(std::int64_t value) {
  return io::number_of(static_cast<double>(value));
}

/// The directions are along no face whose plane has small numbers.
Points all_points() {
  Points points;
  for (std::size_t k = 0; k < kNearPoints; ++k) {
    const auto twice = twice_near_point(k);
    points.push_back({{integer(twice[0]), integer(twice[1]), integer(twice[2])},
                      integer(2)});
  }
  for (int k = 0; k < 8; ++k) {
    const auto sign = [k](int bit) { return (k >> bit & 1) != 0 ? 1 : -1; };
    points.push_back(
        {{integer(71 * sign(0)), integer(97 * sign(1)), integer(83 * sign(2))},
         integer(0)});
  }
  return points;
}

/// Whether the numbers are soon multiplied.
template <class Rows>
bool is_short(const Rows& rows) {
  constexpr int kMost = 80;
  for (const auto& row : rows) {
    for (const Number& number : row) {
      if (std::abs(number.two) > kMost || std::abs(number.five) > kMost ||
          !(std::abs(io::to_double(number)) < 1e24))
        return false;
    }
  }
  return true;
}

Number negative(Number number) {
  number.mantissa = -number.mantissa;
  return number;
}

Number difference(const Number& a, const Number& b) {
  return csg::sum(a, negative(b));
}

Number minor_of(const Numbers3& u, const Numbers3& v, std::size_t i) {
  const std::size_t j = (i + 1) % 3;
  const std::size_t k = (i + 2) % 3;
  return difference(csg::product(u[j], v[k]), csg::product(u[k], v[j]));
}

Number determinant(const std::array<Numbers3, 3>& rows) {
  Number value;
  for (std::size_t i = 0; i < 3; ++i) {
    value = csg::sum(value,
                     csg::product(rows[0][i], minor_of(rows[1], rows[2], i)));
  }
  return value;
}

/// Where the points were before the matrix moved them, by Cramer's rule.
Points moved_back(const Matrix& matrix, const Points& points) {
  std::array<Numbers3, 3> columns;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) columns[j][i] = matrix.rows[i][j];
  }
  const Number whole = determinant(columns);
  const bool is_negative = whole.mantissa.sign() < 0;
  Points result;
  for (const Point& p : points) {
    Numbers3 from_origin;
    for (std::size_t i = 0; i < 3; ++i) {
      from_origin[i] =
          difference(p.at[i], csg::product(matrix.rows[i][3], p.w));
    }
    Point q;
    q.w = csg::product(is_negative ? negative(whole) : whole, p.w);
    for (std::size_t j = 0; j < 3; ++j) {
      auto replaced = columns;
      replaced[j] = from_origin;
      q.at[j] = determinant(replaced);
      if (is_negative) q.at[j] = negative(q.at[j]);
    }
    result.push_back(std::move(q));
  }
  return result;
}

bool is_less(const Number& a, const Number& b) {
  return difference(a, b).mantissa.sign() < 0;
}

Mask in_box(const Box& box, const Points& points) {
  Mask mask = 0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Point& p = points[k];
    bool inside = p.w.mantissa.sign() > 0;
    for (std::size_t i = 0; i < 3 && inside; ++i) {
      inside = !is_less(p.at[i], csg::product(integer(box.low[i]), p.w)) &&
               is_less(p.at[i], csg::product(integer(box.high[i]), p.w));
    }
    mask |= Mask{inside} << k;
  }
  return mask;
}

/// On the side from which the three corners are not seen counterclockwise.
Mask in_half(const csg::HalfSpace& half, const Points& points) {
  std::array<Numbers3, 3> rows;
  for (std::size_t i = 0; i < 3; ++i) {
    rows[0][i] = difference(half[1][i], half[0][i]);
    rows[1][i] = difference(half[2][i], half[0][i]);
  }
  Mask mask = 0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Point& p = points[k];
    for (std::size_t i = 0; i < 3; ++i)
      rows[2][i] = difference(p.at[i], csg::product(half[0][i], p.w));
    mask |= Mask{determinant(rows).mantissa.sign() < 0} << k;
  }
  return mask;
}

Mask combined(NodeKind kind, Mask a, Mask b) {
  switch (kind) {
    case NodeKind::kUnion:
      return a | b;
    case NodeKind::kIntersection:
      return a & b;
    case NodeKind::kDifference:
      return a & ~b;
    default:
      return a ^ b;
  }
}

/// The points go down through the transforms to files and half-spaces.
class Reading {
 public:
  explicit Reading(const Script& script) : script_(script) {}

  std::optional<Mask> result() {
    for (const auto& matrix : script_.transforms) {
      if (!is_short(matrix.rows)) return std::nullopt;
    }
    for (const auto& half : script_.halves) {
      if (!is_short(half)) return std::nullopt;
    }
    const Mask mask = of(script_.result, all_points(), 0);
    return is_long_ ? std::nullopt : std::optional(mask);
  }

 private:
  static constexpr int kMostSteps = 200;
  static constexpr int kMostTransforms = 5;

  /// No deeper than there are steps.
  Mask of(std::int32_t id, const Points& points, int transforms) {
    is_long_ =
        is_long_ || ++steps_ > kMostSteps || transforms > kMostTransforms;
    if (is_long_) return 0;
    const csg::Node& node = script_.nodes[static_cast<std::size_t>(id)];
    const auto item = static_cast<std::size_t>(node.item);
    switch (node.kind) {
      case NodeKind::kFile:
        return in_box(box_of(script_.files[item]), points);
      case NodeKind::kHalf:
        return in_half(script_.halves[item], points);
      case NodeKind::kComplement:
        return ~of(node.left, points, transforms);
      case NodeKind::kTransform:
        return of(node.left, moved_back(script_.transforms[item], points),
                  transforms + 1);
      default:
        break;
    }
    const Mask left = of(node.left, points, transforms);
    return combined(node.kind, left, of(node.right, points, transforms));
  }

  const Script& script_;
  int steps_ = 0;
  bool is_long_ = false;
};

/// The solids of a plan, as sets of the points.
struct PointAlgebra {
  using Value = Mask;
  const Script& script;
  const Plan& plan;
  const Points points = all_points();

  Result<Value> leaf(std::int32_t id) const {
    const auto& leaf = plan.leaves[static_cast<std::size_t>(id)];
    return in_box(
        box_of(script.files[static_cast<std::size_t>(leaf.file)]),
        moved_back(plan.matrices[static_cast<std::size_t>(leaf.matrix)],
                   points));
  }
  Result<Value> plane(std::int32_t id) const {
    return in_half(plan.planes[static_cast<std::size_t>(id)].points, points);
  }
  static Value complement(Value value) { return ~value; }
  static Value combine(NodeKind kind, Value a, Value b) {
    return combined(kind, a, b);
  }
};

}  // namespace

std::array<std::int64_t, 3> twice_near_point(std::size_t k) {
  const auto n = static_cast<std::int64_t>(k);
  return {2 * (n % 4) + 1, 2 * (n / 4 % 3) + 1, 2 * (n / 12) + 1};
}

Box box_of(const csg::File& file) {
  constexpr Box kBoxes[] = {{{0, 0, 0}, {2, 2, 2}},
                            {{1, 1, 0}, {3, 3, 1}},
                            {{0, 1, 1}, {4, 2, 3}},
                            {{2, 0, -1}, {3, 4, 1}}};
  return kBoxes[(static_cast<unsigned char>(file.path.front()) - 'a') & 3];
}

std::optional<Mask> mask_of(const Script& script) {
  return Reading(script).result();
}

Mask mask_of(const Script& script, const Plan& plan) {
  PointAlgebra algebra{script, plan};
  csg::Evaluator<PointAlgebra> evaluator(plan, algebra,
                                         [](double) { return true; });
  return **evaluator.result();
}

}  // namespace halfspace::fuzz
