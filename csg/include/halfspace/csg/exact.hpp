#pragma once

#include <optional>
#include <span>
#include <string>

#include "halfspace/csg/matrix.hpp"
#include "halfspace/fast/check_operand.hpp"
#include "halfspace/fast/solid.hpp"
#include "halfspace/io/load_scene.hpp"
#include "halfspace/io/number.hpp"
#include "halfspace/result.hpp"
#include "halfspace/solid_file.hpp"

namespace halfspace::csg {

/// What a grid must be able to do to hold an exact solid that was moved.
struct ExactNeed {
  io::Number step;  ///< 2^i 5^j: all grid points are multiples of it
  io::Number least;
  io::Number greatest;  ///< no coordinate is beyond these, multiples of it too
  int grid_bits = 26;   ///< the least whose planes can be like the solid's
};

/// What a grid must be able to do to hold the solid, moved by the matrix;
/// nothing where no grid can have its planes.
/// Exact: yes.
std::optional<ExactNeed> need_of(const SolidData& data, const Matrix& matrix);

/// The solid, moved by the matrix, on the grid of this unit and so many bits.
/// Requires: the grid does what need_of() says.
/// Exact:    yes.
SolidData placed(const SolidData& data, const Matrix& matrix, const Unit& unit,
                 int grid_bits);

/// The same solid on the least grid that holds its points and planes.
SolidData in_least_grid(SolidData data);

/// The solid with every face turned round. Nobody vouches for it.
SolidData flipped(SolidData data);

/// The data's solid in a table of its own.
/// Errors: those of fast::to_solid(); and unless the data are checked, those of
///         fast::check_operand().
Result<fast::Solid> checked_solid(const SolidData& data,
                                  const fast::CheckOptions& options = {});

/// The solid's surface in doubles (S6.8), imported. The polygons' numbers are
/// those of the origins.
/// Errors: those of checked_solid() and fast::rounded_mesh().
Result<io::Imported> rounded(const SolidData& data,
                             const io::ImportOptions& options);

/// io::load_scene(), of exact solids, too: those as their surface in doubles;
/// `exact`, if not null, gets the solid itself.
/// Errors: those of read_solid(), rounded() and io::load_scene().
Result<io::LoadedScene> load_scene(const std::string& path,
                                   const io::ImportOptions& options,
                                   std::optional<SolidData>* exact = nullptr);

}  // namespace halfspace::csg
