#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "halfspace/boolean.hpp"
#include "halfspace/fast/solid.hpp"

/// What holds for the booleans of any two solids, checked without an oracle.
namespace halfspace::identities {

/// A boolean to be checked: fast::boolean(), or a wrong one.
using Boolean = std::function<fast::Solid(BooleanOp, const fast::Solid&,
                                          const fast::Solid&)>;

/// The one that ships.
fast::Solid shipped(BooleanOp operation, const fast::Solid& a,
                    const fast::Solid& b);

/// Whether the solids are one point set: their least surfaces are the same,
/// edge by edge.
/// Requires: one table.
bool is_same_set(const fast::Solid& a, const fast::Solid& b);

/// How many of the first solid's faces, merged by their origin, are not the
/// second's, edge by edge, and the other way round.
/// Requires: one table.
std::size_t count_foreign_faces(const fast::Solid& a, const fast::Solid& b);

/// What is wrong with the form of the surface, if anything: an edge or a face
/// that is not closed, a vertex within an edge, two faces of one plane in one
/// place.
std::vector<std::string> faults_of(const fast::Solid& solid);

/// The identities that do not hold for the two solids: volumes add up, exactly,
/// what is cut is put together again, De Morgan's laws, either with itself; and
/// what is wrong with the form of the results.
/// Requires: one table, bounded, parts 0 and 1.
std::vector<std::string> broken_identities(const fast::Solid& a,
                                           const fast::Solid& b,
                                           const Boolean& boolean);

}  // namespace halfspace::identities
