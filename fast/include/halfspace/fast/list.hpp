#pragma once

#if !defined(__wasm__)
#include <memory_resource>
#endif
#include <vector>

namespace halfspace::fast {

/// A vector that may be long. Its memory comes from the resource that was the
/// program's default when the list was made (std::pmr::get_default_resource()):
/// new and delete, unless the program sets another one, for example a
/// HugePagePool. A module for the web has one memory, and is smaller with
/// vectors that know it.
#if defined(__wasm__)
template <class T>
using List = std::vector<T>;
#else
template <class T>
using List = std::pmr::vector<T>;
#endif

}  // namespace halfspace::fast
