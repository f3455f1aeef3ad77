#include "origin_parts.hpp"

namespace halfspace::csg {

OriginParts::OriginParts(const Plan& plan, const Operands& operands) {
  const auto add = [this](const std::string& name, const SolidData* data) {
    const auto operand = static_cast<std::int32_t>(first_.size());
    first_.push_back(static_cast<std::int32_t>(names_.size()));
    data_.push_back(data);
    auto& places = places_.emplace_back();
    if (data == nullptr) {
      names_.push_back(name);
    } else {
      names_.insert(names_.end(), data->parts.begin(), data->parts.end());
      for (std::size_t i = 0; i < data->origins.size(); ++i) {
        places.try_emplace({data->origins[i].part, data->origins[i].polygon},
                           static_cast<PolygonId>(i));
      }
    }
    operands_.resize(names_.size(), operand);
  };
  for (std::size_t i = 0; i < plan.leaves.size(); ++i) {
    const auto leaf = static_cast<std::int32_t>(i);
    add(operands.name_in_files(leaf), operands.parts_of(leaf));
  }
  for (std::size_t i = 0; i < plan.planes.size(); ++i) add("half", nullptr);
}

void OriginParts::expand(fast::Solid& solid) const {
  for (fast::Face& face : solid.faces) {
    const auto operand = static_cast<std::size_t>(face.part);
    face.part = first_[operand];
    if (data_[operand] == nullptr) continue;
    const SolidData::Origin& origin =
        data_[operand]->origins[static_cast<std::size_t>(face.polygon)];
    face.part += static_cast<std::int32_t>(origin.part);
    face.polygon = static_cast<PolygonId>(origin.polygon);
  }
}

Origin OriginParts::of_operand(const Origin& origin) const {
  const std::int32_t operand = operands_[static_cast<std::size_t>(origin.leaf)];
  const auto at = static_cast<std::size_t>(operand);
  if (data_[at] == nullptr) return {operand, origin.polygon};
  const auto part = static_cast<std::uint32_t>(origin.leaf - first_[at]);
  return {operand,
          places_[at].at({part, static_cast<std::uint32_t>(origin.polygon)})};
}

}  // namespace halfspace::csg
