#include "options.hpp"

#include <algorithm>

namespace halfspace::tools {

namespace {

template <class Choice>
CLI::Option* add_any_choice(CLI::App& app, const std::string& name,
                            const std::vector<std::string>& words,
                            Choice& choice, const std::string& meaning) {
  std::string form;
  for (const std::string& word : words)
    form += (form.empty() ? "" : "|") + word;
  const auto place = [words](const std::string& text) {
    return std::find(words.begin(), words.end(), text) - words.begin();
  };
  const auto complain = [=](const std::string& text) {
    const bool known = static_cast<std::size_t>(place(text)) < words.size();
    return known ? std::string() : "must be " + form + ", not '" + text + "'";
  };
  const auto store = [place, &choice](const std::string& text) {
    choice = static_cast<std::size_t>(place(text));
  };
  return app.add_option_function<std::string>(name, store, meaning)
      ->check(complain)
      ->type_name(form);
}

}  // namespace

CLI::Option* add_choice(CLI::App& app, const std::string& name,
                        const std::vector<std::string>& words,
                        std::size_t& choice, const std::string& meaning) {
  return add_any_choice(app, name, words, choice, meaning);
}

CLI::Option* add_choice(CLI::App& app, const std::string& name,
                        const std::vector<std::string>& words,
                        std::optional<std::size_t>& choice,
                        const std::string& meaning) {
  return add_any_choice(app, name, words, choice, meaning);
}

}  // namespace halfspace::tools
