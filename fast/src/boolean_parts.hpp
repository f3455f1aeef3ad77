#pragma once

#include <cstdint>
#include <vector>

#include "box_tree.hpp"
#include "halfspace/fast/solid.hpp"
#include "space.hpp"

/// What a boolean works on: which faces of the operands are near each other,
/// where their edges are cut, and what else they have in common.
namespace halfspace::fast {

/// An edge of an operand without direction, from `low` to `high` along `axis`.
struct LineEdge {
  std::int32_t low = 0;
  std::int32_t high = 0;
  std::int32_t axis = 0;
  std::int32_t plane = 0;   ///< of its first face
  std::int32_t other = -1;  ///< a second plane through it; -1: not known yet
  std::int32_t owner = 0;   ///< its first face, which reports what it meets
  std::uint32_t first_edge = 0;  ///< of the solid: the face's
  std::uint32_t first_use = 0;
  std::uint32_t use_count = 0;
};

/// A face at an edge. `forward`: it has the edge from low to high.
struct EdgeUse {
  std::int32_t face = 0;
  bool forward = false;
};

/// A point at which an edge meets a face of the other operand.
struct Cut {
  std::int32_t edge = 0;
  std::int32_t vertex = 0;
  std::int32_t face = 0;
  bool through = false;  ///< it passes through the face's interior there
};

/// A part of an edge that lies in a face of the other operand.
struct Cover {
  std::int32_t edge = 0;
  std::int32_t low = 0;
  std::int32_t high = 0;
  std::int32_t face = 0;
  bool left = false;     ///< the face is there on the left of the edge, as seen
  bool right = false;    ///< against its plane's normal; on the right
  bool on_edge = false;  ///< it has an edge there
};

/// A segment in the interiors of a face of either operand.
struct Trace {
  std::int32_t first = 0;   ///< the first operand's face
  std::int32_t second = 0;  ///< the second's
  std::int32_t low = 0;
  std::int32_t high = 0;
  std::int32_t axis = 0;
};

/// An operand of a boolean at work.
struct Operand {
  const Solid* solid = nullptr;
  std::vector<Box> boxes;               ///< by face
  Box box = kEmptyBox;                  ///< of all faces
  std::vector<std::int32_t> active;     ///< faces whose boxes meet other faces'
  std::vector<std::uint8_t> is_active;  ///< by face
  std::vector<std::uint8_t> touched;    ///< by face: it meets another
  std::vector<LineEdge> edges;          ///< of the active faces
  std::vector<EdgeUse> uses;            ///< by edge
  std::vector<std::int32_t> edge_of;  ///< by edge of the solid; -1: not active
  std::vector<Cut> cuts;
  std::vector<Cover> covers;
  /// By vertex of the space: on the other operand's surface.
  std::vector<std::uint8_t> on_other;

  const Face& face(std::int32_t f) const {
    return solid->faces[static_cast<std::size_t>(f)];
  }
  const SolidEdge* edges_of(std::int32_t f) const {
    return solid->edges.data() + face(f).first_edge;
  }
  LineEdge& edge(std::int32_t e) { return edges[static_cast<std::size_t>(e)]; }
  bool is_on_other(std::int32_t v) const {
    return static_cast<std::size_t>(v) < on_other.size() &&
           on_other[static_cast<std::size_t>(v)] != 0;
  }
  void put_on_other(std::int32_t v) {
    const auto at = static_cast<std::size_t>(v);
    if (at >= on_other.size()) on_other.resize(at + 1 + at / 2);
    on_other[at] = 1;
  }
};

/// The boxes of the operand's faces, rounded outwards.
void add_boxes(Operand& operand);

/// The pairs of faces whose boxes overlap; fills in `active`.
std::vector<std::pair<std::int32_t, std::int32_t>> near_pairs(Operand& a,
                                                              Operand& b);

/// Fills in the edges of the active faces.
void add_edges(Operand& operand, const Space& space);

/// A plane through the edge other than its first face's.
std::int32_t second_plane(LineEdge& edge, const Operand& operand, Space& space);

/// Whether a point off the operand's surface is inside: the vertex, or where
/// that does not tell, right beside it in the direction of `towards` (S6.2).
class Locator {
 public:
  Locator(const Operand& operand, const Space& space);
  bool is_inside(std::int32_t vertex, std::int32_t towards) const;

 private:
  bool is_above(std::int32_t face, std::int32_t vertex,
                std::int32_t towards) const;

  const Operand& operand_;
  const Space& space_;
  BoxTree tree_;
};

}  // namespace halfspace::fast
