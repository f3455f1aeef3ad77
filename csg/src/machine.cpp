#include "machine.hpp"

#include <algorithm>
#include <iterator>

#include "halfspace/csg/matrix.hpp"
#include "numbers.hpp"

namespace halfspace::csg {
namespace {

using io::Number;

/// A loop that makes more than this was not meant.
constexpr std::size_t kMostNodes = std::size_t{1} << 22;
constexpr std::size_t kMostInstructions = std::size_t{1} << 22;
constexpr std::size_t kMostValues = std::size_t{1} << 22;
constexpr std::uint32_t kMostDepth = 1000;

const char* kind_of(const Value& value) {
  switch (value.kind) {
    case Value::Kind::kNumber:
      return "a number";
    case Value::Kind::kSolid:
      return "a solid";
    default:
      return "a list";
  }
}

/// The numbers among lists and lists of lists, in order; nothing where another
/// kind is among them. The same for solids.
bool flattened(std::vector<Value> values, Value::Kind kind,
               std::vector<Value>& flat) {
  std::reverse(values.begin(), values.end());
  while (!values.empty()) {
    const Value value = std::move(values.back());
    values.pop_back();
    if (value.kind == Value::Kind::kList)
      values.insert(values.end(), value.list->rbegin(), value.list->rend());
    else if (value.kind != kind)
      return false;
    else
      flat.push_back(value);
    if (values.size() + flat.size() > kMostValues) return false;
  }
  return true;
}

}  // namespace

Result<Done> Machine::bind_names() {
  for (std::size_t i = 0; i < bindings_.size(); ++i) {
    const std::string& name = bindings_[i].name;
    const char* trouble = nullptr;
    if (!is_name(name)) trouble = " is not a name";
    if (is_function(name)) trouble = " is a function, not a name";
    if (!trouble && !bound_.try_emplace(name, i).second)
      trouble = " is bound twice";
    if (trouble)
      return Error{ErrorCode::kSyntax, in_quotes(name) + trouble, -1};
  }
  return Done{};
}

Result<Done> Machine::all_used() const {
  for (std::size_t i = 0; i < bindings_.size(); ++i) {
    if (used_[i]) continue;
    return Error{ErrorCode::kBadIndex,
                 in_quotes(bindings_[i].name) + " is bound, but never used",
                 -1};
  }
  return Done{};
}

Value Machine::pop() {
  Value value = std::move(stack_.back());
  stack_.pop_back();
  return value;
}

std::vector<Value> Machine::pop_many(std::size_t count) {
  const auto first = stack_.end() - static_cast<std::ptrdiff_t>(count);
  std::vector<Value> values(std::make_move_iterator(first),
                            std::make_move_iterator(stack_.end()));
  stack_.erase(first, stack_.end());
  return values;
}

void Machine::push(Number number) {
  stack_.push_back({Value::Kind::kNumber, std::move(number), -1, {}, 0});
}

void Machine::push_node(Node node) {
  script_.nodes.push_back(node);
  const auto id = static_cast<std::int32_t>(script_.nodes.size()) - 1;
  stack_.push_back({Value::Kind::kSolid, {}, id, {}, 0});
}

void Machine::push_combined(NodeKind kind, const Place& place, const Value& a,
                            const Value& b) {
  Node node{.kind = kind, .place = place};
  node.left = a.node;
  node.right = b.node;
  push_node(node);
}

bool Machine::push_list(std::vector<Value> values, const Place& place) {
  std::uint32_t depth = 0;
  for (const Value& value : values) depth = std::max(depth, value.depth);
  if (depth >= kMostDepth)
    return fail(place, ErrorCode::kOutOfRange, "lists are nested too deeply");
  stack_.push_back(
      {Value::Kind::kList,
       {},
       -1,
       std::make_shared<const std::vector<Value>>(std::move(values)),
       depth + 1});
  return true;
}

/// The node of a file, which is one however often it is named.
std::int32_t Machine::file_node(File file, const Place& place) {
  const std::string key = file.name + (file.is_flipped ? " flipped" : "");
  const auto [at, is_new] = files_.try_emplace({file.path, key}, 0);
  if (is_new) {
    Node node{.place = place};
    node.item = static_cast<std::int32_t>(script_.files.size());
    script_.files.push_back(std::move(file));
    script_.nodes.push_back(node);
    at->second = static_cast<std::int32_t>(script_.nodes.size()) - 1;
  }
  return at->second;
}

bool Machine::load(const Instruction& at) {
  const auto named = names_.find(at.name);
  if (named != names_.end()) {
    stack_.push_back(named->second);
    return true;
  }
  const auto bound = bound_.find(at.name);
  if (bound != bound_.end()) {
    const Binding& binding = bindings_[bound->second];
    used_[bound->second] = true;
    const std::int32_t node =
        file_node({binding.path, binding.name, {}, false}, at.place);
    stack_.push_back({Value::Kind::kSolid, {}, node, {}, 0});
    return true;
  }
  if (at.name == "pi") {
    push(io::number_of(3.141592653589793));
    return true;
  }
  return fail(at.place, ErrorCode::kBadIndex,
              in_quotes(at.name) + " stands for nothing here");
}

bool Machine::arithmetic(const Instruction& at) {
  const Value b = pop();
  const Value a = at.op == Op::kNegate ? b : pop();
  if (at.op == Op::kAdd && a.kind == Value::Kind::kSolid &&
      b.kind == Value::Kind::kSolid) {
    push_combined(NodeKind::kUnion, at.place, a, b);
    return true;
  }
  for (const Value* value : {&a, &b}) {
    if (value->kind == Value::Kind::kNumber) continue;
    const char* const operation = at.op == Op::kAdd        ? "+ adds"
                                  : at.op == Op::kMultiply ? "* multiplies"
                                  : at.op == Op::kDivide   ? "/ divides"
                                                           : "- negates";
    return fail(at.place, ErrorCode::kSyntax,
                std::string(operation) + " numbers, not " + kind_of(*value));
  }
  std::optional<Number> result;
  switch (at.op) {
    case Op::kAdd:
      result = sum(a.number, b.number);
      break;
    case Op::kMultiply:
      result = product(a.number, b.number);
      break;
    case Op::kDivide:
      if (b.number.mantissa == 0)
        return fail(at.place, ErrorCode::kOutOfRange, "this divides by 0");
      result = quotient(a.number, b.number);
      break;
    default:
      result = negative(a.number);
  }
  if (!result || !is_handy(*result)) {
    return fail(at.place, ErrorCode::kOutOfRange,
                "the result has too many digits");
  }
  push(*std::move(result));
  return true;
}

bool Machine::combine(const Instruction& at) {
  const Value b = pop();
  const Value a = pop();
  const bool is_difference = at.operation == NodeKind::kDifference;
  if (is_difference && a.kind == Value::Kind::kNumber &&
      b.kind == Value::Kind::kNumber) {
    const Number result = sum(a.number, negative(b.number));
    if (!is_handy(result)) {
      return fail(at.place, ErrorCode::kOutOfRange,
                  "the result has too many digits");
    }
    push(result);
    return true;
  }
  for (const Value* value : {&a, &b}) {
    if (value->kind == Value::Kind::kSolid) continue;
    return fail(at.place, ErrorCode::kSyntax,
                std::string("this combines solids, not ") + kind_of(*value));
  }
  push_combined(at.operation, at.place, a, b);
  return true;
}

bool Machine::index(const Instruction& at) {
  const Value which = pop();
  const Value list = pop();
  if (list.kind != Value::Kind::kList || which.kind != Value::Kind::kNumber) {
    return fail(at.place, ErrorCode::kSyntax,
                "brackets after a value take a list and a number");
  }
  const auto last = static_cast<std::int64_t>(list.list->size()) - 1;
  const auto i = whole_in(which.number, 0, last);
  if (!i) {
    return fail(at.place, ErrorCode::kBadIndex,
                "the list has the indices 0 to " + std::to_string(last));
  }
  Value value = (*list.list)[static_cast<std::size_t>(*i)];
  stack_.push_back(std::move(value));
  return true;
}

bool Machine::enter(const Instruction& at, const OwnFunction& function) {
  if (at.count != function.parameters) {
    return fail(at.place, ErrorCode::kSyntax,
                std::string(function.name) + " takes " +
                    std::to_string(function.parameters) +
                    (function.parameters == 1 ? " value" : " values") +
                    ", not " + std::to_string(at.count));
  }
  frames_.push_back({&function.code, 0, locals_.size(), loops_.size()});
  for (Value& value : pop_many(at.count)) locals_.push_back(std::move(value));
  locals_.resize(frames_.back().first_local + function.locals);
  return true;
}

bool Machine::begin_loop(const Instruction& at) {
  const Value list = pop();
  if (list.kind != Value::Kind::kList) {
    return fail(at.place, ErrorCode::kSyntax,
                std::string("for takes a list, not ") + kind_of(list));
  }
  if (list.list->empty()) {
    frames_.back().next = at.target;
    return push_list({}, at.place);
  }
  locals_[frames_.back().first_local + at.count] = list.list->front();
  loops_.push_back({list.list, 0, {}});
  return true;
}

bool Machine::next_of_loop(const Instruction& at) {
  Loop& loop = loops_.back();
  loop.made.push_back(pop());
  if (loop.made.size() > kMostValues)
    return fail(at.place, ErrorCode::kOutOfRange, "the list is too long");
  if (++loop.index < loop.list->size()) {
    locals_[frames_.back().first_local + at.count] = (*loop.list)[loop.index];
    frames_.back().next = at.target;
    return true;
  }
  std::vector<Value> made = std::move(loop.made);
  loops_.pop_back();
  return push_list(std::move(made), at.place);
}

bool Machine::push_half(const Instruction& at, HalfSpace half) {
  Node node{.kind = NodeKind::kHalf, .place = at.place};
  node.item = static_cast<std::int32_t>(script_.halves.size());
  script_.halves.push_back(std::move(half));
  push_node(node);
  return true;
}

bool Machine::push_primitive(const Instruction& at, io::Mesh mesh) {
  File file;
  file.name = std::string(at.name) + " at " + to_string(at.place);
  file.mesh = std::make_shared<const io::Mesh>(std::move(mesh));
  Node node{.place = at.place};
  node.item = static_cast<std::int32_t>(script_.files.size());
  script_.files.push_back(std::move(file));
  push_node(node);
  return true;
}

bool Machine::call_transform(const Instruction& at, std::vector<Value> values) {
  if (values.empty() || values.front().kind != Value::Kind::kSolid)
    return fail(wrong_call(at.function, at.place));
  std::vector<Number> numbers;
  for (std::size_t i = 1; i < values.size(); ++i) {
    if (values[i].kind != Value::Kind::kNumber)
      return fail(wrong_call(at.function, at.place));
    numbers.push_back(values[i].number);
  }
  Result<Matrix> matrix = transform_of(at.function, at.place, numbers);
  if (!matrix) return fail(matrix.error());
  Node node{.kind = NodeKind::kTransform, .place = at.place};
  node.left = values.front().node;
  node.item = static_cast<std::int32_t>(script_.transforms.size());
  script_.transforms.push_back(*std::move(matrix));
  push_node(node);
  return true;
}

bool Machine::call_combine(const Instruction& at, std::vector<Value> values) {
  std::vector<Value> solids;
  if (!flattened(std::move(values), Value::Kind::kSolid, solids) ||
      solids.empty())
    return fail(wrong_call(at.function, at.place));
  NodeKind kind = NodeKind::kUnion;
  if (at.function == Function::kIntersection) kind = NodeKind::kIntersection;
  if (at.function == Function::kDifference) kind = NodeKind::kDifference;
  if (at.function == Function::kSymmetricDifference)
    kind = NodeKind::kSymmetricDifference;
  if (kind == NodeKind::kSymmetricDifference) {
    // Two by two, for plans leave their order.
    while (solids.size() > 1) {
      std::vector<Value> pairs;
      for (std::size_t i = 0; i + 1 < solids.size(); i += 2) {
        push_combined(kind, at.place, solids[i], solids[i + 1]);
        pairs.push_back(pop());
      }
      if (solids.size() % 2 == 1) pairs.push_back(solids.back());
      solids = std::move(pairs);
    }
  }
  stack_.push_back(solids.front());
  for (std::size_t i = 1; i < solids.size(); ++i)
    push_combined(kind, at.place, pop(), solids[i]);
  return true;
}

bool Machine::call_primitive(const Instruction& at,
                             const std::vector<Number>& numbers) {
  Result<io::Mesh> mesh = primitive_of(at.function, at.place, numbers);
  return mesh ? push_primitive(at, *std::move(mesh)) : fail(mesh.error());
}

bool Machine::call_range(const Instruction& at,
                         const std::vector<Number>& numbers) {
  if (numbers.empty() || numbers.size() > 3)
    return fail(wrong_call(at.function, at.place));
  const Number begin = numbers.size() == 1 ? Number{} : numbers[0];
  const Number& end = numbers[numbers.size() == 1 ? 0 : 1];
  const Number step = numbers.size() == 3 ? numbers[2] : Number{1, 0, 0};
  if (step.mantissa == 0) return fail(wrong_call(at.function, at.place));
  const bool falls = step.mantissa < 0;
  std::vector<Value> values;
  for (Number at_number = begin;
       falls ? is_less(end, at_number) : is_less(at_number, end);
       at_number = sum(at_number, step)) {
    if (values.size() >= kMostValues)
      return fail(at.place, ErrorCode::kOutOfRange, "the range is too long");
    values.push_back({Value::Kind::kNumber, at_number, -1, {}, 0});
  }
  return push_list(std::move(values), at.place);
}

bool Machine::call_number(const Instruction& at,
                          const std::vector<Number>& numbers) {
  const bool is_choice =
      at.function == Function::kMin || at.function == Function::kMax;
  if (numbers.empty() || (!is_choice && numbers.size() != 1))
    return fail(wrong_call(at.function, at.place));
  const Number& x = numbers.front();
  std::optional<Number> result;
  switch (at.function) {
    case Function::kSin:
      result = sine(x);
      break;
    case Function::kCos:
      result = cosine(x);
      break;
    case Function::kTan:
      result = quotient(sine(x), cosine(x));
      break;
    case Function::kSqrt:
      result = square_root(x);
      break;
    case Function::kAbs:
      result = x.mantissa < 0 ? negative(x) : x;
      break;
    case Function::kFloor:
      result = floor_of(x);
      break;
    case Function::kMin:
      result = *std::min_element(numbers.begin(), numbers.end(), is_less);
      break;
    default:
      result = *std::max_element(numbers.begin(), numbers.end(), is_less);
  }
  if (!result) {
    return fail(at.place, ErrorCode::kOutOfRange,
                std::string(at.name) + " has no value there");
  }
  push(*std::move(result));
  return true;
}

bool Machine::call_flip(const Instruction& at,
                        const std::vector<Value>& values) {
  if (values.size() != 1 || values[0].kind != Value::Kind::kSolid)
    return fail(wrong_call(at.function, at.place));
  const Node& node = script_.nodes[static_cast<std::size_t>(values[0].node)];
  if (node.kind != NodeKind::kFile)
    return fail(wrong_call(at.function, at.place));
  File file = script_.files[static_cast<std::size_t>(node.item)];
  if (file.mesh) return fail(wrong_call(at.function, at.place));
  file.is_flipped = !file.is_flipped;
  const std::int32_t id = file_node(std::move(file), at.place);
  stack_.push_back({Value::Kind::kSolid, {}, id, {}, 0});
  return true;
}

bool Machine::call(const Instruction& at) {
  std::vector<Value> values = pop_many(at.count);
  if (at.function <= Function::kMirror)
    return call_transform(at, std::move(values));
  if (at.function >= Function::kUnion &&
      at.function <= Function::kSymmetricDifference)
    return call_combine(at, std::move(values));
  if (at.function == Function::kFlip) return call_flip(at, values);
  if (at.function == Function::kLength) {
    if (values.size() != 1 || values[0].kind != Value::Kind::kList)
      return fail(wrong_call(at.function, at.place));
    push(io::number_of(static_cast<double>(values[0].list->size())));
    return true;
  }
  std::vector<Value> flat;
  if (!flattened(std::move(values), Value::Kind::kNumber, flat))
    return fail(wrong_call(at.function, at.place));
  std::vector<Number> numbers;
  for (Value& value : flat) numbers.push_back(std::move(value.number));
  if (at.function == Function::kHalf) {
    Result<HalfSpace> half = half_of(at.place, numbers);
    return half ? push_half(at, *std::move(half)) : fail(half.error());
  }
  if (at.function == Function::kRange) return call_range(at, numbers);
  return at.function <= Function::kHull ? call_primitive(at, numbers)
                                        : call_number(at, numbers);
}

bool Machine::step(const Instruction& at,
                   const std::vector<OwnFunction>& functions) {
  switch (at.op) {
    case Op::kNumber:
      push(at.number);
      return true;
    case Op::kFile: {
      const std::int32_t node =
          file_node({std::string(at.name), {}, {}, false}, at.place);
      stack_.push_back({Value::Kind::kSolid, {}, node, {}, 0});
      return true;
    }
    case Op::kLoad:
      return load(at);
    case Op::kLoadLocal:
      stack_.push_back(locals_[frames_.back().first_local + at.count]);
      return true;
    case Op::kComplement: {
      const Value solid = pop();
      if (solid.kind != Value::Kind::kSolid) {
        return fail(at.place, ErrorCode::kSyntax,
                    std::string("~ takes a solid, not ") + kind_of(solid));
      }
      Node node{.kind = NodeKind::kComplement, .place = at.place};
      node.left = solid.node;
      push_node(node);
      return true;
    }
    case Op::kCombine:
      return combine(at);
    case Op::kNegate:
    case Op::kAdd:
    case Op::kMultiply:
    case Op::kDivide:
      return arithmetic(at);
    case Op::kList:
      return push_list(pop_many(at.count), at.place);
    case Op::kIndex:
      return index(at);
    case Op::kHalf: {
      const Value value = pop();
      if (value.kind != Value::Kind::kNumber)
        return fail(wrong_call(Function::kHalf, at.place));
      return push_half(at, axis_half(at.count, at.target != 0, value.number));
    }
    case Op::kCall:
      return call(at);
    case Op::kCallOwn:
      return enter(at, functions[at.target]);
    case Op::kForBegin:
      return begin_loop(at);
    case Op::kForNext:
      return next_of_loop(at);
  }
  return true;
}

Result<Value> Machine::run(const Code& code, std::uint32_t locals,
                           const std::vector<OwnFunction>& functions) {
  stack_.clear();
  loops_.clear();
  locals_.assign(locals, Value{});
  frames_.assign(1, {&code, 0, 0, 0});
  while (true) {
    Frame& frame = frames_.back();
    if (frame.next == frame.code->size()) {
      locals_.resize(frame.first_local);
      frames_.pop_back();
      if (frames_.empty()) break;
      continue;
    }
    const Instruction& at = (*frame.code)[frame.next++];
    if (!step(at, functions)) return *error_;
    if (++steps_ > kMostInstructions || script_.nodes.size() > kMostNodes) {
      return error_at(at.place, ErrorCode::kOutOfRange,
                      "the script makes too many parts");
    }
  }
  return pop();
}

}  // namespace halfspace::csg
