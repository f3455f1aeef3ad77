#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "halfspace/csg/script.hpp"
#include "halfspace/io/number.hpp"
#include "halfspace/result.hpp"
#include "scad_tokens.hpp"

namespace halfspace::csg {

/// The value of an argument: a number, a word, or lists of numbers, at most a
/// list of lists.
struct ScadArgument {
  std::string_view name;
  std::string_view word;  ///< of true, false, undef and texts
  bool is_text = false;
  std::vector<std::vector<io::Number>> rows;  ///< a number: one row of one
  bool is_list = false;
};

/// A call as it is written, and its children as nodes of a script once they are
/// there.
struct ScadCall {
  std::string_view name;
  Place place;
  std::vector<ScadArgument> arguments;
  std::vector<std::int32_t> children;
  bool is_hidden = false;  ///< marked as background
  bool is_leaf = false;    ///< ends in `;`: there are no children

  /// The argument of a name; null where there is none.
  const ScadArgument* argument(std::string_view wanted) const;
  std::optional<io::Number> number(std::string_view wanted) const;
  bool is_true(std::string_view wanted) const;
};

/// Reads the calls of an OpenSCAD `.csg` one after another.
class ScadParser {
 public:
  explicit ScadParser(std::string_view text) : tokens_(text) { advance(); }

  bool is_at_end() const { return token_.kind == ScadToken::Kind::kEnd; }
  /// Passes over the symbol, if it comes next.
  bool takes(char symbol);
  /// A call up to its `{` or `;`. Errors: kSyntax, kOutOfRange.
  Result<ScadCall> call();

 private:
  bool fail(const Place& place, ErrorCode code, const std::string& sentence);
  bool unexpected(const std::string& wanted);
  void advance() { token_ = tokens_.next(); }
  bool head(ScadCall& call);
  bool arguments(ScadCall& call);
  bool value(ScadArgument& argument);
  bool number(io::Number& value);

  ScadTokens tokens_;
  ScadToken token_{ScadToken::Kind::kEnd, {}, {}};
  std::optional<Error> error_;
};

}  // namespace halfspace::csg
