#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "halfspace/assert.hpp"
#include "halfspace/fast/build.hpp"
#include "tree/scene_planes.hpp"

namespace halfspace::fast {

/// A fragment that is in no list of the tree yet: `count` corners of the
/// tree's array, from `first` on.
struct FragmentRef {
  PolygonId source = 0;
  std::uint32_t first = 0;
  std::uint32_t count = 0;
};

/// Adds a fragment to the tree's array, in no list yet; its index.
inline std::int32_t add_fragment(BspTree& tree, const FragmentRef& fragment,
                                 bool flipped) {
  HALFSPACE_ASSERT(fragment.count <= kMostCornersOfFragment);
  tree.fragments.push_back({fragment.source, fragment.first,
                            fragment.count & kMostCornersOfFragment,
                            flipped ? 1u : 0u, kNoFragment});
  return static_cast<std::int32_t>(tree.fragments.size()) - 1;
}

/// Whether two planes that are the same point set have opposite normals.
///
/// Products of parallel vectors' components all have one sign, so their sum in
/// doubles has it too.
inline bool opposed(const Plane& p, const Plane& q) {
  return p.a * q.a + p.b * q.b + p.c * q.c < 0;
}

/// The two fragments that a plane makes of one.
struct FragmentPair {
  FragmentRef positive;
  FragmentRef negative;
};

/// Decides and splits the fragments of a growing tree. All builders call this,
/// and so do the public side_of(), relation() and split().
class FragmentSplitter {
 public:
  FragmentSplitter(const Scene& scene, BspTree& tree, FilterStats& stats)
      : FragmentSplitter(scene, tree, stats, ScenePlanes(scene, tree)) {}
  /// `most`: as of ScenePlanes.
  FragmentSplitter(const Scene& scene, BspTree& tree, FilterStats& stats,
                   double most)
      : FragmentSplitter(scene, tree, stats, ScenePlanes(scene, tree, most)) {}

  const ScenePlanes& planes() const { return planes_; }

  /// The whole polygon; its corners are added to the tree.
  FragmentRef whole(PolygonId polygon);

  /// The fragment against the plane (S2.1). Keeps the signs for split().
  Relation relation(const FragmentRef& fragment, PlaneId id,
                    const FilterPlane& plane);
  /// The sign at vertex `k` that the last relation() found (S1.5).
  int sign_at(std::size_t k) const { return signs_[k]; }

  /// Splits the fragment along the plane (S2.3).
  /// Requires: the last call was relation(fragment, id, plane), and the answer
  ///           was kSpanning.
  FragmentPair split(const FragmentRef& fragment, PlaneId id,
                     const FilterPlane& plane);

  Vertex vertex(std::int32_t index) const {
    if (index >= vertex_count_) {
      return tree_
          .cut_vertices[static_cast<std::size_t>(index - vertex_count_)];
    }
    return to_vertex(planes_.scene().point(index));
  }

 private:
  FragmentSplitter(const Scene& scene, BspTree& tree, FilterStats& stats,
                   const ScenePlanes& planes)
      : planes_(planes),
        vertex_count_(static_cast<std::int32_t>(scene.data().vertices.size())),
        tree_(tree),
        stats_(stats) {}

  int exact_sign(const FragmentRef& fragment, std::size_t k, PlaneId id);
  std::int32_t add_crossing(const FragmentRef& fragment, std::size_t k,
                            const FilterPlane& plane);
  FragmentRef add(PolygonId source, const std::vector<Corner>& corners);

  ScenePlanes planes_;
  std::int32_t vertex_count_;
  BspTree& tree_;
  FilterStats& stats_;
  std::vector<std::int8_t> signs_;
  std::vector<Bounded> values_;
  std::array<std::vector<Corner>, 2> new_corners_;
};

/// A public fragment, as FragmentSplitter reads it: in a tree of its own.
class StandaloneFragment {
 public:
  StandaloneFragment(const Scene& scene, const Fragment& fragment,
                     FilterStats& stats);

  FragmentSplitter& splitter() { return splitter_; }
  const FragmentRef& ref() const { return ref_; }
  /// The public form of what the splitter made.
  Fragment fragment_of(const FragmentRef& ref) const;

 private:
  BspTree tree_;
  FragmentSplitter splitter_;
  FragmentRef ref_;
};

/// Lays the corners out in the order of the fragments, without those of
/// fragments that were split.
void drop_unused_corners(BspTree& tree);

}  // namespace halfspace::fast
