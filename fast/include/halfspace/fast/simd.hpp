#pragma once

#include <cstdint>

namespace halfspace::fast {

/// The instruction set that the innermost loops are compiled for. All of them
/// give the same bytes.
enum class SimdLevel : std::uint8_t {
  kPortable,  ///< any processor of the target
  kAvx2,      ///< AVX2, BMI1 and POPCNT
  kAvx512,    ///< AVX-512 F, BW, DQ, VL and VBMI, and BMI2
  kBest       ///< the highest that this processor has
};

/// Whether this processor has the level; true for kBest.
///
/// Where a level is asked for that the processor lacks, the loops are those of
/// the highest level below it that it has.
bool is_supported(SimdLevel level);

}  // namespace halfspace::fast
