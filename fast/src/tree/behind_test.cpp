#include "tree/behind_test.hpp"

#include <cmath>
#include <vector>

#include "camera/edge_function.hpp"
#include "halfspace/assert.hpp"
#include "halfspace/fast/image/behind.hpp"
#include "tree/eye_classifier.hpp"
#include "tree/tree_access.hpp"

namespace halfspace::fast {

/// In perspective the plane grows along a ray by P(s) - P(e), whose doubles are
/// off by what both are, and by 3u of their sizes; else P(s) alone counts. The
/// corners of the image are half a pixel beside the first and last centres.
bool BehindTest::is_behind(const Plane& plane, PlaneId id, int side) const {
  const ApproximateProjection p = project_approximately(plane, view_);
  const double width = camera_.width_px * view_.samples;
  const double height = camera_.height_px * view_.samples;
  const double eye = view_.perspective ? p.eye.value : 0;
  const double error = p.error + (view_.perspective ? p.eye.error : 0) +
                       4 * kRounding * (p.most + std::abs(eye));
  for (int corner = 0; corner < 4; ++corner) {
    const int right = corner & 1;
    const int bottom = corner >> 1;
    const double value = p.a * (right * width - 0.5) +
                         (p.b * (bottom * height - 0.5) + p.c) - eye;
    const int known = filtered_sign({value, error * (1 + 0x1p-40)});
    const int sign = known != 0 ? known : exact_sign(id, right, bottom);
    if (sign == side) return false;
  }
  return true;
}

/// Bits: as at a pixel (ProjectedPlane), and one of the eye's more.
int BehindTest::exact_sign(PlaneId id, int right, int bottom) const {
  return with_grid(reader_.scene().grid_bits(), [&](auto bits) {
    constexpr std::size_t kWords = Grid<bits()>::kWords;
    const auto p =
        projected(reader_.planes().template exact<bits()>(id), camera_);
    const auto times = [](const auto& value, Int128 factor) {
      return multiply<kWords>(Wide<kWords>(value), factor);
    };
    Wide<kWords> value = times(p.a, Int128{2} * right * camera_.width_px) +
                         times(p.b, Int128{2} * bottom * camera_.height_px) +
                         Wide<kWords>(p.c);
    if (camera_.perspective) value = value - times(p.eye, 2);
    return sign(value);
  });
}

bool is_behind(const Scene& scene, PolygonId splitter, const Camera& camera,
               Side side) {
  HALFSPACE_ASSERT(side != Side::kOn);
  const BspTree none;
  FilterStats stats;
  const TreeReader reader(scene, none);
  const View view = make_view(camera, scene.grid_bits());
  const EyeClassifier side_of_eye(reader, view, camera.data(), stats);
  const BehindTest behind(reader, view, camera.data());
  const Plane plane = reader.planes().plane(splitter);
  return behind(plane, splitter, side_of_eye(plane, splitter),
                static_cast<int>(side));
}

BehindCount count_behind(const Scene& scene, const BspTree& tree,
                         const Camera& camera) {
  FilterStats stats;
  const TreeReader reader(scene, tree);
  const View view = make_view(camera, scene.grid_bits());
  const EyeClassifier side_of_eye(reader, view, camera.data(), stats);
  const BehindTest behind(reader, view, camera.data());
  struct Ahead {
    NodeId node;
    bool is_behind;
  };
  BehindCount count;
  std::vector<Ahead> ahead;
  if (!tree.nodes.empty()) ahead.push_back({0, false});
  while (!ahead.empty()) {
    const Ahead at = ahead.back();
    ahead.pop_back();
    const Node& node = node_at(tree, at.node);
    if (at.is_behind) {
      ++count.nodes;
      for_fragments(tree, node, [&](const TreeFragment&) {
        ++count.fragments;
        return true;
      });
    }
    if (node.splitter == kNoPlane) continue;
    const int eye = at.is_behind ? 0 : side_of_eye(node.plane, node.splitter);
    for (const int side : {1, -1}) {
      const NodeId child = side > 0 ? node.positive : node.negative;
      if (child == kNoNode) continue;
      const bool begins =
          !at.is_behind && behind(node.plane, node.splitter, eye, side);
      count.subtrees += begins ? 1 : 0;
      ahead.push_back({child, at.is_behind || begins});
    }
  }
  return count;
}

}  // namespace halfspace::fast
