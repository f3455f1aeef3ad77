#pragma once

#include <string>

#include "halfspace/csg/matrix.hpp"
#include "halfspace/csg/script.hpp"
#include "halfspace/io/mesh.hpp"

namespace halfspace::csg {

/// Names of the parts of solids in files. They say where a part stands, so that
/// parts of one name are the same solid in the same place, whichever commands
/// brought them there:
///
///   a.off                     the file as it is
///   a.off @ 1 0 0 5 ...       moved: the rows of the matrix, exact decimals
///   box #1b2c3d4e             a primitive: what made it, and a hash of its
///   mesh half @ 2 0 0 2 1 0 ...    a half-space: three points of its plane

/// The part's name after it was moved.
/// Exact: yes: moved twice it is what it is moved by the product. Where that
///        has too many digits, "?" stands for the matrix.
std::string placed_name(const std::string& name, const Matrix& matrix);

std::string half_name(const HalfSpace& points);

std::string primitive_name(const std::string& name, const io::Mesh& mesh);

/// The same of what is known as a scene: `name #1b2c3d4e`.
std::string scene_name(const std::string& name, const Scene& scene);

}  // namespace halfspace::csg
