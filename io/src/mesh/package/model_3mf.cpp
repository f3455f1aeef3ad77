#include "mesh/package/model_3mf.hpp"

#include <expat.h>

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <memory>
#include <sstream>

#include "base/text.hpp"
#include "halfspace/message.hpp"

namespace halfspace::io {
namespace {

/// A model part that unpacks to more is not read.
constexpr std::uint64_t kMostModelBytes = std::uint64_t{1} << 30;

/// Nor is one with a longer tag: expat looks at what it has of a tag again with
/// each piece of it, which takes time quadratic in its length.
constexpr std::int64_t kMostTagBytes = std::int64_t{1} << 23;

constexpr char kSpaceEnd = '|';

/// The colour of `#RRGGBB` or `#RRGGBBAA`, from 0 to 1.
std::array<double, 4> color_of_digits(const std::string& text) {
  std::array<double, 4> color{};
  for (std::size_t k = 0; k < 4; ++k) {
    const std::string digits =
        2 * k + 3 <= text.size() ? text.substr(2 * k + 1, 2) : "ff";
    color[k] =
        static_cast<double>(std::strtoul(digits.c_str(), nullptr, 16)) / 255;
  }
  return color;
}

/// Reads the elements of a model as they come (expat).
class Model3mfParser {
 public:
  explicit Model3mfParser(std::string part) : part_(std::move(part)) {}

  Result<Model3mf> read(const PackageReader& package);

 private:
  /// An element's name, and its attributes.
  struct Element {
    std::string_view space;
    std::string_view name;
    const XML_Char** attributes;
  };

  static Element element_of(const XML_Char* name, const XML_Char** attributes) {
    const std::string_view all(name);
    const std::size_t at = all.rfind(kSpaceEnd);
    if (at == std::string_view::npos) return {{}, all, attributes};
    return {all.substr(0, at), all.substr(at + 1), attributes};
  }

  void fail(ErrorCode code, const std::string& what) {
    if (error_) return;
    const auto line =
        static_cast<std::int64_t>(XML_GetCurrentLineNumber(parser_.get()));
    error_ = Error{code, part_ + ", line " + std::to_string(line) + ": " + what,
                   line};
    XML_StopParser(parser_.get(), XML_FALSE);
  }
  std::int64_t line() const {
    return static_cast<std::int64_t>(XML_GetCurrentLineNumber(parser_.get()));
  }
  static const XML_Char* find(const Element& element, std::string_view name) {
    for (const XML_Char** at = element.attributes; *at; at += 2) {
      if (name == at[0]) return at[1];
    }
    return nullptr;
  }
  static std::string text(const Element& element, std::string_view name) {
    const XML_Char* value = find(element, name);
    return value ? value : "";
  }
  std::int64_t whole(const Element& element, std::string_view name,
                     std::int64_t other);
  Number coordinate(const Element& element, std::string_view name);
  ExactMap transform(const Element& element);

  void start(const Element& element);
  void start_core(const Element& element);
  void start_material(const Element& element);
  void start_set(const Element& element);
  void model(const Element& element);
  void triangle(const Element& element);
  void use(const Element& element, std::vector<Model3mfUse>& to);
  void end(std::string_view name);

  static void on_start(void* self, const XML_Char* name,
                       const XML_Char** attributes) {
    auto* parser = static_cast<Model3mfParser*>(self);
    if (!parser->error_) parser->start(element_of(name, attributes));
  }
  static void on_end(void* self, const XML_Char* name) {
    auto* parser = static_cast<Model3mfParser*>(self);
    if (!parser->error_) parser->end(element_of(name, nullptr).name);
  }
  static void on_text(void* self, const XML_Char* text, int length) {
    auto* parser = static_cast<Model3mfParser*>(self);
    constexpr std::size_t kMost = 4096;
    if (parser->in_origin_ && parser->text_.size() < kMost)
      parser->text_.append(text, static_cast<std::size_t>(length));
  }
  static void on_doctype(void* self, const XML_Char*, const XML_Char*,
                         const XML_Char*, int) {
    static_cast<Model3mfParser*>(self)->fail(
        ErrorCode::kSyntax, "a model has no document type (DOCTYPE)");
  }

  std::string part_;
  std::unique_ptr<XML_ParserStruct, void (*)(XML_Parser)> parser_{nullptr,
                                                                  nullptr};
  std::int64_t taken_ = 0;  // bytes
  std::optional<Error> error_;
  Model3mf model_;
  bool has_model_ = false;
  Model3mfObject* object_ = nullptr;
  Model3mfGroup* group_ = nullptr;
  Model3mfSet* set_ = nullptr;
  std::vector<Model3mfSurface>* surfaces_ = nullptr;
  std::int64_t object_group_ = -1;
  std::uint32_t object_property_ = 0;
  bool in_build_ = false;
  std::optional<std::size_t> in_origin_;
  std::string text_;
};

std::int64_t Model3mfParser::whole(const Element& element,
                                   std::string_view name, std::int64_t other) {
  const XML_Char* value = find(element, name);
  if (value == nullptr) return other;
  const Result<std::int64_t> number = parse_integer(value);
  constexpr std::int64_t kMost = std::numeric_limits<std::int32_t>::max();
  if (number && *number >= 0 && *number <= kMost) return *number;
  fail(ErrorCode::kSyntax, std::string(name) + " is " + in_quotes(value) +
                               ", which is no whole number from 0 to "
                               "2147483647");
  return other;
}

Number Model3mfParser::coordinate(const Element& element,
                                  std::string_view name) {
  const XML_Char* value = find(element, name);
  if (value == nullptr) {
    fail(ErrorCode::kSyntax,
         "a " + std::string(element.name) + " has no " + std::string(name));
    return {};
  }
  Result<Number> number = parse_number(value);
  if (number) return *std::move(number);
  fail(number.error().code, number.error().message);
  return {};
}

/// The map of twelve numbers, column by column as a matrix of points as rows.
ExactMap Model3mfParser::transform(const Element& element) {
  ExactMap map = identity_map();
  const XML_Char* value = find(element, "transform");
  if (value == nullptr) return map;
  std::istringstream words(value);
  std::string word;
  std::size_t count = 0;
  for (; words >> word; ++count) {
    Result<Number> number = parse_number(word);
    if (!number) {
      fail(number.error().code, "transform: " + number.error().message);
      return map;
    }
    if (count < 12) map.rows[count % 3][count / 3] = *std::move(number);
  }
  if (count != 12) {
    fail(ErrorCode::kSyntax,
         "a transform has " + std::to_string(count) + " numbers, not 12");
  }
  return map;
}

void Model3mfParser::model(const Element& element) {
  has_model_ = true;
  const std::string unit = text(element, "unit");
  constexpr struct {
    const char* name;
    const char* millimetres;
  } kUnits[] = {{"", "1"},           {"micron", "0.001"},
                {"millimeter", "1"}, {"centimeter", "10"},
                {"inch", "25.4"},    {"foot", "304.8"},
                {"meter", "1000"}};
  const auto* const found =
      std::find_if(std::begin(kUnits), std::end(kUnits),
                   [&](const auto& entry) { return unit == entry.name; });
  if (found == std::end(kUnits))
    return fail(ErrorCode::kSyntax, "the unit " + in_quotes(unit) + " is none");
  model_.unit = *parse_number(found->millimetres);
  // Those that change what is where; beams and slices are no triangles.
  std::istringstream needed(text(element, "requiredextensions"));
  std::string prefix;
  while (needed >> prefix) {
    if (prefix != "m" && prefix != "p" && prefix != "t") {
      return fail(ErrorCode::kUnknownFormat,
                  "the model needs the extension " + in_quotes(prefix) +
                      ", which is not read; export it without");
    }
  }
}

void Model3mfParser::triangle(const Element& element) {
  if (object_ == nullptr) return;
  Model3mfTriangle triangle;
  constexpr const char* kVertices[] = {"v1", "v2", "v3"};
  constexpr const char* kProperties[] = {"p1", "p2", "p3"};
  for (std::size_t k = 0; k < 3; ++k) {
    const std::int64_t vertex = whole(element, kVertices[k], -1);
    if (error_) return;
    if (vertex < 0 ||
        static_cast<std::size_t>(vertex) >= object_->vertices.size()) {
      return fail(ErrorCode::kBadIndex,
                  std::string(kVertices[k]) + " is " +
                      in_quotes(text(element, kVertices[k])) + ", of " +
                      std::to_string(object_->vertices.size()) + " vertices");
    }
    triangle.vertices[k] = static_cast<std::uint32_t>(vertex);
  }
  triangle.group = whole(element, "pid", object_group_);
  const std::int64_t first = whole(
      element, "p1", triangle.group == object_group_ ? object_property_ : 0);
  for (std::size_t k = 0; k < 3; ++k) {
    triangle.properties[k] = static_cast<std::uint32_t>(
        k == 0 ? first : whole(element, kProperties[k], first));
  }
  const std::string space = std::string(kOriginSpace) + kSpaceEnd;
  triangle.origin = {whole(element, space + "solid", -1),
                     whole(element, space + "polygon", -1)};
  object_->triangles.push_back(triangle);
}

void Model3mfParser::use(const Element& element, std::vector<Model3mfUse>& to) {
  Model3mfUse made;
  made.object = whole(element, "objectid", -1);
  made.part = text(element, std::string(kProductionSpace) + kSpaceEnd + "path");
  made.map = transform(element);
  made.line = line();
  to.push_back(std::move(made));
}

void Model3mfParser::start_core(const Element& element) {
  const std::string_view name = element.name;
  if (name == "vertex" && object_ != nullptr) {
    object_->vertices.push_back({coordinate(element, "x"),
                                 coordinate(element, "y"),
                                 coordinate(element, "z")});
  } else if (name == "triangle") {
    triangle(element);
  } else if (name == "object") {
    const std::int64_t id = whole(element, "id", -1);
    const auto [at, is_new] = model_.objects.try_emplace(id);
    if (!is_new && !error_) {
      return fail(ErrorCode::kSyntax,
                  "object " + std::to_string(id) + " is there twice");
    }
    object_ = &at->second;
    object_->name = text(element, "name");
    object_group_ = whole(element, "pid", -1);
    object_property_ = static_cast<std::uint32_t>(whole(element, "pindex", 0));
  } else if (name == "component" && object_ != nullptr) {
    use(element, object_->components);
  } else if (name == "item" && in_build_) {
    use(element, model_.items);
  } else if (name == "build") {
    in_build_ = true;
  } else if (name == "basematerials") {
    group_ = &model_.groups[whole(element, "id", -1)];
    group_->surfaces_id = whole(element, "displaypropertiesid", -1);
  } else if (name == "base" && group_ != nullptr) {
    Material material{text(element, "name")};
    const std::string value = text(element, "displaycolor");
    const std::array<double, 4> color = color_of_digits(value);
    if (!value.empty()) material.color = rgb_of(color);
    material.opacity = color[3];
    group_->materials.push_back(std::move(material));
  } else if (name == "model") {
    model(element);
  } else if (name == "metadata") {
    const std::string key = text(element, "name");
    const std::size_t at = key.find(":origin");
    if (at == std::string::npos) return;
    const auto number = parse_integer(key.substr(at + 7));
    if (number && *number >= 0) in_origin_ = static_cast<std::size_t>(*number);
    text_.clear();
  }
}

void Model3mfParser::start_material(const Element& element) {
  const std::string_view name = element.name;
  if (name == "colorgroup" || name == "texture2dgroup") {
    group_ = &model_.groups[whole(element, "id", -1)];
    group_->texture_id = whole(element, "texid", -1);
    const std::string space = std::string(kOriginSpace) + kSpaceEnd;
    group_->material_group = whole(element, space + "pid", -1);
    group_->material =
        static_cast<std::size_t>(whole(element, space + "pindex", 0));
  } else if (name == "color" && group_ != nullptr) {
    group_->colors.push_back(color_of_digits(text(element, "color")));
  } else if (name == "tex2coord" && group_ != nullptr) {
    group_->texture.push_back(
        {value_or_none(text(element, "u")), value_or_none(text(element, "v"))});
  } else if (name == "texture2d") {
    model_.textures[whole(element, "id", -1)] = text(element, "path");
  } else if (name == "pbmetallicdisplayproperties") {
    surfaces_ = &model_.surfaces[whole(element, "id", -1)];
  } else if (name == "pbmetallic" && surfaces_ != nullptr) {
    const auto share = [&](const char* key, double other) {
      const double value = value_or_none(text(element, key));
      return value >= 0 && value <= 1 ? value : other;
    };
    surfaces_->push_back({share("metallicness", 0), share("roughness", 1)});
  }
}

void Model3mfParser::start_set(const Element& element) {
  if (object_ == nullptr) return;
  if (element.name == "triangleset") {
    object_->sets.push_back(
        {text(element, "name"), text(element, "identifier"), {}});
    set_ = &object_->sets.back();
  } else if (element.name == "ref" && set_ != nullptr) {
    const auto at = static_cast<std::uint64_t>(whole(element, "index", 0));
    set_->ranges.emplace_back(at, at);
  } else if (element.name == "refrange" && set_ != nullptr) {
    set_->ranges.emplace_back(whole(element, "startindex", 0),
                              whole(element, "endindex", 0));
  }
}

void Model3mfParser::start(const Element& element) {
  if (!has_model_ && element.name != "model")
    return fail(
        ErrorCode::kSyntax,
        "the first element is " + in_quotes(element.name) + ", not 'model'");
  if (element.space == kModelSpace) {
    start_core(element);
  } else if (element.space == kMaterialSpace) {
    start_material(element);
  } else if (element.space == kSetSpace) {
    start_set(element);
  } else if (!has_model_) {
    fail(ErrorCode::kSyntax, "the model has the namespace " +
                                 in_quotes(element.space) +
                                 ", which is not that of 3MF");
  }
}

void Model3mfParser::end(std::string_view name) {
  if (name == "object") object_ = nullptr;
  if (name == "triangleset") set_ = nullptr;
  if (name == "basematerials" || name == "colorgroup" ||
      name == "texture2dgroup")
    group_ = nullptr;
  if (name == "pbmetallicdisplayproperties") surfaces_ = nullptr;
  if (name == "build") in_build_ = false;
  if (name == "metadata" && in_origin_) {
    model_.origins[*in_origin_] = text_;
    in_origin_.reset();
  }
}

Result<Model3mf> Model3mfParser::read(const PackageReader& package) {
  parser_ = {XML_ParserCreateNS(nullptr, kSpaceEnd), XML_ParserFree};
  XML_SetUserData(parser_.get(), this);
  XML_SetElementHandler(parser_.get(), on_start, on_end);
  XML_SetCharacterDataHandler(parser_.get(), on_text);
  XML_SetStartDoctypeDeclHandler(parser_.get(), on_doctype);
  const auto take = [this](std::string_view bytes, bool is_last) {
    const XML_Status status =
        XML_Parse(parser_.get(), bytes.data(), static_cast<int>(bytes.size()),
                  is_last ? XML_TRUE : XML_FALSE);
    taken_ += static_cast<std::int64_t>(bytes.size());
    const std::int64_t waits = taken_ - XML_GetCurrentByteIndex(parser_.get());
    if (status == XML_STATUS_OK && waits <= kMostTagBytes) return true;
    if (status == XML_STATUS_OK) {
      error_ = Error{ErrorCode::kOutOfRange,
                     part_ + ", line " + std::to_string(line()) +
                         ": a tag is longer than 8 MiB",
                     line()};
    } else if (!error_) {
      const XML_Error code = XML_GetErrorCode(parser_.get());
      const bool is_cut = code == XML_ERROR_NO_ELEMENTS ||
                          code == XML_ERROR_UNCLOSED_TOKEN || is_last;
      error_ = Error{is_cut ? ErrorCode::kTruncated : ErrorCode::kSyntax,
                     part_ + ", line " + std::to_string(line()) + ": " +
                         XML_ErrorString(code),
                     line()};
    }
    return false;
  };
  const Result<Done> done = package.read(part_, kMostModelBytes, take);
  if (error_) return *error_;
  if (!done) return done.error();
  return std::move(model_);
}

}  // namespace

Result<Model3mf> read_model_3mf(const PackageReader& package,
                                const std::string& part) {
  return Model3mfParser(part).read(package);
}

}  // namespace halfspace::io
