#include <cmath>

#include "base/binary.hpp"
#include "mesh/mesh_builder.hpp"
#include "mesh/ply.hpp"
#include "mesh/ply_channels.hpp"
#include "mesh/readers.hpp"

namespace halfspace::io {
namespace {

/// Values one after another, from text.
class TextSource {
 public:
  explicit TextSource(TextReader& text) : text_(text) {}

  std::optional<Error> number(PlyType, Number& value) {
    return take(parse_number, value);
  }
  std::optional<Error> integer(PlyType, std::int64_t& value) {
    return take(parse_integer, value);
  }
  std::optional<Error> real(PlyType, double& value) {
    std::string_view token;
    if (!text_.next(token)) return ended();
    value = value_or_none(token);
    return std::nullopt;
  }
  std::optional<Error> skip(PlyType, std::int64_t count) {
    for (; count > 0; --count) {
      std::string_view token;
      if (!text_.next(token)) return ended();
    }
    return std::nullopt;
  }
  /// A value is at least a character and what parts it from the next.
  std::size_t at_most(std::size_t values, std::size_t) const {
    return (text_.rest().size() + 1) / (2 * values);
  }
  std::optional<Error> finish() {
    std::string_view token;
    if (!text_.next(token)) return std::nullopt;
    return text_.error(ErrorCode::kSyntax,
                       "the file goes on after its last element");
  }

 private:
  Error ended() const {
    return text_.error(ErrorCode::kTruncated, "the file ends");
  }
  template <class Parse, class Value>
  std::optional<Error> take(Parse&& parse, Value& value) {
    std::string_view token;
    if (!text_.next(token)) return ended();
    auto result = parse(token);
    if (!result) {
      return text_.error(result.error().code, result.error().message);
    }
    value = *std::move(result);
    return std::nullopt;
  }

  TextReader& text_;
};

/// Values one after another, from bytes.
class BinarySource {
 public:
  BinarySource(std::string_view bytes, ByteOrder order)
      : bytes_(bytes), order_(order) {}

  std::optional<Error> number(PlyType type, Number& value) {
    if (type == PlyType::kFloat || type == PlyType::kDouble) {
      double real = 0;
      if (auto error = take(type, real)) return error;
      if (!std::isfinite(real)) {
        return Error{ErrorCode::kNotFinite,
                     std::to_string(real) + " is not finite" + place()};
      }
      value = number_of(real);
      return std::nullopt;
    }
    std::int64_t whole = 0;
    if (auto error = take(type, whole)) return error;
    value = normalised(whole, 0, 0);
    return std::nullopt;
  }
  std::optional<Error> integer(PlyType type, std::int64_t& value) {
    return take(type, value);
  }
  std::optional<Error> real(PlyType type, double& value) {
    if (auto error = take(type, value)) return error;
    if (!std::isfinite(value)) value = kNoValue;
    return std::nullopt;
  }
  std::optional<Error> skip(PlyType type, std::int64_t count) {
    const std::size_t size = size_of(type);
    if ((bytes_.size() - at_) / size < static_cast<std::uint64_t>(count)) {
      return ended();
    }
    at_ += static_cast<std::size_t>(count) * size;
    return std::nullopt;
  }
  std::size_t at_most(std::size_t, std::size_t bytes) const {
    return (bytes_.size() - at_) / bytes;
  }
  std::optional<Error> finish() { return trailing_error(bytes_, at_); }

 private:
  std::string place() const {
    return " (byte " + std::to_string(at_) + " after the header)";
  }
  Error ended() const {
    return {ErrorCode::kTruncated, "the file ends" + place()};
  }
  template <class Stored, class Value>
  void load_as(Value& value) {
    value = static_cast<Value>(load<Stored>(bytes_, at_, order_));
  }
  template <class Value>
  std::optional<Error> take(PlyType type, Value& value) {
    const std::size_t size = size_of(type);
    if (bytes_.size() - at_ < size) return ended();
    switch (type) {
      case PlyType::kInt8:
        load_as<std::int8_t>(value);
        break;
      case PlyType::kUint8:
        load_as<std::uint8_t>(value);
        break;
      case PlyType::kInt16:
        load_as<std::int16_t>(value);
        break;
      case PlyType::kUint16:
        load_as<std::uint16_t>(value);
        break;
      case PlyType::kInt32:
        load_as<std::int32_t>(value);
        break;
      case PlyType::kUint32:
        load_as<std::uint32_t>(value);
        break;
      case PlyType::kFloat:
        load_as<float>(value);
        break;
      case PlyType::kDouble:
        load_as<double>(value);
        break;
    }
    at_ += size;
    return std::nullopt;
  }

  std::string_view bytes_;
  ByteOrder order_;
  std::size_t at_ = 0;
};

/// Where the values that matter stand among the properties of an element.
struct Places {
  std::array<int, 3> point = {-1, -1, -1};
  std::array<int, 3> color = {-1, -1, -1};
  int indices = -1;
  int has_color = -1;

  explicit Places(const PlyElement& element) {
    color = {element.find({"red", "diffuse_red", "r"}),
             element.find({"green", "diffuse_green", "g"}),
             element.find({"blue", "diffuse_blue", "b"})};
    for (const int place : color) {
      if (place < 0 ||
          element.properties[static_cast<std::size_t>(place)].is_list) {
        color = {-1, -1, -1};
      }
    }
    if (element.name == "vertex") {
      point = {element.find({"x"}), element.find({"y"}), element.find({"z"})};
    } else if (element.name == "face") {
      indices = element.find({"vertex_indices", "vertex_index"});
      has_color = element.find({kPlyHasColor});
      if (has_color >= 0 &&
          element.properties[static_cast<std::size_t>(has_color)].is_list)
        has_color = -1;
    } else {
      color = {-1, -1, -1};
    }
  }
};

int index_in(const std::array<int, 3>& places, int place) {
  for (int i = 0; i < 3; ++i) {
    if (places[static_cast<std::size_t>(i)] == place) return i;
  }
  return -1;
}

template <class Source>
class BodyReader {
 public:
  BodyReader(Source source, const PlyHeader& header, const Stop& stop)
      : source_(std::move(source)), header_(header), builder_(stop) {}

  Result<Mesh> read() {
    builder_.mesh.decimal = header_.encoding == PlyEncoding::kText;
    for (const PlyElement& element : header_.elements) {
      if (element.name == "vertex") vertex_count_ = element.count;
    }
    for (const PlyElement& element : header_.elements) {
      if (auto error = read_element(element)) return *error;
    }
    if (auto error = source_.finish()) return *error;
    vertex_channels_.add_to_corners(builder_.mesh);
    face_channels_.add_to_faces(header_.comments, builder_.mesh);
    return std::move(builder_.mesh);
  }

 private:
  /// One element's values that matter.
  struct Values {
    std::array<Number, 3> point;
    std::array<Number, 3> color;
    double has_color = 1;
  };

  std::optional<Error> read_element(const PlyElement& element) {
    if (element.count == 0) return std::nullopt;
    std::size_t bytes = 0;
    for (const PlyProperty& property : element.properties) {
      bytes += size_of(property.is_list ? property.count_type : property.type);
    }
    // A header may claim anything: believe what the file has room for.
    const std::size_t room = source_.at_most(element.properties.size(), bytes);
    if (static_cast<std::uint64_t>(element.count) > room) {
      return Error{ErrorCode::kTruncated,
                   "the header claims " + std::to_string(element.count) +
                       " of element " + in_quotes(element.name) +
                       ", but the file has room for " + std::to_string(room) +
                       " at most",
                   static_cast<std::int64_t>(room)};
    }
    const Places places(element);
    channels_ = places.point[0] >= 0  ? &vertex_channels_
                : places.indices >= 0 ? &face_channels_
                                      : nullptr;
    if (channels_ != nullptr) {
      std::vector<bool> is_read(element.properties.size());
      for (const auto& known : {places.point, places.color}) {
        for (const int place : known) {
          if (place >= 0) is_read[static_cast<std::size_t>(place)] = true;
        }
      }
      if (places.indices >= 0)
        is_read[static_cast<std::size_t>(places.indices)] = true;
      if (places.has_color >= 0)
        is_read[static_cast<std::size_t>(places.has_color)] = true;
      channels_->begin(element, is_read);
    }
    for (std::int64_t i = 0; i < element.count; ++i) {
      if (auto error = read_one(element, places)) {
        error->message = element.name + " " + std::to_string(i) + " of " +
                         std::to_string(element.count) + ": " + error->message;
        if (error->index < 0) error->index = i;
        return error;
      }
    }
    return std::nullopt;
  }

  std::optional<Error> read_one(const PlyElement& element,
                                const Places& places) {
    Values values;
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
      if (auto error = read_property(element.properties[i], static_cast<int>(i),
                                     places, values)) {
        return error;
      }
    }
    std::optional<Rgb> color;
    if (places.color[0] >= 0) {
      const auto& property =
          element.properties[static_cast<std::size_t>(places.color[0])];
      const Result<Rgb> value =
          color_of(values.color, color_range(property.type));
      if (!value) return value.error();
      color = *value;
    }
    Mesh& mesh = builder_.mesh;
    if (places.point[0] >= 0) {
      if (color) mesh.vertex_colors.push_back(color);
      return builder_.add_vertex(std::move(values.point));
    }
    if (places.indices >= 0) {
      if (values.has_color == 0 && color) {
        mesh.face_colors.emplace_back();
      } else if (color) {
        mesh.face_colors.push_back(color);
      }
      builder_.end_face();
      face_channels_.end_face(mesh);
    }
    return std::nullopt;
  }

  std::optional<Error> read_property(const PlyProperty& property, int place,
                                     const Places& places, Values& values) {
    if (property.is_list) {
      std::int64_t count = 0;
      if (auto error = source_.integer(property.count_type, count)) {
        return error;
      }
      if (count < 0) {
        return Error{ErrorCode::kOutOfRange,
                     "a list has the length " + std::to_string(count)};
      }
      if (place == places.indices) return read_indices(property, count);
      if (channels_ == nullptr || !channels_->wants(place))
        return source_.skip(property.type, count);
      for (; count > 0; --count) {
        double value = 0;
        if (auto error = source_.real(property.type, value)) return error;
        channels_->add(place, value);
      }
      return std::nullopt;
    }
    if (const int axis = index_in(places.point, place); axis >= 0) {
      return source_.number(property.type,
                            values.point[static_cast<std::size_t>(axis)]);
    }
    if (const int part = index_in(places.color, place); part >= 0) {
      return source_.number(property.type,
                            values.color[static_cast<std::size_t>(part)]);
    }
    if (place == places.has_color)
      return source_.real(property.type, values.has_color);
    if (channels_ == nullptr || !channels_->wants(place))
      return source_.skip(property.type, 1);
    double value = 0;
    if (auto error = source_.real(property.type, value)) return error;
    channels_->add(place, value);
    return std::nullopt;
  }

  std::optional<Error> read_indices(const PlyProperty& property,
                                    std::int64_t count) {
    for (; count > 0; --count) {
      std::int64_t index = 0;
      if (auto error = source_.integer(property.type, index)) return error;
      if (index < 0 || index >= vertex_count_) {
        return Error{ErrorCode::kBadIndex,
                     "there is no vertex " + std::to_string(index) +
                         ", only 0 to " + std::to_string(vertex_count_ - 1)};
      }
      if (auto error = builder_.add_corner(index)) return error;
    }
    return std::nullopt;
  }

  Source source_;
  const PlyHeader& header_;
  MeshBuilder builder_;
  PlyChannels vertex_channels_;
  PlyChannels face_channels_;
  PlyChannels* channels_ = nullptr;  // of the element that is read
  std::int64_t vertex_count_ = 0;
};

}  // namespace

Result<Mesh> read_ply(std::string_view bytes, const Stop& stop) {
  TextReader text(bytes, {});
  const Result<PlyHeader> header = read_ply_header(text);
  if (!header) {
    // Says it better, where that is the reason.
    if (auto error = not_plain_text(bytes.substr(0, 8))) return *error;
    return header.error();
  }
  if (header->encoding == PlyEncoding::kText) {
    if (auto error = not_plain_text(bytes)) return *error;
    return BodyReader(TextSource(text), *header, stop).read();
  }
  const ByteOrder order = header->encoding == PlyEncoding::kLittle
                              ? ByteOrder::kLittle
                              : ByteOrder::kBig;
  return BodyReader(BinarySource(text.rest(), order), *header, stop).read();
}

}  // namespace halfspace::io
