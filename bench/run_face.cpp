#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <memory_resource>
#include <string>

#include "booleans/contestant.hpp"
#include "booleans/face.hpp"
#include "halfspace/fast/huge_page_pool.hpp"
#include "papers/table.hpp"

/// What the library that users link costs over calls of the fast one, and what
/// properties cost. Both sides of a ratio run in turn, many times, and the
/// least times of each are compared: other work of the machine only adds.
namespace halfspace::bench {
namespace {

struct Sides {
  double direct = 0;
  double other = 0;
  void take(double direct_ms, double other_ms) {
    const auto least = [](double a, double b) {
      return a == 0 ? b : std::min(a, b);
    };
    direct = least(direct, direct_ms);
    other = least(other, other_ms);
  }
  std::vector<std::string> row(const std::string& name) const {
    return {name, digits(direct), digits(other), digits(other / direct, 4)};
  }
};

/// The pairs and the folds of run_booleans, but those of a million triangles.
std::vector<BooleanCase> compared_cases() {
  std::vector<BooleanCase> cases;
  for (const int triangles : {1000, 10000, 100000}) {
    cases.push_back(two_spheres(triangles, 0));
    cases.push_back(two_spheres(triangles, 0.01));
  }
  cases.push_back(menger(3));
  cases.push_back(plate());
  cases.push_back(sphere_chain(100));
  cases.push_back(shared_face(50));
  return cases;
}

bool compare_cases(int rounds, const std::string& only, Table& table) {
  bool good = true;
  for (const BooleanCase& task : compared_cases()) {
    if (task.name.find(only) == std::string::npos) continue;
    const Contestant direct =
        task.operands.size() > 2 ? ours_at_once() : ours_in_turn();
    Sides sides;
    for (int round = 0; round < rounds; ++round) {
      const auto ours = direct.run(task);
      const auto faced = through_the_face(task);
      good = good && ours && faced && ours->triangles == faced->triangles;
      if (!good) {
        std::fprintf(stderr, "%s: not the same result\n", task.name.c_str());
        return false;
      }
      sides.take(ours->total_ms(), faced->total_ms());
    }
    table.rows.push_back(sides.row(task.name));
  }
  return good;
}

void compare_fields(int rounds, const std::string& only, Table& table) {
  for (const int triangles : {10000, 100000}) {
    const std::string name =
        "5 fields, spheres of " + std::to_string(triangles / 1000) + " k";
    if (name.find(only) == std::string::npos) continue;
    Sides all, parts;
    for (int round = 0; round < rounds; ++round) {
      const FieldTimes without = time_with_fields(triangles, 0);
      const FieldTimes with = time_with_fields(triangles, 5);
      all.take(without.all_ms, with.all_ms);
      parts.take(without.boolean_and_mesh_ms, with.boolean_and_mesh_ms);
    }
    table.rows.push_back(all.row(name));
    table.rows.push_back(parts.row(name + ", boolean and mesh"));
  }
}

int run(int count, char** arguments) {
  const int rounds = count > 1 ? std::atoi(arguments[1]) : 9;
  const std::string only = count > 2 ? arguments[2] : "";
  if (rounds < 1 || count > 3) {
    std::fprintf(stderr, "usage: run_face [ROUNDS [PART-OF-A-NAME]]\n");
    return 2;
  }
  Table table{{"case", "without", "with", "ratio"}, {}};
  const bool good = compare_cases(rounds, only, table);
  compare_fields(rounds, only, table);
  std::printf(
      "Processor time in ms, one thread, least of %d runs: without and "
      "with the face; without and with fields.\n\n%s",
      rounds, to_markdown(table).c_str());
  return good && !table.rows.empty() ? 0 : 1;
}

}  // namespace
}  // namespace halfspace::bench

int main(int count, char** arguments) {
  // As the command line program does.
  static auto* const pool = new halfspace::fast::HugePagePool;
  std::pmr::set_default_resource(pool);
  return halfspace::bench::run(count, arguments);
}
