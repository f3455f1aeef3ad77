#pragma once

#include <pthread.h>

#include <functional>

#include "halfspace/assert.hpp"

namespace halfspace::ref {

/// Runs `work` on a stack of 256 KiB, on which a recursion as deep as the trees
/// of these tests does not fit.
inline void on_small_stack(std::function<void()> work) {
  pthread_attr_t attributes;
  HALFSPACE_ASSERT(pthread_attr_init(&attributes) == 0);
  HALFSPACE_ASSERT(pthread_attr_setstacksize(&attributes, 256 * 1024) == 0);
  pthread_t thread;
  const auto run = [](void* argument) -> void* {
    (*static_cast<std::function<void()>*>(argument))();
    return nullptr;
  };
  HALFSPACE_ASSERT(pthread_create(&thread, &attributes, run, &work) == 0);
  HALFSPACE_ASSERT(pthread_join(thread, nullptr) == 0);
  HALFSPACE_ASSERT(pthread_attr_destroy(&attributes) == 0);
}

}  // namespace halfspace::ref
