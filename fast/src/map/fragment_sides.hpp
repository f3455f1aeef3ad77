#pragma once

#include <span>
#include <vector>

#include "map/cell_tree.hpp"
#include "map/line_table.hpp"
#include "raster/clip_set.hpp"

namespace halfspace::fast {

/// The sides of fragments in the image (S4.5), by their lines.
class FragmentSides {
 public:
  FragmentSides(const TreeReader& reader, const CameraData& camera,
                LineTable& lines)
      : reader_(reader), camera_(camera), lines_(lines) {}

  /// Requires: the eye is on side `eye_sign` of the fragment's source.
  std::span<const HalfPlane> of(const TreeFragment& fragment, int eye_sign) {
    sides_.clear();
    const auto source = reader_.scene().corners(fragment.source);
    for (const Corner& corner : reader_.corners(fragment)) {
      if (is_source(corner.edge)) {
        const auto k = static_cast<std::size_t>(corner.edge);
        const VertexId p = source[k];
        const VertexId q = source[k + 1 == source.size() ? 0 : k + 1];
        sides_.push_back(p < q ? HalfPlane{lines_.edge(p, q), eye_sign}
                               : HalfPlane{lines_.edge(q, p), -eye_sign});
      } else {
        const PlaneId splitter = splitter_of(corner.edge);
        sides_.push_back({lines_.meet(fragment.source, splitter),
                          eye_sign * reader_.side_of(fragment, splitter)});
      }
    }
    if (camera_.near)
      sides_.push_back({lines_.near(fragment.source), eye_sign});
    return sides_;
  }

 private:
  const TreeReader& reader_;
  const CameraData& camera_;
  LineTable& lines_;
  std::vector<HalfPlane> sides_;
};

/// Adds what the clip planes of the mask leave of a polygon (S10.2) to its
/// sides; false where caps take it away (S10.3).
///
/// Requires: the table has the clip planes of the set.
inline bool add_clips(const ClipSet& clips, ClipMask mask, PolygonId source,
                      int eye_sign, LineTable& lines,
                      std::vector<HalfPlane>& sides) {
  for (std::size_t k = 0; mask >> k != 0; ++k) {
    if ((mask >> k & 1u) == 0) continue;
    const LineId line = lines.meet(source, plane_id_of_clip(k));
    if (!lines.is_zero(line)) {
      sides.push_back({line, eye_sign});
    } else if (clips.has_caps()) {
      return false;
    }
  }
  return true;
}

}  // namespace halfspace::fast
