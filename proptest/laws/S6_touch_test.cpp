#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "adapters/both.hpp"
#include "adapters/scenes.hpp"
#include "definition/definition.hpp"
#include "laws/law.hpp"
#include "laws/operands.hpp"

/// Laws of closed scenes whose parts meet anywhere (S6.2, S6.6, S6.7). The
/// parts are convex, so their half-spaces say what is in them: no ray and no
/// winding number is trusted here.
namespace halfspace {
namespace {

using definition::Facet;
using definition::Integer;
using definition::Plane;
using definition::Point;

constexpr int kSoups = 300;
/// All over the soups, and somewhat beyond: from -2 to 6.
constexpr int kPoints = 100;
constexpr int kLow = -15;
constexpr int kRange = 59;

template <class Impl>
class S6Touch : public ::testing::Test {};
TYPED_TEST_SUITE(S6Touch, BooleanImplementations);

/// A convex part: its corners and its polygons.
struct Part {
  std::vector<std::vector<Point>> polygons;
  std::vector<Plane> planes;
};

std::vector<Part> parts_of(const Scene& scene) {
  std::vector<Part> parts;
  for (const PolygonId p : ids_of(scene)) {
    const std::size_t part = scene.color(p).r;
    if (part >= parts.size()) parts.resize(part + 1);
    parts[part].polygons.push_back(
        definition::points_of(scene, definition::whole(scene, p)));
    parts[part].planes.push_back(definition::plane_of(scene, p));
  }
  return parts;
}

using Vector = std::array<Integer, 3>;

Vector cross(const Vector& u, const Vector& v) {
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
          u[0] * v[1] - u[1] * v[0]};
}

std::vector<Vector> edges_of(const Part& part) {
  std::vector<Vector> edges;
  for (const auto& polygon : part.polygons) {
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const Point& p = polygon[k];
      const Point& q = polygon[(k + 1) % polygon.size()];
      edges.push_back({q.x - p.x, q.y - p.y, q.z - p.z});
    }
  }
  return edges;
}

/// From where to where the part reaches along a direction.
std::pair<Integer, Integer> reach(const Part& part, const Vector& along) {
  std::pair<Integer, Integer> reach;
  bool first = true;
  for (const auto& polygon : part.polygons) {
    for (const Point& p : polygon) {
      const Integer at = along[0] * p.x + along[1] * p.y + along[2] * p.z;
      if (first || at < reach.first) reach.first = at;
      if (first || at > reach.second) reach.second = at;
      first = false;
    }
  }
  return reach;
}

/// Whether two convex parts have an inner point in common: no plane along a
/// face of either, or along an edge of each, stands between them.
bool have_common_points(const Part& a, const Part& b) {
  std::vector<Vector> directions;
  for (const Part* part : {&a, &b}) {
    for (const Plane& plane : part->planes)
      directions.push_back({plane.a, plane.b, plane.c});
  }
  for (const Vector& u : edges_of(a)) {
    for (const Vector& v : edges_of(b)) directions.push_back(cross(u, v));
  }
  return std::none_of(
      directions.begin(), directions.end(), [&](const Vector& along) {
        const auto [low_a, high_a] = reach(a, along);
        const auto [low_b, high_b] = reach(b, along);
        return low_a != high_a && (high_a <= low_b || high_b <= low_a);
      });
}

/// Whether a face of one lies in a face of the other, as far as both reach.
bool touch_in_a_plane(const Part& a, const Part& b) {
  return std::any_of(a.polygons.begin(), a.polygons.end(), [&](const auto& p) {
    return std::any_of(b.polygons.begin(), b.polygons.end(),
                       [&](const auto& q) { return overlap(p, q); });
  });
}

/// Whether they have a point in common at all.
bool touch(const Part& a, const Part& b) {
  for (const Part* part : {&a, &b}) {
    for (const Plane& plane : part->planes) {
      const Vector along{plane.a, plane.b, plane.c};
      const auto [low_a, high_a] = reach(a, along);
      const auto [low_b, high_b] = reach(b, along);
      if (high_a < low_b || high_b < low_a) return false;
    }
  }
  return true;
}

/// In how many parts the point is, or -1: on a plane of one.
int count_at(const std::vector<Part>& parts, const Point& point) {
  int count = 0;
  for (const Part& part : parts) {
    bool inside = true;
    for (const Plane& plane : part.planes) {
      const int side = definition::side_of(plane, point);
      if (side == 0) return -1;
      inside = inside && side < 0;
    }
    count += inside ? 1 : 0;
  }
  return count;
}

TYPED_TEST(S6Touch, L13PartsMakeASolidExactlyIfNoTwoOverlap) {
  std::map<std::string, int> met;
  law::for_all_soups(
      [&](const Scene& soup) {
        const std::vector<Part> parts = parts_of(soup);
        bool is_solid = true;
        bool is_apart = true;
        for (std::size_t i = 0; i < parts.size(); ++i) {
          for (std::size_t j = 0; j < i; ++j) {
            is_solid = is_solid && !have_common_points(parts[i], parts[j]) &&
                       !touch_in_a_plane(parts[i], parts[j]);
            is_apart = is_apart && !touch(parts[i], parts[j]);
          }
        }
        ++met[!is_solid ? "overlaps" : is_apart ? "apart" : "touches"];
        HALFSPACE_LAW(TypeParam::is_solid(
                          TypeParam::to_solid(*make_solid(soup))) == is_solid);
      },
      kSoups);
  for (const char* name : {"overlaps", "touches", "apart"})
    EXPECT_GT(met[name], 0) << name;
}

TYPED_TEST(S6Touch, L14ResolvedIsASolidOfWhatThePartsHold) {
  std::map<int, int> met;
  law::for_all_soups(
      [&](const Scene& soup) {
        const std::vector<Part> parts = parts_of(soup);
        const auto resolved =
            TypeParam::resolve(TypeParam::to_solid(*make_solid(soup)));
        const auto polygons = TypeParam::polygons_of(resolved);
        HALFSPACE_LAW(TypeParam::is_closed(resolved));
        HALFSPACE_LAW(definition::is_closed(polygons));
        HALFSPACE_LAW(TypeParam::is_solid(resolved));
        const std::vector<Facet> facets = facets_of(polygons);
        for (const Point& point : some_points(kPoints, kLow, kRange)) {
          const int count = count_at(parts, point);
          if (count < 0) continue;
          ++met[std::min(count, 2)];
          HALFSPACE_LAW(definition::winding(facets, point) ==
                        std::min(count, 1));
        }
      },
      kSoups / 2);
  for (const int count : {0, 1, 2}) EXPECT_GT(met[count], 50) << count;
}

TYPED_TEST(S6Touch, L15BooleansOfTouchingPartsHaveTheirMembers) {
  int touching = 0;
  law::for_all_soups(
      [&](const Scene& soup) {
        // The last part is one operand, the others are the other one.
        const std::vector<Part> parts = parts_of(soup);
        std::vector<PolygonId> ids[2];
        for (const PolygonId p : ids_of(soup))
          ids[std::size_t{soup.color(p).r} + 1 == parts.size()].push_back(p);
        const auto a = TypeParam::to_solid(*make_solid(chosen(soup, ids[0])));
        const auto b = TypeParam::to_solid(*make_solid(chosen(soup, ids[1])));
        if (!TypeParam::is_solid(a)) return;
        const std::vector<Part> first(parts.begin(), parts.end() - 1);
        const std::vector<Part> second(parts.end() - 1, parts.end());
        touching += parts.size() > 2 ? 1 : 0;
        for (const BooleanOp operation : kBooleanOps) {
          const auto result = TypeParam::boolean(operation, a, b);
          const auto polygons = TypeParam::polygons_of(result);
          HALFSPACE_LAW(definition::is_closed(polygons));
          HALFSPACE_LAW(TypeParam::is_solid(result));
          const std::vector<Facet> facets = facets_of(polygons);
          for (const Point& point : some_points(kPoints, kLow, kRange)) {
            const int in_a = count_at(first, point);
            const int in_b = count_at(second, point);
            if (in_a < 0 || in_b < 0) continue;
            const bool is_in = is_member(operation, in_a > 0, in_b > 0);
            HALFSPACE_LAW(definition::winding(facets, point) ==
                          (is_in ? 1 : 0));
          }
        }
      },
      kSoups);
  EXPECT_GT(touching, 10);
}

}  // namespace
}  // namespace halfspace
