#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "halfspace/assert.hpp"
#include "halfspace/csg/plan.hpp"
#include "halfspace/progress.hpp"
#include "halfspace/result.hpp"

namespace halfspace::csg {

/// Carries out a plan with one library's solids.
///
/// `Algebra` has a type Value, the solid; leaf(id) and plane(id), which give a
/// Result<Value>; complement(Value); component(Value,
/// point), a Result<Value>; and combine(NodeKind, Value, Value) for
/// the four booleans.
///
/// Long unions and intersections are balanced: each solid takes part in about
/// as many booleans as their number has bits. Their order stays, so of faces
/// that coincide the first solid's is kept. Where an algebra has
/// takes_all(NodeKind) and that says so, its combine_all(NodeKind,
/// std::vector<Value>) is given 64 at once.
template <class Algebra>
class Evaluator {
 public:
  using Value = typename Algebra::Value;

  Evaluator(const Plan& plan, Algebra& algebra, Progress progress)
      : plan_(plan),
        algebra_(algebra),
        progress_(std::move(progress)),
        values_(plan.steps.size()),
        uses_left_(plan.steps.size()) {
    for (std::size_t i = 0; i < plan.steps.size(); ++i)
      uses_left_[i] = plan.steps[i].uses;
  }

  /// The result; nothing where it was stopped.
  Result<std::optional<Value>> result() {
    const std::size_t last = plan_.steps.size() - 1;
    for (std::size_t i = 0; i <= last; ++i) {
      const Step& step = plan_.steps[i];
      // A file is read into a solid when it is wanted, not all at once.
      if (step.terms.empty()) continue;
      values_[i] = value_of(step);
      if (error_) return *error_;
      if (stopped_) return std::optional<Value>();
    }
    Value value = take(static_cast<std::int32_t>(last));
    if (error_) return *error_;
    return std::optional<Value>(std::move(value));
  }

 private:
  bool goes_on() const { return !error_ && !stopped_; }

  /// The value of a step, for one of those that use it.
  Value take(std::int32_t id) {
    const auto i = static_cast<std::size_t>(id);
    const Step& step = plan_.steps[i];
    if (!values_[i]) {
      Result<Value> made = step.kind == NodeKind::kHalf
                               ? algebra_.plane(step.item)
                               : algebra_.leaf(step.item);
      if (!made) {
        error_ = made.error();
        return {};
      }
      values_[i] = *std::move(made);
    }
    if (--uses_left_[i] > 0) return *values_[i];
    Value value = *std::move(values_[i]);
    values_[i].reset();
    return value;
  }

  /// Passes on the share that is done.
  void report() {
    if (!progress_) return;
    stopped_ = !progress_(static_cast<double>(done_) /
                          static_cast<double>(plan_.booleans));
  }

  Value combined(NodeKind kind, Value a, Value b) {
    if (!goes_on()) return {};
    Value value = algebra_.combine(kind, std::move(a), std::move(b));
    ++done_;
    report();
    return value;
  }

  /// Whether the algebra combines many at once.
  bool takes_all(NodeKind kind) const {
    if constexpr (requires { algebra_.takes_all(kind); }) {
      return algebra_.takes_all(kind);
    } else {
      return false;
    }
  }

  Value all_of(NodeKind kind, std::span<const std::int32_t> terms) {
    std::vector<Value> values;
    for (const std::int32_t term : terms) {
      values.push_back(take(term));
      if (!goes_on()) return {};
    }
    done_ += terms.size() - 1;
    report();
    if constexpr (requires { algebra_.combine_all(kind, values); }) {
      return algebra_.combine_all(kind, values);
    } else {
      return {};
    }
  }

  /// The terms, one or more, combined in a balanced way: like the digits of a
  /// binary counter, what is of one size is combined at once.
  Value folded(NodeKind kind, std::span<const std::int32_t> terms) {
    struct Term {
      Value value;
      std::size_t size = 0;
    };
    std::vector<Term> parts;
    const auto join_equals = [&] {
      while (goes_on() && parts.size() > 1 &&
             parts[parts.size() - 2].size == parts.back().size) {
        join_last(kind, parts);
      }
    };
    // As many as make one part of the digits' sizes, for threads to share.
    while (terms.size() >= kMany && takes_all(kind)) {
      parts.push_back({all_of(kind, terms.first(kMany)), kMany});
      terms = terms.subspan(kMany);
      join_equals();
      if (!goes_on()) return {};
    }
    for (const std::int32_t term : terms) {
      parts.push_back({take(term), 1});
      join_equals();
      if (!goes_on()) return {};
    }
    while (goes_on() && parts.size() > 1) join_last(kind, parts);
    return std::move(parts.front().value);
  }

  template <class Term>
  void join_last(NodeKind kind, std::vector<Term>& parts) {
    Term last = std::move(parts.back());
    parts.pop_back();
    Term& first = parts.back();
    first.value = combined(kind, std::move(first.value), std::move(last.value));
    first.size += last.size;
  }

  /// A connected part; the empty solid by an algebra that has none, whose plans
  /// name none.
  Value component_of(const Step& step) {
    Value whole = take(step.terms.front());
    if (!goes_on()) return {};
    const Numbers3& point = plan_.points[static_cast<std::size_t>(step.item)];
    if constexpr (requires { algebra_.component(whole, point); }) {
      Result<Value> part = algebra_.component(std::move(whole), point);
      if (!part) error_ = part.error();
      return part ? *std::move(part) : Value{};
    } else {
      HALFSPACE_ASSERT(false);
      return {};
    }
  }

  Value value_of(const Step& step) {
    if (step.kind == NodeKind::kComplement)
      return algebra_.complement(take(step.terms.front()));
    if (step.kind == NodeKind::kComponent) return component_of(step);
    const std::span<const std::int32_t> terms(step.terms);
    const auto halves = terms.last(step.halves);
    auto solids = terms.first(terms.size() - step.halves);
    Value value;
    if (step.kind == NodeKind::kDifference) {
      value = take(solids.front());
      solids = solids.subspan(1);
      if (!solids.empty() && goes_on()) {
        Value rest = folded(NodeKind::kUnion, solids);
        value = combined(step.kind, std::move(value), std::move(rest));
      }
    } else {
      value = folded(step.kind, solids);
    }
    // Half-spaces among themselves have no bounded surface.
    for (const std::int32_t half : halves) {
      if (!goes_on()) return {};
      Value plane = take(half);
      value = combined(step.kind, std::move(value), std::move(plane));
    }
    return value;
  }

  static constexpr std::size_t kMany = 64;

  const Plan& plan_;
  Algebra& algebra_;
  Progress progress_;
  std::vector<std::optional<Value>> values_;  // by step
  std::vector<std::int32_t> uses_left_;       // by step
  std::size_t done_ = 0;
  bool stopped_ = false;
  std::optional<Error> error_;
};

}  // namespace halfspace::csg
