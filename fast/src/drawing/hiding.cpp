#include "drawing/hiding.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "drawing/short_product.hpp"

namespace halfspace::fast {
namespace {

constexpr Cut kStart = {0, 0, CutKind::kFrom, 0, -1};
constexpr Cut kEnd = {1, 0, CutKind::kTo, 0, -1};

}  // namespace

Hiding::Hiding(Sight& sight, const SceneEdges& edges,
               std::vector<std::int8_t> eye_signs, const ClipForms& clips,
               const std::vector<bool>& is_hider)
    : sight_(sight),
      edges_(edges),
      eye_signs_(std::move(eye_signs)),
      clips_(clips) {
  const Scene& scene = sight.scene();
  const auto vertices = static_cast<VertexId>(scene.data().vertices.size());
  points_.reserve(static_cast<std::size_t>(vertices));
  for (VertexId v = 0; v < vertices; ++v)
    points_.push_back(sight.point_of(edges.first_of(v)));
  std::vector<std::int32_t> hiders;
  std::vector<std::int32_t> turners;
  for (std::size_t p = 0; p < eye_signs_.size(); ++p) {
    const auto id = static_cast<std::int32_t>(p);
    if (eye_signs_[p] == 0) continue;
    if (is_hider[p] && clips_.leaves(id)) hiders.push_back(id);
    if (clips_.is_beyond_caps(id)) turners.push_back(id);
  }
  const auto box = [this](std::int32_t p) { return box_of(PolygonId{p}); };
  tree_.emplace(box, hiders);
  if (clips_.has_caps()) cap_tree_.emplace(box, turners);
}

/// Image coordinates across and down, then the depth. The image of a point that
/// is not surely before the eye may be anywhere.
Box Hiding::box_of(const SpacePoint& p) const {
  constexpr float kFar = std::numeric_limits<float>::max();
  Box box;
  const bool perspective = sight_.view().perspective;
  const bool anywhere = perspective && !(p.depth > p.depth_error * 0x1p20);
  const double w = perspective ? p.depth : 1;
  const double doubt = perspective ? 4 * p.depth_error / w : 0;
  const double values[2] = {p.across / w, p.down / w};
  for (std::size_t k = 0; k < 2; ++k) {
    const double error =
        4 * p.image_error / w + std::abs(values[k]) * (doubt + 0x1p-40);
    const double low = anywhere ? -kFar : values[k] - error;
    const double high = anywhere ? kFar : values[k] + error;
    box.low[k] = low < -kFar / 2 ? -kFar : rounded_down(low);
    box.high[k] = high > kFar / 2 ? kFar : rounded_up(high);
  }
  box.low[2] = rounded_down(p.depth - p.depth_error);
  box.high[2] = rounded_up(p.depth + p.depth_error);
  return box;
}

Box Hiding::box_of(PolygonId polygon) const {
  Box box = kEmptyBox;
  for (const VertexId v : sight_.scene().corners(polygon))
    extend(box, box_of(point(v)));
  return box;
}

template <class MakeForm>
int Hiding::decided(const Bounded& value, MakeForm&& form,
                    const SpacePoint& p) {
  if (const int known = filtered_sign(value)) {
    ++sight_.stats().filtered;
    return known;
  }
  ++sight_.stats().exact;
  const int exact = sign(value_at(form(), p));
  sight_.stats().zero += exact == 0 ? 1 : 0;
  return exact;
}

Form Hiding::form_of(const Cut& cut) const {
  switch (cut.kind) {
    case CutKind::kSide: {
      const auto corners = sight_.scene().corners(cut.polygon);
      const auto k = static_cast<std::size_t>(cut.number);
      return sight_.side_form(corners[k],
                              corners[k + 1 == corners.size() ? 0 : k + 1]);
    }
    case CutKind::kPlane:
      return sight_.plane_form(cut.polygon);
    case CutKind::kNear:
      return sight_.near_form(cut.polygon);
    case CutKind::kClip:
      return clips_.form(cut.number);
    case CutKind::kClipped:
      return sight_.cut_form(cut.polygon, clips_.form(cut.number));
    case CutKind::kClipNear:
      return cap_near_limit(cut.number);
    case CutKind::kClipMeet:
      return cap_limit(cut.number / kClips, cut.number % kClips);
    default:
      return sight_.limit_form(cut.number);
  }
}

bool Hiding::is_point(const Line& line) {
  const SpacePoint& p = line.from;
  const SpacePoint& q = line.to;
  const bool perspective = sight_.view().perspective;
  const double image_error = std::max(p.image_error, q.image_error);
  const double depth_error = std::max(p.depth_error, q.depth_error);
  const auto differ = [&](double a, double b) {
    const double s = perspective ? p.depth : 1;
    const double t = perspective ? q.depth : 1;
    const double e = perspective ? depth_error : 0;
    const double value = a * t - b * s;
    const double size = std::abs(a) + std::abs(b) + 2 * image_error;
    const double error =
        (image_error * (std::abs(s) + std::abs(t) + 2 * e) + size * e +
         8 * kRounding * size * (std::abs(s) + std::abs(t))) *
        (1 + 0x1p-40);
    return std::abs(value) > error;
  };
  if (differ(p.across, q.across) || differ(p.down, q.down)) return false;
  const auto parallel = [&](const Form& f, const Form& g) {
    return short_product<22>(value_at(f, p), value_at(g, q)) ==
           short_product<22>(value_at(f, q), value_at(g, p));
  };
  ++sight_.stats().exact;
  // In perspective both are one ray from the eye: (x, y, w) in proportion.
  return parallel(sight_.x_form(), sight_.w_form()) &&
         parallel(sight_.y_form(), sight_.w_form()) &&
         parallel(sight_.x_form(), sight_.y_form());
}

bool Hiding::are_same_side(const Cut& f, const Cut& g) const {
  if (f.kind != CutKind::kSide || g.kind != CutKind::kSide) return false;
  const auto ends_of = [&](const Cut& cut) {
    const auto corners = sight_.scene().corners(cut.polygon);
    const auto k = static_cast<std::size_t>(cut.number);
    const std::size_t next = k + 1 == corners.size() ? 0 : k + 1;
    const VertexId u = point(corners[k]).vertex;
    const VertexId v = point(corners[next]).vertex;
    return std::pair{std::min(u, v), std::max(u, v)};
  };
  return ends_of(f) == ends_of(g);
}

/// A share is |F| / (|F| + |G|) for a form's values F and G at the ends, of
/// different signs; for that of homogeneous points both are scaled by their
/// weights, which drop out of the comparison.
int Hiding::compare(const Line& line, const Cut& f, const Cut& g) {
  const double gap = f.share - g.share;
  const double doubt = f.error + g.error;
  if (gap > doubt) return 1;
  if (gap < -doubt) return -1;
  const auto is_end = [](const Cut& cut) {
    return cut.kind == CutKind::kFrom || cut.kind == CutKind::kTo;
  };
  // A cut between the ends is at neither.
  if (is_end(f) || is_end(g)) {
    const auto rank = [&](const Cut& cut) {
      return is_end(cut) ? (cut.kind == CutKind::kFrom ? 0 : 2) : 1;
    };
    return (rank(f) > rank(g)) - (rank(f) < rank(g));
  }
  if (f.is_same(g)) return 0;
  if (are_same_side(f, g)) return 0;
  ++sight_.stats().exact;
  const ExactCut p = exact_cut(line, f);
  const ExactCut q = exact_cut(line, g);
  return sign(short_product<22>(p.from, q.to) -
              short_product<22>(q.from, p.to));
}

Hiding::ExactCut Hiding::exact_cut(const Line& line, const Cut& cut) {
  const std::uint64_t name =
      std::uint64_t{static_cast<std::uint32_t>(cut.polygon)} << 32 |
      std::uint64_t{static_cast<std::uint32_t>(cut.number)} << 4 |
      static_cast<std::uint64_t>(cut.kind);
  const auto found = exact_cuts_.find(name);
  if (found != exact_cuts_.end()) return found->second;
  const Form form = form_of(cut);
  const ExactCut exact = {size_of(value_at(form, line.from)),
                          size_of(value_at(form, line.to))};
  exact_cuts_.emplace(name, exact);
  return exact;
}

bool Hiding::narrow(const Line& line, const Ends& ends, Cut cut, Cut& low,
                    Cut& high) {
  if (ends.from <= 0 && ends.to <= 0) return ends.from == 0 && ends.to == 0;
  if (ends.from >= 0 && ends.to >= 0) return true;
  const double f = std::abs(ends.from_value.value);
  const double g = std::abs(ends.to_value.value);
  const double sum = f + g;
  // See meet() in exact/filter.hpp.
  const double error =
      std::max(ends.from_value.error, ends.to_value.error) / sum;
  const bool sure = sum > 0 && error < 0.5;
  cut.share = sure ? f / sum : 0.5;
  cut.error = sure ? 2 * error + 4 * kRounding : 1;
  if (ends.from < 0) {
    if (compare(line, cut, low) > 0) low = cut;
  } else {
    if (compare(line, cut, high) < 0) high = cut;
  }
  return compare(line, low, high) < 0;
}

bool Hiding::in_view(const Line& line, Cut& low, Cut& high) {
  low = kStart;
  high = kEnd;
  for (int limit = 0; limit < Sight::kLimits; ++limit) {
    if (!sight_.has_limit(limit)) continue;
    Ends ends;
    ends.from_value = sight_.limit_value(limit, line.from);
    ends.to_value = sight_.limit_value(limit, line.to);
    const auto form = [&] { return sight_.limit_form(limit); };
    ends.from = decided(ends.from_value, form, line.from);
    ends.to = decided(ends.to_value, form, line.to);
    // At the near limit itself nothing is seen.
    if (limit == 0 && ends.from == 0 && ends.to == 0) return false;
    if (!narrow(line, ends, {0, 0, CutKind::kLimit, limit, -1}, low, high))
      return false;
  }
  return line.is_whole || narrow_to_kept(line, low, high);
}

Form Hiding::plane_of(const Line& line) const {
  if (kCornersOfCaps && line.other_clip >= 0) {
    return sight_.meet_form_of(clips_.form(line.clip),
                               clips_.form(line.other_clip));
  }
  if (line.clip >= 0)
    return sight_.cut_form(line.polygons[0], clips_.form(line.clip));
  return line.is_intersection
             ? sight_.meet_form(line.polygons[0], line.polygons[1])
             : sight_.side_form(line.from.vertex, line.to.vertex);
}

int Hiding::side_of_parallel(const Line& line, const Form& g) const {
  const Form f = plane_of(line);
  const int a = sign(f.a) * sign(g.a);
  const int b = sign(f.b) * sign(g.b);
  return a != 0 ? a : b != 0 ? b : sign(f.c) * sign(g.c);
}

int Hiding::side_sign(const SpacePoint& p, PolygonId polygon, std::size_t side,
                      Bounded& value) {
  const auto corners = sight_.scene().corners(polygon);
  const VertexId u = corners[side];
  const VertexId v = corners[side + 1 == corners.size() ? 0 : side + 1];
  const SpacePoint& a = point(u);
  const SpacePoint& b = point(v);
  if (p.vertex >= 0 && (p.vertex == a.vertex || p.vertex == b.vertex)) return 0;
  value = sight_.side_value(a, b, p);
  return eye_sign(polygon) *
         decided(
             value, [&] { return sight_.side_form(u, v); }, p);
}

Hiding::Ends Hiding::side_ends(const Line& line, PolygonId polygon,
                               std::size_t side) {
  Ends ends;
  ends.from = side_sign(line.from, polygon, side, ends.from_value);
  ends.to = side_sign(line.to, polygon, side, ends.to_value);
  return ends;
}

int Hiding::behind(const SpacePoint& p, PolygonId polygon, Bounded& value) {
  for (const VertexId v : sight_.scene().corners(polygon)) {
    if (p.vertex >= 0 && point(v).vertex == p.vertex) return 0;
  }
  value = sight_.plane_value(polygon, p);
  return -eye_sign(polygon) *
         decided(
             value, [&] { return sight_.plane_form(polygon); }, p);
}

bool Hiding::is_hidden_by(const SpacePoint& p, PolygonId polygon) {
  Bounded value;
  if (behind(p, polygon, value) <= 0) return false;
  const std::size_t sides = sight_.scene().corners(polygon).size();
  for (std::size_t k = 0; k < sides; ++k) {
    if (side_sign(p, polygon, k, value) < 0) return false;
  }
  if (sight_.camera().near && sign(value_at(sight_.near_form(polygon), p)) <= 0)
    return false;
  return !kGivenInSections || is_left_at(p, polygon);
}

bool Hiding::is_visible(const SpacePoint& p, bool is_whole) {
  for (std::int32_t k = 0; kGivenInSections && k < clips_.count(); ++k) {
    if (!is_whole && sign(value_at(clips_.form(k), p)) < 0) return false;
  }
  for (int limit = 0; limit < Sight::kLimits; ++limit) {
    if (!sight_.has_limit(limit)) continue;
    const int side = decided(
        sight_.limit_value(limit, p), [&] { return sight_.limit_form(limit); },
        p);
    // At the near limit itself nothing is seen.
    if (side < 0 || (side == 0 && limit == 0)) return false;
  }
  Box box = box_of(p);
  box.low[2] = std::numeric_limits<float>::lowest();
  bool hidden = false;
  tree_->find(box, [&](std::int32_t polygon) {
    hidden = hidden || is_hidden_by(p, polygon);
  });
  return !hidden && !(kGivenInSections && is_behind_a_cap(p));
}

bool Hiding::narrow_to_sides(const Line& line, PolygonId polygon, Cut& from,
                             Cut& to, int& covered) {
  const auto corners = sight_.scene().corners(polygon);
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Ends ends = side_ends(line, polygon, k);
    if (ends.from == 0 && ends.to == 0) {
      const VertexId u = corners[k];
      const VertexId v = corners[k + 1 == corners.size() ? 0 : k + 1];
      const int side = side_of_parallel(line, sight_.side_form(u, v));
      covered &= eye_sign(polygon) * side > 0 ? kLeft : kRight;
      continue;
    }
    const auto number = static_cast<std::int32_t>(k);
    if (!narrow(line, ends, {0, 0, CutKind::kSide, number, polygon}, from, to))
      return false;
  }
  return true;
}

void Hiding::hide(const Line& line, const Cut& low, const Cut& high,
                  PolygonId polygon) {
  Cut from = low;
  Cut to = high;
  // Step 1: where the polygon's plane is before the edge.
  Ends ends;
  ends.from = behind(line.from, polygon, ends.from_value);
  ends.to = behind(line.to, polygon, ends.to_value);
  if (ends.from <= 0 && ends.to <= 0) return;
  if (!narrow(line, ends, {0, 0, CutKind::kPlane, 0, polygon}, from, to))
    return;
  // Step 2: where its sides, and what clip planes leave of it, hold it; on both
  // sides of the edge, or on one.
  int covered = kLeft | kRight;
  if (!narrow_to_sides(line, polygon, from, to, covered)) return;
  for (std::int32_t k = 0; k < clips_.count(); ++k) {
    if (clips_.is_cut_by(polygon, k) &&
        !narrow_to_clip(line, polygon, k, 1, from, to, covered))
      return;
  }
  // Step 3: where it is beyond the near limit.
  if (sight_.camera().near) {
    ends = exact_ends(line, sight_.near_form(polygon));
    if (ends.from <= 0 && ends.to <= 0) return;
    if (!narrow(line, ends, {0, 0, CutKind::kNear, 0, polygon}, from, to))
      return;
  }
  const int left = (covered & kLeft) != 0 ? 1 : 0;
  const int right = (covered & kRight) != 0 ? 1 : 0;
  if (left + right == 0) return;
  Event event;
  event.cut = from;
  event.left = static_cast<std::int8_t>(left);
  event.right = static_cast<std::int8_t>(right);
  events_.push_back(event);
  event.cut = to;
  event.left = static_cast<std::int8_t>(-left);
  event.right = static_cast<std::int8_t>(-right);
  events_.push_back(event);
}

std::vector<Layered> Hiding::parts_of(const Line& line) {
  std::vector<Layered> parts;
  Cut low;
  Cut high;
  exact_cuts_.clear();
  if (!in_view(line, low, high)) return parts;
  events_.clear();
  Box box = box_of(line.from);
  extend(box, box_of(line.to));
  box.low[2] = std::numeric_limits<float>::lowest();
  tree_->find(box, [&](std::int32_t polygon) {
    if (std::find(line.polygons.begin(), line.polygons.end(), polygon) ==
        line.polygons.end())
      hide(line, low, high, polygon);
  });
  for (std::int32_t k = 0; k < clips_.count(); ++k) {
    if (clips_.has_cap_in_front(k) ||
        (line.is_whole && clips_.has_cap_behind(k)))
      find_cap(line, low, high, k, box);
  }
  if (kCornersOfCaps && line.other_clip >= 0) find_corner(line, low, high);
  std::sort(events_.begin(), events_.end(),
            [&](const Event& f, const Event& g) {
              const int order = compare(line, f.cut, g.cut);
              return order != 0 ? order < 0 : f.cut.polygon < g.cut.polygon;
            });
  Count count;
  const std::int32_t clips = clips_.has_caps() ? clips_.count() : 0;
  parts.push_back({low, high, count.layers(line, clips)});
  for (std::size_t k = 0; k < events_.size();) {
    const Cut& cut = events_[k].cut;
    std::size_t end = k;
    while (end < events_.size() && compare(line, events_[end].cut, cut) == 0) {
      count.add(events_[end]);
      ++end;
    }
    const std::int32_t layers = count.layers(line, clips);
    Layered& last = parts.back();
    if (layers != last.layers) {
      if (compare(line, cut, last.from) == 0) {
        last.layers = layers;
      } else if (compare(line, cut, high) < 0) {
        last.to = cut;
        parts.push_back({cut, high, layers});
      }
    }
    k = end;
  }
  std::erase_if(parts, [](const Layered& p) { return p.layers == kAbsent; });
  return parts;
}

}  // namespace halfspace::fast
