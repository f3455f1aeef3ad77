#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "camera/clip_function.hpp"
#include "exact/filter.hpp"
#include "halfspace/clip.hpp"
#include "halfspace/fast/types.hpp"
#include "tree/tree_reader.hpp"

namespace halfspace::fast {

/// Some of a frame's clip planes, a bit each.
using ClipMask = std::uint32_t;

/// What clip planes leave of something: nothing, or what the planes of the
/// mask have still to be asked about.
struct ClipState {
  bool is_gone = false;
  ClipMask mask = 0;
};

/// What clip planes leave of a fragment (S10.2).
struct ClippedFragment {
  bool is_gone = false;
  ClipMask cuts = 0;  ///< the planes that cut it, or may do so
  /// Its corners after the cuts; none where they are not known.
  std::span<const Vertex> corners;
};

/// The clip planes of a frame (S10.2): boxes and fragments against them.
class ClipSet {
 public:
  ClipSet(const std::vector<ClipPlane>& planes, bool has_caps, int grid_bits);
  /// The planes, of which this is the set in the world, in the frame of an
  /// object, whose scene has that grid.
  ClipSet moved(const ObjectMap& to_world, int grid_bits) const;

  bool empty() const { return planes_.empty(); }
  /// Whether polygons in the planes are not there (S10.3).
  bool has_caps() const { return has_caps_; }
  /// A plane, as it stands in the world.
  const ClipPlane& plane(std::size_t k) const { return (*exact_)[k]; }
  ClipMask all() const { return (ClipMask{1} << planes_.size()) - 1; }

  /// The state of all that is in a box.
  ClipState classify(const Box& box) const;

 private:
  friend class FragmentClipper;
  struct Filter {
    FilterPlane plane;
    double error = 0;  ///< how far rounding puts a value off
  };

  void add_filter(const Plane& plane, int grid_bits);
  int sign_at(std::size_t k, const GridPoint& p) const;

  const std::vector<ClipPlane>* exact_;
  std::vector<MovedClip> moved_;  ///< in the frame of an object, if in one
  std::vector<Filter> planes_;
  bool has_caps_;
  double rounding_;
};

/// The polygons of a tree that may cross a plane, each once, in order.
std::vector<PolygonId> crossing_polygons(const TreeReader& reader,
                                         const ClipPlane& plane);
/// The same for a set of one plane, in the frame of the tree.
std::vector<PolygonId> crossing_polygons(const TreeReader& reader,
                                         const ClipSet& plane);

/// Cuts fragments by clip planes: in doubles with bounds, corners of the scene
/// exactly.
class FragmentClipper {
 public:
  FragmentClipper(const ClipSet& set, const TreeReader& reader)
      : set_(set), reader_(reader) {}

  /// The fragment, cut by the planes of the mask. What is in it lasts until the
  /// next call.
  ClippedFragment clip(const TreeFragment& fragment, ClipMask mask);

 private:
  /// What a plane did: nothing is left, nothing is gone, it cut, or that is not
  /// known.
  enum class Cut { kGone, kWhole, kCut, kDoubt };
  struct At {
    Vertex vertex;
    std::int32_t index = -1;  ///< of a vertex of the scene, or -1
  };
  Cut cut(std::size_t plane);
  int sign_at_corner(std::size_t plane, const At& at, const Bounded& value);

  const ClipSet& set_;
  const TreeReader& reader_;
  std::vector<At> corners_;
  std::vector<At> next_;
  std::vector<Bounded> values_;
  std::vector<std::int8_t> signs_;
  std::vector<Vertex> result_;
};

}  // namespace halfspace::fast
