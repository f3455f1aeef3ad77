#pragma once

#include <cstdint>
#include <vector>

#include "halfspace/fast/render.hpp"
#include "raster/frame.hpp"

namespace halfspace::fast {

/// A change of a part's winding number in a row of a clip plane, from a column
/// on (S10.3).
struct CapChange {
  std::int32_t row;
  std::int32_t column;
  std::int32_t by;
  std::uint32_t part;  ///< 0 where parts are not told apart
  friend auto operator<=>(const CapChange&, const CapChange&) = default;
};

/// Of each clip plane of a frame its changes, in order; none where the cap is
/// not seen.
using CapChanges = std::vector<std::vector<CapChange>>;

/// The changes in the rows and columns of a rectangle.
///
/// Only polygons that cross a clip plane are looked at: row by row they say
/// where the winding number in the plane changes.
/// Requires: a closed scene; image.caps.
/// Exact:    yes.
/// Cost:     the way through the tree to what crosses the planes, and one exact
///           function for each of them and row.
CapChanges cap_changes(const Frame& frame, const Rectangle& rectangle);

/// Adds the changes that the object of `frame` makes in the caps of the world:
/// those of all objects and of the world add up. They are not sorted.
///
/// Requires: frame.moved; image.caps; a closed object.
void add_object_changes(const Frame& frame, const Rectangle& rectangle,
                        CapChanges& changes);

/// Puts the caps of the frame's clip planes into a rendering of the clipped
/// scene (S10.3): of the rectangle, items and maybe colours, but where the
/// frame has an alpha items alone.
///
/// Requires: a closed scene; image.caps; result.items of the rectangle, whose
///           rows are some of those of `changes`, and its columns the same.
///           Ids of caps begin at `first_id`.
/// Exact:    yes.
/// Cost:     what is filled.
void add_caps(const Frame& frame, const Rectangle& rectangle,
              const CapChanges& changes, PolygonId first_id, Rendering& result);

/// Blends the caps of planes that the eye is on that side of with the colours
/// of some rows of a rendering (S10.7).
///
/// Requires: as add_caps(), but for items.
/// Exact:    yes.
void blend_caps(const Frame& frame, const Rectangle& rectangle, PixelRange rows,
                const CapChanges& changes, int side, Rendering& result);

}  // namespace halfspace::fast
