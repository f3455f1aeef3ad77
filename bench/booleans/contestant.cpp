#include "booleans/contestant.hpp"

namespace halfspace::bench {

std::optional<Outcome> best_of(const Contestant& contestant,
                               const BooleanCase& task,
                               const Repeats& repeats) {
  std::optional<Outcome> best;
  const double start = process_ms();
  for (int i = 0; i < repeats.most; ++i) {
    const std::optional<Outcome> outcome = contestant.run(task);
    if (!outcome) return outcome;
    if (!best || outcome->total_ms() < best->total_ms()) best = outcome;
    if (process_ms() - start > repeats.budget_ms) break;
  }
  return best;
}

}  // namespace halfspace::bench
