#include "parser.hpp"

#include <map>
#include <utility>

#include "halfspace/csg/script.hpp"

namespace halfspace::csg {
bool Parser::advance() {
  Result<Token> next = lexer_.next();
  if (!next) {
    error_ = next.error();
    return false;
  }
  token_ = *next;
  return true;
}

std::int32_t Parser::add(Node node) {
  script_.nodes.push_back(node);
  return static_cast<std::int32_t>(script_.nodes.size()) - 1;
}

std::int32_t Parser::add_file(const std::string& path,
                              const std::string& name) {
  const auto [at, is_new] = files_.try_emplace({path, name}, 0);
  if (is_new) {
    Node node{.place = token_.place};
    node.item = static_cast<std::int32_t>(script_.files.size());
    script_.files.push_back({path, name});
    at->second = add(node);
  }
  return at->second;
}

bool Parser::bind_names() {
  for (std::size_t i = 0; i < bindings_.size(); ++i) {
    const std::string& name = bindings_[i].name;
    const char* trouble = nullptr;
    if (!is_name(name)) trouble = " is not a name";
    if (is_function(name)) trouble = " is a function, not a name";
    if (!trouble && !bound_.try_emplace(name, i).second)
      trouble = " is bound twice";
    if (!trouble) continue;
    error_ = Error{ErrorCode::kSyntax, in_quotes(name) + trouble, -1};
    return false;
  }
  return true;
}

/// Does the operators on top that bind at least so strongly.
void Parser::reduce(int strength) {
  while (!pending_.empty() &&
         pending_.back().kind == Pending::Kind::kOperator &&
         pending_.back().strength >= strength) {
    Node node{.kind = pending_.back().operation,
              .place = pending_.back().place};
    if (node.kind != NodeKind::kComplement) {
      node.right = operands_.back();
      operands_.pop_back();
    }
    node.left = operands_.back();
    operands_.back() = add(node);
    pending_.pop_back();
  }
}

/// A token where an operand begins; `complete`: it was a whole one.
bool Parser::operand(bool& complete) {
  complete = false;
  if (token_.kind == TokenKind::kLineEnd) return advance();
  if (token_.is('~')) {
    pending_.push_back({.kind = Pending::Kind::kOperator,
                        .operation = NodeKind::kComplement,
                        .strength = kStrengthOfComplement,
                        .place = token_.place});
    return advance();
  }
  if (token_.is('(')) {
    pending_.push_back(
        {.kind = Pending::Kind::kBracket, .place = token_.place});
    ++depth_;
    return advance();
  }
  if (token_.kind == TokenKind::kText) {
    if (token_.text.empty())
      return fail(token_.place, ErrorCode::kSyntax, "the file has no name");
    operands_.push_back(add_file(std::string(token_.text), {}));
    complete = true;
    return advance();
  }
  if (token_.kind != TokenKind::kName) return unexpected("a solid");
  if (const auto which = function_named(token_.text)) {
    complete = *which == Function::kHalf;
    return function();
  }
  complete = true;
  const auto named = names_.find(token_.text);
  if (named != names_.end()) {
    operands_.push_back(named->second);
    return advance();
  }
  const auto bound = bound_.find(token_.text);
  if (bound == bound_.end()) {
    return fail(token_.place, ErrorCode::kBadIndex,
                in_quotes(token_.text) + " stands for nothing here");
  }
  const Binding& binding = bindings_[bound->second];
  used_[bound->second] = true;
  operands_.push_back(add_file(binding.path, binding.name));
  return advance();
}

/// A closing bracket, or the comma after a function's operand.
bool Parser::close() {
  reduce(0);
  // Above what is open no operator is left.
  const bool is_open = !pending_.empty();
  const bool in_function =
      is_open && pending_.back().kind == Pending::Kind::kFunction;
  if (token_.is(',')) {
    if (!in_function)
      return unexpected(is_open ? "an operator or ')'" : "an operator");
    return close_function();
  }
  if (!is_open) {
    return fail(token_.place, ErrorCode::kSyntax,
                "this bracket was never opened");
  }
  if (in_function) {
    return unexpected("',' and " + numbers_wanted(pending_.back().function));
  }
  pending_.pop_back();
  --depth_;
  return advance();
}

/// A token after an operand; `complete`: another operator may follow; `done`:
/// the expression has ended before it.
bool Parser::operation(bool& complete, bool& done) {
  struct Operator {
    char symbol;
    NodeKind operation;
    int strength;
  };
  constexpr Operator kOperators[] = {
      {'|', NodeKind::kUnion, kStrengthOfSum},
      {'-', NodeKind::kDifference, kStrengthOfSum},
      {'^', NodeKind::kSymmetricDifference, kStrengthOfSum},
      {'&', NodeKind::kIntersection, kStrengthOfProduct}};
  for (const Operator& op : kOperators) {
    if (!token_.is(op.symbol)) continue;
    reduce(op.strength);
    pending_.push_back({.kind = Pending::Kind::kOperator,
                        .operation = op.operation,
                        .strength = op.strength,
                        .place = token_.place});
    complete = false;
    return advance();
  }
  if (token_.is(')') || token_.is(',')) return close();
  const bool is_end = token_.kind == TokenKind::kEnd || token_.is(';');
  if (token_.kind == TokenKind::kLineEnd && depth_ > 0) return advance();
  if (is_end || token_.kind == TokenKind::kLineEnd) {
    reduce(0);
    done = true;
    if (depth_ == 0) return true;
    return fail(pending_.back().place, ErrorCode::kSyntax,
                "this bracket is never closed");
  }
  return unexpected("an operator");
}

/// An expression, whose node is then the only operand.
bool Parser::expression() {
  bool complete = false;
  bool done = false;
  while (!done) {
    if (!(complete ? operation(complete, done) : operand(complete)))
      return false;
  }
  return true;
}

/// A statement, and what ends it.
bool Parser::statement() {
  operands_.clear();
  std::string name;
  const Place place = token_.place;
  if (token_.kind == TokenKind::kName && !is_function(token_.text)) {
    // `name =`, or the first operand of an expression.
    const Lexer here = lexer_;
    const Token first = token_;
    if (!advance()) return false;
    if (token_.is('=')) {
      name = first.text;
      if (!advance()) return false;
    } else {
      lexer_ = here;
      token_ = first;
    }
  }
  if (!expression()) return false;
  script_.result = operands_.back();
  if (!name.empty()) {
    names_.insert_or_assign(name, script_.result);
  }
  while (token_.is(';') || token_.kind == TokenKind::kLineEnd) {
    if (!advance()) return false;
  }
  if (name.empty() && token_.kind != TokenKind::kEnd) {
    return fail(place, ErrorCode::kSyntax,
                "only the last statement may do without `name =`");
  }
  return true;
}

bool Parser::all_used() {
  for (std::size_t i = 0; i < bindings_.size(); ++i) {
    if (used_[i]) continue;
    error_ =
        Error{ErrorCode::kBadIndex,
              in_quotes(bindings_[i].name) + " is bound, but never used", -1};
    return false;
  }
  return true;
}

Result<Script> Parser::parse() {
  if (!bind_names() || !advance()) return *error_;
  while (token_.is(';') || token_.kind == TokenKind::kLineEnd) {
    if (!advance()) return *error_;
  }
  if (token_.kind == TokenKind::kEnd)
    return Error{ErrorCode::kEmpty, "there is no statement", -1};
  while (token_.kind != TokenKind::kEnd) {
    if (!statement()) return *error_;
  }
  if (!all_used()) return *error_;
  return std::move(script_);
}

Result<Script> parse_script(std::string_view text,
                            std::span<const Binding> bindings) {
  // Places and nodes are counted in 31 bits; a byte makes one node at most.
  if (text.size() >= std::size_t{1} << 31) {
    return Error{ErrorCode::kOutOfRange,
                 "a script must have fewer than 2^31 bytes", -1};
  }
  return Parser(text, bindings).parse();
}

}  // namespace halfspace::csg
