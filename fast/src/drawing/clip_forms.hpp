#pragma once

#include <cstdint>
#include <vector>

#include "drawing/scene_edges.hpp"
#include "drawing/sight.hpp"
#include "halfspace/clip.hpp"

namespace halfspace::fast {

struct Line;

/// The clip planes of a drawing, and what they do to polygons (S9.8).
class ClipForms {
 public:
  ClipForms(const Sight& sight, const std::vector<ClipPlane>& planes,
            bool caps);

  std::int32_t count() const {
    return static_cast<std::int32_t>(forms_.size());
  }
  const Form& form(std::int32_t k) const {
    return forms_[static_cast<std::size_t>(k)];
  }
  /// Whether there is a cap that what is kept may be behind.
  bool has_cap_in_front() const { return has_cap_in_front_; }

  /// Whether a plane passes through the inside of a polygon.
  bool is_cut_by(PolygonId polygon, std::int32_t k) const {
    return count() > 0 && (bits(polygon).cut >> k & 1) != 0;
  }
  /// Whether no corner of a polygon is on the positive side of a plane.
  bool is_removed_by(PolygonId polygon, std::int32_t k) const {
    return (bits(polygon).removed >> k & 1) != 0;
  }
  /// Whether anything of a polygon is left.
  bool leaves(PolygonId polygon) const {
    if (count() == 0) return true;
    const Bits& b = bits(polygon);
    return (b.removed & ~b.inside) == 0 && (!has_caps_ || b.inside == 0);
  }
  /// Whether an edge or intersection lies in a clip plane, and is not there.
  bool takes_away(const Line& line) const;

  /// The segments that polygons have in common with the planes. Not of those
  /// that are not `present`, but where the eye is before a cap.
  std::vector<Line> sections(const SceneEdges& edges,
                             const std::vector<bool>& present) const;

 private:
  struct Bits {
    std::uint8_t cut = 0;
    std::uint8_t removed = 0;
    std::uint8_t inside = 0;  ///< lies in the plane
  };
  const Bits& bits(PolygonId polygon) const {
    return bits_[static_cast<std::size_t>(polygon)];
  }
  void add_section(PolygonId polygon, std::int32_t k, const SceneEdges& edges,
                   std::vector<Line>& lines) const;

  const Sight& sight_;
  std::vector<Form> forms_;
  std::vector<Bits> bits_;
  bool has_caps_ = false;
  bool has_cap_in_front_ = false;
};

}  // namespace halfspace::fast
