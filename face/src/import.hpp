#pragma once

#include <string>
#include <vector>

#include "halfspace/io/mesh.hpp"
#include "node.hpp"

namespace halfspace::detail {

/// How an exact mesh becomes a leaf.
struct ImportHow {
  OperandOptions options;
  /// Its coordinates were computed: they may be rounded to any fine grid.
  bool is_free = false;
  /// It is a solid as it is made: nothing has to be looked for.
  bool is_trusted = false;
  /// By polygon whether it has a colour of its own; empty: as its properties.
  std::vector<bool> has_color = {};
};

/// The leaf that the mesh is; `properties` are its polygons', or null.
/// Errors: those of importing; kOpen, kSelfCrossing, kInsideOut.
Result<LeafData> imported_leaf(const std::string& name, io::Mesh mesh,
                               std::shared_ptr<const Mesh> properties,
                               const ImportHow& how);

/// The leaf that a mesh of doubles is.
/// Errors: those, and kBadIndex, kNotFinite (of the mesh as it is).
Result<LeafData> mesh_leaf(const std::string& name, Mesh mesh,
                           const ImportHow& how);
/// The same of one that may be kept for its properties.
Result<LeafData> mesh_leaf(const std::string& name,
                           const std::shared_ptr<const Mesh>& mesh,
                           const ImportHow& how);

/// The leaf in a file.
Result<LeafData> file_leaf(const std::string& path,
                           const OperandOptions& options);

/// The leaf in a mesh file, mended, and what was done to it.
Result<LeafData> mended_leaf(const std::string& path,
                             const MendOptions& options,
                             std::vector<std::string>& done);

/// The error of a mesh that does not keep to its shape, if it does not.
std::optional<Error> fault_of(const Mesh& mesh);

}  // namespace halfspace::detail
