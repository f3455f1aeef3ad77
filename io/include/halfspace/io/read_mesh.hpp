#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "halfspace/io/format.hpp"
#include "halfspace/io/mesh.hpp"
#include "halfspace/io/stop.hpp"
#include "halfspace/result.hpp"

namespace halfspace::io {

/// The mesh in a file; a gzipped file is unpacked.
///
/// Text numbers are read as exact decimals, binary floats exactly (S1.7). STL
/// points that are equal become one vertex.
///
/// * OBJ: v (with colours too), f in all its forms, negative indices, lines
///   continued by a backslash; texture points, normals, objects, groups and
///   materials, those also from the files that it names, in its folder. Points
///   and lines are passed over; free-form curves and surfaces are refused.
/// * STL: text with any number of solids, and binary; told apart by size and
///   first bytes. Normals are passed over: the vertices' order tells.
/// * PLY: text and binary of either byte order; numbers of vertices and faces
///   become channels; other elements and lists are passed over.
/// * OFF: with any of ST, C, N before it and counts on its own line or not;
///   4OFF, nOFF and OFF BINARY are refused.
///
/// Errors: kUnreadable, kUnknownFormat, kEmpty (a file of no bytes), kSyntax,
///         kTruncated, kNotFinite, kOutOfRange, kBadIndex, kTooFewVertices (an
///         OBJ face); kStopped (by `stop`). Each names the file, and the line
///         or element and the value where there is one; index is the line,
///         element or byte.
/// Cost:   linear in the file's size, whatever counts its header claims.
Result<Mesh> read_mesh(const std::filesystem::path& path,
                       const Stop& stop = {});

/// The mesh that `bytes` hold in the format; the same, without the file's name
/// and without files beside it.
Result<Mesh> read_mesh(std::string_view bytes, Format format);

}  // namespace halfspace::io
