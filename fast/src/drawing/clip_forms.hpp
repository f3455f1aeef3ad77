#pragma once

#include <cstdint>
#include <vector>

#include "drawing/scene_edges.hpp"
#include "drawing/sight.hpp"
#include "halfspace/clip.hpp"

namespace halfspace::fast {

struct Line;

/// Whether drawings have the edges at which caps meet: not in a module for the
/// web, of whose size that is a kilobyte.
#if defined(__wasm__)
constexpr bool kCornersOfCaps = false;
#else
constexpr bool kCornersOfCaps = true;
#endif
/// Whether sections have given points, and whole lines (S9.8): the same holds.
constexpr bool kGivenInSections = kCornersOfCaps;

/// The clip planes of a drawing, and what they do to polygons (S9.8).
class ClipForms {
 public:
  /// `behind`: whether caps that all that is kept is before are asked about.
  ClipForms(const Sight& sight, const std::vector<ClipPlane>& planes, bool caps,
            bool behind);

  /// A polygon that the line of two clip planes crosses, moved by nothing into
  /// what they keep, and how the winding number changes from the line's first
  /// end on.
  struct Crossing {
    PolygonId polygon = -1;
    int turns = 0;
  };

  std::int32_t count() const {
    return static_cast<std::int32_t>(forms_.size());
  }
  const Form& form(std::int32_t k) const {
    return forms_[static_cast<std::size_t>(k)];
  }
  /// Whether there is a cap that what is kept may be behind.
  bool has_cap_in_front() const { return caps_in_front_ != 0; }
  bool has_cap_in_front(std::int32_t k) const {
    return (caps_in_front_ >> k & 1) != 0;
  }
  /// Whether there is a cap that is before what a whole line has on the
  /// negative side alone.
  bool has_cap_behind(std::int32_t k) const {
    return (caps_behind_ >> k & 1) != 0;
  }
  bool has_caps() const { return (caps_in_front_ | caps_behind_) != 0; }
  /// Whether a polygon may be beyond the cap of a plane for the eye.
  bool is_beyond(PolygonId polygon, std::int32_t k) const {
    const Bits& b = bits(polygon);
    const int beyond = has_cap_behind(k) ? b.removed | b.cut : ~b.removed;
    return (beyond >> k & 1) != 0;
  }
  bool is_beyond_caps(PolygonId polygon) const {
    if (!has_caps()) return false;
    const Bits& b = bits(polygon);
    return (caps_in_front_ & ~b.removed) != 0 ||
           (caps_behind_ & (b.removed | b.cut)) != 0;
  }

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

  /// The lines along which caps meet, from end to end of the box round the
  /// scene, made one grid step larger on all sides.
  std::vector<Line> corners(bool cull) const;
  /// The polygons that such a line crosses.
  std::vector<Crossing> crossings(const Line& line) const;

 private:
  struct Bits {
    std::uint8_t cut = 0;
    std::uint8_t removed = 0;
    std::uint8_t inside = 0;  ///< lies in the plane
    std::uint8_t kept = 0;    ///< all corners are on the positive side
  };
  const Bits& bits(PolygonId polygon) const {
    return bits_[static_cast<std::size_t>(polygon)];
  }
  void add_section(PolygonId polygon, std::int32_t k, const SceneEdges& edges,
                   std::vector<Line>& lines) const;
  bool is_there(const Line& section) const;
  /// Whether a plane holds both ends of a line.
  bool holds(std::int32_t k, const Line& line) const;
  /// Whether another plane that holds the line takes all beside it away.
  bool is_cut_off(const Line& corner) const;

  const Sight& sight_;
  std::vector<Form> forms_;
  std::vector<Bits> bits_;
  bool has_caps_ = false;
  std::uint32_t caps_in_front_ = 0;  ///< by bit
  std::uint32_t caps_behind_ = 0;
};

}  // namespace halfspace::fast
