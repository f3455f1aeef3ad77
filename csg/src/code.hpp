#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "functions.hpp"
#include "halfspace/csg/script.hpp"

namespace halfspace::csg {

/// What one instruction does with the values on the machine's stack.
enum class Op : std::uint8_t {
  kNumber,      ///< pushes `number`
  kFile,        ///< pushes the solid in the file `name`
  kLoad,        ///< pushes what the global `name` stands for
  kLoadLocal,   ///< pushes local `count` of the function that runs
  kNegate,      ///< replaces a number
  kComplement,  ///< replaces a solid
  kCombine,     ///< replaces two solids, or two numbers less one another
  kAdd,         ///< replaces two numbers, or two solids by their union
  kMultiply,    ///< each replaces two numbers
  kDivide,
  kList,      ///< replaces `count` values by their list
  kIndex,     ///< replaces a list and a number by one of its values
  kHalf,      ///< replaces a number by `x < number` and its like
  kCall,      ///< calls `function` with `count` values
  kCallOwn,   ///< calls function `target` of the script with `count` values
  kForBegin,  ///< takes a list; `target`: behind its kForNext
  kForNext,   ///< keeps a value; `target`: behind its kForBegin
};

struct Instruction {
  Op op = Op::kNumber;
  NodeKind operation = NodeKind::kUnion;     ///< of kCombine
  Function function = Function::kTranslate;  ///< of kCall
  std::uint32_t count = 0;
  std::uint32_t target = 0;
  Place place;
  io::Number number;
  std::string_view name;  ///< a part of the script's text
};

using Code = std::vector<Instruction>;

/// A function that the script defines: its parameters are its first locals.
struct OwnFunction {
  std::string_view name;
  std::uint32_t parameters = 0;
  std::uint32_t locals = 0;
  Code code;
};

}  // namespace halfspace::csg
