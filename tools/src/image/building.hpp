#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "cli/loading.hpp"
#include "halfspace/result.hpp"
#include "image/engine.hpp"

namespace CLI {
class App;
}

namespace halfspace::tools {

/// What the command line says about the tree, and about what is measured.
struct BuildArguments {
  std::optional<Library> library;
  std::optional<RootRule> rule;
  std::optional<std::uint32_t> candidates;
  std::optional<std::uint64_t> seed;
  std::optional<std::uint32_t> cut_weight;
  std::optional<std::uint32_t> threads;
  std::optional<std::string> stats_file;
};

/// Adds the options, each of which fills its member. `usual_library` says in
/// the help which library it is if nothing is said.
/// Requires: `arguments` outlives the parsing.
void add_build_options(CLI::App& app, BuildArguments& arguments,
                       const std::string& usual_library);

/// The library asked for; `usual` if none is.
Library library_of(const BuildArguments& arguments, Library usual);

/// The options of a rule's tree.
BuildOptions build_options(const BuildArguments& arguments);

/// The number of threads asked for, for images; 1 if none.
int thread_count(const BuildArguments& arguments);

/// The same for builds and for packing pictures: 0, all that there are, if
/// none.
int working_threads(const BuildArguments& arguments);

/// A tree that was built or loaded, and what it took.
struct BuildMeasure {
  TreeStats stats;
  std::string library;     ///< by its word; empty: there is no tree
  std::string kind;        ///< its rule's word, or "display"
  double build_ms = 0;     ///< processor time
  double wall_ms = 0;      ///< time as it passed
  std::size_t bytes = 0;   ///< memory of the tree
  bool is_loaded = false;  ///< read from a file
  bool is_lazy = false;    ///< opened; images build what they come to
};

/// Builds the scene's tree in `engine`, of `library`, and measures it: by a
/// rule of the papers if the arguments say anything of one, else the library's
/// usual tree, without leaves or lazy if need be. Nothing, where Ctrl-C stopped
/// that.
std::optional<BuildMeasure> build_measured(Engine& engine, Library library,
                                           const Scene& scene,
                                           const BuildArguments& arguments,
                                           bool leaves, bool lazy = false);

/// Loads the tree in the file instead.
/// Errors: those of Engine::load_tree().
Result<BuildMeasure> load_measured(Engine& engine, Library library,
                                   const Scene& scene, const std::string& path,
                                   bool leaves);

/// What `--stats` says about the scene, its import and its tree; zeros for the
/// tree where none was built.
nlohmann::json stats_of(const io::LoadedScene& loaded,
                        const BuildMeasure& measure);

/// The tree in words, with its number of polygons.
std::string to_string(const BuildMeasure& measure, std::size_t polygons);

/// Writes the statistics to the file, or for `-` to standard output.
/// Errors: kUnwritable.
Result<Done> write_stats(const std::string& path, const nlohmann::json& stats);

}  // namespace halfspace::tools
