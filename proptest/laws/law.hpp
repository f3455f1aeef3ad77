#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>

#include "generate/generate.hpp"

/// How laws are checked: on saved scenes, then on generated ones, with a fixed
/// seed unless RC_PARAMS gives another. The environment may ask for more:
///
///   HALFSPACE_PROPTEST_RUNS     a factor for the number of generated ones
///   HALFSPACE_COUNTEREXAMPLES   the folder for counterexamples
///   HALFSPACE_REPLAY            a scene file: the laws on that one alone
///   HALFSPACE_REPORT            a file for counts, written while tests run
namespace halfspace::law {

/// A law that does not hold.
class Broken : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Throws Broken unless the condition holds.
#define HALFSPACE_LAW(condition)                                 \
  do {                                                           \
    if (!(condition)) {                                          \
      throw ::halfspace::law::Broken(std::string(__FILE__ ":") + \
                                     std::to_string(__LINE__) +  \
                                     ": not so: " #condition);   \
    }                                                            \
  } while (false)

/// How many views a law is tried on, before HALFSPACE_PROPTEST_RUNS.
constexpr int kViews = 400;

/// `count` times the factor HALFSPACE_PROPTEST_RUNS, which long campaigns set.
int runs(int count);

/// How many cases properties have been tried on since this was last asked.
std::uint64_t take_case_count();

/// Notes that the current test met a case called `name`, for the report that
/// HALFSPACE_REPORT asks for; else nothing.
void note(const std::string& name, std::uint64_t count = 1);

/// Whether a report is asked for: then what takes time may be noted, too.
bool is_reporting();

/// The name of the current test's law, for files: "s4-l3".
std::string law_name();

/// Checks a property with RapidCheck, once for each of `count` runs, under the
/// name of the current test. It holds unless it throws Broken.
void check(int count, const std::function<void()>& property);

/// Checks a property of views: on all of regressions/*.scene, then on `count`
/// drawn from `views`. A counterexample is shrunk and saved as a scene file in
/// the folder HALFSPACE_COUNTEREXAMPLES, or else where the test runs.
void for_all(const generate::Views& views, int count,
             const std::function<void(const SceneFile&)>& property);

/// The same for generate::views(); fails where a trouble never came up.
void for_all_views(const std::function<void(const SceneFile&)>& property,
                   int count = kViews);

/// The same for pairs of solids; saved ones are in regressions/solids/.
void for_all_solids(
    const std::function<void(const generate::SolidPair&)>& property, int count);

/// The same for soups (generate::soups()); saved ones are in
/// regressions/soups/.
void for_all_soups(const std::function<void(const Scene&)>& property,
                   int count);

/// Counts the cases that a run has met, by name.
class Cases {
 public:
  explicit Cases(std::set<std::string> names) : missing_(std::move(names)) {}
  /// Meets a case. Requires: it is one of the names.
  void meet(const std::string& name) { missing_.erase(name); }
  const std::set<std::string>& missing() const { return missing_; }
  /// Fails the current test for every case that was never met.
  void expect_all() const {
    for (const std::string& name : missing_)
      ADD_FAILURE() << "the case never came up: " << name;
  }

 private:
  std::set<std::string> missing_;
};

}  // namespace halfspace::law
