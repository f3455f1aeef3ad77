#include "token_lines.hpp"

#include <algorithm>

namespace halfspace {

bool is_integer(std::string_view token) {
  if (!token.empty() && (token[0] == '-' || token[0] == '+')) {
    token.remove_prefix(1);
  }
  return !token.empty() && std::all_of(token.begin(), token.end(), [](char c) {
    return c >= '0' && c <= '9';
  });
}

bool TokenLines::next_line() {
  tokens_.clear();
  while (tokens_.empty()) {
    if (rest_.empty()) return false;
    ++line_;
    const std::size_t feed = rest_.find('\n');
    line_ended_ = feed != std::string_view::npos;
    std::string_view line = rest_.substr(0, feed);
    rest_.remove_prefix(line_ended_ ? feed + 1 : rest_.size());
    line = line.substr(0, line.find('#'));
    constexpr std::string_view kBlank = " \t\r";
    for (std::size_t at = line.find_first_not_of(kBlank);
         at != std::string_view::npos; at = line.find_first_not_of(kBlank)) {
      line.remove_prefix(at);
      const std::string_view token = line.substr(0, line.find_first_of(kBlank));
      tokens_.push_back(token);
      line.remove_prefix(token.size());
    }
  }
  return true;
}

bool TokenLines::fail(ErrorCode code, const std::string& what) {
  const bool cut = !line_ended_;
  error_ = Error{cut ? ErrorCode::kTruncated : code,
                 "line " + std::to_string(line_) + ": " + what +
                     (cut ? ", where the file ends" : ""),
                 line_};
  return false;
}

bool TokenLines::integer(std::size_t token, Int128 least, Int128 most,
                         Int128& value) {
  const std::string_view text = tokens_[token];
  if (!is_integer(text)) {
    return fail(ErrorCode::kSyntax, in_quotes(text) + " is not an integer");
  }
  if (!parse_int128(text, value) || value < least || value > most) {
    return fail(ErrorCode::kOutOfRange, in_quotes(text) + " is not from " +
                                            to_string(least) + " to " +
                                            to_string(most));
  }
  return true;
}

bool TokenLines::count_is(std::size_t values) {
  if (tokens_.size() == values + 1) return true;
  return fail(ErrorCode::kSyntax, in_quotes(tokens_[0]) + " is followed by " +
                                      std::to_string(values) +
                                      (values == 1 ? " value" : " values") +
                                      ", not " +
                                      std::to_string(tokens_.size() - 1));
}

}  // namespace halfspace
