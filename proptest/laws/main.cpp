#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <string>

#include "laws/law.hpp"

namespace {

/// Adds to the file HALFSPACE_LAW_REPORT, if there is one, a line for every
/// test that has run: its name, on how many cases, and whether it passed.
class Report : public ::testing::EmptyTestEventListener {
  void OnTestStart(const ::testing::TestInfo&) override {
    halfspace::law::take_case_count();
  }
  void OnTestEnd(const ::testing::TestInfo& info) override {
    const char* path = std::getenv("HALFSPACE_LAW_REPORT");
    if (path == nullptr) return;
    // A law that tries all there is in one loop has run once.
    const std::uint64_t cases =
        std::max<std::uint64_t>(1, halfspace::law::take_case_count());
    const testing::TestResult& result = *info.result();
    const char* how = result.Skipped()  ? " skipped\n"
                      : result.Passed() ? " passed\n"
                                        : " failed\n";
    // One write, so that tests that run side by side do not mix lines.
    const std::string line = std::string(info.test_suite_name()) + "." +
                             info.name() + " " + std::to_string(cases) + how;
    std::ofstream(path, std::ios::app | std::ios::binary) << line;
  }
};

}  // namespace

/// Runs the laws with a fixed seed, unless RC_PARAMS names one, and says which.
int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  const char* given = std::getenv("RC_PARAMS");
  std::string params = given == nullptr ? "" : given;
  if (params.find("seed=") == std::string::npos)
    params += std::string(params.empty() ? "" : " ") + "seed=19911983";
  setenv("RC_PARAMS", params.c_str(), 1);
  std::cout << "RC_PARAMS=\"" << params << "\"" << std::endl;
  // The listeners take it.
  ::testing::UnitTest::GetInstance()->listeners().Append(new Report);
  return RUN_ALL_TESTS();
}
