#include "halfspace/csg/part_names.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace halfspace::csg {
namespace {

using io::Integer;
using io::Number;

constexpr std::string_view kAt = " @ ";
constexpr std::string_view kHalf = "half";

/// The number as a decimal that parse_number() reads as the same.
std::string text_of(const Number& number) {
  if (number.mantissa == 0) return "0";
  const std::int32_t ten = std::min(number.two, number.five);
  Integer digits = number.mantissa *
                   pow(Integer(5), static_cast<unsigned>(number.five - ten));
  digits <<= number.two - ten;
  return digits.str() + (ten == 0 ? "" : "e" + std::to_string(ten));
}

/// A name without a place, and the numbers of the place.
struct Parsed {
  std::string name;
  std::vector<Number> numbers;
};

/// The name in its parts; without numbers where it names no place.
Parsed parsed(const std::string& name) {
  const std::size_t at = name.rfind(kAt);
  if (at == std::string::npos) return {name, {}};
  Parsed made{name.substr(0, at), {}};
  std::string_view rest = std::string_view(name).substr(at + kAt.size());
  while (true) {
    const std::size_t end = std::min(rest.find(' '), rest.size());
    Result<Number> number = io::parse_number(rest.substr(0, end));
    if (!number) return {name, {}};
    made.numbers.push_back(*std::move(number));
    if (end == rest.size()) break;
    rest.remove_prefix(end + 1);
  }
  const std::size_t wanted = made.name == kHalf ? 9 : 12;
  return made.numbers.size() == wanted ? made : Parsed{name, {}};
}

template <class Rows>
std::string with_place(std::string name, const Rows& rows) {
  name += kAt;
  for (const auto& row : rows) {
    for (const Number& number : row) name += text_of(number) + " ";
  }
  name.pop_back();
  return name;
}

template <std::size_t kColumns>
std::array<std::array<Number, kColumns>, 3> rows_of(
    const std::vector<Number>& numbers) {
  std::array<std::array<Number, kColumns>, 3> rows;
  for (std::size_t i = 0; i < 3 * kColumns; ++i)
    rows[i / kColumns][i % kColumns] = numbers[i];
  return rows;
}

}  // namespace

std::string placed_name(const std::string& name, const Matrix& matrix) {
  if (matrix == identity_matrix()) return name;
  const Parsed was = parsed(name);
  if (was.name == kHalf && !was.numbers.empty()) {
    HalfSpace points = rows_of<3>(was.numbers);
    for (Numbers3& point : points) point = image_of(matrix, point);
    // As plans have it: turned inside out, the plane would face the other way.
    if (determinant_sign(matrix) < 0) std::swap(points[0], points[2]);
    return half_name(points);
  }
  const Matrix before =
      was.numbers.empty() ? identity_matrix() : Matrix{rows_of<4>(was.numbers)};
  const std::optional<Matrix> both = product(matrix, before);
  if (!both) return was.name + std::string(kAt) + "?";
  return *both == identity_matrix() ? was.name
                                    : with_place(was.name, both->rows);
}

std::string half_name(const HalfSpace& points) {
  return with_place(std::string(kHalf), points);
}

std::string scene_name(const std::string& name, const Scene& scene) {
  io::Mesh mesh;
  const Unit unit = scene.unit();
  const auto number = [&unit](std::int64_t steps) {
    return io::normalised(steps, steps == 0 ? 0 : unit.exponent,
                          steps == 0 || unit.base == 2 ? 0 : unit.exponent);
  };
  for (const GridPoint& p : scene.data().vertices)
    mesh.vertices.push_back({number(p.x), number(p.y), number(p.z)});
  mesh.corners = scene.data().corners;
  return primitive_name(name, mesh);
}

std::string primitive_name(const std::string& name, const io::Mesh& mesh) {
  // FNV-1a of the coordinates as texts, and of the corners.
  std::uint32_t hash = 2166136261u;
  const auto add = [&hash](const std::string& text) {
    for (const char c : text + " ") {
      hash ^= static_cast<unsigned char>(c);
      hash *= 16777619u;
    }
  };
  for (const auto& point : mesh.vertices) {
    for (const Number& number : point) add(text_of(number));
  }
  for (const VertexId corner : mesh.corners) add(std::to_string(corner));
  std::string digits;
  for (int shift = 28; shift >= 0; shift -= 4)
    digits += "0123456789abcdef"[hash >> shift & 15u];
  return name + " #" + digits;
}

}  // namespace halfspace::csg
