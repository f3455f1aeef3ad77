// A drilled part, its volume, and where its faces come from.
#include <halfspace/halfspace.hpp>
#include <map>

using halfspace::Solid;

int main() {
  const Solid plate = Solid::box({0, 0, 0}, {40, 30, 5}).named("plate");
  const Solid drill = Solid::cylinder(4, 9, 64).translated({10, 15, -2});
  const Solid part = plate - drill - drill.translated({20, 0, 0}) -
                     Solid::sphere(2.5).translated({20, 15, 5});
  const auto mesh = part.mesh();
  const auto operands = part.operands();
  std::map<std::string, int> polygons;
  for (const auto& origin : mesh->origins)
    ++polygons[(*operands)[origin.operand].name()];
  std::printf("volume %.3f\n", *part.volume());
  for (const auto& [name, count] : polygons)
    std::printf("%d polygons of the %s\n", count, name.c_str());
  return part.save("part.off") ? 0 : 1;
}
