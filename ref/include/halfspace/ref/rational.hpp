#pragma once

/// The numbers of the reference. Both classes have the same functions and
/// values; HALFSPACE_PLAIN_RATIONAL takes the one that is plain to read.
#ifdef HALFSPACE_PLAIN_RATIONAL
#include "halfspace/ref/plain_rational.hpp"
#else
#include "halfspace/ref/small_rational.hpp"
#endif
