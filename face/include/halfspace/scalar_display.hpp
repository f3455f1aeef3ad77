#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "halfspace/api.hpp"
#include "halfspace/display.hpp"
#include "halfspace/mesh.hpp"
#include "halfspace/result.hpp"

namespace halfspace {

/// How numbers become colours (S11.3).
struct ScalarStyle {
  /// heated, grey, viridis, cividis, turbo, coolwarm, `_r` after it in reverse,
  /// or a text file with a colour a line.
  std::string map = "viridis";
  std::optional<double> low = {};   ///< nothing: the least number there is
  std::optional<double> high = {};  ///< nothing: the greatest
  bool logarithmic = false;
  std::int32_t steps = 0;  ///< so many bands; 0: as many as the map has colours
  bool clamp = true;       ///< else what is outside has the colour of no data
  Rgb no_data = {160, 160, 160};
  bool legend = false;     ///< with a scale at the picture's right side
  std::string title = {};  ///< of the legend
};

/// Polygons to look at, coloured by numbers at their corners.
///
/// What is interpolated is the number, exactly; the colour is that of the
/// number at the pixel's centre, dimmed by the light on the polygon (S11).
/// Units: as of Display. Cost: of making it, that of a Display. Source: FAG83
/// fig. 9.
class HALFSPACE_API ScalarDisplay {
 public:
  /// Takes polygons and one of their fields (Mesh::fields), in which a NaN is
  /// no data. What is no triangle is cut into triangles.
  /// Errors: those of Display::of(); kBadIndex (there is no such field);
  ///         kNotFinite (an infinite number).
  static Result<ScalarDisplay> of(const Mesh& mesh, std::size_t field = 0);

  ScalarDisplay(ScalarDisplay&&) noexcept;
  ScalarDisplay& operator=(ScalarDisplay&&) noexcept;
  ~ScalarDisplay();

  /// The picture, with the polygons of the mesh. Exact.
  /// Errors: those of Display::render(); kOutOfRange (a scale's range or steps;
  ///         exact areas, marked back faces and caps by solid, which have no
  ///         scalars); kEmpty (no number, and no range);
  ///         kUnknownFormat, kUnreadable and others of a file with colours.
  Result<Picture> render(const View& view = {},
                         const ScalarStyle& style = {}) const;

 private:
  struct State;
  explicit ScalarDisplay(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace halfspace
