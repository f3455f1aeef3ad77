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

/// The stand at `share` of the way from `a` to `b`.
Stand between(const Stand& a, const Stand& b, double share);

/// An object of the file.
struct NamedObject {
  std::string name;
  std::size_t owner = 0;   ///< a model
  std::size_t object = 0;  ///< of the owner
  Stand stand;
};

/// A file of objects (docs/guide.md): models from files, objects in regions.
struct ObjectFile {
  Assembly assembly;
  std::vector<NamedObject> objects;
  bool cut = false;       ///< what reaches into regions is cut away
  io::LoadedScene world;  ///< for cameras, and what import did
};

/// Errors: kSyntax, kBadIndex with the line; those of load_scene() and
///         make_assembly(). The message names the file.
Result<ObjectFile> read_object_file(const std::string& path,
                                    const io::ImportOptions& options);

/// The pose in which the objects stand so, by index of `file.objects`. Maps are
/// rounded here, once: entries to some 20 bits, what moves to a grid step's
/// share of that.
Pose pose_of(const ObjectFile& file, const std::vector<Stand>& stands);

}  // namespace halfspace::tools
