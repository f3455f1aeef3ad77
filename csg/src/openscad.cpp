#include "halfspace/csg/openscad.hpp"

#include <cstddef>
#include <utility>

#include "openscad/scad_parser.hpp"
#include "openscad/scad_tokens.hpp"
#include "openscad/scad_translator.hpp"

namespace halfspace::csg {

bool is_openscad(std::string_view text) {
  ScadTokens tokens(text);
  ScadToken token = tokens.next();
  while (token.is('%') || token.is('#') || token.is('!') || token.is('*'))
    token = tokens.next();
  if (token.kind != ScadToken::Kind::kWord || !tokens.next().is('('))
    return false;
  token = tokens.next();
  if (token.is(')')) {
    const ScadToken after = tokens.next();
    return after.is('{') || after.is(';');
  }
  if (token.kind == ScadToken::Kind::kWord) return tokens.next().is('=');
  return token.is('[') && tokens.next().is('[');
}

Result<Script> read_openscad(std::string_view text) {
  if (text.size() >= std::size_t{1} << 31) {
    return Error{ErrorCode::kOutOfRange,
                 "a script must have fewer than 2^31 bytes", -1};
  }
  ScadParser parser(text);
  ScadTranslator translator;
  while (!parser.is_at_end() || translator.is_within()) {
    bool closes = translator.is_within() && parser.takes('}');
    if (!closes) {
      if (parser.takes(';')) continue;
      Result<ScadCall> call = parser.call();
      if (!call) return call.error();
      closes = call->is_leaf;
      if (auto error = translator.open(*std::move(call))) return *error;
    }
    if (!closes) continue;
    if (auto error = translator.close()) return *error;
  }
  return translator.script();
}

}  // namespace halfspace::csg
