#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "halfspace/result.hpp"

struct zip;

namespace halfspace::io {

/// A package of files in memory, as ZIP has it (libzip).
class PackageReader {
 public:
  /// `bytes` must outlive it. Errors: kSyntax, kTruncated.
  static Result<PackageReader> open(std::string_view bytes);

  std::vector<std::string> names() const;
  bool has(const std::string& name) const;
  /// Passes the unpacked bytes of an entry on, some at a time, the last ones
  /// with `is_last`; stops where that is refused.
  /// Errors: kBadIndex (there is no such entry); kOutOfRange (it unpacks to
  ///         more than `most` bytes); kSyntax (it is damaged, or encrypted).
  ///         The message names the entry.
  Result<Done> read(const std::string& name, std::uint64_t most,
                    const std::function<bool(std::string_view bytes,
                                             bool is_last)>& take) const;

 private:
  struct Closer {
    void operator()(zip* archive) const;
  };
  std::unique_ptr<zip, Closer> archive_;
};

/// The bytes of a package of these entries, each a name and its bytes. The same
/// entries give the same bytes.
/// Errors: kOutOfRange (there is no room for it).
Result<std::string> package_of(
    const std::vector<std::pair<std::string, std::string>>& entries);

}  // namespace halfspace::io
