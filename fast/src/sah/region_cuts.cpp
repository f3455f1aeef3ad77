#include <algorithm>
#include <vector>

#include "sah/sah_builder.hpp"

namespace halfspace::fast {

/// A box that reaches both sides of a plane across an axis, by integers, is
/// that of a polygon that does, and what lies in a plane belongs to its
/// positive side: so a polygon on one side of all faces needs no other
/// decision.
void SahBuilder::cut_to(const CellRegion& region) {
  struct Face {
    std::size_t axis;
    int side;  ///< that is kept
    std::int64_t coordinate;
    Splitter splitter;
  };
  std::vector<Face> faces;
  const auto add_face = [&](std::size_t axis, int side,
                            std::int64_t coordinate) {
    job_.tree->free_planes.push_back(
        {static_cast<std::int32_t>(axis), coordinate});
    const auto id = static_cast<PlaneId>(state_.scene.polygon_count() +
                                         job_.tree->free_planes.size() - 1);
    faces.push_back({axis, side, coordinate, {id, {}, nullptr}});
  };
  for (std::size_t a = 0; a < 3; ++a) {
    if (region.low[a] != CellRegion::kNoLow) add_face(a, 1, region.low[a]);
    if (region.high[a] != CellRegion::kNoHigh) add_face(a, -1, region.high[a]);
  }
  for (Face& face : faces)
    face.splitter.plane =
        filter_plane(splitter_.planes().plane(face.splitter.id));
  job_.inherited_planes = faces.size();

  const std::array<double, 3> origin = to_doubles(state_.origin);
  std::size_t kept = 0;
  job_.box = kEmptyBox;
  for (Primitive primitive : primitives_) {
    const GridRange range = range_of(state_.scene, primitive.source);
    bool is_in = true;
    for (const Face& face : faces) {
      const std::int64_t low = range.low[face.axis];
      const std::int64_t high = range.high[face.axis];
      const bool reaches_negative = low < face.coordinate;
      const bool reaches_positive =
          high > face.coordinate || (low == face.coordinate && low == high);
      if (!(face.side > 0 ? reaches_negative : reaches_positive)) continue;
      is_in = keep_side(primitive, face.splitter, face.side);
      if (!is_in) break;
      const double at =
          static_cast<double>(face.coordinate) - origin[face.axis];
      float& inner =
          face.side > 0 ? primitive.low[face.axis] : primitive.high[face.axis];
      inner = face.side > 0 ? std::max(inner, float_below(at))
                            : std::min(inner, float_above(at));
    }
    if (!is_in) continue;
    primitives_[kept++] = primitive;
    extend(job_.box, primitive);
  }
  primitives_.resize(kept);
}

/// Makes the primitive what is of it on one side of a plane; false if nothing
/// is.
bool SahBuilder::keep_side(Primitive& primitive, const Splitter& splitter,
                           int side) {
  const std::size_t corners = job_.tree->corners.size();
  const FragmentRef part = fragment_of(primitive);
  const Relation relation =
      splitter_.relation(part, splitter.id, splitter.plane);
  if (relation == Relation::kSpanning) {
    const FragmentPair pair =
        splitter_.split(part, splitter.id, splitter.plane);
    primitive = primitive_of(
        primitive, side > 0 ? pair.positive : pair.negative, side, nullptr);
    return true;
  }
  job_.tree->corners.resize(corners);
  if (relation == Relation::kCoincident) return side > 0;
  return (relation == Relation::kPositive) == (side > 0);
}

}  // namespace halfspace::fast
