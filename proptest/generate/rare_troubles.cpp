#include "generate/generate.hpp"
#include "generate/troubles.hpp"

namespace halfspace::generate {

const std::map<std::string, std::size_t>& rare_troubles() {
  static const std::map<std::string, std::size_t> rare = {
      {"eye in a polygon", 12},
      {"no polygons", 6},
      {"thinner than a pixel", 6},
      {"cyclic overlap", 24},
      {"grid of 26 bits at its limit", 12},
      {"grid of 40 bits at its limit", 12},
      {"grid of 54 bits at its limit", 12}};
  return rare;
}

std::set<std::string> common_troubles() {
  std::set<std::string> names = all_troubles();
  for (const auto& [name, count] : rare_troubles()) names.erase(name);
  return names;
}

}  // namespace halfspace::generate
