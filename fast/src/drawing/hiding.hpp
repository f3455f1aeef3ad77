#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "box/bvh.hpp"
#include "drawing/clip_forms.hpp"
#include "drawing/scene_edges.hpp"
#include "drawing/sight.hpp"

namespace halfspace::fast {

/// An edge with what is known of it for hiding.
struct Line {
  SpacePoint from;
  SpacePoint to;
  std::vector<PolygonId> polygons;  ///< those at it
  bool is_intersection = false;     ///< of the first two of them
  /// The clip plane that the one polygon has the segment in common with; -1:
  /// none.
  std::int32_t clip = -1;
  /// The second clip plane of an edge at which caps meet (S9.8), `clip` being
  /// the first; -1: it is no such edge.
  std::int32_t other_clip = -1;
  bool is_whole = false;  ///< clip planes take nothing away
};

/// What cuts an edge: an end of it, a limit of the view, or a polygon's side
/// (its number), plane or near limit, a clip plane, where that cuts a polygon,
/// its near limit, or where it cuts the cap of another one.
enum class CutKind : std::int8_t {
  kFrom,
  kTo,
  kLimit,
  kSide,
  kPlane,
  kNear,
  kClip,
  kClipped,
  kClipNear,
  kClipMeet
};

/// A place on an edge where a form is 0: the share of the edge, in space, up to
/// there.
struct Cut {
  double share = 0;
  double error = 0;
  CutKind kind = CutKind::kFrom;
  /// Of the limit, the side or the clip plane; of two planes kMostClipPlanes
  /// times that with the cap and the other one.
  std::int32_t number = 0;
  PolygonId polygon = -1;

  bool is_same(const Cut& other) const {
    return kind == other.kind && number == other.number &&
           polygon == other.polygon;
  }
};

/// A part of an edge with one number of layers in front.
struct Layered {
  Cut from;
  Cut to;
  std::int32_t layers = 0;
};

/// What hides the edges of a scene (S9.4).
class Hiding {
 public:
  /// `eye_signs`: by polygon the sign of its plane at the eye.
  /// `hiders`: by polygon whether it hides anything.
  Hiding(Sight& sight, const SceneEdges& edges,
         std::vector<std::int8_t> eye_signs, const ClipForms& clips,
         const std::vector<bool>& hiders);

  /// The parts of an edge that are in the view, in order.
  /// Requires: its image is no single point.
  std::vector<Layered> parts_of(const Line& line);

  /// Whether a point is visible (S9.7, S9.8).
  bool is_visible(const SpacePoint& p, bool is_whole);

  /// The plane through the eye and an edge.
  Form plane_of(const Line& line) const;

  /// Whether the image of an edge is a single point.
  bool is_point(const Line& line);

  /// A form that is 0 at the cut.
  Form form_of(const Cut& cut) const;

  const SpacePoint& point(VertexId vertex) const {
    return points_[static_cast<std::size_t>(vertex)];
  }
  int eye_sign(PolygonId polygon) const {
    return eye_signs_[static_cast<std::size_t>(polygon)];
  }

 private:
  /// A change of the number of polygons in front, on the two sides of an edge.
  struct Event {
    Cut cut;
    std::int8_t left = 0;
    std::int8_t right = 0;
    // Of the winding number where the eye's rays pass the plane of a cap, and
    // of whether the cap may be there, beyond the near limit and within the
    // other clip planes.
    std::int8_t cap = 0;
    std::int8_t left_turns = 0;
    std::int8_t right_turns = 0;
    std::int8_t left_open = 0;
    std::int8_t right_open = 0;
    /// Of the winding number along an edge at which caps meet.
    std::int8_t solid = 0;
  };
  /// What the events up to some place on an edge add up to.
  struct Count {
    struct Cap {
      std::int32_t left_turns = 0, right_turns = 0;
      std::int32_t left_open = 0, right_open = 0;
    };
    std::int32_t left = 0, right = 0, solid = 0;
    std::array<Cap, kMostClipPlanes> caps = {};
    void add(const Event& event);
    /// The layers; of an edge at which caps meet kAbsent where they do not.
    std::int32_t layers(const Line& line, std::int32_t clips) const;
  };
  static constexpr std::int32_t kAbsent = -1;
  static constexpr auto kClips = static_cast<std::int32_t>(kMostClipPlanes);
  /// The signs of a form at both ends of an edge, and its values in doubles.
  struct Ends {
    int from = 0;
    int to = 0;
    Bounded from_value;
    Bounded to_value;
  };
  /// The sizes of a cut's form at an edge's ends.
  struct ExactCut {
    FormValue from;
    FormValue to;
  };
  static constexpr int kLeft = 1;
  static constexpr int kRight = 2;

  /// The order of two cuts along the edge of parts_of(): -1, 0 or 1.
  int compare(const Line& line, const Cut& f, const Cut& g);
  ExactCut exact_cut(const Line& line, const Cut& cut);
  template <class MakeForm>
  int decided(const Bounded& value, MakeForm&& form, const SpacePoint& p);
  /// Narrows a range by the half-line on which a form is positive; false if
  /// nothing is left. Where the form is 0 all along, it narrows nothing.
  bool narrow(const Line& line, const Ends& ends, Cut cut, Cut& low, Cut& high);
  bool in_view(const Line& line, Cut& low, Cut& high);
  void hide(const Line& line, const Cut& low, const Cut& high,
            PolygonId polygon);
  /// 1 if a plane through the eye that holds the edge faces as the edge's own
  /// does, else -1.
  int side_of_parallel(const Line& line, const Form& g) const;
  /// The ends of a form whose values doubles are not asked about.
  Ends exact_ends(const Line& line, const Form& form);
  /// Narrows a range to where a polygon's sides hold the edge, and `covered` to
  /// the sides of the edge on which they do; false if nothing is left.
  bool narrow_to_sides(const Line& line, PolygonId polygon, Cut& from, Cut& to,
                       int& covered);
  /// The same for what of a polygon is on a side of a clip plane.
  bool narrow_to_clip(const Line& line, PolygonId polygon, std::int32_t clip,
                      int side, Cut& from, Cut& to, int& covered);
  /// What clip planes leave of an edge (S9.8).
  bool narrow_to_kept(const Line& line, Cut& low, Cut& high);
  /// 1 where the eye is on the negative side of a cap's plane, else -1.
  int cap_side(std::int32_t cap) const {
    return clips_.has_cap_behind(cap) ? -1 : 1;
  }
  /// Positive at points whose sight rays meet the plane of a cap on the
  /// positive side of another clip plane.
  Form cap_limit(std::int32_t cap, std::int32_t other) const {
    const Form form = sight_.meet_form_of(clips_.form(cap), clips_.form(other));
    return cap_side(cap) > 0 ? -form : form;
  }
  /// Positive at points whose sight rays meet the plane of a cap beyond the
  /// near limit, if they meet it before the point.
  Form cap_near_limit(std::int32_t cap) const {
    const Form form = sight_.near_form_of(clips_.form(cap));
    return cap_side(cap) > 0 ? form : -form;
  }
  /// Narrows a range to where the other clip planes leave the cap of one, and
  /// `covered` as narrow_to_sides() does.
  bool narrow_to_cap(const Line& line, std::int32_t cap, Cut& from, Cut& to,
                     int& covered);
  /// The winding number that a polygon adds where rays pass a cap's plane.
  void turn(const Line& line, const Cut& low, const Cut& high, std::int32_t cap,
            PolygonId polygon);
  void find_cap(const Line& line, const Cut& low, const Cut& high,
                std::int32_t cap, const Box& box);
  /// Where caps meet along the line of two clip planes (S9.8).
  void find_corner(const Line& line, const Cut& low, const Cut& high);
  /// Whether two cuts are by sides between the same two points.
  bool are_same_side(const Cut& f, const Cut& g) const;
  /// The sign at a point of a polygon's side seen from the eye, positive
  /// inside.
  int side_sign(const SpacePoint& p, PolygonId polygon, std::size_t side,
                Bounded& value);
  /// The sign at a point of how far it is behind a polygon's plane.
  int behind(const SpacePoint& p, PolygonId polygon, Bounded& value);
  bool is_hidden_by(const SpacePoint& p, PolygonId polygon);
  /// Whether clip planes leave a polygon that hides a point, where it does.
  bool is_left_at(const SpacePoint& p, PolygonId polygon) const;
  bool has_area_left(PolygonId polygon) const;
  /// Whether a cap hides a point.
  bool is_behind_a_cap(const SpacePoint& p);
  bool is_behind_cap(const SpacePoint& p, std::int32_t cap);
  /// The sign of a form that holds the eye beside a point, at the image's
  /// sample there (S4.4).
  int sign_at_sample(const Form& form, const SpacePoint& p) const;
  /// The winding number that a polygon adds where a point's ray passes a cap's
  /// plane.
  int turns_at(const SpacePoint& p, std::int32_t cap, PolygonId polygon);
  Ends side_ends(const Line& line, PolygonId polygon, std::size_t side);
  Box box_of(const SpacePoint& p) const;
  Box box_of(PolygonId polygon) const;

  Sight& sight_;
  const SceneEdges& edges_;
  std::vector<SpacePoint> points_;  ///< by vertex
  std::vector<std::int8_t> eye_signs_;
  const ClipForms& clips_;
  std::optional<BoxTree> tree_;
  std::optional<BoxTree> cap_tree_;  ///< of all that caps in front are made of
  // Scratch.
  std::vector<Event> events_;
  /// What exact_cut() has worked out for the edge of parts_of(), by cut.
  std::unordered_map<std::uint64_t, ExactCut> exact_cuts_;
};

}  // namespace halfspace::fast
