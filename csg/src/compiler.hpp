#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "code.hpp"
#include "halfspace/csg/lexer.hpp"

namespace halfspace::csg {

/// A statement, taken apart.
struct Statement {
  enum class Kind : std::uint8_t { kValue, kFunction, kEnd } kind;
  std::string_view name;  ///< of kValue; empty: it has none
  Place place;
  Code code;
  std::uint32_t locals = 0;  ///< that the code has
};

/// Compiles a script, a statement at a time, into code that leaves one value.
///
/// A shunting yard: operators wait on a stack of their own until all that binds
/// more strongly has been done. No recursion.
class Compiler {
 public:
  explicit Compiler(std::string_view text) : lexer_(text) {}

  /// The next statement; a function goes to `functions`, too.
  /// Errors: kSyntax, kBadIndex, kOutOfRange, with the place.
  Result<Statement> next(std::vector<OwnFunction>& functions);

 private:
  /// What has been opened, or waits for its second operand.
  struct Pending {
    enum class Kind : std::uint8_t {
      kBracket,
      kCall,
      kList,
      kIndex,
      kForSource,
      kForBody,
      kOperator
    } kind;
    Instruction instruction;  ///< of kOperator and kCall
    int strength = 0;         ///< of kOperator
    std::uint32_t count = 0;  ///< of values that have been closed by commas
    std::uint32_t begin = 0;  ///< of kForBody: its kForBegin
    Place place;
  };

  bool fail(const Place& place, ErrorCode code, const std::string& sentence) {
    error_ = error_at(place, code, sentence);
    return false;
  }
  bool unexpected(const std::string& wanted, const std::string& hint = {}) {
    return fail(token_.place, ErrorCode::kSyntax,
                "expected " + wanted + ", not " + described(token_) + hint);
  }
  bool advance();
  bool pass_over_lines();
  bool statement(Statement& made, std::vector<OwnFunction>& functions);
  bool function_head(std::string_view& name);
  bool named(Statement& made);
  bool expression();
  bool operand(bool& complete);
  bool name_or_call(bool& complete);
  bool open_call(const Token& name, bool& complete);
  bool open_list();
  bool operation(bool& complete, bool& done);
  std::string meant_after_operand() const;
  bool separate(bool& complete);
  bool begin_body(bool& complete);
  void emit_closed(Pending& top, std::uint32_t count);
  bool close(bool& complete);
  void reduce(int strength);
  void emit(Instruction instruction) {
    code_.push_back(std::move(instruction));
  }
  void wait_for_operand(Op op, NodeKind operation, int strength);
  bool is_open() const { return depth_ > 0; }

  Lexer lexer_;
  Token token_;
  bool begun_ = false;
  Code code_;
  std::vector<Pending> pending_;
  std::size_t depth_ = 0;  // how many of them are open
  std::vector<std::string_view> locals_;
  std::uint32_t most_locals_ = 0;
  const std::vector<OwnFunction>* functions_ = nullptr;
  std::optional<Error> error_;
};

}  // namespace halfspace::csg
