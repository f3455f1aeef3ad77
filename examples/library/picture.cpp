// A picture from a mesh file:  picture MESH PICTURE.png
#include <halfspace/halfspace.hpp>

int main(int, char** argv) {
  const auto model = halfspace::Display::of_file(argv[1]);
  if (!model) return std::puts(model.error().message.c_str());
  return model->render()->save(argv[2]) ? 0 : 1;
}
