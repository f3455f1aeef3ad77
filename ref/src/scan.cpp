#include "halfspace/ref/scan.hpp"

#include <algorithm>
#include <list>
#include <map>
#include <utility>

#include "halfspace/assert.hpp"

namespace halfspace::ref {
namespace {

/// A polygon edge that meets the current scan line.
struct Edge {
  std::int32_t last_line = 0;  ///< the last scan line that it meets
  Rational x;                  ///< where it meets the current one
  Rational slope;              ///< by how much x grows from line to line
};

/// The edges by the first scan line that they meet.
using EdgeTable = std::map<std::int32_t, std::list<Edge>>;

/// The least integer k whose k + 1/2 is not below `value`.
///
/// All four ends of the sweep are this one number. The samples of line j have
/// y = j + 1/2 + e * e, so an edge from y0 down to y1 meets the line where
/// y0 < j + 1/2 + e * e < y1, that is, y0 <= j + 1/2 < y1: from line
/// first_centre(y0) to line first_centre(y1) - 1.
///
/// It does so at x + e * e * slope, x being where it meets j + 1/2. The
/// sample of pixel i has i + 1/2 + e, and e outweighs e * e * slope whatever
/// the slope: the sample is on the right where i + 1/2 >= x, from pixel
/// first_centre(x) on, and on the left up to pixel first_centre(x) - 1.
std::int32_t first_centre(const Rational& value) {
  const Rational half = Rational(1) / Rational(2);
  return static_cast<std::int32_t>(-floor(half - value).to_int64());
}

/// Enters the edge between two corners, unless no scan line meets it.
void enter(EdgeTable& table, ImagePoint top, ImagePoint bottom) {
  if (bottom.y < top.y) std::swap(top, bottom);
  const std::int32_t first_line = first_centre(top.y);
  const std::int32_t last_line = first_centre(bottom.y) - 1;
  if (last_line < first_line) return;  // so every horizontal edge, too
  const Rational slope = (bottom.x - top.x) / (bottom.y - top.y);
  const Rational centre = Rational(first_line) + Rational(1) / Rational(2);
  table[first_line].push_back(
      {last_line, top.x + slope * (centre - top.y), slope});
}

EdgeTable edge_table_of(const std::vector<ImagePoint>& corners) {
  EdgeTable table;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    enter(table, corners[k], corners[(k + 1) % corners.size()]);
  }
  return table;
}

}  // namespace

std::vector<ObjectSegment> scan_convert(const Fragment& fragment,
                                        const Projection& projection) {
  // Step 1: clip to the view volume, and project.
  const Fragment seen = clip(fragment, projection);
  std::vector<ImagePoint> corners;
  for (const Point& vertex : seen.vertices) {
    // In the view volume w is zero at the eye alone, and a polygon that
    // contains the eye is seen edge-on.
    if (sign(value_at(projection.w, vertex)) == 0) return {};
    corners.push_back(image_of(vertex, projection));
  }

  // Step 2: enter the edges into the edge table.
  EdgeTable edge_table = edge_table_of(corners);
  if (edge_table.empty()) return {};

  // Step 3: sweep the active edge table (AET) from line to line.
  std::vector<ObjectSegment> segments;
  std::list<Edge> active;
  std::int32_t line = edge_table.begin()->first;
  for (; !edge_table.empty() || !active.empty(); ++line) {
    if (const auto entry = edge_table.find(line); entry != edge_table.end()) {
      active.splice(active.end(), entry->second);
      edge_table.erase(entry);
    }
    active.sort([](const Edge& a, const Edge& b) { return a.x < b.x; });

    // Half-open edges: a line meets none or two of a convex polygon's.
    HALFSPACE_ASSERT(active.size() == 2);
    const Span span{first_centre(active.front().x),
                    first_centre(active.back().x) - 1};
    if (span.first <= span.last) segments.push_back({line, span});

    active.remove_if([&](const Edge& edge) { return edge.last_line == line; });
    for (Edge& edge : active) edge.x += edge.slope;
  }
  return segments;
}

}  // namespace halfspace::ref
