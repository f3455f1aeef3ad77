#include "scene/grid.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>

#include "halfspace/assert.hpp"

namespace halfspace::io {
namespace {

/// 5^0 to 5^27, the powers of 5 in 63 bits.
constexpr auto kPowersOfFive = [] {
  std::array<std::int64_t, 28> powers{};
  powers[0] = 1;
  for (std::size_t i = 1; i < powers.size(); ++i) {
    powers[i] = 5 * powers[i - 1];
  }
  return powers;
}();

/// 5^27 is below 2^63, so |value| below this divided by it stays in 63 bits.
constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();

Integer power_of_five(std::int32_t exponent) {
  if (exponent < static_cast<std::int32_t>(kPowersOfFive.size())) {
    return kPowersOfFive[static_cast<std::size_t>(exponent)];
  }
  return pow(Integer(5), static_cast<unsigned>(exponent));
}

/// The number in units: mantissa * 2^two * 5^five of them.
struct Exponents {
  std::int32_t two;
  std::int32_t five;
};
Exponents in_units(const Number& number, const Unit& unit) {
  return {number.two - unit.exponent,
          number.five - (unit.base == 10 ? unit.exponent : 0)};
}

/// The integer, if its size is less than 2^63; without a detour by others.
std::optional<std::int64_t> short_integer(const Integer& integer) {
  const auto& limbs = integer.backend();
  constexpr std::size_t kLimbBits = 8 * sizeof(*limbs.limbs());
  if (kLimbBits * limbs.size() > 64) return std::nullopt;
  std::uint64_t size = 0;
  for (std::size_t i = 0; i < limbs.size(); ++i)
    size |= std::uint64_t{limbs.limbs()[i]} << (kLimbBits * i);
  if (size > std::uint64_t{kMost}) return std::nullopt;
  const auto value = static_cast<std::int64_t>(size);
  return limbs.sign() ? -value : value;
}

/// The number in units, if that is an integer of less than 63 bits.
std::optional<std::int64_t> exact_steps(const Number& number,
                                        const Unit& unit) {
  const auto mantissa = short_integer(number.mantissa);
  if (mantissa == 0) return 0;
  const auto [two, five] = in_units(number, unit);
  if (two < 0 || five < 0 || two > 62 || five > 27) return std::nullopt;
  if (!mantissa) return std::nullopt;
  const std::int64_t power = kPowersOfFive[static_cast<std::size_t>(five)];
  std::int64_t steps = 0;
  if (__builtin_mul_overflow(*mantissa, power, &steps)) return std::nullopt;
  const std::int64_t limit = kMost >> two;
  if (steps > limit || steps < -limit) return std::nullopt;
  return steps * (std::int64_t{1} << two);
}

/// The greatest k with 2^k <= |number|, which is not zero.
std::int64_t floor_log2(const Number& number) {
  if (const auto mantissa = short_integer(number.mantissa);
      mantissa && number.five == 0) {
    const auto size =
        static_cast<std::uint64_t>(*mantissa < 0 ? -*mantissa : *mantissa);
    return static_cast<std::int64_t>(std::bit_width(size)) - 1 + number.two;
  }
  Integer size = abs(number.mantissa);
  if (number.five >= 0) {
    size *= power_of_five(number.five);
    return static_cast<std::int64_t>(msb(size)) + number.two;
  }
  Integer divisor = power_of_five(-number.five);
  auto log = static_cast<std::int64_t>(msb(size)) -
             static_cast<std::int64_t>(msb(divisor));
  if (log >= 0) {
    divisor <<= log;
  } else {
    size <<= -log;
  }
  if (size < divisor) --log;
  return log + number.two;
}

/// What the choice depends on: the numbers in use that are not zero.
class Chooser {
 public:
  Chooser(const Mesh& mesh, const std::vector<bool>& used,
          const ImportOptions& options)
      : mesh_(mesh), used_(used), options_(options) {}

  std::optional<GridChoice> exact() const;
  Result<GridChoice> rounded() const;

 private:
  /// A unit, and the bits that the greatest coordinate needs on its grid.
  struct Candidate {
    Unit unit;
    int bits;
  };

  template <class Deed>
  void for_each(Deed&& deed) const {
    for (std::size_t v = 0; v < mesh_.vertices.size(); ++v) {
      if (!used_[v]) continue;
      for (const Number& number : mesh_.vertices[v]) {
        if (number.mantissa != 0) deed(number);
      }
    }
  }
  std::optional<std::int32_t> coarsest(int base) const;
  int bits_needed(const Unit& unit) const;
  void add_candidates(int base, std::vector<Candidate>& candidates) const;
  GridChoice refined(const Candidate& candidate, int bits) const;

  const Mesh& mesh_;
  const std::vector<bool>& used_;
  const ImportOptions& options_;
};

/// The greatest exponent with which all numbers are multiples of the base's
/// power; nothing if there is none.
std::optional<std::int32_t> Chooser::coarsest(int base) const {
  std::int32_t two = std::numeric_limits<std::int32_t>::max();
  std::int32_t five = two;
  for_each([&](const Number& number) {
    two = std::min(two, number.two);
    five = std::min(five, number.five);
  });
  if (two == std::numeric_limits<std::int32_t>::max()) return 0;
  // Units go up to the base's power of 4096.
  constexpr std::int32_t kGreatest = 4096;
  if (base == 10) return std::min({two, five, kGreatest});
  if (five < 0) return std::nullopt;
  return std::min(two, kGreatest);
}

/// The bits of the greatest coordinate in the unit; 64 if it has that or more.
int Chooser::bits_needed(const Unit& unit) const {
  int bits = 1;
  for_each([&](const Number& number) {
    if (bits == 64) return;
    const std::optional<std::int64_t> steps = exact_steps(number, unit);
    while (bits < 64 && (!steps || !fits(*steps, bits))) ++bits;
  });
  return bits;
}

void Chooser::add_candidates(int base,
                             std::vector<Candidate>& candidates) const {
  const std::optional<std::int32_t> coarsest_exponent = coarsest(base);
  if (!coarsest_exponent) return;
  const Unit plain{base, std::min(*coarsest_exponent, 0)};
  candidates.push_back({plain, bits_needed(plain)});
  if (*coarsest_exponent == plain.exponent) return;
  const Unit large{base, *coarsest_exponent};
  candidates.push_back({large, bits_needed(large)});
}

/// The candidate's unit, divided as options_.refine_bits asks.
GridChoice Chooser::refined(const Candidate& candidate, int bits) const {
  GridChoice choice{candidate.unit, bits};
  // A base's power more needs at most 4 bits more (10 < 2^4), or 1.
  const int step = choice.unit.base == 10 ? 4 : 1;
  const int limit = std::min(options_.refine_bits, bits);
  for (int have = candidate.bits;
       have + step <= limit && choice.unit.exponent > -4096; have += step) {
    --choice.unit.exponent;
  }
  return choice;
}

std::optional<GridChoice> Chooser::exact() const {
  std::vector<Candidate> candidates;
  add_candidates(mesh_.decimal ? 10 : 2, candidates);
  // Of floats with digits after the point, 10^-k is no shorter than 2^-k, which
  // goes first.
  const bool are_floats = !mesh_.decimal && !candidates.empty() &&
                          candidates.front().unit.exponent < 0;
  if (!are_floats) add_candidates(mesh_.decimal ? 2 : 10, candidates);
  for (const int bits : kGridBits) {
    if (options_.grid_bits && *options_.grid_bits != bits) continue;
    for (const Candidate& candidate : candidates) {
      if (candidate.bits <= bits) return refined(candidate, bits);
    }
  }
  return std::nullopt;
}

Result<GridChoice> Chooser::rounded() const {
  std::int64_t log = std::numeric_limits<std::int64_t>::min();
  for_each(
      [&](const Number& number) { log = std::max(log, floor_log2(number)); });
  GridChoice choice;
  choice.bits = options_.grid_bits.value_or(54);
  // |c| < 2^(log + 1), so c has at most `bits` bits in this unit ...
  std::int64_t exponent = log + 2 - choice.bits;
  choice.unit = {2, static_cast<std::int32_t>(exponent)};
  // ... unless rounding takes it to the power of two itself.
  bool all_fit = true;
  for_each([&](const Number& number) {
    all_fit = all_fit && fits(to_grid(number, choice.unit).steps, choice.bits);
  });
  if (!all_fit) ++exponent;
  choice.unit.exponent = static_cast<std::int32_t>(exponent);
  if (exponent < -4096 || exponent > 4096) {
    return Error{ErrorCode::kOutOfRange,
                 "the coordinates need a unit of 2^" +
                     std::to_string(exponent) +
                     ", but units go from 2^-4096 to 2^4096"};
  }
  return choice;
}

}  // namespace

Result<GridChoice> choose_grid(const Mesh& mesh, const std::vector<bool>& used,
                               const ImportOptions& options) {
  if (options.grid_bits &&
      std::count(std::begin(kGridBits), std::end(kGridBits),
                 *options.grid_bits) == 0) {
    return Error{ErrorCode::kOutOfRange,
                 "a grid has 26, 40 or 54 bits, not " +
                     std::to_string(*options.grid_bits)};
  }
  const Chooser chooser(mesh, used, options);
  if (const auto choice = chooser.exact()) return *choice;
  return chooser.rounded();
}

GridCoordinate to_grid(const Number& number, const Unit& unit) {
  if (const auto steps = exact_steps(number, unit)) return {*steps, false, 0};
  const auto [two, five] = in_units(number, unit);
  Integer numerator = abs(number.mantissa);
  Integer denominator = 1;
  numerator <<= std::max(two, 0);
  numerator *= power_of_five(std::max(five, 0));
  denominator <<= std::max(-two, 0);
  denominator *= power_of_five(std::max(-five, 0));
  const Integer steps = (2 * numerator + denominator) / (2 * denominator);
  HALFSPACE_ASSERT(steps <= kMost);
  const Integer move = abs(Integer(numerator - steps * denominator));
  GridCoordinate coordinate;
  coordinate.steps = static_cast<std::int64_t>(steps);
  if (number.mantissa < 0) coordinate.steps = -coordinate.steps;
  coordinate.moved = move != 0;
  // The denominator is 2^max(-two, 0) * 5^max(-five, 0) units.
  const std::int32_t fives = unit.base == 10 ? unit.exponent : 0;
  coordinate.move = to_double(
      {move, std::min(two, 0) + unit.exponent, std::min(five, 0) + fives});
  return coordinate;
}

}  // namespace halfspace::io
