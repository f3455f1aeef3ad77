#include "halfspace/fast/predicate.hpp"

#include "halfspace/assert.hpp"
#include "tree/fragment_splitter.hpp"

namespace halfspace::fast {
namespace {

/// The eye's side of a plane, exactly: n.(e - p0) with e in lattice steps and
/// p0 scaled to them, or n.e for a direction.
///
/// Bits: e - p0 at most 2^(n+13) + 2^(n+7) < 2^(n+14), times a normal of
/// 2^(2n+1), three times: below 2^(3n+17), so 95, 137 or 179: 4 words do.
template <int kBits>
int exact_eye_sign(const ExactPlane<kBits>& plane, const CameraData& camera) {
  const Int128 step = camera.perspective ? Int128{1} << kLatticeBits : 0;
  const LatticeVector& e = camera.eye;
  const GridPoint& p = plane.origin;
  return sign(multiply<4>(Int128{plane.normal.x}, e.x - step * p.x) +
              multiply<4>(Int128{plane.normal.y}, e.y - step * p.y) +
              multiply<4>(Int128{plane.normal.z}, e.z - step * p.z));
}

}  // namespace

Fragment whole(const Scene& scene, PolygonId id) {
  Fragment fragment{id, {}, {}};
  for (const VertexId vertex : scene.corners(id)) {
    const auto corner = static_cast<std::int32_t>(fragment.edges.size());
    fragment.edges.push_back({EdgeName::Kind::kSource, corner});
    fragment.vertices.push_back(to_vertex(scene.point(vertex)));
  }
  return fragment;
}

std::array<GridPoint, 3> plane_corners(const Scene& scene, PolygonId id) {
  const auto corners = scene.corners(id);
  const std::size_t count = corners.size();
  const auto at = [&](std::size_t i) -> const GridPoint& {
    return scene.point(corners[i % count]);
  };
  // A triangle has an area, so all its corners turn.
  if (count == 3) {
    return {scene.point(corners[0]), scene.point(corners[1]),
            scene.point(corners[2])};
  }
  // Never false: some corner turns, since a polygon has an area.
  for (std::size_t i = 0; i < count; ++i) {
    if (cross<54>(difference(at(i), at(i + 1)), difference(at(i), at(i + 2))) !=
        Vector3<Int128>{})
      return {at(i), at(i + 1), at(i + 2)};
  }
  HALFSPACE_ASSERT(false && "a polygon has an area");
  return {};
}

Plane plane_of(const Scene& scene, PolygonId id) {
  return with_grid(scene.grid_bits(), [&](auto bits) {
    return rounded(exact_plane<bits()>(plane_corners(scene, id)));
  });
}

std::vector<Plane> planes_of(const Scene& scene) {
  std::vector<Plane> planes(scene.polygon_count());
  for (std::size_t p = 0; p < planes.size(); ++p) {
    planes[p] = plane_of(scene, static_cast<PolygonId>(p));
  }
  return planes;
}

Side side_of(const Scene& scene, const Fragment& fragment, std::size_t k,
             PolygonId splitter, FilterStats& stats) {
  StandaloneFragment whole(scene, fragment, stats);
  whole.splitter().relation(whole.ref(), splitter,
                            filter_plane(plane_of(scene, splitter)));
  return static_cast<Side>(whole.splitter().sign_at(k));
}

Side side_of_eye(const Scene& scene, PolygonId splitter, const Camera& camera,
                 FilterStats& stats) {
  const int decided = with_grid(scene.grid_bits(), [&](auto bits) {
    return exact_eye_sign(exact_plane<bits()>(plane_corners(scene, splitter)),
                          camera.data());
  });
  ++stats.exact;
  stats.zero += decided == 0 ? 1 : 0;
  return static_cast<Side>(decided);
}

Relation relation(const Scene& scene, const Fragment& fragment,
                  PolygonId splitter, FilterStats& stats) {
  StandaloneFragment whole(scene, fragment, stats);
  return whole.splitter().relation(whole.ref(), splitter,
                                   filter_plane(plane_of(scene, splitter)));
}

FragmentName name_of(const Fragment& fragment) {
  return {fragment.source, rotated_to_least(fragment.edges)};
}

}  // namespace halfspace::fast
