#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "command.hpp"
#include "halfspace/shadow/check.hpp"
#include "rendering.hpp"

namespace halfspace::tools {

/// The share of an image's pixels that `text` spells: above 0, at most 1.
std::optional<double> parse_share(std::string_view text);

/// Images checked by the reference, as `render --shadow` asks for.
class Shadow {
 public:
  explicit Shadow(const RenderArguments& arguments) : arguments_(arguments) {}

  /// Checks an image, if that is asked for, and writes the scene of the first
  /// one that is wrong.
  ///
  /// Returns kFine, whatever was found, or kBadInput if that scene cannot be
  /// written.
  Status check(const io::LoadedScene& loaded, const Camera& camera,
               const Frame& frame);

  /// What was checked, in words and numbers; nothing if nothing was asked for.
  std::string sentence() const;
  void add_to(nlohmann::json& stats) const;

  /// kDiffers if a pixel was wrong; then that has been said.
  Status status() const;

 private:
  const RenderArguments& arguments_;
  shadow::Report report_;
  std::uint64_t images_ = 0;
  double check_ms_ = 0;  ///< of each image the median of the repeats
};

}  // namespace halfspace::tools
