#include <array>
#include <bit>

#include "../proptest/adapters/screen_line.hpp"
#include "fuzz.hpp"
#include "halfspace/fast/screen.hpp"
#include "halfspace/ref/screen.hpp"

namespace halfspace {
namespace {

/// A line of 64 pixels is a set of bits.
using Line = std::uint64_t;

/// Segments as bits: the pixels, and those at which a new segment begins even
/// where the one before it has not ended.
struct Segments {
  Line pixels = 0;
  Line cuts = 0;

  /// The first segment. Requires: there is one.
  Line first() const {
    const Line low = pixels & (~pixels + 1);
    const Line run = pixels & ~(pixels + low);
    const Line cut = run & cuts & ~low;
    return cut == 0 ? run : run & ((cut & (~cut + 1)) - 1);
  }
};

/// What is beyond the last pixel of a segment.
Line beyond(Line segment) { return ~(~Line{0} >> std::countl_zero(segment)); }

void list(Segments segments, std::vector<Span>& spans) {
  spans.clear();
  while (segments.pixels != 0) {
    const Line segment = segments.first();
    spans.push_back(
        {std::countr_zero(segment), 63 - std::countl_zero(segment)});
    segments.pixels &= ~segment;
  }
}

template <class Spans>
Line pixels_of(const Spans& spans) {
  Line pixels = 0;
  std::int32_t next = 0;
  for (const Span& span : spans) {
    HALFSPACE_FUZZ_EXPECT(next <= span.first && span.first <= span.last);
    HALFSPACE_FUZZ_EXPECT(span.last <= 63);
    pixels |= ~Line{0} >> (63 - span.last) & ~Line{0} << span.first;
    next = span.last + 1;
  }
  return pixels;
}

/// The row of S4.7 that two segments are in, by which pixels they have.
MergeCase case_of(Line object, Line unlit) {
  using enum MergeCase;
  if ((object & unlit) == 0) return object < unlit ? k1 : k8;
  const bool left = (unlit & ((object & (~object + 1)) - 1)) != 0;
  if ((unlit & beyond(object)) != 0) return left ? k3 : k2;
  if ((object & beyond(unlit)) != 0) return left ? k7 : k6;
  return left ? k5 : k4;
}

/// F2B's Merge by sets of bits, a step at a time. Of two segments the one that
/// ends first is settled, with all before; both are if they end together.
class Steps {
 public:
  Steps(Segments objects, Segments unlit) : objects_(objects), unlit_(unlit) {}

  bool done() const { return objects_.pixels == 0 || unlit_.pixels == 0; }

  MergeCase next() {
    const Line object = objects_.first();
    const Line line = unlit_.first();
    const bool object_goes_on = (object & beyond(line)) != 0;
    if (!object_goes_on) objects_.pixels &= ~object;
    unlit_.pixels &= beyond(object_goes_on ? line : object);
    return case_of(object, line);
  }

 private:
  Segments objects_;
  Segments unlit_;
};

/// What a run needs again and again: nearly nothing is allocated by a target
/// that runs as often as it can.
struct Scratch {
  Scratch() {
    for (const fast::SimdLevel level : kSimdLevels) {
      if (fast::is_supported(level)) {
        lines.emplace_back(64, level);
        screens.emplace_back(64, 1, level);
      }
    }
  }

  /// The fast library's screen by every instruction set that this machine has.
  std::vector<ScreenLine> lines;
  std::vector<fast::DynamicScreen> screens;
  std::vector<Span> objects;
  std::vector<Span> unlit;
  std::vector<Span> lit;
  ref::UnlitList list;
  ref::PaintSegment paint = [this](Span span) { lit.push_back(span); };
};

/// By the reference's Merge-segment: the case of every step, and what is lit.
void merge_by_ref(Steps steps, Scratch& scratch) {
  scratch.lit.clear();
  scratch.list.assign(scratch.unlit.begin(), scratch.unlit.end());
  auto object = scratch.objects.cbegin();
  auto unlit = scratch.list.begin();
  while (object != scratch.objects.cend() && unlit != scratch.list.end()) {
    HALFSPACE_FUZZ_EXPECT(!steps.done());
    HALFSPACE_FUZZ_EXPECT(ref::merge_case(*object, *unlit) == steps.next());
    ref::merge_segment(object, scratch.list, unlit, scratch.paint);
  }
  HALFSPACE_FUZZ_EXPECT(steps.done());
}

/// The cases of the fast library, carried on by the rows of S4.7.
void expect_fast_cases(Steps steps, const Scratch& scratch) {
  using enum MergeCase;
  std::size_t o = 0, u = 0;
  Span line = scratch.unlit.empty() ? Span{} : scratch.unlit[0];
  while (o < scratch.objects.size() && u < scratch.unlit.size()) {
    const MergeCase found = fast::merge_case(scratch.objects[o], line);
    HALFSPACE_FUZZ_EXPECT(!steps.done() && found == steps.next());
    if (found == k2 || found == k3) line.first = scratch.objects[o].last + 1;
    if (found <= k5) ++o;
    if (found < k4) continue;
    if (++u < scratch.unlit.size()) line = scratch.unlit[u];
  }
  HALFSPACE_FUZZ_EXPECT(steps.done());
}

/// One merge, by all.
void expect_merge(Segments objects, Segments unlit, Scratch& scratch) {
  list(objects, scratch.objects);
  list(unlit, scratch.unlit);
  merge_by_ref({objects, unlit}, scratch);
  HALFSPACE_FUZZ_EXPECT(pixels_of(scratch.lit) ==
                        (objects.pixels & unlit.pixels));
  HALFSPACE_FUZZ_EXPECT(pixels_of(scratch.list) ==
                        (unlit.pixels & ~objects.pixels));
  for (ScreenLine& line : scratch.lines) {
    const auto& by_fast = line.merge(scratch.objects, scratch.unlit);
    HALFSPACE_FUZZ_EXPECT(by_fast.lit == scratch.lit);
    HALFSPACE_FUZZ_EXPECT(std::equal(by_fast.unlit.begin(), by_fast.unlit.end(),
                                     scratch.list.begin(), scratch.list.end()));
  }
  expect_fast_cases({objects, unlit}, scratch);
}

/// Whether there are bits for a second merge: then a screen takes part.
constexpr std::size_t kBytesOfMerge = 32;

void expect_screen(fuzz::Bytes bytes, Scratch& scratch) {
  ref::DynamicScreen screen(64, 1);
  for (fast::DynamicScreen& one : scratch.screens) one.clear();
  std::vector<Span> unlit = {{0, 63}};
  Line lit = 0;
  while (!bytes.empty()) {
    const Line pixels = bytes.word();
    list({pixels, bytes.word()}, scratch.objects);
    bytes.word();
    bytes.word();
    const auto merged = ref::merge(scratch.objects, unlit);
    scratch.lit.clear();
    screen.merge(0, scratch.objects, scratch.paint);
    HALFSPACE_FUZZ_EXPECT(scratch.lit == merged.lit);
    HALFSPACE_FUZZ_EXPECT(pixels_of(merged.lit) == (pixels & ~lit));
    HALFSPACE_FUZZ_EXPECT(pixels_of(merged.unlit) == ~(pixels | lit));
    unlit = merged.unlit;
    lit |= pixels;
    HALFSPACE_FUZZ_EXPECT(screen.full() == (~lit == 0));
    for (fast::DynamicScreen& one : scratch.screens) {
      Line now = 0;
      one.merge(0, scratch.objects, 7,
                [&](std::int32_t line, Span span, PolygonId id) {
                  HALFSPACE_FUZZ_EXPECT(line == 0 && id == 7);
                  now |= pixels_of(std::array{span});
                });
      HALFSPACE_FUZZ_EXPECT(now == pixels_of(merged.lit));
      HALFSPACE_FUZZ_EXPECT(pixels_of(one.unlit(0)) == ~lit);
      HALFSPACE_FUZZ_EXPECT(one.full() == (~lit == 0));
    }
  }
}

}  // namespace
}  // namespace halfspace

/// Merging lists of segments, cut up anyhow, is what their bits say: pixels,
/// segments and the case of every step, by the reference and by the fast
/// library's screen. So it is one after another on a screen.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  using namespace halfspace;
  static Scratch scratch;
  fuzz::Bytes bytes(data, size);
  while (!bytes.empty()) {
    const Segments objects{bytes.word(), bytes.word()};
    const Segments unlit{bytes.word(), bytes.word()};
    expect_merge(objects, unlit, scratch);
  }
  if (size > kBytesOfMerge) expect_screen(fuzz::Bytes(data, size), scratch);
  return 0;
}
