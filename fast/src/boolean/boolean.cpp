#include "halfspace/fast/boolean.hpp"

#include "base/parallel.hpp"
#include "boolean/assemble.hpp"
#include "boolean/conform.hpp"
#include "solid/move_to_table.hpp"

namespace halfspace::fast {
namespace {

/// The boolean of solids in the lease's table.
Solid carried_out(BooleanOp operation, const Solid& a, const Solid& b,
                  TableLease& lease, int threads) {
  Arrangement found(operation, a, b, lease, threads);
  found.find_contacts();
  if (found.conforms(0) && found.conforms(1)) return assembled(found).solid;
  const Solid first = found.conforms(0) ? a : conforming(a, lease);
  const Solid second = found.conforms(1) ? b : conforming(b, lease);
  Solid result = carried_out(operation, first, second, lease, threads);
  for (Face& face : result.faces) {
    const Solid& from = face.from_first ? first : second;
    if (!found.conforms(face.from_first ? 0 : 1))
      face.source = from.faces[static_cast<std::size_t>(face.source)].source;
  }
  return result;
}

}  // namespace

Solid boolean(BooleanOp operation, const Solid& a, const Solid& b,
              int threads) {
  if (!a.table != !b.table) {
    // A default solid is empty: it fits any table and any unit.
    const Solid& known = a.table ? a : b;
    Solid empty = a.table ? b : a;
    empty.table = known.table;
    empty.unit = known.unit;
    return a.table ? boolean(operation, a, empty, threads)
                   : boolean(operation, empty, b, threads);
  }
  return with_lease(
      a, b, [&](const Solid& first, const Solid& second, TableLease& lease) {
        return carried_out(operation, first, second, lease,
                           thread_count(threads));
      });
}

Halves split(const Solid& solid, const std::array<GridPoint, 3>& corners) {
  const Solid negative = half_space(corners, solid);
  return {boolean(BooleanOp::kDifference, solid, negative),
          boolean(BooleanOp::kIntersection, solid, negative)};
}

}  // namespace halfspace::fast
