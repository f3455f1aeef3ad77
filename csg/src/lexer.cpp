#include "halfspace/csg/lexer.hpp"

#include <algorithm>
#include <cstdio>

namespace halfspace::csg {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

std::size_t digits_at(std::string_view text, std::size_t first) {
  std::size_t end = first;
  while (end < text.size() && is_digit(text[end])) ++end;
  return end - first;
}

/// How long the decimal at the front is; 0 if there is none.
std::size_t number_length(std::string_view text) {
  std::size_t length = digits_at(text, 0);
  bool any = length > 0;
  if (length < text.size() && text[length] == '.') {
    const std::size_t after = digits_at(text, length + 1);
    any = any || after > 0;
    length += 1 + after;
  }
  if (!any) return 0;
  if (length < text.size() && (text[length] == 'e' || text[length] == 'E')) {
    std::size_t first = length + 1;
    if (first < text.size() && (text[first] == '-' || text[first] == '+'))
      ++first;
    const std::size_t digits = digits_at(text, first);
    if (digits > 0) length = first + digits;
  }
  return length;
}

std::size_t name_length(std::string_view text) {
  if (text.empty() || !is_letter(text[0])) return 0;
  std::size_t length = 1;
  while (length < text.size() &&
         (is_letter(text[length]) || is_digit(text[length])))
    ++length;
  return length;
}

}  // namespace

std::string to_string(const Place& place) {
  return "line " + std::to_string(place.line) + ", column " +
         std::to_string(place.column);
}

Error error_at(const Place& place, ErrorCode code,
               const std::string& sentence) {
  if (place.line == 0) return {code, sentence};
  return {code, to_string(place) + ": " + sentence, place.line};
}

std::string described(const Token& token) {
  switch (token.kind) {
    case TokenKind::kLineEnd:
      return "the end of the line";
    case TokenKind::kEnd:
      return "the end";
    case TokenKind::kText:
      return "the file " + in_quotes(token.text);
    default:
      return in_quotes(token.text);
  }
}

bool is_name(std::string_view text) {
  return !text.empty() && name_length(text) == text.size();
}

Lexer::Lexer(std::string_view text) : rest_(text) {
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  if (rest_.starts_with(kByteOrderMark))
    rest_.remove_prefix(kByteOrderMark.size());
}

Token Lexer::taken(TokenKind kind, std::size_t length) {
  const Token token{kind, rest_.substr(0, length), place_};
  rest_.remove_prefix(length);
  place_.column += static_cast<std::int32_t>(length);
  return token;
}

void Lexer::pass_over() {
  const auto is_blank = [](char c) {
    return c == ' ' || c == '\t' || c == '\r';
  };
  std::size_t length = 0;
  while (length < rest_.size() && is_blank(rest_[length])) ++length;
  if (length < rest_.size() && rest_[length] == '#')
    length = std::min(rest_.find('\n', length), rest_.size());
  taken(TokenKind::kEnd, length);
}

Result<Token> Lexer::next_text() {
  const std::size_t end = rest_.find_first_of(
      rest_[0] == '"' ? std::string_view("\"\n") : std::string_view("'\n"), 1);
  if (end == std::string_view::npos || rest_[end] == '\n') {
    return error_at(place_, ErrorCode::kSyntax,
                    "these quotes do not end in their line");
  }
  Token token = taken(TokenKind::kText, end + 1);
  token.text = token.text.substr(1, end - 1);
  return token;
}

Result<Token> Lexer::next() {
  pass_over();
  if (rest_.empty()) return Token{TokenKind::kEnd, {}, place_};
  const char c = rest_[0];
  if (c == '\n') {
    const Token token = taken(TokenKind::kLineEnd, 1);
    place_ = {place_.line + 1, 1};
    return token;
  }
  if (c == '"' || c == '\'') return next_text();
  if (const std::size_t length = name_length(rest_))
    return taken(TokenKind::kName, length);
  if (const std::size_t length = number_length(rest_))
    return taken(TokenKind::kNumber, length);
  if (c != '\0' &&
      std::string_view("(),=;|&-+^~<>*/[]:").find(c) != std::string_view::npos)
    return taken(TokenKind::kSymbol, 1);
  const auto byte = static_cast<unsigned char>(c);
  if (byte > 0x20 && byte < 0x7f) {
    const char* hint = "";
    if (c == '.' || c == '\\') hint = "; names of files stand in quotes";
    if (c == '{') hint = "; solids stand in round brackets, as in union(A, B)";
    return error_at(
        place_, ErrorCode::kSyntax,
        "nothing begins with " + in_quotes(rest_.substr(0, 1)) + hint);
  }
  char text[40];
  std::snprintf(text, sizeof text, "nothing begins with the byte 0x%02x",
                static_cast<unsigned>(byte));
  return error_at(place_, ErrorCode::kSyntax, text);
}

}  // namespace halfspace::csg
