#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

#include "halfspace/boolean.hpp"
#include "halfspace/fast/boolean.hpp"
#include "halfspace/fast/rounded_mesh.hpp"
#include "halfspace/fast/solid/canonical_solid.hpp"
#include "halfspace/fast/to_mesh.hpp"
#include "laws/law.hpp"

/// The law of the order of results (S6.10).
namespace halfspace {
namespace {

constexpr int kOrders = 150;

/// The same solid, its vertices and polygons in any order, polygons from any
/// corner on; and by polygon, which it was.
struct Shuffled {
  GridSolid solid;
  std::vector<PolygonId> polygons;
};

Shuffled shuffled(const GridSolid& solid, std::mt19937_64& random) {
  const SceneData& from = solid.scene().data();
  const auto some_order = [&](std::size_t count) {
    std::vector<std::size_t> order(count);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::shuffle(order.begin(), order.end(), random);
    return order;
  };
  SceneData to;
  to.unit = from.unit;
  to.grid_bits = from.grid_bits;
  std::vector<VertexId> place(from.vertices.size());
  for (const std::size_t v : some_order(from.vertices.size())) {
    place[v] = static_cast<VertexId>(to.vertices.size());
    to.vertices.push_back(from.vertices[v]);
  }
  std::vector<PolygonId> polygons;
  for (const std::size_t p : some_order(solid.scene().polygon_count())) {
    const auto id = static_cast<PolygonId>(p);
    const auto corners = solid.scene().corners(id);
    const std::size_t first = random() % corners.size();
    for (std::size_t i = 0; i < corners.size(); ++i) {
      to.corners.push_back(place[static_cast<std::size_t>(
          corners[(first + i) % corners.size()])]);
    }
    to.first_corner.push_back(static_cast<std::uint32_t>(to.corners.size()));
    to.colors.push_back(from.colors[p]);
    polygons.push_back(id);
  }
  Result<Scene> scene = make_scene(std::move(to));
  HALFSPACE_LAW(scene.has_value());
  Result<GridSolid> made = make_solid(*std::move(scene));
  HALFSPACE_LAW(made.has_value());
  return {*std::move(made), std::move(polygons)};
}

/// Whether all that files say of two solids is the same and in one order.
bool in_one_order(const fast::Solid& a, const fast::Solid& b) {
  const auto same_face = [](const fast::Face& f, const fast::Face& g) {
    return f.plane == g.plane && f.flipped == g.flipped && f.color == g.color &&
           f.part == g.part && f.polygon == g.polygon &&
           f.first_edge == g.first_edge && f.edge_count == g.edge_count;
  };
  const auto same_edge = [](const fast::SolidEdge& e,
                            const fast::SolidEdge& f) {
    return e.from == f.from && e.to == f.to;
  };
  if (!std::equal(a.faces.begin(), a.faces.end(), b.faces.begin(),
                  b.faces.end(), same_face) ||
      !std::equal(a.edges.begin(), a.edges.end(), b.edges.begin(),
                  b.edges.end(), same_edge))
    return false;
  const fast::ExportedMesh x = fast::to_mesh(a), y = fast::to_mesh(b);
  return x.vertices == y.vertices && x.corners == y.corners &&
         x.first_corner == y.first_corner && x.faces == y.faces &&
         x.points == y.points;
}

bool same_when_rounded(const fast::Solid& a, const fast::Solid& b) {
  const auto rounded = [](const fast::Solid& solid) {
    return fast::rounded_mesh(solid, {.number = fast::FileNumber::kFloat});
  };
  const Result<fast::RoundedMesh> x = rounded(a), y = rounded(b);
  if (!x || !y) return false;
  return x->vertices == y->vertices && x->corners == y->corners &&
         x->first_corner == y->first_corner && x->faces == y->faces;
}

/// A boolean of the solids, and of the same in other orders with the names of
/// polygons that they have in the first.
std::pair<fast::Solid, fast::Solid> two_ways(const generate::SolidPair& solids,
                                             std::uint64_t seed) {
  std::mt19937_64 random(seed);
  constexpr BooleanOp kAll[] = {BooleanOp::kUnion, BooleanOp::kIntersection,
                                BooleanOp::kDifference,
                                BooleanOp::kSymmetricDifference};
  const BooleanOp operation = kAll[seed % 4];
  const fast::Solid a = fast::to_solid(solids.a, 0);
  const fast::Solid b = fast::to_solid(solids.b, 1);
  const Shuffled other_a = shuffled(solids.a, random);
  const Shuffled other_b = shuffled(solids.b, random);
  const fast::Solid c = fast::to_solid(other_a.solid, 0);
  const fast::Solid d = fast::to_solid(other_b.solid, 1);
  fast::Solid other = fast::boolean(operation, c, d);
  for (fast::Face& face : other.faces) {
    const Shuffled& of = face.part == 0 ? other_a : other_b;
    face.polygon = of.polygons[static_cast<std::size_t>(face.polygon)];
  }
  return {fast::boolean(operation, a, b), std::move(other)};
}

TEST(S6Order, L21TheOrderOfOperandsDoesNotMatter) {
  law::Cases cases({"the order was another", "vertices are rounded"});
  std::uint64_t seed = 0;
  law::for_all_solids(
      [&](const generate::SolidPair& solids) {
        const auto [one, other] = two_ways(solids, seed++);
        const fast::Solid a = fast::canonical(one);
        const fast::Solid b = fast::canonical(other);
        HALFSPACE_LAW(in_one_order(a, b));
        HALFSPACE_LAW(same_when_rounded(a, b));
        if (!in_one_order(one, other)) cases.meet("the order was another");
        if (fast::to_mesh(a).moved > 0) cases.meet("vertices are rounded");
      },
      kOrders);
  cases.expect_all();
}

/// Whether a vertex is a point of the grid in one form and named by planes in
/// the other.
bool has_other_points(const fast::Solid& a, const fast::Solid& b) {
  const auto count = [](const fast::Solid& solid) {
    return std::count_if(solid.edges.begin(), solid.edges.end(),
                         [&](const fast::SolidEdge& edge) {
                           return fast::vertex_at(solid, edge.from).is_grid;
                         });
  };
  return count(a) != count(b);
}

TEST(S6Order, L21TheFormForFilesIsRoundedToTheSame) {
  law::Cases cases({"points were others", "vertices are rounded"});
  std::uint64_t seed = 0;
  law::for_all_solids(
      [&](const generate::SolidPair& solids) {
        const auto [one, other] = two_ways(solids, seed++);
        const fast::Solid a = fast::canonical(one);
        const fast::Solid b = fast::canonical_for_file(one);
        HALFSPACE_LAW(same_when_rounded(a, b));
        const fast::ExportedMesh mesh = fast::to_mesh(a);
        HALFSPACE_LAW(mesh.is_rounded == fast::to_mesh(b).is_rounded);
        if (has_other_points(a, b)) cases.meet("points were others");
        if (mesh.moved > 0) cases.meet("vertices are rounded");
      },
      4 * kOrders);
  cases.expect_all();
}

/// Faults planted in the order: each is seen.
TEST(S6Order, FaultsInTheOrderAreFound) {
  std::uint64_t seed = 0;
  std::size_t faces_seen = 0, edges_seen = 0, names_seen = 0;
  law::for_all_solids(
      [&](const generate::SolidPair& solids) {
        const fast::Solid right =
            fast::canonical(two_ways(solids, seed++).first);
        if (right.faces.size() < 2) return;
        fast::Solid wrong = right;
        std::swap(wrong.faces.front(), wrong.faces.back());
        faces_seen += in_one_order(right, wrong) ? 0u : 1u;
        wrong = right;
        const fast::Face& face = wrong.faces.front();
        const auto first = wrong.edges.begin() + face.first_edge;
        std::rotate(first, first + 1, first + face.edge_count);
        edges_seen += in_one_order(right, wrong) ? 0u : 1u;
        wrong = right;
        wrong.faces.front().polygon += 1;
        names_seen += in_one_order(right, wrong) ? 0u : 1u;
        HALFSPACE_LAW(faces_seen == edges_seen && edges_seen == names_seen);
      },
      kOrders / 5);
  EXPECT_GT(faces_seen, 10u);
}

}  // namespace
}  // namespace halfspace
