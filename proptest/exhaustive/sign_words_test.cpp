#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <vector>

#include "halfspace/fast/split.hpp"
#include "halfspace/ref/build.hpp"
#include "halfspace/ref/split.hpp"

namespace halfspace {
namespace {

/// The signs of a polygon's vertices against a plane, in order: "++0-".
using Word = std::string;

/// A point of the polygon's own plane.
struct Flat {
  std::int64_t u = 0;
  std::int64_t v = 0;
};

Flat operator+(Flat p, Flat q) { return {p.u + q.u, p.v + q.v}; }
Flat operator-(Flat p, Flat q) { return {p.u - q.u, p.v - q.v}; }
std::int64_t cross(Flat p, Flat q) { return p.u * q.v - p.v * q.u; }

/// Twice the least common multiple of 1 to 6: what divides edges evenly.
constexpr std::int64_t kScale = 120;

/// A polygon: strictly convex corners, then points inside the edges after
/// them, which are straight corners.
std::vector<Flat> polygon_of(const std::vector<int>& straight) {
  constexpr std::array<Flat, 8> kCorners = {Flat{3, 1}, {1, 3},   {-1, 3},
                                            {-3, 1},    {-3, -1}, {-1, -3},
                                            {1, -3},    {3, -1}};
  std::vector<Flat> points;
  for (std::size_t k = 0; k < straight.size(); ++k) {
    const Flat p = kCorners[k];
    const Flat d = kCorners[(k + 1) % straight.size()] - p;
    for (std::int64_t j = 0; j <= straight[k]; ++j) {
      const std::int64_t part = kScale * j / (straight[k] + 1);
      points.push_back({kScale * p.u + part * d.u, kScale * p.v + part * d.v});
    }
  }
  return points;
}

/// Calls visit(polygon) for every way to make `count` corners out of strictly
/// convex ones and straight ones on their edges.
template <class Visit>
void for_all_polygons(int count, const Visit& visit) {
  // The straight corners after each strict one, as bits: 1 begins a new edge.
  for (std::uint32_t bits = 0; bits < 1u << (count - 1); ++bits) {
    std::vector<int> straight = {0};
    for (int k = 0; k + 1 < count; ++k) {
      if ((bits >> k & 1u) != 0) {
        straight.push_back(0);
      } else {
        ++straight.back();
      }
    }
    if (straight.size() < 3) continue;
    // Straight corners come first, too.
    std::vector<Flat> polygon = polygon_of(straight);
    for (int k = 0; k <= straight.back(); ++k) {
      visit(polygon);
      std::rotate(polygon.begin(), polygon.end() - 1, polygon.end());
    }
  }
}

/// A line of the polygon's plane, through two points.
struct Line {
  Flat from;
  Flat to;
};

/// Lines that lie in every way against the polygon: through any two of its
/// corners and middles of edges, past a corner, and apart; each both ways.
std::vector<Line> lines_against(const std::vector<Flat>& polygon) {
  const std::size_t count = polygon.size();
  std::vector<Flat> marks = polygon;
  for (std::size_t k = 0; k < count; ++k) {
    const Flat sum = polygon[k] + polygon[(k + 1) % count];
    marks.push_back({sum.u / 2, sum.v / 2});
  }
  std::vector<Line> lines;
  for (std::size_t a = 0; a < marks.size(); ++a) {
    for (std::size_t b = 0; b < marks.size(); ++b) {
      if (a != b) lines.push_back({marks[a], marks[b]});
    }
  }
  for (std::size_t k = 0; k < count; ++k) {
    const Flat before = polygon[(k + count - 1) % count];
    const Flat after = polygon[(k + 1) % count];
    const Flat along = after - before;
    for (const Flat p : {polygon[k], polygon[k] + polygon[k]}) {
      lines.push_back({p, p + along});
      lines.push_back({p + along, p});
    }
  }
  return lines;
}

/// The signs of the corners against the line: + to its left.
Word word_of(const std::vector<Flat>& polygon, const Line& line) {
  Word word;
  for (const Flat p : polygon) {
    const std::int64_t side = cross(line.to - line.from, p - line.from);
    word += side > 0 ? '+' : side < 0 ? '-' : '0';
  }
  return word;
}

/// Whether some convex polygon, straight corners allowed, has these signs
/// against some plane: round the polygon, one run of each sign; between + and
/// - at most one 0, since more would be a line through the inside.
bool is_possible(const Word& word) {
  const std::size_t count = word.size();
  std::size_t runs[3] = {};  // of +, -, 0
  const auto kind = [](char sign) {
    return sign == '+' ? 0u : sign == '-' ? 1u : 2u;
  };
  bool long_zero = false;
  for (std::size_t k = 0; k < count; ++k) {
    const char next = word[(k + 1) % count];
    if (word[k] != next) ++runs[kind(word[k])];
    long_zero = long_zero || (word[k] == '0' && next == '0');
  }
  const bool some_positive = word.find('+') != Word::npos;
  const bool some_negative = word.find('-') != Word::npos;
  if (some_positive && some_negative)
    return runs[0] == 1 && runs[1] == 1 && !long_zero;
  // Against an edge's line, or touched in a corner; or wholly in the plane.
  return runs[2] <= 1;
}

std::set<Word> possible_words(int count) {
  std::set<Word> words;
  int all = 1;
  for (int k = 0; k < count; ++k) all *= 3;
  for (int number = 0; number < all; ++number) {
    Word word;
    for (int rest = number, k = 0; k < count; ++k, rest /= 3)
      word += "+-0"[rest % 3];
    if (is_possible(word)) words.insert(word);
  }
  return words;
}

/// The words of one set that are not in the other.
std::string only_in(const std::set<Word>& words, const std::set<Word>& others) {
  std::string text;
  for (const Word& word : words) {
    if (!others.contains(word)) text += word + " ";
  }
  return text;
}

Relation relation_of(const Word& word) {
  const bool some_positive = word.find('+') != Word::npos;
  const bool some_negative = word.find('-') != Word::npos;
  if (some_positive)
    return some_negative ? Relation::kSpanning : Relation::kPositive;
  return some_negative ? Relation::kNegative : Relation::kCoincident;
}

/// The part on the side of `sign` of polygon 0, cut by that of polygon 1.
FragmentName part_of(const Word& word, char sign) {
  FragmentName name{0, {}};
  for (std::size_t k = 0; k < word.size(); ++k) {
    const char from = word[k];
    const char to = word[(k + 1) % word.size()];
    if (from == sign || to == sign) {
      name.edges.push_back(
          {EdgeName::Kind::kSource, static_cast<std::int32_t>(k)});
    }
    if (from == sign && to != sign)
      name.edges.push_back({EdgeName::Kind::kSplitter, 1});
  }
  name.edges = rotated_to_least(name.edges);
  return name;
}

/// The polygon and the splitter, in a plane that is no axis's, on the grid.
Scene scene_of(const std::vector<Flat>& polygon,
               const std::vector<Flat>& splitter, std::int64_t lift,
               int grid_bits) {
  const std::int64_t size = std::int64_t{1} << (grid_bits - 17);
  const auto at = [size](Flat p, std::int64_t w) {
    return GridPoint{size * (3 * p.u - p.v) + 7,
                     size * (p.u + 4 * p.v + 2 * w) - 11,
                     size * (2 * p.v - 5 * p.u - w) + 1};
  };
  SceneData data;
  data.grid_bits = grid_bits;
  const auto add = [&data](const std::vector<GridPoint>& points) {
    for (const GridPoint& p : points) {
      data.corners.push_back(static_cast<VertexId>(data.vertices.size()));
      data.vertices.push_back(p);
    }
    data.first_corner.push_back(
        static_cast<std::uint32_t>(data.corners.size()));
    data.colors.push_back({});
  };
  std::vector<GridPoint> points;
  for (const Flat p : polygon) points.push_back(at(p, 0));
  add(points);
  add({at(splitter[0], 0), at(splitter[1], 0), at(splitter[2], lift)});
  const auto scene = make_scene(data);
  EXPECT_TRUE(scene.has_value()) << scene.error().message;
  return *scene;
}

/// What both implementations make of polygon 0 and the plane of polygon 1.
void expect_word(const Scene& scene, const Word& word) {
  const auto splitter = ref::plane_of(ref::whole(scene, 1).vertices);
  const ref::Fragment f = ref::whole(scene, 0);
  const fast::Fragment g = fast::whole(scene, 0);
  fast::FilterStats stats;
  ASSERT_EQ(ref::relation(f, splitter), relation_of(word));
  ASSERT_EQ(fast::relation(scene, g, 1, stats), relation_of(word));
  if (relation_of(word) != Relation::kSpanning) return;
  const auto parts = ref::split(f, splitter, 1);
  const auto found = fast::split(scene, g, 1, stats);
  ASSERT_EQ(ref::name_of(parts.positive), part_of(word, '+'));
  ASSERT_EQ(ref::name_of(parts.negative), part_of(word, '-'));
  ASSERT_EQ(fast::name_of(found.positive), part_of(word, '+'));
  ASSERT_EQ(fast::name_of(found.negative), part_of(word, '-'));
  const auto zeros =
      static_cast<std::size_t>(std::count(word.begin(), word.end(), '0'));
  ASSERT_EQ(parts.positive.edges.size() + parts.negative.edges.size(),
            word.size() + 4 - zeros);
}

/// The lift is towards the side that makes the left of the line positive.
constexpr std::int64_t kLift = 64;

void check_polygon(const std::vector<Flat>& polygon, int grid_bits,
                   std::set<Word>& met) {
  for (const Line& line : lines_against(polygon)) {
    const Word word = word_of(polygon, line);
    SCOPED_TRACE(word + ", " + std::to_string(grid_bits) + " bits");
    expect_word(
        scene_of(polygon, {line.from, line.to, line.from}, kLift, grid_bits),
        word);
    if (::testing::Test::HasFatalFailure()) return;
    met.insert(word);
  }
  const Word zeros(polygon.size(), '0');
  for (const bool turned : {false, true}) {
    const Flat& far = polygon.back();
    const std::vector<Flat> triangle =
        turned ? std::vector<Flat>{polygon[0], far, {far.u + 1, -far.v - 7}}
               : std::vector<Flat>{far, polygon[0], {far.u + 1, -far.v - 7}};
    expect_word(scene_of(polygon, triangle, 0, grid_bits), zeros);
    met.insert(zeros);
  }
}

/// Every sign word of a convex polygon of up to 8 corners, straight corners
/// among them, against a plane: relation, parts, and the names of their edges.
TEST(Exhaustive, EverySignWordOfAConvexPolygonIsCutAsItSays) {
  std::size_t words = 0;
  for (int count = 3; count <= 8; ++count) {
    std::set<Word> met;
    int turn = 0;
    for_all_polygons(count, [&](const std::vector<Flat>& polygon) {
      check_polygon(polygon, kGridBits[turn++ % 3], met);
    });
    const std::set<Word> possible = possible_words(count);
    EXPECT_EQ(only_in(met, possible), "") << count << " corners";
    EXPECT_EQ(only_in(possible, met), "") << count << " corners";
    words += met.size();
  }
  RecordProperty("words", std::to_string(words));
  EXPECT_GT(words, 300u);
}

}  // namespace
}  // namespace halfspace
