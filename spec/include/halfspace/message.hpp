#pragma once

#include <string>
#include <string_view>

namespace halfspace {

/// A token of an input as it may stand in an error's message: short, and
/// printable ASCII only.
std::string in_quotes(std::string_view token);

}  // namespace halfspace
