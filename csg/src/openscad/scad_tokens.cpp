#include "scad_tokens.hpp"

#include <algorithm>

namespace halfspace::csg {

void ScadTokens::skip(std::size_t count) {
  for (const char c : rest_.substr(0, count)) {
    place_ = c == '\n' ? Place{place_.line + 1, 1}
                       : Place{place_.line, place_.column + 1};
  }
  rest_.remove_prefix(count);
}

void ScadTokens::pass_over() {
  while (true) {
    const std::size_t blanks =
        std::min(rest_.find_first_not_of(" \t\r\n"), rest_.size());
    skip(blanks);
    if (rest_.starts_with("//"))
      skip(std::min(rest_.find('\n'), rest_.size()));
    else if (rest_.starts_with("/*"))
      skip(std::min(rest_.find("*/") + 2, rest_.size()));
    else
      return;
  }
}

ScadToken ScadTokens::taken(ScadToken::Kind kind, std::size_t length) {
  const ScadToken token{kind, rest_.substr(0, length), place_};
  skip(length);
  return token;
}

ScadToken ScadTokens::next() {
  pass_over();
  if (rest_.empty()) return {ScadToken::Kind::kEnd, {}, place_};
  const char c = rest_[0];
  constexpr std::string_view kLetters =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_$";
  constexpr std::string_view kInWord =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_$0123456789";
  constexpr std::string_view kInNumber = "0123456789.eE+-";
  if (kLetters.find(c) != kLetters.npos)
    return taken(ScadToken::Kind::kWord,
                 std::min(rest_.find_first_not_of(kInWord), rest_.size()));
  if (kInNumber.substr(0, 11).find(c) != kInNumber.npos || c == '-')
    return taken(ScadToken::Kind::kNumber,
                 std::min(rest_.find_first_not_of(kInNumber, 1), rest_.size()));
  if (c == '"') {
    std::size_t end = 1;
    while (end < rest_.size() && rest_[end] != '"')
      end += rest_[end] == '\\' ? 2u : 1u;
    ScadToken text =
        taken(ScadToken::Kind::kText, std::min(end + 1, rest_.size()));
    text.text =
        text.text.substr(1, text.text.size() < 2 ? 0 : text.text.size() - 2);
    return text;
  }
  return taken(ScadToken::Kind::kSymbol, 1);
}

}  // namespace halfspace::csg
