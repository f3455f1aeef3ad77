#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <memory_resource>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "cli/arguments.hpp"
#include "cli/command.hpp"
#include "cli/long_work.hpp"
#include "halfspace/fast/huge_page_pool.hpp"
#include "halfspace/io/format.hpp"

namespace {

using halfspace::tools::Status;

struct NamedCommand {
  std::string_view name;
  void (*add)(CLI::App& program, Status& status);
};

constexpr NamedCommand kCommands[] = {
    {"info", halfspace::tools::add_info},
    {"render", halfspace::tools::add_render},
    {"build", halfspace::tools::add_build},
    {"csg", halfspace::tools::add_csg},
    {"repair", halfspace::tools::add_repair},
    {"compare", halfspace::tools::add_compare},
    {"join", halfspace::tools::add_join},
    {"scene", halfspace::tools::add_scene},
    {"draw", halfspace::tools::add_draw},
    {"order", halfspace::tools::add_order},
    {"seen", halfspace::tools::add_seen},
    {"map", halfspace::tools::add_map},
    {"pick", halfspace::tools::add_pick},
    {"view", halfspace::tools::add_view},
};

/// Adds the command that the first argument names, or all of them, of which
/// help and errors tell.
void add_commands(CLI::App& program, std::string_view first, Status& status) {
  program.name("halfspace");
  program.description(
      "Exact visibility and solid modelling with BSP trees.\n"
      "Meshes: " +
      halfspace::io::format_names() + ", also gzipped. Scenes: .scene.");
  program.footer(
      "Examples:\n"
      "  halfspace info part.stl\n"
      "  halfspace render part.stl -o part.png\n"
      "  halfspace csg difference part.stl drill.stl -o drilled.off\n\n"
      "`halfspace render --help` tells more about render, and so on.\n"
      "Exit status: 0 fine, 1 a comparison found differences, 2 bad input.");
  program.require_subcommand(1);
  program.set_version_flag("--version", "halfspace " HALFSPACE_VERSION);
  // The options of all commands take longer to make than a small work does.
  const auto* const named = std::find_if(
      std::begin(kCommands), std::end(kCommands),
      [&](const NamedCommand& command) { return command.name == first; });
  if (named != std::end(kCommands)) {
    named->add(program, status);
    return;
  }
  for (const NamedCommand& command : kCommands) command.add(program, status);
  halfspace::tools::add_help(program, status);
}

/// What is wrong with the command line.
std::string complaint(const CLI::App& program, const CLI::ParseError& error) {
  // CLI11 says that a command is missing also where it is misspelt.
  const std::string sentence = error.what();
  const std::vector<std::string> unknown = program.remaining(true);
  if (unknown.empty() || !sentence.starts_with("A subcommand")) return sentence;
  return "there is no command called " + unknown.front();
}

/// Reads the command line and does what it says.
Status run(int count, char** words) {
  auto status = Status::kFine;
  CLI::App program;
  try {
    add_commands(program, count > 1 ? words[1] : "", status);
    std::vector<std::string> arguments =
        halfspace::tools::joined_arguments(count, words);
    // CLI11 takes them from the end.
    std::reverse(arguments.begin(), arguments.end());
    program.parse(std::move(arguments));
  } catch (const CLI::Success& success) {
    std::ostringstream text;
    program.exit(success, text, text);  // --help and --version
    halfspace::tools::print(text.str());
  } catch (const CLI::ParseError& error) {
    status = halfspace::tools::fail(complaint(program, error) +
                                    " (--help tells more)");
  } catch (const std::bad_alloc&) {
    status = halfspace::tools::fail("there is not enough memory");
  } catch (const std::exception& error) {
    // oneTBB's words where a thread cannot begin.
    const bool is_thread =
        std::string_view(error.what()).starts_with("pthread_create");
    status = halfspace::tools::fail(
        is_thread ? "the system gives no more threads, perhaps for lack of "
                    "memory; --threads 1 takes one"
                  : error.what());
  }
  return status;
}

}  // namespace

int main(int count, char** words) {
  // Never destroyed: lists may outlive main().
  static auto* const pool = new halfspace::fast::HugePagePool;
  std::pmr::set_default_resource(pool);
  halfspace::tools::catch_interrupts();
  Status status = run(count, words);
  const auto written = halfspace::tools::finish_output();
  if (!written && status == Status::kFine)
    status = halfspace::tools::fail(written.error().message);
  return static_cast<int>(status);
}
