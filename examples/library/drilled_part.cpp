// A drilled part, its volume, and where its faces come from.
#include <halfspace/halfspace.hpp>
using halfspace::Solid;

int main() {
  const Solid plate = Solid::box({0, 0, 0}, {40, 30, 5}).named("plate");
  const Solid drill = Solid::cylinder(4, 9, 64).translated({10, 15, -2});
  const Solid ball = Solid::sphere(2.5).translated({20, 15, 5});
  const Solid part = plate - drill - drill.translated({20, 0, 0}) - ball;
  std::printf("volume %.3f\n", *part.volume());
  for (const auto of = part.polygons_by_operand(); const auto& [name, n] : *of)
    std::printf("%zu polygons of the %s\n", n, name.c_str());
  return part.save("part.off") ? 0 : 1;
}
