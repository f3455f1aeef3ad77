#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "camera/edge_function.hpp"
#include "halfspace/fast/predicate.hpp"
#include "raster/frame.hpp"

namespace halfspace::fast {

/// Which of two fragments of a leaf is nearer at a pixel (S5.3): by their
/// depths in doubles, else by their planes, else exactly.
template <int kBits>
class LeafDepth {
 public:
  LeafDepth(const Frame& frame, const TileView& screen)
      : frame_(frame),
        farthest_(std::max(screen.columns.end, screen.lines.end)),
        seen_(kSeen),
        depths_(kSeen) {}

  /// Begins a fragment, of that block if it is in one; the eye is on side
  /// `eye_sign` of its source.
  void start(const TreeFragment& fragment, int eye_sign,
             const BlockHead* block);

  /// ExactFallback::nearer(), for the fragment.
  void nearer(PolygonId other, std::int32_t x, std::int32_t y,
              std::uint32_t* lit);

  /// The fragment's depth, as of depth_of().
  const DepthDifference& depth() { return *depth(fragment_->source); }

  /// Forgets what is known of polygons: the view is another one from now on.
  void forget();

  const FilterStats& stats() const { return stats_; }

 private:
  /// How the fragment lies to a polygon that it contests pixels with.
  struct Rival {
    PolygonId polygon = kBackground;
    std::uint32_t serial = 0;  ///< of the fragment
    bool by_depths = false;    ///< planes may decide more
    DepthDifference line;      ///< positive where the fragment is nearer
  };
  /// Polygons that were drawn lately: what each changes, and apart from it, to
  /// keep that near, what few are asked for.
  struct Seen {
    PolygonId polygon = kBackground;
    bool has_plane = false;
    bool has_depth = false;
    const TreeFragment* fragment = nullptr;  ///< of the polygon, if known
    const BlockHead* block = nullptr;        ///< the fragment's, if it has one
  };
  struct Depths {
    ApproximateProjection plane;
    DepthDifference depth;  ///< of the fragment
  };
  static constexpr std::size_t kSeen = 512;
  static std::size_t place_of(PolygonId polygon) {
    return static_cast<std::size_t>(polygon) % kSeen;
  }

  bool is_nearer(Rival& entry, std::int32_t i, std::int32_t j);
  Rival& rival(PolygonId other);
  void collect_corners(const Seen& entry);
  const DepthDifference* depth(PolygonId polygon);
  bool compare_depths(Rival& entry);
  void compare_planes(Rival& entry);
  const ApproximateProjection& seen(PolygonId polygon);
  Plane plane_of(PolygonId polygon, const TreeFragment* fragment) const;

  const Frame& frame_;
  std::int32_t farthest_;
  const TreeFragment* fragment_ = nullptr;
  int eye_sign_ = 0;
  std::uint32_t serial_ = 0;
  std::array<Rival, 16> rivals_;
  std::vector<Seen> seen_;
  std::vector<Depths> depths_;
  std::vector<Vertex> corners_;  ///< of a fragment
  FilterStats stats_;
};

extern template class LeafDepth<kMovedGrid>;
extern template class LeafDepth<26>;
extern template class LeafDepth<40>;
extern template class LeafDepth<54>;

}  // namespace halfspace::fast
