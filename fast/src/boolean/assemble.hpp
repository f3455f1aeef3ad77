#pragma once

#include "boolean/arrangement.hpp"

namespace halfspace::fast {

/// A boolean's result, and the packets of its faces' edges.
struct Assembled {
  Solid solid;
  EdgePackets blocks;
};

/// Steps 1 to 3 of a boolean: classifies, emits and assembles the faces of the
/// result, each of one source.
/// Requires: both operands conform (Arrangement::conforms()).
Assembled assembled(Arrangement& arrangement);

}  // namespace halfspace::fast
