#include <utility>

#include "halfspace/csg/components.hpp"
#include "halfspace/solid.hpp"
#include "node.hpp"

namespace halfspace {

Result<std::vector<Solid>> Solid::decompose() const {
  const auto whole = node_->evaluation({});
  if (!whole) return whole.error();
  std::vector<Solid> parts;
  const Lock lock((*whole)->mutex);
  for (fast::Solid& component : csg::components_of((*whole)->solid)) {
    // The part of an expression that has a point: it stays that one wherever
    // the expression is moved to.
    auto node = std::make_shared<detail::SolidNode>();
    node->kind = csg::NodeKind::kComponent;
    node->left = node_;
    node->point = csg::point_within(component);
    node->name = name();
    auto known = std::make_shared<detail::Evaluation>();
    known->solid = std::move(component);
    known->uses = (*whole)->uses;
    known->cuts = (*whole)->cuts;
    known->rounding = (*whole)->rounding;
    node->set_evaluation(std::move(known));
    parts.push_back(Solid(std::move(node)));
  }
  return parts;
}

}  // namespace halfspace
