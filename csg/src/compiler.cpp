#include "compiler.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace halfspace::csg {
namespace {

/// How strongly operators bind.
constexpr int kStrengthOfSum = 1;
constexpr int kStrengthOfIntersection = 2;
constexpr int kStrengthOfProduct = 3;
constexpr int kStrengthOfSign = 4;

constexpr std::uint32_t kMostLocals = 1000;

}  // namespace

bool Compiler::advance() {
  Result<Token> next = lexer_.next();
  if (!next) {
    error_ = next.error();
    return false;
  }
  token_ = *next;
  return true;
}

bool Compiler::pass_over_lines() {
  while (token_.kind == TokenKind::kLineEnd) {
    if (!advance()) return false;
  }
  return true;
}

/// Does the operators on top that bind at least so strongly.
void Compiler::reduce(int strength) {
  while (!pending_.empty() &&
         pending_.back().kind == Pending::Kind::kOperator &&
         pending_.back().strength >= strength) {
    emit(std::move(pending_.back().instruction));
    pending_.pop_back();
  }
}

void Compiler::wait_for_operand(Op op, NodeKind operation, int strength) {
  Pending pending{.kind = Pending::Kind::kOperator,
                  .instruction = {},
                  .strength = strength,
                  .place = token_.place};
  pending.instruction.op = op;
  pending.instruction.operation = operation;
  pending.instruction.place = token_.place;
  pending_.push_back(std::move(pending));
}

/// A token where an operand begins; `complete`: it was a whole one.
bool Compiler::operand(bool& complete) {
  complete = false;
  if (token_.kind == TokenKind::kLineEnd) return advance();
  if (token_.is('~') || token_.is('-') || token_.is('+')) {
    if (!token_.is('+')) {
      wait_for_operand(token_.is('~') ? Op::kComplement : Op::kNegate,
                       NodeKind::kComplement, kStrengthOfSign);
    }
    return advance();
  }
  if (token_.is('(')) {
    pending_.push_back({.kind = Pending::Kind::kBracket,
                        .instruction = {},
                        .place = token_.place});
    ++depth_;
    return advance();
  }
  if (token_.is('[')) return open_list();
  const bool may_be_empty =
      !pending_.empty() && pending_.back().count == 0 &&
      ((token_.is(')') && pending_.back().kind == Pending::Kind::kCall) ||
       (token_.is(']') && pending_.back().kind == Pending::Kind::kList));
  if (may_be_empty) {
    return close(complete);
  }
  Instruction made;
  made.place = token_.place;
  if (token_.kind == TokenKind::kText) {
    if (token_.text.empty())
      return fail(token_.place, ErrorCode::kSyntax, "the file has no name");
    made.op = Op::kFile;
    made.name = token_.text;
  } else if (token_.kind == TokenKind::kNumber) {
    Result<io::Number> number = number_in(token_, false);
    if (!number) {
      error_ = number.error();
      return false;
    }
    made.number = *std::move(number);
  } else if (token_.kind == TokenKind::kName) {
    return name_or_call(complete);
  } else {
    return unexpected("a solid");
  }
  emit(std::move(made));
  complete = true;
  return advance();
}

bool Compiler::name_or_call(bool& complete) {
  const Token name = token_;
  if (!advance()) return false;
  if (token_.is('(')) return open_call(name, complete);
  if (name.text == "for" && token_.kind == TokenKind::kName)
    return fail(name.place, ErrorCode::kSyntax,
                "for stands in square brackets: [for i in range(3): ...]");
  if (is_function(name.text)) return unexpected("'('");
  Instruction made;
  made.op = Op::kLoad;
  made.place = name.place;
  made.name = name.text;
  const auto local = std::find(locals_.rbegin(), locals_.rend(), name.text);
  if (local != locals_.rend()) {
    made.op = Op::kLoadLocal;
    made.count = static_cast<std::uint32_t>(locals_.rend() - local - 1);
  }
  emit(std::move(made));
  complete = true;
  return true;
}

/// A function's name, before its bracket.
bool Compiler::open_call(const Token& name, bool& complete) {
  Pending pending{
      .kind = Pending::Kind::kCall, .instruction = {}, .place = name.place};
  Instruction& call = pending.instruction;
  call.place = name.place;
  call.name = name.text;
  const auto own =
      std::find_if(functions_->rbegin(), functions_->rend(),
                   [&](const OwnFunction& f) { return f.name == name.text; });
  const auto which = function_named(name.text);
  if (own != functions_->rend()) {
    call.op = Op::kCallOwn;
    call.target = static_cast<std::uint32_t>(functions_->rend() - own - 1);
  } else if (which) {
    call.op = Op::kCall;
    call.function = *which;
  } else {
    error_ = no_function(name);
    return false;
  }
  if (!advance() || !pass_over_lines()) return false;
  if (call.op == Op::kCall && call.function == Function::kHalf &&
      token_.kind == TokenKind::kName &&
      std::string_view("xyz").find(token_.text) != std::string_view::npos) {
    // `half(x < 5)`, or numbers that begin with a name.
    const Lexer here = lexer_;
    const Token axis = token_;
    if (!advance()) return false;
    if (token_.is('<') || token_.is('>')) {
      call.op = Op::kHalf;
      call.count =
          static_cast<std::uint32_t>(std::string_view("xyz").find(axis.text));
      call.target = token_.is('<') ? 1 : 0;
      if (!advance()) return false;
    } else {
      lexer_ = here;
      token_ = axis;
    }
  }
  complete = false;
  pending_.push_back(std::move(pending));
  ++depth_;
  return true;
}

/// `[`, and for `[for NAME in` all of that.
bool Compiler::open_list() {
  Pending pending{
      .kind = Pending::Kind::kList, .instruction = {}, .place = token_.place};
  if (!advance() || !pass_over_lines()) return false;
  if (token_.kind == TokenKind::kName && token_.text == "for") {
    pending.kind = Pending::Kind::kForSource;
    pending.instruction.place = token_.place;
    if (!advance()) return false;
    if (token_.kind != TokenKind::kName) return unexpected("a name");
    pending.instruction.name = token_.text;
    if (!advance()) return false;
    if (token_.kind != TokenKind::kName || token_.text != "in")
      return unexpected("'in'");
    if (!advance()) return false;
  }
  pending_.push_back(std::move(pending));
  ++depth_;
  return true;
}

/// A comma between values.
bool Compiler::separate(bool& complete) {
  using Kind = Pending::Kind;
  Pending& top = pending_.back();
  if (top.kind != Kind::kCall && top.kind != Kind::kList)
    return unexpected(top.kind == Kind::kForSource ? "an operator or ':'"
                                                   : "an operator or ')'");
  ++top.count;
  complete = false;
  return advance();
}

/// The colon after a loop's list.
bool Compiler::begin_body(bool& complete) {
  Pending& top = pending_.back();
  if (top.kind != Pending::Kind::kForSource) return unexpected("an operator");
  locals_.push_back(top.instruction.name);
  most_locals_ =
      std::max(most_locals_, static_cast<std::uint32_t>(locals_.size()));
  if (locals_.size() > kMostLocals)
    return fail(token_.place, ErrorCode::kOutOfRange,
                "there are over 1000 names here");
  Instruction begin;
  begin.op = Op::kForBegin;
  begin.place = top.instruction.place;
  begin.count = static_cast<std::uint32_t>(locals_.size() - 1);
  top.begin = static_cast<std::uint32_t>(code_.size());
  emit(std::move(begin));
  top.kind = Pending::Kind::kForBody;
  complete = false;
  return advance();
}

/// The instruction of a closed bracket with this number of values.
void Compiler::emit_closed(Pending& top, std::uint32_t count) {
  using Kind = Pending::Kind;
  Instruction made = std::move(top.instruction);
  if (top.kind == Kind::kBracket) return;
  if (top.kind == Kind::kCall) {
    if (made.op != Op::kHalf) made.count = count;
    return emit(std::move(made));
  }
  if (top.kind == Kind::kForBody) {
    made.op = Op::kForNext;
    made.count = static_cast<std::uint32_t>(locals_.size() - 1);
    made.target = top.begin + 1;
    emit(std::move(made));
    code_[top.begin].target = static_cast<std::uint32_t>(code_.size());
    return locals_.pop_back();
  }
  made = {};
  made.op = top.kind == Kind::kList ? Op::kList : Op::kIndex;
  made.place = top.place;
  made.count = count;
  emit(std::move(made));
}

/// A closing bracket, a comma or a colon. `complete` is false before it where
/// there is nothing between the brackets.
bool Compiler::close(bool& complete) {
  reduce(0);
  // Above what is open no operator is left.
  if (pending_.empty()) {
    if (token_.is(',') || token_.is(':')) return unexpected("an operator");
    return fail(token_.place, ErrorCode::kSyntax,
                "this bracket was never opened");
  }
  if (token_.is(',')) return separate(complete);
  if (token_.is(':')) return begin_body(complete);
  using Kind = Pending::Kind;
  Pending& top = pending_.back();
  const bool is_round = top.kind == Kind::kBracket || top.kind == Kind::kCall;
  if (token_.is(']') == is_round)
    return unexpected(is_round ? "an operator or ')'" : "an operator or ']'");
  if (top.kind == Kind::kForSource) return unexpected("':'");
  emit_closed(top, top.count + (complete ? 1 : 0));
  pending_.pop_back();
  --depth_;
  complete = true;
  return advance();
}

/// A token after an operand; `complete`: another operator may follow; `done`:
/// the expression has ended before it.
bool Compiler::operation(bool& complete, bool& done) {
  struct Operator {
    char symbol;
    Op op;
    NodeKind operation;
    int strength;
  };
  constexpr Operator kOperators[] = {
      {'|', Op::kCombine, NodeKind::kUnion, kStrengthOfSum},
      {'-', Op::kCombine, NodeKind::kDifference, kStrengthOfSum},
      {'^', Op::kCombine, NodeKind::kSymmetricDifference, kStrengthOfSum},
      {'+', Op::kAdd, NodeKind::kUnion, kStrengthOfSum},
      {'&', Op::kCombine, NodeKind::kIntersection, kStrengthOfIntersection},
      {'*', Op::kMultiply, NodeKind::kUnion, kStrengthOfProduct},
      {'/', Op::kDivide, NodeKind::kUnion, kStrengthOfProduct}};
  for (const Operator& op : kOperators) {
    if (!token_.is(op.symbol)) continue;
    reduce(op.strength);
    wait_for_operand(op.op, op.operation, op.strength);
    complete = false;
    return advance();
  }
  if (token_.is('[')) {
    pending_.push_back({.kind = Pending::Kind::kIndex,
                        .instruction = {},
                        .place = token_.place});
    ++depth_;
    complete = false;
    return advance();
  }
  for (const char symbol : {')', ']', ',', ':'}) {
    if (token_.is(symbol)) return close(complete);
  }
  const bool is_end = token_.kind == TokenKind::kEnd || token_.is(';');
  if (token_.kind == TokenKind::kLineEnd && is_open()) return advance();
  if (is_end || token_.kind == TokenKind::kLineEnd) {
    reduce(0);
    done = true;
    if (!is_open()) return true;
    return fail(pending_.back().place, ErrorCode::kSyntax,
                "this bracket is never closed");
  }
  return unexpected("an operator", meant_after_operand());
}

/// What is said to who writes here what other languages have after an operand.
std::string Compiler::meant_after_operand() const {
  if (token_.is('=') && is_open())
    return "; arguments have an order, and no names";
  if (token_.kind != TokenKind::kName) return {};
  constexpr std::string_view kWords[] = {
      "and",     "or",       "xor",          "plus",
      "minus",   "union",    "difference",   "unite",
      "without", "subtract", "intersection", "intersect"};
  if (std::count(std::begin(kWords), std::end(kWords), token_.text) > 0)
    return "; the operators on solids are | & - ^";
  if (!code_.empty() && code_.back().op == Op::kCall &&
      code_.back().function <= Function::kMirror)
    return "; the solid is the first argument, as in translate(S, 1, 2, 3)";
  return {};
}

/// An expression, whose value its code leaves.
bool Compiler::expression() {
  code_.clear();
  pending_.clear();
  depth_ = 0;
  most_locals_ = static_cast<std::uint32_t>(locals_.size());
  bool complete = false;
  bool done = false;
  while (!done) {
    if (!(complete ? operation(complete, done) : operand(complete)))
      return false;
  }
  return true;
}

/// What stands between `def` and `=`: the function's name and parameters.
bool Compiler::function_head(std::string_view& name) {
  if (token_.kind != TokenKind::kName) return unexpected("a name");
  if (is_function(token_.text)) {
    return fail(token_.place, ErrorCode::kSyntax,
                in_quotes(token_.text) + " is a function already");
  }
  name = token_.text;
  if (!advance()) return false;
  if (!token_.is('(')) return unexpected("'('");
  if (!advance()) return false;
  while (!token_.is(')')) {
    if (token_.kind != TokenKind::kName || is_function(token_.text))
      return unexpected("the name of a parameter");
    if (locals_.size() >= kMostLocals)
      return fail(token_.place, ErrorCode::kOutOfRange,
                  "there are over 1000 parameters");
    locals_.push_back(token_.text);
    if (!advance()) return false;
    if (token_.is(',')) {
      if (!advance()) return false;
    } else if (!token_.is(')')) {
      return unexpected("',' or ')'");
    }
  }
  if (!advance()) return false;
  if (!token_.is('=')) return unexpected("'='");
  return advance();
}

/// `name =`, if it is there.
bool Compiler::named(Statement& made) {
  if (token_.kind != TokenKind::kName || is_function(token_.text)) return true;
  const Lexer here = lexer_;
  const Token first = token_;
  if (!advance()) return false;
  if (token_.is('=')) {
    made.name = first.text;
    return advance();
  }
  lexer_ = here;
  token_ = first;
  return true;
}

bool Compiler::statement(Statement& made, std::vector<OwnFunction>& functions) {
  made.kind = Statement::Kind::kValue;
  made.place = token_.place;
  locals_.clear();
  functions_ = &functions;
  const Lexer here = lexer_;
  const Token first = token_;
  bool is_definition = false;
  if (token_.kind == TokenKind::kName && token_.text == "def") {
    if (!advance()) return false;
    is_definition = token_.kind == TokenKind::kName;
    if (!is_definition) {
      lexer_ = here;
      token_ = first;
    }
  }
  if (is_definition) {
    OwnFunction function;
    if (!function_head(function.name)) return false;
    function.parameters = static_cast<std::uint32_t>(locals_.size());
    if (!expression()) return false;
    function.locals = most_locals_;
    function.code = std::move(code_);
    functions.push_back(std::move(function));
    made.kind = Statement::Kind::kFunction;
  } else {
    if (!named(made) || !expression()) return false;
    made.code = std::move(code_);
    made.locals = most_locals_;
  }
  while (token_.is(';') || token_.kind == TokenKind::kLineEnd) {
    if (!advance()) return false;
  }
  const bool is_nameless = !is_definition && made.name.empty();
  if (is_nameless && token_.kind != TokenKind::kEnd) {
    return fail(made.place, ErrorCode::kSyntax,
                "only the last statement may do without `name =`");
  }
  return true;
}

Result<Statement> Compiler::next(std::vector<OwnFunction>& functions) {
  Statement made{};
  if (!begun_) {
    begun_ = true;
    if (!advance()) return *error_;
    while (token_.is(';') || token_.kind == TokenKind::kLineEnd) {
      if (!advance()) return *error_;
    }
  }
  if (token_.kind == TokenKind::kEnd) {
    made.kind = Statement::Kind::kEnd;
    made.place = token_.place;
    return made;
  }
  if (!statement(made, functions)) return *error_;
  return made;
}

}  // namespace halfspace::csg
