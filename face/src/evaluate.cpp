#include <cmath>
#include <unordered_map>
#include <utility>

#include "halfspace/csg/outcome.hpp"
#include "halfspace/csg/plan.hpp"
#include "halfspace/exact.hpp"
#include "node.hpp"

namespace halfspace::detail {
namespace {

using Node = std::shared_ptr<const SolidNode>;

/// An expression as a script of csg, with the nodes of its leaves.
struct Lowered {
  csg::Script script;
  std::vector<Node> leaves;  ///< by file of the script
  std::vector<Node> halves;  ///< by half-space of the script
};

/// Puts the nodes below `root` after their operands. No recursion.
class Lowering {
 public:
  Result<Lowered> lowered(const Node& root) {
    stack_.push_back({root, false});
    while (!stack_.empty()) {
      auto [node, is_done] = std::move(stack_.back());
      stack_.pop_back();
      if (ids_.contains(node.get())) continue;
      if (node->error) return *node->error;
      if (is_done) {
        add(node);
        continue;
      }
      stack_.push_back({node, true});
      if (node->right) stack_.push_back({node->right, false});
      if (node->left) stack_.push_back({node->left, false});
    }
    result_.script.result = ids_.at(root.get());
    return std::move(result_);
  }

 private:
  void add(const Node& node) {
    csg::Script& script = result_.script;
    csg::Node made;
    made.kind = node->kind;
    made.place = {0, 0};
    if (node->left) made.left = ids_.at(node->left.get());
    if (node->right) made.right = ids_.at(node->right.get());
    if (node->kind == csg::NodeKind::kFile) {
      made.item = static_cast<std::int32_t>(script.files.size());
      script.files.push_back({node->name, node->name, {}, false});
      result_.leaves.push_back(node);
    } else if (node->kind == csg::NodeKind::kHalf) {
      made.item = static_cast<std::int32_t>(script.halves.size());
      script.halves.push_back(node->half);
      result_.halves.push_back(node);
    } else if (node->kind == csg::NodeKind::kTransform) {
      made.item = static_cast<std::int32_t>(script.transforms.size());
      script.transforms.push_back(node->matrix);
    } else if (node->kind == csg::NodeKind::kComponent) {
      made.item = static_cast<std::int32_t>(script.points.size());
      script.points.push_back(node->point);
    }
    ids_.emplace(node.get(), static_cast<std::int32_t>(script.nodes.size()));
    script.nodes.push_back(made);
  }

  Lowered result_;
  std::vector<std::pair<Node, bool>> stack_;
  std::unordered_map<const SolidNode*, std::int32_t> ids_;
};

Result<std::vector<std::shared_ptr<const csg::Source>>> sources_of(
    const std::vector<Node>& leaves) {
  std::vector<std::shared_ptr<const csg::Source>> sources;
  for (const Node& node : leaves) {
    const Result<LeafData>& data = node->leaf->data();
    if (!data) return data.error();
    sources.push_back(data->source);
  }
  return sources;
}

/// The error of joining operands, and what to do where no grid holds them.
Error advised(Error error) {
  if (error.code == ErrorCode::kOutOfRange)
    error.message += "; OperandOptions::may_round lets an operand be rounded";
  return error;
}

Result<std::shared_ptr<Evaluation>> evaluated(const Node& root,
                                              const WorkOptions& options) {
  Result<Lowered> lowered = Lowering().lowered(root);
  if (!lowered) return lowered.error();
  auto sources = sources_of(lowered->leaves);
  if (!sources) return sources.error();
  const Result<csg::Plan> plan = csg::make_plan(lowered->script);
  if (!plan) return plan.error();
  csg::OperandOptions how;
  how.exact = true;
  how.repair_word = "OperandOptions::resolve";
  how.check.threads = options.threads;
  Result<csg::Operands> operands =
      csg::Operands::join(*std::move(sources), lowered->script, *plan, how);
  if (!operands) return advised(operands.error());
  csg::EvaluateOptions work;
  work.threads = options.threads;
  work.progress = options.progress;
  auto solid = csg::evaluate_solid(*plan, *operands, work);
  if (!solid && solid.error().code != ErrorCode::kStopped &&
      operands->can_be_finer()) {
    operands = operands->on_finest_grid();
    if (!operands) return operands.error();
    solid = csg::evaluate_solid(*plan, *operands, work);
  }
  if (!solid) return solid.error();
  if (!*solid) return Error{ErrorCode::kStopped, "the work was stopped"};
  auto result = std::make_shared<Evaluation>();
  result->solid = **std::move(solid);
  for (const csg::Leaf& leaf : plan->leaves) {
    result->uses.push_back(
        {lowered->leaves[static_cast<std::size_t>(leaf.file)],
         plan->matrices[static_cast<std::size_t>(leaf.matrix)]});
  }
  const io::ImportReport& report = operands->report();
  result->rounding = {report.moved, report.max_move,
                      std::pow(static_cast<double>(report.unit.base),
                               static_cast<double>(report.unit.exponent)),
                      report.grid_bits};
  for (std::size_t i = 0; i < plan->planes.size(); ++i) {
    const auto half = static_cast<std::size_t>(plan->planes[i].half);
    const auto points = operands->plane(static_cast<std::int32_t>(i));
    if (!points) return points.error();
    result->cuts.push_back(
        {lowered->halves[half], *points, plan->planes[i].points});
  }
  return result;
}

}  // namespace

SolidNode::~SolidNode() {
  std::vector<Node> stack;
  const auto take = [&stack](SolidNode& node) {
    for (Node* child : {&node.left, &node.right}) {
      if (*child) stack.push_back(std::move(*child));
    }
  };
  take(*this);
  while (!stack.empty()) {
    const Node node = std::move(stack.back());
    stack.pop_back();
    // Nobody else has it, so nobody sees it change.
    if (node.use_count() == 1) take(const_cast<SolidNode&>(*node));
  }
}

Result<std::shared_ptr<Evaluation>> SolidNode::evaluation(
    const WorkOptions& options) const {
  const Lock lock(mutex_);
  if (evaluation_) return *evaluation_;
  // Its own owner lives as long as this call.
  const Node self(Node(), this);
  auto result = evaluated(self, options);
  if (!result && result.error().code == ErrorCode::kStopped) return result;
  evaluation_ = std::move(result);
  return *evaluation_;
}

void SolidNode::set_evaluation(std::shared_ptr<Evaluation> evaluation) const {
  const Lock lock(mutex_);
  evaluation_.emplace(std::move(evaluation));
}

Solid leaf_solid(std::string name, Leaf::Load load) {
  auto node = std::make_shared<SolidNode>();
  node->leaf = std::make_shared<const Leaf>(std::move(load));
  node->name = std::move(name);
  return SolidNode::solid_of(std::move(node));
}

Solid faulty_solid(std::string name, ErrorCode code, std::string message) {
  auto node = std::make_shared<SolidNode>();
  node->error = Error{code, name + ": " + message};
  node->name = std::move(name);
  return SolidNode::solid_of(std::move(node));
}

}  // namespace halfspace::detail

namespace halfspace::exact {

Result<fast::Solid> solid_of(const halfspace::Solid& solid) {
  const auto evaluation = detail::SolidNode::of(solid).evaluation({});
  if (!evaluation) return evaluation.error();
  return (*evaluation)->solid;
}

}  // namespace halfspace::exact
