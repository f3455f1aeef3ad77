#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "halfspace/halfspace.hpp"

namespace halfspace {
namespace {

using Vector = std::array<double, 3>;

class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::uint64_t below(std::uint64_t bound) {
    state_ = state_ * 6364136223846793005u + 1442695040888963407u;
    return (state_ >> 33) % bound;
  }
  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(below(1 << 30)) / (1 << 30);
  }

 private:
  std::uint64_t state_;
};

double dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Vector less(const Point& a, const Point& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}

/// A convex operand by the planes of its own mesh, in doubles.
class Convex {
 public:
  explicit Convex(const Mesh& mesh) {
    for (std::size_t p = 0; p < mesh.polygon_count(); ++p) {
      const auto corners = mesh.corners_of(p);
      const auto at = [&](std::size_t i) {
        return mesh.vertices[static_cast<std::size_t>(corners[i])];
      };
      Vector normal{};
      for (std::size_t i = 2; i < corners.size(); ++i) {
        const Vector u = less(at(i - 1), at(0)), v = less(at(i), at(0));
        for (std::size_t k = 0; k < 3; ++k) {
          const std::size_t m = (k + 1) % 3, n = (k + 2) % 3;
          normal[k] += u[m] * v[n] - u[n] * v[m];
        }
      }
      const double length = std::sqrt(dot(normal, normal));
      for (double& c : normal) c /= length;
      planes_.push_back({normal, dot(normal, less(at(0), Point{}))});
    }
  }
  /// Nothing where it is too close to decide.
  std::optional<bool> holds(const Point& p) const {
    double most = -1e300;
    for (const auto& [normal, offset] : planes_)
      most = std::max(most, dot(normal, less(p, Point{})) - offset);
    if (std::abs(most) < 1e-7) return std::nullopt;
    return most < 0;
  }

 private:
  struct Bound {
    Vector normal;
    double offset;
  };
  std::vector<Bound> planes_;
};

/// An expression, and how to know what it holds.
struct Tree {
  Solid solid;
  std::vector<Convex> leaves;  ///< of its own and below, in order
  std::vector<int> code;       ///< postfix: a leaf's number, or -1 - operator
};

/// How many expressions: HALFSPACE_EXPRESSIONS says it for campaigns.
int rounds(int usually) {
  const char* wanted = std::getenv("HALFSPACE_EXPRESSIONS");
  return wanted != nullptr ? std::atoi(wanted) : usually;
}

/// Files in units of their own: millimetres, a binary fraction, and decimals
/// of seven places; written once.
const std::vector<Solid>& files() {
  static const std::vector<Solid> read = [] {
    const std::vector<Solid> solids = {
        Solid::box({0, 0, 0}, {0.75, 1.125, 0.5}),
        Solid::hull({{0, 0, 0},
                     {1.03125, 0, 0},
                     {0, 0.96875, 0},
                     {0.09375, 0.3125, 1}}),
        Solid::cone(0.9, 0.3, 1.1234567, 5).translated({0.1, 0, -0.3})};
    std::vector<Solid> result;
    int number = 0;
    for (const char* end : {".off", ".obj", ".ply"}) {
      const std::string path = "expression" + std::to_string(number) + end;
      EXPECT_TRUE(solids[static_cast<std::size_t>(number++)].save(path));
      result.push_back(Solid::from_file(path, {.may_round = true}));
    }
    return result;
  }();
  return read;
}

Solid random_primitive(Random& random) {
  switch (random.below(9)) {
    case 6:
    case 7:
    case 8:
      return files()[random.below(files().size())];
    case 0:
      return Solid::box({-0.5, -0.5, -0.5}, {0.7, 0.3, 1.1});
    case 1:
      return Solid::box({-0.375, -1, -0.5}, {0.75, 1.125, 0.25});
    case 2:
      return Solid::sphere(1, 8);
    case 3:
      return Solid::cylinder(0.8, 1.5, 7);
    case 4:
      return Solid::cone(1, 0.25, 1.25, 6);
    default:
      return Solid::hull({{0, 0, 0},
                          {1.1, 0, 0},
                          {0, 1.2, 0},
                          {0.1, 0.3, 1},
                          {-0.7, 0.2, 0.4}});
  }
}

Solid random_move(const Solid& solid, Random& random) {
  switch (random.below(5)) {
    case 0:
      return solid.rotated({0, 0, 1}, 90).translated({0.25, -0.1, 0});
    case 1:
      return solid.mirrored({{0, 1, 0}, 0.2});
    case 2:
      return solid.rotated({1, 2, -1}, random.between(0, 360));
    case 3:
      return solid.scaled({1.25, 0.8, 1.1}).translated({0, 0, 0.3});
    default:
      return solid.translated({random.between(-1, 1), 0.125, 0.0625});
  }
}

Tree random_tree(Random& random) {
  Tree tree;
  const std::uint64_t count = 2 + random.below(4);
  for (std::uint64_t i = 0; i < count; ++i) {
    Solid leaf = random_primitive(random);
    for (std::uint64_t k = random.below(3); k > 0; --k)
      leaf = random_move(leaf, random);
    tree.leaves.emplace_back(*leaf.mesh());
    tree.code.push_back(static_cast<int>(i));
    if (i == 0) {
      tree.solid = leaf;
      continue;
    }
    const auto operation = static_cast<int>(random.below(4));
    tree.code.push_back(-1 - operation);
    const Solid& a = tree.solid;
    tree.solid = operation == 0   ? a + leaf
                 : operation == 1 ? a - leaf
                 : operation == 2 ? (a ^ leaf)
                                  : (a & leaf);
  }
  // The whole, moved once more: transforms go down to the leaves.
  return tree;
}

std::optional<bool> expected(const Tree& tree, const Point& p) {
  std::vector<bool> stack;
  for (const int code : tree.code) {
    if (code >= 0) {
      const auto held = tree.leaves[static_cast<std::size_t>(code)].holds(p);
      if (!held) return std::nullopt;
      stack.push_back(*held);
      continue;
    }
    const bool b = stack.back();
    stack.pop_back();
    const bool a = stack.back();
    stack.back() = code == -1   ? a || b
                   : code == -2 ? a && !b
                   : code == -3 ? a != b
                                : a && b;
  }
  return stack.front();
}

TEST(FaceExpression, RandomExpressionsHoldTheRightPoints) {
  Random random(20);
  int inside = 0, outside = 0;
  for (int round = 0; round < rounds(60); ++round) {
    const Tree tree = random_tree(random);
    const Point by{0.5, -0.25, 3};
    const Solid moved = tree.solid.translated(by);
    ASSERT_TRUE(moved.volume()) << moved.volume().error().message;
    for (int k = 0; k < 30; ++k) {
      const Point p{random.between(-1.5, 1.5), random.between(-1.5, 1.5),
                    random.between(-1.5, 1.5)};
      const auto is_held = expected(tree, p);
      if (!is_held) continue;
      const Point at{p.x + by.x, p.y + by.y, p.z + by.z};
      ASSERT_EQ(*moved.locate(at),
                *is_held ? Location::kInside : Location::kOutside)
          << round << ": " << p.x << " " << p.y << " " << p.z;
      ++(*is_held ? inside : outside);
    }
  }
  EXPECT_GT(inside, 80);
  EXPECT_GT(outside, 400);
}

TEST(FaceExpression, TheOrderOfAskingChangesNothing) {
  Random random(21);
  for (int round = 0; round < rounds(20); ++round) {
    const Tree tree = random_tree(random);
    const Solid other = random_primitive(random);
    // Asked before it is used in another expression, and not.
    const Solid first = tree.solid - other;
    const Mesh before = *first.mesh();
    ASSERT_TRUE(tree.solid.mesh());
    const Mesh after = *(tree.solid - other).mesh();
    ASSERT_EQ(before, after);
    // In two threads, each with an expression of its own.
    Mesh meshes[2];
    std::thread thread([&] { meshes[0] = *(tree.solid - other).mesh(); });
    meshes[1] = *(tree.solid - other).mesh();
    thread.join();
    ASSERT_EQ(meshes[0], before);
    ASSERT_EQ(meshes[1], before);
  }
}

}  // namespace
}  // namespace halfspace
