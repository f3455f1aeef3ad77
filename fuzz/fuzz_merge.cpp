#include "fuzz.hpp"
#include "halfspace/fast/screen.hpp"
#include "halfspace/ref/screen.hpp"

namespace halfspace {
namespace {

/// The runs of pixels of a mask; those of `cut` begin a new run.
std::vector<Span> spans_of(std::uint64_t mask, std::uint64_t cut) {
  std::vector<Span> spans;
  for (std::int32_t i = 0; i < 64; ++i) {
    if ((mask >> i & 1u) == 0) continue;
    const bool goes_on =
        !spans.empty() && spans.back().last == i - 1 && (cut >> i & 1u) == 0;
    if (goes_on) {
      spans.back().last = i;
    } else {
      spans.push_back({i, i});
    }
  }
  return spans;
}

std::uint64_t mask_of(const std::vector<Span>& spans) {
  std::uint64_t mask = 0;
  std::int32_t next = 0;
  for (const Span& span : spans) {
    HALFSPACE_FUZZ_EXPECT(next <= span.first && span.first <= span.last);
    for (std::int32_t i = span.first; i <= span.last; ++i)
      mask |= std::uint64_t{1} << i;
    next = span.last + 1;
  }
  return mask;
}

}  // namespace
}  // namespace halfspace

/// Merging lists of segments is what their masks say, on a line of 64 pixels
/// and, one after another, on a screen.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  using namespace halfspace;
  fuzz::Bytes bytes(data, size);
  ref::DynamicScreen screen(64, 1);
  std::uint64_t lit = 0;
  std::vector<Span> unlit = {{0, 63}};
  while (!bytes.empty()) {
    const std::uint64_t mask = bytes.word();
    const auto objects = spans_of(mask, bytes.word());
    // By lists, from what the merges before left.
    const auto merged = ref::merge(objects, unlit);
    HALFSPACE_FUZZ_EXPECT(mask_of(merged.lit) == (mask & ~lit));
    HALFSPACE_FUZZ_EXPECT(mask_of(merged.unlit) == ~(mask | lit));
    unlit = merged.unlit;
    // By lists that are cut up anyhow.
    const std::uint64_t some = bytes.word();
    const std::uint64_t cut = bytes.word();
    const auto other = ref::merge(objects, spans_of(some, cut));
    HALFSPACE_FUZZ_EXPECT(mask_of(other.lit) == (mask & some));
    HALFSPACE_FUZZ_EXPECT(mask_of(other.unlit) == (some & ~mask));
    const auto by_fast = fast::merge(objects, spans_of(some, cut));
    HALFSPACE_FUZZ_EXPECT(by_fast.lit == other.lit);
    HALFSPACE_FUZZ_EXPECT(by_fast.unlit == other.unlit);
    for (const Span& object : objects) {
      for (const Span& line : spans_of(some, cut)) {
        HALFSPACE_FUZZ_EXPECT(fast::merge_case(object, line) ==
                              ref::merge_case(object, line));
      }
    }
    // On the screen.
    std::uint64_t now = 0;
    screen.merge(0, objects, [&now](Span span) { now |= mask_of({span}); });
    HALFSPACE_FUZZ_EXPECT(now == (mask & ~lit));
    lit |= mask;
    HALFSPACE_FUZZ_EXPECT(screen.full() == (~lit == 0));
  }
  return 0;
}
