#pragma once

/// The only place where the library meets oneTBB, which HALFSPACE_THREADS=OFF
/// leaves out.
#if defined(HALFSPACE_ONE_THREAD)
#include "base/threads_one.hpp"
#else
#include "base/threads_tbb.hpp"
#endif

namespace halfspace::fast {

/// `kManyThreads`: whether there may be more than one, so that code for that is
/// of use.
#if defined(HALFSPACE_ONE_THREAD)
namespace threads = one_thread;
constexpr bool kManyThreads = false;
#else
namespace threads = tbb_threads;
constexpr bool kManyThreads = true;
#endif

}  // namespace halfspace::fast
