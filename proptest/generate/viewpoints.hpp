#pragma once

#include <vector>

#include "generate/shapes.hpp"
#include "halfspace/scene_file.hpp"

/// From small integers to cameras, placed with respect to the scene.
namespace halfspace::generate {

/// Where the eye is; for an eye at infinity, what its direction lies in.
enum class EyeKind {
  kFree,
  kOnSplitter,
  kOnEdge,
  kAtVertex,
  kInside,
  kInPolygon
};

/// What the image is laid over.
enum class AimKind {
  kTarget,          ///< towards a corner of the scene
  kVertexOnCentre,  ///< a corner is seen at a pixel's centre
  kEdgeOnRow,       ///< an edge is seen along the centres of a row
  kEdgeOnColumn,
  kEdgeOnDiagonal,
};

enum class NearKind { kNone, kFree, kThroughImage };

/// What a camera consists of.
struct ViewRecipe {
  EyeKind eye = EyeKind::kFree;
  AimKind aim = AimKind::kTarget;
  NearKind near = NearKind::kNone;
  bool perspective = true;
  bool cull = false;
  bool gouraud = false;
  int other = 0;  ///< which polygon, modulo their number
  int edge = 0;   ///< which of its edges, modulo their number
  int width_px = 8;
  int height_px = 8;
  std::vector<int> numbers;  ///< twelve, from -4 to 4
};

/// A camera on the scene; where the recipe means none that is valid, one that
/// looks from the side.
SceneFile make(const MadeScene& scene, const ViewRecipe& recipe);

}  // namespace halfspace::generate
