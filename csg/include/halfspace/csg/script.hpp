#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "halfspace/csg/lexer.hpp"
#include "halfspace/csg/matrix.hpp"
#include "halfspace/io/mesh.hpp"
#include "halfspace/result.hpp"

namespace halfspace::csg {

/// What a node of a script is.
enum class NodeKind : std::uint8_t {
  kFile,                 ///< the solid in a file
  kHalf,                 ///< all that is on one side of a plane
  kUnion,                ///< a | b
  kIntersection,         ///< a & b
  kDifference,           ///< a - b
  kSymmetricDifference,  ///< a ^ b
  kComplement,           ///< ~a
  kTransform,            ///< a, moved
  kComponent,            ///< the connected part of a that has a point inside
};

/// A part of a script: its operands are nodes before it.
struct Node {
  NodeKind kind = NodeKind::kFile;
  std::int32_t left = -1;   ///< the first operand, or the only one
  std::int32_t right = -1;  ///< the second
  /// Of the script's files, halves, transforms or points.
  std::int32_t item = -1;
  Place place;  ///< of the operator, the file or the function
};

/// A file that a script names.
struct File {
  std::string path;  ///< as it was given; empty for a primitive
  /// The name that it is bound to; empty where the script has it in quotes.
  std::string name;
  /// The faces of a primitive; else they are read.
  std::shared_ptr<const io::Mesh> mesh = nullptr;
  bool is_flipped = false;  ///< its faces are turned round
};

/// The side of a plane from which three points of it, in this order, are seen
/// clockwise: outwards is where they are seen counterclockwise.
using HalfSpace = std::array<Numbers3, 3>;

/// A script, taken apart. Each file, by path and name, is one node.
struct Script {
  std::vector<Node> nodes;
  std::vector<File> files;
  std::vector<HalfSpace> halves;
  std::vector<Matrix> transforms;
  std::vector<Numbers3> points;  ///< of components; no script has words for it
  std::int32_t result = -1;
};

/// A name given to a file outside of the script.
struct Binding {
  std::string name;
  std::string path;
};

/// The solid of the script in `text`: one expression, or statements, of which
/// the last is the result. docs/guide.md has the grammar. No recursion.
///
/// Exact:  yes, but for turns, roots, quotients and the like, which are
/// doubles,
///         and circles, which are polygons of rounded corners.
/// Errors: kEmpty (there is no statement); kSyntax; kBadIndex (a name that
///         stands for nothing there, or a binding that is not used); kZeroArea
///         (three points on a line; a transform that makes everything flat);
///         kOutOfRange (a number of too many digits; 2^31 bytes or more; over
///         2^22 nodes or operations). The message begins with the line and
///         the column; index is the line.
/// Cost:   n log n in the bytes and in the operations.
Result<Script> parse_script(std::string_view text,
                            std::span<const Binding> bindings = {});

/// Whether a word is a name of its own, which no operand can have.
bool is_function(std::string_view word);

}  // namespace halfspace::csg
