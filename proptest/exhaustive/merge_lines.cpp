#include "merge_lines.hpp"

#include <array>
#include <bit>
#include <span>
#include <utility>
#include <vector>

#include "adapters/screen_line.hpp"
#include "halfspace/fast/screen.hpp"
#include "halfspace/ref/screen.hpp"
#include "halfspace/splitmix.hpp"

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

/// Merges by the reference and by the fast library, and their steps.
class Merger {
 public:
  Merger(int width_px, std::span<const fast::SimdLevel> levels)
      : lines_(width_px) {
    for (const fast::SimdLevel level : levels) {
      fast_.emplace_back(level_name(level), ScreenLine(width_px, level));
    }
  }

  /// What differs in one pair, in words; nothing if all agree.
  std::string difference(std::uint32_t objects, std::uint32_t unlit,
                         Steps steps) {
    const std::vector<Span>& object_line = lines_.of(objects);
    const std::vector<Span>& unlit_line = lines_.of(unlit);
    const std::vector<Span>& lit = lines_.of(objects & unlit);
    const std::vector<Span>& left = lines_.of(unlit & ~objects);
    const auto differs = [&](const char* what, const char* where) {
      return std::string(what) + where + ": objects" + words(object_line) +
             ", unlit" + words(unlit_line);
    };
    trace_.clear();
    // Into the nodes that the list has: most of the time would go there.
    list_.assign(unlit_line.begin(), unlit_line.end());
    trace_ref(object_line, list_, trace_);
    if (trace_.lit != lit) return differs("lit by the reference", "");
    if (trace_.unlit != left) return differs("unlit by the reference", "");
    if (trace_.steps != steps) return differs("cases of the reference", "");
    for (auto& [name, line] : fast_) {
      const ScreenLine::Merged& merged = line.merge(object_line, unlit_line);
      if (merged.lit != lit) return differs("lit by the screen, ", name);
      if (merged.unlit != left) return differs("unlit on the screen, ", name);
    }
    if (trace_fast(object_line, unlit_line) != steps)
      return differs("cases of the fast library", "");
    return {};
  }

 private:
  Lines lines_;
  std::vector<std::pair<const char*, ScreenLine>> fast_;
  Trace trace_;
  ref::UnlitList list_;
};

/// Lines of 64 pixels on one row of tiles, a set of bits each.
class TileRow {
 public:
  static constexpr int kLines = 8;
  using Sets = std::array<std::uint64_t, kLines>;

  explicit TileRow(fast::SimdLevel level)
      : screen_(kShift + 64, kLines, level) {}

  /// Lights the runs of the sets, the k-th of all lines together. Gives what
  /// becomes lit.
  Sets light(const Sets& sets) {
    Sets rest = sets;
    Sets lit{};
    for (bool more = true; more;) {
      objects_.clear();
      for (int j = 0; j < kLines; ++j) {
        const std::uint64_t set = rest[static_cast<std::size_t>(j)];
        if (set == 0) continue;
        const int first = std::countr_zero(set);
        const int last = first + std::countr_one(set >> first) - 1;
        rest[static_cast<std::size_t>(j)] &= ~bits(first, last);
        objects_.push_back({j, {first + kShift, last + kShift}});
      }
      for (const fast::ObjectSegment& run : screen_.light(objects_)) {
        lit[static_cast<std::size_t>(run.line)] |=
            bits(run.span.first - kShift, run.span.last - kShift);
      }
      more = !objects_.empty();
    }
    return lit;
  }

  std::uint64_t unlit(int line) const {
    std::uint64_t set = 0;
    for (const Span& span : screen_.unlit(line)) {
      if (span.first >= kShift) {
        set |= bits(span.first - kShift, span.last - kShift);
      }
    }
    return set;
  }

  bool full() const { return screen_.full(); }
  void clear() {
    screen_.clear();
    for (int j = 0; j < kLines; ++j) {
      const fast::ObjectSegment left = {j, {0, kShift - 1}};
      screen_.light({&left, 1});
    }
  }

 private:
  static constexpr std::int32_t kShift = 21;

  static std::uint64_t bits(int first, int last) {
    return ~std::uint64_t{0} >> (63 - last) & ~std::uint64_t{0} << first;
  }

  fast::DynamicScreen screen_;
  std::vector<fast::ObjectSegment> objects_;
};

}  // namespace

void MergeTally::add(const MergeTally& other) {
  if (mismatches == 0) first_mismatch = other.first_mismatch;
  pairs += other.pairs;
  steps += other.steps;
  mismatches += other.mismatches;
  for (int k = 0; k < 9; ++k) steps_of_case[k] += other.steps_of_case[k];
}

MergeTally merge_lines(int width_px, std::uint32_t first, std::uint32_t end,
                       std::span<const fast::SimdLevel> levels) {
  Merger merger(width_px, levels);
  MergeTally tally;
  for (std::uint32_t objects = first; objects < end; ++objects) {
    for (std::uint32_t unlit = 0; unlit < 1u << width_px; ++unlit) {
      Steps steps = steps_of_bits(objects, unlit);
      std::string what = merger.difference(objects, unlit, steps);
      ++tally.pairs;
      if (!what.empty() && tally.mismatches++ == 0)
        tally.first_mismatch = std::move(what);
      for (; steps != 1; steps >>= 3) {
        ++tally.steps;
        ++tally.steps_of_case[(steps & 7) + 1];
      }
    }
  }
  return tally;
}

MergeTally merge_random(std::uint64_t count, std::uint64_t seed,
                        fast::SimdLevel level) {
  TileRow row(level);
  MergeTally tally;
  SplitMix64 random(mix(seed));
  // Ands and ors of random sets: long runs and short ones, many and few.
  const auto draw = [&random] {
    const std::uint64_t kind = random.next();
    std::uint64_t set = random.next();
    if ((kind & 1) != 0) set &= set << (kind >> 4 & 31);
    if ((kind & 2) != 0) set |= set >> (kind >> 9 & 31);
    if ((kind & 4) != 0) set &= ~std::uint64_t{0} << (kind >> 14 & 63);
    return (kind & 8) != 0 ? ~set : set;
  };
  while (tally.pairs < count) {
    row.clear();
    // Now and then all lines are all unlit, or covered all over.
    const std::uint64_t whole = random.next();
    TileRow::Sets unlit, others;
    for (std::size_t j = 0; j < unlit.size(); ++j) {
      unlit[j] = whole % 8 == 0 ? ~std::uint64_t{0} : draw();
      others[j] = ~unlit[j];
    }
    row.light(others);
    // One after another into what the last has left.
    for (int k = 0; k < 4; ++k) {
      TileRow::Sets objects;
      for (std::uint64_t& set : objects) {
        set = (whole >> (4 * k + 4)) % 16 == 0 ? ~std::uint64_t{0} : draw();
      }
      const TileRow::Sets lit = row.light(objects);
      std::uint64_t left = 0;
      for (std::size_t j = 0; j < unlit.size(); ++j) {
        const bool agrees =
            lit[j] == (objects[j] & unlit[j]) &&
            row.unlit(static_cast<int>(j)) == (unlit[j] & ~objects[j]);
        ++tally.pairs;
        if (!agrees && tally.mismatches++ == 0) {
          tally.first_mismatch = std::string(level_name(level)) + ", merge " +
                                 std::to_string(tally.pairs) + " of seed " +
                                 std::to_string(seed);
        }
        left |= unlit[j] &= ~objects[j];
      }
      if (row.full() != (left == 0) && tally.mismatches++ == 0) {
        tally.first_mismatch = "full after merge " +
                               std::to_string(tally.pairs) + " of seed " +
                               std::to_string(seed);
      }
      if (left == 0) break;
    }
  }
  return tally;
}

}  // namespace halfspace::exhaustive
