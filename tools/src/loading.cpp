#include "loading.hpp"

#include <cstdio>

#include "options.hpp"

namespace halfspace::tools {
std::string to_string(const io::ImportReport& report) {
  char text[256];
  std::snprintf(text, sizeof text,
                "moved %zu coordinates (by at most %.3g), triangulated %zu, "
                "dropped %zu",
                report.moved, report.max_move, report.triangulated,
                report.dropped);
  return text;
}

void add_grid_option(CLI::App& app, std::optional<int>& bits) {
  add_parsed<int>(app, "--grid", "26|40|54", bits, parse_grid,
                  "Round the mesh to a grid of so many bits; without it, the "
                  "smallest that holds it exactly");
}

}  // namespace halfspace::tools
