#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <utility>

#include "halfspace/result.hpp"

namespace CLI {
class App;
}

namespace halfspace::tools {

/// The exit statuses of the program.
enum class Status : int {
  kFine = 0,
  kDiffers = 1,        ///< a comparison found a difference
  kBadInput = 2,       ///< bad usage, or a file that cannot be used
  kInterrupted = 130,  ///< Ctrl-C, as shells say it
};

/// Prints `halfspace: SENTENCE` as one line to standard error.
Status fail(std::string_view sentence);

/// The same where Ctrl-C ended the work.
Status stop(std::string_view sentence);

/// The same for an error about `file`, which is named if the error does not.
Status fail(const std::string& file, const Error& error);

/// A note on standard error, if that is a terminal and notes are wanted;
/// nothing if it is empty.
void progress(const std::string& sentence);

/// `text` with everything that would break the line, or play tricks with a
/// terminal, made blanks.
std::string one_line(std::string_view text);

/// Adds --quiet, after which say() and progress() print nothing.
void add_quiet_option(CLI::App& app);
bool is_quiet();

/// Writes to standard output.
void print(std::string_view text);

/// Flushes standard output. Errors: kUnwritable, if any of it was lost.
Result<Done> finish_output();

/// Prints a part of the summary to standard output, unless --quiet is given.
template <class... Values>
void say(fmt::format_string<Values...> form, Values&&... values) {
  if (!is_quiet()) print(fmt::format(form, std::forward<Values>(values)...));
}

/// Each adds one subcommand to the program; when it is called, it runs and
/// leaves its status in `status`.
void add_info(CLI::App& program, Status& status);
void add_pick(CLI::App& program, Status& status);
void add_render(CLI::App& program, Status& status);
void add_build(CLI::App& program, Status& status);
void add_csg(CLI::App& program, Status& status);
void add_compare(CLI::App& program, Status& status);
void add_repair(CLI::App& program, Status& status);
void add_join(CLI::App& program, Status& status);
void add_scene(CLI::App& program, Status& status);
void add_draw(CLI::App& program, Status& status);
void add_order(CLI::App& program, Status& status);
void add_seen(CLI::App& program, Status& status);
void add_map(CLI::App& program, Status& status);
void add_view(CLI::App& program, Status& status);
void add_help(CLI::App& program, Status& status);

}  // namespace halfspace::tools
