#include "halfspace/fast/image/depth_sort.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "halfspace/assert.hpp"
#include "tree/behind_test.hpp"
#include "tree/depth_sort/image_extent.hpp"
#include "tree/eye_classifier.hpp"
#include "tree/fragment_splitter.hpp"
#include "tree/scene_planes.hpp"

namespace halfspace::fast {
namespace {

/// Of a scene's own points: on a fine grid it may be small.
Extent extent_of(const Scene& scene) {
  Extent extent = extent_of_grid(scene.grid_bits());
  extent.most = largest_coordinate(scene);
  return extent;
}

/// A fragment that is not listed yet.
struct Unlisted {
  FragmentRef fragment;
  ImageExtent extent;
};

class DepthSorter {
 public:
  DepthSorter(const Scene& scene, const Camera& camera)
      : view_(make_view(camera, extent_of(scene))),
        splitter_(scene, result_.list, result_.decisions,
                  largest_coordinate(scene)),
        reader_(scene, result_.list) {
    const EyeClassifier side_of_eye(reader_, view_, camera.data(),
                                    result_.decisions);
    const BehindTest behind(reader_, view_, camera.data());
    for (std::size_t p = 0; p < scene.polygon_count(); ++p) {
      const auto id = static_cast<PolygonId>(p);
      planes_.push_back(splitter_.planes().plane(id));
      eye_sides_.push_back(side_of_eye(planes_.back(), id));
      // What is in a plane through the eye, in one that no ray meets, or behind
      // the eye, covers nothing.
      const int eye = eye_sides_.back();
      if (eye == 0 || behind(planes_.back(), id, eye, -eye)) continue;
      const Unlisted polygon = unlisted_of(splitter_.whole(id));
      if (view_.perspective && polygon.extent.depth_high <= 0) continue;
      sorted_.push_back(polygon);
    }
    std::stable_sort(sorted_.begin(), sorted_.end(), is_nearer);
  }

  DepthSort run() {
    while (!sorted_.empty() || !marked_.empty()) {
      take_last();
      const std::optional<std::size_t> m = marked_in_the_way();
      const std::optional<std::size_t> q =
          m ? std::nullopt : sorted_in_the_way();
      if (m) {
        break_cycle(*m);
      } else if (!q) {
        listed_.push_back(last_.fragment);
        marked_are_passed_ = false;
      } else if (is_behind(sorted_[*q].fragment, last_.fragment) ||
                 is_before(last_.fragment, sorted_[*q].fragment)) {
        move_to_end(*q);
      } else {
        const Unlisted other = sorted_[*q];
        sorted_.erase(sorted_.begin() + static_cast<std::ptrdiff_t>(*q));
        cut_either(other);
      }
    }
    make_chain();
    return std::move(result_);
  }

 private:
  static bool is_nearer(const Unlisted& a, const Unlisted& b) {
    return a.extent.depth_high < b.extent.depth_high;
  }

  const Plane& plane(const FragmentRef& f) const {
    return planes_[static_cast<std::size_t>(f.source)];
  }
  int eye_side(const FragmentRef& f) const {
    return eye_sides_[static_cast<std::size_t>(f.source)];
  }
  /// Of a fragment to the plane of another. While some are marked, the same
  /// pairs are asked for again and again, and kept.
  Relation relation(const FragmentRef& f, const FragmentRef& to) {
    const auto found = [&] {
      return splitter_.relation(f, to.source, filter_plane(plane(to)));
    };
    if (marked_.empty()) return found();
    if (relations_.size() == kMostRelations) relations_.clear();
    const auto [known, is_new] =
        relations_.try_emplace({f.first, to.source}, Relation::kSpanning);
    if (is_new) known->second = found();
    return known->second;
  }

  Unlisted unlisted_of(const FragmentRef& fragment) const {
    Unlisted unlisted{fragment, {}};
    for (std::uint32_t k = 0; k < fragment.count; ++k) {
      const Corner& corner = result_.list.corners[fragment.first + k];
      const Vertex v = splitter_.vertex(corner.vertex);
      extend(unlisted.extent, image_of_vertex(view_, v), k == 0);
    }
    return unlisted;
  }

  void outline_of(const FragmentRef& fragment, ImageOutline& outline) const {
    outline.corners.clear();
    outline.error = 0;
    for (std::uint32_t k = 0; k < fragment.count; ++k) {
      const Corner& corner = result_.list.corners[fragment.first + k];
      const ImageOfVertex image =
          image_of_vertex(view_, splitter_.vertex(corner.vertex));
      outline.corners.push_back({corner.vertex, image.x, image.y});
      outline.error = std::max(outline.error, image.error);
    }
  }

  /// Whether `p` is on the far side of `q`'s plane, or in it and not lower.
  bool is_behind(const FragmentRef& p, const FragmentRef& q) {
    const Relation found = relation(p, q);
    if (found == Relation::kCoincident) return p.source >= q.source;
    return found ==
           (eye_side(q) > 0 ? Relation::kNegative : Relation::kPositive);
  }

  /// Whether `q` is on the eye's side of `p`'s plane.
  bool is_before(const FragmentRef& q, const FragmentRef& p) {
    return relation(q, p) ==
           (eye_side(p) > 0 ? Relation::kPositive : Relation::kNegative);
  }

  bool have_apart_images(const Unlisted& p, const Unlisted& q) {
    if (!p.extent.is_bounded() || !q.extent.is_bounded()) return false;
    outline_of(p.fragment, outlines_[0]);
    outline_of(q.fragment, outlines_[1]);
    return separates(outlines_[0], outlines_[1]) ||
           separates(outlines_[1], outlines_[0]);
  }

  /// Step 1: whether the last one may be listed before `q`, whose depths are
  /// not all less. Doubles that do not tell leave it to the planes.
  bool last_may_precede(const Unlisted& q) {
    if (last_.extent.is_apart_from(q.extent)) return true;
    ++result_.pairs;
    return is_behind(last_.fragment, q.fragment) ||
           is_before(q.fragment, last_.fragment) || have_apart_images(last_, q);
  }

  /// The marked ones come last, the one that was marked last of all at the end.
  void take_last() {
    std::vector<Unlisted>& from = marked_.empty() ? sorted_ : marked_;
    last_is_marked_ = !marked_.empty();
    last_ = from.back();
    from.pop_back();
  }

  /// Step 2: a fragment that the last one may hide. Sorted ones before the
  /// first whose depths are all less have lesser depths still.
  std::optional<std::size_t> marked_in_the_way() {
    if (marked_are_passed_) return std::nullopt;
    for (std::size_t q = marked_.size(); q-- > 0;) {
      const ImageExtent& extent = marked_[q].extent;
      if (extent.depth_high >= last_.extent.depth_low &&
          !last_may_precede(marked_[q]))
        return q;
    }
    return std::nullopt;
  }
  std::optional<std::size_t> sorted_in_the_way() {
    for (std::size_t q = sorted_.size(); q-- > 0;) {
      if (sorted_[q].extent.depth_high < last_.extent.depth_low) break;
      if (!last_may_precede(sorted_[q])) return q;
    }
    return std::nullopt;
  }

  /// Puts the last one back.
  void put_last_back() {
    if (last_is_marked_) {
      marked_.push_back(last_);
    } else {
      put_sorted(last_);
    }
  }

  void put_sorted(const Unlisted& unlisted) {
    const auto place =
        std::upper_bound(sorted_.begin(), sorted_.end(), unlisted, is_nearer);
    sorted_.insert(place, unlisted);
  }

  /// Step 3.
  void move_to_end(std::size_t q) {
    put_last_back_before(q);
    ++result_.moves;
    marked_are_passed_ = false;
  }

  void put_last_back_before(std::size_t q) {
    const Unlisted moved = sorted_[q];
    sorted_.erase(sorted_.begin() + static_cast<std::ptrdiff_t>(q));
    put_last_back();
    marked_.push_back(moved);
  }

  /// Step 4: the marked fragment `m` is to come first, but has been before.
  void break_cycle(std::size_t m) {
    const Unlisted other = marked_[m];
    marked_.erase(marked_.begin() + static_cast<std::ptrdiff_t>(m));
    if (relation(last_.fragment, other.fragment) == Relation::kSpanning ||
        relation(other.fragment, last_.fragment) == Relation::kSpanning) {
      cut_either(other);
      return;
    }
    marked_.insert(marked_.begin() + static_cast<std::ptrdiff_t>(m), other);
    put_last_back();
    for (std::size_t a = 0; a < marked_.size(); ++a) {
      for (std::size_t b = 0; b < marked_.size(); ++b) {
        if (relation(marked_[a].fragment, marked_[b].fragment) !=
            Relation::kSpanning)
          continue;
        const Unlisted cut_one = marked_[a];
        const Unlisted by = marked_[b];
        marked_.erase(marked_.begin() + static_cast<std::ptrdiff_t>(a));
        add_parts(cut_one.fragment, by.fragment);
        unmark_all();
        return;
      }
    }
    // The images touch, and doubles did not tell: there is no cycle.
    take_hindmost();
  }

  /// Cuts the last one by the other's plane, or that by the last one's.
  void cut_either(const Unlisted& other) {
    if (relation(last_.fragment, other.fragment) == Relation::kSpanning) {
      add_parts(last_.fragment, other.fragment);
      put_sorted(other);
    } else {
      add_parts(other.fragment, last_.fragment);
      put_sorted(last_);
    }
    unmark_all();
  }

  void add_parts(const FragmentRef& fragment, const FragmentRef& by) {
    const FilterPlane filter = filter_plane(plane(by));
    const Relation found = splitter_.relation(fragment, by.source, filter);
    HALFSPACE_ASSERT(found == Relation::kSpanning);
    static_cast<void>(found);
    const FragmentPair parts = splitter_.split(fragment, by.source, filter);
    put_sorted(unlisted_of(parts.negative));
    put_sorted(unlisted_of(parts.positive));
    ++result_.cuts;
  }

  void unmark_all() {
    for (const Unlisted& each : marked_) put_sorted(each);
    marked_.clear();
    marked_are_passed_ = false;
  }

  /// Makes one the last that is in front of no other marked one. None spans
  /// another's plane, so that a tree of these planes cuts nothing: the way to
  /// its far end.
  void take_hindmost() {
    std::vector<std::size_t> left(marked_.size());
    for (std::size_t k = 0; k < left.size(); ++k) left[k] = k;
    std::size_t hindmost = 0;
    while (!left.empty()) {
      const std::size_t root = left.front();
      hindmost = root;
      std::vector<std::size_t> far;
      for (const std::size_t k : left) {
        const FragmentRef& f = marked_[k].fragment;
        const Relation found = relation(f, marked_[root].fragment);
        if (found == Relation::kCoincident) {
          if (f.source > marked_[hindmost].fragment.source) hindmost = k;
        } else if (is_behind(f, marked_[root].fragment)) {
          far.push_back(k);
        }
      }
      left = std::move(far);
    }
    std::swap(marked_[hindmost], marked_.back());
    marked_are_passed_ = true;
  }

  /// The list as a tree: each fragment's node is the far child of the one in
  /// front of it.
  void make_chain() {
    BspTree& tree = result_.list;
    tree.is_list = true;
    for (std::size_t k = listed_.size(); k-- > 0;) {
      const FragmentRef& fragment = listed_[k];
      Node node;
      node.splitter = fragment.source;
      node.plane = plane(fragment);
      node.first_fragment = add_fragment(tree, fragment, false);
      const NodeId next =
          k > 0 ? static_cast<NodeId>(tree.nodes.size()) + 1 : kNoNode;
      (eye_side(fragment) > 0 ? node.negative : node.positive) = next;
      tree.nodes.push_back(node);
    }
    drop_unused_corners(tree);
  }

  DepthSort result_;
  const View view_;
  FragmentSplitter splitter_;
  TreeReader reader_;
  std::vector<Plane> planes_;   ///< by polygon
  std::vector<int> eye_sides_;  ///< by polygon
  /// Those not listed: by their greatest depth, and those that took others'
  /// places, in that order.
  std::vector<Unlisted> sorted_;
  std::vector<Unlisted> marked_;
  Unlisted last_;
  bool last_is_marked_ = false;
  bool marked_are_passed_ = false;   ///< the last one is behind all marked ones
  std::vector<FragmentRef> listed_;  ///< back to front
  std::array<ImageOutline, 2> outlines_;
  /// By a fragment's first corner and a polygon. So many take 8 MB; without a
  /// limit 6,000 triangles that cross took 75 MB, and no less time.
  static constexpr std::size_t kMostRelations = std::size_t{1} << 17;
  std::map<std::pair<std::uint32_t, PolygonId>, Relation> relations_;
};

}  // namespace

DepthSort depth_sort(const Scene& scene, const Camera& camera) {
  return DepthSorter(scene, camera).run();
}

}  // namespace halfspace::fast
