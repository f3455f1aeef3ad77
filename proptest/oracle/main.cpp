#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "question.hpp"

/// Asks the oracle many questions, and compares the libraries' answers:
///
///   oracle_agree ORACLE CASES [SEED]
///
/// ORACLE is a command for the shell, the program of spec/oracle.
/// One case in twenty or more is geometry, the others are merges. Exit status
/// 0: all agree.
int main(int argc, char** argv) {
  using namespace halfspace;
  if (argc < 3 || argc > 4) {
    std::fprintf(stderr, "oracle_agree ORACLE CASES [SEED]\n");
    return 2;
  }
  const std::uint64_t cases = std::strtoull(argv[2], nullptr, 10);
  const std::uint64_t seed = argc > 3 ? std::strtoull(argv[3], nullptr, 10) : 1;
  constexpr std::uint64_t kBatch = 50000;
  oracle::Inquiry inquiry(argv[1]);
  oracle::ask_table(inquiry);
  oracle::ask_classes(inquiry);
  if (!inquiry.settle()) return 1;
  std::uint64_t geometry = 0;
  for (std::uint64_t batch = 0; inquiry.asked() < cases; ++batch) {
    const std::uint64_t most =
        std::min<std::uint64_t>(kBatch, cases - inquiry.asked());
    geometry +=
        oracle::ask_geometry(inquiry, seed * 1000003 + batch, most / 20);
    oracle::ask_merges(inquiry, seed * 1000033 + batch, most - most / 20);
    if (!inquiry.settle()) return 1;
  }
  std::printf("%llu cases agree, %llu of them splits and orders\n",
              static_cast<unsigned long long>(inquiry.asked()),
              static_cast<unsigned long long>(geometry));
  return 0;
}
