#pragma once

#include <CLI/App.hpp>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "arguments.hpp"

namespace halfspace::tools {

/// Adds the option `name`, whose text `parse` must understand; else the program
/// says that it wants `form`, and gives up.
///
/// Requires: `value` outlives the parsing.
template <class T>
CLI::Option* add_parsed(CLI::App& app, const std::string& name,
                        const std::string& form, std::optional<T>& value,
                        std::optional<T> (*parse)(std::string_view),
                        const std::string& meaning) {
  const auto complain = [parse, form](const std::string& text) {
    return parse(text) ? std::string()
                       : "must be " + spelt_out(form) + ", not '" + text + "'";
  };
  const auto store = [parse, &value](const std::string& text) {
    value = parse(text);
  };
  return app.add_option_function<std::string>(name, store, meaning)
      ->check(complain)
      ->type_name(form);
}

/// Adds the option `name`, whose text is one of `words`; `choice` is its index.
///
/// Requires: `choice` outlives the parsing.
CLI::Option* add_choice(CLI::App& app, const std::string& name,
                        const std::vector<std::string>& words,
                        std::size_t& choice, const std::string& meaning);

/// The same, where nothing may be said.
CLI::Option* add_choice(CLI::App& app, const std::string& name,
                        const std::vector<std::string>& words,
                        std::optional<std::size_t>& choice,
                        const std::string& meaning);

}  // namespace halfspace::tools
