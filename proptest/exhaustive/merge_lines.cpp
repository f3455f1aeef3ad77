#include "merge_lines.hpp"

#include <bit>
#include <span>
#include <vector>

#include "halfspace/fast/screen.hpp"
#include "halfspace/ref/screen.hpp"

namespace halfspace::exhaustive {
namespace {

/// Cases in the order of the steps, three bits each: a line of 16 pixels has
/// at most 8 segments in either list, and every step settles one.
using Steps = std::uint64_t;

Steps followed_by(Steps steps, MergeCase last) {
  return steps << 3 | (static_cast<Steps>(last) - 1);
}

/// The segments of every set, once.
class Lines {
 public:
  explicit Lines(int width_px) {
    const std::uint32_t count = 1u << width_px;
    segments_.resize(count);
    for (std::uint32_t set = 0; set < count; ++set) {
      for (std::uint32_t left = set; left != 0;) {
        const std::uint32_t run = lowest_run(left);
        segments_[set].push_back(span_of(run));
        left &= ~run;
      }
    }
  }

  const std::vector<Span>& of(std::uint32_t set) const {
    return segments_[set];
  }

  /// The lowest bits of `set` that stand together.
  static std::uint32_t lowest_run(std::uint32_t set) {
    return set & ~(set + (set & (~set + 1)));
  }

  static Span span_of(std::uint32_t run) {
    return {std::countr_zero(run), 31 - std::countl_zero(run)};
  }

 private:
  std::vector<std::vector<Span>> segments_;
};

/// The row of S4.7 that two runs of bits are in, by which pixels they have.
MergeCase case_of_bits(std::uint32_t object, std::uint32_t unlit) {
  using enum MergeCase;
  if ((object & unlit) == 0) return object < unlit ? k1 : k8;
  const std::uint32_t before_object = (object & (~object + 1)) - 1;
  const bool left = (unlit & before_object) != 0;
  const bool right = unlit >> std::bit_width(object) != 0;
  const bool over = object >> std::bit_width(unlit) != 0;
  if (right) return left ? k3 : k2;
  if (over) return left ? k7 : k6;
  return left ? k5 : k4;
}

/// The steps by sets of bits. Of two runs the one that ends first is settled,
/// with the pixels up to its end; both are if they end together.
Steps steps_of_bits(std::uint32_t objects, std::uint32_t unlit) {
  Steps steps = 1;
  while (objects != 0 && unlit != 0) {
    const std::uint32_t object = Lines::lowest_run(objects);
    const std::uint32_t line = Lines::lowest_run(unlit);
    steps = followed_by(steps, case_of_bits(object, line));
    const bool object_ends_last = object >> std::bit_width(line) != 0;
    const std::uint32_t settled =
        (1u << std::bit_width(object_ends_last ? line : object)) - 1;
    if (!object_ends_last) objects &= ~object;
    unlit &= ~settled;
  }
  return steps;
}

/// What a merge did, step by step.
struct Trace {
  std::vector<Span> lit;
  std::vector<Span> unlit;
  Steps steps = 1;

  void clear() {
    lit.clear();
    unlit.clear();
    steps = 1;
  }
};

/// F2B's Merge by the reference's Merge-segment, its steps written down.
void trace_ref(const std::vector<Span>& objects, ref::UnlitList& list,
               Trace& trace) {
  const ref::PaintSegment paint = [&trace](Span lit) {
    trace.lit.push_back(lit);
  };
  auto object = objects.begin();
  auto unlit = list.begin();
  while (object != objects.end() && unlit != list.end()) {
    trace.steps = followed_by(trace.steps, ref::merge_case(*object, *unlit));
    ref::merge_segment(object, list, unlit, paint);
  }
  trace.unlit.assign(list.begin(), list.end());
}

/// The same by the fast library's cases and what S4.7's rows say to do.
Steps trace_fast(std::span<const Span> objects, std::span<const Span> unlit) {
  using enum MergeCase;
  Steps steps = 1;
  std::size_t o = 0, u = 0;
  Span line = unlit.empty() ? Span{} : unlit[0];
  while (o < objects.size() && u < unlit.size()) {
    const MergeCase found = fast::merge_case(objects[o], line);
    steps = followed_by(steps, found);
    if (found == k2 || found == k3) line.first = objects[o].last + 1;
    if (found <= k5) ++o;
    if (found < k4) continue;
    ++u;
    if (u < unlit.size()) line = unlit[u];
  }
  return steps;
}

std::string words(const std::vector<Span>& segments) {
  std::string text;
  for (const Span& span : segments) {
    text += ' ';
    text += std::to_string(span.first) + ".." + std::to_string(span.last);
  }
  return text.empty() ? " nothing" : text;
}

/// What the pair's numbers mean, for whoever has to look into it.
std::string described(const Lines& lines, std::uint32_t objects,
                      std::uint32_t unlit, const char* what) {
  return std::string(what) + ": objects" + words(lines.of(objects)) +
         ", unlit" + words(lines.of(unlit));
}

/// What differs in one pair; nothing if all agree.
const char* difference(const Lines& lines, std::uint32_t objects,
                       std::uint32_t unlit, Steps steps, Trace& trace,
                       ref::UnlitList& list) {
  const std::vector<Span>& object_line = lines.of(objects);
  const std::vector<Span>& unlit_line = lines.of(unlit);
  const std::vector<Span>& lit = lines.of(objects & unlit);
  const std::vector<Span>& left = lines.of(unlit & ~objects);
  trace.clear();
  // Into the nodes that the list has: most of the time would go there.
  list.assign(unlit_line.begin(), unlit_line.end());
  trace_ref(object_line, list, trace);
  if (trace.lit != lit) return "lit by the reference";
  if (trace.unlit != left) return "left unlit by the reference";
  if (trace.steps != steps) return "cases of the reference";
  const fast::Merged merged = fast::merge(object_line, unlit_line);
  if (merged.lit != lit) return "lit by the fast library";
  if (merged.unlit != left) return "left unlit by the fast library";
  if (trace_fast(object_line, unlit_line) != steps)
    return "cases of the fast library";
  return nullptr;
}

}  // namespace

void MergeTally::add(const MergeTally& other) {
  if (mismatches == 0) first_mismatch = other.first_mismatch;
  pairs += other.pairs;
  steps += other.steps;
  mismatches += other.mismatches;
  for (int k = 0; k < 9; ++k) steps_of_case[k] += other.steps_of_case[k];
}

MergeTally merge_lines(int width_px, std::uint32_t first, std::uint32_t end) {
  const Lines lines(width_px);
  MergeTally tally;
  Trace trace;
  ref::UnlitList list;
  for (std::uint32_t objects = first; objects < end; ++objects) {
    for (std::uint32_t unlit = 0; unlit < 1u << width_px; ++unlit) {
      Steps steps = steps_of_bits(objects, unlit);
      const char* what = difference(lines, objects, unlit, steps, trace, list);
      ++tally.pairs;
      if (what != nullptr && tally.mismatches++ == 0)
        tally.first_mismatch = described(lines, objects, unlit, what);
      for (; steps != 1; steps >>= 3) {
        ++tally.steps;
        ++tally.steps_of_case[(steps & 7) + 1];
      }
    }
  }
  return tally;
}

}  // namespace halfspace::exhaustive
