// A renderer of one's own: the painter's algorithm, onto an SVG.
#include <cstdio>
#include <halfspace/halfspace.hpp>

using namespace halfspace;

int main() {
  const Solid part = Solid::box({0, 0, 0}, {3, 2, 1}) ^ Solid::sphere(1, 12);
  const auto display = Display::of(part);
  if (!display) return std::puts(display.error().message.c_str());
  std::puts("<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 640 480'>");
  const auto draw = [](const SeenPolygon& polygon) {
    std::printf("<polygon fill='#%02x%02x%02x' points='", polygon.color.r,
                polygon.color.g, polygon.color.b);
    for (const Point2& p : polygon.projected)
      std::printf("%.1f,%.1f ", p.x, p.y);
    return std::puts("'/>") >= 0;
  };
  if (!display->back_to_front({}, draw)) return 1;
  return std::puts("</svg>") < 0;
}
