#pragma once

#include <nlohmann/json.hpp>

#include "halfspace/csg/scaled.hpp"

namespace halfspace::tools {

/// A number that readers of JSON get as a double; null where no double is near.
inline nlohmann::json json_of(const csg::Scaled& value) {
  return value.is_double() ? nlohmann::json(value.value()) : nlohmann::json();
}

}  // namespace halfspace::tools
