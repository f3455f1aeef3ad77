#pragma once

#include <array>
#include <cstdint>

#include "halfspace/camera.hpp"
#include "halfspace/polygon.hpp"
#include "halfspace/result.hpp"

namespace halfspace {

/// Which parameters belong to a ray (S8.1).
enum class Reach : std::uint8_t {
  kRay,      ///< t >= 0
  kSegment,  ///< 0 <= t <= 1
  kBetween,  ///< 0 < t < 1
  kLine,     ///< any t
};

/// The data of a ray, not yet checked: the points origin + t direction (S8.1).
struct RayData {
  LatticeVector origin;
  LatticeVector direction;
  Reach reach = Reach::kRay;
  friend bool operator==(const RayData&, const RayData&) = default;
};

/// A valid ray for scenes of one grid (S8.1): only make_ray() makes one.
class Ray {
 public:
  const RayData& data() const { return data_; }
  const RayData* operator->() const { return &data_; }
  friend bool operator==(const Ray&, const Ray&) = default;

 private:
  friend Result<Ray> make_ray(const RayData& data, int grid_bits);
  RayData data_;
};

/// The ray that `data` describes, if it is valid for scenes of `grid_bits`.
///
/// Errors: kOutOfRange (a component beyond 2^(grid_bits + 13) in size);
///         kBadRay (the direction is zero).
Result<Ray> make_ray(const RayData& data, int grid_bits);

/// An integer of 256 bits in two's complement, least word first.
using RayInteger = std::array<std::uint64_t, 4>;

/// What a ray hits: the polygon, and the ray parameter as a fraction that need
/// not be in lowest terms (S8.2).
struct RayHit {
  PolygonId polygon = 0;
  RayInteger numerator{};
  RayInteger denominator{};  ///< positive
};

}  // namespace halfspace
