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
#include "halfspace/io/legend.hpp"
#include "halfspace/io/load_scene.hpp"
#include "halfspace/io/mesh.hpp"
#include "halfspace/io/stop.hpp"
#include "halfspace/result.hpp"
#include "halfspace/scalars.hpp"
#include "halfspace/viewer/state.hpp"

namespace halfspace::viewer {

/// The part of faces that close a cut.
constexpr std::uint32_t kCapPart = 0xffffffff;

/// The numbers of a model, and from what to what they are.
struct Numbers {
  std::string source;
  ScalarField field;
  std::array<double, 2> extent = {0, 1};
  double least_positive = 1;  ///< what a logarithmic scale begins with
  bool has_gaps = false;      ///< some are no data
};

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
  std::shared_ptr<const Numbers> numbers;  ///< null where there are none
  /// What numbers the file has, where it is alone.
  std::vector<std::string> scalar_names;
  bool is_closed = false;  ///< whether caps can fill its cuts
  /// By polygon its part, where the parts are several and each is closed: their
  /// caps are told apart. Null elsewhere.
  std::shared_ptr<const CapParts> cap_parts;
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
  /// Errors: those of io::read_mesh(), kStopped among them; the file is named.
  Result<std::shared_ptr<const io::Mesh>> mesh_of(const std::string& path,
                                                  const io::Stop& stop = {});
  /// The properties of vertices and faces of a PLY file, which mesh_of() has
  /// read; none of other files.
  std::vector<std::string> scalar_names_of(const std::string& path) const;

 private:
  struct Entry {
    std::filesystem::file_time_type time;
    std::uintmax_t size = 0;
    std::shared_ptr<const io::Mesh> mesh;
    std::vector<std::string> scalar_names;
  };
  std::map<std::string, Entry> entries_;
};

/// What becomes of sections.
enum class Sections : std::uint8_t {
  kByPlanes,  ///< image_options() has them: nothing is cut
  kOfSolids,  ///< the parts are cut as solids, and closed
};

/// The scene of the state's visible parts, without a tree.
///
/// One visible part, not moved, is what `halfspace render` makes of the file;
/// more than one are one mesh on one grid.
/// Exact:  yes, but for the rounding that the report tells of.
/// Errors: those of reading and of import; kStopped; kEmpty (no part is
///         visible, or a boolean holds nothing); those of Solid for
///         booleans.
Result<Model> make_scene_of(const State& state, Sections sections,
                            MeshCache& cache, const Report& report);

/// The same with a tree: that of `before`, if it is of the same scene but for
/// colours.
Result<std::shared_ptr<const Model>> make_model(const State& state,
                                                MeshCache& cache,
                                                const Model* before,
                                                const Report& report);

/// The options of the image (S5.2), with the sections as clip planes, and caps
/// where the model is closed (S10).
ImageOptions image_options(const State& state, const Model& model);

/// How numbers are coloured.
struct ShownNumbers {
  std::shared_ptr<const Numbers> numbers;
  ColorScale scale;
  io::Legend legend;
  bool has_legend = false;
};

/// Looks at no polygon. Requires: the model has numbers.
/// Errors: those of io::read_color_map() and io::make_scale().
Result<std::shared_ptr<const ShownNumbers>> shown_numbers(
    const Model& model, const ScalarLook& look);

/// What a `.view` file shows: scene, camera, options.
/// Errors: those of read_state() and make_scene_of(); kBadCamera.
Result<io::LoadedScene> load_view(const std::filesystem::path& path,
                                  Sections sections);

}  // namespace halfspace::viewer
