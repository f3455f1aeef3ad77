#include "halfspace/ref/screen.hpp"

#include <iterator>

namespace halfspace::ref {
namespace {

/// F2B fig. 10: K becomes [Min, I-1], and after it comes a new [J+1, Max].
/// Returns the new segment. The new segment takes K's Max before that
/// changes (E1).
UnlitList::iterator split_segment(Span object, UnlitList& list,
                                  UnlitList::iterator unlit) {
  const auto link =
      list.insert(std::next(unlit), Span{object.last + 1, unlit->last});
  unlit->last = object.first - 1;
  return link;
}

/// F2B's Merge: the segments of both lists against each other, in order.
void merge_lists(const std::vector<Span>& objects, UnlitList& list,
                 const PaintSegment& paint) {
  auto object = objects.begin();
  auto unlit = list.begin();
  while (object != objects.end() && unlit != list.end()) {
    merge_segment(object, list, unlit, paint);
  }
}

}  // namespace

void merge_segment(std::vector<Span>::const_iterator& object, UnlitList& list,
                   UnlitList::iterator& unlit, const PaintSegment& paint) {
  const auto [first, last] = *object;  // F2B's I and J
  switch (merge_case(*object, *unlit)) {
    case MergeCase::k1:  // the object precedes
      ++object;
      break;
    case MergeCase::k2:  // it covers the left end
      paint({unlit->first, last});
      unlit->first = last + 1;
      ++object;
      break;
    case MergeCase::k3:  // it lies strictly inside
      paint({first, last});
      unlit = split_segment(*object, list, unlit);
      ++object;
      break;
    case MergeCase::k4:  // it covers all, and both end together
      paint(*unlit);
      unlit = list.erase(unlit);
      ++object;
      break;
    case MergeCase::k5:  // it covers the right end, and both end together
      paint({first, unlit->last});
      unlit->last = first - 1;
      ++unlit;
      ++object;
      break;
    case MergeCase::k6:  // it covers all, and goes on
      paint(*unlit);
      unlit = list.erase(unlit);
      break;
    case MergeCase::k7:  // it covers the right end, and goes on
      paint({first, unlit->last});
      unlit->last = first - 1;
      ++unlit;
      break;
    case MergeCase::k8:  // the unlit segment precedes
      ++unlit;
      break;
  }
}

Merged merge(const std::vector<Span>& objects, const std::vector<Span>& unlit) {
  UnlitList list(unlit.begin(), unlit.end());
  Merged merged;
  merge_lists(objects, list, [&](Span lit) { merged.lit.push_back(lit); });
  merged.unlit.assign(list.begin(), list.end());
  return merged;
}

DynamicScreen::DynamicScreen(std::int32_t width_px, std::int32_t height_px)
    : lines_(static_cast<std::size_t>(height_px),
             UnlitList{Span{0, width_px - 1}}),
      lines_with_unlit_(height_px) {}

void DynamicScreen::merge(std::int32_t line, const std::vector<Span>& objects,
                          const PaintSegment& paint) {
  UnlitList& list = lines_[static_cast<std::size_t>(line)];
  if (list.empty()) return;
  merge_lists(objects, list, paint);
  if (list.empty()) --lines_with_unlit_;
}

}  // namespace halfspace::ref
