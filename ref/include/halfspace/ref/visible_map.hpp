#pragma once

#include <cstdint>
#include <vector>

#include "halfspace/camera.hpp"
#include "halfspace/image.hpp"
#include "halfspace/ref/projection.hpp"
#include "halfspace/scene.hpp"
#include "halfspace/visible_map.hpp"

namespace halfspace::ref {

/// An arc of the map (S7.4). Units: pixels.
struct MapArc {
  ImagePoint from;
  ImagePoint to;
  std::int32_t left = kOutsideKey;   ///< the key on its left
  std::int32_t right = kOutsideKey;  ///< the key on its right
};

/// The visible map of the scene (S7.4), as its arcs: sorted by `from`, then by
/// `to`, points by x and then y.
///
/// All lines against all: every line is cut where another one meets it, and
/// what is seen right beside the middle of each part decides whether it stays.
/// Exact: yes.
/// Cost:  the cube of the number of polygon pairs, and worse: small scenes.
std::vector<MapArc> visible_map(const Scene& scene, const Camera& camera,
                                const MapOptions& options = {});

/// The map of what clip planes and caps leave (S10.5), with the keys of
/// S10.5.
///
/// Requires: a closed scene where the options have caps.
/// Exact:    yes.
/// Cost:     as visible_map().
std::vector<MapArc> section_map(const Scene& scene, const Camera& camera,
                                const ImageOptions& options);

/// The transparent map of the scene (S7.8), as its arcs: the same with composed
/// colours as keys.
std::vector<MapArc> transparent_map(const Scene& scene, const Camera& camera,
                                    const TransparentOptions& options);

/// That of what clip planes and caps leave (S10.7).
///
/// Requires: as section_map().
std::vector<MapArc> transparent_section(const Scene& scene,
                                        const Camera& camera,
                                        const TransparentOptions& options,
                                        const ImageOptions& section);

/// The area of all regions with a key (S7.5). Units: square pixels.
Rational area_of_key(const std::vector<MapArc>& map, std::int32_t key);

}  // namespace halfspace::ref
