#include "raster/leaf_depth.hpp"

#include <algorithm>
#include <bit>

#include "raster/depth_line.hpp"

namespace halfspace::fast {

template <int kBits>
void LeafDepth<kBits>::start(const TreeFragment& fragment, int eye_sign,
                             const BlockHead* block) {
  fragment_ = &fragment;
  eye_sign_ = eye_sign;
  ++serial_;
  Seen& seen = seen_[place_of(fragment.source)];
  if (seen.polygon != fragment.source) {
    seen.polygon = fragment.source;
    seen.has_plane = false;
    seen.fragment = nullptr;
  }
  if (seen.fragment == &fragment && seen.block == block) return;
  seen.fragment = &fragment;
  seen.block = block;
  seen.has_depth = false;
}

/// Whether the fragment is nearer than another at the sample (S5.3), exactly:
/// the planes' order along the ray is the sign of the line they meet in. Where
/// they are one plane the order is that of ids, everywhere.
template <int kBits>
bool LeafDepth<kBits>::is_nearer(Rival& entry, std::int32_t i, std::int32_t j) {
  ++stats_.exact;
  const PolygonId other = entry.polygon;
  const ScenePlanes& planes = frame_.reader.planes();
  const auto here = projected(planes.exact<kBits>(fragment_->source),
                              exact_camera<kBits>(frame_), frame_.view.samples);
  const auto there =
      projected(planes.exact<kBits>(other), exact_camera<kBits>(frame_),
                frame_.view.samples);
  const int order = meet_function<kBits>(here, there).sign_at_sample(i, j) *
                    eye_sign_ * sign(there.eye);
  if (order != 0) return order > 0;
  const bool is_lower = fragment_->source < other;
  entry.line = {0, 0, is_lower ? 1.0 : -1.0, 0};
  return is_lower;
}

/// The plane of a polygon, from the corners of its fragment if that is all of
/// the triangle: the scene's own lists are far from here.
template <int kBits>
Plane LeafDepth<kBits>::plane_of(PolygonId polygon,
                                 const TreeFragment* fragment) const {
  const Scene& scene = frame_.reader.scene();
  const auto count = static_cast<std::int32_t>(scene.data().vertices.size());
  std::array<GridPoint, 3> points;
  std::size_t k = 0;
  if (fragment != nullptr && fragment->corner_count == 3) {
    for (const Corner& corner : frame_.reader.corners(*fragment)) {
      if (corner.edge != static_cast<EdgeCode>(k) || corner.vertex >= count) {
        break;
      }
      points[k++] = scene.point(corner.vertex);
    }
  }
  if constexpr (kBits != kMovedGrid) {
    if (k == 3) return rounded(exact_plane<kBits>(points));
  }
  return frame_.reader.planes().plane(polygon);
}

template <int kBits>
const ApproximateProjection& LeafDepth<kBits>::seen(PolygonId polygon) {
  const std::size_t at = place_of(polygon);
  Seen& entry = seen_[at];
  if (entry.polygon != polygon) entry = {.polygon = polygon};
  ApproximateProjection& plane = depths_[at].plane;
  if (!entry.has_plane) {
    entry.has_plane = true;
    plane =
        project_approximately(plane_of(polygon, entry.fragment), frame_.view);
  }
  return plane;
}

/// Collects the corners of the entry's fragment, from its block if it has one:
/// that is near.
template <int kBits>
void LeafDepth<kBits>::collect_corners(const Seen& entry) {
  corners_.clear();
  const TreeFragment& fragment = *entry.fragment;
  const auto add = [&](const auto& block) {
    const auto k =
        static_cast<std::size_t>(&fragment - frame_.reader.fragments_of(block));
    for (std::size_t c = 0; c < block.x.size(); ++c) {
      corners_.push_back(corner_of(block, c, k));
    }
  };
  if (entry.block == nullptr) {
    for (const Corner& corner : frame_.reader.corners(fragment)) {
      corners_.push_back(frame_.reader.vertex(corner.vertex));
    }
  } else if (fragment.corner_count == 3) {
    add(block_of<3>(*entry.block));
  } else {
    add(block_of<4>(*entry.block));
  }
}

/// The depth of a fragment of the leaf, if it is known.
template <int kBits>
const DepthDifference* LeafDepth<kBits>::depth(PolygonId polygon) {
  const std::size_t at = place_of(polygon);
  Seen& entry = seen_[at];
  if (entry.polygon != polygon || entry.fragment == nullptr) return nullptr;
  DepthDifference& depth = depths_[at].depth;
  if (!entry.has_depth) {
    entry.has_depth = true;
    collect_corners(entry);
    depth = depth_of(corners_, frame_.view, farthest_);
  }
  return &depth;
}

/// Finds a rival's order from depths; false: they are not known.
template <int kBits>
bool LeafDepth<kBits>::compare_depths(Rival& entry) {
  const DepthDifference* here = depth(fragment_->source);
  const DepthDifference* there = depth(entry.polygon);
  if (here == nullptr || there == nullptr) return false;
  entry.line = difference_of_depths(*here, *there);
  return true;
}

/// The same from the planes of their sources.
template <int kBits>
void LeafDepth<kBits>::compare_planes(Rival& entry) {
  // Both may be kept at the same place.
  const ApproximateProjection here = seen(fragment_->source);
  const ApproximateProjection there = seen(entry.polygon);
  entry.by_depths = false;
  entry.line = depth_difference(here, there);
  // Read against the sides that the eye is on; where the other's is in doubt,
  // so is all of this.
  const int there_sign = filtered_sign(there.eye);
  if (there_sign == 0) entry.line.error = 1e300;
  if (there_sign * eye_sign_ < 0) {
    entry.line = {-entry.line.a, -entry.line.b, -entry.line.c,
                  entry.line.error};
  }
}

template <int kBits>
typename LeafDepth<kBits>::Rival& LeafDepth<kBits>::rival(PolygonId other) {
  Rival& entry = rivals_[static_cast<std::size_t>(other) % rivals_.size()];
  if (entry.polygon == other && entry.serial == serial_) return entry;
  entry.polygon = other;
  entry.serial = serial_;
  entry.by_depths = compare_depths(entry);
  if (!entry.by_depths) compare_planes(entry);
  return entry;
}

template <int kBits>
void LeafDepth<kBits>::nearer(PolygonId other, std::int32_t x, std::int32_t y,
                              std::uint32_t* lit) {
  if (other == fragment_->source) {
    // Lit by itself, until it was in doubt.
    std::fill_n(lit, kTileHeight, 0u);
    return;
  }
  Rival& entry = rival(other);
  const auto sign_at = [&](int i, std::int32_t j) {
    const int rough = entry.line.filtered_sign_at(i, j);
    if (rough != 0 || !entry.by_depths) return rough;
    compare_planes(entry);
    return entry.line.filtered_sign_at(i, j);
  };
  for (std::int32_t r = 0; r < kTileHeight; ++r) {
    if (lit[r] == 0) continue;
    const std::int32_t j = y + r;
    // What holds at both ends holds between them.
    const int first =
        entry.line.filtered_sign_at(x + std::countr_zero(lit[r]), j);
    const int last =
        entry.line.filtered_sign_at(x + 31 - std::countl_zero(lit[r]), j);
    if (first > 0 && last > 0) continue;
    if (first < 0 && last < 0) lit[r] = 0;
    for (std::uint32_t bits = lit[r]; bits != 0; bits &= bits - 1) {
      const int k = std::countr_zero(bits);
      const int known = sign_at(x + k, j);
      const bool wins = known != 0 ? known > 0 : is_nearer(entry, x + k, j);
      if (!wins) lit[r] &= ~(std::uint32_t{1} << k);
    }
  }
}

template <int kBits>
void LeafDepth<kBits>::forget() {
  for (Seen& entry : seen_) entry = {};
}

template class LeafDepth<kMovedGrid>;
template class LeafDepth<26>;
template class LeafDepth<40>;
template class LeafDepth<54>;

}  // namespace halfspace::fast
