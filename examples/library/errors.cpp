// What is wrong comes out where a solid is used, and says what it is.
#include <halfspace/halfspace.hpp>
using halfspace::Solid;

int main() {
  const Solid cube = Solid::box({0, 0, 0}, {1, 1, 1}), far = cube.scaled(1e9);
  const Solid open = Solid::from_mesh(cube.mesh()->add({0, 1, 2}));
  const Solid file = Solid::from_file("no.off"), fine = cube.scaled(1e-9);
  for (const Solid& solid : {open, ~cube, file, far.named("far") + fine})
    std::puts(to_string(solid.volume().error()).c_str());
}
