#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <string>

namespace halfspace::law {

/// What tests count for whoever watches them: written as JSON to the file
/// HALFSPACE_REPORT, beside it first and then renamed, a few times a second
/// and when the program ends.
class Report {
 public:
  static Report& instance();
  ~Report() { write(); }

  bool is_wanted() const { return !path_.empty(); }
  void add_case() { add(cases_); }
  /// Shrinking tries many more: every one that fails counts.
  void add_failure() { add(failures_); }
  void note(const std::string& name, std::uint64_t count) {
    notes_[name] += count;
  }

 private:
  using Counts = std::map<std::string, std::uint64_t>;

  Report();
  void add(Counts& counts);
  void write() const;

  std::string path_;
  Counts cases_;     ///< by test
  Counts failures_;  ///< by test
  Counts notes_;
  std::chrono::steady_clock::time_point written_;
};

}  // namespace halfspace::law
