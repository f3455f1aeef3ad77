#include <algorithm>
#include <numeric>
#include <optional>

#include "adapters/both.hpp"
#include "adapters/scenes.hpp"
#include "definition/definition.hpp"
#include "laws/law.hpp"

namespace halfspace {
namespace {

using generate::mask_of;
using generate::spans_of;
using Mask = std::uint64_t;

/// The instruction set that an implementation is bound to, if it is.
template <class Impl>
std::optional<fast::SimdLevel> level_of() {
  if constexpr (requires { Impl::kLevel; }) return Impl::kLevel;
  return std::nullopt;
}

/// A law is checked on the reference, and on the fast library by every
/// instruction set that this machine has.
template <class Impl>
class S4Screen : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto level = level_of<Impl>();
    if (level && !fast::is_supported(*level))
      GTEST_SKIP() << "this machine has no " << level_name(*level);
  }
};
using ScreenImplementations =
    ::testing::Types<Ref, FastBy<fast::SimdLevel::kPortable>,
                     FastBy<fast::SimdLevel::kAvx2>,
                     FastBy<fast::SimdLevel::kAvx512>>;
TYPED_TEST_SUITE(S4Screen, ScreenImplementations);

/// The row of S4.7 whose condition holds; 0 for none, -1 for several.
int row_of(Span object, Span unlit) {
  const std::int32_t i = object.first, j = object.last;
  const std::int32_t min = unlit.first, max = unlit.last;
  const bool holds[] = {j < min,
                        i <= min && min <= j && j < max,
                        min < i && j < max,
                        i <= min && j == max,
                        min < i && i <= max && j == max,
                        i <= min && j > max,
                        min < i && i <= max && max<j, i> max};
  int row = 0;
  for (int k = 0; k < 8; ++k) {
    if (holds[k]) row = row == 0 ? k + 1 : -1;
  }
  return row;
}

/// Calls `visit` for every two spans of a line of eight pixels.
template <class Visit>
void for_all_span_pairs(const Visit& visit) {
  for (std::int32_t a = 0; a < 8; ++a) {
    for (std::int32_t b = a; b < 8; ++b) {
      for (std::int32_t c = 0; c < 8; ++c) {
        for (std::int32_t d = c; d < 8; ++d) visit(Span{a, b}, Span{c, d});
      }
    }
  }
}

bool is_sorted_without_overlap(const std::vector<Span>& spans) {
  for (std::size_t k = 0; k < spans.size(); ++k) {
    if (spans[k].first > spans[k].last) return false;
    if (k > 0 && spans[k].first <= spans[k - 1].last) return false;
  }
  return true;
}

/// Splits every span of more than one pixel in two, so that segments touch.
std::vector<Span> cut_up(const std::vector<Span>& spans) {
  std::vector<Span> pieces;
  for (const Span& span : spans) {
    if (span.first == span.last) {
      pieces.push_back(span);
    } else {
      const std::int32_t middle = (span.first + span.last) / 2;
      pieces.push_back({span.first, middle});
      pieces.push_back({middle + 1, span.last});
    }
  }
  return pieces;
}

/// Checks merging on all lines of eight pixels, then on long ones.
template <class Check>
void for_all_lines(const Check& check) {
  for (Mask objects = 0; objects < 256; ++objects) {
    for (Mask unlit = 0; unlit < 256; ++unlit) {
      check(spans_of(objects), spans_of(unlit));
      check(cut_up(spans_of(objects)), spans_of(unlit));
      check(spans_of(objects), cut_up(spans_of(unlit)));
    }
  }
  law::check(500, [&] {
    const generate::Line line = *generate::lines();
    const auto more = *rc::gen::arbitrary<Mask>();
    check(spans_of(line.objects), spans_of(line.unlit));
    check(spans_of(line.objects & more), spans_of(line.unlit | ~more));
    check(spans_of(line.objects | more), cut_up(spans_of(line.unlit & more)));
  });
}

TYPED_TEST(S4Screen, L1ExactlyOneCaseHoldsAndItIsNamed) {
  std::vector<int> met(9, 0);
  for_all_span_pairs([&](Span object, Span unlit) {
    const int row = row_of(object, unlit);
    ASSERT_GE(row, 1);
    EXPECT_EQ(static_cast<int>(TypeParam::merge_case(object, unlit)), row);
    ++met[static_cast<std::size_t>(row)];
  });
  for (std::size_t row = 1; row <= 8; ++row) EXPECT_GT(met[row], 0) << row;
}

TYPED_TEST(S4Screen, L2AMergeOfTwoSegmentsDoesWhatItsRowSays) {
  using Spans = std::vector<Span>;
  for_all_span_pairs([&](Span object, Span unlit) {
    const std::int32_t i = object.first, j = object.last;
    const std::int32_t min = unlit.first, max = unlit.last;
    const std::pair<Spans, Spans> rows[] = {
        {{}, {unlit}},
        {{{min, j}}, {{j + 1, max}}},
        {{{i, j}}, {{min, i - 1}, {j + 1, max}}},
        {{{min, max}}, {}},
        {{{i, max}}, {{min, i - 1}}},
        {{{min, max}}, {}},
        {{{i, max}}, {{min, i - 1}}},
        {{}, {unlit}}};
    const auto row = static_cast<std::size_t>(row_of(object, unlit));
    EXPECT_EQ(TypeParam::merge({object}, {unlit}), rows[row - 1])
        << "case " << row << ": " << i << ".." << j << " against " << min
        << ".." << max;
  });
}

TYPED_TEST(S4Screen, L3LitPixelsAreTheIntersection) {
  for_all_lines([](const auto& objects, const auto& unlit) {
    const auto lit = TypeParam::merge(objects, unlit).first;
    HALFSPACE_LAW(mask_of(lit) == (mask_of(objects) & mask_of(unlit)));
  });
}

TYPED_TEST(S4Screen, L4PixelsLeftUnlitAreTheDifference) {
  for_all_lines([](const auto& objects, const auto& unlit) {
    const auto left = TypeParam::merge(objects, unlit).second;
    HALFSPACE_LAW(mask_of(left) == (mask_of(unlit) & ~mask_of(objects)));
  });
}

TYPED_TEST(S4Screen, L5AMergeReturnsSortedSegmentsWithoutOverlap) {
  for_all_lines([](const auto& objects, const auto& unlit) {
    const auto [lit, left] = TypeParam::merge(objects, unlit);
    HALFSPACE_LAW(is_sorted_without_overlap(lit));
    HALFSPACE_LAW(is_sorted_without_overlap(left));
  });
}

TYPED_TEST(S4Screen, L6TheOrderOfObjectsDoesNotChangeWhatIsLeft) {
  law::check(300, [] {
    auto order =
        *rc::gen::container<std::vector<Mask>>(rc::gen::arbitrary<Mask>());
    const auto sparse = *rc::gen::arbitrary<Mask>();
    const auto left_by = [&](const std::vector<Mask>& objects) {
      std::vector<Span> unlit = {{0, 63}};
      for (const Mask mask : objects)
        unlit = TypeParam::merge(spans_of(mask & sparse), unlit).second;
      return mask_of(unlit);
    };
    const Mask forwards = left_by(order);
    std::reverse(order.begin(), order.end());
    HALFSPACE_LAW(left_by(order) == forwards);
  });
}

/// The pixels of a fragment's object segments, 1 for each that names one.
template <class Impl>
Grid2<std::uint8_t> pixels_of(const Scene& scene,
                              const typename Impl::Fragment& fragment,
                              const Camera& camera) {
  Grid2<std::uint8_t> pixels(camera->width_px, camera->height_px, 0);
  std::int32_t last_line = -1;
  for (const auto& [line, span] : Impl::scan_convert(scene, fragment, camera)) {
    HALFSPACE_LAW(line > last_line);
    HALFSPACE_LAW(line < camera->height_px);
    HALFSPACE_LAW(0 <= span.first && span.first <= span.last);
    HALFSPACE_LAW(span.last < camera->width_px);
    for (std::int32_t i = span.first; i <= span.last; ++i)
      pixels.at(i, line) += 1;
    last_line = line;
  }
  return pixels;
}

TYPED_TEST(S4Screen, L7ObjectSegmentsAreTheCoveredSamples) {
  int covered = 0;
  law::for_all_views([&](const SceneFile& view) {
    for (const auto& fragment : fragments_of<TypeParam>(view.scene)) {
      const auto facet =
          definition::facet_of(view.scene, TypeParam::name_of(fragment));
      const auto expected = definition::coverage(facet, *view.camera, false);
      HALFSPACE_LAW(pixels_of<TypeParam>(view.scene, fragment, *view.camera) ==
                    expected);
      covered +=
          std::accumulate(expected.pixels.begin(), expected.pixels.end(), 0);
    }
  });
  EXPECT_GT(covered, 5000);
}

TYPED_TEST(S4Screen, L8PartsOfASplitShareOutItsSamples) {
  int shared = 0;
  law::for_all_views([&](const SceneFile& view) {
    const Scene& scene = view.scene;
    const auto count = static_cast<PolygonId>(scene.polygon_count());
    for (const auto& fragment : fragments_of<TypeParam>(scene)) {
      for (PolygonId q = 0; q < count; ++q) {
        if (TypeParam::relation(scene, fragment, q) != Relation::kSpanning)
          continue;
        const auto parts = TypeParam::split(scene, fragment, q);
        const auto all = pixels_of<TypeParam>(scene, fragment, *view.camera);
        auto sum = pixels_of<TypeParam>(scene, parts.first, *view.camera);
        const auto other =
            pixels_of<TypeParam>(scene, parts.second, *view.camera);
        for (std::size_t k = 0; k < sum.pixels.size(); ++k)
          sum.pixels[k] += other.pixels[k];
        HALFSPACE_LAW(sum == all);
        ++shared;
      }
    }
  });
  EXPECT_GT(shared, 100);
}

TYPED_TEST(S4Screen, L9AReversedFragmentCoversTheSameSamples) {
  law::for_all_views([](const SceneFile& view) {
    const Scene other = reversed(view.scene);
    const auto count = static_cast<PolygonId>(other.polygon_count());
    for (PolygonId p = 0; p < count; ++p) {
      HALFSPACE_LAW(pixels_of<TypeParam>(view.scene,
                                         TypeParam::whole(view.scene, p),
                                         *view.camera) ==
                    pixels_of<TypeParam>(other, TypeParam::whole(other, p),
                                         *view.camera));
    }
  });
}

TYPED_TEST(S4Screen, L10ANearDistanceTakesAwayWhatIsNotBeyondIt) {
  int taken = 0, left = 0;
  law::for_all_views([&](const SceneFile& view) {
    CameraData data = view.camera->data();
    data.near.reset();
    const Camera far = *make_camera(data, view.scene.grid_bits());
    for (const std::int64_t k : {0, 20000, 65536, 100000}) {
      data.near = k;
      const Camera near = *make_camera(data, view.scene.grid_bits());
      const auto count = static_cast<PolygonId>(view.scene.polygon_count());
      for (PolygonId p = 0; p < count; ++p) {
        const auto fragment = TypeParam::whole(view.scene, p);
        const auto before = pixels_of<TypeParam>(view.scene, fragment, far);
        const auto after = pixels_of<TypeParam>(view.scene, fragment, near);
        const auto seen = definition::project(
            definition::facet_of(view.scene, definition::whole(view.scene, p)),
            far, false);
        // num / den > k / 2^16, as an affine function.
        const definition::Affine beyond{
            (seen.num.c << kNearBits) - k * seen.den.c,
            (seen.num.x << kNearBits) - k * seen.den.x,
            (seen.num.y << kNearBits) - k * seen.den.y};
        for (std::int32_t j = 0; j < data.height_px; ++j) {
          for (std::int32_t i = 0; i < data.width_px; ++i) {
            const bool is_beyond = definition::sign_at_sample(beyond, i, j) > 0;
            HALFSPACE_LAW(after.at(i, j) == (is_beyond ? before.at(i, j) : 0));
            taken += before.at(i, j) - after.at(i, j);
            left += after.at(i, j);
          }
        }
      }
    }
  });
  EXPECT_GT(taken, 1000);
  EXPECT_GT(left, 1000);
}

TYPED_TEST(S4Screen, L11TheScreenIsFullWhenEveryPixelWasLitOnce) {
  int filled = 0;
  law::check(300, [&] {
    const auto width = *rc::gen::resize(100, rc::gen::inRange(1, 12));
    const auto height = *rc::gen::resize(100, rc::gen::inRange(1, 5));
    const auto steps = *rc::gen::resize(
        60, rc::gen::container<std::vector<std::pair<int, Mask>>>(
                rc::gen::pair(rc::gen::resize(100, rc::gen::inRange(0, 60)),
                              rc::gen::arbitrary<Mask>())));
    typename TypeParam::DynamicScreen screen(width, height);
    Grid2<int> times(width, height, 0);
    const Mask line = (Mask{1} << width) - 1;
    for (const auto& [where, mask] : steps) {
      const std::int32_t j = where % height;
      screen.merge(j, spans_of(mask & line), [&](Span lit) {
        for (std::int32_t i = lit.first; i <= lit.last; ++i)
          times.at(i, j) += 1;
      });
      const auto least =
          *std::min_element(times.pixels.begin(), times.pixels.end());
      const auto most =
          *std::max_element(times.pixels.begin(), times.pixels.end());
      HALFSPACE_LAW(most <= 1);
      HALFSPACE_LAW(screen.full() == (least == 1));
      filled += screen.full() ? 1 : 0;
    }
  });
  EXPECT_GT(filled, 0);
}

}  // namespace
}  // namespace halfspace
