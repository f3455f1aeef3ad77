#include "origin_parts.hpp"

#include <algorithm>
#include <numeric>
#include <optional>
#include <tuple>

#include "halfspace/csg/part_names.hpp"

namespace halfspace::csg {
namespace {

/// What tells parts apart. Solids that were written and read again are known by
/// their names alone; what has attributes of its own stays by itself, for
/// those depend on where a part is from.
struct Key {
  std::string name;
  std::int32_t alone = -1;  ///< the operand, if it stays by itself
  friend auto operator<=>(const Key&, const Key&) = default;
};

std::vector<OperandPart> parts_of(const Plan& plan, const Operands& operands) {
  std::vector<OperandPart> parts;
  std::map<std::string, std::string> paths;  // of the first file of a name
  for (std::size_t i = 0; i < plan.leaves.size(); ++i) {
    const auto leaf = static_cast<std::int32_t>(i);
    const std::string name = operands.part_name(leaf);
    const SolidData* const data = operands.parts_of(leaf);
    const std::string& path = operands.path_of(leaf);
    const bool is_other = data == nullptr && !operands.is_primitive(leaf) &&
                          paths.try_emplace(name, path).first->second != path;
    const bool is_alone = is_other || operands.attributed(leaf) != nullptr;
    parts.push_back(
        {name, data,
         plan.matrices[static_cast<std::size_t>(plan.leaves[i].matrix)],
         is_alone ? leaf : -1});
  }
  for (const Plane& plane : plan.planes)
    parts.push_back(half_part(plane.points));
  return parts;
}

}  // namespace

OperandPart half_part(const HalfSpace& points) {
  return {half_name(points), nullptr, std::nullopt, -1};
}

OriginParts::OriginParts(const Plan& plan, const Operands& operands)
    : OriginParts(parts_of(plan, operands)) {}

OriginParts::OriginParts(std::span<const OperandPart> operands) {
  std::vector<Key> keys;  // by part of an operand
  for (const OperandPart& part : operands) {
    const auto operand = static_cast<std::int32_t>(first_.size());
    first_.push_back(static_cast<std::int32_t>(keys.size()));
    data_.push_back(part.data);
    auto& places = places_.emplace_back();
    const auto placed = [&part](const std::string& name) {
      return part.matrix ? placed_name(name, *part.matrix) : name;
    };
    if (part.data == nullptr) {
      keys.push_back({placed(part.name), part.alone});
    } else {
      for (const std::string& name : part.data->parts)
        keys.push_back({placed(name), -1});
      for (std::size_t i = 0; i < part.data->origins.size(); ++i) {
        const SolidData::Origin& origin = part.data->origins[i];
        places.try_emplace({origin.part, origin.polygon},
                           static_cast<PolygonId>(i));
      }
    }
    operands_.resize(keys.size(), operand);
  }

  // Parts by name.
  std::vector<std::int32_t> order(keys.size());
  std::iota(order.begin(), order.end(), 0);
  const auto key = [&keys](std::int32_t part) -> const Key& {
    return keys[static_cast<std::size_t>(part)];
  };
  std::stable_sort(
      order.begin(), order.end(),
      [&](std::int32_t a, std::int32_t b) { return key(a) < key(b); });
  part_.resize(keys.size());
  for (const std::int32_t at : order) {
    if (same_.empty() || key(same_.back().front()) != key(at)) {
      names_.push_back(key(at).name);
      same_.emplace_back();
    }
    part_[static_cast<std::size_t>(at)] =
        static_cast<std::int32_t>(names_.size()) - 1;
    same_.back().push_back(at);
  }
}

void OriginParts::expand(fast::Solid& solid) const {
  for (fast::Face& face : solid.faces) {
    const auto operand = static_cast<std::size_t>(face.part);
    std::int32_t part = first_[operand];
    if (data_[operand] != nullptr) {
      const SolidData::Origin& origin =
          data_[operand]->origins[static_cast<std::size_t>(face.polygon)];
      part += static_cast<std::int32_t>(origin.part);
      face.polygon = static_cast<PolygonId>(origin.polygon);
    }
    face.part = part_[static_cast<std::size_t>(part)];
  }
}

Origin OriginParts::of_operand(const Origin& origin) const {
  for (const std::int32_t part : same_[static_cast<std::size_t>(origin.leaf)]) {
    const std::int32_t operand = operands_[static_cast<std::size_t>(part)];
    const auto at = static_cast<std::size_t>(operand);
    if (data_[at] == nullptr) return {operand, origin.polygon};
    const auto found =
        places_[at].find({static_cast<std::uint32_t>(part - first_[at]),
                          static_cast<std::uint32_t>(origin.polygon)});
    if (found != places_[at].end()) return {operand, found->second};
  }
  return origin;  // not reached: a face has its origin from some operand
}

}  // namespace halfspace::csg
