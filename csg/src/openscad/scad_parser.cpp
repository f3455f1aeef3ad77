#include "scad_parser.hpp"

#include <utility>

#include "../functions.hpp"
#include "../numbers.hpp"
#include "halfspace/csg/lexer.hpp"

namespace halfspace::csg {

const ScadArgument* ScadCall::argument(std::string_view wanted) const {
  for (const ScadArgument& at : arguments) {
    if (at.name == wanted) return &at;
  }
  return nullptr;
}

std::optional<io::Number> ScadCall::number(std::string_view wanted) const {
  const ScadArgument* const at = argument(wanted);
  if (at == nullptr || at->is_list || at->rows.size() != 1) return std::nullopt;
  return at->rows[0][0];
}

bool ScadCall::is_true(std::string_view wanted) const {
  const ScadArgument* const at = argument(wanted);
  return at != nullptr && at->word == "true";
}

bool ScadParser::takes(char symbol) {
  if (!token_.is(symbol)) return false;
  advance();
  return true;
}

bool ScadParser::fail(const Place& place, ErrorCode code,
                      const std::string& sentence) {
  error_ = error_at(place, code, sentence);
  return false;
}

bool ScadParser::unexpected(const std::string& wanted) {
  const std::string found =
      token_.kind == ScadToken::Kind::kEnd ? "the end" : in_quotes(token_.text);
  return fail(token_.place, ErrorCode::kSyntax,
              "expected " + wanted + ", not " + found);
}

bool ScadParser::number(io::Number& value) {
  Result<io::Number> read = io::parse_number(token_.text);
  if (token_.kind != ScadToken::Kind::kNumber || !read)
    return unexpected("a number");
  if (!is_handy(*read)) {
    return fail(token_.place, ErrorCode::kOutOfRange,
                in_quotes(token_.text) + " has too many digits");
  }
  value = *std::move(read);
  advance();
  return true;
}

bool ScadParser::value(ScadArgument& argument) {
  if (token_.kind == ScadToken::Kind::kWord ||
      token_.kind == ScadToken::Kind::kText) {
    argument.is_text = token_.kind == ScadToken::Kind::kText;
    argument.word = token_.text;
    advance();
    return true;
  }
  if (!token_.is('[')) {
    argument.rows.resize(1);
    return number(argument.rows[0].emplace_back());
  }
  argument.is_list = true;
  std::size_t depth = 0;
  do {
    if (token_.is('[')) {
      if (++depth > 2) return unexpected("a number");
      argument.rows.emplace_back();
    } else if (token_.is(']')) {
      --depth;
    } else if (!token_.is(',')) {
      // Numbers after an inner list begin no row of their own.
      if (!number(argument.rows.back().emplace_back())) return false;
      continue;
    }
    advance();
  } while (depth > 0);
  // The first row is the outer list's own: empty where there are inner ones.
  if (argument.rows.size() > 1 && argument.rows.front().empty())
    argument.rows.erase(argument.rows.begin());
  return true;
}

bool ScadParser::arguments(ScadCall& call) {
  if (!token_.is('(')) return unexpected("'('");
  advance();
  while (!token_.is(')')) {
    ScadArgument& argument = call.arguments.emplace_back();
    if (token_.kind == ScadToken::Kind::kWord) {
      const ScadToken word = token_;
      advance();
      if (token_.is('=')) {
        argument.name = word.text;
        advance();
        if (!value(argument)) return false;
      } else {
        argument.word = word.text;
      }
    } else if (!value(argument)) {
      return false;
    }
    if (token_.is(',')) {
      advance();
    } else if (!token_.is(')')) {
      return unexpected("',' or ')'");
    }
  }
  advance();
  return true;
}

bool ScadParser::head(ScadCall& call) {
  while (token_.is('%') || token_.is('#') || token_.is('!') || token_.is('*')) {
    call.is_hidden = call.is_hidden || token_.is('%') || token_.is('*');
    advance();
  }
  if (token_.kind != ScadToken::Kind::kWord) return unexpected("a shape");
  call.name = token_.text;
  call.place = token_.place;
  advance();
  if (!arguments(call)) return false;
  call.is_leaf = token_.is(';');
  if (!call.is_leaf && !token_.is('{')) return unexpected("'{' or ';'");
  advance();
  return true;
}

Result<ScadCall> ScadParser::call() {
  ScadCall call;
  if (!head(call)) return *error_;
  return call;
}

}  // namespace halfspace::csg
