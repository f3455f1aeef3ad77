#include "halfspace/ref/classify.hpp"

#include <optional>
#include <utility>

#include "halfspace/assert.hpp"
#include "halfspace/ref/split.hpp"
#include "vector.hpp"

namespace halfspace::ref {
namespace {

/// A part of the polygon on its way down the tree.
struct Part {
  Fragment fragment;
  NodeId node;    ///< where it has arrived; kNoNode: at a missing child
  bool positive;  ///< on which side of that node's parent; none: the positive
  /// The node in whose plane it lies, once it has met one.
  const Node* plane_node = nullptr;
  /// Its class on the positive side of that node, once it has been there.
  std::optional<SolidClass> positive_class = std::nullopt;
};

/// The class of a fragment in a splitter's plane by the classes it gets on the
/// splitter's two sides. `agrees`: its normal is the splitter's.
SolidClass class_in_plane(SolidClass positive, SolidClass negative,
                          bool agrees) {
  if (positive == negative) return positive;
  // The solid's surface is here, and it faces what is outside (E3: this need
  // not be the splitter's direction).
  const bool surface_agrees = positive == SolidClass::kOutside;
  return surface_agrees == agrees ? SolidClass::kSame : SolidClass::kOpposite;
}

/// One step down for a part at `node`: what is to follow is put on `parts`.
void descend(Part part, const Node& node, std::vector<Part>& parts) {
  const auto follow = [&](Fragment fragment, bool positive) {
    const NodeId child = positive ? node.positive : node.negative;
    parts.push_back({std::move(fragment), child, positive, part.plane_node,
                     part.positive_class});
  };
  switch (relation(part.fragment, node.plane)) {
    case Relation::kPositive:
      follow(std::move(part.fragment), /*positive=*/true);
      break;
    case Relation::kNegative:
      follow(std::move(part.fragment), /*positive=*/false);
      break;
    case Relation::kSpanning: {
      SplitResult cut = split(part.fragment, node.plane, node.splitter);
      follow(std::move(cut.negative), /*positive=*/false);
      follow(std::move(cut.positive), /*positive=*/true);
      break;
    }
    case Relation::kCoincident:
      // No two splitters on one way down are the same plane (S3.5).
      HALFSPACE_ASSERT(part.plane_node == nullptr);
      part.plane_node = &node;
      follow(std::move(part.fragment), /*positive=*/true);
      break;
  }
}

}  // namespace

Solid to_solid(const GridSolid& solid) {
  const Scene& scene = solid.scene();
  Solid result;
  for (std::size_t p = 0; p < scene.polygon_count(); ++p) {
    const auto id = static_cast<PolygonId>(p);
    std::vector<Point> vertices = whole(scene, id).vertices;
    const Plane plane = plane_of(vertices);
    result.faces.push_back(
        {plane, std::move(vertices), scene.color(id), true, id});
  }
  return result;
}

Fragment whole(const Solid& solid, PolygonId id) {
  Fragment fragment{id, {}, solid.faces[static_cast<std::size_t>(id)].vertices};
  for (std::size_t k = 0; k < fragment.vertices.size(); ++k) {
    fragment.edges.push_back(
        {EdgeName::Kind::kSource, static_cast<std::int32_t>(k)});
  }
  return fragment;
}

BspTree build(const Solid& solid, const BuildOptions& options) {
  std::vector<Plane> planes;
  std::vector<Fragment> polygons;
  for (std::size_t f = 0; f < solid.faces.size(); ++f) {
    planes.push_back(solid.faces[f].plane);
    polygons.push_back(whole(solid, static_cast<PolygonId>(f)));
  }
  return build(planes, std::move(polygons), options);
}

std::vector<Classified> classify(const BspTree& tree, Fragment polygon,
                                 const Plane& plane) {
  std::vector<Classified> result;
  std::vector<Part> parts;
  // The root's side: to the empty solid everything is outside.
  parts.push_back({std::move(polygon), tree.nodes.empty() ? kNoNode : 0, true});
  while (!parts.empty()) {
    Part part = std::move(parts.back());
    parts.pop_back();

    // Step 1: go down to a missing child.
    if (part.node != kNoNode) {
      const Node& node = tree.nodes[static_cast<std::size_t>(part.node)];
      descend(std::move(part), node, parts);
      continue;
    }

    // Step 2: there, take the class of the side.
    SolidClass found =
        part.positive ? SolidClass::kOutside : SolidClass::kInside;

    // Step 3: a part that lies in a splitter's plane has gone down its positive
    // side; it goes down its negative side too, and both classes decide.
    if (part.plane_node != nullptr) {
      if (!part.positive_class) {
        part.node = part.plane_node->negative;
        part.positive = false;
        part.positive_class = found;
        parts.push_back(std::move(part));
        continue;
      }
      found = class_in_plane(*part.positive_class, found,
                             same_direction(part.plane_node->plane, plane));
    }
    result.push_back({std::move(part.fragment), found});
  }
  return result;
}

}  // namespace halfspace::ref
