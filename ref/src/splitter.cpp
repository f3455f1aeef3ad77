#include "halfspace/ref/splitter.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "halfspace/assert.hpp"

namespace halfspace::ref {
namespace {

/// A polygon's degrees in HEUR's graph G(I), whose edges lead from a plane to
/// the polygons that it cuts, and how its plane divides the others.
struct Counts {
  std::uint64_t out_degree = 0;  ///< polygons that its plane cuts
  std::uint64_t in_degree = 0;   ///< polygons whose planes cut it
  std::uint64_t positive = 0;
  std::uint64_t negative = 0;

  /// HEUR's |IN - OUT|: which side the origin is on does not change it.
  std::uint64_t imbalance() const {
    return positive > negative ? positive - negative : negative - positive;
  }
};

/// The counts of all polygons; those of a polygon that is no candidate lack
/// all but the in-degree, which counts the planes of candidates alone.
std::vector<Counts> count(const std::vector<Plane>& planes,
                          const std::vector<Fragment>& polygons,
                          const std::vector<std::size_t>& candidates) {
  std::vector<Counts> counts(polygons.size());
  for (const std::size_t i : candidates) {
    const Plane& plane = planes[static_cast<std::size_t>(polygons[i].source)];
    for (std::size_t j = 0; j < polygons.size(); ++j) {
      switch (relation(polygons[j], plane)) {
        case Relation::kPositive:
          ++counts[i].positive;
          break;
        case Relation::kNegative:
          ++counts[i].negative;
          break;
        case Relation::kSpanning:
          ++counts[i].out_degree;
          ++counts[j].in_degree;
          break;
        case Relation::kCoincident:
          break;
      }
    }
  }
  return counts;
}

/// The polygons among which the rule chooses, in id order: all of them, or
/// `options.candidates` drawn without repetition (S3.4).
std::vector<std::size_t> candidates_of(const BuildOptions& options,
                                       std::size_t polygon_count,
                                       std::uint64_t key) {
  std::vector<std::size_t> candidates(polygon_count);
  std::iota(candidates.begin(), candidates.end(), std::size_t{0});
  if (options.rule == RootRule::kRandom && options.candidates < polygon_count) {
    for (std::size_t j = 0; j < options.candidates; ++j) {
      const std::size_t r = j + draw(key, j, polygon_count - j);
      std::swap(candidates[j], candidates[r]);
    }
    candidates.resize(options.candidates);
    std::sort(candidates.begin(), candidates.end());
  }
  return candidates;
}

/// The cost that the rule minimises, in lexicographic order. A
/// greatest in-degree is a least number of polygons that do not cut.
std::pair<std::uint64_t, std::uint64_t> cost(const Counts& counts,
                                             std::size_t polygon_count,
                                             const BuildOptions& options) {
  const std::uint64_t not_cutting = polygon_count - counts.in_degree;
  switch (options.rule) {
    // Never reached: choose_root() does not ask.
    case RootRule::kFirst:
      return {0, 0};
    case RootRule::kRandom:
    case RootRule::kFewestCuts:
    case RootRule::kH1:
      return {counts.out_degree, 0};
    case RootRule::kH2:
      return {not_cutting, 0};
    case RootRule::kH3:
      return {counts.out_degree, not_cutting};
    case RootRule::kH4:
      return {counts.imbalance(), 0};
    case RootRule::kH5:
      return {counts.out_degree * counts.imbalance(), 0};
    case RootRule::kH6:
      return {options.cut_weight * counts.out_degree + counts.imbalance(), 0};
  }
  HALFSPACE_ASSERT(false && "a rule of S3.3");
  return {};
}

}  // namespace

std::size_t choose_root(const std::vector<Plane>& planes,
                        const std::vector<Fragment>& polygons,
                        const BuildOptions& options, std::uint64_t key) {
  HALFSPACE_ASSERT(!polygons.empty());
  HALFSPACE_ASSERT(options.candidates >= 1);
  // Step 1: nothing to compare where there is no choice.
  if (options.rule == RootRule::kFirst || polygons.size() == 1) return 0;
  // Step 2: the candidates, lowest id first.
  const std::vector<std::size_t> candidates =
      candidates_of(options, polygons.size(), key);
  // Step 3: what each would cut, and what would cut it.
  const std::vector<Counts> counts = count(planes, polygons, candidates);
  // Step 4: the candidate of least cost; the first of equals.
  return *std::min_element(candidates.begin(), candidates.end(),
                           [&](std::size_t i, std::size_t j) {
                             return cost(counts[i], polygons.size(), options) <
                                    cost(counts[j], polygons.size(), options);
                           });
}

}  // namespace halfspace::ref
