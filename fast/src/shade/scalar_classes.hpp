#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "exact/big_rational.hpp"
#include "halfspace/scalars.hpp"
#include "shade/exact_double.hpp"

namespace halfspace::fast {

/// The classes of a scale (S11.3) as runs of the numbers' line: between two
/// neighbouring bounds lies one class. Below the first and above the last is
/// what is outside of the scale's limits, whether or not it has any.
class ScalarClasses {
 public:
  explicit ScalarClasses(const ColorScale& scale)
      : steps_(scale.steps), limits_(scale.limits) {}

  /// The class of a number in doubles; if one that is off by at most `doubt`
  /// may be in another, -1.
  std::int32_t of(double value, double doubt = 0) const {
    std::int32_t inside = 1;
    if (limits_) {
      // A bound that is not passed for sure is one in doubt, but for exact
      // numbers: those are in the scale if they are limits.
      if (std::abs(value - limits_->low) <= doubt && doubt > 0) return -1;
      if (std::abs(value - limits_->high) <= doubt && doubt > 0) return -1;
      if (value < limits_->low) return 0;
      if (value > limits_->high)
        return static_cast<std::int32_t>(steps_.size()) + 2;
    }
    std::size_t first = 0;
    std::size_t count = steps_.size();
    while (count > 0) {
      const std::size_t half = count / 2;
      const bool passes = steps_[first + half] <= value;
      first = passes ? first + half + 1 : first;
      count = passes ? count - half - 1 : half;
    }
    if (doubt > 0) {
      if (first > 0 && value - steps_[first - 1] <= doubt) return -1;
      if (first < steps_.size() && steps_[first] - value <= doubt) return -1;
    }
    inside += static_cast<std::int32_t>(first);
    return inside;
  }

  /// Whether a number that is off by at most `doubt` is surely in a class.
  bool is_in(std::int32_t own, double value, double doubt) const {
    if (own < 1 || own > static_cast<std::int32_t>(steps_.size()) + 1)
      return false;
    const auto step = static_cast<std::size_t>(own - 1);
    const bool is_inside = !limits_ || (value - limits_->low > doubt &&
                                        limits_->high - value > doubt);
    return is_inside && (step == 0 || value - steps_[step - 1] > doubt) &&
           (step == steps_.size() || steps_[step] - value > doubt);
  }

  /// The class of an exact number.
  std::int32_t of(const BigRational& value) const {
    if (limits_ && value < exact_double(limits_->low)) return 0;
    if (limits_ && value > exact_double(limits_->high))
      return static_cast<std::int32_t>(steps_.size()) + 2;
    std::size_t first = 0;
    std::size_t count = steps_.size();
    while (count > 0) {
      const std::size_t half = count / 2;
      const bool passes = exact_double(steps_[first + half]) <= value;
      first = passes ? first + half + 1 : first;
      count = passes ? count - half - 1 : half;
    }
    return static_cast<std::int32_t>(first) + 1;
  }

  std::int32_t no_data() const {
    return static_cast<std::int32_t>(steps_.size()) + 3;
  }

 private:
  const std::vector<double>& steps_;
  const std::optional<ScaleLimits>& limits_;
};

}  // namespace halfspace::fast
