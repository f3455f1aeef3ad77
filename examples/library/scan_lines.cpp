// A renderer of one's own: scan lines onto a dynamic screen, near parts first.
#include <cstdio>
#include <halfspace/halfspace.hpp>

using namespace halfspace;

int main() {
  const auto display = *Display::of(Solid::torus(3, 1, 24, 12));
  DynamicScreen screen(60, 22);
  char image[22][60] = {};
  const auto draw = [&](const SeenPolygon& polygon) {
    for (const auto& [line, first, last] : screen.light(polygon.spans()))
      for (int x = first; x <= last; ++x)
        image[line][x] = " .:-=+*#%@"[polygon.color.g / 26];
    return !screen.is_full();
  };
  const View view{.width_px = 60, .height_px = 22};
  if (!display.front_to_back(view, draw)) return 1;
  for (const auto& line : image) {
    for (const char c : line) std::putchar(c ? c : ' ');
    std::putchar('\n');
  }
}
