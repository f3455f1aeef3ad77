#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "halfspace/camera.hpp"
#include "halfspace/image.hpp"
#include "halfspace/int128.hpp"
#include "halfspace/polygon.hpp"
#include "halfspace/region.hpp"
#include "halfspace/result.hpp"
#include "halfspace/scene.hpp"

namespace halfspace {

/// An object's map (S12.2): its point `p` stands at `(M p + t) / 2^shift` of
/// its owner. Units: grid steps of the object, and of the owner.
struct ObjectMap {
  /// M, row by row.
  std::array<std::int64_t, 9> m = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  std::array<Int128, 3> t{};
  int shift = 0;
  friend bool operator==(const ObjectMap&, const ObjectMap&) = default;
};

/// What a map may have (S12.2): entries of M below 2^31 in size, shifts of at
/// most 31, and `t` below 2^86.
constexpr int kMapBits = 31;
constexpr int kMapOffsetBits = 86;

/// What maps one after another may come to (S12.3), powers of two that all
/// numbers share taken out: entries of M below 2^62, a shift of at most 62, and
/// `t` below 2^118.
constexpr int kComposedBits = 62;
constexpr int kComposedOffsetBits = 118;

/// Objects are nested at most so deep; the world has depth 0.
constexpr int kMostNesting = 16;

/// A place for an object: what it is, and where it may move (S12.1).
struct MovingObject {
  std::int32_t model = 0;
  ObjectRegion region;
  friend bool operator==(const MovingObject&, const MovingObject&) = default;
};

/// Polygons, and places for objects among them. Many objects may be of one
/// model.
struct Model {
  Scene scene;
  std::vector<MovingObject> objects;
};

/// One object with all that it is in (S12.1).
struct Occurrence {
  std::int32_t model = 0;
  std::int32_t owner = -1;       ///< another occurrence; -1 for the world
  std::int32_t object = -1;      ///< which of the owner's model
  std::int32_t first_child = 0;  ///< its objects follow each other
  PolygonId first_polygon = 0;   ///< the id of its model's first polygon
};

/// A valid world of moving objects (S12.1): only make_assembly() makes one.
class Assembly {
 public:
  const std::vector<Model>& models() const { return models_; }
  const Model& model(std::int32_t index) const {
    return models_[static_cast<std::size_t>(index)];
  }
  /// All objects: the world first, then the objects of each occurrence.
  const std::vector<Occurrence>& occurrences() const { return occurrences_; }
  /// Polygons of all occurrences together.
  std::size_t polygon_count() const { return polygon_count_; }
  /// The least box of a model's corners and regions; nothing if it has none.
  const std::optional<ObjectRegion>& extent(std::int32_t model) const {
    return extents_[static_cast<std::size_t>(model)];
  }

 private:
  friend Result<Assembly> make_assembly(std::vector<Model> models);
  std::vector<Model> models_;
  std::vector<std::optional<ObjectRegion>> extents_;
  std::vector<Occurrence> occurrences_;
  std::size_t polygon_count_ = 0;
};

/// The assembly whose world is `models[0]` (S12.1).
///
/// Errors: kEmpty (no models); kBadIndex (an object of a model that does not
///         come after its owner); kOutOfRange (a region that is empty, beyond
///         its owner's grid, not as hull_region() makes it, or shares space
///         with another one of its owner;
///         nesting deeper than kMostNesting; more than 2^31 - 1 polygons, or
///         2^24 objects).
/// Cost:   linear in objects, but for regions side by side.
Result<Assembly> make_assembly(std::vector<Model> models);

/// Where the objects of each occurrence stand (S12.2): by model and object, so
/// that an occurrence's objects stand alike in all occurrences of its model.
struct Pose {
  /// maps[m][k] is that of object k of model m; nothing: it is not there.
  std::vector<std::vector<std::optional<ObjectMap>>> maps;
};

/// A pose in which no object is there.
Pose empty_pose(const Assembly& assembly);

/// A valid pose (S12.3): only make_placement() makes one.
class Placement {
 public:
  /// By occurrence: the map from its model's points to the world's; nothing
  /// where it or its owner is not there. The world's is the identity.
  const std::vector<std::optional<ObjectMap>>& to_world() const {
    return to_world_;
  }

 private:
  friend Result<Placement> make_placement(const Assembly& assembly,
                                          const Pose& pose);
  std::vector<std::optional<ObjectMap>> to_world_;
};

/// The placement that `pose` describes, if no object leaves its region (S12.3).
///
/// Errors: kBadIndex (a pose of other models); kZeroArea (a map whose
///         determinant is 0); kOutOfRange (numbers beyond S12.2 or S12.3; an
///         object that leaves its region). The index is that of the
///         occurrence.
/// Exact:  yes.
/// Cost:   a few products an occurrence; where the box of an object reaches out
///         of its region, some for each of its corners.
Result<Placement> make_placement(const Assembly& assembly, const Pose& pose);

/// The sign of the determinant of M, which fits 128 bits only for maps that are
/// not composed. Exact: yes.
int orientation_of(const ObjectMap& map);

/// The grid of flat scenes: the finest that there is.
constexpr int kFlatGrid = 54;

/// Moved polygons as a scene of their own (S12.7), and the camera that sees it
/// as it sees them.
struct FlatScene {
  Scene scene;
  Camera camera;
  std::vector<PolygonId> ids;  ///< by polygon of the scene, that of S12.1
  /// By corner of the scene, that of its model: which one in all its list.
  std::vector<std::uint32_t> corners;
  int shift = 0;  ///< a step of the world is 2^shift of its steps
};

/// The shift of the flat scene: the greatest of the maps that are there.
int flat_shift(const Placement& placement);

/// The camera that sees a scene in steps of 2^-shift as the given one does.
///
/// Errors: kOutOfRange: it is off the lattice of a grid of 54 bits.
Result<Camera> flat_camera(const Camera& camera, int shift);

/// The error of moved corners that a grid of 54 bits does not hold.
Error off_flat_grid();

/// The options by which the flat scene has the same image: clip planes on its
/// grid, and parts of its polygons.
///
/// Errors: those of make_clips().
Result<ImageOptions> flat_options(const FlatScene& flat,
                                  const ImageOptions& options);

/// The item of the moved polygons for one of the flat scene, caps too.
PolygonId moved_item(const Assembly& assembly, const FlatScene& flat,
                     PolygonId item);

}  // namespace halfspace
