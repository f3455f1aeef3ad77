#include "halfspace/ref/lines.hpp"

#include <algorithm>

#include "exact_double.hpp"

namespace halfspace::ref {
namespace {

ImagePoint to_doubles(const ImagePoint& p) {
  return {rational_of(nearest_double(p.x)), rational_of(nearest_double(p.y))};
}

ImagePoint minus(const ImagePoint& p, const ImagePoint& q) {
  return {p.x - q.x, p.y - q.y};
}

Rational dot(const ImagePoint& p, const ImagePoint& q) {
  return p.x * q.x + p.y * q.y;
}

}  // namespace

bool is_on_line(const ImagePoint& point, const ImagePoint& from,
                const ImagePoint& to, std::int32_t width) {
  const ImagePoint a = to_doubles(from);
  const ImagePoint b = to_doubles(to);
  const Rational half = Rational(width) / Rational(32);
  const ImagePoint along = minus(b, a);
  const ImagePoint beyond = minus(point, a);
  const Rational length = dot(along, along);
  const Rational at = dot(beyond, along);
  // The nearest point of the segment is an end, or the foot of the
  // perpendicular.
  if (at <= Rational(0)) return dot(beyond, beyond) <= half * half;
  if (at >= length) {
    const ImagePoint past = minus(point, b);
    return dot(past, past) <= half * half;
  }
  const Rational cross = beyond.x * along.y - beyond.y * along.x;
  return cross * cross <= half * half * length;
}

void add_lines(const Drawing& drawing, const LineStyle& style,
               std::int32_t samples, ColorImage& image) {
  const int count = samples * samples;
  for (std::int32_t j = 0; j < image.height_px; ++j) {
    for (std::int32_t i = 0; i < image.width_px; ++i) {
      int on_lines = 0;
      for (std::int32_t s = 0; s < count; ++s) {
        const ImagePoint at = {Rational(i) + Rational(2 * (s % samples) + 1) /
                                                 Rational(2 * samples),
                               Rational(j) + Rational(2 * (s / samples) + 1) /
                                                 Rational(2 * samples)};
        on_lines += std::any_of(
            drawing.strokes.begin(), drawing.strokes.end(),
            [&](const DrawnStroke& stroke) {
              return stroke.layers == 0 &&
                     (style.classes & set_of(stroke.edge_class)) != 0 &&
                     is_on_line(at, stroke.from, stroke.to, style.width);
            });
      }
      image.at(i, j) = with_line(image.at(i, j), style.color, on_lines, count);
    }
  }
}

}  // namespace halfspace::ref
