#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "halfspace/result.hpp"
#include "halfspace/scene.hpp"

namespace halfspace::models {

/// Parameters of a model. Each model uses those it needs.
struct ModelOptions {
  int count = 0;           ///< number of parts; 0: the model's default
  int size = 500;          ///< side of the cube a random triangle lies in
  std::uint64_t seed = 1;  ///< of random numbers
};

/// A model by name, and what it is for.
struct ModelName {
  std::string_view name;
  std::string_view meaning;
};

/// All models, in the order of the table in the source.
std::vector<ModelName> model_names();

/// The model called `name`: exact integer coordinates, made in code.
///
/// Errors: kOutOfRange where there is no such model, or the options ask for a
///         size or count that it cannot have.
Result<Scene> make_model(std::string_view name, const ModelOptions& options);

}  // namespace halfspace::models
