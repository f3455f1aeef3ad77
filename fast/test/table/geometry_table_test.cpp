#include "table/geometry_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "box/bvh.hpp"
#include "solid/dynamic_bvh.hpp"
#include "solid/grid_prefilter.hpp"

namespace halfspace::fast {
namespace {

/// A solid of nothing but faces with boxes, of up to this size.
Solid boxed_faces(std::mt19937_64& random, std::size_t count, int size) {
  Solid solid;
  const auto number = [&](int most) {
    return static_cast<float>(random() % static_cast<std::uint64_t>(most));
  };
  for (std::size_t i = 0; i < count; ++i) {
    Face face;
    for (std::size_t k = 0; k < 3; ++k) {
      face.box.low[k] = number(1000) - 300;
      face.box.high[k] = face.box.low[k] + number(size);
    }
    solid.faces.push_back(face);
  }
  return solid;
}

std::vector<std::int32_t> all_of(const Solid& solid) {
  std::vector<std::int32_t> faces;
  for (std::size_t f = 0; f < solid.faces.size(); ++f)
    faces.push_back(static_cast<std::int32_t>(f));
  return faces;
}

TEST(NearCells, DropNoFaceThatOverlapsAnother) {
  std::mt19937_64 random(5);
  // In boxes that hold all, some, and in one that is flat.
  const std::array<Box, 3> reaches{Box{{-300, -300, -300}, {800, 800, 800}},
                                   Box{{0, 100, 50}, {90, 500, 60}},
                                   Box{{-300, 7, -300}, {800, 7, 800}}};
  for (const int size : {4, 40, 400}) {
    for (const Box& reach : reaches) {
      const Solid a = boxed_faces(random, 700, size);
      const Solid b = boxed_faces(random, 600, size);
      std::vector<std::int32_t> first = all_of(a);
      std::vector<std::int32_t> second = all_of(b);
      drop_lonely(a, first, b, second, reach);
      const std::set<std::int32_t> left(first.begin(), first.end());
      const std::set<std::int32_t> right(second.begin(), second.end());
      std::size_t pairs = 0;
      for (const std::int32_t f : all_of(a)) {
        for (const std::int32_t g : all_of(b)) {
          if (!overlap(a.faces[static_cast<std::size_t>(f)].box,
                       b.faces[static_cast<std::size_t>(g)].box))
            continue;
          ++pairs;
          ASSERT_TRUE(left.count(f) != 0 && right.count(g) != 0);
        }
      }
      ASSERT_GT(pairs + static_cast<std::size_t>(size == 4), 0u);
    }
  }
}

TEST(NearCells, DropMostOfWhatIsFar) {
  std::mt19937_64 random(6);
  Solid a = boxed_faces(random, 1000, 4);
  Solid b = boxed_faces(random, 1000, 4);
  for (std::size_t i = 0; i < 900; ++i) {
    for (Box* box : {&a.faces[i].box, &b.faces[i].box}) {
      // Of the one far to the left, of the other far to the right.
      const float x = box == &a.faces[i].box ? -2000.0f : 3000.0f;
      box->low[0] = x;
      box->high[0] = x + 1;
    }
  }
  std::vector<std::int32_t> first = all_of(a);
  std::vector<std::int32_t> second = all_of(b);
  drop_lonely(a, first, b, second, {{-2000, -300, -300}, {3001, 800, 800}});
  EXPECT_LE(first.size(), 100u);
  EXPECT_LE(second.size(), 100u);
}

/// Of the faces that are not gone those whose boxes overlap `box`.
std::vector<std::int32_t> overlapping(const Solid& solid, const Box& box,
                                      const std::set<std::int32_t>& gone = {}) {
  std::vector<std::int32_t> found;
  for (const std::int32_t f : all_of(solid)) {
    if (gone.count(f) == 0 &&
        overlap(solid.faces[static_cast<std::size_t>(f)].box, box))
      found.push_back(f);
  }
  return found;
}

/// Boxes to look for: of faces, and that of all of space.
std::vector<Box> boxes_of(const Solid& solid) {
  std::vector<Box> boxes{{kEmptyBox.high, kEmptyBox.low}};
  for (const Face& face : solid.faces) boxes.push_back(face.box);
  return boxes;
}

TEST(BoxTree, FindsJustWhatOverlaps) {
  std::mt19937_64 random(8);
  // Levels are full, and one more; items are sorted from some number on.
  for (const std::size_t count :
       {0u, 1u, 7u, 8u, 9u, 64u, 65u, 256u, 257u, 513u, 4097u}) {
    Solid solid = boxed_faces(random, count, 90);
    // A half-space's face is everywhere.
    if (count > 8) solid.faces[5].box = {kEmptyBox.high, kEmptyBox.low};
    const BoxTree tree(
        [&](std::int32_t f) -> const Box& {
          return solid.faces[static_cast<std::size_t>(f)].box;
        },
        all_of(solid));
    for (const Box& box : boxes_of(boxed_faces(random, 40, 200))) {
      std::vector<std::int32_t> found;
      tree.find(box, [&](std::int32_t f) { found.push_back(f); });
      std::sort(found.begin(), found.end());
      ASSERT_EQ(found, overlapping(solid, box)) << count;
    }
  }
}

TEST(FaceIndex, FindsWhatIsThere) {
  std::mt19937_64 random(9);
  Solid solid;
  FaceIndex index;
  std::set<std::int32_t> gone;
  std::size_t found_in_all = 0;
  for (int step = 0; step < 600; ++step) {
    const auto first = static_cast<std::int32_t>(solid.faces.size());
    // Now and then none, or many.
    const std::size_t more = step % 150 == 149 ? 300 : random() % 6;
    for (const Face& face : boxed_faces(random, more, 60).faces)
      solid.faces.push_back(face);
    index.add(solid, first);
    if (step % 2 != 0 && !solid.faces.empty()) {
      const auto f = static_cast<std::int32_t>(random() % solid.faces.size());
      index.remove(f);
      gone.insert(f);
    }
    // Layers are put together after 7, 63 and 511 others.
    if (step % 8 > 1) continue;
    for (const Box& box : boxes_of(boxed_faces(random, 1, 200))) {
      std::vector<std::int32_t> found;
      index.find(box, [&](std::int32_t f) { found.push_back(f); });
      std::sort(found.begin(), found.end());
      ASSERT_EQ(found, overlapping(solid, box, gone)) << step;
      found_in_all += found.size();
    }
  }
  EXPECT_GT(gone.size(), 200u);
  EXPECT_GT(found_in_all, 50000u);
}

TEST(GeometryTable, PointsAddedTogetherAreThoseAddedAlone) {
  std::mt19937_64 random(10);
  for (const std::size_t count : {0u, 1u, 31u, 32u, 33u, 500u}) {
    std::vector<GridPoint> points;
    const auto number = [&] {
      return static_cast<std::int64_t>(random() % 7) - 3;
    };
    for (std::size_t i = 0; i < count; ++i)
      points.push_back({number(), number(), number()});
    GeometryTable together(26), alone(26);
    std::vector<std::int32_t> ids, others;
    together.add_points(points, ids);
    for (const GridPoint& point : points)
      others.push_back(alone.add_point(point));
    ASSERT_EQ(ids, others);
    for (std::size_t i = 0; i < count; ++i)
      ASSERT_EQ(together.vertex(ids[i]).point(), points[i]);
  }
}

/// A point in a plane: `origin + i u + j v`.
GridPoint point_at(const GridPoint& origin, const GridPoint& u,
                   const GridPoint& v, std::int64_t i, std::int64_t j) {
  return {origin.x + i * u.x + j * v.x, origin.y + i * u.y + j * v.y,
          origin.z + i * u.z + j * v.z};
}

TEST(GeometryTable, PlanesThatAreEqualAreOne) {
  std::mt19937_64 random(7);
  for (const int bits : {26, 40, 54}) {
    GeometryTable table(bits);
    std::set<std::int32_t> known;
    for (int round = 0; round < 400; ++round) {
      // Small numbers make many planes parallel, large ones fill the grid.
      const std::int64_t most =
          round % 2 == 0 ? 3 : (std::int64_t{1} << (bits - 1)) / 32;
      const auto number = [&] {
        return static_cast<std::int64_t>(
                   random() % static_cast<std::uint64_t>(2 * most + 1)) -
               most;
      };
      const auto point = [&] {
        return GridPoint{number(), number(), number()};
      };
      const GridPoint o = point(), u = point(), v = point();
      if (cross<54>({u.x, u.y, u.z}, {v.x, v.y, v.z}) == Vector3<Int128>{})
        continue;
      const OrientedPlane one = table.add_plane(
          {o, point_at(o, u, v, 1, 0), point_at(o, u, v, 0, 1)});
      known.insert(one.plane);
      const std::size_t count = table.plane_count();
      ASSERT_EQ(count, known.size());
      for (int k = 0; k < 8; ++k) {
        const auto times = [&] {
          return static_cast<std::int64_t>(random() % 13) - 6;
        };
        const std::int64_t a = times(), b = times(), c = times(), d = times();
        if (a * d == b * c) continue;
        const GridPoint p = point_at(o, u, v, times(), times());
        const OrientedPlane other = table.add_plane(
            {p, point_at(p, u, v, a, b), point_at(p, u, v, c, d)});
        ASSERT_EQ(other.plane, one.plane);
        ASSERT_EQ(other.flipped == one.flipped, a * d > b * c);
      }
      ASSERT_EQ(table.plane_count(), count);
      // What is beside it, and parallel, is another plane.
      const auto n = table.normal(one.plane);
      const GridPoint beside = n.x != 0   ? GridPoint{o.x + 1, o.y, o.z}
                               : n.y != 0 ? GridPoint{o.x, o.y + 1, o.z}
                                          : GridPoint{o.x, o.y, o.z + 1};
      const OrientedPlane parallel = table.add_plane(
          {beside, point_at(beside, u, v, 1, 0), point_at(beside, u, v, 0, 1)});
      ASSERT_NE(parallel.plane, one.plane);
      known.insert(parallel.plane);
    }
  }
}

/// Offsets right between two cells of the table, which doubles take to either
/// side: with the normal (2^17, 1, 0), those that are odd.
TEST(GeometryTable, PlanesAtTheBordersOfCellsAreOne) {
  std::mt19937_64 random(12);
  const auto number = [&](std::int64_t most) {
    return static_cast<std::int64_t>(random() %
                                     static_cast<std::uint64_t>(2 * most + 1)) -
           most;
  };
  const GridPoint u{1, -(1 << 17), 0}, v{0, 0, 1};
  GeometryTable table(26);
  for (int round = 0; round < 100; ++round) {
    const GridPoint o{number(100), 2 * number(1 << 22) + 1, number(1 << 23)};
    const std::int32_t plane =
        table.add_plane({o, point_at(o, u, v, 1, 0), point_at(o, u, v, 0, 1)})
            .plane;
    for (int k = 0; k < 20; ++k) {
      const std::int64_t a = number(100), b = number(1 << 24), c = number(100),
                         d = number(1 << 24);
      if (a * d == b * c) continue;
      ASSERT_EQ(
          table.add_plane({o, point_at(o, u, v, a, b), point_at(o, u, v, c, d)})
              .plane,
          plane);
    }
  }
}

TEST(Wide, DoublesAreTheNearest) {
  std::mt19937_64 random(8);
  for (int i = 0; i < 20000; ++i) {
    const Uint128 bits = Uint128{random()} << 64 | random();
    const Int128 value = static_cast<Int128>(bits) >> (random() % 128);
    ASSERT_EQ(to_double(value), static_cast<double>(value));
    ASSERT_EQ(to_double(-value), static_cast<double>(-value));
  }
}

}  // namespace
}  // namespace halfspace::fast
