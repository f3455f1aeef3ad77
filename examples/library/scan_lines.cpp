// A renderer of one's own: scan lines onto a dynamic screen, near parts first.
#include <halfspace/halfspace.hpp>
using namespace halfspace;

int main() {
  const auto display = *Display::of(Solid::torus(3, 1, 24, 12));
  std::string image(22 * 60, ' ');
  const auto paint = [&](const SeenPolygon& polygon, const PixelSpan& span) {
    const char shade = " .:-=+*#%@"[polygon.color.g / 26];
    std::fill_n(&image[0] + 60 * span.line + span.first, span.size(), shade);
  };
  if (!display.scan({.width_px = 60, .height_px = 22}, paint)) return 1;
  for (; !image.empty(); image.erase(0, 60)) std::printf("%.60s\n", &image[0]);
}
