// The functions of a script: their numbers and brackets.
#include <utility>

#include "parser.hpp"

namespace halfspace::csg {

bool Parser::number(io::Number& value) {
  bool negative = false;
  if (token_.is('-') || token_.is('+')) {
    negative = token_.is('-');
    if (!advance()) return false;
  }
  if (token_.kind != TokenKind::kNumber) return unexpected("a number");
  Result<io::Number> read = number_in(token_, negative);
  if (!read) {
    error_ = read.error();
    return false;
  }
  value = *std::move(read);
  if (!advance()) return false;
  while (token_.kind == TokenKind::kLineEnd) {
    if (!advance()) return false;
  }
  return true;
}

/// Numbers with commas between them, up to a closing bracket.
bool Parser::numbers(std::vector<io::Number>& values) {
  for (;;) {
    if (!number(values.emplace_back())) return false;
    if (token_.is(')')) return true;
    if (!token_.is(',')) return unexpected("',' or ')'");
    do {
      if (!advance()) return false;
    } while (token_.kind == TokenKind::kLineEnd);
    // No function takes more; what has a million is no use to count.
    if (values.size() > 12) return unexpected("')'");
  }
}

bool Parser::axis_half_of(const Place& place, std::size_t axis) {
  if (!advance()) return false;
  if (!token_.is('<') && !token_.is('>')) return unexpected("'<' or '>'");
  const bool less = token_.is('<');
  io::Number value;
  if (!advance() || !number(value)) return false;
  if (!token_.is(')')) return unexpected("')'");
  Node node{.kind = NodeKind::kHalf, .place = place};
  node.item = static_cast<std::int32_t>(script_.halves.size());
  script_.halves.push_back(axis_half(axis, less, value));
  operands_.push_back(add(node));
  return advance();
}

/// What is in the brackets of `half`, and the closing one.
bool Parser::half(const Place& place) {
  while (token_.kind == TokenKind::kLineEnd) {
    if (!advance()) return false;
  }
  if (token_.kind == TokenKind::kName) {
    constexpr std::string_view kAxes = "xyz";
    const std::size_t axis =
        token_.text.size() == 1 ? kAxes.find(token_.text) : kAxes.npos;
    if (axis == kAxes.npos) return unexpected("x, y, z or a number");
    return axis_half_of(place, axis);
  }
  std::vector<io::Number> values;
  if (!numbers(values)) return false;
  Result<HalfSpace> points = half_of(place, values);
  if (!points) {
    error_ = points.error();
    return false;
  }
  Node node{.kind = NodeKind::kHalf, .place = place};
  node.item = static_cast<std::int32_t>(script_.halves.size());
  script_.halves.push_back(*std::move(points));
  operands_.push_back(add(node));
  return advance();
}

/// A function, up to its first operand; all of `half`, which has none.
bool Parser::function() {
  const Place place = token_.place;
  const Function which = *function_named(token_.text);
  if (!advance()) return false;
  if (!token_.is('(')) return unexpected("'('");
  if (!advance()) return false;
  if (which == Function::kHalf) return half(place);
  pending_.push_back(
      {.kind = Pending::Kind::kFunction, .function = which, .place = place});
  ++depth_;
  return true;
}

/// The numbers of a function after its operand, and the closing bracket.
bool Parser::close_function() {
  const Pending call = pending_.back();
  do {
    if (!advance()) return false;
  } while (token_.kind == TokenKind::kLineEnd);
  std::vector<io::Number> values;
  if (!numbers(values)) return false;
  Result<Matrix> matrix = transform_of(call.function, call.place, values);
  if (!matrix) {
    error_ = matrix.error();
    return false;
  }
  Node node{.kind = NodeKind::kTransform, .place = call.place};
  node.left = operands_.back();
  node.item = static_cast<std::int32_t>(script_.transforms.size());
  script_.transforms.push_back(*std::move(matrix));
  operands_.back() = add(node);
  pending_.pop_back();
  --depth_;
  return advance();
}

}  // namespace halfspace::csg
