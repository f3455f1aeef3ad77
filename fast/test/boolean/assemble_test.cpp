#include "boolean/assemble.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "halfspace/fast/boolean.hpp"
#include "lattice.hpp"
#include "scenes.hpp"
#include "solid/loops.hpp"
#include "solid/move_to_table.hpp"

namespace halfspace::fast {
namespace {

/// Whether a face's edges go on from one to the next, loop by loop.
bool goes_round(const Solid& solid, const Face& face) {
  std::int32_t start = -1, last = -1;
  for (std::uint32_t i = 0; i < face.edge_count; ++i) {
    const SolidEdge& edge = solid.edges[face.first_edge + i];
    if (start < 0) start = last = edge.from;
    if (edge.from != last) return false;
    last = edge.to;
    if (last == start) start = -1;
  }
  return start < 0;
}

/// Every face of the boolean is all that is left of the one that it names, to
/// one side, in a box of its own.
Solid with_faces_of(BooleanOp operation, const Solid& a, const Solid& b) {
  Solid result = boolean(operation, a, b);
  EXPECT_TRUE(result.unit == a.unit);
  std::set<std::tuple<bool, PolygonId, bool>> seen;
  for (const Face& face : result.faces) {
    const Solid& of = face.from_first ? a : b;
    const Face& source = of.faces.at(static_cast<std::size_t>(face.source));
    EXPECT_EQ(face.plane, source.plane);
    EXPECT_TRUE(face.box == face_box(result, face));
    EXPECT_TRUE(goes_round(result, face));
    EXPECT_TRUE(
        seen.emplace(face.from_first, face.source, face.flipped).second);
  }
  return result;
}

TEST(FastBooleanFaces, AreOfTheirSourcesAndGoRound) {
  std::uint64_t state = 11;
  for (int pair = 0; pair < 8; ++pair) {
    SCOPED_TRACE("pair " + std::to_string(pair));
    // A plate with holes and a cube at its corner, then anything.
    lattice::Cubes a = lattice::random_cubes(1 + pair % 2, state);
    lattice::Cubes b = lattice::random_cubes(2, state);
    for (std::size_t i = 0; i < a.full.size() && pair < 2; ++i) {
      a.full[i] = i < 64 && i != 27 && i != 45 && i != 30;
      b.full[i] = i == 0;
    }
    const Solid first =
        merge_faces(to_solid(lattice::surface(a)), Merge::kPlane);
    const Solid second = to_solid(lattice::surface(b), first);
    for (const BooleanOp operation : kBooleanOps) {
      const Solid result = with_faces_of(operation, first, second);
      with_faces_of(operation, second, first);
      with_faces_of(operation, complement(second), first);
      with_faces_of(operation, result, complement(first));
    }
  }
}

/// The solid's outlines are those of the cubes that are in one of the two.
void expect_cubes(const Solid& solid, BooleanOp operation,
                  const lattice::Cubes& a, const lattice::Cubes& b) {
  lattice::Cubes cubes;
  for (std::size_t i = 0; i < cubes.full.size(); ++i)
    cubes.full[i] =
        is_member(operation, a.full[i], b.full[i]) != solid.unbounded;
  bool whole = false;
  EXPECT_TRUE(bad_edges(solid).empty());
  EXPECT_TRUE(lattice::outline(solid.unbounded ? complement(solid) : solid,
                               whole) == lattice::outline(cubes));
  EXPECT_TRUE(whole);
}

lattice::Cubes complement(lattice::Cubes cubes) {
  for (bool& full : cubes.full) full = !full;
  return cubes;
}

TEST(FastBooleanFaces, InPartsGoWhereEachPartIs) {
  // Two channels leave a block's top in four parts. Caps hold some of them
  // whole, and touch none.
  lattice::Cubes block, channels, prongs;
  const auto is_channel = [](std::size_t c) { return c > 1 && c < 5; };
  for (std::size_t i = 0; i < block.full.size(); ++i) {
    const std::size_t x = i / 64, y = i / 8 % 8, z = i % 8;
    block.full[i] = x % 6 != 0 && y % 6 != 0 && x < 6 && y < 6 && z < 5;
    channels.full[i] = (is_channel(x) || is_channel(y)) && z > 1;
    prongs.full[i] = block.full[i] && !channels.full[i];
  }
  const Solid whole =
      merge_faces(to_solid(lattice::surface(block)), Merge::kPlane);
  const Solid cut =
      with_faces_of(BooleanOp::kDifference, whole,
                    to_solid(lattice::surface(channels), whole, 1));
  EXPECT_EQ(std::count_if(cut.faces.begin(), cut.faces.end(),
                          [](const Face& f) { return f.edge_count == 16; }),
            1);
  for (std::size_t held = 1; held < 16; ++held) {
    SCOPED_TRACE("parts held " + std::to_string(held));
    lattice::Cubes caps;
    for (std::size_t i = 0; i < caps.full.size(); ++i) {
      const std::size_t x = i / 64, y = i / 8 % 8, z = i % 8;
      const std::size_t part = x / 4 * 2 + y / 4;
      caps.full[i] =
          x % 4 < 3 && y % 4 < 3 && z > 2 && z < 7 && (held >> part) % 2 != 0;
    }
    const Solid other = to_solid(lattice::surface(caps), cut, 2);
    for (const BooleanOp operation : kBooleanOps) {
      expect_cubes(with_faces_of(operation, cut, other), operation, prongs,
                   caps);
      expect_cubes(with_faces_of(operation, other, cut), operation, caps,
                   prongs);
      expect_cubes(with_faces_of(operation, complement(other), cut), operation,
                   complement(caps), prongs);
      expect_cubes(with_faces_of(operation, cut, complement(other)), operation,
                   prongs, complement(caps));
    }
  }
}

TEST(FastBooleanFaces, KeepVerticesOfPartsThatStay) {
  // A channel through a block's top, of which one half is black: a corner of
  // each half is amid a wall's edge. The wall is bitten into, the top only
  // near.
  lattice::Cubes block, channel, bite, rest;
  for (std::size_t i = 0; i < block.full.size(); ++i) {
    const std::size_t x = i / 64, y = i / 8 % 8, z = i % 8;
    block.full[i] = y > 0 && z < 4;
    channel.full[i] = (y == 3 || y == 4) && z > 2;
    bite.full[i] = x > 2 && x < 5 && (y < 2 ? z == 1 : y == 4 && z == 6);
    rest.full[i] = block.full[i] && !channel.full[i];
  }
  Solid whole = to_solid(lattice::surface(block));
  for (Face& face : whole.faces) {
    if (face.box.low[2] > 3 && face.box.low[0] > 3) face.color.r = 1;
  }
  whole = merge_faces(whole, Merge::kColor);
  EXPECT_EQ(whole.faces.size(), 7u);
  const Solid cut =
      with_faces_of(BooleanOp::kDifference, whole,
                    to_solid(lattice::surface(channel), whole, 1));
  const Solid other = to_solid(lattice::surface(bite), cut, 2);
  for (const BooleanOp operation : kBooleanOps)
    expect_cubes(with_faces_of(operation, cut, other), operation, rest, bite);
}

/// A pyramid with its top at (1, 1, 1). Its base, in two triangles, goes from
/// (4 - d, 4 + d) to (4 + e, 4 - e) and from z = 1 to z = 2.
Solid pyramid(std::int64_t d, std::int64_t e) {
  return solid_of(
      {{4 - d, 4 + d, 1},
       {4 + e, 4 - e, 1},
       {4 + e, 4 - e, 2},
       {4 - d, 4 + d, 2},
       {1, 1, 1}},
      {{0, 2, 1}, {0, 3, 2}, {3, 0, 4}, {2, 3, 4}, {1, 2, 4}, {0, 1, 4}});
}

TEST(FastBooleanFaces, EndAtNoPointWhereNothingTurns) {
  // All but a quarter, the edge of which the bases' edges touch; and a cube
  // within a block.
  lattice::Cubes cubes, cube, block;
  for (std::size_t i = 0; i < cubes.full.size(); ++i) {
    cubes.full[i] = i / 64 < 4 || i / 8 % 8 < 4;
    cube.full[i] = i == (3 * 8 + 3) * 8 + 1;
    block.full[i] = i / 64 % 7 != 0 && i / 8 % 8 % 7 != 0;
  }
  for (const auto& [d, e] : {std::pair(2, 1), std::pair(4, 4)}) {
    const Solid inner = pyramid(d, e);
    const auto beside_inner = [&inner](const Solid& solid) {
      TableLease lease = *TableLease::of(inner.table);
      return moved_to(solid, lease);
    };
    const Solid outer = beside_inner(
        merge_faces(to_solid(lattice::surface(cubes)), Merge::kPlane));
    // Vertices of the cube, which stay, are where nothing turns afterwards.
    const auto beside = [&](const lattice::Cubes& full) {
      return beside_inner(to_solid(lattice::surface(full)));
    };
    const Solid within =
        boolean(BooleanOp::kIntersection, beside(cube), beside(block));
    EXPECT_EQ(within.faces.size(), 6u);
    for (const bool swapped : {false, true}) {
      const Solid& a = swapped ? outer : inner;
      const Solid& b = swapped ? inner : outer;
      const Solid both = with_faces_of(BooleanOp::kIntersection, a, b);
      EXPECT_EQ(both.faces.size(), 6u);
      EXPECT_EQ(both.edges.size(), 18u);
      EXPECT_TRUE(bad_edges(both).empty());
      const Solid any = with_faces_of(BooleanOp::kUnion, a, b);
      EXPECT_EQ(any.faces.size(), outer.faces.size());
      EXPECT_EQ(any.edges.size(), outer.edges.size());
    }
  }
}

/// Whether a box holds the vertex, wherever within its error it is.
bool holds(const Box& box, const Solid& solid, std::int32_t vertex) {
  Box both = box;
  extend(both, solid.table->vertex(vertex).approximate);
  return both == box;
}

/// The blocks of a face are all its edges in order, in boxes that hold them,
/// and are found by those boxes.
void expect_right(const PacketList& list, const Solid& solid,
                  const Face& face) {
  EXPECT_TRUE(list.box() == face.box);
  const SolidEdge* edges = solid.edges.data() + face.first_edge;
  std::uint32_t next = 0;
  for (const EdgePacket& block : list.blocks()) {
    ASSERT_EQ(block.first, next);
    next += block.count;
    ASSERT_GT(next, block.first);
    // A block that matters takes a look at each of its edges.
    EXPECT_LE(block.count, 16u);
    ASSERT_LE(next, face.edge_count);
    Face part = face;
    part.first_edge += block.first;
    part.edge_count = block.count;
    EXPECT_EQ(block.is_closed, goes_round(solid, part));
    for (std::uint32_t i = block.first; i < next; ++i) {
      EXPECT_TRUE(holds(block.box, solid, edges[i].from));
      EXPECT_TRUE(holds(block.box, solid, edges[i].to));
      const bool goes_on = i > block.first && edges[i - 1].to == edges[i].from;
      EXPECT_TRUE(i == block.first || goes_on || !block.is_row);
    }
    bool is_found = false;
    list.visit(
        [&](const Box& box) { return holds(box, solid, edges[next - 1].to); },
        [&](const EdgePacket& found) {
          is_found = is_found || found.first == block.first;
        });
    EXPECT_TRUE(is_found);
  }
  EXPECT_EQ(next, face.edge_count);
}

TEST(FastBooleanFaces, WithManyEdgesHaveBlocksOfThem) {
  // A plate with holes, of which the others take bites and slices away, or
  // nothing, also where they are above and below, or round it.
  lattice::Cubes plate;
  std::vector<lattice::Cubes> others(15);
  for (std::size_t i = 0; i < plate.full.size(); ++i) {
    const std::size_t x = i / 64, y = i / 8 % 8, z = i % 8;
    plate.full[i] = z == 1 && (x % 2 == 0 || y % 2 == 0);
    for (std::size_t k = 0; k < 6; ++k) {
      others[k].full[i] = x <= k;
      others[k + 6].full[i] = x <= 2 && y <= k && z < 3;
    }
    others[12].full[i] = z == 5;
    others[13].full[i] = x == 7 && z < 3;
    others[14].full[i] = x == 3 && y == 3 && (z == 0 || z == 4);
  }
  Solid whole = merge_faces(to_solid(lattice::surface(plate)), Merge::kPlane);
  std::stable_sort(
      whole.faces.begin(), whole.faces.end(),
      [](const Face& f, const Face& g) { return f.edge_count > g.edge_count; });
  // The first faces, some of them, and the others.
  const EdgePackets blocks(whole);
  const EdgePackets some(blocks, {1, 2, 0});
  for (std::size_t f = 0; f < whole.faces.size(); ++f) {
    EXPECT_EQ(blocks.of(static_cast<std::int32_t>(f)) != nullptr,
              EdgePackets::has_many(whole.faces[f]));
  }
  EXPECT_TRUE(EdgePackets::has_many(whole.faces[1]));
  EXPECT_EQ(some.of(0), blocks.of(1));
  EXPECT_EQ(some.of(1), blocks.of(2));
  EXPECT_EQ(some.of(2), blocks.of(0));
  std::size_t known = 0;
  for (std::size_t k = 0; k < 2 * others.size(); ++k) {
    Solid tool = to_solid(lattice::surface(others[k / 2]), whole, 1);
    if (k % 2 != 0) tool = complement(std::move(tool));
    for (const BooleanOp operation : kBooleanOps) {
      for (const bool swapped : {false, true}) {
        TableLease lease = *TableLease::of(whole.table);
        Arrangement found(operation, swapped ? tool : whole,
                          swapped ? whole : tool, lease, 1);
        found.find_contacts();
        ASSERT_TRUE(found.conforms(0));
        ASSERT_TRUE(found.conforms(1));
        const auto [result, result_blocks] = assembled(found);
        for (std::size_t f = 0; f < result.faces.size(); ++f) {
          const Face& face = result.faces[f];
          const auto list = result_blocks.shared(static_cast<std::int32_t>(f));
          ASSERT_EQ(list != nullptr, EdgePackets::has_many(face));
          if (list == nullptr) continue;
          expect_right(*list, result, face);
          ++known;
        }
      }
    }
  }
  EXPECT_GT(known, 120u);
}

}  // namespace
}  // namespace halfspace::fast
