#include "repair/soup.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

#include "halfspace/boolean.hpp"
#include "halfspace/csg/fault.hpp"

namespace halfspace::csg {
namespace {

/// Triangles between points of a small cube, each point once.
Soup some_soup(std::mt19937_64& random, std::int64_t width,
               std::size_t triangles) {
  Soup soup;
  std::map<GridPoint, VertexId> ids;
  const auto coordinate = [&] {
    return static_cast<std::int64_t>(random() %
                                     static_cast<std::uint64_t>(width)) -
           width / 2;
  };
  while (soup.polygons.size() < triangles) {
    std::vector<VertexId> polygon;
    for (int i = 0; i < 3; ++i) {
      const GridPoint p{coordinate(), coordinate(), coordinate()};
      const auto [at, is_new] =
          ids.try_emplace(p, static_cast<VertexId>(soup.points.size()));
      if (is_new) soup.points.push_back(p);
      polygon.push_back(at->second);
    }
    if (std::set<VertexId>(polygon.begin(), polygon.end()).size() < 3) continue;
    soup.add(polygon, static_cast<PolygonId>(soup.polygons.size()), {});
  }
  return soup;
}

TEST(Soup, WeldsAsALookAtAllPairsDoes) {
  std::mt19937_64 random(5);
  std::size_t welded_some = 0;
  for (int i = 0; i < 200; ++i) {
    const auto width = static_cast<std::int64_t>(5 + random() % 60);
    const auto reach = static_cast<std::int64_t>(random() % 6);
    Soup soup = some_soup(random, width, 30);
    std::set<VertexId> ends;
    for (const auto& [from, to] : open_edges(soup)) ends.insert({from, to});
    std::map<VertexId, VertexId> become;
    for (const VertexId v : ends) {
      become[v] = v;
      for (const auto& [u, target] : become) {
        const GridPoint &p = soup.at(u), &q = soup.at(v);
        if (target == u && become[v] == v &&
            std::max({std::abs(p.x - q.x), std::abs(p.y - q.y),
                      std::abs(p.z - q.z)}) <= reach)
          become[v] = u;
      }
    }
    std::vector<std::vector<VertexId>> wanted;
    std::size_t moved = 0;
    for (const auto& [v, target] : become) moved += v != target ? 1u : 0u;
    for (std::vector<VertexId> polygon : soup.polygons) {
      for (VertexId& v : polygon) v = become.contains(v) ? become[v] : v;
      if (std::set<VertexId>(polygon.begin(), polygon.end()).size() == 3)
        wanted.push_back(polygon);
    }
    EXPECT_EQ(weld(soup, reach).vertices, moved);
    EXPECT_EQ(soup.polygons, wanted);
    welded_some += moved > 0 ? 1u : 0u;
  }
  EXPECT_GT(welded_some, 50u);
}

TEST(Soup, KeepsOneOfEqualPolygonsOfTheWayThatThereAreMoreOf) {
  std::mt19937_64 random(6);
  std::size_t dropped_some = 0;
  for (int i = 0; i < 200; ++i) {
    Soup soup = some_soup(random, 2, 40);  // of eight points
    const auto key_of = [](std::vector<VertexId> polygon) {
      std::rotate(polygon.begin(),
                  std::min_element(polygon.begin(), polygon.end()),
                  polygon.end());
      return polygon;
    };
    std::map<std::vector<VertexId>, int> counts;
    for (const auto& polygon : soup.polygons) ++counts[key_of(polygon)];
    std::vector<PolygonId> wanted;
    std::set<std::vector<VertexId>> seen;
    for (std::size_t p = 0; p < soup.polygons.size(); ++p) {
      const auto key = key_of(soup.polygons[p]);
      std::vector<VertexId> back(key.rbegin(), key.rend());
      if (counts[key] > counts[key_of(back)] && seen.insert(key).second)
        wanted.push_back(static_cast<PolygonId>(p));
    }
    const std::size_t before = soup.polygons.size();
    EXPECT_EQ(drop_duplicates(soup), before - wanted.size());
    EXPECT_EQ(soup.sources, wanted);
    dropped_some += before > wanted.size() ? 1u : 0u;
  }
  EXPECT_GT(dropped_some, 100u);
}

TEST(OpenError, CountsBadEdgesAndThePlacesOfThem) {
  std::mt19937_64 random(7);
  std::set<std::size_t> places_met;
  for (int i = 0; i < 300; ++i) {
    const Soup soup = some_soup(random, 4 + i % 9, 1 + random() % 12);
    Result<io::Imported> made = imported_soup(soup);
    ASSERT_TRUE(made);
    const std::vector<BadEdge> bad = bad_edges(made->scene);
    if (bad.empty()) continue;
    // The least end of each edge's place, until nothing becomes less.
    std::map<GridPoint, GridPoint> place;
    for (const BadEdge& edge : bad) {
      place[edge.from] = edge.from;
      place[edge.to] = edge.to;
    }
    for (bool is_changed = true; is_changed;) {
      is_changed = false;
      for (const BadEdge& edge : bad) {
        GridPoint &a = place[edge.from], &b = place[edge.to];
        if (a == b) continue;
        a = b = std::min(a, b);
        is_changed = true;
      }
    }
    std::set<GridPoint> least;
    for (const auto& [end, at] : place) least.insert(at);
    const auto counted = [](std::size_t count, const std::string& noun) {
      return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
    };
    const Error error = open_error(made->scene, made->faces);
    EXPECT_NE(error.message.find(": " + counted(bad.size(), "bad edge") +
                                 " in " + counted(least.size(), "place") +
                                 ", the first from "),
              std::string::npos)
        << error.message;
    places_met.insert(least.size());
  }
  EXPECT_GT(places_met.size(), 4u);
}

}  // namespace
}  // namespace halfspace::csg
