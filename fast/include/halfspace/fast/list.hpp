#pragma once

#include <memory_resource>
#include <vector>

namespace halfspace::fast {

/// A vector that may be long. Its memory comes from the resource that was the
/// program's default when the list was made (std::pmr::get_default_resource()):
/// new and delete, unless the program sets another one, for example a
/// HugePagePool.
template <class T>
using List = std::pmr::vector<T>;

}  // namespace halfspace::fast
