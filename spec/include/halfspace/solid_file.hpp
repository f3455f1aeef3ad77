#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "halfspace/int128.hpp"
#include "halfspace/polygon.hpp"
#include "halfspace/result.hpp"
#include "halfspace/scene.hpp"

namespace halfspace {

/// The contents of a `.hsolid` file (spec/solid-format.md): a solid as planes
/// and as what meets where.
struct SolidData {
  /// normal.(p - origin) = 0. The normal's components have no common divisor,
  /// and its first one that is not zero is positive.
  struct Plane {
    std::array<Int128, 3> normal{};
    GridPoint origin;
    friend bool operator==(const Plane&, const Plane&) = default;
  };
  /// A polygon of a part: where a face came from in the first place.
  struct Origin {
    std::uint32_t part = 0;
    std::uint32_t polygon = 0;
    friend bool operator==(const Origin&, const Origin&) = default;
  };
  /// A region of a plane.
  struct Face {
    std::uint32_t plane = 0;
    bool flipped = false;  ///< outwards is against the plane's normal
    Rgb color;             ///< without meaning where it has none
    std::uint32_t origin = 0;
    std::uint32_t loop_count = 0;
    bool has_color = true;
    friend bool operator==(const Face&, const Face&) = default;
  };
  static constexpr std::uint32_t kNoPlane = 0xffffffff;
  /// The beginning of an edge, which ends at the next corner of the loop.
  struct Corner {
    std::uint32_t vertex = 0;
    /// A plane through the edge that is not the face's. kNoPlane: none is
    /// named, and both ends are grid points.
    std::uint32_t plane = kNoPlane;
    friend bool operator==(const Corner&, const Corner&) = default;
  };

  Unit unit;
  int grid_bits = 26;
  /// The writer vouches for the surface: it does not pass through itself.
  bool is_checked = false;
  /// Every vertex on an edge is an end of it, and an edge in a face is one of
  /// the face's own.
  bool is_conforming = false;
  /// Vertex `v` is `points[v]`, or where the planes `meets[v - points.size()]`
  /// meet.
  std::vector<GridPoint> points;
  std::vector<Plane> planes;
  std::vector<std::array<std::uint32_t, 3>> meets;
  std::vector<std::string> parts;  ///< their names, any bytes
  std::vector<Origin> origins;
  std::vector<Face> faces;
  std::vector<std::uint32_t> loops;  ///< corners of each, face by face
  std::vector<Corner> corners;       ///< loop by loop
  friend bool operator==(const SolidData&, const SolidData&) = default;
};

/// The two forms of a `.hsolid` file.
enum class SolidForm : std::uint8_t { kBinary, kText };

/// Whether the bytes begin like a `.hsolid` file of either form.
bool is_solid_file(std::string_view bytes);

/// Reads the bytes of a `.hsolid` file, whichever form it has.
///
/// What depends on more than indices and the planes' numbers is not looked at:
/// whether vertices lie on the planes of their faces and edges, and whether the
/// surface is closed.
///
/// Exact:  yes: every number is an integer, and round trips.
/// Errors: kUnknownFormat (another version); kTruncated, kSyntax (the checksum
///         is wrong, too), kOutOfRange, kBadIndex, kTooFewVertices,
///         kRepeatedVertex, kZeroArea (a normal of zeros, or planes that do not
///         meet in one point); with the line's number, or the byte's, as index.
/// Cost:   linear; memory at most a small multiple of the bytes.
Result<SolidData> read_solid(std::string_view bytes);

/// The bytes of a `.hsolid` file: read_solid(write_solid(d, form)) == d.
/// Requires: `data` is what read_solid() would take.
std::string write_solid(const SolidData& data, SolidForm form);

/// What is wrong with the data, by the rules of read_solid(); `index` names
/// the plane, meet, origin or corner.
Result<Done> check_solid_data(const SolidData& data);

}  // namespace halfspace
