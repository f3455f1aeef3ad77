#include "mesh/glb/gltf_json.hpp"

#include <cmath>
#include <utility>

namespace halfspace::io {
namespace {

/// A scene's description is smaller.
constexpr std::size_t kMostJsonBytes = std::size_t{1} << 25;

/// Arrays and objects that are open at once, outside of texts.
bool is_too_deep(std::string_view text) {
  int depth = 0;
  bool in_text = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_text) {
      if (c == '\\') ++i;
      if (c == '"') in_text = false;
      continue;
    }
    if (c == '"') in_text = true;
    if ((c == '[' || c == '{') && ++depth > kMostJsonDepth) return true;
    if (c == ']' || c == '}') --depth;
  }
  return false;
}

/// Takes any JSON, and notes where it is none.
struct FaultFinder : nlohmann::json_sax<Json> {
  std::size_t fault = 0;  // counted from 1
  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(number_integer_t) override { return true; }
  bool number_unsigned(number_unsigned_t) override { return true; }
  bool number_float(number_float_t, const string_t&) override { return true; }
  bool string(string_t&) override { return true; }
  bool binary(binary_t&) override { return true; }
  bool start_object(std::size_t) override { return true; }
  bool key(string_t&) override { return true; }
  bool end_object() override { return true; }
  bool start_array(std::size_t) override { return true; }
  bool end_array() override { return true; }
  bool parse_error(std::size_t position, const std::string&,
                   const nlohmann::detail::exception&) override {
    fault = position;
    return false;
  }
};

Error syntax(const std::string& message) {
  return {ErrorCode::kSyntax, message, -1};
}

}  // namespace

Result<Json> parsed_json(std::string_view text, std::size_t begin) {
  if (text.size() > kMostJsonBytes || is_too_deep(text)) {
    return Error{ErrorCode::kOutOfRange,
                 "the JSON has over " + std::to_string(kMostJsonBytes) +
                     " bytes, or over " + std::to_string(kMostJsonDepth) +
                     " brackets within one another",
                 static_cast<std::int64_t>(begin)};
  }
  Json json = Json::parse(text, nullptr, /*allow_exceptions=*/false);
  if (json.is_object()) return json;
  if (!json.is_discarded()) return syntax("the JSON of the file is no object");
  FaultFinder finder;
  Json::sax_parse(text, &finder);
  const std::size_t byte = begin + finder.fault;
  return Error{ErrorCode::kSyntax,
               "byte " + std::to_string(byte) + " is no JSON",
               static_cast<std::int64_t>(byte)};
}

std::string item(const char* list, std::size_t i) {
  return std::string(list) + "[" + std::to_string(i) + "]";
}

Result<std::int64_t> whole(const Json& object, const char* name,
                           std::int64_t other, const std::string& place) {
  const auto found = object.find(name);
  if (found == object.end()) return other;
  if (found->is_number_unsigned() &&
      found->get<std::uint64_t>() <= (std::uint64_t{1} << 53))
    return static_cast<std::int64_t>(found->get<std::uint64_t>());
  return syntax(place + "." + name + " is no whole number of 0 or more");
}

std::optional<Error> read_wholes(const Json& object, const std::string& place,
                                 std::initializer_list<WholeField> fields) {
  for (const WholeField& field : fields) {
    const auto value = whole(object, field.name, *field.value, place);
    if (!value) return value.error();
    *field.value = *value;
  }
  return std::nullopt;
}

Result<const Json*> entry_at(const Json& file, const char* list, std::int64_t i,
                             const std::string& place) {
  const auto found = file.find(list);
  const std::size_t count =
      found == file.end() || !found->is_array() ? 0 : found->size();
  const auto at = static_cast<std::size_t>(i);
  if (i < 0 || at >= count) {
    return Error{ErrorCode::kBadIndex, place + ": there is no " +
                                           item(list, at) + ", only " +
                                           std::to_string(count)};
  }
  const Json& entry = (*found)[at];
  if (!entry.is_object()) return syntax(item(list, at) + " is no object");
  return &entry;
}

std::string text_in(const Json& object, const char* name) {
  const auto found = object.find(name);
  return found != object.end() && found->is_string() ? found->get<std::string>()
                                                     : std::string();
}

const Json* object_in(const Json& object, const char* name) {
  const auto found = object.find(name);
  return found != object.end() && found->is_object() ? &*found : nullptr;
}

Result<const Json*> list_in(const Json& object, const char* name,
                            const std::string& place) {
  static const Json kEmptyList = Json::array();
  const auto found = object.find(name);
  if (found == object.end()) return &kEmptyList;
  if (!found->is_array()) return syntax(place + "." + name + " is no list");
  return &*found;
}

Result<std::vector<double>> doubles_in(const Json& object, const char* name,
                                       std::vector<double> other,
                                       const std::string& place) {
  const auto list = object.find(name);
  if (list == object.end()) return other;
  const std::string at = place + "." + name;
  if (!list->is_array() || list->size() != other.size()) {
    return syntax(at + " is no list of " + std::to_string(other.size()) +
                  " numbers");
  }
  std::vector<double> values;
  for (const Json& value : *list) {
    if (!value.is_number()) return syntax(at + " has what is no number");
    values.push_back(value.get<double>());
    if (!std::isfinite(values.back()))
      return Error{ErrorCode::kNotFinite, at + " has a number beyond doubles"};
  }
  return values;
}

}  // namespace halfspace::io
