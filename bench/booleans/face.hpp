#pragma once

#include "booleans/contestant.hpp"

namespace halfspace::bench {

/// The same case through halfspace::Solid, by one thread. Reading and checking
/// the operands, which calls of the fast library leave out, is not measured;
/// bringing them to one table is, as it is there. `import_ms` is 0.
std::optional<Outcome> through_the_face(const BooleanCase& task);

/// Two spheres of about `triangles` each in general position, one taken from
/// the other, from meshes of doubles to a mesh of doubles, with `fields` fields
/// at each corner. Units: ms of processor time.
struct FieldTimes {
  double all_ms = 0;  ///< with reading and checking the operands
  double boolean_and_mesh_ms = 0;
};
FieldTimes time_with_fields(int triangles, std::size_t fields);

}  // namespace halfspace::bench
