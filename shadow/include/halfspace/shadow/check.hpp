#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "halfspace/camera.hpp"
#include "halfspace/image.hpp"
#include "halfspace/scene.hpp"

/// The reference beside the fast library, in production: a chosen share of the
/// pixels of an image is checked, whoever made it.
namespace halfspace::shadow {

/// Which pixels are checked, and how.
struct Options {
  /// The share of the pixels, above 0 and at most 1; one at least. Of every
  /// 1/share pixels, in the order of rows, one is chosen.
  double share = 0.01;
  std::uint64_t seed = 1;          ///< chooses them; another one for each frame
  std::size_t kept = 16;           ///< so many mismatches are told in full
  bool by_reference_only = false;  ///< leave nothing to doubles with bounds
};

/// A pixel that does not see what it shows. Units: pixels of the whole image.
struct Mismatch {
  std::int32_t i = 0;
  std::int32_t j = 0;
  PolygonId shown = kBackground;
  PolygonId expected = kBackground;
  Rgb shown_color;
  Rgb expected_color;
  friend bool operator==(const Mismatch&, const Mismatch&) = default;
};

/// What was checked, and what was found.
struct Report {
  std::size_t pixels = 0;        ///< checked
  std::size_t by_reference = 0;  ///< of them: where doubles could not tell
  std::size_t mismatches = 0;
  std::vector<Mismatch> first;  ///< Options::kept of them at most

  /// Adds the report of another frame.
  void add(const Report& other);
};

/// An image of a scene, or the part of it whose first pixel is (left, top).
struct Shown {
  const ItemImage& items;
  const ColorImage& colors;  ///< as large as `items`; or empty: not checked
  std::int32_t left = 0;
  std::int32_t top = 0;
};

/// Checks the chosen pixels of an image against the definition (S5.1, S5.4).
///
/// A pixel is right where doubles with bounds, by arithmetic of their own,
/// prove it; every other is decided by the reference's rays (ref::raycast_at,
/// ref::color_at), cast at what the doubles cannot rule out. So a mismatch is
/// always the reference's verdict.
/// Requires: the part lies in the image; no polygon is transparent.
/// Exact:    yes.
/// Cost:     every vertex and polygon is looked at once, then the polygons
///           around each chosen pixel.
Report check(const Scene& scene, const Camera& camera,
             const ImageOptions& options, const Shown& shown,
             const Options& how = {});

/// One sentence for each mismatch that is told in full.
std::string to_string(const Mismatch& mismatch);

/// The text of a `.scene` file that shows the mismatches again; they stand in
/// it as comments.
std::string reproducer(const Scene& scene, const Camera& camera,
                       const ImageOptions& options, const Report& report);

}  // namespace halfspace::shadow
