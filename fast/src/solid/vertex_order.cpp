#include "solid/vertex_order.hpp"

#include <algorithm>
#include <limits>

#include "base/radix_sort.hpp"

namespace halfspace::fast {
namespace {

/// A vertex on its way to its place.
struct Ranked {
  double x = 0;
  std::uint32_t cell = 0;  ///< ascends with x
  std::int32_t id = 0;
};

/// Cells are two digits of the radix sort. Untuned.
constexpr std::uint32_t kCellCount = std::uint32_t{1} << 22;

/// Sorts by x what lies between two numbers.
void sort_by_x(List<Ranked>& row, double low, double high) {
  const auto is_less = [](const Ranked& a, const Ranked& b) {
    return a.x < b.x;
  };
  constexpr std::size_t kMany = 512;
  if (row.size() < kMany) {
    std::sort(row.begin(), row.end(), is_less);
    return;
  }
  if (!(low < high)) return;
  // Rounding keeps the order.
  const double scale = (kCellCount - 1) / (high - low);
  for (Ranked& r : row)
    r.cell = static_cast<std::uint32_t>((r.x - low) * scale);
  radix_sort(row, [](const Ranked& r) { return std::uint64_t{r.cell}; });
  for (auto i = row.begin(); i != row.end();) {
    const auto j = std::find_if(
        i, row.end(), [&](const Ranked& r) { return r.cell != i->cell; });
    if (!std::is_sorted(i, j, is_less)) std::sort(i, j, is_less);
    i = j;
  }
}

/// Whether a vertex comes before another.
bool is_before(std::int32_t u, std::int32_t v, const GeometryTable& table) {
  const Vertex& a = table.vertex(u).approximate;
  const Vertex& b = table.vertex(v).approximate;
  const double p[3] = {a.x, a.y, a.z};
  const double q[3] = {b.x, b.y, b.z};
  const bool exact = a.error == 0 && b.error == 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double d = p[axis] - q[axis];
    if (exact && d == 0) continue;
    const int order = exact ? (d < 0 ? -1 : 1) : table.compare(axis, u, v);
    if (order != 0) return order < 0;
  }
  return false;
}

}  // namespace

List<std::int32_t> vertices_in_order(std::span<const std::int32_t> vertices,
                                     const GeometryTable& table) {
  List<Ranked> row;
  row.reserve(vertices.size());
  double error = 0;
  double low = std::numeric_limits<double>::max();
  double high = std::numeric_limits<double>::lowest();
  for (const std::int32_t v : vertices) {
    const Vertex& at = table.vertex(v).approximate;
    error = std::max(error, at.error);
    low = std::min(low, at.x);
    high = std::max(high, at.x);
    row.push_back({at.x, 0, v});
  }
  sort_by_x(row, low, high);
  // Vertices that are nearly level along the first axis are sorted exactly.
  for (auto i = row.begin(); i != row.end();) {
    auto j = i + 1;
    while (j != row.end() && j->x - (j - 1)->x <= 3 * error) ++j;
    if (j - i > 1) {
      std::sort(i, j, [&](const Ranked& a, const Ranked& b) {
        return is_before(a.id, b.id, table);
      });
    }
    i = j;
  }
  List<std::int32_t> order;
  order.reserve(row.size());
  for (const Ranked& r : row) order.push_back(r.id);
  return order;
}

}  // namespace halfspace::fast
