#include <gtest/gtest.h>

#include <map>
#include <string>

#include "generate/generate.hpp"
#include "generate/troubles.hpp"
#include "halfspace/fast/build.hpp"
#include "halfspace/fast/render.hpp"
#include "halfspace/ref/screen.hpp"
#include "laws/law.hpp"

/// What the generators make is what the laws are tried on: how much of which
/// trouble is asserted here.
namespace halfspace {
namespace {

/// Counts the steps of a line's merge by case.
void count_steps(const generate::Line& line,
                 std::map<MergeCase, std::size_t>& steps) {
  const auto objects = generate::spans_of(line.objects);
  const auto unlit = generate::spans_of(line.unlit);
  ref::UnlitList list(unlit.begin(), unlit.end());
  auto object = objects.begin();
  auto k = list.begin();
  while (object != objects.end() && k != list.end()) {
    ++steps[ref::merge_case(*object, *k)];
    ref::merge_segment(object, list, k, [](Span) {});
  }
}

TEST(Distribution, EveryMergeCaseIsATwentiethOfTheStepsOfEveryGenerator) {
  const std::pair<const char*, rc::Gen<generate::Line>> generators[] = {
      {"dense_lines", generate::dense_lines()},
      {"lines_of_runs", generate::lines_of_runs()},
      {"lines_with_common_ends", generate::lines_with_common_ends()},
      {"lines", generate::lines()}};
  for (const auto& [name, lines] : generators) {
    std::map<MergeCase, std::size_t> steps;
    law::check(2000, [&] { count_steps(*lines, steps); });
    std::size_t all = 0;
    for (const auto& [merge_case, count] : steps) all += count;
    for (int k = 1; k <= 8; ++k) {
      const std::size_t count = steps[static_cast<MergeCase>(k)];
      EXPECT_GE(20 * count, all)
          << name << ", case " << k << ": " << count << " of " << all;
      law::note(std::string(name) + ", case " + std::to_string(k), count);
    }
  }
}

TEST(Distribution, EveryTroubleComesUpAsOftenAsIsSaid) {
  std::map<std::string, std::size_t> counts;
  const auto troubles = generate::all_troubles();
  law::check(1200, [&] {
    const SceneFile view = *generate::views();
    for (const auto& trouble : generate::troubles_in(view, troubles))
      ++counts[trouble];
  });
  for (const auto& trouble : troubles) {
    const auto rare = generate::rare_troubles().find(trouble);
    const std::size_t least =
        rare == generate::rare_troubles().end() ? 40 : rare->second;
    EXPECT_GE(counts[trouble], least) << trouble;
    RecordProperty(trouble, std::to_string(counts[trouble]));
  }
}

TEST(Distribution, EveryWayToDecideComesUp) {
  fast::FilterStats building, seeing;
  law::check(1000, [&] {
    const SceneFile view = *generate::views();
    const auto tree = fast::build(view.scene, {}, building);
    seeing.add(
        fast::render(view.scene, tree, *view.camera, view.options).decisions);
  });
  for (const fast::FilterStats& stats : {building, seeing}) {
    EXPECT_GE(stats.filtered, 3000u);
    EXPECT_GE(stats.exact, 1000u);
    EXPECT_GE(stats.zero, 500u);
    EXPECT_GE(stats.exact - stats.zero, 100u);
  }
  RecordProperty("building", std::to_string(building.filtered) + " filtered, " +
                                 std::to_string(building.exact) + " exact, " +
                                 std::to_string(building.zero) + " zero");
  RecordProperty("seeing", std::to_string(seeing.filtered) + " filtered, " +
                               std::to_string(seeing.exact) + " exact, " +
                               std::to_string(seeing.zero) + " zero");
}

}  // namespace
}  // namespace halfspace
