#pragma once

/// What a shared library of Halfspace shows; everything else is hidden.
#if defined(__GNUC__)
#define HALFSPACE_API __attribute__((visibility("default")))
#else
#define HALFSPACE_API
#endif
