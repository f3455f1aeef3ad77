#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "halfspace/clip.hpp"
#include "halfspace/display.hpp"
#include "halfspace/fast/build.hpp"
#include "halfspace/fast/image/lazy_tree.hpp"
#include "halfspace/fast/render.hpp"
#include "halfspace/fast/shade/scalars.hpp"
#include "halfspace/io/import.hpp"
#include "halfspace/io/mesh.hpp"
#include "halfspace/ray.hpp"
#include "halfspace/threads.hpp"
#include "halfspace/visible_map.hpp"

namespace halfspace {
namespace detail {

/// How meshes to look at come onto a grid: so finely that cameras have room.
io::ImportOptions import_options();

struct VertexMoves;
struct MovedScene;

}  // namespace detail

/// What a display is made of. A shared library does not show it, though it
/// shows the class that it is in.
struct [[gnu::visibility("hidden")]] Display::State {
  /// As it was given, but coloured by face; empty of a scene file.
  io::Mesh mesh;
  /// By face of the mesh, its number, where some are gone; else empty.
  std::vector<std::int32_t> numbers;
  Scene scene;
  bool is_by_vertex = false;     ///< the scene's vertices are the mesh's
  std::vector<PolygonId> faces;  ///< by polygon of the scene
  std::size_t polygon_count = 0;
  std::vector<std::int32_t> solid_starts = {0};  ///< its first polygon
  /// Polygons when trees were made anew, and how many came or went since.
  std::size_t built_count = 0;
  std::size_t changes = 0;

  /// The tree for pictures, and one without leaves; made when first needed.
  Mutex mutex;
  std::optional<fast::BspTree> tree;
  std::optional<fast::BspTree> ordered;
  std::optional<fast::LazyTree> lazy;  ///< of this scene
  std::optional<bool> closed;
  /// The solid of each polygon of the scene, for caps that tell them apart, and
  /// whether each is closed.
  std::optional<std::vector<std::uint32_t>> solids;
  bool solids_closed = false;

  static Result<std::unique_ptr<State>> of(
      io::Mesh mesh,
      const io::ImportOptions& options = detail::import_options());
  /// Goes on with the numbers of a display, to which faces may have been added.
  void continue_numbers(const State& before);

  /// The scene with vertices that have moved: nothing, where its vertices are
  /// not the mesh's, or its polygons would be others.
  std::optional<detail::MovedScene> moved(const detail::VertexMoves& moves)
      const;
  /// The display with them made anew.
  Result<std::unique_ptr<State>> made_anew(const detail::VertexMoves& moves)
      const;

  /// Null where view.progress stopped it.
  const fast::BspTree* picture_tree(const View& view);
  const fast::BspTree& picture_tree() { return *picture_tree(View{}); }
  const fast::BspTree* ordered_tree(const View& view);
  /// A tree that is built as it is asked; null where there is a whole one.
  const fast::LazyTree* opened_tree(int threads);
  /// The polygon of the display that a polygon of the scene is part of, and its
  /// solid. Solids without polygons begin where the next one does.
  std::int32_t polygon_of(PolygonId id) const;
  std::int32_t solid_of(std::int32_t polygon) const;

  /// The keys of a figure's regions by polygon of the scene, then, with caps,
  /// those of S10.5.
  std::vector<std::int32_t> keys_of(FigureKey by, const ImageOptions& options)
      const;

  /// What a view says about its image; whether caps can be is looked at once.
  Result<ImageOptions> options_of(const View& view);
  /// Requires: the mutex; view.caps.
  Result<std::shared_ptr<const CapParts>> cap_parts_of(const View& view);
  /// The picture, of the display's polygons; in the colours of scalars where
  /// there are any, and then not of exact areas.
  Result<fast::Rendering> rendered(const View& view,
                                   const fast::ScalarColors* scalars = nullptr);

  Hit hit_of(const RayHit& hit, const Ray& ray) const;
  std::vector<Hit> hits_of(const Ray& ray);
};

namespace detail {

io::Mesh exact_mesh(const Mesh& mesh);
/// Adds the polygons of one mesh to another.
void append(const io::Mesh& from, io::Mesh& to);

glm::dvec3 vector_of(const Point& p);

/// The camera of a view. Errors: those of Display::render().
Result<Camera> camera_of(const Scene& scene, const View& view);

/// The clip planes of a view (S10.1): a normal of 1 and its offset in the steps
/// of the scene.
Result<std::vector<ClipPlane>> clips_of(const Scene& scene, const View& view);

/// How a view looks at polygons, where it is not at exact areas of them.
/// Errors: kOutOfRange (too many samples).
Result<Look> look_of(const View& view);

/// A step of a grid. Units: model units.
double step_of(const Unit& unit);

/// The errors of a view without pixels, and of work that was stopped.
Error no_pixels();
Error stopped();

/// The error of a colour of back faces, where only pixels of one sample could
/// have it.
Error no_marks();

/// The error of a view with transparent polygons, where there can be none.
Error no_alpha(const char* where);

}  // namespace detail
}  // namespace halfspace
