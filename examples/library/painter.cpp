// A renderer of one's own: the painter's algorithm, onto an SVG.
#include <halfspace/halfspace.hpp>
using namespace halfspace;

int main() {
  const Solid part = Solid::box({0, 0, 0}, {3, 2, 1}) ^ Solid::sphere(1, 12);
  std::puts("<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 640 480'>");
  const auto draw = [](const SeenPolygon& polygon) {
    const Rgb c = polygon.color;
    std::printf("<polygon fill='#%02x%02x%02x' points='", c.r, c.g, c.b);
    for (const Point2& p : polygon.projected)
      std::printf("%.1f,%.1f ", p.x, p.y);
    std::puts("'/>");
  };
  if (Display::of(part)->back_to_front({}, draw)) std::puts("</svg>");
}
