#include "laws/report.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace halfspace::law {
namespace {

std::string json_of(const std::map<std::string, std::uint64_t>& counts) {
  std::string text = "{";
  const char* before = "";
  for (const auto& [name, count] : counts) {
    // Names are ours: they need no escapes.
    text += before;
    text += "\"" + name + "\":" + std::to_string(count);
    before = ",";
  }
  return text + "}";
}

}  // namespace

Report& Report::instance() {
  static Report report;
  return report;
}

Report::Report() {
  const char* path = std::getenv("HALFSPACE_REPORT");
  if (path != nullptr) path_ = path;
}

void Report::add(Counts& counts) {
  const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
  ++counts[std::string(test->test_suite_name()) + "." + test->name()];
  const auto now = std::chrono::steady_clock::now();
  if (now - written_ < std::chrono::milliseconds(300)) return;
  written_ = now;
  write();
}

void Report::write() const {
  if (!is_wanted()) return;
  const std::string beside = path_ + ".new";
  std::ofstream(beside, std::ios::binary)
      << "{\"cases\":" << json_of(cases_)
      << ",\"failures\":" << json_of(failures_)
      << ",\"notes\":" << json_of(notes_) << "}\n";
  std::error_code ignored;
  std::filesystem::rename(beside, path_, ignored);
}

}  // namespace halfspace::law
