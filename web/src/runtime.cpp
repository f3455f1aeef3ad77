// What the toolchain leaves to its users: where Boost without exceptions ends,
// the guard of stacks of the compiler's own library, and what becomes of the
// values of the one thread, which never ends.
#include <boost/throw_exception.hpp>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>

namespace boost {

/// The module stops, as where memory ends.
void throw_exception(const std::exception& e) {
  std::fprintf(stderr, "%s\n", e.what());
  std::abort();
}
void throw_exception(const std::exception& e, const source_location&) {
  throw_exception(e);
}

}  // namespace boost

extern "C" {

extern std::uintptr_t __stack_chk_guard;
std::uintptr_t __stack_chk_guard = 0x595e9fbd;
[[noreturn]] void __stack_chk_fail();
void __stack_chk_fail() { std::abort(); }
int __cxa_thread_atexit(void (*)(void*), void*, void*);
int __cxa_thread_atexit(void (*)(void*), void*, void*) { return 0; }
}
