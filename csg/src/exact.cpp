#include "halfspace/csg/exact.hpp"

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <iterator>
#include <utility>
#include <vector>

#include "halfspace/big_integer.hpp"
#include "halfspace/fast/check_operand.hpp"
#include "halfspace/fast/rounded_mesh.hpp"
#include "halfspace/fast/solid_data.hpp"
#include "halfspace/io/file.hpp"
#include "step_map.hpp"

namespace halfspace::csg {
namespace {

using io::Integer;
using io::Number;
/// Holds what is computed from three planes of 54 bits: 9n + 12.
using Big = boost::multiprecision::int512_t;
using Rows = std::array<std::array<Integer, 3>, 3>;

/// How a map moves planes: normals by its cofactors, without common divisors.
struct NormalMap {
  Rows rows;
  bool is_identity = false;
  bool mirrors = false;
};

NormalMap normal_map(const StepMap& map) {
  Rows linear;
  Integer divisor = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      linear[i][j] = map.rows[i][j];
      divisor = gcd(divisor, linear[i][j]);
    }
  }
  NormalMap result;
  for (auto& row : linear) {
    for (Integer& value : row) value /= divisor;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const std::size_t r = (i + 1) % 3, s = (i + 2) % 3;
      const std::size_t u = (j + 1) % 3, v = (j + 2) % 3;
      result.rows[i][j] =
          linear[r][u] * linear[s][v] - linear[r][v] * linear[s][u];
    }
  }
  Integer determinant = 0;
  for (std::size_t j = 0; j < 3; ++j)
    determinant += linear[0][j] * result.rows[0][j];
  result.mirrors = determinant < 0;
  result.is_identity = true;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j)
      result.is_identity &= result.rows[i][j] == (i == j ? 1 : 0);
  }
  return result;
}

/// A moved normal, reduced; `turned`: it points the other way.
std::array<Integer, 3> image_of(const NormalMap& map,
                                const std::array<Int128, 3>& normal,
                                bool& turned) {
  std::array<Integer, 3> image;
  Integer divisor = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j)
      image[i] += map.rows[i][j] * to_big<Integer>(normal[j]);
    divisor = gcd(divisor, image[i]);
  }
  const auto first = std::find_if(image.begin(), image.end(),
                                  [](const Integer& c) { return c != 0; });
  turned = *first < 0;
  for (Integer& c : image) c /= turned ? Integer(-divisor) : divisor;
  return image;
}

std::size_t bits_of(const Integer& value) {
  return value == 0 ? 0 : msb(abs(value)) + 1;
}

std::size_t bits_of(Int128 value) { return bits_of(to_big<Integer>(value)); }

/// The bits of the greatest component of a moved normal.
std::size_t normal_bits(const SolidData& data, const NormalMap& map) {
  Int128 most = 0;
  std::size_t bits = 0;
  for (const SolidData::Plane& plane : data.planes) {
    if (map.is_identity) {
      for (const Int128 c : plane.normal) most = std::max(most, c < 0 ? -c : c);
      continue;
    }
    bool turned = false;
    for (const Integer& c : image_of(map, plane.normal, turned))
      bits = std::max(bits, bits_of(c));
  }
  return std::max(bits, bits_of(most));
}

/// Where three planes meet, rounded down; the point is less than 1 beyond.
std::array<Big, 3> meet_below(const SolidData& data,
                              const std::array<std::uint32_t, 3>& planes) {
  std::array<std::array<Big, 3>, 3> n;
  std::array<Big, 3> offset;
  for (std::size_t i = 0; i < 3; ++i) {
    const SolidData::Plane& plane = data.planes[planes[i]];
    for (std::size_t k = 0; k < 3; ++k) n[i][k] = to_big<Big>(plane.normal[k]);
    offset[i] = n[i][0] * plane.origin.x + n[i][1] * plane.origin.y +
                n[i][2] * plane.origin.z;
  }
  std::array<Big, 3> at;
  Big below = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& q = n[(i + 1) % 3];
    const auto& r = n[(i + 2) % 3];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t u = (k + 1) % 3, v = (k + 2) % 3;
      const Big product = q[u] * r[v] - q[v] * r[u];
      at[k] += offset[i] * product;
      if (i == 0) below += n[0][k] * product;
    }
  }
  for (Big& c : at) {
    if (below < 0) c = -c;
    const Big positive = abs(below);
    const Big quotient = c / positive;
    c = c % positive < 0 ? Big(quotient - 1) : quotient;
  }
  return at;
}

/// The corners of a box of grid points that holds all meets.
std::vector<GridPoint> box_of_meets(const SolidData& data) {
  if (data.meets.empty()) return {};
  const std::int64_t limit = std::int64_t{1} << (data.grid_bits - 1);
  std::array<std::int64_t, 3> low{limit, limit, limit},
      high{-limit, -limit, -limit};
  for (const auto& planes : data.meets) {
    const std::array<Big, 3> at = meet_below(data, planes);
    for (std::size_t k = 0; k < 3; ++k) {
      const Big held = std::clamp<Big>(at[k], -limit, limit - 1);
      const auto value = held.convert_to<std::int64_t>();
      low[k] = std::min(low[k], value);
      high[k] = std::max(high[k], value + 1);
    }
  }
  std::vector<GridPoint> corners;
  for (int i = 0; i < 8; ++i) {
    corners.push_back({(i & 1) != 0 ? high[0] : low[0],
                       (i & 2) != 0 ? high[1] : low[1],
                       (i & 4) != 0 ? high[2] : low[2]});
  }
  return corners;
}

/// The least, or greatest, multiple of a step that is not within the number.
Number outwards(const Number& value, const Number& step, bool up) {
  Integer above = value.mantissa, below = 1;
  const auto scale = [&](std::int32_t exponent, int base) {
    Integer& side = exponent < 0 ? below : above;
    side *= pow(Integer(base), static_cast<unsigned>(std::abs(exponent)));
  };
  scale(value.two - step.two, 2);
  scale(value.five - step.five, 5);
  Integer quotient = above / below;
  const Integer rest = above % below;
  if (rest < 0 && !up) --quotient;
  if (rest > 0 && up) ++quotient;
  return io::normalised(quotient, step.two, step.five);
}

std::vector<GridPoint> grid_points_of(const SolidData& data) {
  std::vector<GridPoint> points = data.points;
  for (const SolidData::Plane& plane : data.planes)
    points.push_back(plane.origin);
  return points;
}

/// Turns every loop round; each edge keeps its plane.
void reverse_loops(SolidData& data) {
  std::size_t first = 0;
  for (const std::uint32_t count : data.loops) {
    const auto begin =
        data.corners.begin() + static_cast<std::ptrdiff_t>(first);
    const std::vector<SolidData::Corner> old(begin, begin + count);
    for (std::size_t i = 0; i < count; ++i) {
      begin[static_cast<std::ptrdiff_t>(i)] = {old[(count - i) % count].vertex,
                                               old[count - i - 1].plane};
    }
    first += count;
  }
}

bool is_below(const Number& a, Number b) {
  b.mantissa = -b.mantissa;
  return sum(a, b).mantissa < 0;
}

/// The polygons of a rounded surface as a mesh. `solid` is that of the data.
io::Mesh mesh_of(const fast::RoundedMesh& rounded, const fast::Solid& solid,
                 const SolidData& data) {
  std::vector<bool> colored(data.origins.size());
  for (const SolidData::Face& face : data.faces) {
    if (face.has_color) colored[face.origin] = true;
  }
  io::Mesh mesh;
  for (const auto& [x, y, z] : rounded.vertices) {
    mesh.vertices.push_back(
        {io::number_of(x), io::number_of(y), io::number_of(z)});
  }
  mesh.first_corner = rounded.first_corner;
  mesh.corners = rounded.corners;
  for (std::size_t p = 0; p < rounded.faces.size(); ++p) {
    const auto face = static_cast<std::size_t>(rounded.faces[p]);
    const auto origin = static_cast<std::size_t>(solid.faces[face].polygon);
    mesh.face_colors.push_back(
        colored[origin] ? std::optional<Rgb>(rounded.colors[p]) : std::nullopt);
  }
  return mesh;
}

}  // namespace

std::optional<ExactNeed> need_of(const SolidData& data, const Matrix& matrix) {
  const StepMap map = step_map(matrix, data.unit);
  const std::size_t bits = normal_bits(data, normal_map(map));
  ExactNeed need;
  const auto grid = std::find_if(
      std::begin(kGridBits), std::end(kGridBits),
      [&](int n) { return bits <= 2 * static_cast<std::size_t>(n) + 1; });
  if (grid == std::end(kGridBits)) return std::nullopt;
  need.grid_bits = *grid;
  const Extent points = extent_of(map, grid_points_of(data));
  need.step =
      points.step.mantissa == 0 ? Number{1, map.two, map.five} : points.step;
  need.least = points.least;
  need.greatest = points.greatest;
  const std::vector<GridPoint> box = box_of_meets(data);
  if (box.empty()) return need;
  const Extent meets = extent_of(map, box);
  const Number least = outwards(meets.least, need.step, false);
  const Number greatest = outwards(meets.greatest, need.step, true);
  if (is_below(least, need.least)) need.least = least;
  if (is_below(need.greatest, greatest)) need.greatest = greatest;
  return need;
}

SolidData placed(const SolidData& data, const Matrix& matrix, const Unit& unit,
                 int grid_bits) {
  const StepMap map = step_map(matrix, data.unit);
  const NormalMap normals = normal_map(map);
  SolidData result = data;
  result.unit = unit;
  result.grid_bits = grid_bits;
  const PlacedPoints at = placed(map, grid_points_of(data), unit);
  const std::size_t count = data.points.size();
  std::copy_n(at.points.begin(), count, result.points.begin());
  std::vector<bool> turned(data.planes.size());
  for (std::size_t p = 0; p < data.planes.size(); ++p) {
    SolidData::Plane& plane = result.planes[p];
    plane.origin = at.points[count + p];
    if (normals.is_identity) continue;
    bool is_turned = false;
    const auto image = image_of(normals, data.planes[p].normal, is_turned);
    for (std::size_t k = 0; k < 3; ++k) plane.normal[k] = to_int128(image[k]);
    turned[p] = is_turned;
  }
  for (SolidData::Face& face : result.faces)
    face.flipped = face.flipped != (turned[face.plane] != normals.mirrors);
  if (normals.mirrors) reverse_loops(result);
  return result;
}

SolidData in_least_grid(SolidData data) {
  std::vector<GridPoint> points = grid_points_of(data);
  const std::vector<GridPoint> box = box_of_meets(data);
  points.insert(points.end(), box.begin(), box.end());
  const std::optional<ExactNeed> need = need_of(data, identity_matrix());
  for (const int bits : kGridBits) {
    if (!need || bits < need->grid_bits || bits >= data.grid_bits) continue;
    const auto holds = [bits](const GridPoint& p) {
      return fits(p.x, bits) && fits(p.y, bits) && fits(p.z, bits);
    };
    if (!std::all_of(points.begin(), points.end(), holds)) continue;
    data.grid_bits = bits;
    break;
  }
  return data;
}

SolidData flipped(SolidData data) {
  for (SolidData::Face& face : data.faces) face.flipped = !face.flipped;
  reverse_loops(data);
  data.is_checked = false;
  return data;
}

Result<fast::Solid> checked_solid(const SolidData& data,
                                  const fast::CheckOptions& options) {
  Result<fast::Solid> solid = fast::to_solid(data);
  if (!solid || data.is_checked) return solid;
  const Result<Done> fine = fast::check_operand(*solid, options);
  if (!fine) return fine.error();
  return solid;
}

Result<io::Imported> rounded(const SolidData& data,
                             const io::ImportOptions& options) {
  const Result<fast::Solid> solid = checked_solid(data);
  if (!solid) return solid.error();
  const Result<fast::RoundedMesh> mesh = fast::rounded_mesh(*solid);
  if (!mesh) return mesh.error();
  Result<io::Imported> imported =
      io::import_scene(mesh_of(*mesh, *solid, data), options);
  if (!imported) return imported;
  for (PolygonId& polygon : imported->faces) {
    const auto face = static_cast<std::size_t>(
        mesh->faces[static_cast<std::size_t>(polygon)]);
    polygon = solid->faces[face].polygon;
  }
  imported->report.moved += mesh->moved;
  imported->report.max_move += mesh->max_move;
  return imported;
}

namespace {

Result<io::LoadedScene> rounded_scene(const SolidData& data,
                                      const io::ImportOptions& options) {
  Result<io::Imported> imported = rounded(data, options);
  if (!imported) return imported.error();
  return io::LoadedScene{{std::move(imported->scene), std::nullopt, {}},
                         std::move(imported->faces),
                         imported->report,
                         false};
}

Result<io::LoadedScene> rounded_scene(const std::string& name,
                                      std::string_view bytes,
                                      const io::ImportOptions& options,
                                      std::optional<SolidData>* exact) {
  Result<SolidData> data = read_solid(bytes);
  if (!data) return io::error_about(name, data.error());
  Result<io::LoadedScene> loaded = rounded_scene(*data, options);
  if (!loaded) return io::error_about(name, loaded.error());
  if (exact != nullptr) *exact = *std::move(data);
  return loaded;
}

}  // namespace

Result<io::LoadedScene> load_scene(const std::string& path,
                                   const io::ImportOptions& options,
                                   std::optional<SolidData>* exact) {
  if (path == "-") {
    const Result<std::string> bytes = io::read_input();
    if (!bytes) return bytes.error();
    return is_solid_file(*bytes)
               ? rounded_scene(io::kInputName, *bytes, options, exact)
               : io::scene_of_input(*bytes, options);
  }
  if (!io::is_solid_name(path)) return io::load_scene(path, options);
  const Result<std::string> bytes = io::read_file(path);
  if (!bytes) return io::error_about(path, bytes.error());
  return rounded_scene(path, *bytes, options, exact);
}

}  // namespace halfspace::csg
