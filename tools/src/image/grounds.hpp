#pragma once

#include "halfspace/io/picture.hpp"
#include "image/engine.hpp"
#include "image/lines.hpp"

namespace halfspace::tools {

/// The picture that a shot asks for, of exact areas too.
Picture drawn(const Engine& engine, const Scene& scene, const Camera& camera,
              const Shot& shot);

/// The same over a gradient: rows over one colour are drawn together.
/// Requires: no exact areas.
Picture drawn_over_gradient(const Engine& engine, const Scene& scene,
                            const Camera& camera, const Shot& shot);

/// Draws the lines that are asked for, if any, over the colours of a shot.
/// Errors: those of Engine::add_lines().
Result<Done> add_lines(const Engine& engine, const Scene& scene,
                       const Camera& camera, const Shot& shot,
                       const LineArguments& arguments, ColorImage& colors);

/// How much of each pixel hides what is behind it: the shot over black, its
/// lines too, of the scene in which all is white.
///
/// Requires: a shot over black; no lazy tree.
/// Errors:   those of Engine::add_lines().
Result<io::CoverageImage> coverage_of(const Engine& engine, const Scene& scene,
                                      const Camera& camera, const Shot& shot,
                                      LineArguments lines);

/// Makes the colours of a picture over black those of what covers its pixels:
/// divided by the coverage, rounded half up, 255 at most.
void divide(const io::CoverageImage& coverage, ColorImage& colors);

}  // namespace halfspace::tools
