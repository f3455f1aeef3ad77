#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "halfspace/csg/script.hpp"

namespace halfspace::csg {

struct ScadToken {
  enum class Kind : std::uint8_t { kWord, kNumber, kText, kSymbol, kEnd } kind;
  std::string_view text;
  Place place;
  bool is(char symbol) const {
    return kind == Kind::kSymbol && text.front() == symbol;
  }
};

/// Takes the text apart; comments are passed over.
class ScadTokens {
 public:
  explicit ScadTokens(std::string_view text) : rest_(text) {}
  ScadToken next();

 private:
  void skip(std::size_t count);
  void pass_over();
  ScadToken taken(ScadToken::Kind kind, std::size_t length);

  std::string_view rest_;
  Place place_;
};

}  // namespace halfspace::csg
