// Included before everything in builds for WebAssembly: Boost's mutex where
// there are no threads, for its own header asks for std::mutex.
#pragma once

#define BOOST_SMART_PTR_DETAIL_LIGHTWEIGHT_MUTEX_HPP_INCLUDED

namespace boost::detail {

class lightweight_mutex {
 public:
  class scoped_lock {
   public:
    explicit scoped_lock(lightweight_mutex&) {}
    ~scoped_lock() {}
  };
};

}  // namespace boost::detail
