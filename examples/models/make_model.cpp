// Writes one of the models as a mesh or a scene file.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "halfspace/io/format.hpp"
#include "halfspace/io/write_mesh.hpp"
#include "halfspace/scene_file.hpp"
#include "models.hpp"

namespace {

using halfspace::Result;
using halfspace::Scene;

int fail(const std::string& sentence) {
  std::fprintf(stderr, "make_model: %s\n", sentence.c_str());
  return EXIT_FAILURE;
}

int write(const std::string& path, const Scene& scene) {
  if (std::filesystem::path(path).extension() == ".scene") {
    std::ofstream out(path, std::ios::binary);
    out << halfspace::write_scene(
        {.scene = scene, .camera = {}, .options = {}});
    out.close();
    return out ? EXIT_SUCCESS : fail(path + ": cannot be written");
  }
  const auto report = halfspace::io::write_scene_mesh(path, scene);
  return report ? EXIT_SUCCESS : fail(report.error().message);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Writes a model, made in code, as " +
               halfspace::io::format_extensions(".scene") + ".");
  std::string name;
  std::string output;
  halfspace::models::ModelOptions options;
  app.add_option("NAME", name, "The model")->required();
  app.add_option("-o,--output", output, "The file")->required();
  app.add_option("--count", options.count, "How many parts it has");
  app.add_option("--size", options.size, "Size of random triangles");
  app.add_option("--seed", options.seed, "Seed of what is random");
  std::string models = "Models:\n";
  for (const auto& model : halfspace::models::model_names()) {
    models += "  " + std::string(model.name) + ": " +
              std::string(model.meaning) + "\n";
  }
  app.footer(models);
  CLI11_PARSE(app, argc, argv);
  const Result<Scene> scene = halfspace::models::make_model(name, options);
  if (!scene) return fail(scene.error().message);
  return write(output, *scene);
}
