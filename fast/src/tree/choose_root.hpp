#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "halfspace/bsp_tree.hpp"
#include "halfspace/plane.hpp"

namespace halfspace::fast {

/// A polygon's degrees in HEUR's graph G(I), and how its plane divides the
/// others.
struct RootCounts {
  std::uint64_t out_degree = 0;
  std::uint64_t in_degree = 0;
  std::uint64_t positive = 0;
  std::uint64_t negative = 0;
};

/// Up to this number the draws are looked up one by one, not in a list of all.
/// Untuned.
constexpr std::uint32_t kFewCandidates = 32;

/// The indices among which the rule chooses, in order (S3.4).
inline void draw_candidates(const BuildOptions& options, std::size_t count,
                            std::uint64_t key,
                            std::vector<std::size_t>& candidates) {
  candidates.clear();
  if (options.rule != RootRule::kRandom || options.candidates >= count) {
    candidates.resize(count);
    std::iota(candidates.begin(), candidates.end(), std::size_t{0});
    return;
  }
  if (options.candidates > kFewCandidates) {
    candidates.resize(count);
    std::iota(candidates.begin(), candidates.end(), std::size_t{0});
    for (std::size_t j = 0; j < options.candidates; ++j) {
      std::swap(candidates[j], candidates[j + draw(key, j, count - j)]);
    }
    candidates.resize(options.candidates);
  } else {
    // The same without the list 0, 1, 2, ...: only swapped entries differ from
    // it, one for each draw.
    std::vector<std::pair<std::size_t, std::size_t>> moved;
    const auto entry = [&moved](std::size_t place) {
      for (auto it = moved.rbegin(); it != moved.rend(); ++it) {
        if (it->first == place) return it->second;
      }
      return place;
    };
    for (std::size_t j = 0; j < options.candidates; ++j) {
      const std::size_t r = j + draw(key, j, count - j);
      candidates.push_back(entry(r));
      moved.emplace_back(r, entry(j));
    }
  }
  std::sort(candidates.begin(), candidates.end());
}

/// The cost that the rule minimises, in lexicographic order (S3.3).
inline std::pair<std::uint64_t, std::uint64_t> root_cost(
    const RootCounts& counts, std::size_t polygon_count,
    const BuildOptions& options) {
  const std::uint64_t imbalance = counts.positive > counts.negative
                                      ? counts.positive - counts.negative
                                      : counts.negative - counts.positive;
  const std::uint64_t not_cutting = polygon_count - counts.in_degree;
  switch (options.rule) {
    // Never reached: choose_root() does not ask.
    case RootRule::kFirst:
      break;
    case RootRule::kRandom:
    case RootRule::kFewestCuts:
    case RootRule::kH1:
      return {counts.out_degree, 0};
    case RootRule::kH2:
      return {not_cutting, 0};
    case RootRule::kH3:
      return {counts.out_degree, not_cutting};
    case RootRule::kH4:
      return {imbalance, 0};
    case RootRule::kH5:
      return {counts.out_degree * imbalance, 0};
    case RootRule::kH6:
      return {options.cut_weight * counts.out_degree + imbalance, 0};
  }
  // Never reached: no other rule comes here.
  return {0, 0};
}

/// The index of the root in a list of `count` polygons (S3.3).
/// `relation_of(i, j)` is polygon j against the plane of polygon i; `go_on()`
/// is called for each candidate, and where it returns false the answer is any
/// index.
template <class RelationOf, class GoOn>
std::size_t choose_root(std::size_t count, const BuildOptions& options,
                        std::uint64_t key, RelationOf&& relation_of,
                        GoOn&& go_on) {
  // Step 1: nothing to compare where there is no choice.
  if (options.rule == RootRule::kFirst || count == 1) return 0;
  // Step 2: the candidates, lowest id first.
  std::vector<std::size_t> candidates;
  draw_candidates(options, count, key, candidates);
  if (candidates.size() == 1) return candidates[0];
  // Step 3: how many polygons each would cut, and how many would cut it. The
  // in-degree is kept only for the rules that use it.
  const bool needs_in =
      options.rule == RootRule::kH2 || options.rule == RootRule::kH3;
  std::vector<RootCounts> counts(candidates.size());
  for (std::size_t c = 0; c < candidates.size(); ++c) {
    if (!go_on()) return 0;
    for (std::size_t j = 0; j < count; ++j) {
      const Relation relation = relation_of(candidates[c], j);
      counts[c].positive += relation == Relation::kPositive ? 1 : 0;
      counts[c].negative += relation == Relation::kNegative ? 1 : 0;
      if (relation == Relation::kSpanning) {
        ++counts[c].out_degree;
        // These rules have all polygons as candidates: place j is entry j.
        if (needs_in) ++counts[j].in_degree;
      }
    }
  }
  // Step 4: the candidate of least cost; the first of equals.
  std::size_t best = 0;
  for (std::size_t c = 1; c < candidates.size(); ++c) {
    if (root_cost(counts[c], count, options) <
        root_cost(counts[best], count, options)) {
      best = c;
    }
  }
  return candidates[best];
}

}  // namespace halfspace::fast
