#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "cli/command.hpp"
#include "halfspace/shadow/check.hpp"
#include "image/rendering.hpp"

namespace CLI {
class Option;
}

namespace halfspace::tools {

/// Adds the option `name`, which asks for a share to be checked.
CLI::Option* add_share(CLI::App& app, const std::string& name,
                       std::optional<double>& share,
                       const std::string& meaning);

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
