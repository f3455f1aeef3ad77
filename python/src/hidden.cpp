#include "hidden.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "binding.hpp"

namespace halfspace::python {
namespace {

/// The triangles whose boxes meet each tile of the image.
class Tiles {
 public:
  explicit Tiles(std::span<const ImageTriangle> triangles) {
    for (const ImageTriangle& t : triangles) {
      for (const ImagePoint& p : t) {
        low_ = {std::min(low_[0], p[0]), std::min(low_[1], p[1])};
        high_ = {std::max(high_[0], p[0]), std::max(high_[1], p[1])};
      }
    }
    const double count = static_cast<double>(triangles.size());
    size_ = std::clamp(static_cast<int>(std::sqrt(count / 2)), 1, 256);
    tiles_.resize(static_cast<std::size_t>(size_ * size_));
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      const ImageTriangle& t = triangles[i];
      for_each(std::min({t[0][0], t[1][0], t[2][0]}),
               std::min({t[0][1], t[1][1], t[2][1]}),
               std::max({t[0][0], t[1][0], t[2][0]}),
               std::max({t[0][1], t[1][1], t[2][1]}),
               [&](std::vector<std::int32_t>& tile) {
                 tile.push_back(static_cast<std::int32_t>(i));
               });
    }
  }

  /// Calls `visit` with each tile that a box meets.
  template <class Visit>
  void for_each(double x0, double y0, double x1, double y1,
                const Visit& visit) {
    const int last_column = place(x1, 0), last_row = place(y1, 1);
    for (int row = place(y0, 1); row <= last_row; ++row) {
      for (int column = place(x0, 0); column <= last_column; ++column)
        visit(tiles_[static_cast<std::size_t>(row * size_ + column)]);
    }
  }

 private:
  int place(double at, std::size_t axis) const {
    const double extent = high_[axis] - low_[axis];
    if (!(extent > 0)) return 0;
    const double tile = (at - low_[axis]) / extent * size_;
    return static_cast<int>(std::clamp(tile, 0.0, size_ - 1.0));
  }

  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  std::array<double, 2> low_ = {kInfinity, kInfinity};
  std::array<double, 2> high_ = {-kInfinity, -kInfinity};
  int size_ = 1;
  std::vector<std::vector<std::int32_t>> tiles_;
};

struct Run {
  double begin = 0;
  double end = 1;
};

/// Where `value(t)`, affine with these values at 0 and 1, is above 0: cuts the
/// run down to it.
void cut(Run& run, double at_begin, double at_end) {
  if (at_begin <= 0 && at_end <= 0) {
    run.end = run.begin - 1;
  } else if (at_begin <= 0) {
    run.begin = std::max(run.begin, at_begin / (at_begin - at_end));
  } else if (at_end <= 0) {
    run.end = std::min(run.end, at_begin / (at_begin - at_end));
  }
}

double area2(const ImagePoint& a, const ImagePoint& b, const ImagePoint& p) {
  return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
}

/// The run of the segment that the triangle hides; empty: begin >= end.
Run hidden_run(const ImageSegment& segment, const ImageTriangle& triangle,
               double tolerance) {
  Run run{0, 1};
  const double area = area2(triangle[0], triangle[1], triangle[2]);
  if (area == 0) return {1, 0};
  const double sign = area > 0 ? 1 : -1;
  // The triangle's nearness at each end, as a mean weighted by areas.
  double nearness[2] = {0, 0};
  for (std::size_t k = 0; k < 3; ++k) {
    const ImagePoint& a = triangle[(k + 1) % 3];
    const ImagePoint& b = triangle[(k + 2) % 3];
    const double ends[2] = {area2(a, b, segment[0]), area2(a, b, segment[1])};
    cut(run, sign * ends[0], sign * ends[1]);
    for (std::size_t e = 0; e < 2; ++e)
      nearness[e] += ends[e] / area * triangle[k][2];
  }
  cut(run, nearness[0] - segment[0][2] - tolerance,
      nearness[1] - segment[1][2] - tolerance);
  return run;
}

/// What is left of 0 to 1 without the runs.
std::vector<Run> complement_of(std::vector<Run> runs) {
  std::sort(runs.begin(), runs.end(),
            [](const Run& a, const Run& b) { return a.begin < b.begin; });
  // Gaps below this are between triangles that meet.
  constexpr double kLeast = 1e-7;
  std::vector<Run> left;
  double from = 0;
  for (const Run& run : runs) {
    if (run.begin > from + kLeast) left.push_back({from, run.begin});
    from = std::max(from, run.end);
  }
  if (from < 1 - kLeast) left.push_back({from, 1});
  return left;
}

}  // namespace

std::vector<VisiblePart> visible_parts(std::span<const ImageTriangle> triangles,
                                       std::span<const ImageSegment> segments,
                                       double tolerance) {
  Tiles tiles(triangles);
  std::vector<VisiblePart> parts;
  std::vector<std::int32_t> last_segment(triangles.size(), -1);
  for (std::size_t s = 0; s < segments.size(); ++s) {
    const ImageSegment& segment = segments[s];
    const auto [x0, x1] = std::minmax(segment[0][0], segment[1][0]);
    const auto [y0, y1] = std::minmax(segment[0][1], segment[1][1]);
    std::vector<Run> runs;
    tiles.for_each(x0, y0, x1, y1, [&](const std::vector<std::int32_t>& tile) {
      for (const std::int32_t t : tile) {
        const auto i = static_cast<std::size_t>(t);
        if (last_segment[i] == static_cast<std::int32_t>(s)) continue;
        last_segment[i] = static_cast<std::int32_t>(s);
        const Run run = hidden_run(segment, triangles[i], tolerance);
        if (run.begin < run.end) runs.push_back(run);
      }
    });
    for (const Run& run : complement_of(std::move(runs)))
      parts.push_back({static_cast<double>(s), run.begin, run.end});
  }
  return parts;
}

void bind_hidden(py::module_& module) {
  module.def("visible_parts", [](const ArrayOf<double>& triangle_rows,
                                 const ArrayOf<double>& segment_rows,
                                 double tolerance) {
    const auto triangles = rows_of<ImageTriangle>(triangle_rows, "triangles");
    const auto segments = rows_of<ImageSegment>(segment_rows, "segments");
    return array_of<double>(without_lock(
        [&] { return visible_parts(triangles, segments, tolerance); }));
  });
}

}  // namespace halfspace::python
