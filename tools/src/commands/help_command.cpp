#include <CLI/App.hpp>
#include <algorithm>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "cli/command.hpp"

namespace halfspace::tools {
namespace {

struct HelpArguments {
  std::string word;
  bool man = false;
  bool completion = false;
};

std::vector<const CLI::App*> commands_of(const CLI::App& program) {
  return program.get_subcommands([](const CLI::App*) { return true; });
}

std::vector<const CLI::Option*> options_of(const CLI::App& app) {
  return app.get_options([](const CLI::Option*) { return true; });
}

/// Text for troff: backslashes, and dots and quotes that begin a line.
std::string in_troff(const std::string& text) {
  std::string escaped;
  bool begins_line = true;
  for (const char c : text) {
    if (begins_line && (c == '.' || c == '\'')) escaped += "\\&";
    begins_line = c == '\n';
    if (c == '\\')
      escaped += "\\e";
    else if (c == '-')
      escaped += "\\-";
    else
      escaped += c;
  }
  return escaped;
}

/// The option's names and its value, such as `-o,--output OUT`.
std::string heading_of(const CLI::Option& option) {
  const std::string names = option.get_name(
      /*positional=*/option.get_positional(), /*all_options=*/true);
  const std::string type = option.get_type_name();
  return names +
         (type.empty() || option.get_expected_max() == 0 ? "" : " " + type);
}

/// A page of the manual in troff.
std::string man_page(const CLI::App& program, const CLI::App& app) {
  const bool is_command = &app != &program;
  const std::string name =
      "halfspace" + (is_command ? "-" + app.get_name() : std::string());
  std::string upper = name;
  std::transform(upper.begin(), upper.end(), upper.begin(), [](char c) {
    return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  });
  std::string page = ".TH " + in_troff(upper) +
                     " 1 \"\" \"halfspace " HALFSPACE_VERSION "\"\n";
  const std::string description = app.get_description();
  const std::string first = description.substr(0, description.find('\n'));
  page += ".SH NAME\n" + in_troff(name + " - " + first) + "\n";
  page += ".SH SYNOPSIS\n.B halfspace" +
          in_troff(is_command ? " " + app.get_name() : " COMMAND");
  for (const CLI::Option* option : options_of(app)) {
    if (!option->get_positional()) continue;
    page += " " + in_troff(option->get_name(true)) +
            (option->get_expected_max() > 1 ? " ..." : "");
  }
  page +=
      " [OPTIONS]\n.SH DESCRIPTION\n.nf\n" + in_troff(description) + "\n.fi\n";
  if (!is_command) {
    page += ".SH COMMANDS\n";
    for (const CLI::App* command : commands_of(program)) {
      page += ".TP\n.B " + in_troff(command->get_name()) + "\n" +
              in_troff(command->get_description()) + "\n";
    }
  }
  page += ".SH OPTIONS\n";
  for (const CLI::Option* option : options_of(app)) {
    page += ".TP\n.B " + in_troff(heading_of(*option)) + "\n" +
            in_troff(option->get_description()) + "\n";
  }
  page += ".SH NOTES\n.nf\n" + in_troff(app.get_footer()) + "\n.fi\n";
  return page;
}

/// A function for bash that completes commands, options and their words.
std::string bash_completion(const CLI::App& program) {
  std::string commands, cases;
  for (const CLI::App* command : commands_of(program)) {
    commands += (commands.empty() ? "" : " ") + command->get_name();
    std::string options, words;
    for (const CLI::Option* option : options_of(*command)) {
      for (const std::string& name : option->get_lnames())
        options += (options.empty() ? "--" : " --") + name;
      const std::string type = option->get_type_name();
      if (type.find('|') == std::string::npos) continue;
      std::string choices = type;
      std::replace(choices.begin(), choices.end(), '|', ' ');
      for (const std::string& name : option->get_lnames()) {
        words += "        " + command->get_name() + ":--" + name +
                 ") words=\"" + choices + "\" ;;\n";
      }
    }
    cases += words + "        " + command->get_name() + ":*) words=\"" +
             options + "\" ;;\n";
  }
  return "# Completion of halfspace for bash, made by `halfspace help "
         "--completion`.\n"
         "_halfspace() {\n"
         "  local current=${COMP_WORDS[COMP_CWORD]} words=\n"
         "  local before=${COMP_WORDS[COMP_CWORD-1]}\n"
         "  if [ \"$COMP_CWORD\" = 1 ]; then\n"
         "    words=\"" +
         commands +
         "\"\n"
         "  else\n"
         "    case ${COMP_WORDS[1]}:$before in\n" +
         cases +
         "    esac\n"
         "    case $before:$current in\n"
         "      --*:*|*:-*) ;;\n"
         "      *) words= ;;\n"
         "    esac\n"
         "  fi\n"
         "  mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$current\")\n"
         "}\n"
         "complete -o default -F _halfspace halfspace\n";
}

std::string in_lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return text;
}

bool mentions(const std::string& text, const std::string& word) {
  return in_lower_case(text).find(in_lower_case(word)) != std::string::npos;
}

/// The lines of a note that mention the word.
std::string lines_about(const std::string& note, const std::string& word) {
  std::istringstream lines(note);
  std::string found;
  for (std::string line; std::getline(lines, line);) {
    if (!mentions(line, word)) continue;
    line.erase(0, line.find_first_not_of(' '));
    found += "    " + line + "\n";
  }
  return found;
}

/// Where the word is an option, or occurs in what one takes or does.
std::string options_about(const CLI::App& program, const std::string& word) {
  const std::string bare =
      word.substr(std::min(word.find_first_not_of('-'), word.size()));
  std::string found;
  for (const CLI::App* command : commands_of(program)) {
    for (const CLI::Option* option : options_of(*command)) {
      const auto& names = option->get_lnames();
      const bool is_named =
          std::find(names.begin(), names.end(), bare) != names.end();
      const bool is_mentioned =
          word == bare && (mentions(option->get_description(), word) ||
                           mentions(option->get_type_name(), word));
      if (bare.empty() || (!is_named && !is_mentioned)) continue;
      found += "halfspace " + command->get_name() + " " + heading_of(*option) +
               "\n    " + option->get_description() + "\n";
    }
    const std::string lines =
        bare.empty() ? "" : lines_about(command->get_footer(), word);
    if (!lines.empty()) {
      found += "halfspace " + command->get_name() + "\n" + lines +
               "    as `halfspace help " + command->get_name() + "` says\n";
    }
  }
  return found;
}

Status run_help(const CLI::App& program, const HelpArguments& arguments) {
  if (arguments.completion) {
    print(bash_completion(program));
    return Status::kFine;
  }
  const CLI::App* about = &program;
  for (const CLI::App* command : commands_of(program)) {
    if (command->get_name() == arguments.word) about = command;
  }
  if (about == &program && !arguments.word.empty()) {
    const std::string found = options_about(program, arguments.word);
    if (found.empty() || arguments.man) {
      return fail("help: there is no command" +
                  std::string(arguments.man ? "" : " or option") + " called " +
                  arguments.word);
    }
    print(found);
    return Status::kFine;
  }
  if (arguments.man) {
    print(man_page(program, *about));
    return Status::kFine;
  }
  // The program itself, for its help() would be that of this command.
  const std::string name = about == &program ? "" : " " + about->get_name();
  print(about->get_formatter()->make_help(about, "halfspace" + name,
                                          CLI::AppFormatMode::Normal));
  return Status::kFine;
}

}  // namespace

void add_help(CLI::App& program, Status& status) {
  CLI::App* app = program.add_subcommand(
      "help", "Explain a command or an option, or make the manual's pages");
  const auto arguments = std::make_shared<HelpArguments>();
  app->add_option("WORD", arguments->word, "A command, an option or a word")
      ->type_name("");
  app->add_flag(
      "--man", arguments->man,
      "Print the page of the manual, of a command or of all, for man");
  app->add_flag("--completion", arguments->completion,
                "Print what completes words of halfspace in bash");
  app->footer(
      "Examples:\n"
      "  halfspace help csg\n"
      "  halfspace help --threads\n"
      "  halfspace help --man render > halfspace-render.1\n"
      "  source <(halfspace help --completion)");
  // A word may look like an option.
  app->allow_extras();
  app->callback([arguments, app, &program, &status] {
    const std::vector<std::string> extras = app->remaining();
    if (arguments->word.empty() && !extras.empty())
      arguments->word = extras.front();
    status = run_help(program, *arguments);
  });
}

}  // namespace halfspace::tools
