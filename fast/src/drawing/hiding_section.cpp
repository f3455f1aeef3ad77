#include <algorithm>
#include <limits>

#include "drawing/hiding.hpp"

/// What clip planes and caps do to what hides edges (S9.8).
namespace halfspace::fast {

void Hiding::Count::add(const Event& event) {
  left += event.left;
  right += event.right;
  left_turns += event.left_turns;
  right_turns += event.right_turns;
  beyond += event.beyond;
}

std::int32_t Hiding::Count::layers() const {
  const auto cap = [this](std::int32_t turns) {
    return beyond > 0 && turns > 0 ? 1 : 0;
  };
  return std::min(left + cap(left_turns), right + cap(right_turns));
}

Hiding::Ends Hiding::exact_ends(const Line& line, const Form& form) {
  const auto side = [&](const SpacePoint& p) {
    ++sight_.stats().exact;
    return sign(value_at(form, p));
  };
  const double none = std::numeric_limits<double>::infinity();
  return {side(line.from), side(line.to), {0, none}, {0, none}};
}

bool Hiding::narrow_to_kept(const Line& line, Cut& low, Cut& high) {
  for (std::int32_t k = 0; k < clips_.count(); ++k) {
    if (line.clip == k) continue;
    const Ends ends = exact_ends(line, clips_.form(k));
    if (!narrow(line, ends, {0, 0, CutKind::kClip, k, -1}, low, high))
      return false;
  }
  return true;
}

bool Hiding::narrow_to_clip(const Line& line, PolygonId polygon,
                            std::int32_t clip, Cut& from, Cut& to,
                            int& covered) {
  const Form form = sight_.cut_form(polygon, clips_.form(clip));
  const int eye = eye_sign(polygon);
  Ends ends = exact_ends(line, form);
  ends.from *= eye;
  ends.to *= eye;
  if (ends.from == 0 && ends.to == 0) {
    covered &= eye * side_of_parallel(line, form) > 0 ? kLeft : kRight;
    return true;
  }
  return narrow(line, ends, {0, 0, CutKind::kClipped, clip, polygon}, from, to);
}

void Hiding::turn(const Line& line, const Cut& low, const Cut& high,
                  PolygonId polygon) {
  Cut from = low;
  Cut to = high;
  int covered = kLeft | kRight;
  if (!narrow_to_sides(line, polygon, from, to, covered)) return;
  if (clips_.is_cut_by(polygon, 0) &&
      !narrow_to_clip(line, polygon, 0, from, to, covered))
    return;
  // Rays leave the solid where the eye is on a polygon's negative side.
  Event event;
  event.cut = from;
  event.left_turns = (covered & kLeft) != 0 ? -eye_sign(polygon) : 0;
  event.right_turns = (covered & kRight) != 0 ? -eye_sign(polygon) : 0;
  events_.push_back(event);
  event.cut = to;
  event.left_turns = -event.left_turns;
  event.right_turns = -event.right_turns;
  events_.push_back(event);
}

void Hiding::find_cap(const Line& line, const Cut& low, const Cut& high,
                      const Box& box) {
  // Nothing of a line in the plane is behind the cap.
  const Ends on = exact_ends(line, clips_.form(0));
  if (on.from == 0 && on.to == 0) return;
  Cut from = low;
  Cut to = high;
  if (sight_.camera().near) {
    const Ends ends = exact_ends(line, sight_.near_form_of(clips_.form(0)));
    if (ends.from <= 0 && ends.to <= 0) return;
    if (!narrow(line, ends, {0, 0, CutKind::kClipNear, 0, -1}, from, to))
      return;
  }
  Event event;
  event.cut = from;
  event.beyond = 1;
  events_.push_back(event);
  event.cut = to;
  event.beyond = -1;
  events_.push_back(event);
  Box all = box;
  all.high[2] = std::numeric_limits<float>::max();
  cap_tree_->find(all, [&](std::int32_t polygon) {
    turn(line, from, to, PolygonId{polygon});
  });
}

}  // namespace halfspace::fast
