#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/vec3.hpp>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "halfspace/fast/build.hpp"
#include "halfspace/io/load_scene.hpp"
#include "halfspace/io/mesh.hpp"
#include "halfspace/result.hpp"
#include "halfspace/viewer/state.hpp"

namespace halfspace::viewer {

/// The part of faces that close a cut.
constexpr std::uint32_t kCapPart = 0xffffffff;

/// A state's scene with its tree: never changed once it is made, so that any
/// thread may look at it.
struct Model {
  io::LoadedScene loaded;
  /// Of each polygon of the scene the part that it belongs to, and the face of
  /// that part's file that it is, or is a part of.
  std::vector<std::uint32_t> parts;
  std::vector<PolygonId> faces;
  std::uint64_t fingerprint = 0;  ///< of the scene, without its colours
  std::shared_ptr<const fast::BspTree> tree;
  /// The box round the files' points, before any cut. Units: model units.
  std::array<double, 3> low{}, high{};

  /// The least and the greatest value of axis . p in the box.
  std::array<double, 2> extent_along(const glm::dvec3& axis) const;
};

/// Receives what is being done and the share of it that is done, from 0 to 1;
/// where it returns false, the work stops.
using Report = std::function<bool(const std::string& work, double share)>;

/// Files that were read, kept until they change: colours and shading need no
/// second reading.
class MeshCache {
 public:
  /// The mesh in the file, which a scene file becomes, too.
  /// Errors: those of io::read_mesh(); the file is named.
  Result<std::shared_ptr<const io::Mesh>> mesh_of(const std::string& path);

 private:
  struct Entry {
    std::filesystem::file_time_type time;
    std::uintmax_t size = 0;
    std::shared_ptr<const io::Mesh> mesh;
  };
  std::map<std::string, Entry> entries_;
};

/// The scene of the state's visible parts, without a tree.
///
/// One visible part, not moved, is what `halfspace render` makes of the file;
/// more than one are one mesh on one grid.
/// Exact:  yes, but for the rounding that the report tells of.
/// Errors: those of reading and of import; kStopped; kEmpty (no part is
///         visible, or a boolean holds nothing); those of Solid for
///         booleans.
Result<Model> make_scene_of(const State& state, MeshCache& cache,
                            const Report& report);

/// The same with a tree: that of `before`, if it is of the same scene but for
/// colours.
Result<std::shared_ptr<const Model>> make_model(const State& state,
                                                MeshCache& cache,
                                                const Model* before,
                                                const Report& report);

/// The options of the image (S5.2).
ImageOptions image_options(const Looks& looks);

/// What `halfspace render` shows for a `.view` file: scene, camera, options.
/// Errors: those of read_state() and make_scene_of(); kBadCamera.
Result<io::LoadedScene> load_view(const std::filesystem::path& path);

}  // namespace halfspace::viewer
