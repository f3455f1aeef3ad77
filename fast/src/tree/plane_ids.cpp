#include <bit>
#include <utility>

#include "exact/gcd.hpp"
#include "tree/scene_planes.hpp"

namespace halfspace::fast {
namespace {

/// A plane in the form that planes equal as point sets share: the normal
/// divided by its greatest common divisor, its first component that is not
/// zero positive. The offset follows from any point; its lowest word is enough
/// to tell planes apart nearly always, and the point itself settles the rest.
struct ReducedPlane {
  Vector3<Int128> normal;
  std::uint64_t offset_word = 0;
  bool turned = false;  ///< the sign was changed
};

ReducedPlane reduced(const std::array<GridPoint, 3>& corners) {
  // The widest grid's normal fits 128 bits, so it does for all of them.
  const ExactPlane<54> plane = exact_plane<54>(corners);
  const Vector3<Int128>& n = plane.normal;
  const Uint128 divisor = greatest_common_divisor(
      greatest_common_divisor(size_of(n.x), size_of(n.y)), size_of(n.z));
  const Int128 lead = n.x != 0 ? n.x : n.y != 0 ? n.y : n.z;
  ReducedPlane result;
  result.turned = lead < 0;
  const Int128 by = result.turned ? -static_cast<Int128>(divisor)
                                  : static_cast<Int128>(divisor);
  if (by == 1) {
    result.normal = n;
  } else {
    result.normal = {n.x / by, n.y / by, n.z / by};
  }
  const auto word = [](Int128 v) { return static_cast<std::uint64_t>(v); };
  const auto low = [](std::int64_t v) { return static_cast<std::uint64_t>(v); };
  const GridPoint& p = plane.origin;
  result.offset_word = word(result.normal.x) * low(p.x) +
                       word(result.normal.y) * low(p.y) +
                       word(result.normal.z) * low(p.z);
  return result;
}

std::uint64_t hash_of(const ReducedPlane& plane) {
  std::uint64_t hash = plane.offset_word;
  for (const Int128 c : {plane.normal.x, plane.normal.y, plane.normal.z}) {
    hash ^= static_cast<std::uint64_t>(c) +
            31 * static_cast<std::uint64_t>(c >> 64);
    hash = (hash ^ (hash >> 32)) * 0x9e3779b97f4a7c15u;
  }
  return hash ^ (hash >> 29);
}

/// A table of planes by their reduced form, with open addresses.
class Interner {
 public:
  Interner(const Scene& scene, PlaneTable& table)
      : scene_(scene),
        table_(table),
        mask_(std::bit_ceil(2 * scene.polygon_count() + 1) - 1),
        slots_(mask_ + 1, -1),
        hashes_(mask_ + 1) {}

  void enter(PolygonId id) {
    const std::array<GridPoint, 3> corners = plane_corners(scene_, id);
    const ReducedPlane plane = reduced(corners);
    const std::uint64_t hash = hash_of(plane);
    std::size_t slot = hash & mask_;
    while (slots_[slot] >= 0) {
      if (hashes_[slot] == hash && same(slots_[slot], plane, corners[0])) break;
      slot = (slot + 1) & mask_;
    }
    if (slots_[slot] < 0) {
      slots_[slot] = static_cast<std::int32_t>(table_.first_polygon.size());
      hashes_[slot] = hash;
      table_.first_polygon.push_back(id);
      turned_.push_back(plane.turned);
    }
    const auto found = static_cast<std::size_t>(slots_[slot]);
    table_.plane_of.push_back(slots_[slot]);
    table_.same_orientation.push_back(turned_[found] == plane.turned);
  }

 private:
  bool same(std::int32_t entry, const ReducedPlane& plane,
            const GridPoint& point) const {
    const auto corners = plane_corners(
        scene_, table_.first_polygon[static_cast<std::size_t>(entry)]);
    return reduced(corners).normal == plane.normal &&
           sign(value_at(exact_plane<54>(corners), point)) == 0;
  }

  const Scene& scene_;
  PlaneTable& table_;
  std::size_t mask_;
  std::vector<std::int32_t> slots_;
  std::vector<std::uint64_t> hashes_;
  std::vector<bool> turned_;
};

}  // namespace

PlaneTable intern_planes(const Scene& scene) {
  PlaneTable table;
  table.plane_of.reserve(scene.polygon_count());
  Interner interner(scene, table);
  for (std::size_t p = 0; p < scene.polygon_count(); ++p) {
    interner.enter(static_cast<PolygonId>(p));
  }
  return table;
}

}  // namespace halfspace::fast
