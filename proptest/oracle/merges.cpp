#include <utility>
#include <vector>

#include "adapters/screen_line.hpp"
#include "generate/random_scenes.hpp"
#include "halfspace/fast/screen.hpp"
#include "halfspace/ref/screen.hpp"
#include "question.hpp"

namespace halfspace::oracle {
namespace {

using agree::Draws;

/// Sorted segments without overlap, often adjacent, often at the same ends.
std::vector<Span> random_spans(Draws& draws) {
  std::vector<Span> spans;
  auto next = static_cast<std::int32_t>(draws.from_to(0, 6));
  const std::int64_t count = draws.from_to(0, 6);
  for (std::int64_t k = 0; k < count; ++k) {
    const auto length = static_cast<std::int32_t>(draws.from_to(0, 5));
    spans.push_back({next, next + length});
    next += length + 1 + static_cast<std::int32_t>(draws.from_to(0, 4));
  }
  return spans;
}

void add_spans(Line& line, const std::vector<Span>& spans) {
  line.add_list(spans, [&line](Span span) {
    line.add(span.first);
    line.add(span.last);
  });
}

/// The cases met, one after another: what ref::merge does, step by step.
template <class MergeCaseOf>
std::vector<int> cases_of(const std::vector<Span>& objects,
                          const std::vector<Span>& unlit,
                          MergeCaseOf&& merge_case) {
  ref::UnlitList list(unlit.begin(), unlit.end());
  std::vector<int> cases;
  auto object = objects.begin();
  auto rest = list.begin();
  while (object != objects.end() && rest != list.end()) {
    cases.push_back(static_cast<int>(merge_case(*object, *rest)));
    ref::merge_segment(object, list, rest, [](Span) {});
  }
  return cases;
}

template <class Merged>
Line line_of(const std::vector<int>& cases, const Merged& merged) {
  Line line;
  line.add_list(cases, [&line](int number) { line.add(number); });
  add_spans(line, merged.lit);
  add_spans(line, merged.unlit);
  return line;
}

}  // namespace

void ask_merges(Inquiry& inquiry, std::uint64_t seed, std::uint64_t count) {
  constexpr std::int32_t kWidth = 80;
  std::vector<std::pair<const char*, ScreenLine>> lines;
  for (const fast::SimdLevel level : kSimdLevels) {
    if (fast::is_supported(level)) {
      lines.emplace_back(level_name(level), ScreenLine(kWidth, level));
    }
  }
  Draws draws(seed);
  for (std::uint64_t k = 0; k < count; ++k) {
    const std::vector<Span> objects = random_spans(draws);
    const std::vector<Span> unlit = random_spans(draws);
    Line question;
    question.add(0);
    add_spans(question, objects);
    add_spans(question, unlit);
    const auto by_ref = [](Span o, Span u) { return ref::merge_case(o, u); };
    const auto by_fast = [](Span o, Span u) { return fast::merge_case(o, u); };
    auto& [name, line] = lines[k % lines.size()];
    inquiry.ask(question,
                {{"ref::merge", line_of(cases_of(objects, unlit, by_ref),
                                        ref::merge(objects, unlit))},
                 {name, line_of(cases_of(objects, unlit, by_fast),
                                line.merge(objects, unlit))}});
  }
}

}  // namespace halfspace::oracle
