#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "halfspace/int128.hpp"
#include "halfspace/message.hpp"
#include "halfspace/result.hpp"

namespace halfspace {

/// Whether a token has a digit, only digits, and perhaps a sign before them.
bool is_integer(std::string_view token);

/// A text as lines of tokens, read one at a time, and the first error found.
/// The rest of a line from '#' on is a comment; lines without tokens are
/// passed over.
class TokenLines {
 public:
  explicit TokenLines(std::string_view text) : rest_(text) {}

 protected:
  /// Makes `tokens_` those of the next line that has any; false at the end.
  bool next_line();

  /// Notes the error; returns false. A bad line without a line feed may be half
  /// of one, so the file is cut off there, whatever else is wrong with it.
  bool fail(ErrorCode code, const std::string& what);

  /// Reads a token of the line as an integer within limits, or fails.
  bool integer(std::size_t token, Int128 least, Int128 most, Int128& value);
  template <class Int>
  bool integer(std::size_t token, Int128 least, Int128 most, Int& value) {
    Int128 wide = 0;
    if (!integer(token, least, most, wide)) return false;
    value = static_cast<Int>(wide);
    return true;
  }

  /// Whether `values` values follow the line's first token; fails if not.
  bool count_is(std::size_t values);

  std::vector<std::string_view> tokens_;  // of the current line
  std::int64_t line_ = 0;
  bool line_ended_ = true;  // the current line has its line feed
  std::optional<Error> error_;

 private:
  std::string_view rest_;
};

}  // namespace halfspace
