#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "halfspace/bsp_tree.hpp"
#include "halfspace/fast/predicate.hpp"
#include "halfspace/fast/types.hpp"
#include "halfspace/progress.hpp"
#include "halfspace/region.hpp"

namespace halfspace::fast {

/// The plane of a node that divides nothing: a leaf.
constexpr PlaneId kNoPlane = -1;

/// The end of a list of fragments.
constexpr std::int32_t kNoFragment = -1;

/// A node of a tree (S3.1): a plane, two subtrees, and a list of fragments.
///
/// The fragments lie in the plane, in id order. A leaf has no plane and no
/// subtrees; its fragments are in any order.
struct Node {
  PlaneId splitter = kNoPlane;
  NodeId positive = kNoNode;
  NodeId negative = kNoNode;
  std::int32_t first_fragment = kNoFragment;
  Plane plane;  ///< the splitter in doubles
};

/// A fragment in a tree. Its edges and vertices are
/// `corners[first_corner]` and the `corner_count - 1` after it.
struct TreeFragment {
  PolygonId source = 0;
  std::uint32_t first_corner = 0;
  std::uint32_t corner_count : 31 = 0;
  /// Whether its source's positive side is the splitter's negative one.
  std::uint32_t flipped : 1 = 0;
  std::int32_t next = kNoFragment;  ///< the next in the node's list
};

/// A vertex of a fragment and the edge that leaves it.
struct Corner {
  /// The source corner that the edge leaves, or -1 - the plane that cut it.
  std::int32_t edge = 0;
  /// Below the scene's number of vertices one of them, exactly; from there on
  /// it counts the tree's cut vertices.
  std::int32_t vertex = 0;
  friend bool operator==(const Corner&, const Corner&) = default;
};

/// The fragments of a block.
struct BlockHead {
  std::array<float, 3> origin{};    ///< whole numbers; units: grid steps
  std::int32_t first_fragment = 0;  ///< the others follow it
  std::int32_t count = 0;           ///< of fragments
  /// A bit for each fragment that is its whole source, with its corners in
  /// their order, and exact.
  std::uint32_t whole = 0;
  friend bool operator==(const BlockHead&, const BlockHead&) = default;
};

/// Up to eight fragments of a leaf with `kCorners` corners each, in
/// structure-of-arrays form for render(). Units: grid steps.
template <std::size_t kCorners>
struct FragmentBlock : BlockHead {
  using Eight = std::array<float, 8>;
  /// Their corners less `origin`, one fragment after another.
  alignas(32) std::array<Eight, kCorners> x{};
  std::array<Eight, kCorners> y{};
  std::array<Eight, kCorners> z{};
  Eight error{};  ///< of each fragment's corners; 0: exact
  friend bool operator==(const FragmentBlock&, const FragmentBlock&) = default;
};

/// The indices of a node's first blocks.
struct FirstBlocks {
  std::int32_t triangles = 0;
  std::int32_t quadrangles = 0;
  friend bool operator==(const FirstBlocks&, const FirstBlocks&) = default;
};

/// Faces of regions, shared by a tree with the parts it is joined from.
using SlantedFaces = std::shared_ptr<const std::vector<RegionFace>>;

/// A tree of a scene; its root, if it has one, is the first node (S3.1).
///
/// Everything lies in arrays and is referred to by index, so that destroying a
/// deep tree needs no recursion.
struct BspTree {
  std::vector<Node> nodes;
  std::vector<TreeFragment> fragments;
  std::vector<Corner> corners;
  std::vector<Vertex> cut_vertices;
  std::vector<FreePlane> free_planes;
  /// None, or the faces of regions that free planes go by (kSlantedFace).
  SlantedFaces slanted;
  /// Empty, or for each node a box that holds all fragments of its subtree,
  /// rounded outwards.
  std::vector<Box> boxes;
  /// Empty, or copies of the triangles, then quadrangles, that the lists of
  /// leaves begin with, node by node.
  std::vector<FragmentBlock<3>> triangles;
  std::vector<FragmentBlock<4>> quadrangles;
  /// Empty, or for each node its blocks, and where the last end.
  std::vector<FirstBlocks> first_blocks;
  /// A list priority (S3.9): polygons that cover nothing are not in it.
  bool is_list = false;
};

/// The tree of the scene (S3.5; FAG83 sec. 2.2.1, Make_tree).
///
/// A pure function of its arguments; no recursion.
/// Requires: options.candidates >= 1.
/// Exact:    yes; the same tree as the reference's.
/// Cost:     n log n decisions a candidate where the splitters divide well;
///           the rules that compare all polygons square that.
BspTree build(const Scene& scene, const BuildOptions& options);
BspTree build(const Scene& scene, const BuildOptions& options,
              FilterStats& stats);
/// Without nodes if `progress` stopped it.
BspTree build(const Scene& scene, const BuildOptions& options,
              FilterStats& stats, const Progress& progress);

/// Adds polygon `polygon` of the scene to a tree that does not hold it yet
/// (S3.6; F2B "on-line").
///
/// Each part of it ends in the node whose plane it lies in, or in a new node
/// where the tree had none. A tree with boxes keeps them up to date.
/// Requires: a tree of this scene, without leaves.
void insert(BspTree& tree, const Scene& scene, PolygonId polygon);
void insert(BspTree& tree, const Scene& scene, PolygonId polygon,
            FilterStats& stats);

/// Takes polygons of the scene out of its tree, which may have leaves (S3.11).
///
/// Arrays hold nothing of them afterwards, but for free planes; boxes stay as
/// large as they were.
/// Requires: a tree of this scene, not of one with moving objects.
/// Cost:     linear in the tree, however many polygons go.
void remove(BspTree& tree, const Scene& scene,
            std::span<const PolygonId> polygons);

/// Whether some node of the tree is a leaf: only images, maps and rays take it.
bool has_leaves(const BspTree& tree);

/// Replaces every leaf by a subtree whose splitters are planes of its fragments
/// (S3.5), so that the tree can be walked fragment by fragment (S3.7), and
/// inserted into.
///
/// A pure function of its arguments.
/// Exact: yes.
/// Cost:  for a leaf of k fragments k log k decisions and bytes, at worst k^2.
void divide_leaves(BspTree& tree, const Scene& scene);

/// The size of the tree (S3.2). No recursion.
TreeStats stats(const BspTree& tree);

/// The tree by names alone (S3.1). No recursion.
TreeName name_of(const BspTree& tree);

}  // namespace halfspace::fast
