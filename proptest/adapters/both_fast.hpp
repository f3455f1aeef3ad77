#pragma once

#include <utility>
#include <vector>

#include "adapters/answers.hpp"
#include "adapters/screen_line.hpp"
#include "halfspace/bsp_tree.hpp"
#include "halfspace/fast/build.hpp"
#include "halfspace/fast/painter.hpp"
#include "halfspace/fast/render.hpp"
#include "halfspace/fast/scan.hpp"
#include "halfspace/fast/screen.hpp"
#include "halfspace/fast/split.hpp"
#include "halfspace/fast/traverse.hpp"
#include "halfspace/scene.hpp"

namespace halfspace {

/// The fast library, as the laws see it (both.hpp).
struct Fast {
  using Fragment = fast::Fragment;

  /// A tree, and the scene that names its planes.
  struct Tree {
    fast::BspTree tree;
    Scene scene;
  };

  // S1: a point is asked about as the corner of a polygon of its own, in a
  // scene of that and the plane's.
  static Side side_of(const Scene& scene, PolygonId plane,
                      const GridPoint& point) {
    SceneData data;
    data.grid_bits = scene.grid_bits();
    const auto add_corner = [&data](const GridPoint& p) {
      data.corners.push_back(static_cast<VertexId>(data.vertices.size()));
      data.vertices.push_back(p);
    };
    const auto end_polygon = [&data] {
      data.first_corner.push_back(
          static_cast<std::uint32_t>(data.corners.size()));
      data.colors.push_back({});
    };
    for (const VertexId corner : scene.corners(plane))
      add_corner(scene.point(corner));
    end_polygon();
    const auto inwards = [](std::int64_t value) {
      return value > 0 ? value - 1 : value + 1;
    };
    add_corner(point);
    add_corner({inwards(point.x), point.y, point.z});
    add_corner({point.x, inwards(point.y), point.z});
    end_polygon();
    const Scene two = *make_scene(std::move(data));
    fast::FilterStats stats;
    return fast::side_of(two, fast::whole(two, 1), 0, 0, stats);
  }
  static Side side_of_eye(const Scene& scene, PolygonId plane,
                          const Camera& camera) {
    fast::FilterStats stats;
    return fast::side_of_eye(scene, plane, camera, stats);
  }

  // S2
  static Fragment whole(const Scene& scene, PolygonId polygon) {
    return fast::whole(scene, polygon);
  }
  static FragmentName name_of(const Fragment& fragment) {
    return fast::name_of(fragment);
  }
  static Relation relation(const Scene& scene, const Fragment& fragment,
                           PolygonId splitter) {
    fast::FilterStats stats;
    return fast::relation(scene, fragment, splitter, stats);
  }
  static std::pair<Fragment, Fragment> split(const Scene& scene,
                                             const Fragment& fragment,
                                             PolygonId splitter) {
    fast::FilterStats stats;
    auto parts = fast::split(scene, fragment, splitter, stats);
    return {std::move(parts.positive), std::move(parts.negative)};
  }

  // S3
  static Tree build(const Scene& scene, const BuildOptions& options) {
    return {fast::build(scene, options), scene};
  }
  static void insert(Tree& tree, const Scene& scene, PolygonId polygon) {
    tree.scene = scene;
    fast::insert(tree.tree, scene, polygon);
  }
  static void remove(Tree& tree, const std::vector<PolygonId>& polygons) {
    fast::remove(tree.tree, tree.scene, polygons);
  }
  static TreeStats stats(const Tree& tree) { return fast::stats(tree.tree); }
  static TreeName name_of(const Tree& tree) { return fast::name_of(tree.tree); }
  static std::vector<FragmentName> back_to_front(const Tree& tree,
                                                 const Camera& camera,
                                                 std::size_t limit = kNoLimit) {
    std::vector<FragmentName> shown;
    fast::back_to_front(tree.tree, tree.scene, camera,
                        collect(tree.tree, shown, limit));
    return shown;
  }
  static std::vector<FragmentName> front_to_back(const Tree& tree,
                                                 const Camera& camera,
                                                 std::size_t limit = kNoLimit) {
    std::vector<FragmentName> shown;
    fast::front_to_back(tree.tree, tree.scene, camera,
                        collect(tree.tree, shown, limit));
    return shown;
  }

  // S4
  static std::vector<LineSpan> scan_convert(
      const Scene& scene, const Fragment& fragment, const Camera& camera,
      fast::SimdLevel simd = fast::SimdLevel::kBest) {
    fast::FilterStats stats;
    std::vector<LineSpan> lines;
    for (const auto& segment :
         fast::scan_convert(scene, fragment, camera, stats, simd))
      lines.push_back({segment.line, segment.span});
    return lines;
  }
  static MergeCase merge_case(Span object, Span unlit) {
    return fast::merge_case(object, unlit);
  }

  // S5
  static Image render(const Scene& scene, const Tree& tree,
                      const Camera& camera, const ImageOptions& options) {
    return image_of(fast::render(scene, tree.tree, camera, options));
  }
  static Image render_samples(const Scene& scene, const Tree& tree,
                              const Camera& camera, const ImageOptions& options,
                              std::int32_t samples) {
    return image_of(
        fast::render_samples(scene, tree.tree, camera, options, samples));
  }
  static Image blend(const Scene& scene, const Tree& tree, const Camera& camera,
                     const ImageOptions& options, std::uint8_t alpha) {
    return image_of(fast::blend(scene, tree.tree, camera, options, alpha));
  }

 private:
  static constexpr std::size_t kNoLimit = static_cast<std::size_t>(-1);

  static Image image_of(fast::Rendering rendering) {
    return {std::move(rendering.items), std::move(rendering.colors),
            rendering.pixels_painted};
  }

  /// The name of a tree's fragment, from its corners.
  static FragmentName name_in(const fast::BspTree& tree,
                              const fast::TreeFragment& fragment) {
    std::vector<EdgeName> edges;
    for (std::uint32_t k = 0; k < fragment.corner_count; ++k) {
      const std::int32_t edge = tree.corners[fragment.first_corner + k].edge;
      edges.push_back(edge >= 0
                          ? EdgeName{EdgeName::Kind::kSource, edge}
                          : EdgeName{EdgeName::Kind::kSplitter, -1 - edge});
    }
    return {fragment.source, rotated_to_least(std::move(edges))};
  }
  static fast::Visitor collect(const fast::BspTree& tree,
                               std::vector<FragmentName>& shown,
                               std::size_t limit) {
    return [&tree, &shown, limit](const fast::Node&,
                                  const fast::TreeFragment& fragment) {
      shown.push_back(name_in(tree, fragment));
      return shown.size() < limit;
    };
  }
};

/// Its scan conversion and its screen by one instruction set (S4).
template <fast::SimdLevel kSimd>
struct FastBy : Fast {
  static constexpr fast::SimdLevel kLevel = kSimd;

  static std::vector<LineSpan> scan_convert(const Scene& scene,
                                            const Fragment& fragment,
                                            const Camera& camera) {
    return Fast::scan_convert(scene, fragment, camera, kSimd);
  }
  static std::pair<std::vector<Span>, std::vector<Span>> merge(
      const std::vector<Span>& objects, const std::vector<Span>& unlit) {
    ScreenLine line(64, kSimd);
    const ScreenLine::Merged& merged = line.merge(objects, unlit);
    return {merged.lit, merged.unlit};
  }

  /// Its dynamic screen, whose callback is given more.
  class DynamicScreen {
   public:
    DynamicScreen(std::int32_t width_px, std::int32_t height_px)
        : screen_(width_px, height_px, kSimd) {}
    template <class Paint>
    void merge(std::int32_t line, const std::vector<Span>& objects,
               const Paint& paint) {
      screen_.merge(line, objects, 0,
                    [&](std::int32_t, Span lit, PolygonId) { paint(lit); });
    }
    bool full() const { return screen_.full(); }

   private:
    fast::DynamicScreen screen_;
  };
};

}  // namespace halfspace
