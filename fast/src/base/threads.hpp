#pragma once

/// The only place where the library meets oneTBB, which HALFSPACE_THREADS=OFF
/// leaves out.
#if defined(HALFSPACE_ONE_THREAD)
#include "base/threads_one.hpp"
#else
#include "base/threads_tbb.hpp"
#endif

namespace halfspace::fast {

#if defined(HALFSPACE_ONE_THREAD)
namespace threads = one_thread;
#else
namespace threads = tbb_threads;
#endif

}  // namespace halfspace::fast
