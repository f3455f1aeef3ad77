#pragma once

#include <fmt/format.h>

#include <CLI/App.hpp>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "cli/arguments.hpp"

namespace halfspace::tools {

/// A value of an option, and the word for it.
template <class T>
struct Word {
  std::string_view word;
  T value;
};

/// The word for a value. Requires: there is one.
template <class T, std::size_t N>
constexpr std::string_view word_of(const Word<T> (&words)[N], T value) {
  for (const Word<T>& word : words) {
    if (word.value == value) return word.word;
  }
  return {};
}

/// Adds the option `name`, whose value is what `parse` makes of its text. Where
/// that is nothing, the program says that the text must be `wanted`, and ends.
/// `form` stands for the text in the help. `Value` is T or std::optional<T>.
///
/// Requires: `value` outlives the parsing.
template <class Value, class Parse>
CLI::Option* add_parsed(CLI::App& app, const std::string& name,
                        const std::string& form, const std::string& wanted,
                        Value& value, Parse parse, const std::string& meaning) {
  const auto complain = [parse, wanted](const std::string& text) {
    return parse(text) ? std::string()
                       : fmt::format("must be {}, not '{}'", wanted, text);
  };
  const auto store = [parse, &value](const std::string& text) {
    value = *parse(text);
  };
  return app.add_option_function<std::string>(name, store, meaning)
      ->check(complain)
      ->type_name(form);
}

/// The same for a number from `least` to `most`.
template <class T>
CLI::Option* add_number(CLI::App& app, const std::string& name,
                        const std::string& form, std::optional<T>& value,
                        T least, T most, const std::string& meaning) {
  const auto parse = [least, most](std::string_view text) {
    const std::optional<T> number = parse_number<T>(text);
    return number && least <= *number && *number <= most ? number
                                                         : std::nullopt;
  };
  return add_parsed(
      app, name, form,
      fmt::format("a whole number of at least {} and at most {}", least, most),
      value, parse, meaning);
}

/// The same for any finite number.
inline CLI::Option* add_real(CLI::App& app, const std::string& name,
                             const std::string& form,
                             std::optional<double>& value,
                             const std::string& meaning) {
  return add_parsed(app, name, form, "a finite number", value,
                    parse_number<double>, meaning);
}

/// The same for a vector.
inline CLI::Option* add_vector(CLI::App& app, const std::string& name,
                               std::optional<glm::dvec3>& value,
                               const std::string& meaning) {
  return add_parsed(app, name, "X,Y,Z", "X,Y,Z, three finite numbers", value,
                    parse_vector, meaning);
}

/// The same for one of `words`, which are never destroyed.
template <class T, std::size_t N, class Value>
CLI::Option* add_choice(CLI::App& app, const std::string& name,
                        const Word<T> (&words)[N], Value& value,
                        const std::string& meaning) {
  std::string form;
  for (const Word<T>& word : words)
    form += (form.empty() ? "" : "|") + std::string(word.word);
  const auto parse = [&words](std::string_view text) {
    for (const Word<T>& word : words) {
      if (word.word == text) return std::optional<T>(std::in_place, word.value);
    }
    return std::optional<T>();
  };
  return add_parsed(app, name, form, form, value, parse, meaning);
}

}  // namespace halfspace::tools
