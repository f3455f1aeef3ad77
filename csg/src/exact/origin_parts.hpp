#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "halfspace/csg/operands.hpp"
#include "halfspace/csg/outcome.hpp"
#include "halfspace/csg/plan.hpp"
#include "halfspace/fast/solid.hpp"

namespace halfspace::csg {

/// The solids that a result was made of in the first place: operands, those
/// that exact operands were made of, and planes; each once, by name, wherever
/// it stands in a script or in the files of the commands before (S6.10).
///
/// What is decided by where faces come from is decided by these, so that it
/// does not matter which of them a file has put together on the way, nor which
/// was named first.
class OriginParts {
 public:
  OriginParts(const Plan& plan, const Operands& operands);
  /// Operands, and planes after them.
  explicit OriginParts(std::span<const OperandPart> operands);

  /// By part, sorted.
  const std::vector<std::string>& names() const { return names_; }
  /// Makes the parts of the faces these ones.
  void expand(fast::Solid& solid) const;
  /// The operand, or plane, and its polygon, that an origin among these is: the
  /// first that has it.
  Origin of_operand(const Origin& origin) const;

 private:
  std::vector<std::string> names_;
  // Parts as operands have them, one operand after another: ...
  std::vector<std::int32_t> operands_;           // ... whose each is
  std::vector<std::int32_t> part_;               // ... which of the names
  std::vector<std::vector<std::int32_t>> same_;  // ... by name
  std::vector<std::int32_t> first_;              // of them, by operand
  std::vector<const SolidData*> data_;  // by operand; null: it is one part
  /// By operand the place of each of its origins.
  std::vector<std::map<std::pair<std::uint32_t, std::uint32_t>, PolygonId>>
      places_;
};

}  // namespace halfspace::csg
