#include <CLI/App.hpp>
#include <memory>
#include <string>

#include "cli/command.hpp"
#include "halfspace/io/picture.hpp"

namespace halfspace::tools {
namespace {

/// The number of differences shown one by one.
constexpr std::size_t kShown = 10;

struct CompareArguments {
  std::string first;
  std::string second;
};

/// Prints the first pixels that differ; the number of all of them.
std::size_t print_differences(const ItemImage& a, const ItemImage& b) {
  std::size_t count = 0;
  for (std::int32_t j = 0; j < a.height_px; ++j) {
    for (std::int32_t i = 0; i < a.width_px; ++i) {
      if (a.at(i, j) == b.at(i, j)) continue;
      if (count < kShown) {
        say("column {}, row {}: {} and {}\n", i, j, a.at(i, j), b.at(i, j));
      }
      ++count;
    }
  }
  return count;
}

Status run_compare(const CompareArguments& arguments) {
  const Result<ItemImage> a = io::read_npy(arguments.first);
  if (!a) return fail(arguments.first, a.error());
  const Result<ItemImage> b = io::read_npy(arguments.second);
  if (!b) return fail(arguments.second, b.error());
  if (a->width_px != b->width_px || a->height_px != b->height_px) {
    say("sizes differ: {}x{} and {}x{}\n", a->width_px, a->height_px,
        b->width_px, b->height_px);
    return Status::kDiffers;
  }
  const std::size_t count = print_differences(*a, *b);
  say("mismatches: {} of {} pixels\n", count, a->pixels.size());
  return count == 0 ? Status::kFine : Status::kDiffers;
}

}  // namespace

void add_compare(CLI::App& program, Status& status) {
  CLI::App* app = program.add_subcommand(
      "compare", "Compare two images of polygon ids, pixel for pixel");
  const auto arguments = std::make_shared<CompareArguments>();
  app->add_option("A", arguments->first, "An array that --ids wrote")
      ->required()
      ->type_name("");
  app->add_option("B", arguments->second, "Another")->required()->type_name("");
  add_quiet_option(*app);
  app->footer(
      "Exit status: 0 if they are equal, 1 if they differ, 2 if one cannot be "
      "read.\n\n"
      "Example:\n"
      "  halfspace compare span.npy raycast.npy");
  app->callback([arguments, &status] { status = run_compare(*arguments); });
}

}  // namespace halfspace::tools
