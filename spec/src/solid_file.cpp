#include "solid_file.hpp"

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <iterator>
#include <numeric>

#include "halfspace/big_integer.hpp"

namespace halfspace {
namespace {

/// Holds a determinant of three normals of 54 bits: 6n + 6 bits.
using Big = boost::multiprecision::int512_t;

Int128 divisor_of(Int128 a, Int128 b) {
  while (b != 0) {
    const Int128 rest = a % b;
    a = b;
    b = rest;
  }
  return a < 0 ? -a : a;
}

/// The checks, one kind of item after the other.
class Checker {
 public:
  explicit Checker(const SolidData& data) : data_(data) {}
  Result<Done> checked();

 private:
  bool fail(ErrorCode code, const char* item, std::size_t index,
            const std::string& what) {
    error_ = Error{code, std::string(item) + " " + std::to_string(index) + what,
                   static_cast<std::int64_t>(index)};
    return false;
  }
  bool check_header();
  bool is_in_grid(const GridPoint& p) const {
    return fits(p.x, data_.grid_bits) && fits(p.y, data_.grid_bits) &&
           fits(p.z, data_.grid_bits);
  }
  bool check_points();
  bool check_plane(std::size_t p);
  bool check_meet(std::size_t m);
  bool check_origins();
  bool check_faces();
  bool check_loop(std::size_t first, std::size_t count, std::uint32_t plane);

  const SolidData& data_;
  Error error_{};
};

bool Checker::check_header() {
  const Unit unit = data_.unit;
  if ((unit.base == 2 || unit.base == 10) && std::abs(unit.exponent) <= 4096 &&
      std::count(std::begin(kGridBits), std::end(kGridBits), data_.grid_bits) ==
          1) {
    return true;
  }
  error_ = Error{ErrorCode::kOutOfRange,
                 "the unit is no power of 2 or 10 up to 4096, or the grid has "
                 "other than 26, 40 or 54 bits"};
  return false;
}

bool Checker::check_points() {
  for (std::size_t i = 0; i < data_.points.size(); ++i) {
    if (!is_in_grid(data_.points[i]))
      return fail(ErrorCode::kOutOfRange, "point", i, " is beyond the grid");
  }
  return true;
}

bool Checker::check_plane(std::size_t p) {
  const SolidData::Plane& plane = data_.planes[p];
  const Int128 limit = Int128{1} << (2 * data_.grid_bits + 1);
  Int128 divisor = 0;
  for (const Int128 component : plane.normal) {
    if (component <= -limit || component >= limit)
      return fail(ErrorCode::kOutOfRange, "plane", p,
                  " has a normal beyond the grid's");
    divisor = divisor_of(divisor, component);
  }
  if (divisor == 0)
    return fail(ErrorCode::kZeroArea, "plane", p, " has a normal of zeros");
  const auto first = std::find_if(plane.normal.begin(), plane.normal.end(),
                                  [](Int128 c) { return c != 0; });
  if (divisor != 1 || *first < 0)
    return fail(ErrorCode::kSyntax, "plane", p,
                " is not reduced: its normal has a common divisor, or begins "
                "with a number below 0");
  if (!is_in_grid(plane.origin))
    return fail(ErrorCode::kOutOfRange, "plane", p,
                " has a point beyond the grid");
  return true;
}

bool Checker::check_meet(std::size_t m) {
  const auto& planes = data_.meets[m];
  std::array<std::array<Big, 3>, 3> n;
  for (std::size_t i = 0; i < 3; ++i) {
    if (planes[i] >= data_.planes.size())
      return fail(ErrorCode::kBadIndex, "meet", m,
                  " has no plane " + std::to_string(planes[i]));
    for (std::size_t k = 0; k < 3; ++k)
      n[i][k] = to_big<Big>(data_.planes[planes[i]].normal[k]);
  }
  Big determinant = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3, last = (k + 2) % 3;
    determinant +=
        n[0][k] * (n[1][next] * n[2][last] - n[1][last] * n[2][next]);
  }
  if (determinant == 0)
    return fail(ErrorCode::kZeroArea, "meet", m,
                " has planes that do not meet in one point");
  return true;
}

bool Checker::check_origins() {
  for (std::size_t i = 0; i < data_.origins.size(); ++i) {
    if (data_.origins[i].part >= data_.parts.size())
      return fail(ErrorCode::kBadIndex, "origin", i,
                  " has no part " + std::to_string(data_.origins[i].part));
    if (data_.origins[i].polygon > kMostSolidItems)
      return fail(ErrorCode::kOutOfRange, "origin", i,
                  " has a polygon over 2147483647");
  }
  return true;
}

bool Checker::check_loop(std::size_t first, std::size_t count,
                         std::uint32_t plane) {
  const std::size_t vertices = data_.points.size() + data_.meets.size();
  for (std::size_t i = first; i < first + count; ++i) {
    const SolidData::Corner& corner = data_.corners[i];
    const SolidData::Corner& next =
        data_.corners[i + 1 < first + count ? i + 1 : first];
    if (corner.vertex >= vertices)
      return fail(ErrorCode::kBadIndex, "corner", i,
                  " has no vertex " + std::to_string(corner.vertex));
    if (corner.vertex == next.vertex)
      return fail(ErrorCode::kRepeatedVertex, "corner", i,
                  " is where the next one is");
    if (corner.plane == SolidData::kNoPlane) {
      if (std::max(corner.vertex, next.vertex) >= data_.points.size())
        return fail(ErrorCode::kSyntax, "corner", i,
                    " must name a plane: an end of its edge is no grid point");
    } else if (corner.plane >= data_.planes.size()) {
      return fail(ErrorCode::kBadIndex, "corner", i,
                  " has no plane " + std::to_string(corner.plane));
    } else if (corner.plane == plane) {
      return fail(ErrorCode::kBadIndex, "corner", i,
                  " names the plane of its face");
    }
  }
  return true;
}

bool Checker::check_faces() {
  std::size_t loop = 0, first = 0;
  for (std::size_t f = 0; f < data_.faces.size(); ++f) {
    const SolidData::Face& face = data_.faces[f];
    if (face.plane >= data_.planes.size())
      return fail(ErrorCode::kBadIndex, "face", f,
                  " has no plane " + std::to_string(face.plane));
    if (face.origin >= data_.origins.size())
      return fail(ErrorCode::kBadIndex, "face", f,
                  " has no origin " + std::to_string(face.origin));
    if (face.loop_count == 0 || face.loop_count > data_.loops.size() - loop)
      return fail(ErrorCode::kTooFewVertices, "face", f, " lacks its loops");
    for (std::uint32_t l = 0; l < face.loop_count; ++l, ++loop) {
      const std::uint32_t count = data_.loops[loop];
      if (count < 2 || count > data_.corners.size() - first)
        return fail(ErrorCode::kTooFewVertices, "face", f,
                    " has a loop of fewer than 2 corners");
      if (!check_loop(first, count, face.plane)) return false;
      first += count;
    }
  }
  if (loop != data_.loops.size() || first != data_.corners.size())
    return fail(ErrorCode::kSyntax, "face", data_.faces.size(),
                ": there are loops or corners of no face");
  return true;
}

Result<Done> Checker::checked() {
  const auto all = [](std::size_t count, auto&& check) {
    for (std::size_t i = 0; i < count; ++i) {
      if (!check(i)) return false;
    }
    return true;
  };
  const bool is_fine =
      check_header() && check_points() &&
      all(data_.planes.size(), [&](std::size_t p) { return check_plane(p); }) &&
      all(data_.meets.size(), [&](std::size_t m) { return check_meet(m); }) &&
      check_origins() && check_faces();
  if (!is_fine) return error_;
  return Done{};
}

}  // namespace

bool is_solid_file(std::string_view bytes) {
  return bytes.starts_with(kSolidTextMagic) ||
         bytes.starts_with(kSolidBinaryMagic.substr(0, 7));
}

std::uint32_t solid_version(const SolidData& data) {
  const bool has_slits =
      std::find(data.loops.begin(), data.loops.end(), 2u) != data.loops.end();
  const bool is_colored =
      std::all_of(data.faces.begin(), data.faces.end(),
                  [](const SolidData::Face& face) { return face.has_color; });
  return is_colored && !has_slits ? kFirstSolidVersion : kSolidVersion;
}

Result<Done> check_solid_data(const SolidData& data) {
  return Checker(data).checked();
}

Result<SolidData> read_solid(std::string_view bytes) {
  Result<SolidData> data = bytes.starts_with(kSolidBinaryMagic.substr(0, 1))
                               ? read_solid_binary(bytes)
                               : read_solid_text(bytes);
  if (!data) return data;
  const Result<Done> fine = check_solid_data(*data);
  if (!fine) return fine.error();
  return data;
}

std::string write_solid(const SolidData& data, SolidForm form) {
  return form == SolidForm::kText ? solid_text(data) : solid_binary(data);
}

}  // namespace halfspace
