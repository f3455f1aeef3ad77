#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "halfspace/fast/build.hpp"
#include "halfspace/result.hpp"

namespace halfspace::fast {

/// A hash of all that a tree depends on in its scene: grid, vertices and
/// polygons, but not colours or the unit.
std::uint64_t fingerprint_of(const Scene& scene);

/// The version of the format that encode_tree() writes.
constexpr std::uint32_t kTreeFileVersion = 1;

/// The bytes of a tree file.
///
/// Layout: a header of 256 bytes, then the tree's six arrays as they lie in
///         memory, each at a multiple of 64 bytes, with zeros between, so that
///         a mapped file can be read in place. The header holds the magic
///         "HSPCTREE", the version, a mark of the byte order, the scene's
///         fingerprint, the size of the file, for each array its offset, length
///         and element size, a checksum of all that follows the header, and
///         one of itself. There are no pointers and all padding is zero, so
///         the same tree gives the same bytes.
/// Exact:  yes: decode_tree() gives back the same tree.
std::vector<std::byte> encode_tree(const BspTree& tree, const Scene& scene);

/// The tree that the bytes hold.
///
/// A change of any one byte is found; so is every index that leads out of the
/// tree or the scene, and every list or subtree that does not end.
/// Errors: the first that holds: kTruncated (fewer bytes than a header, or than
///         the header says); kUnknownFormat (no tree file; another version,
///         byte order or layout); kSyntax (a checksum is wrong, with the index
///         of the first byte it covers; bytes too many); kBadIndex (the tree is
///         another scene's, index -1; else an index names nothing, with the
///         node, fragment or corner it is in).
/// Cost:   linear.
Result<BspTree> decode_tree(std::span<const std::byte> bytes,
                            const Scene& scene);

/// Writes and reads the file at `path`.
///
/// Errors: kUnwritable; kUnreadable, and those of decode_tree().
Result<Done> save_tree(const std::string& path, const BspTree& tree,
                       const Scene& scene);
Result<BspTree> load_tree(const std::string& path, const Scene& scene);

}  // namespace halfspace::fast
