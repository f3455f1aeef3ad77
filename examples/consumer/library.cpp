// What most users link: one target, one header.
#include <cstdio>
#include <halfspace/halfspace.hpp>

int main() {
  using halfspace::Solid;
  const Solid cube = Solid::box({0, 0, 0}, {1, 1, 1});
  const Solid part = cube - cube.scaled(0.5) - Solid::sphere(0.25, 8);
  std::printf("halfspace %s: volume %s\n", HALFSPACE_VERSION,
              part.exact_volume()->c_str());
  return *part.volume() == 0.875 ? 0 : 1;
}
