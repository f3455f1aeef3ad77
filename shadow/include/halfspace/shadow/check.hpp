#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "halfspace/camera.hpp"
#include "halfspace/image.hpp"
#include "halfspace/scene.hpp"

/// The reference beside the fast library in production: a share of an image's
/// pixels is checked against the definition.
namespace halfspace::shadow {

/// Which pixels are checked, and how.
struct Options {
  /// The share of the pixels to check, above 0 and at most 1: one of every
  /// 1/share consecutive pixels in row order, and at least one.
  double share = 0.01;
  std::uint64_t seed = 1;          ///< chooses pixels; vary it frame by frame
  std::size_t kept = 16;           ///< the most mismatches kept in full
  bool by_reference_only = false;  ///< decide nothing by bounded doubles
};

/// A pixel that shows the wrong polygon or colour. Units: pixels of the whole
/// image.
struct Mismatch {
  std::int32_t i = 0;
  std::int32_t j = 0;
  PolygonId shown = kBackground;
  PolygonId expected = kBackground;
  Rgb shown_color;
  Rgb expected_color;
  friend bool operator==(const Mismatch&, const Mismatch&) = default;
};

/// The pixels that were checked, and the mismatches found.
struct Report {
  std::size_t pixels = 0;        ///< checked
  std::size_t by_reference = 0;  ///< decided by the reference, not by doubles
  std::size_t mismatches = 0;
  std::vector<Mismatch> first;  ///< at most Options::kept

  /// Adds the report of another frame.
  void add(const Report& other);
};

/// An image of a scene, or a part of one whose first pixel is (left, top).
struct Shown {
  const ItemImage& items;
  const ColorImage& colors;  ///< as large as `items`, or empty: not checked
  std::int32_t left = 0;
  std::int32_t top = 0;
};

/// Checks the chosen pixels of an image against the definition (S5.1, S5.4).
///
/// Doubles with error bounds, independent of the fast library's arithmetic,
/// prove most pixels right. The reference's rays (ref::raycast_at,
/// ref::color_at) decide the others, among the polygons that the doubles cannot
/// exclude. So a mismatch is always the reference's verdict.
/// Requires: the part lies in the image; no polygon is transparent.
/// Exact:    yes.
/// Cost:     one pass over vertices and polygons, then the polygons whose
///           bounds hold a chosen pixel.
Report check(const Scene& scene, const Camera& camera,
             const ImageOptions& options, const Shown& shown,
             const Options& how = {});

/// One sentence.
std::string to_string(const Mismatch& mismatch);

/// The text of a `.scene` file that reproduces the mismatches, which are listed
/// in it as comments.
std::string reproducer(const Scene& scene, const Camera& camera,
                       const ImageOptions& options, const Report& report);

}  // namespace halfspace::shadow
