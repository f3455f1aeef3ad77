#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "functions.hpp"
#include "halfspace/csg/script.hpp"

namespace halfspace::csg {

/// What has been opened, or waits for its second operand.
struct Pending {
  enum class Kind : std::uint8_t { kBracket, kFunction, kOperator } kind;
  NodeKind operation = NodeKind::kUnion;     ///< of kOperator
  Function function = Function::kTranslate;  ///< of kFunction
  int strength = 0;                          ///< of kOperator
  Place place;
};

/// How strongly operators bind.
constexpr int kStrengthOfSum = 1;
constexpr int kStrengthOfProduct = 2;
constexpr int kStrengthOfComplement = 3;

/// A shunting yard: operators wait on a stack of their own until all that binds
/// more strongly has been done.
class Parser {
 public:
  Parser(std::string_view text, std::span<const Binding> bindings)
      : lexer_(text), bindings_(bindings), used_(bindings.size()) {}
  Result<Script> parse();

 private:
  bool fail(const Place& place, ErrorCode code, const std::string& sentence) {
    error_ = error_at(place, code, sentence);
    return false;
  }
  bool unexpected(const std::string& wanted) {
    return fail(token_.place, ErrorCode::kSyntax,
                "expected " + wanted + ", not " + described(token_));
  }
  bool advance();
  bool bind_names();
  bool statement();
  bool expression();
  bool operand(bool& complete);
  bool function();
  bool half(const Place& place);
  bool axis_half_of(const Place& place, std::size_t axis);
  bool numbers(std::vector<io::Number>& values);
  bool number(io::Number& value);
  bool operation(bool& complete, bool& done);
  bool close();
  bool close_function();
  void reduce(int strength);
  std::int32_t add(Node node);
  std::int32_t add_file(const std::string& path, const std::string& name);
  bool all_used();

  Lexer lexer_;
  std::span<const Binding> bindings_;
  std::vector<bool> used_;  // by binding
  Token token_;
  Script script_;
  std::map<std::string, std::int32_t, std::less<>> names_;  // to nodes
  std::map<std::string, std::size_t, std::less<>> bound_;   // to bindings
  std::map<std::pair<std::string, std::string>, std::int32_t> files_;
  std::vector<Pending> pending_;
  std::size_t depth_ = 0;  // how many of them are open
  std::vector<std::int32_t> operands_;
  std::optional<Error> error_;
};

}  // namespace halfspace::csg
