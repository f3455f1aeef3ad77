#include <algorithm>
#include <optional>

#include "mesh/ply.hpp"

namespace halfspace::io {
namespace {

std::optional<PlyType> type_named(std::string_view name) {
  using enum PlyType;
  constexpr struct {
    std::string_view old_name, new_name;
    PlyType type;
  } kTypes[] = {{"char", "int8", kInt8},      {"uchar", "uint8", kUint8},
                {"short", "int16", kInt16},   {"ushort", "uint16", kUint16},
                {"int", "int32", kInt32},     {"uint", "uint32", kUint32},
                {"float", "float32", kFloat}, {"double", "float64", kDouble}};
  for (const auto& entry : kTypes) {
    if (name == entry.old_name || name == entry.new_name) return entry.type;
  }
  return std::nullopt;
}

bool is_integer(PlyType type) {
  return type != PlyType::kFloat && type != PlyType::kDouble;
}

class HeaderReader {
 public:
  explicit HeaderReader(TextReader& text) : text_(text) {}
  Result<PlyHeader> read();

 private:
  using Tokens = std::span<const std::string_view>;

  bool fail(ErrorCode code, const std::string& what) {
    error_ = text_.error(code, what);
    return false;
  }
  bool line(Tokens tokens);
  bool format(Tokens tokens);
  bool element(Tokens tokens);
  bool property(Tokens tokens);
  bool type(std::string_view name, PlyType& value);
  bool check();

  TextReader& text_;
  PlyHeader header_;
  bool has_format_ = false;
  std::optional<Error> error_;
};

bool HeaderReader::format(Tokens tokens) {
  if (has_format_ || tokens.size() != 3) {
    return fail(ErrorCode::kSyntax,
                "there should be one 'format' of two "
                "words");
  }
  has_format_ = true;
  if (tokens[2] != "1.0") {
    return fail(ErrorCode::kUnknownFormat,
                "PLY version " + in_quotes(tokens[2]) + " is not read");
  }
  if (tokens[1] == "ascii") {
    header_.encoding = PlyEncoding::kText;
  } else if (tokens[1] == "binary_little_endian") {
    header_.encoding = PlyEncoding::kLittle;
  } else if (tokens[1] == "binary_big_endian") {
    header_.encoding = PlyEncoding::kBig;
  } else {
    return fail(ErrorCode::kUnknownFormat,
                "PLY format " + in_quotes(tokens[1]) + " is not read");
  }
  return true;
}

bool HeaderReader::element(Tokens tokens) {
  if (tokens.size() != 3) {
    return fail(ErrorCode::kSyntax, "an element has a name and a count");
  }
  const Result<std::int64_t> count = parse_integer(tokens[2]);
  if (!count) return fail(count.error().code, count.error().message);
  if (*count < 0) {
    return fail(ErrorCode::kOutOfRange,
                "the count " + in_quotes(tokens[2]) + " is negative");
  }
  for (const PlyElement& other : header_.elements) {
    if (other.name == tokens[1]) {
      return fail(ErrorCode::kSyntax,
                  "there is a second element " + in_quotes(tokens[1]));
    }
  }
  header_.elements.push_back({std::string(tokens[1]), *count, {}});
  return true;
}

bool HeaderReader::type(std::string_view name, PlyType& value) {
  const std::optional<PlyType> found = type_named(name);
  if (!found) {
    return fail(ErrorCode::kSyntax, in_quotes(name) + " is no type of PLY");
  }
  value = *found;
  return true;
}

bool HeaderReader::property(Tokens tokens) {
  if (header_.elements.empty()) {
    return fail(ErrorCode::kSyntax, "a property stands before any element");
  }
  PlyProperty property;
  property.is_list = tokens.size() > 1 && tokens[1] == "list";
  if (tokens.size() != (property.is_list ? 5u : 3u)) {
    return fail(ErrorCode::kSyntax, "a property has a type and a name");
  }
  if (!type(tokens[property.is_list ? 3 : 1], property.type)) return false;
  if (property.is_list) {
    if (!type(tokens[2], property.count_type)) return false;
    if (!is_integer(property.count_type)) {
      return fail(ErrorCode::kSyntax, "the length of a list is no integer");
    }
  }
  property.name = tokens.back();
  PlyElement& element = header_.elements.back();
  if (element.find({property.name}) >= 0) {
    return fail(ErrorCode::kSyntax,
                "there is a second property " + in_quotes(property.name));
  }
  element.properties.push_back(std::move(property));
  return true;
}

bool HeaderReader::line(Tokens tokens) {
  if (tokens[0] == "comment") {
    header_.comments.push_back(joined(tokens.subspan(1)));
    return true;
  }
  if (tokens[0] == "obj_info") return true;
  if (tokens[0] == "format") return format(tokens);
  if (tokens[0] == "element") return element(tokens);
  if (tokens[0] == "property") return property(tokens);
  return fail(ErrorCode::kSyntax,
              in_quotes(tokens[0]) + " is no line of a PLY header");
}

/// Facts that need the whole header.
bool HeaderReader::check() {
  if (!has_format_) {
    return fail(ErrorCode::kSyntax, "the header has no 'format'");
  }
  bool has_vertices = false;
  for (const PlyElement& element : header_.elements) {
    if (element.properties.empty() && element.count > 0) {
      return fail(ErrorCode::kSyntax,
                  "element " + in_quotes(element.name) + " has no properties");
    }
    if (element.name == "tristrips") {
      return fail(ErrorCode::kUnknownFormat, "triangle strips are not read");
    }
    if (element.name == "face" && element.count > 0) {
      const int list = element.find({"vertex_indices", "vertex_index"});
      const auto place = static_cast<std::size_t>(list);
      if (list < 0 || !element.properties[place].is_list ||
          !is_integer(element.properties[place].type)) {
        return fail(ErrorCode::kSyntax,
                    "the faces have no list of integers 'vertex_indices'");
      }
    }
    if (element.name != "vertex") continue;
    has_vertices = true;
    if (element.find({"vertex_indices", "vertex_index"}) >= 0) {
      return fail(ErrorCode::kSyntax,
                  "the vertices have a list 'vertex_indices'; a line 'element "
                  "face' is missing");
    }
    for (const std::string_view name : {"x", "y", "z"}) {
      const int place = element.find({name});
      if (place < 0 ||
          element.properties[static_cast<std::size_t>(place)].is_list) {
        return fail(ErrorCode::kSyntax,
                    "the vertices have no number " + in_quotes(name));
      }
    }
  }
  if (has_vertices) return true;
  return fail(ErrorCode::kSyntax, "the header has no element 'vertex'");
}

Result<PlyHeader> HeaderReader::read() {
  if (!text_.next_line() || text_.left().size() != 1 ||
      text_.left()[0] != "ply") {
    fail(ErrorCode::kUnknownFormat, "a PLY file starts with a line 'ply'");
    return *error_;
  }
  while (text_.next_line()) {
    const Tokens tokens = text_.left();
    if (tokens[0] == "end_header" && tokens.size() == 1 && !text_.is_cut()) {
      text_.skip_line();
      if (!check()) return *error_;
      return std::move(header_);
    }
    if (!line(tokens)) return *error_;
  }
  fail(ErrorCode::kTruncated, "the header has no end");
  return *error_;
}

}  // namespace

std::size_t size_of(PlyType type) {
  switch (type) {
    case PlyType::kInt8:
    case PlyType::kUint8:
      return 1;
    case PlyType::kInt16:
    case PlyType::kUint16:
      return 2;
    case PlyType::kInt32:
    case PlyType::kUint32:
    case PlyType::kFloat:
      return 4;
    case PlyType::kDouble:
      return 8;
  }
  return 0;
}

int color_range(PlyType type) {
  if (!is_integer(type)) return 1;
  return type == PlyType::kUint16 ? 65535 : 255;
}

int PlyElement::find(std::initializer_list<std::string_view> names) const {
  for (const std::string_view wanted : names) {
    for (std::size_t i = 0; i < properties.size(); ++i) {
      if (properties[i].name == wanted) return static_cast<int>(i);
    }
  }
  return -1;
}

Result<PlyHeader> read_ply_header(TextReader& text) {
  return HeaderReader(text).read();
}

}  // namespace halfspace::io
