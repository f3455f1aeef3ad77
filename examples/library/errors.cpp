// What is wrong comes out where a solid is used, and says what it is.
#include <cstdio>
#include <halfspace/halfspace.hpp>

using halfspace::Solid;

int main() {
  const Solid cube = Solid::box({0, 0, 0}, {1, 1, 1});
  auto open = *cube.mesh();
  open.add({0, 1, 2});
  for (const Solid& solid :
       {Solid::from_mesh(open), ~cube, cube + Solid::from_file("no.off"),
        cube.translated({1e9, 0, 0}).named("far") + cube.scaled(1e-9)}) {
    const auto volume = solid.volume();
    const std::string code(to_string(volume.error().code));
    std::printf("%s: %s\n", code.c_str(), volume.error().message.c_str());
  }
}
