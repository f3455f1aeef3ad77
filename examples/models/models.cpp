#include "models.hpp"

#include <array>
#include <string>

#include "shapes.hpp"

namespace halfspace::models {
namespace {

/// The most parts of a model: more would fill the memory by mistake.
constexpr int kMaxCount = 10'000'000;

struct Model {
  ModelName name;
  Result<Scene> (*make)(const ModelOptions& options);
};

constexpr std::array<Model, 10> kModels = {{
    {{"cube", "a cube: the smallest closed solid here"}, cube},
    {{"interlocking-cubes", "3 crossing cubes, 216 rectangles (FAG83)"},
     interlocking_cubes},
    {{"pinwheel", "4 bars, each over the next: cyclic overlap"}, pinwheel},
    {{"stairs", "N steps: a closed solid with many coincident planes"}, stairs},
    {{"sphere", "a ball with N meridians, coloured corners"}, sphere},
    {{"klein-bottle", "a one-sided surface, 450 triangles (FAG83)"},
     klein_bottle},
    {{"ribbons", "16 ribbons of 23 rectangles, 368 in all (FAG83)"}, ribbons},
    {{"theorem1", "N rectangles, every tree has N(N+4)/4 nodes (HEUR)"},
     theorem1},
    {{"random", "N random triangles of size S (F2B)"}, random_triangles},
    {{"parallel", "N parallel random triangles of size S (F2B)"},
     parallel_triangles},
}};

}  // namespace

std::vector<ModelName> model_names() {
  std::vector<ModelName> names;
  for (const Model& model : kModels) names.push_back(model.name);
  return names;
}

Result<Scene> make_model(std::string_view name, const ModelOptions& options) {
  if (options.count < 0 || options.count > kMaxCount) {
    return Error{ErrorCode::kOutOfRange, "the count is from 1 to 10000000"};
  }
  for (const Model& model : kModels) {
    if (model.name.name == name) return model.make(options);
  }
  return Error{ErrorCode::kOutOfRange,
               "there is no model called " + std::string(name)};
}

}  // namespace halfspace::models
