#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "camera/clip_function.hpp"
#include "camera/moved_camera.hpp"
#include "raster/clip_set.hpp"
#include "tree/tree_reader.hpp"

namespace halfspace::fast {

/// Decides, exactly, which samples a fragment covers (S4.5): where doubles
/// cannot, and where a fragment reaches up to the eye.
template <int kBits>
class ExactScan {
 public:
  ExactScan(const TreeReader& reader, const ExactCamera<kBits>& camera,
            const ClipSet& clips, int samples = 1)
      : reader_(reader), camera_(camera), clips_(clips), samples_(samples) {}

  /// The fragment that is meant from now on; the eye is on side `eye_sign` of
  /// its source, and not on its plane.
  /// Of it what clip planes `cuts` of the set leave.
  void start(const TreeFragment& fragment, int eye_sign, ClipMask cuts = 0) {
    fragment_ = &fragment;
    cuts_ = cuts;
    eye_sign_ = eye_sign;
    ready_ = false;
  }

  /// The functions that are positive at the samples it covers.
  std::span<const EdgeFunction<Grid<kBits>::kWords>> lines() {
    if (!ready_) prepare();
    return lines_;
  }

  /// The pixels of line `j`, of those in `range`, that it covers.
  PixelRange line(std::int32_t j, PixelRange range) {
    if (!ready_) prepare();
    for (const Line& line : lines_) range = clipped(range, line, j);
    return range;
  }

 private:
  static constexpr std::size_t kWords = Grid<kBits>::kWords;
  using Line = EdgeFunction<kWords>;

  void add(const Line& line, int inside) {
    lines_.push_back(inside > 0 ? line : -line);
  }
  template <std::size_t kOther>
  static Line widened(const EdgeFunction<kOther>& line) {
    return {Wide<kWords>(line.a), Wide<kWords>(line.b), Wide<kWords>(line.c)};
  }

  Line clip_line(const ProjectedPlane<kBits>& support, std::size_t k) const {
    if constexpr (kBits == kMovedGrid) {
      return meet_function(
          support, projected<54>(clips_.plane(k), camera_.in_world, samples_));
    } else {
      return meet_function<kBits>(
          support, projected<kBits>(clips_.plane(k), camera_, samples_));
    }
  }

  void prepare() {
    ready_ = true;
    lines_.clear();
    const ScenePlanes& planes = reader_.planes();
    const PolygonId source = fragment_->source;
    const ProjectedPlane<kBits> support =
        projected(planes.exact<kBits>(source), camera_, samples_);
    for (const Corner& corner : reader_.corners(*fragment_)) {
      if (is_source(corner.edge)) {
        const auto ends = planes.source_edge(source, corner.edge);
        add(widened(edge_function(ends[0], ends[1], camera_, samples_)),
            eye_sign_);
      } else {
        const PlaneId splitter = splitter_of(corner.edge);
        add(meet_function<kBits>(
                support,
                projected(planes.exact<kBits>(splitter), camera_, samples_)),
            eye_sign_ * reader_.side_of(*fragment_, splitter));
      }
    }
    for (std::size_t k = 0; cuts_ >> k != 0; ++k) {
      if ((cuts_ >> k & 1u) == 0) continue;
      const Line line = clip_line(support, k);
      // A polygon in the clip plane stays, or is not there.
      if (!is_zero(line)) {
        add(line, eye_sign_);
      } else if (clips_.has_caps()) {
        add(Line{{}, {}, Wide<kWords>(-1)}, 1);
      }
    }
    if (camera_.near) {
      add(widened(near_function(support, *camera_.near, camera_.perspective,
                                samples_)),
          eye_sign_);
    }
  }

  const TreeReader& reader_;
  const ExactCamera<kBits>& camera_;
  const ClipSet& clips_;
  int samples_;
  ClipMask cuts_ = 0;
  const TreeFragment* fragment_ = nullptr;
  int eye_sign_ = 0;
  bool ready_ = false;
  std::vector<Line> lines_;
};

}  // namespace halfspace::fast
