#include <CLI/App.hpp>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "cli/command.hpp"
#include "cli/loading.hpp"
#include "cli/long_work.hpp"
#include "halfspace/io/join.hpp"

namespace halfspace::tools {
namespace {

struct JoinArguments {
  std::vector<std::string> parts;
  std::string output;
};

Status run_join(const JoinArguments& arguments) {
  const std::string& output = arguments.output;
  const bool is_picture = io::has_extension(output, ".png");
  if (!is_picture && !io::has_extension(output, ".npy")) {
    return fail(output + ": the name must end in .png or .npy");
  }
  std::vector<std::filesystem::path> parts;
  for (const std::string& part : arguments.parts) {
    if (io::has_extension(part, ".png") != is_picture) {
      return fail(part + ": parts are of the same kind as " + output);
    }
    parts.emplace_back(part);
  }
  note_part(output);
  const Result<io::JoinedSize> size =
      is_picture ? io::join_png(parts, output) : io::join_npy(parts, output);
  if (!size) return fail(size.error().message);
  say("{}: {}x{} from {} parts\n", output, size->width_px, size->height_px,
      parts.size());
  return Status::kFine;
}

}  // namespace

void add_join(CLI::App& program, Status& status) {
  CLI::App* app = program.add_subcommand(
      "join", "Put the parts of an image, made with --rows, together");
  const auto arguments = std::make_shared<JoinArguments>();
  app->add_option("PARTS", arguments->parts,
                  "The parts from the top, all .png or all .npy")
      ->required()
      ->type_name("");
  app->add_option("-o,--output", arguments->output, "The whole image")
      ->required()
      ->type_name("OUT");
  add_quiet_option(*app);
  app->footer(
      "The whole has the same bytes as if it had been made in one piece. "
      "Pictures know\nwhich rows they are: one that is missing or out of order "
      "is an error. Arrays do\nnot: give them in order.\n\n"
      "Example:\n"
      "  halfspace render part.stl -o 0.png --size 9000x9000 --rows 0:4500\n"
      "  halfspace render part.stl -o 1.png --size 9000x9000 --rows 4500:\n"
      "  halfspace join 0.png 1.png -o part.png");
  app->callback([arguments, &status] { status = run_join(*arguments); });
}

}  // namespace halfspace::tools
