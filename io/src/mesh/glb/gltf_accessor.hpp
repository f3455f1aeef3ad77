#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "halfspace/result.hpp"
#include "mesh/glb/gltf_file.hpp"

namespace halfspace::io {

/// The bytes of bufferView number `id`; errors of the number itself name
/// `place`. Errors: kBadIndex, kSyntax, kTruncated.
Result<std::string_view> bytes_of_view(const GltfFile& file, std::int64_t id,
                                       const std::string& place);

/// The numbers of an accessor (glTF 2.0, sec. 3.6.2), in the file's bytes.
class Accessor {
 public:
  /// Accessor number `id`; errors of the number itself name `place`.
  /// Errors: kBadIndex, kSyntax, kTruncated; kUnknownFormat, where it is
  ///         sparse.
  static Result<Accessor> of(const GltfFile& file, std::int64_t id,
                             const std::string& place);

  std::size_t count() const { return count_; }
  std::size_t width() const { return width_; }
  /// kGlbInt8 and so on.
  std::int64_t type() const { return type_; }
  /// Requires: i < count(), k < width(); for integer() no floats.
  std::int64_t integer(std::size_t i, std::size_t k) const;
  double number(std::size_t i, std::size_t k) const;

 private:
  std::optional<Error> find_bytes(const GltfFile& file, const Json& accessor,
                                  const std::string& place);

  std::string_view bytes_;
  std::size_t count_ = 0;
  std::size_t width_ = 1;
  std::int64_t type_ = 0;
  std::size_t stride_ = 0;
  bool is_normalized_ = false;
};

}  // namespace halfspace::io
