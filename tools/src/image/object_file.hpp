#pragma once

#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "halfspace/io/load_scene.hpp"
#include "halfspace/moving.hpp"
#include "halfspace/result.hpp"

namespace halfspace::tools {

/// Where an object stands, as people say it: its points are scaled, turned
/// about its own origin by the right-hand rule, and moved. Units: those of the
/// files, and degrees.
struct Stand {
  glm::dvec3 move = glm::dvec3(0);
  glm::dvec3 axis = glm::dvec3(0, 0, 1);
  double turn_deg = 0;
  double scale = 1;
  bool is_there = true;
};

/// The word that says something of where an object stands: move, turn, scale,
/// there. False where the value is none of the word's; nothing where there is
/// no such word.
std::optional<bool> set_stand(Stand& stand, const std::string& word,
                              const std::string& value);

/// What a value of such a word must be.
std::string stand_value_of(const std::string& word);

/// The stand at `share` of the way from `a` to `b`.
Stand between(const Stand& a, const Stand& b, double share);

/// An object of the file.
struct NamedObject {
  std::string name;
  std::size_t owner = 0;   ///< a model
  std::size_t object = 0;  ///< of the owner
  Stand stand;
};

/// What a model was read from.
struct ModelFile {
  std::string path;
  io::LoadedScene loaded;
};

/// A file of objects (docs/guide.md): models from files, objects in regions.
struct ObjectFile {
  Assembly assembly;
  std::vector<NamedObject> objects;
  bool cut = false;              ///< what reaches into regions is cut away
  std::vector<ModelFile> files;  ///< by model
  /// Maps are no finer than 2^-most_shift of a step, if that leaves enough of
  /// them: so a flat scene is there (S12.7).
  int most_shift = kMapBits;

  /// For cameras: the world on the grid that it has now.
  const SceneFile& world() const { return files.front().loaded.file; }
};

/// The message with objects' names for `object K of model M`.
std::string with_object_names(std::string message, const ObjectFile& file);

/// Errors: kSyntax, kBadIndex with the line; those of load_scene() and
///         make_assembly(). The message names the file.
Result<ObjectFile> read_object_file(const std::string& path,
                                    const io::ImportOptions& options);

/// The pose in which the objects stand so, by index of `file.objects`. Maps are
/// rounded here, once (io::object_map).
Pose pose_of(const ObjectFile& file, const std::vector<Stand>& stands);

}  // namespace halfspace::tools
