#include "mesh/mesh_builder.hpp"

#include <cmath>

namespace halfspace::io {
namespace {

Error too_many(const char* what) {
  return {ErrorCode::kOutOfRange,
          std::string("there are more than 2147483647 ") + what};
}

}  // namespace

std::size_t NumbersHash::operator()(const std::array<Number, 3>& point) const {
  std::uint64_t hash = 0;
  for (const Number& number : point) {
    const auto& limbs = number.mantissa.backend();
    hash = mixed(hash + static_cast<std::uint64_t>(limbs.limbs()[0]) +
                 (limbs.sign() ? 1u : 0u));
    hash =
        mixed(hash + static_cast<std::uint32_t>(number.two) +
              (std::uint64_t{static_cast<std::uint32_t>(number.five)} << 32));
  }
  return hash;
}

std::optional<Error> MeshBuilder::add_vertex(std::array<Number, 3> point) {
  if (check_.stops()) return stopped();
  if (mesh.vertices.size() >= kMaxCount) return too_many("vertices");
  mesh.vertices.push_back(std::move(point));
  return std::nullopt;
}

std::optional<Error> MeshBuilder::add_corner_at(std::array<Number, 3> point) {
  if (mesh.vertices.size() >= kMaxCount) return too_many("vertices");
  return add_corner(table_.index_of(std::move(point), mesh.vertices));
}

std::optional<Error> MeshBuilder::add_corner(std::int64_t vertex) {
  if (check_.stops()) return stopped();
  if (mesh.corners.size() >= kMaxCount) return too_many("corners");
  mesh.corners.push_back(static_cast<VertexId>(vertex));
  return std::nullopt;
}

Result<Rgb> color_of(const std::array<Number, 3>& values, int range) {
  std::array<std::uint8_t, 3> bytes{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double value = to_double(values[i]);
    if (!(value >= 0 && value <= range)) {
      return Error{ErrorCode::kOutOfRange,
                   "a colour is " + std::to_string(value) +
                       ", which is not from 0 to " + std::to_string(range)};
    }
    bytes[i] = static_cast<std::uint8_t>(std::floor(value * 255 / range + 0.5));
  }
  return Rgb{bytes[0], bytes[1], bytes[2]};
}

}  // namespace halfspace::io
