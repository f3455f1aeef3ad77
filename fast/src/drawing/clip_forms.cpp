#include "drawing/clip_forms.hpp"

#include <algorithm>
#include <utility>

#include "drawing/hiding.hpp"

namespace halfspace::fast {
ClipForms::ClipForms(const Sight& sight, const std::vector<ClipPlane>& planes,
                     bool caps, bool behind)
    : sight_(sight), has_caps_(caps) {
  for (const ClipPlane& plane : planes) {
    forms_.push_back({FormInt(plane.a), FormInt(plane.b), FormInt(plane.c),
                      FormInt(plane.d)});
  }
  for (std::size_t k = 0; caps && k < forms_.size(); ++k) {
    const int eye = sight.eye_side(forms_[k]);
    if (eye < 0) caps_in_front_ |= 1u << k;
    if (kGivenInSections && behind && eye > 0) caps_behind_ |= 1u << k;
  }
  if (planes.empty()) return;
  const Scene& scene = sight.scene();
  bits_.resize(scene.polygon_count());
  for (std::size_t p = 0; p < bits_.size(); ++p) {
    for (std::size_t k = 0; k < planes.size(); ++k) {
      bool any_positive = false;
      bool any_negative = false;
      bool any_on = false;
      for (const VertexId v : scene.corners(static_cast<PolygonId>(p))) {
        const int side = sign(value_at(forms_[k], sight.point_of(v)));
        any_positive |= side > 0;
        any_negative |= side < 0;
        any_on |= side == 0;
      }
      const auto bit = static_cast<std::uint8_t>(1u << k);
      if (any_positive && any_negative) bits_[p].cut |= bit;
      if (!any_positive) bits_[p].removed |= bit;
      if (!any_positive && !any_negative) bits_[p].inside |= bit;
      if (!any_negative && !any_on) bits_[p].kept |= bit;
    }
  }
}

bool ClipForms::holds(std::int32_t k, const Line& line) const {
  return sign(value_at(form(k), line.from)) == 0 &&
         sign(value_at(form(k), line.to)) == 0;
}

bool ClipForms::takes_away(const Line& line) const {
  for (std::int32_t k = 0; k < count(); ++k) {
    if (!holds(k, line)) continue;
    const auto lies_there = [&](PolygonId polygon) {
      return (bits(polygon).inside >> k & 1) != 0;
    };
    if (has_caps_ ||
        std::none_of(line.polygons.begin(), line.polygons.end(), lies_there))
      return true;
  }
  return false;
}

std::vector<Line> ClipForms::sections(const SceneEdges& edges,
                                      const std::vector<bool>& present) const {
  std::vector<Line> lines;
  for (std::size_t p = 0; p < bits_.size(); ++p) {
    const auto id = static_cast<PolygonId>(p);
    for (std::int32_t k = 0; k < count(); ++k) {
      if (!is_removed_by(id, k) && (present[p] || has_cap_in_front(k)))
        add_section(id, k, edges, lines);
    }
  }
  return lines;
}

/// A convex polygon that is on both sides has two such points, each a corner or
/// within a side; one that is on the positive side has a side in the plane, or
/// a corner at most.
void ClipForms::add_section(PolygonId polygon, std::int32_t k,
                            const SceneEdges& edges,
                            std::vector<Line>& lines) const {
  const auto corners = sight_.scene().corners(polygon);
  const std::size_t n = corners.size();
  std::vector<int> signs;
  for (const VertexId v : corners)
    signs.push_back(sign(value_at(form(k), sight_.point_of(v))));
  std::vector<SpacePoint> points;
  for (std::size_t c = 0; c < n; ++c) {
    const std::size_t next = c + 1 == n ? 0 : c + 1;
    const int before = signs[c == 0 ? n - 1 : c - 1];
    if (signs[c] == 0 && (before != 0 || signs[next] != 0)) {
      points.push_back(sight_.point_of(edges.first_of(corners[c])));
    } else if (signs[c] * signs[next] < 0) {
      points.push_back(sight_.crossing(corners[c], corners[next], form(k)));
    }
  }
  if (points.size() != 2) return;
  if (is_before(points[1], points[0])) std::swap(points[0], points[1]);
  if (!is_before(points[0], points[1])) return;
  Line line;
  line.from = points[0];
  line.to = points[1];
  line.polygons = {polygon};
  line.clip = k;
  if (is_there(line)) lines.push_back(std::move(line));
}

bool ClipForms::is_there(const Line& section) const {
  const PolygonId polygon = section.polygons[0];
  const auto corners = sight_.scene().corners(polygon);
  for (std::int32_t k = 0; k < count(); ++k) {
    if (k == section.clip || !holds(k, section)) continue;
    const auto is_kept = [&](VertexId v) {
      const SpacePoint p = sight_.point_of(v);
      return sign(value_at(form(k), p)) > 0 &&
             sign(value_at(form(section.clip), p)) > 0;
    };
    const bool lies_there = (bits(polygon).inside >> k & 1) != 0;
    if (lies_there ? has_caps_
                   : std::none_of(corners.begin(), corners.end(), is_kept))
      return false;
  }
  return true;
}

}  // namespace halfspace::fast
