#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "box/bvh.hpp"
#include "drawing/scene_edges.hpp"
#include "drawing/sight.hpp"

namespace halfspace::fast {

/// An edge with what is known of it for hiding.
struct Line {
  SpacePoint from;
  SpacePoint to;
  std::vector<PolygonId> polygons;  ///< those at it
  bool is_intersection = false;     ///< of the first two of them
};

/// What cuts an edge: an end of it, a limit of the view, or a polygon's side
/// (its number), plane or near limit.
enum class CutKind : std::int8_t { kFrom, kTo, kLimit, kSide, kPlane, kNear };

/// A place on an edge where a form is 0: the share of the edge, in space, up to
/// there.
struct Cut {
  double share = 0;
  double error = 0;
  CutKind kind = CutKind::kFrom;
  std::int32_t number = 0;  ///< of the limit or the side
  PolygonId polygon = -1;
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
  /// `eye_signs`: by polygon the sign of its plane at the eye, 0 if the
  /// polygon hides nothing.
  Hiding(Sight& sight, const SceneEdges& edges,
         std::vector<std::int8_t> eye_signs);

  /// The parts of an edge that are in the view, in order.
  /// Requires: its image is no single point.
  std::vector<Layered> parts_of(const Line& line);

  /// Whether a point is visible (S9.7).
  bool is_visible(const SpacePoint& p);

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
    std::int32_t left = 0;
    std::int32_t right = 0;
  };
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
  /// 1 if the plane through the eye and a polygon's side from `u` to `v`, which
  /// holds the edge, faces as the edge's own does, else -1.
  int side_of_parallel(const Line& line, VertexId u, VertexId v) const;
  /// Whether two cuts are by sides between the same two points.
  bool are_same_side(const Cut& f, const Cut& g) const;
  /// The sign at a point of a polygon's side seen from the eye, positive
  /// inside.
  int side_sign(const SpacePoint& p, PolygonId polygon, std::size_t side,
                Bounded& value);
  /// The sign at a point of how far it is behind a polygon's plane.
  int behind(const SpacePoint& p, PolygonId polygon, Bounded& value);
  bool is_hidden_by(const SpacePoint& p, PolygonId polygon);
  Ends side_ends(const Line& line, PolygonId polygon, std::size_t side);
  Box box_of(const SpacePoint& p) const;
  Box box_of(PolygonId polygon) const;

  Sight& sight_;
  const SceneEdges& edges_;
  std::vector<SpacePoint> points_;  ///< by vertex
  std::vector<std::int8_t> eye_signs_;
  std::optional<BoxTree> tree_;
  // Scratch.
  std::vector<Event> events_;
  /// What exact_cut() has worked out for the edge of parts_of(), by cut.
  std::unordered_map<std::uint64_t, ExactCut> exact_cuts_;
};

}  // namespace halfspace::fast
