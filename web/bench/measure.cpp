// What measure.mjs does, natively and in one thread: processor time,
// the least of some runs.
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <vector>

#include "halfspace/halfspace.hpp"

namespace {

using namespace halfspace;

template <class Work>
void measure(const char* name, int runs, const Work& work) {
  double best = 1e9;
  for (int k = 0; k < runs; ++k) {
    const std::clock_t begin = std::clock();
    work();
    best = std::min(best, static_cast<double>(std::clock() - begin) * 1000 /
                              CLOCKS_PER_SEC);
  }
  std::printf("%s\t%.1f ms\n", name, best);
}

const WorkOptions kOneThread = {1, {}};

Solid menger(int side) {
  std::vector<Solid> bars;
  for (int n = 1; n < side; n *= 3) {
    const int width = side / (3 * n);
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) {
        const double a = (3 * i + 1) * width, b = (3 * j + 1) * width;
        const double c = width, most = side + 1;
        bars.push_back(Solid::box({-1, a, b}, {most, a + c, b + c}));
        bars.push_back(Solid::box({a, -1, b}, {a + c, most, b + c}));
        bars.push_back(Solid::box({a, b, -1}, {a + c, b + c, most}));
      }
    }
  }
  const double s = side;
  return Solid::box({0, 0, 0}, {s, s, s}) - Solid::union_of(bars);
}

Solid plate() {
  const Solid drill = Solid::cylinder(1, 9, 48);
  Solid part = Solid::box({0, 0, 0}, {31, 31, 5});
  for (int k = 0; k < 100; ++k)
    part -= drill.translated({2.0 + 3 * (k % 10), 2.0 + 3 * (k / 10), -2});
  return part;
}

}  // namespace

int main() {
  MeshOptions triangles;
  triangles.triangles = true;
  triangles.threads = 1;
  const Mesh one = [&] {
    const Mesh mesh = *Solid::sphere(1, 100).mesh(triangles);
    Mesh plain;
    plain.vertices = mesh.vertices;
    plain.first_corner = mesh.first_corner;
    plain.corners = mesh.corners;
    return plain;
  }();
  Mesh two = one;
  for (Point& p : two.vertices) p.x += 0.5;
  std::printf("spheres of %zu triangles\n", one.polygon_count());
  measure("difference", 7, [&] {
    const Solid c = Solid::from_mesh(one) - Solid::from_mesh(two);
    static_cast<void>(c.mesh(triangles));
  });
  const Solid a = Solid::from_mesh(one), b = Solid::from_mesh(two);
  static_cast<void>(a.evaluate(kOneThread));
  static_cast<void>(b.evaluate(kOneThread));
  measure("difference, operands checked", 7,
          [&] { static_cast<void>((a - b).evaluate(kOneThread)); });
  measure("menger 3", 3,
          [&] { static_cast<void>(menger(27).evaluate(kOneThread)); });
  measure("plate with 100 holes", 3,
          [&] { static_cast<void>(plate().evaluate(kOneThread)); });
  const auto display = Display::of(Solid::sphere(10, 300));
  if (!display) return 1;
  View view;
  view.width_px = view.height_px = 1000;
  view.threads = 1;
  static_cast<void>(display->render(view));
  measure("picture, 1000 x 1000, 89,400 polygons", 7,
          [&] { static_cast<void>(display->render(view)); });
  return 0;
}
