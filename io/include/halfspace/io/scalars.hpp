#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "halfspace/io/load_scene.hpp"
#include "halfspace/io/stop.hpp"
#include "halfspace/result.hpp"
#include "halfspace/scalars.hpp"

namespace halfspace::io {

/// Where the values of a field stand in a mesh.
enum class ScalarPlace : std::uint8_t { kVertices, kFaces };

/// Numbers as a file holds them: kNoData where there is none.
struct ScalarColumn {
  std::vector<double> values;
  std::optional<ScalarPlace> place;  ///< nothing: the file does not say
};

/// Whether the name is that of a file of numbers: whether it ends in `.npy`,
/// `.csv` or `.txt`, maybe with `:COLUMN` after it.
bool is_scalar_file_name(const std::string& name);

/// The numbers in a NumPy array of one dimension (of floats or integers), or in
/// a text, one a line. A text may have a first line of names, and several
/// columns parted by commas; then `name` ends in `:COLUMN`. Nothing, `nan` and
/// `NA` are no data. Text is rounded to the nearest double.
/// Errors: those of read_file(); kUnknownFormat, kSyntax, kTruncated,
///         kBadIndex (there is no such column, or there are several and none is
///         named).
Result<ScalarColumn> read_scalars(const std::string& name);

/// A property of the vertices, or else of the faces, of a PLY file. What is not
/// finite is no data.
/// Errors: those of read_mesh(); kBadIndex (there is none of that name; the
///         message lists those that there are).
Result<ScalarColumn> read_ply_scalars(const std::filesystem::path& path,
                                      const std::string& property);

/// The properties that read_ply_scalars() would find, none for other files, nor
/// where `stop` says so.
std::vector<std::string> ply_scalar_names(const std::filesystem::path& path,
                                          const Stop& stop = {});

/// The field over a scene whose file has these numbers for its vertices or
/// faces; their number says for which, where the column does not.
///
/// Requires: for values at vertices, that the scene was loaded with
///           ImportOptions::keep_vertices and triangles, or is a scene file.
/// Errors:   kOutOfRange (as many values as neither vertices nor faces; or as
///           both, and no place), and those of make_scalars().
Result<ScalarField> scalars_of(const LoadedScene& loaded,
                               const ScalarColumn& column);

}  // namespace halfspace::io
