#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <mutex>
#include <optional>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "adapters/screen_line.hpp"
#include "merge_lines.hpp"

namespace halfspace::exhaustive {
namespace {

using Clock = std::chrono::steady_clock;

/// The sets of object pixels are divided into so many blocks.
constexpr std::uint32_t kBlocks = 1024;

struct Arguments {
  int pixels = 16;
  unsigned jobs = 1;
  std::uint32_t shard = 0;
  std::uint32_t shards = 1;
  std::string state = "exhaustive_merge.state";
  double seconds = 0;  ///< 0: until all is done
  std::vector<fast::SimdLevel> levels;
  std::uint64_t merges = 0;  ///< so many random ones instead
  std::uint64_t seed = 1;
};

constexpr const char* kUsage =
    "Usage: exhaustive_merge [--simd LEVEL] [--jobs N] [--pixels N]\n"
    "                        [--shard I/N] [--seconds S] [--state FILE]\n"
    "       exhaustive_merge [--simd LEVEL] [--jobs N] --merges N [--seed S]\n"
    "\n"
    "Merges every set of object pixels into every set of unlit pixels of a\n"
    "line of N pixels (16), by the reference, the fast library's screen and\n"
    "sets of bits, and compares segments and cases. What is done is kept in\n"
    "FILE: the same line goes on where it was stopped. Shard I of N, from 0,\n"
    "does every N-th block; the files of all shards, one after the other, are\n"
    "the state of the whole.\n"
    "With --merges, so many merges of lines of 64 pixels, drawn from the "
    "seed,\n"
    "by the screen and by sets of bits.\n"
    "LEVEL is portable, avx2 or avx512, the instruction set of the screen's\n"
    "loops; without it all are taken that this machine has.\n"
    "Exit status: 0 all done and no mismatch, 1 a mismatch, 2 bad usage, or a\n"
    "level that this machine lacks, 3 no mismatch, but not all done yet.\n";

/// The level that is named, or all that this machine has, if it has them.
std::vector<fast::SimdLevel> levels_named(const std::string& name) {
  constexpr std::array kNames = {"portable", "avx2", "avx512"};
  std::vector<fast::SimdLevel> levels;
  for (std::size_t k = 0; k < kNames.size(); ++k) {
    if ((name.empty() || name == kNames[k]) &&
        fast::is_supported(kSimdLevels[k])) {
      levels.push_back(kSimdLevels[k]);
    }
  }
  return levels;
}

std::optional<Arguments> parse(int count, char** words) {
  Arguments arguments;
  arguments.levels = levels_named("");
  for (int k = 1; k < count; ++k) {
    const std::string word = words[k];
    if (k + 1 == count) return std::nullopt;
    const std::string value = words[++k];
    if (word == "--pixels") {
      arguments.pixels = std::atoi(value.c_str());
    } else if (word == "--jobs") {
      arguments.jobs = static_cast<unsigned>(std::atoi(value.c_str()));
    } else if (word == "--seconds") {
      arguments.seconds = std::atof(value.c_str());
    } else if (word == "--simd") {
      arguments.levels = levels_named(value);
    } else if (word == "--merges") {
      arguments.merges = std::strtoull(value.c_str(), nullptr, 10);
    } else if (word == "--seed") {
      arguments.seed = std::strtoull(value.c_str(), nullptr, 10);
    } else if (word == "--state") {
      arguments.state = value;
    } else if (word != "--shard" ||
               std::sscanf(value.c_str(), "%u/%u", &arguments.shard,
                           &arguments.shards) != 2) {
      return std::nullopt;
    }
  }
  const bool fits = arguments.pixels >= 10 && arguments.pixels <= 16 &&
                    arguments.jobs >= 1 && arguments.jobs <= 1024 &&
                    arguments.shard < arguments.shards &&
                    !arguments.levels.empty();
  return fits ? std::optional(arguments) : std::nullopt;
}

/// One block's tally as a line of the state, and back. A line that was not
/// written to its end has no " ." there, and counts for nothing.
std::string line_of(int pixels, std::uint32_t block, const MergeTally& tally) {
  std::ostringstream line;
  line << pixels << ' ' << block << ' ' << tally.pairs << ' ' << tally.steps;
  for (int k = 1; k <= 8; ++k) line << ' ' << tally.steps_of_case[k];
  line << ' ' << tally.mismatches << " .";
  return line.str();
}

using State = std::map<std::uint32_t, MergeTally>;

State read_state(const Arguments& arguments) {
  State state;
  std::ifstream in(arguments.state);
  for (std::string text; std::getline(in, text);) {
    std::istringstream line(text);
    int pixels = 0;
    std::uint32_t block = 0;
    MergeTally tally;
    std::string end;
    line >> pixels >> block >> tally.pairs >> tally.steps;
    for (int k = 1; k <= 8; ++k) line >> tally.steps_of_case[k];
    line >> tally.mismatches >> end;
    if (line && end == "." && pixels == arguments.pixels) state[block] = tally;
  }
  return state;
}

class Campaign {
 public:
  explicit Campaign(const Arguments& arguments)
      : arguments_(arguments), done_(read_state(arguments)) {
    for (const auto& [block, tally] : done_) total_.add(tally);
    for (std::uint32_t b = 0; b < kBlocks; ++b) {
      if (b % arguments.shards == arguments.shard && !done_.contains(b))
        waiting_.push_back(b);
    }
    resumed_ = total_.pairs;
    // A line may have been cut off: what is appended begins a new one.
    out_.open(arguments.state, std::ios::app);
    out_ << '\n' << std::flush;
  }

  int run() {
    std::vector<std::thread> threads;
    for (unsigned k = 0; k < arguments_.jobs; ++k)
      threads.emplace_back([this] { work(); });
    for (std::thread& thread : threads) thread.join();
    if (is_terminal_) std::printf("\r");
    report();
    std::printf("\n");
    for (int k = 1; k <= 8; ++k) {
      std::printf("case %d: %llu steps, %.2f %%\n", k, count_of(k),
                  100 * static_cast<double>(count_of(k)) /
                      static_cast<double>(total_.steps));
    }
    if (!total_.first_mismatch.empty())
      std::printf("first mismatch: %s\n", total_.first_mismatch.c_str());
    if (!out_) std::printf("the state could not be written\n");
    if (total_.mismatches > 0) return 1;
    return next_ >= waiting_.size() && out_ ? 0 : 3;
  }

 private:
  unsigned long long count_of(int merge_case) const {
    return total_.steps_of_case[merge_case];
  }

  double seconds() const {
    return std::chrono::duration<double>(Clock::now() - begin_).count();
  }

  void work() {
    const std::uint32_t block_size = (1u << arguments_.pixels) / kBlocks;
    while (arguments_.seconds == 0 || seconds() < arguments_.seconds) {
      const std::size_t at = next_++;
      if (at >= waiting_.size()) return;
      const std::uint32_t first = waiting_[at] * block_size;
      const MergeTally tally = merge_lines(
          arguments_.pixels, first, first + block_size, arguments_.levels);
      const std::scoped_lock lock(mutex_);
      total_.add(tally);
      out_ << line_of(arguments_.pixels, waiting_[at], tally) << std::endl;
      // At most ten times a second, and only for someone who watches.
      if (!is_terminal_ || seconds() < next_report_) continue;
      next_report_ = seconds() + 0.1;
      std::printf("\r");
      report();
    }
  }

  void report() const {
    const double fresh = static_cast<double>(total_.pairs - resumed_);
    const double all =
        static_cast<double>(std::uint64_t{1} << (2 * arguments_.pixels));
    std::printf(
        "%llu pairs, %.1f %% of all; %.2f million a second; "
        "%llu mismatches ",
        static_cast<unsigned long long>(total_.pairs),
        100 * static_cast<double>(total_.pairs) / all, fresh / seconds() / 1e6,
        static_cast<unsigned long long>(total_.mismatches));
    std::fflush(stdout);
  }

  Arguments arguments_;
  State done_;
  std::vector<std::uint32_t> waiting_;
  std::atomic<std::size_t> next_ = 0;
  std::mutex mutex_;
  MergeTally total_;
  std::uint64_t resumed_ = 0;
  std::ofstream out_;
  const bool is_terminal_ = isatty(STDOUT_FILENO) != 0;
  double next_report_ = 0;
  Clock::time_point begin_ = Clock::now();
};

/// Random merges by every level, in as many threads as are asked for, each with
/// a seed of its own.
int run_random(const Arguments& arguments) {
  std::uint64_t mismatches = 0;
  for (const fast::SimdLevel level : arguments.levels) {
    const Clock::time_point begin = Clock::now();
    std::vector<MergeTally> tallies(arguments.jobs);
    std::vector<std::thread> threads;
    for (unsigned k = 0; k < arguments.jobs; ++k) {
      threads.emplace_back([&, k] {
        tallies[k] = merge_random(arguments.merges / arguments.jobs + 1,
                                  arguments.seed * arguments.jobs + k, level);
      });
    }
    MergeTally all;
    for (unsigned k = 0; k < arguments.jobs; ++k) {
      threads[k].join();
      all.add(tallies[k]);
    }
    const double seconds =
        std::chrono::duration<double>(Clock::now() - begin).count();
    std::printf("%s: %llu merges, %.2f million a second; %llu mismatches\n",
                level_name(level), static_cast<unsigned long long>(all.pairs),
                static_cast<double>(all.pairs) / seconds / 1e6,
                static_cast<unsigned long long>(all.mismatches));
    if (all.mismatches > 0)
      std::printf("first mismatch: %s\n", all.first_mismatch.c_str());
    mismatches += all.mismatches;
  }
  return mismatches == 0 ? 0 : 1;
}

}  // namespace
}  // namespace halfspace::exhaustive

int main(int count, char** words) {
  const auto arguments = halfspace::exhaustive::parse(count, words);
  if (!arguments) {
    std::fputs(halfspace::exhaustive::kUsage, stderr);
    return 2;
  }
  if (arguments->merges > 0)
    return halfspace::exhaustive::run_random(*arguments);
  return halfspace::exhaustive::Campaign(*arguments).run();
}
