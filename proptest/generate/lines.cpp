#include <ostream>

#include "generate/generate.hpp"

namespace halfspace::generate {
namespace {

namespace gen = rc::gen;

/// 64 random bits, whatever the size; they shrink.
rc::Gen<std::uint64_t> word() {
  return gen::resize(rc::kNominalSize, gen::arbitrary<std::uint64_t>());
}

/// Runs whose lengths are the digits of `number` to base 6.
std::uint64_t runs_of(std::uint64_t number) {
  std::uint64_t mask = 0;
  int at = static_cast<int>(number & 1);
  for (number >>= 1; at < 64; number /= 6) {
    const int length = 1 + static_cast<int>(number % 6);
    mask |= ((std::uint64_t{1} << length) - 1) << at;
    at += length + 1;
  }
  return mask;
}

/// Between two bits of `ends` a pixel is as the bit of `dark` at the first.
std::uint64_t held(std::uint64_t ends, std::uint64_t dark) {
  std::uint64_t mask = 0;
  bool is_on = false;
  for (int i = 0; i < 64; ++i) {
    if ((ends >> i & 1u) != 0) is_on = (dark >> i & 1u) == 0;
    if (is_on) mask |= std::uint64_t{1} << i;
  }
  return mask;
}

}  // namespace

void showValue(const Line& line, std::ostream& out) {
  const auto show = [&out](const char* what, std::uint64_t mask) {
    out << what;
    for (const Span& span : spans_of(mask))
      out << ' ' << span.first << ".." << span.last;
  };
  show("objects", line.objects);
  show("; unlit", line.unlit);
}

std::vector<Span> spans_of(std::uint64_t mask) {
  std::vector<Span> spans;
  for (std::int32_t i = 0; i < 64; ++i) {
    if ((mask >> i & 1u) == 0) continue;
    if (!spans.empty() && spans.back().last == i - 1) {
      spans.back().last = i;
    } else {
      spans.push_back({i, i});
    }
  }
  return spans;
}

std::uint64_t mask_of(const std::vector<Span>& spans) {
  std::uint64_t mask = 0;
  for (const Span& span : spans) {
    for (std::int32_t i = span.first; i <= span.last; ++i)
      mask |= std::uint64_t{1} << i;
  }
  return mask;
}

rc::Gen<Line> dense_lines() {
  return gen::map(gen::tuple(word(), word(), word(), word()), [](auto drawn) {
    const auto [a, b, c, d] = drawn;
    return Line{a | b, c | d};
  });
}

rc::Gen<Line> lines_of_runs() {
  return gen::map(gen::pair(word(), word()), [](auto drawn) {
    return Line{runs_of(drawn.first), runs_of(drawn.second)};
  });
}

rc::Gen<Line> lines_with_common_ends() {
  return gen::map(gen::tuple(word(), word(), word(), word(), word()),
                  [](auto drawn) {
                    const auto [ends, a, b, c, d] = drawn;
                    return Line{held(ends, a & b), held(ends, c & d)};
                  });
}

rc::Gen<Line> lines() {
  return gen::oneOf(dense_lines(), lines_of_runs(), lines_with_common_ends());
}

}  // namespace halfspace::generate
