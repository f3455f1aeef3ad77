// A mesh to a picture by the exact reference. The README's program does the
// same by the fast library, with the same bytes.
//
//   render_scene MESH PICTURE.png
#include <cstdio>
#include <cstdlib>

#include "halfspace/io/import.hpp"
#include "halfspace/io/picture.hpp"
#include "halfspace/io/read_mesh.hpp"
#include "halfspace/io/view.hpp"
#include "halfspace/ref/render.hpp"

using namespace halfspace;

namespace {

Result<Done> picture_of(const char* mesh_file, const char* png_file) {
  const auto mesh = io::read_mesh(mesh_file);
  if (!mesh) return mesh.error();  // the file, the line, the value
  const auto model = io::import_scene(*mesh, {});
  if (!model) return model.error();
  const auto view = io::automatic_view(model->scene, 160, 120);
  if (!view) return view.error();
  const auto tree = ref::build(model->scene, {.candidates = 5, .seed = 1});
  const auto image = ref::render(model->scene, tree, view->camera, {});
  return io::write_png(png_file, image.colors);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: render_scene MESH PICTURE.png\n");
    return EXIT_FAILURE;
  }
  const Result<Done> done = picture_of(argv[1], argv[2]);
  if (done) return EXIT_SUCCESS;
  std::fprintf(stderr, "%s\n", done.error().message.c_str());
  return EXIT_FAILURE;
}
