#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <string>

namespace halfspace::generate {

/// The troubles that too few views have for every law to meet them, and how
/// many of 1,200 must have them at least.
const std::map<std::string, std::size_t>& rare_troubles();

/// All others: every law that is tried on all views must meet them.
std::set<std::string> common_troubles();

}  // namespace halfspace::generate
