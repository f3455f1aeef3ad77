#pragma once

#include <cstdio>
#include <cstdlib>

/// Stops the program where a precondition is broken: that is a bug of the
/// caller, not an input error. Always on, whatever NDEBUG says.
#define HALFSPACE_ASSERT(condition)                                      \
  do {                                                                   \
    if (!(condition)) {                                                  \
      std::fprintf(stderr, "%s:%d: broken precondition: %s\n", __FILE__, \
                   __LINE__, #condition);                                \
      std::abort();                                                      \
    }                                                                    \
  } while (false)
