#pragma once

#include <CLI/App.hpp>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "engine.hpp"
#include "halfspace/result.hpp"
#include "loading.hpp"

namespace halfspace::tools {

/// What the command line says about the tree, and about what is measured.
struct BuildArguments {
  std::size_t library = 0;
  std::size_t rule = 1;  ///< RootRule::kRandom
  std::optional<std::uint32_t> candidates;
  std::optional<std::uint64_t> seed;
  std::optional<std::uint32_t> cut_weight;
  std::optional<std::uint32_t> threads;
  std::optional<std::string> stats_file;
};

/// Adds the options, each of which fills its member.
/// Requires: `arguments` outlives the parsing.
void add_build_options(CLI::App& app, BuildArguments& arguments);

/// The options of the tree.
BuildOptions build_options(const BuildArguments& arguments);

/// The number of threads asked for; 1 if none.
int thread_count(const BuildArguments& arguments);

/// A tree that was built, and what it took.
struct BuildMeasure {
  TreeStats stats;
  double build_ms = 0;    ///< processor time
  std::size_t bytes = 0;  ///< memory of the tree
};

/// Builds the scene's tree in `engine` and measures it.
BuildMeasure build_measured(Engine& engine, const Scene& scene,
                            const BuildArguments& arguments);

/// What `--stats` says about the scene, its import and its tree; zeros for the
/// tree where none was built.
nlohmann::json stats_of(const Loaded& loaded, const BuildMeasure& measure,
                        const BuildArguments& arguments);

/// The tree in words.
std::string to_string(const BuildMeasure& measure);

/// Writes the statistics to the file, or for `-` to standard output.
/// Errors: kUnwritable.
Result<Done> write_stats(const std::string& path, const nlohmann::json& stats);

}  // namespace halfspace::tools
