#include "halfspace/shadow/check.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <utility>

#include "halfspace/assert.hpp"
#include "halfspace/ref/raycast.hpp"
#include "halfspace/ref/shade.hpp"
#include "halfspace/scene_file.hpp"
#include "polygons.hpp"

namespace halfspace::shadow {
namespace {

/// A chosen pixel.
struct Sample {
  std::int32_t i = 0;  ///< in the whole image
  std::int32_t j = 0;
  PolygonId shown = kBackground;
  bool is_covered = false;  ///< by `shown`, certainly
  bool is_sure = true;      ///< no other polygon may hide it
};

/// Pixels of a part of an image: one of every `step` in the order of rows.
class Samples {
 public:
  Samples(const Shown& shown, const Options& how)
      : left_(shown.left),
        top_(shown.top),
        width_(static_cast<std::size_t>(shown.items.width_px)),
        step_(static_cast<std::size_t>(
            std::clamp(std::floor(1 / how.share), 1.0, 0x1p40))),
        inverse_(1 / static_cast<double>(step_)) {
    const std::size_t pixels = shown.items.pixels.size();
    std::uint64_t state = how.seed;
    for (std::size_t first = 0; first < pixels; first += step_) {
      const std::size_t length = std::min(step_, pixels - first);
      const std::size_t at = first + next(state) % length;
      all_.push_back({left_ + static_cast<std::int32_t>(at % width_),
                      top_ + static_cast<std::int32_t>(at / width_),
                      shown.items.pixels[at]});
    }
  }

  std::vector<Sample>& all() { return all_; }

  /// Calls `visit` with every sample within the bounds.
  template <class Visit>
  void within(const Bounds& bounds, const Visit& visit) {
    const std::int32_t right = left_ + static_cast<std::int32_t>(width_) - 1;
    const std::int32_t first_column = std::max(bounds.left, left_);
    const std::int32_t last_column = std::min(bounds.right, right);
    if (first_column > last_column) return;
    // A product is soon made and may be off by one: so one more at either end.
    const auto last_sample = static_cast<std::ptrdiff_t>(all_.size()) - 1;
    for (std::int32_t j = std::max(bounds.top, top_); j <= bounds.bottom; ++j) {
      const auto first =
          std::max<std::ptrdiff_t>(near(offset(first_column, j)) - 1, 0);
      if (first > last_sample) return;
      const auto last = std::min(near(offset(last_column, j)) + 1, last_sample);
      for (std::ptrdiff_t n = first; n <= last; ++n) {
        Sample& sample = all_[static_cast<std::size_t>(n)];
        if (sample.j == j && sample.i >= first_column &&
            sample.i <= last_column) {
          visit(sample);
        }
      }
    }
  }

 private:
  /// The generator splitmix64.
  static std::uint64_t next(std::uint64_t& state) {
    std::uint64_t z = state += 0x9e3779b97f4a7c15;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9;
    z = (z ^ z >> 27) * 0x94d049bb133111eb;
    return z ^ z >> 31;
  }
  std::size_t offset(std::int32_t i, std::int32_t j) const {
    return static_cast<std::size_t>(j - top_) * width_ +
           static_cast<std::size_t>(i - left_);
  }

  /// The number of the sample chosen around a pixel, or one off.
  std::ptrdiff_t near(std::size_t offset) const {
    return static_cast<std::ptrdiff_t>(static_cast<double>(offset) * inverse_);
  }

  std::int32_t left_, top_;
  std::size_t width_, step_;
  double inverse_;
  std::vector<Sample> all_;
};

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
        prepared_(scene.polygon_count()) {}

  Report run() {
    if (!how_.by_reference_only) {
      prepare();
      for (const auto& [sample, id] : near_) judge(*sample, id);
    }
    std::sort(rivals_.begin(), rivals_.end());
    report_.pixels = samples_.all().size();
    for (Sample& sample : samples_.all()) conclude(sample);
    return std::move(report_);
  }

 private:
  bool is_id(PolygonId id) const {
    return id >= 0 && id < std::ssize(prepared_);
  }
  const Prepared& prepared(PolygonId id) const {
    return prepared_[static_cast<std::size_t>(id)];
  }

  /// Prepares the polygons that are near a sample.
  void prepare() {
    for (PolygonId id = 0; id < std::ssize(prepared_); ++id) {
      const std::size_t before = near_.size();
      samples_.within(polygons_.bounds_of(id), [&](Sample& sample) {
        near_.push_back({&sample, id});
      });
      if (near_.size() > before)
        prepared_[static_cast<std::size_t>(id)] = polygons_.prepare(id);
    }
  }

  /// Compares the polygon with what the sample shows.
  void judge(Sample& sample, PolygonId id) {
    const Prepared& polygon = prepared(id);
    const Verdict verdict = polygons_.covers(polygon, sample.i, sample.j);
    if (verdict == Verdict::kNo) return;
    if (id == sample.shown) {
      sample.is_covered = verdict == Verdict::kYes;
      return;
    }
    if (is_id(sample.shown) &&
        Polygons::is_nearer(prepared(sample.shown), polygon, sample.i,
                            sample.j)) {
      return;
    }
    sample.is_sure = false;
    rivals_.push_back({&sample, id});
  }

  /// What the sample sees, by the reference's rays.
  PolygonId seen_at(const Sample& sample) {
    ++report_.by_reference;
    if (how_.by_reference_only) return cast_at_all(sample);
    std::vector<PolygonId> ids;
    if (is_id(sample.shown)) ids.push_back(sample.shown);
    const auto first = std::lower_bound(
        rivals_.begin(), rivals_.end(), std::pair(&sample, PolygonId{0}),
        [](const auto& a, const auto& b) { return a.first < b.first; });
    for (auto rival = first; rival != rivals_.end() && rival->first == &sample;
         ++rival) {
      ids.push_back(rival->second);
    }
    std::sort(ids.begin(), ids.end());
    const PolygonId seen =
        ref::raycast_at(scene_, camera_, options_, sample.i, sample.j, ids);
    // If it does not see what it shows, then that has ruled out nothing.
    return seen == sample.shown ? seen : cast_at_near(sample);
  }

  PolygonId cast_at_all(const Sample& sample) const {
    std::vector<PolygonId> ids(prepared_.size());
    std::iota(ids.begin(), ids.end(), PolygonId{0});
    return ref::raycast_at(scene_, camera_, options_, sample.i, sample.j, ids);
  }

  /// The same, without the polygons that doubles rule out.
  PolygonId cast_at_near(const Sample& sample) const {
    std::vector<PolygonId> ids;
    for (const auto& [near, id] : near_) {
      if (near == &sample &&
          polygons_.covers(prepared(id), sample.i, sample.j) != Verdict::kNo) {
        ids.push_back(id);
      }
    }
    return ref::raycast_at(scene_, camera_, options_, sample.i, sample.j, ids);
  }

  /// Whether the polygon's colour changes over it (S5.4).
  bool is_shaded(PolygonId id) const {
    const auto colors = scene_.corner_colors(id);
    return options_.shading == Shading::kGouraud &&
           std::adjacent_find(colors.begin(), colors.end(),
                              std::not_equal_to<>()) != colors.end();
  }

  Rgb color_of(const Sample& sample, PolygonId seen, Rgb shown) {
    if (seen == kBackground) return options_.background;
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
    const PolygonId seen = is_right ? sample.shown : seen_at(sample);
    Mismatch found{sample.i, sample.j, sample.shown, seen, {}, {}};
    if (!shown_.colors.pixels.empty()) {
      found.shown_color =
          shown_.colors.at(sample.i - shown_.left, sample.j - shown_.top);
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
  std::vector<Prepared> prepared_;
  /// Samples, and the polygons around them, which alone they may see.
  std::vector<std::pair<Sample*, PolygonId>> near_;
  /// Polygons that may hide what a sample shows, by sample.
  std::vector<std::pair<const Sample*, PolygonId>> rivals_;
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
