#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "halfspace/result.hpp"

namespace halfspace::io {

using Json = nlohmann::json;

/// Arrays and objects within one another in a glTF are no more.
constexpr int kMostJsonDepth = 100;

/// The JSON of a text that begins at byte `begin` of a file.
///
/// Errors: kSyntax, with the byte; kOutOfRange, where the text is larger or
///         deeper than a scene's description is.
Result<Json> parsed_json(std::string_view text, std::size_t begin);

/// `list[i]`, as errors name the entries of a glTF.
std::string item(const char* list, std::size_t i);

/// Below, `place` is what errors call the object.

/// A whole number of an object, from 0 to 2^53; `other` where it has none of
/// the name. Errors: kSyntax.
Result<std::int64_t> whole(const Json& object, const char* name,
                           std::int64_t other, const std::string& place);

/// One of those that read_wholes() reads.
struct WholeField {
  const char* name;
  std::int64_t* value;  ///< what it is where the object has none of the name
};

/// The same for several.
std::optional<Error> read_wholes(const Json& object, const std::string& place,
                                 std::initializer_list<WholeField> fields);

/// An entry of a list of the file, which is an object.
/// Errors: kBadIndex, kSyntax.
Result<const Json*> entry_at(const Json& file, const char* list, std::int64_t i,
                             const std::string& place);

/// A text of an object; an empty one where it has none of the name.
std::string text_in(const Json& object, const char* name);

/// The object within an object; null where it has none of the name.
const Json* object_in(const Json& object, const char* name);

/// The list of an object; an empty one where it has none of the name.
/// Errors: kSyntax.
Result<const Json*> list_in(const Json& object, const char* name,
                            const std::string& place);

/// The list of `count` numbers of an object; `other` where it has none of the
/// name. Errors: kSyntax, kNotFinite.
Result<std::vector<double>> doubles_in(const Json& object, const char* name,
                                       std::vector<double> other,
                                       const std::string& place);

}  // namespace halfspace::io
