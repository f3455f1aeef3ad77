#pragma once

#include <string_view>

#include "halfspace/csg/script.hpp"
#include "halfspace/result.hpp"

namespace halfspace::csg {

/// Whether the text is the tree of solids that OpenSCAD exports as `.csg`, and
/// not a script: whether it begins with a call whose bracket holds nothing, a
/// list of lists or `name =`.
bool is_openscad(std::string_view text);

/// The solid of such a tree: cube, sphere, cylinder, polyhedron, import;
/// linear_extrude, without twist and scale, of square, circle and polygon;
/// hull of shapes and unions of them; group, union, difference, intersection,
/// multmatrix, color and render. Circles and balls have the corners that
/// OpenSCAD gives them, rounded to seven digits. No recursion.
///
/// Errors: kEmpty (there is nothing solid); kUnknownFormat (another shape,
/// which
///         the message names); kSyntax; kZeroArea (a matrix that flattens);
///         kOutOfRange (numbers and sizes). The message begins with the line
///         and the column; index is the line.
Result<Script> read_openscad(std::string_view text);

}  // namespace halfspace::csg
