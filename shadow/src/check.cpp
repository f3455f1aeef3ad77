#include "halfspace/shadow/check.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <optional>
#include <utility>

#include "halfspace/assert.hpp"
#include "halfspace/cap_parts.hpp"
#include "halfspace/ref/clip.hpp"
#include "halfspace/ref/oracle/raycast.hpp"
#include "halfspace/ref/shade.hpp"
#include "halfspace/scene_file.hpp"
#include "halfspace/splitmix.hpp"
#include "polygons.hpp"

namespace halfspace::shadow {
namespace {

/// A chosen pixel.
struct Sample {
  std::int32_t i = 0;  ///< in the whole image
  std::int32_t j = 0;
  PolygonId shown = kBackground;
  Rgb color;                ///< shown, if colours are checked
  bool is_covered = false;  ///< certainly covered by `shown`
  bool is_sure = true;      ///< certainly no other polygon hides `shown`
  /// A polygon that is certainly less near cannot hide `shown`.
  double nearness = -HUGE_VAL;
};

/// Pixels of a part of an image: one of every `step` in the order of rows.
class Samples {
 public:
  Samples(const Shown& shown, const Options& how)
      : left_(shown.left),
        top_(shown.top),
        right_(shown.left + shown.items.width_px - 1),
        bottom_(shown.top + shown.items.height_px - 1) {
    const auto step = static_cast<std::size_t>(
        std::clamp(std::floor(1 / how.share), 1.0, 0x1p40));
    const auto width = static_cast<std::size_t>(shown.items.width_px);
    const std::size_t pixels = shown.items.pixels.size();
    all_.reserve((pixels + step - 1) / step);
    SplitMix64 generator(how.seed);
    for (std::size_t first = 0; first < pixels; first += step) {
      const std::size_t length = std::min(step, pixels - first);
      const std::size_t at = first + generator.next() % length;
      Sample sample;
      sample.i = left_ + static_cast<std::int32_t>(at % width);
      sample.j = top_ + static_cast<std::int32_t>(at / width);
      sample.shown = shown.items.pixels[at];
      // Read here, in one pass: independent loads overlap.
      if (!shown.colors.pixels.empty()) sample.color = shown.colors.pixels[at];
      all_.push_back(sample);
    }
    // Tiles of about two to eight samples.
    while (shift_ < 16 && (std::size_t{1} << 2 * shift_) < 2 * step) ++shift_;
    across_ = tile(right_ - left_) + 1;
    begin_.resize(static_cast<std::size_t>(across_) *
                      (static_cast<std::size_t>(tile(bottom_ - top_)) + 1) +
                  1);
  }

  std::vector<Sample>& all() { return all_; }

  /// Sorts the samples, as they are now, by tiles for within().
  void sort() {
    // A counting sort.
    for (const Sample& sample : all_) ++begin_[tile_of(sample) + 1];
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    places_.resize(all_.size());
    nearness_.assign(begin_.size() - 1, HUGE_VAL);
    std::vector<std::uint32_t> free(begin_.begin(), begin_.end() - 1);
    for (std::size_t n = 0; n < all_.size(); ++n) {
      const Sample& sample = all_[n];
      const std::size_t tile = tile_of(sample);
      places_[free[tile]++] = {sample.nearness, sample.i, sample.j,
                               static_cast<std::uint32_t>(n)};
      nearness_[tile] = std::min(nearness_[tile], sample.nearness);
    }
  }

  /// Calls `visit` with every sample within the bounds whose polygon is not
  /// certainly nearer than `nearness`.
  template <class Visit>
  void within(const Bounds& bounds, double nearness, const Visit& visit) {
    const std::int32_t left = std::max(bounds.left, left_);
    const std::int32_t right = std::min(bounds.right, right_);
    const std::int32_t top = std::max(bounds.top, top_);
    const std::int32_t bottom = std::min(bounds.bottom, bottom_);
    if (left > right || top > bottom) return;
    const auto first_tile = static_cast<std::size_t>(tile(left - left_));
    const auto last_tile = static_cast<std::size_t>(tile(right - left_));
    for (std::int32_t row = tile(top - top_); row <= tile(bottom - top_);
         ++row) {
      const auto at =
          static_cast<std::size_t>(row) * static_cast<std::size_t>(across_);
      // A polygon behind all samples of a row of tiles hides none of them.
      double least = HUGE_VAL;
      for (std::size_t t = first_tile; t <= last_tile; ++t)
        least = std::min(least, nearness_[at + t]);
      if (nearness < least) continue;
      const std::uint32_t end = begin_[at + last_tile + 1];
      for (std::uint32_t n = begin_[at + first_tile]; n < end;) {
        // Most are outside, in an unpredictable order: collect those within
        // without a branch.
        std::uint32_t found[kAtOnce];
        std::size_t count = 0;
        for (const std::uint32_t stop = std::min(end, n + kAtOnce); n < stop;
             ++n) {
          const Place& place = places_[n];
          found[count] = place.sample;
          count += static_cast<std::size_t>(
              int{place.i >= left} & int{place.i <= right} &
              int{place.j >= top} & int{place.j <= bottom} &
              int{!(nearness < place.nearness)});
        }
        for (std::size_t k = 0; k < count; ++k) visit(all_[found[k]]);
      }
    }
  }

 private:
  /// The part of a sample that within() reads.
  struct Place {
    double nearness;
    std::int32_t i, j;
    std::uint32_t sample;
  };

  static constexpr std::uint32_t kAtOnce = 64;

  std::int32_t tile(std::int32_t pixels) const { return pixels >> shift_; }
  std::size_t tile_of(const Sample& sample) const {
    return static_cast<std::size_t>(tile(sample.j - top_)) *
               static_cast<std::size_t>(across_) +
           static_cast<std::size_t>(tile(sample.i - left_));
  }

  std::int32_t left_, top_, right_, bottom_;
  int shift_ = 0;  ///< tiles have 2^shift_ by 2^shift_ pixels
  std::int32_t across_;
  std::vector<Sample> all_;
  std::vector<std::uint32_t> begin_;  ///< each tile's first in places_
  std::vector<double> nearness_;      ///< the least of each tile
  std::vector<Place> places_;
};

constexpr std::int32_t kNotPrepared = -1;

class Checker {
 public:
  Checker(const Scene& scene, const Camera& camera, const ImageOptions& options,
          const Shown& shown, const Options& how)
      : scene_(scene),
        camera_(camera),
        options_(options),
        shown_(shown),
        how_(how),
        polygons_(scene, camera, options),
        samples_(shown, how),
        has_caps_(options.caps && !options.clips.empty()) {}

  Report run() {
    if (!how_.by_reference_only) {
      judge_shown();
      samples_.sort();
      judge_others();
      if (has_caps_) find_walls();
    }
    std::sort(rivals_.begin(), rivals_.end());
    report_.pixels = samples_.all().size();
    for (Sample& sample : samples_.all()) conclude(sample);
    return std::move(report_);
  }

 private:
  PolygonId polygon_count() const {
    return static_cast<PolygonId>(scene_.polygon_count());
  }
  bool is_id(PolygonId id) const { return id >= 0 && id < polygon_count(); }

  /// Requires: some sample shows the polygon.
  const Prepared& prepared(PolygonId id) const {
    return prepared_[static_cast<std::size_t>(
        number_[static_cast<std::size_t>(id)])];
  }

  /// Tests each sample against the polygon that it shows.
  void judge_shown() {
    number_.assign(scene_.polygon_count(), kNotPrepared);
    for (Sample& sample : samples_.all()) {
      if (!is_id(sample.shown)) continue;
      std::int32_t& number = number_[static_cast<std::size_t>(sample.shown)];
      if (number == kNotPrepared) {
        number = static_cast<std::int32_t>(prepared_.size());
        prepared_.push_back(polygons_.prepare(sample.shown));
      }
      const Prepared& polygon = prepared(sample.shown);
      if (!polygon.certain) continue;
      sample.is_covered =
          polygons_.covers(polygon, sample.i, sample.j) == Verdict::kYes;
      const Bounded nearness =
          Polygons::nearness_at(polygon, sample.i, sample.j);
      const double least = nearness.value - nearness.error;
      // NaN fails the comparison: then nothing is certain.
      if (least > -HUGE_VAL) sample.nearness = least;
    }
  }

  /// Collects for each sample the other polygons that may hide the shown one.
  void judge_others() {
    for (PolygonId id = 0; id < polygon_count(); ++id) {
      std::optional<Prepared> own;
      samples_.within(polygons_.bounds_of(id), polygons_.nearness_of(id),
                      [&](Sample& sample) {
                        if (id == sample.shown) return;
                        const bool is_shown =
                            number_[static_cast<std::size_t>(id)] !=
                            kNotPrepared;
                        if (!is_shown && !own) own = polygons_.prepare(id);
                        judge(sample, id, is_shown ? prepared(id) : *own);
                      });
      if (own) polygons_.forget(*own);
    }
  }

  /// Collects for each sample all polygons that a cap there may depend on.
  void find_walls() {
    for (PolygonId id = 0; id < polygon_count(); ++id) {
      samples_.within(polygons_.bounds_of(id), HUGE_VAL, [&](Sample& sample) {
        walls_.push_back({&sample, id});
      });
    }
    std::sort(walls_.begin(), walls_.end());
  }

  /// Of pairs with samples, in order, those of one.
  using Pairs = std::vector<std::pair<const Sample*, PolygonId>>;
  static std::vector<PolygonId> ids_of(const Pairs& pairs,
                                       const Sample& sample) {
    const auto first = std::lower_bound(
        pairs.begin(), pairs.end(), std::pair(&sample, PolygonId{0}),
        [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<PolygonId> ids;
    for (auto pair = first; pair != pairs.end() && pair->first == &sample;
         ++pair)
      ids.push_back(pair->second);
    return ids;
  }

  void judge(Sample& sample, PolygonId id, const Prepared& polygon) {
    if (polygons_.covers(polygon, sample.i, sample.j) == Verdict::kNo) return;
    if (polygon.certain) {
      const Bounded nearness =
          Polygons::nearness_at(polygon, sample.i, sample.j);
      if (nearness.value + nearness.error < sample.nearness) return;
    }
    sample.is_sure = false;
    rivals_.push_back({&sample, id});
  }

  /// The polygon seen at the sample, by the reference's ray.
  PolygonId seen_at(const Sample& sample) {
    ++report_.by_reference;
    if (how_.by_reference_only) return cast_at_all(sample);
    std::vector<PolygonId> ids = ids_of(rivals_, sample);
    if (is_id(sample.shown)) ids.push_back(sample.shown);
    std::sort(ids.begin(), ids.end());
    const PolygonId seen =
        ref::raycast_at(scene_, camera_, options_, sample.i, sample.j, ids);
    // The rivals were chosen as those not behind `shown`, if that is a polygon.
    // If another one is seen, that choice excluded too many.
    return seen == sample.shown || !is_id(sample.shown) ? seen
                                                        : cast_at_near(sample);
  }

  std::vector<PolygonId> all_ids() const {
    std::vector<PolygonId> ids(scene_.polygon_count());
    std::iota(ids.begin(), ids.end(), PolygonId{0});
    return ids;
  }
  PolygonId cast_at_all(const Sample& sample) const {
    return ref::raycast_at(scene_, camera_, options_, sample.i, sample.j,
                           all_ids());
  }

  /// What the sample shows, caps too, where polygons alone show `seen`.
  PolygonId with_caps(const Sample& sample, PolygonId seen) {
    if (!has_caps_) return seen;
    ++report_.by_reference;
    return ref::with_caps_at(
        scene_, camera_, options_, sample.i, sample.j, seen,
        how_.by_reference_only ? all_ids() : ids_of(walls_, sample));
  }

  /// The same, without the polygons that certainly do not cover the sample.
  PolygonId cast_at_near(const Sample& sample) {
    std::vector<PolygonId> ids;
    for (PolygonId id = 0; id < polygon_count(); ++id) {
      const Bounds bounds = polygons_.bounds_of(id);
      if (sample.i < bounds.left || sample.i > bounds.right ||
          sample.j < bounds.top || sample.j > bounds.bottom) {
        continue;
      }
      const Prepared polygon = polygons_.prepare(id);
      if (polygons_.covers(polygon, sample.i, sample.j) != Verdict::kNo)
        ids.push_back(id);
      polygons_.forget(polygon);
    }
    return ref::raycast_at(scene_, camera_, options_, sample.i, sample.j, ids);
  }

  /// Whether the polygon's corner colours differ (S5.4).
  bool is_shaded(PolygonId id) const {
    const auto colors = scene_.corner_colors(id);
    return options_.shading == Shading::kGouraud &&
           std::adjacent_find(colors.begin(), colors.end(),
                              std::not_equal_to<>()) != colors.end();
  }

  Rgb color_of(const Sample& sample, PolygonId seen, Rgb shown) {
    if (seen == kBackground) return options_.background;
    if (seen >= polygon_count()) {
      return cap_color_at_sample(
          options_, cap_item(static_cast<std::size_t>(seen - polygon_count())),
          sample.i, sample.j, 1);
    }
    const bool is_certain =
        seen == sample.shown && !how_.by_reference_only && is_shaded(seen) &&
        polygons_.has_color(seen, prepared(seen), sample.i, sample.j, shown);
    if (is_certain) return shown;
    if (is_shaded(seen)) ++report_.by_reference;
    return ref::color_at(scene_, camera_, seen, sample.i, sample.j,
                         options_.shading);
  }

  void conclude(const Sample& sample) {
    const bool is_right = !how_.by_reference_only && sample.is_sure &&
                          (sample.shown == kBackground || sample.is_covered);
    const PolygonId seen =
        with_caps(sample, is_right ? sample.shown : seen_at(sample));
    Mismatch found{sample.i, sample.j, sample.shown, seen, {}, {}};
    if (!shown_.colors.pixels.empty()) {
      found.shown_color = sample.color;
      found.expected_color = color_of(sample, seen, found.shown_color);
    }
    if (found.shown == found.expected &&
        found.shown_color == found.expected_color) {
      return;
    }
    ++report_.mismatches;
    if (report_.first.size() < how_.kept) report_.first.push_back(found);
  }

  const Scene& scene_;
  const Camera& camera_;
  const ImageOptions& options_;
  const Shown& shown_;
  const Options& how_;
  Polygons polygons_;
  Samples samples_;
  bool has_caps_;
  /// The index in `prepared_` of each polygon, or kNotPrepared. Only polygons
  /// that samples show are kept: memory traffic dominates the time.
  std::vector<std::int32_t> number_;
  std::vector<Prepared> prepared_;
  /// For each sample, the polygons that may hide the shown one.
  Pairs rivals_;
  Pairs walls_;  ///< those that caps depend on
  Report report_;
};

std::string to_string(Rgb color) {
  return std::to_string(color.r) + " " + std::to_string(color.g) + " " +
         std::to_string(color.b);
}

}  // namespace

void Report::add(const Report& other) {
  pixels += other.pixels;
  by_reference += other.by_reference;
  mismatches += other.mismatches;
  first.insert(first.end(), other.first.begin(), other.first.end());
}

Report check(const Scene& scene, const Camera& camera,
             const ImageOptions& options, const Shown& shown,
             const Options& how) {
  HALFSPACE_ASSERT(how.share > 0 && how.share <= 1);
  return Checker(scene, camera, options, shown, how).run();
}

std::string to_string(const Mismatch& mismatch) {
  return "pixel " + std::to_string(mismatch.i) + " " +
         std::to_string(mismatch.j) + ": shown polygon " +
         std::to_string(mismatch.shown) + ", colour " +
         to_string(mismatch.shown_color) + "; expected polygon " +
         std::to_string(mismatch.expected) + ", colour " +
         to_string(mismatch.expected_color);
}

std::string reproducer(const Scene& scene, const Camera& camera,
                       const ImageOptions& options, const Report& report) {
  std::string text;
  for (const Mismatch& mismatch : report.first)
    text += "# " + to_string(mismatch) + "\n";
  return text + write_scene({scene, camera, options});
}

}  // namespace halfspace::shadow
