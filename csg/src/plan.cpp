#include "halfspace/csg/plan.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

namespace halfspace::csg {
namespace {

struct MatrixOrder {
  bool operator()(const Matrix& a, const Matrix& b) const {
    return comes_before(a, b);
  }
};

/// A node under one of the matrices: before long chains are joined.
struct Raw {
  const Node* node = nullptr;
  std::int32_t matrix = -1;
  std::int32_t left = -1;
  std::int32_t right = -1;
  std::int32_t uses = 0;
  bool joined = false;      ///< its terms are those of the step that has it
  std::int32_t first = -1;  ///< its terms: where they begin in the links
  std::int32_t last = -1;
  std::int32_t step = -1;
};

/// A term, and which one is next.
struct Link {
  std::int32_t raw = -1;
  std::int32_t next = -1;
};

class Planner {
 public:
  Planner(const Script& script, std::size_t most_steps)
      : script_(script),
        most_steps_(most_steps),
        wanted_(script.nodes.size()) {}
  Result<Plan> plan();

 private:
  const Node& node(std::int32_t id) const {
    return script_.nodes[static_cast<std::size_t>(id)];
  }
  Raw& raw(std::int32_t id) { return raws_[static_cast<std::size_t>(id)]; }
  bool fail(const Place& place, ErrorCode code, const std::string& sentence) {
    error_ = error_at(place, code, sentence);
    return false;
  }
  std::int32_t matrix_id(const Matrix& matrix);
  bool want(std::size_t id);
  bool want_all();
  std::int32_t raw_of(std::int32_t id, std::int32_t matrix) const;
  void make_raws();
  void append(Raw& to, std::int32_t child, bool join);
  void join_chains();
  void take_item(const Raw& from, Step& step);
  bool reach_of(Step& step);
  bool make_steps();

  /// A matrix that a node is wanted under, and where that stands: its raw step,
  /// or the node and matrix that it comes to, for a transform.
  struct Wanted {
    std::int32_t matrix = -1;
    std::int32_t raw = -1;
    friend bool operator<(const Wanted& a, const Wanted& b) {
      return a.matrix < b.matrix;
    }
    friend bool operator==(const Wanted& a, const Wanted& b) {
      return a.matrix == b.matrix;
    }
  };

  const Script& script_;
  const std::size_t most_steps_;
  std::vector<std::vector<Wanted>> wanted_;  // by node
  std::size_t wanted_count_ = 0;
  std::map<Matrix, std::int32_t, MatrixOrder> matrix_ids_;
  std::vector<Raw> raws_;
  std::vector<Link> links_;
  Plan plan_;
  std::optional<Error> error_;
};

std::int32_t Planner::matrix_id(const Matrix& matrix) {
  const auto next = static_cast<std::int32_t>(plan_.matrices.size());
  const auto [at, is_new] = matrix_ids_.try_emplace(matrix, next);
  if (is_new) plan_.matrices.push_back(matrix);
  return at->second;
}

/// Passes on to a node's operands which matrices they are wanted under.
bool Planner::want(std::size_t id) {
  const Node& n = script_.nodes[id];
  std::vector<Wanted>& wanted = wanted_[id];
  std::sort(wanted.begin(), wanted.end());
  wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
  for (Wanted& one : wanted) {
    std::int32_t matrix = one.matrix;
    if (n.kind == NodeKind::kTransform) {
      const auto both =
          product(plan_.matrices[static_cast<std::size_t>(matrix)],
                  script_.transforms[static_cast<std::size_t>(n.item)]);
      if (!both) {
        return fail(n.place, ErrorCode::kOutOfRange,
                    "this transform and those around it need too many digits");
      }
      matrix = matrix_id(*both);
      one.raw = matrix;  // until there are raw steps
    }
    for (const std::int32_t child : {n.left, n.right}) {
      if (child < 0) continue;
      wanted_[static_cast<std::size_t>(child)].push_back({.matrix = matrix});
      if (++wanted_count_ > most_steps_) {
        return fail(n.place, ErrorCode::kOutOfRange,
                    "the script comes to more than " +
                        std::to_string(most_steps_) + " steps");
      }
    }
  }
  return true;
}

bool Planner::want_all() {
  wanted_[static_cast<std::size_t>(script_.result)].push_back(
      {.matrix = matrix_id(identity_matrix())});
  for (std::size_t id = script_.nodes.size(); id-- > 0;) {
    if (!want(id)) return false;
  }
  return true;
}

std::int32_t Planner::raw_of(std::int32_t id, std::int32_t matrix) const {
  const auto& wanted = wanted_[static_cast<std::size_t>(id)];
  return std::lower_bound(wanted.begin(), wanted.end(),
                          Wanted{.matrix = matrix})
      ->raw;
}

void Planner::make_raws() {
  for (std::size_t id = 0; id < script_.nodes.size(); ++id) {
    const Node& n = script_.nodes[id];
    for (Wanted& one : wanted_[id]) {
      if (n.kind == NodeKind::kTransform) {
        one.raw = raw_of(n.left, one.raw);
        continue;
      }
      Raw step{.node = &n, .matrix = one.matrix};
      if (n.left >= 0) step.left = raw_of(n.left, one.matrix);
      if (n.right >= 0) step.right = raw_of(n.right, one.matrix);
      for (const std::int32_t child : {step.left, step.right}) {
        if (child >= 0) ++raw(child).uses;
      }
      one.raw = static_cast<std::int32_t>(raws_.size());
      raws_.push_back(step);
    }
  }
  const std::int32_t result =
      wanted_[static_cast<std::size_t>(script_.result)].front().raw;
  ++raw(result).uses;
  // What comes after the result is not wanted, so it is the last.
}

/// Makes `child` a term of `to`, or its terms if they are to be joined.
void Planner::append(Raw& to, std::int32_t child, bool join) {
  Raw& from = raw(child);
  std::int32_t first = from.first;
  std::int32_t last = from.last;
  if (join && from.uses == 1) {
    from.joined = true;
  } else {
    first = last = static_cast<std::int32_t>(links_.size());
    links_.push_back({.raw = child});
  }
  if (to.first < 0) {
    to.first = first;
  } else {
    links_[static_cast<std::size_t>(to.last)].next = first;
  }
  to.last = last;
}

void Planner::join_chains() {
  for (Raw& step : raws_) {
    const NodeKind kind = step.node->kind;
    const auto is = [&](std::int32_t child, NodeKind wanted) {
      return raw(child).node->kind == wanted;
    };
    if (kind == NodeKind::kComplement || kind == NodeKind::kComponent)
      append(step, step.left, false);
    if (step.right < 0) continue;
    // Where faces of symmetric differences coincide, the order decides whose
    // they are.
    const bool joins = kind != NodeKind::kSymmetricDifference;
    append(step, step.left, joins && is(step.left, kind));
    append(
        step, step.right,
        joins && is(step.right,
                    kind == NodeKind::kDifference ? NodeKind::kUnion : kind));
  }
}

/// The leaf or plane of a step that has no terms.
void Planner::take_item(const Raw& from, Step& step) {
  if (step.kind == NodeKind::kFile) {
    step.item = static_cast<std::int32_t>(plan_.leaves.size());
    plan_.leaves.push_back({from.node->item, from.matrix, step.place});
    return;
  }
  step.reach = Reach::kHalf;
  step.item = static_cast<std::int32_t>(plan_.planes.size());
  const Matrix& matrix = plan_.matrices[static_cast<std::size_t>(from.matrix)];
  const HalfSpace& points =
      script_.halves[static_cast<std::size_t>(from.node->item)];
  // Turned inside out, the plane would face the other way.
  const bool mirrored = determinant_sign(matrix) < 0;
  Plane plane;
  plane.half = from.node->item;
  plane.place = step.place;
  for (std::size_t i = 0; i < 3; ++i)
    plane.points[i] = image_of(matrix, points[mirrored ? 2 - i : i]);
  plan_.planes.push_back(std::move(plane));
}

/// What the step is far away, its half-spaces put last.
bool Planner::reach_of(Step& step) {
  const auto reach = [this](std::int32_t term) {
    return plan_.steps[static_cast<std::size_t>(term)].reach;
  };
  const auto is_half = [&](std::int32_t term) {
    return reach(term) == Reach::kHalf;
  };
  const auto begin = step.terms.begin();
  const bool is_difference = step.kind == NodeKind::kDifference;
  const auto rest = begin + (is_difference ? 1 : 0);
  const auto halves =
      std::stable_partition(rest, step.terms.end(),
                            [&](std::int32_t term) { return !is_half(term); });
  step.halves = static_cast<std::size_t>(step.terms.end() - halves);
  const auto unbounded = std::count_if(rest, halves, [&](std::int32_t term) {
    return reach(term) == Reach::kUnbounded;
  });
  const auto bounded = halves - rest - unbounded;
  bool inside = false;   // far away
  bool decided = false;  // the half-spaces have no say there
  switch (step.kind) {
    case NodeKind::kComplement:
      if (step.halves > 0) {
        step.reach = Reach::kHalf;
        return true;
      }
      inside = bounded > 0;
      break;
    case NodeKind::kComponent:
      if (unbounded > 0) {
        return fail(step.place, ErrorCode::kUnbounded,
                    "a part of this would reach infinitely far");
      }
      break;
    case NodeKind::kUnion:
      inside = decided = unbounded > 0;
      break;
    case NodeKind::kIntersection:
      inside = bounded == 0;
      decided = bounded > 0;
      break;
    case NodeKind::kDifference:
      inside = reach(*begin) == Reach::kUnbounded && unbounded == 0;
      decided = !inside && !is_half(*begin);
      break;
    default:
      inside = unbounded % 2 == 1;
      break;
  }
  const bool half = step.halves > 0 || (is_difference && is_half(*begin));
  if (half && !decided) {
    return fail(step.place, ErrorCode::kUnbounded,
                "the surface of this would reach infinitely far; cut a solid, "
                "as in solid & half(x < 5)");
  }
  step.reach = inside ? Reach::kUnbounded : Reach::kBounded;
  return true;
}

bool Planner::make_steps() {
  for (Raw& from : raws_) {
    if (from.joined) continue;
    Step step;
    step.kind = from.node->kind;
    step.place = from.node->place;
    step.uses = from.uses;
    if (from.first < 0) take_item(from, step);
    if (step.kind == NodeKind::kComponent) {
      step.item = static_cast<std::int32_t>(plan_.points.size());
      plan_.points.push_back(
          image_of(plan_.matrices[static_cast<std::size_t>(from.matrix)],
                   script_.points[static_cast<std::size_t>(from.node->item)]));
    }
    for (std::int32_t link = from.first; link >= 0;) {
      const Link& at = links_[static_cast<std::size_t>(link)];
      step.terms.push_back(raw(at.raw).step);
      link = at.next;
    }
    if (!step.terms.empty()) {
      if (!reach_of(step)) return false;
      plan_.booleans += step.terms.size() - 1;
    }
    from.step = static_cast<std::int32_t>(plan_.steps.size());
    plan_.steps.push_back(std::move(step));
  }
  return true;
}

Result<Plan> Planner::plan() {
  if (!want_all()) return *error_;
  make_raws();
  join_chains();
  if (!make_steps()) return *error_;
  const Step& result = plan_.steps.back();
  if (result.reach == Reach::kBounded) return std::move(plan_);
  return error_at(result.place, ErrorCode::kUnbounded,
                  result.reach == Reach::kHalf
                      ? "the result is all on one side of a plane; cut a solid "
                        "with it"
                      : "the result is inside out: everything but a part of "
                        "space; no mesh says that");
}

}  // namespace

Result<Plan> make_plan(const Script& script, std::size_t most_steps) {
  return Planner(script, most_steps).plan();
}

}  // namespace halfspace::csg
