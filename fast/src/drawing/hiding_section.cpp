#include <algorithm>
#include <limits>

#include "drawing/hiding.hpp"

/// What clip planes and caps do to what hides edges (S9.8).
namespace halfspace::fast {

void Hiding::Count::add(const Event& event) {
  left += event.left;
  right += event.right;
  solid += event.solid;
  Cap& cap = caps[static_cast<std::size_t>(event.cap)];
  cap.left_turns += event.left_turns;
  cap.right_turns += event.right_turns;
  cap.left_open += event.left_open;
  cap.right_open += event.right_open;
}

std::int32_t Hiding::Count::layers(const Line& line, std::int32_t clips) const {
  if (line.other_clip >= 0 && solid <= 0) return kAbsent;
  std::int32_t on_left = left;
  std::int32_t on_right = right;
  for (std::int32_t k = 0; k < clips; ++k) {
    const Cap& cap = caps[static_cast<std::size_t>(k)];
    if (cap.left_open > 0 && cap.left_turns > 0) ++on_left;
    if (cap.right_open > 0 && cap.right_turns > 0) ++on_right;
  }
  return std::min(on_left, on_right);
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
    if (line.clip == k || line.other_clip == k) continue;
    const Ends ends = exact_ends(line, clips_.form(k));
    if (!narrow(line, ends, {0, 0, CutKind::kClip, k, -1}, low, high))
      return false;
  }
  return true;
}

bool Hiding::narrow_to_clip(const Line& line, PolygonId polygon,
                            std::int32_t clip, int side, Cut& from, Cut& to,
                            int& covered) {
  const Form form = sight_.cut_form(polygon, clips_.form(clip));
  const int eye = side * eye_sign(polygon);
  Ends ends = exact_ends(line, form);
  ends.from *= eye;
  ends.to *= eye;
  if (ends.from == 0 && ends.to == 0) {
    covered &= eye * side_of_parallel(line, form) > 0 ? kLeft : kRight;
    return true;
  }
  return narrow(line, ends, {0, 0, CutKind::kClipped, clip, polygon}, from, to);
}

bool Hiding::narrow_to_cap(const Line& line, std::int32_t cap, Cut& from,
                           Cut& to, int& covered) {
  for (std::int32_t k = 0; k < clips_.count(); ++k) {
    if (k == cap) continue;
    const Form form = cap_limit(cap, k);
    const FormInt none;
    const Ends ends = exact_ends(line, form);
    if (ends.from == 0 && ends.to == 0) {
      // The plane itself, turned over.
      if (form.a == none && form.b == none && form.c == none) return false;
      covered &= side_of_parallel(line, form) > 0 ? kLeft : kRight;
    } else if (!narrow(line, ends,
                       {0, 0, CutKind::kClipMeet, kClips * cap + k, -1}, from,
                       to)) {
      return false;
    }
  }
  return covered != 0;
}

void Hiding::turn(const Line& line, const Cut& low, const Cut& high,
                  std::int32_t cap, PolygonId polygon) {
  Cut from = low;
  Cut to = high;
  int covered = kLeft | kRight;
  if (!narrow_to_sides(line, polygon, from, to, covered)) return;
  if (clips_.is_cut_by(polygon, cap) &&
      !narrow_to_clip(line, polygon, cap, cap_side(cap), from, to, covered))
    return;
  // Rays leave the solid where the eye is on a polygon's negative side.
  const int turns = -eye_sign(polygon);
  Event event;
  event.cap = static_cast<std::int8_t>(cap);
  event.cut = from;
  event.left_turns =
      static_cast<std::int8_t>((covered & kLeft) != 0 ? turns : 0);
  event.right_turns =
      static_cast<std::int8_t>((covered & kRight) != 0 ? turns : 0);
  events_.push_back(event);
  event.cut = to;
  event.left_turns = static_cast<std::int8_t>(-event.left_turns);
  event.right_turns = static_cast<std::int8_t>(-event.right_turns);
  events_.push_back(event);
}

void Hiding::find_cap(const Line& line, const Cut& low, const Cut& high,
                      std::int32_t cap, const Box& box) {
  // Nothing of a line in the plane is behind the cap.
  Ends on = exact_ends(line, clips_.form(cap));
  if (on.from == 0 && on.to == 0) return;
  Cut from = low;
  Cut to = high;
  if (kGivenInSections && line.is_whole) {
    // Only what is on the other side than the eye is.
    on.from *= cap_side(cap);
    on.to *= cap_side(cap);
    if (!narrow(line, on, {0, 0, CutKind::kClip, cap, -1}, from, to)) return;
  }
  if (sight_.camera().near) {
    const Ends ends = exact_ends(line, cap_near_limit(cap));
    if (ends.from <= 0 && ends.to <= 0) return;
    if (!narrow(line, ends, {0, 0, CutKind::kClipNear, cap, -1}, from, to))
      return;
  }
  int covered = kLeft | kRight;
  if (!narrow_to_cap(line, cap, from, to, covered)) return;
  Event event;
  event.cap = static_cast<std::int8_t>(cap);
  event.cut = from;
  event.left_open = (covered & kLeft) != 0 ? 1 : 0;
  event.right_open = (covered & kRight) != 0 ? 1 : 0;
  events_.push_back(event);
  event.cut = to;
  event.left_open = static_cast<std::int8_t>(-event.left_open);
  event.right_open = static_cast<std::int8_t>(-event.right_open);
  events_.push_back(event);
  Box all = box;
  all.high[2] = std::numeric_limits<float>::max();
  cap_tree_->find(all, [&](std::int32_t polygon) {
    if (clips_.is_beyond(PolygonId{polygon}, cap))
      turn(line, from, to, cap, PolygonId{polygon});
  });
}

void Hiding::find_corner(const Line& line, const Cut& low, const Cut& high) {
  for (const auto& [polygon, turns] : clips_.crossings(line)) {
    Event event;
    event.cut = {0.5, 1, CutKind::kPlane, 0, polygon};
    event.solid = static_cast<std::int8_t>(turns);
    if (compare(line, event.cut, high) >= 0) continue;
    if (compare(line, event.cut, low) < 0) event.cut = low;
    events_.push_back(event);
  }
}

}  // namespace halfspace::fast
