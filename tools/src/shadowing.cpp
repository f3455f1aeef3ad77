#include "shadowing.hpp"

#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "measuring.hpp"

namespace halfspace::tools {

std::optional<double> parse_share(std::string_view text) {
  const std::optional<double> share = parse_real(text);
  return share && *share > 0 && *share <= 1 ? share : std::nullopt;
}

Status Shadow::check(const io::LoadedScene& loaded, const Camera& camera,
                     const Frame& frame) {
  if (!arguments_.shadow) return Status::kFine;
  const Scene& scene = loaded.file.scene;
  const ImageOptions options = choose_options(loaded.file, arguments_.view);
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
  std::ofstream out(arguments_.shadow_file, std::ios::binary);
  out << shadow::reproducer(scene, camera, options, found);
  out.close();
  return out ? Status::kFine
             : fail(arguments_.shadow_file + ": cannot be written");
}

std::string Shadow::sentence() const {
  if (!arguments_.shadow) return {};
  char time[32];
  std::snprintf(time, sizeof time, "%.3f ms", check_ms_);
  return "shadow: " + std::to_string(report_.pixels) + " pixels checked, " +
         std::to_string(report_.by_reference) + " of them by the reference, " +
         std::to_string(report_.mismatches) + " mismatches, " + time;
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
