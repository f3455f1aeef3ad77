#include "raster/caps.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "camera/clip_function.hpp"
#include "halfspace/cap_parts.hpp"
#include "halfspace/visible_map.hpp"
#include "raster/cap_windings.hpp"

namespace halfspace::fast {
namespace {

/// Points whose corners of polygons are on a clip plane's two sides, and
/// numbers of them that have so many words.
template <int kBits>
struct CapNumbers {
  static constexpr std::size_t kValue = 3;     ///< a plane's value at a point
  static constexpr std::size_t kForm = 5;      ///< a form of ImageForms there
  static constexpr std::size_t kCrossing = 7;  ///< of a Crossing
  static constexpr std::size_t kProduct = 13;  ///< of two of these
  using Coordinate = Int128;                   ///< in lattice steps
};

/// Those of objects: a point stands at p / 2^shift, p having 119 bits, and all
/// its numbers are taken 2^shift times.
///
/// Bits: p in lattice steps less the eye 130; a plane's value 231; a form 137
/// and 130 and 2, with samples 273; a crossing's numbers 505, in a row 525.
template <>
struct CapNumbers<kMovedGrid> {
  static constexpr std::size_t kValue = 4;
  static constexpr std::size_t kForm = 5;
  static constexpr std::size_t kCrossing = 9;
  static constexpr std::size_t kProduct = 17;
  using Coordinate = Wide<3>;
};

/// A point of the world, and what its numbers are multiplied by.
template <int kBits>
struct CapPoint {
  using Coordinate = typename CapNumbers<kBits>::Coordinate;
  Coordinate x, y, z;
  Int128 scale = 1;
};

template <int kBits>
CapPoint<kBits> cap_point(const GridPoint& p, const Frame& frame) {
  if constexpr (kBits == kMovedGrid) {
    const ObjectMap& map = frame.moved->to_world;
    const auto row = [&](std::size_t k) {
      return multiply<3>(Int128{map.m[3 * k]}, Int128{p.x}) +
             multiply<3>(Int128{map.m[3 * k + 1]}, Int128{p.y}) +
             multiply<3>(Int128{map.m[3 * k + 2]}, Int128{p.z}) +
             Wide<3>(map.t[k]);
    };
    return {row(0), row(1), row(2), Int128{1} << map.shift};
  } else {
    return {p.x, p.y, p.z};
  }
}

/// The functions of space by which a point is placed in the image, in halves of
/// lattice steps: the row's plane through the eye is `row(j)`, its function
/// positive below the row; `front` is positive where points are seen.
///
/// Rows are those of samples, so many a pixel: y is (2j + 1) / (2 samples).
/// Bits: cross products of lattice vectors have 2 (n + 14) + 2; against a point
/// 3n + 47; a row's number adds 18 bits more, and samples 3: 3n + 69 at most,
/// 231 on the grid of 54, in 4 words.
template <int kBits>
class ImageForms {
 public:
  static constexpr std::size_t kWords = CapNumbers<kBits>::kForm;
  using Form = Wide<kWords>;

  ImageForms(const CameraData& camera, int samples)
      : camera_(camera), samples_(samples) {
    // The plane of a row holds its direction sx and the eye; below is sy.
    const LatticeVector depth =
        camera.perspective ? minus(camera.s0, camera.eye) : camera.eye;
    front_ = cross(camera.sx, camera.sy);
    if (sign(dot(front_, depth)) < 0) front_ = -front_;
    start_ = cross(depth, camera.sx);
    step_ = camera.perspective ? cross(camera.sy, camera.sx) : Normal{};
    below_ = sign(dot(start_, camera.sy)) < 0 ? -1 : 1;
  }

  /// A point's row function: r0 + r1 (2j + 1), positive below row j.
  struct Row {
    Form at_0;
    Form slope;
  };
  Row row(const CapPoint<kBits>& p) const {
    const auto v = above(p, camera_.perspective ? camera_.eye : camera_.s0);
    if (camera_.perspective) {
      // The normal is cross(2 samples (s0 - e) + (2j + 1) sy, sx).
      return {scaled(2 * samples_ * below_, dot(start_, v)),
              scaled(below_, dot(step_, v))};
    }
    // v less y sy, 2 samples times.
    return {
        scaled(2 * samples_ * below_, dot(start_, v)),
        multiply<kWords>(scaled(-below_, dot(start_, camera_.sy)), p.scale)};
  }
  /// The point's distance from the eye along the view: t of S4.1, times a
  /// positive number.
  Form front(const CapPoint<kBits>& p) const {
    if (!camera_.perspective) return Form(1);
    return dot(front_, above(p, camera_.eye));
  }

 private:
  using Coordinate = typename CapNumbers<kBits>::Coordinate;
  struct Normal {
    Wide<3> x, y, z;
    Normal operator-() const { return {-x, -y, -z}; }
  };
  /// The point from a place of the lattice, in lattice steps.
  static Vector3<Coordinate> above(const CapPoint<kBits>& p,
                                   const LatticeVector& from) {
    constexpr Int128 kStep = Int128{1} << kLatticeBits;
    if constexpr (kBits == kMovedGrid) {
      const auto part = [&](const Wide<3>& to, const Int128& start) {
        return multiply<3>(to, kStep) - multiply<3>(start, p.scale);
      };
      return {part(p.x, from.x), part(p.y, from.y), part(p.z, from.z)};
    } else {
      return {kStep * p.x - from.x, kStep * p.y - from.y, kStep * p.z - from.z};
    }
  }
  static LatticeVector minus(const LatticeVector& u, const LatticeVector& v) {
    return {u.x - v.x, u.y - v.y, u.z - v.z};
  }
  static Normal cross(const LatticeVector& u, const LatticeVector& v) {
    return {multiply<3>(u.y, v.z) - multiply<3>(u.z, v.y),
            multiply<3>(u.z, v.x) - multiply<3>(u.x, v.z),
            multiply<3>(u.x, v.y) - multiply<3>(u.y, v.x)};
  }
  template <class Vector>
  static Form dot(const Normal& n, const Vector& v) {
    return multiply<kWords>(n.x, v.x) + multiply<kWords>(n.y, v.y) +
           multiply<kWords>(n.z, v.z);
  }
  static Form scaled(int factor, const Form& value) {
    return multiply<kWords>(value, Int128{factor});
  }

  const CameraData& camera_;
  int samples_;
  Normal front_;
  Normal start_;
  Normal step_;
  int below_ = 1;
};

/// Where a polygon's boundary passes through the plane: its row function
/// R = r0 + r1 (2j + 1) and what is in front, over a common positive number.
///
/// Bits: a plane's value at a point has 3n + 5, a row function's part 3n + 49;
/// the two products and their difference 6n + 55, 379: 6 words; with samples
/// and a row's number 400.
template <int kBits>
struct Crossing {
  using Number = Wide<CapNumbers<kBits>::kCrossing>;
  Number at_0;
  Number slope;
  Number front;

  EdgeFunction<CapNumbers<kBits>::kCrossing> row_function() const {
    return {slope, {}, at_0};
  }
};

/// Finds the changes of the winding number in a clip plane (S10.3).
template <int kBits>
class CapRows {
 public:
  CapRows(const Frame& frame, const Rectangle& rectangle, std::size_t k)
      : frame_(frame),
        rectangle_(rectangle),
        clip_(frame.clips.plane(k)),
        forms_(frame.camera, frame.view.samples),
        seen_(projected<kWorldBits>(clip_, frame.camera, frame.view.samples)),
        side_(sign(seen_.eye)) {}

  int side() const { return side_; }

  /// Adds the changes that polygons make.
  void add(const std::vector<PolygonId>& polygons,
           std::vector<CapChange>& changes) {
    const CapParts* parts = frame_.image.parts.get();
    for (const PolygonId polygon : polygons) {
      if (parts != nullptr) {
        part_ =
            parts->part_of[static_cast<std::size_t>(frame_.first_id + polygon)];
      }
      add(polygon);
    }
    changes.insert(changes.end(), changes_.begin(), changes_.end());
    changes_.clear();
  }

 private:
  using Numbers = CapNumbers<kBits>;
  using Value = Wide<Numbers::kValue>;
  using Ends = std::array<Crossing<kBits>, 2>;
  /// The world's grid, of which the clip planes are: in an object any.
  static constexpr int kWorldBits = kBits == kMovedGrid ? 54 : kBits;

  /// The plane's value at a point: for a corner on it the removed side's.
  Value value_at(const CapPoint<kBits>& p) const {
    constexpr std::size_t kWords = Numbers::kValue;
    return multiply<kWords>(clip_.a, p.x) + multiply<kWords>(clip_.b, p.y) +
           multiply<kWords>(clip_.c, p.z) + multiply<kWords>(clip_.d, p.scale);
  }

  template <class Number>
  static typename Crossing<kBits>::Number between(const Value& cp,
                                                  const Number& p,
                                                  const Value& cq,
                                                  const Number& q) {
    constexpr std::size_t kWords = Numbers::kCrossing;
    return multiply<kWords>(cp, q) - multiply<kWords>(cq, p);
  }

  void add(PolygonId polygon) {
    const Scene& scene = frame_.reader.scene();
    const auto corners = scene.corners(polygon);
    Ends ends;
    std::size_t count = 0;
    const auto point_at = [&](std::size_t k) {
      return cap_point<kBits>(scene.point(corners[k]), frame_);
    };
    CapPoint<kBits> p = point_at(corners.size() - 1);
    Value last = value_at(p);
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const CapPoint<kBits> q = point_at(k);
      const Value here = value_at(q);
      if ((sign(last) > 0) != (sign(here) > 0)) {
        // (C(p) q - C(q) p) / (C(p) - C(q)), over a positive number.
        const bool down = sign(last) > 0;
        const auto mix = [&](const auto& at_p, const auto& at_q) {
          return down ? between(last, at_p, here, at_q)
                      : between(here, at_q, last, at_p);
        };
        const auto row_p = forms_.row(p);
        const auto row_q = forms_.row(q);
        ends[count++ & 1u] = {mix(row_p.at_0, row_q.at_0),
                              mix(row_p.slope, row_q.slope),
                              mix(forms_.front(p), forms_.front(q))};
      }
      p = q;
      last = here;
    }
    if (count == 2) add(polygon, ends);
  }

  /// The segment between two points of the plane.
  void add(PolygonId polygon, const Ends& ends) {
    const auto plane =
        projected(frame_.reader.planes().template exact<kBits>(polygon),
                  exact_camera<kBits>(frame_), frame_.view.samples);
    // Positive where the polygon's function is, at points of the plane.
    const auto beside = meet_plane(plane);
    const int slope = sign(beside.a);
    // The rows in which the ends are above and below: on each side of the row
    // at which an end's function changes its sign.
    const PixelRange all = {rectangle_.top, rectangle_.bottom};
    std::array<PixelRange, 2> below;
    for (std::size_t k = 0; k < 2; ++k)
      below[k] = clipped(all, ends[k].row_function(), 0);
    const auto is_below = [&](std::size_t k, std::int32_t j) {
      return below[k].first <= j && j < below[k].end;
    };
    std::array<std::int32_t, 6> bounds = {all.first,      all.end,
                                          below[0].first, below[0].end,
                                          below[1].first, below[1].end};
    for (std::int32_t& bound : bounds)
      bound = std::clamp(bound, all.first, all.end);
    std::sort(bounds.begin(), bounds.end());
    for (std::size_t b = 0; b + 1 < bounds.size(); ++b) {
      const std::int32_t first = bounds[b];
      if (first == bounds[b + 1] || is_below(0, first) == is_below(1, first))
        continue;
      for (std::int32_t j = first; j < bounds[b + 1]; ++j)
        add_row(j, ends, beside, slope);
    }
  }

  /// C(e) P(s) - P(e) C(s), for the side that the eye is on.
  EdgeFunction<Grid<kBits>::kWords> meet_plane(
      const ProjectedPlane<kBits>& plane) const {
    if constexpr (kBits == kMovedGrid) {
      const auto meet = meet_function(plane, seen_);
      return side_ > 0 ? -meet : meet;
    } else {
      const auto meet = meet_function<kBits>(seen_, plane);
      return side_ > 0 ? meet : -meet;
    }
  }

  /// A row's crossing: what is after it along the row has a winding number
  /// that is less by one where the polygon's function grows.
  void add_row(std::int32_t j, const Ends& ends,
               const EdgeFunction<Grid<kBits>::kWords>& beside, int slope) {
    if (slope == 0) {
      // The row's plane meets the segment beside the eye, where the image ends:
      // on its left if points of the plane come nearer to there. Then all of
      // the row is after it.
      if (side_ * sign(seen_.a) > 0) {
        const int after = beside.sign_at_sample(rectangle_.left, j);
        changes_.push_back({j, rectangle_.left, -after, part_});
      }
      return;
    }
    const int growth = front_sign(j, ends) * slope;
    const PixelRange after = clipped({rectangle_.left, rectangle_.right},
                                     growth > 0 ? beside : -beside, j);
    if (after.first >= after.end) return;
    changes_.push_back({j, after.first, -growth, part_});
    if (after.end < rectangle_.right)
      changes_.push_back({j, after.end, growth, part_});
  }

  /// Whether the segment meets the row's plane before or behind the eye.
  int front_sign(std::int32_t j, const Ends& ends) const {
    const int first = sign(ends[0].front);
    const int second = sign(ends[1].front);
    if (first > 0 && second > 0) return 1;
    if (first < 0 && second < 0) return -1;
    // (R(p) q - R(q) p) / (R(p) - R(q)). Bits: 400 and 379 and 1; of objects
    // 525 and 505 and 1.
    const auto row = [&](const Crossing<kBits>& end) {
      return multiply<Numbers::kCrossing>(end.slope, Int128{2 * j + 1}) +
             end.at_0;
    };
    const auto p = row(ends[0]);
    const auto q = row(ends[1]);
    return sign(multiply<Numbers::kProduct>(p, ends[1].front) -
                multiply<Numbers::kProduct>(q, ends[0].front)) *
           sign(p - q);
  }

  const Frame& frame_;
  const Rectangle& rectangle_;
  const ClipPlane& clip_;
  ImageForms<kBits> forms_;
  ProjectedPlane<kWorldBits> seen_;
  int side_;
  std::uint32_t part_ = 0;  ///< of the polygon that is added
  std::vector<CapChange> changes_;
};

/// What is made of a cap in an image: all; its colours alone, blended with what
/// is there (S10.7); or its items alone.
enum class CapWork : std::uint8_t { kAll, kBlend, kItems };

/// Fills the pixels of a cap, where it is in front, or blends all of them.
template <int kBits>
class CapFiller {
 public:
  CapFiller(const Frame& frame, const Rectangle& rectangle, std::size_t k,
            const ProjectedPlane<kBits>& seen, CapWork work, PolygonId first_id,
            Rendering& result)
      : frame_(frame),
        rectangle_(rectangle),
        k_(k),
        first_id_(first_id),
        side_(sign(seen.eye)),
        work_(work),
        result_(result) {
    const CameraData& camera = frame.camera;
    const int samples = frame.view.samples;
    if (camera.perspective) {
      // 1/t > 0: C(e) - C(s), 2 samples times.
      add(EdgeFunction<4>{Wide<4>(-seen.a), Wide<4>(-seen.b),
                          multiply<4>(Wide<4>(seen.eye), Int128{2 * samples}) -
                              Wide<4>(seen.c)});
    }
    if (camera.near) {
      add(near_function<kBits>(seen, *camera.near, camera.perspective,
                               samples));
    }
    for (std::size_t other = 0; other < frame.image.clips.size(); ++other) {
      if (other == k) continue;
      add(meet_function<kBits>(
          seen, projected<kBits>(frame.clips.plane(other), camera, samples)));
    }
  }

  /// The pixels of a row that the cap can be seen in.
  PixelRange row(std::int32_t j) const {
    PixelRange range = {rectangle_.left, rectangle_.right};
    for (const Line& line : limits_) range = clipped(range, line, j);
    return range;
  }

  void fill(std::int32_t j, PixelRange range, std::size_t part) {
    const CapItem cap = {k_, part, false};
    const PolygonId id = first_id_ + number_of(cap);
    if (work_ == CapWork::kBlend) return blend(j, range, cap);
    for (std::int32_t i = range.first; i < range.end; ++i) {
      PolygonId& item =
          result_.items.at(i - rectangle_.left, j - rectangle_.top);
      // Before all that is kept, or behind it (S10, "Caps need no depth
      // order").
      if (item != kBackground && side_ > 0) continue;
      if (item == kBackground) ++result_.pixels_painted;
      item = id;
      if (work_ == CapWork::kItems || result_.colors.pixels.empty()) continue;
      result_.colors.at(i - rectangle_.left, j - rectangle_.top) =
          cap_color_at_sample(frame_.image, cap, i, j, frame_.view.samples);
    }
  }

 private:
  static constexpr std::size_t kWords = Grid<kBits>::kWords;
  using Line = EdgeFunction<kWords>;

  void blend(std::int32_t j, PixelRange range, const CapItem& cap) {
    for (std::int32_t i = range.first; i < range.end; ++i) {
      Rgb& color = result_.colors.at(i - rectangle_.left, j - rectangle_.top);
      color = composed_color(
          cap_color_at_sample(frame_.image, cap, i, j, frame_.view.samples),
          color, frame_.alpha);
    }
  }

  template <std::size_t kOther>
  void add(const EdgeFunction<kOther>& line) {
    const Line wide = {Wide<kWords>(line.a), Wide<kWords>(line.b),
                       Wide<kWords>(line.c)};
    limits_.push_back(side_ > 0 ? wide : -wide);
  }

  const Frame& frame_;
  const Rectangle& rectangle_;
  std::size_t k_;
  PolygonId first_id_;
  int side_;
  std::vector<Line> limits_;
  CapWork work_;
  Rendering& result_;
};

/// Adds what the polygons of the frame's tree change in a plane.
template <int kBits>
void add_changes(const Frame& frame, const Rectangle& rectangle, std::size_t k,
                 std::vector<CapChange>& changes) {
  CapRows<kBits> rows(frame, rectangle, k);
  // Seen edge-on; or from behind, for it faces what is removed.
  if (rows.side() == 0 || (frame.image.cull && rows.side() > 0)) return;
  if constexpr (kBits == kMovedGrid) {
    const int grid = frame.reader.scene().grid_bits();
    const std::vector<ClipPlane> one = {frame.clips.plane(k)};
    rows.add(crossing_polygons(
                 frame.reader,
                 ClipSet(one, false, grid).moved(frame.moved->to_world, grid)),
             changes);
  } else {
    rows.add(crossing_polygons(frame.reader, frame.clips.plane(k)), changes);
  }
}

/// The rows of a cap that are in a rectangle.
template <int kBits>
void add_cap(const Frame& frame, const Rectangle& rectangle, PixelRange rows,
             std::size_t k, const std::vector<CapChange>& changes, CapWork work,
             PolygonId first_id, Rendering& result) {
  const auto starts_at = [](const CapChange& change, std::int32_t row) {
    return change.row < row;
  };
  auto at =
      std::lower_bound(changes.begin(), changes.end(), rows.first, starts_at);
  const auto end = std::lower_bound(at, changes.end(), rows.end, starts_at);
  if (at == end) return;
  const auto seen =
      projected<kBits>(frame.clips.plane(k), frame.camera, frame.view.samples);
  CapFiller<kBits> filler(frame, rectangle, k, seen, work, first_id, result);
  CapWindings windings(frame.image.parts.get());
  while (at != end) {
    const std::int32_t j = at->row;
    const PixelRange range = filler.row(j);
    windings.clear();
    for (; at != end && at->row == j; ++at) {
      windings.add_to(at->part, at->by);
      const bool is_last = at + 1 == end || at[1].row != j;
      const std::int32_t next = is_last ? rectangle.right : at[1].column;
      if (!windings.is_cap()) continue;
      filler.fill(
          j, {std::max(range.first, at->column), std::min(range.end, next)},
          windings.part());
    }
  }
}

}  // namespace

CapChanges cap_changes(const Frame& frame, const Rectangle& rectangle) {
  CapChanges changes(frame.image.clips.size());
  with_grid(frame.reader.scene().grid_bits(), [&](auto bits) {
    for (std::size_t k = 0; k < changes.size(); ++k) {
      add_changes<bits()>(frame, rectangle, k, changes[k]);
      std::sort(changes[k].begin(), changes[k].end());
    }
  });
  return changes;
}

void add_object_changes(const Frame& frame, const Rectangle& rectangle,
                        CapChanges& changes) {
  for (std::size_t k = 0; k < changes.size(); ++k)
    add_changes<kMovedGrid>(frame, rectangle, k, changes[k]);
}

void add_caps(const Frame& frame, const Rectangle& rectangle,
              const CapChanges& changes, PolygonId first_id,
              Rendering& result) {
  const PixelRange rows = {rectangle.top, rectangle.bottom};
  const CapWork work = frame.alpha == kOpaque ? CapWork::kAll : CapWork::kItems;
  with_grid(frame.reader.scene().grid_bits(), [&](auto bits) {
    for (std::size_t k = 0; k < changes.size(); ++k) {
      add_cap<bits()>(frame, rectangle, rows, k, changes[k], work, first_id,
                      result);
    }
  });
}

void blend_caps(const Frame& frame, const Rectangle& rectangle, PixelRange rows,
                const CapChanges& changes, int side, Rendering& result) {
  if (result.colors.pixels.empty()) return;
  with_grid(frame.reader.scene().grid_bits(), [&](auto bits) {
    for (std::size_t k = 0; k < changes.size(); ++k) {
      const auto seen = projected<bits()>(frame.clips.plane(k), frame.camera,
                                          frame.view.samples);
      if (sign(seen.eye) != side) continue;
      add_cap<bits()>(frame, rectangle, rows, k, changes[k], CapWork::kBlend, 0,
                      result);
    }
  });
}

}  // namespace halfspace::fast
