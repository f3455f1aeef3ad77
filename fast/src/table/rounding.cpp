#include "exact/nearest_double.hpp"
#include "table/geometry_table.hpp"

namespace halfspace::fast {

std::array<double, 3> GeometryTable::nearest(std::int32_t id,
                                             bool& rounded) const {
  rounded = false;
  const TableVertex& v = vertex(id);
  if (v.is_grid()) return {v.approximate.x, v.approximate.y, v.approximate.z};
  return with_grid(grid_bits_, [&](auto bits) {
    constexpr std::size_t kWords = Grid<bits()>::kWords;
    std::array<Wide<kWords>, 4> c;
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t w = 0; w < kWords; ++w)
        c[i].words[w] = exact_[v.exact + i * kWords + w];
    }
    std::array<double, 3> result;
    for (std::size_t i = 0; i < 3; ++i) {
      bool is_rounded = false;
      result[i] = quotient(c[i], c[3], is_rounded);
      rounded = rounded || is_rounded;
    }
    return result;
  });
}

}  // namespace halfspace::fast
