#include "halfspace/message.hpp"

#include <cstddef>

namespace halfspace {

std::string in_quotes(std::string_view token) {
  constexpr std::size_t kLongest = 40;
  std::string text = "'";
  for (const char c : token.substr(0, kLongest)) {
    text.push_back(c >= ' ' && c <= '~' ? c : '?');
  }
  return text + (token.size() > kLongest ? "...'" : "'");
}

}  // namespace halfspace
