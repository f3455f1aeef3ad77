#pragma once

#include <string>
#include <string_view>

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

/// A note on standard error, if that is a terminal; nothing if it is empty.
void progress(const std::string& sentence);

/// Each adds one subcommand to the program; when it is called, it runs and
/// leaves its status in `status`.
void add_info(CLI::App& program, Status& status);
void add_render(CLI::App& program, Status& status);
void add_build(CLI::App& program, Status& status);
void add_csg(CLI::App& program, Status& status);
void add_compare(CLI::App& program, Status& status);
void add_join(CLI::App& program, Status& status);
void add_scene(CLI::App& program, Status& status);
void add_draw(CLI::App& program, Status& status);

}  // namespace halfspace::tools
