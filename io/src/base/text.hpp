#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "halfspace/message.hpp"
#include "halfspace/result.hpp"

namespace halfspace::io {

/// Whether the two are equal but for the case of letters.
/// Requires: `lower` is lower case.
bool is_word(std::string_view token, std::string_view lower);

/// The error that bytes give which are no text of bytes: UTF-16 or UTF-32, or
/// with zero bytes.
std::optional<Error> not_plain_text(std::string_view bytes);

/// The integer that all of `token` spells.
/// Errors: kSyntax, kOutOfRange (beyond 63 bits).
Result<std::int64_t> parse_integer(std::string_view token);

/// Reads the double that all of `token` spells, as std::from_chars() does: also
/// where the standard library has that for integers alone.
/// Errors: invalid_argument; result_out_of_range, where `value` stays.
std::errc read_double(std::string_view token, double& value);

/// The double that all of `token` spells; NaN where that is none, or not
/// finite.
double value_or_none(std::string_view token);

/// A number with so many digits after its point, as printf's "%.*f" has it:
/// the nearest such decimal, and of two the even one. Exact.
///
/// It stands in for std::to_chars(), whose tables for this are a sixteenth of
/// the web's module.
/// Requires: the value is finite; decimals >= 0.
std::string fixed_point(double value, int decimals);

/// The tokens with one blank between them.
std::string joined(std::span<const std::string_view> tokens);

/// Cuts a text into lines and tokens.
class TextReader {
 public:
  /// What starts a comment, and whether a backslash before the end of a line
  /// joins the next line to it.
  struct Rules {
    bool comments = false;   ///< from `#` to the end of the line
    bool continued = false;  ///< a backslash ends a line that goes on
  };
  TextReader(std::string_view text, Rules rules);

  /// Goes to the next line that has tokens; false where there is none.
  bool next_line();

  /// The next token, of this line or a later one; false where there is none.
  bool next(std::string_view& token);

  /// Whether next() would find nothing; goes on to the next line if this one
  /// is used up.
  bool at_end() { return used_ == tokens_.size() && !next_line(); }

  /// The tokens of this line that next() has not given yet.
  std::span<const std::string_view> left() const {
    return std::span(tokens_).subspan(used_);
  }
  /// Takes all of left().
  void skip_line() { used_ = tokens_.size(); }

  /// The number of the line, from 1; of a joined line that of the first.
  std::int64_t line() const { return line_; }

  /// Whether this is the last line and lacks its line feed.
  bool is_cut() const { return is_cut_; }

  /// An error at this line; a syntax error in a line that is cut is taken for
  /// a file that ends too early.
  Error error(ErrorCode code, const std::string& what) const;

  /// What follows this line.
  std::string_view rest() const { return rest_; }

 private:
  bool take_tokens(std::string_view line);

  std::string_view rest_;
  Rules rules_;
  std::vector<std::string_view> tokens_;
  std::size_t used_ = 0;
  std::int64_t line_ = 0;
  std::int64_t next_number_ = 1;
  bool is_cut_ = false;
};

}  // namespace halfspace::io
