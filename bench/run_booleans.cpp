#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "booleans/contestant.hpp"
#include "papers/table.hpp"

namespace halfspace::bench {
namespace {

/// What the command line asks for.
struct Request {
  std::vector<std::string> only;
  Repeats repeats{.most = 5, .budget_ms = 3000};
};

std::vector<Contestant> contestants() {
  std::vector<Contestant> all{ours_in_turn(), ours_at_once()};
#ifdef HALFSPACE_BENCH_CGAL
  all.push_back(cgal());
#endif
  return all;
}

/// A solid's surface must be closed, as small as is known, and all must agree
/// on the volume but for what doubles round.
bool is_right(const BooleanCase& task, const Contestant& contestant,
              const Outcome& outcome, double volume6) {
  const bool ours = contestant.name.rfind("Halfspace", 0) == 0;
  const bool least =
      !ours || task.least == 0 || outcome.triangles == task.least;
  const bool good = outcome.closed && least &&
                    std::abs(outcome.volume6 - volume6) <= 1e-9 * volume6;
  if (!good) {
    std::fprintf(stderr,
                 "run_booleans: %s: %s is wrong: %zu triangles, %s, "
                 "volume %.17g and not %.17g\n",
                 task.name.c_str(), contestant.name.c_str(), outcome.triangles,
                 outcome.closed ? "closed" : "open", outcome.volume6 / 6,
                 volume6 / 6);
  }
  return good;
}

int run(const Request& request) {
  Table table{{"case", "who", "import", "booleans", "output", "all",
               "times ours", "triangles"},
              {}};
  bool good = true;
  for (const BooleanCase& task : boolean_cases()) {
    bool wanted = request.only.empty();
    for (const std::string& part : request.only)
      wanted = wanted || task.name.find(part) != std::string::npos;
    if (!wanted) continue;
    std::optional<Outcome> first;
    for (const Contestant& contestant : contestants()) {
      const bool is_peer = contestant.name.rfind("Halfspace", 0) != 0;
      if (is_peer && !task.for_peers) continue;
      // Two operands are at once whatever the order.
      if (first && task.operands.size() == 2 &&
          contestant.name == ours_at_once().name)
        continue;
      std::fprintf(stderr, "%s: %s ...\n", task.name.c_str(),
                   contestant.name.c_str());
      const auto outcome = best_of(contestant, task, request.repeats);
      if (!outcome) {
        table.rows.push_back(
            {task.name, contestant.name, "-", "-", "-", "-", "refused", "-"});
        continue;
      }
      if (!first) first = outcome;
      good = is_right(task, contestant, *outcome, first->volume6) && good;
      table.rows.push_back(
          {task.name, contestant.name, digits(outcome->import_ms),
           digits(outcome->boolean_ms), digits(outcome->output_ms),
           digits(outcome->total_ms()),
           digits(outcome->total_ms() / first->total_ms()),
           std::to_string(outcome->triangles)});
    }
  }
  std::printf("Processor time in ms, one thread, least of up to %d runs.\n\n%s",
              request.repeats.most, to_markdown(table).c_str());
  return good ? 0 : 1;
}

}  // namespace
}  // namespace halfspace::bench

int main(int count, char** arguments) {
  halfspace::bench::Request request;
  CLI::App app{"Measures booleans of solids, and of those who do them too."};
  app.add_option("--only", request.only, "Cases whose names hold this");
  app.add_option("--repeats", request.repeats.most, "Runs at most")
      ->check(CLI::Range(1, 1000));
  app.add_option("--budget-ms", request.repeats.budget_ms,
                 "No further run when this is spent");
  CLI11_PARSE(app, count, arguments);
  return halfspace::bench::run(request);
}
