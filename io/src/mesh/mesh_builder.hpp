#pragma once

#include <array>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "base/point_table.hpp"
#include "halfspace/io/mesh.hpp"
#include "halfspace/io/stop.hpp"
#include "halfspace/result.hpp"

namespace halfspace::io {

/// More of anything than this is refused (S1.3).
constexpr std::size_t kMaxCount = std::numeric_limits<std::int32_t>::max();

/// Hashes a point of exact numbers.
struct NumbersHash {
  std::size_t operator()(const std::array<Number, 3>& point) const;
};

/// The mesh that a reader is filling. Errors, of all that it adds: kStopped.
class MeshBuilder {
 public:
  explicit MeshBuilder(Stop stop = {}) : check_(std::move(stop)) {}

  Mesh mesh;

  /// Adds a vertex. Errors: kOutOfRange, if there are too many.
  std::optional<Error> add_vertex(std::array<Number, 3> point);

  /// Adds a corner at this point to the face being built, where equal points
  /// are one vertex. Not to be mixed with add_vertex().
  std::optional<Error> add_corner_at(std::array<Number, 3> point);

  /// Adds a corner. Errors: kOutOfRange, if there are too many.
  std::optional<Error> add_corner(std::int64_t vertex);

  void end_face() {
    mesh.first_corner.push_back(
        static_cast<std::uint32_t>(mesh.corners.size()));
  }

 private:
  StopCheck check_;
  PointTable<std::array<Number, 3>, NumbersHash> table_;
};

/// The colour of three values of this range, each rounded to 8 bits.
/// Errors: kOutOfRange.
Result<Rgb> color_of(const std::array<Number, 3>& values, int range);

}  // namespace halfspace::io
