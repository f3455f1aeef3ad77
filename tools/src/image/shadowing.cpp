#include "image/shadowing.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "cli/measuring.hpp"
#include "cli/options.hpp"
#include "cli/outputs.hpp"

namespace halfspace::tools {

CLI::Option* add_share(CLI::App& app, const std::string& name,
                       std::optional<double>& share,
                       const std::string& meaning) {
  const auto parse = [](std::string_view text) {
    const std::optional<double> number = parse_number<double>(text);
    return number && *number > 0 && *number <= 1 ? number : std::nullopt;
  };
  return add_parsed(app, name, "SHARE", "a number above 0 and at most 1", share,
                    parse, meaning);
}

Status Shadow::check(const io::LoadedScene& loaded, const Camera& camera,
                     const Frame& frame) {
  if (!arguments_.shadow) return Status::kFine;
  const Scene& scene = loaded.file.scene;
  const ImageOptions options = frame.options;
  shadow::Options how;
  how.share = *arguments_.shadow;
  how.seed = ++images_;
  shadow::Report found;
  std::vector<double> times_ms;
  for (std::uint32_t i = 0; i < arguments_.repeat.value_or(1); ++i) {
    const Stopwatch watch;
    found = shadow::check(scene, camera, options,
                          {frame.picture.items, frame.picture.colors, 0,
                           frame.part ? frame.part->first_row : 0},
                          how);
    times_ms.push_back(watch.elapsed_ms());
  }
  check_ms_ += median(std::move(times_ms));
  const bool is_first = report_.mismatches == 0 && found.mismatches > 0;
  report_.add(found);
  if (!is_first) return Status::kFine;
  const Result<Done> written =
      write_output(arguments_.shadow_file,
                   shadow::reproducer(scene, camera, options, found));
  return written ? Status::kFine : fail(written.error().message);
}

std::string Shadow::sentence() const {
  if (!arguments_.shadow) return {};
  return fmt::format(
      "shadow: {} pixels checked, {} of them by the reference, {} mismatches, "
      "{:.3f} ms",
      report_.pixels, report_.by_reference, report_.mismatches, check_ms_);
}

void Shadow::add_to(nlohmann::json& stats) const {
  if (!arguments_.shadow) return;
  stats["shadow_pixels"] = report_.pixels;
  stats["shadow_by_reference"] = report_.by_reference;
  stats["shadow_mismatches"] = report_.mismatches;
  stats["shadow_ms"] = check_ms_;
}

Status Shadow::status() const {
  if (report_.mismatches == 0) return Status::kFine;
  const std::string& file = arguments_.shadow_file;
  fail("--shadow: " + shadow::to_string(report_.first.front()) +
       "; this is a bug, and " + file + " shows it: halfspace render " + file +
       " --shadow 1 --stats -, with the same --impl, --method and tree");
  return Status::kDiffers;
}

}  // namespace halfspace::tools
