#include "halfspace/exact.hpp"

#include "node.hpp"

namespace halfspace::exact {

Result<fast::Solid> solid_of(const halfspace::Solid& solid) {
  const auto evaluation = detail::SolidNode::of(solid).evaluation({});
  if (!evaluation) return evaluation.error();
  return (*evaluation)->solid;
}

}  // namespace halfspace::exact
