#include "halfspace/io/figure_legend.hpp"
#include "halfspace/io/legend.hpp"

namespace halfspace::io {

// Where there are no pictures as files, there is no font either: no legend.
std::int32_t legend_width(const Legend&, std::int32_t, std::int32_t) {
  return 0;
}

void draw_legend(const Legend&, const ItemImage&, const Rgb&, ColorImage&) {}

bool add_legend(const Legend&, const Rgb&, Figure&) { return false; }

}  // namespace halfspace::io
