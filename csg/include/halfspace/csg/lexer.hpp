#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "halfspace/message.hpp"
#include "halfspace/result.hpp"

namespace halfspace::csg {

/// A place in a text. Units: bytes from 1, in a line from 1. Line 0: none, as
/// where a script was made by a program; messages then name no place.
struct Place {
  std::int32_t line = 1;
  std::int32_t column = 1;
  friend bool operator==(const Place&, const Place&) = default;
};

/// The place in words, such as `line 2, column 7`.
std::string to_string(const Place& place);

/// An error at a place in a script.
Error error_at(const Place& place, ErrorCode code, const std::string& sentence);

/// What a script is made of.
enum class TokenKind : std::uint8_t {
  kName,     ///< letters, digits and underscores, no digit first
  kNumber,   ///< an unsigned decimal; what it is worth is not checked
  kText,     ///< a file's name in quotes
  kSymbol,   ///< one character: ( ) [ ] , : = ; | & - + * / ^ ~ < >
  kLineEnd,  ///< the end of a line
  kEnd,      ///< the end of the script, and all after it
};

struct Token {
  TokenKind kind = TokenKind::kEnd;
  std::string_view text;  ///< of a kText, without its quotes
  Place place;
  bool is(char symbol) const {
    return kind == TokenKind::kSymbol && text.front() == symbol;
  }
};

/// The token in words for an error, such as `'&'` or `the end of the line`.
std::string described(const Token& token);

/// Whether the text is one name, such as the operand of an expression has.
bool is_name(std::string_view text);

/// Takes a script apart. Blanks, carriage returns and comments, from `#` to the
/// end of the line, are passed over, and so is a byte order mark.
class Lexer {
 public:
  /// Requires: fewer than 2^31 bytes, which outlive the tokens.
  explicit Lexer(std::string_view text);

  /// The next token.
  /// Errors: kSyntax (a character that begins none; quotes that do not end in
  ///         their line).
  Result<Token> next();

 private:
  Token taken(TokenKind kind, std::size_t length);
  Result<Token> next_text();
  void pass_over();

  std::string_view rest_;
  Place place_;
};

}  // namespace halfspace::csg
