#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "halfspace/csg/script.hpp"

/// Scripts of booleans as text: what parse_script() takes apart, put together.
namespace halfspace::fuzz {

/// Those of the words a, b, c and d that are in the text, as names of the files
/// `a.off` and so on.
std::vector<csg::Binding> bindings_of(std::string_view text);

/// One statement for each node, in their order: whatever is read from that has
/// the same nodes.
std::string statements_of(const csg::Script& script);

/// The result in one expression, with no bracket that it can do without;
/// nothing if that has over `most` characters.
std::optional<std::string> expression_of(const csg::Script& script,
                                         std::size_t most);

/// Whether two scripts have the same nodes, wherever these stand in the text.
bool same_nodes(const csg::Script& a, const csg::Script& b);

/// Whether the results of two scripts are made of the same parts in the same
/// way, whichever of the parts the scripts name.
bool same_result(const csg::Script& a, const csg::Script& b);

}  // namespace halfspace::fuzz
