#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <limits>

#include "base/binary.hpp"
#include "halfspace/io/mesh.hpp"
#include "mesh/encode.hpp"
#include "mesh/images.hpp"
#include "mesh/ply_channels.hpp"

namespace halfspace::io {
namespace {

/// One property of a vertex or a face, or a list of one of a face.
struct PlyColumn {
  std::string name;
  bool is_integer = false;
  bool is_byte = false;                        ///< of a colour
  std::size_t stride = 1;                      ///< of `values`
  std::size_t offset = 0;                      ///< in each stride
  std::span<const double> values;              ///< of a list: the corners'
  std::span<const std::int32_t> of_face = {};  ///< in place of them
};

/// What a PLY has besides points and corners.
struct PlyColumns {
  std::vector<PlyColumn> vertex;
  std::vector<PlyColumn> face;
  std::vector<PlyColumn> lists;
  std::vector<std::string> comments;
  std::vector<std::vector<double>> kept;  ///< numbers that columns show
};

/// A name that is one word and that nothing else in a PLY has.
std::string ply_name(const std::string& name) {
  std::string word = name.empty() ? "number" : name;
  for (char& c : word) {
    if (c <= ' ' || c > '~') c = '_';
  }
  constexpr std::string_view kTaken[] = {"x",
                                         "y",
                                         "z",
                                         "vertex_indices",
                                         "vertex_index",
                                         "red",
                                         "green",
                                         "blue",
                                         "alpha",
                                         "texcoord",
                                         "s",
                                         "t",
                                         "nx",
                                         "ny",
                                         "nz",
                                         "material",
                                         "group",
                                         "object",
                                         "list"};
  if (std::find(std::begin(kTaken), std::end(kTaken), word) != std::end(kTaken))
    word += "_";
  return word;
}

/// Adds a column, under another name if that one is there.
void add_column(PlyColumn column, std::vector<PlyColumn>& columns) {
  const auto is_taken = [&] {
    return std::any_of(
        columns.begin(), columns.end(),
        [&](const PlyColumn& other) { return other.name == column.name; });
  };
  while (is_taken()) column.name += "_";
  columns.push_back(std::move(column));
}

/// What the numbers of a channel are called, one by one.
std::vector<std::string> ply_names(const Channel& channel) {
  if (channel.kind == ChannelKind::kTexture && channel.width == 2)
    return {"s", "t"};
  if (channel.kind == ChannelKind::kNormal && channel.width == 3)
    return {"nx", "ny", "nz"};
  if (channel.kind == ChannelKind::kColor && channel.width == 3)
    return {"red", "green", "blue"};
  if (channel.kind == ChannelKind::kColor && channel.width == 4)
    return {"red", "green", "blue", "alpha"};
  if (channel.width == 1) return {ply_name(channel.name)};
  std::vector<std::string> names;
  for (std::size_t i = 0; i < channel.width; ++i)
    names.push_back(ply_name(channel.name + "_" + std::to_string(i)));
  return names;
}

void add_columns(const Channel& channel, std::span<const double> values,
                 std::vector<PlyColumn>& columns) {
  const std::vector<std::string> names = ply_names(channel);
  for (std::size_t i = 0; i < channel.width; ++i) {
    add_column({names[i], channel.is_integer,
                channel.kind == ChannelKind::kColor, channel.width, i, values},
               columns);
  }
}

void add_names(const char* what, const Labels& labels, PlyColumns& columns) {
  if (labels.of_face.empty()) return;
  for (std::size_t i = 0; i < labels.names.size(); ++i) {
    columns.comments.push_back("halfspace " + std::string(what) + " " +
                               std::to_string(i) + " " + labels.names[i]);
  }
  columns.face.push_back({what, true, false, 1, 0, {}, labels.of_face});
}

PlyColumns columns_of(const Attributes& attributes, const Faces& faces,
                      std::span<const std::string> textures,
                      std::size_t vertex_count) {
  PlyColumns columns;
  // Columns show what is kept here: it must not move.
  columns.kept.reserve(attributes.corners.size());
  if (!attributes.face_materials.empty()) {
    for (std::size_t i = 0; i < attributes.materials.size(); ++i) {
      const Material& material = attributes.materials[i];
      columns.comments.push_back(ply_material_comment(i, material));
      if (kHasImages && (material.metallic || material.roughness))
        columns.comments.push_back(ply_surface_comment(i, material));
      const std::string& texture = texture_of(attributes, textures, i);
      if (texture.empty()) continue;
      columns.comments.push_back("halfspace texture " + std::to_string(i) +
                                 " " + texture);
      // The name that other programs look for.
      if constexpr (kHasImages)
        columns.comments.push_back("TextureFile " + texture);
    }
    columns.face.push_back(
        {"material", true, false, 1, 0, {}, attributes.face_materials});
  }
  for (std::size_t i = 0; i < attributes.origins.size(); ++i) {
    columns.comments.push_back("halfspace origin " + std::to_string(i) + " " +
                               attributes.origins[i]);
  }
  add_names("object", attributes.objects, columns);
  add_names("group", attributes.groups, columns);
  for (const Channel& channel : attributes.faces) {
    // Colours of faces are written as those of the mesh.
    if (channel.kind != ChannelKind::kColor)
      add_columns(channel, channel.values, columns.face);
  }
  for (const Channel& channel : attributes.corners) {
    if (auto values = by_vertex(channel, faces.corners, vertex_count)) {
      columns.kept.push_back(*std::move(values));
      add_columns(channel, columns.kept.back(), columns.vertex);
      continue;
    }
    const bool is_texture =
        channel.kind == ChannelKind::kTexture && channel.width == 2;
    add_column({is_texture ? "texcoord" : "corner_" + ply_name(channel.name),
                false, false, channel.width, 0, channel.values},
               columns.lists);
  }
  return columns;
}

/// Whether no list of a face has more than 255 entries, so that its length
/// fits a byte, as most readers expect.
bool lengths_fit_bytes(const Faces& faces, std::size_t width) {
  for (std::size_t face = 0; face < faces.count(); ++face) {
    if (faces.corners_of(face).size() * width > 255) return false;
  }
  return true;
}

const char* type_of(const PlyColumn& column) {
  if (column.is_byte) return "uchar";
  return column.is_integer ? "int" : "double";
}

std::string one_line_of(std::string text) {
  for (char& c : text) {
    if (c == '\n' || c == '\r') c = ' ';
  }
  return text;
}

/// Whether only some faces have a colour: all get one in the file then, and
/// which have it of their own is beside it.
bool some_lack_colors(const Faces& faces) {
  return !faces.colors.empty() && faces.has_color != nullptr &&
         std::count(faces.has_color->begin(), faces.has_color->end(), false) >
             0;
}

std::string ply_header(std::size_t points, const Faces& faces,
                       const PlyColumns& columns, std::string_view encoding) {
  std::string text = "ply\nformat ";
  text += encoding;
  text += " 1.0\ncomment written by halfspace\n";
  for (const std::string& comment : columns.comments)
    text += "comment " + one_line_of(comment) + "\n";
  text += "element vertex " + std::to_string(points) +
          "\nproperty double x\nproperty double y\nproperty double z\n";
  const auto add = [&text](const PlyColumn& column) {
    text +=
        std::string("property ") + type_of(column) + " " + column.name + "\n";
  };
  for (const PlyColumn& column : columns.vertex) add(column);
  text += "element face " + std::to_string(faces.count()) + "\nproperty list ";
  text += lengths_fit_bytes(faces, 1) ? "uchar" : "uint";
  text += " int vertex_indices\n";
  if (!faces.colors.empty())
    text += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  if (some_lack_colors(faces))
    text += "property uchar " + std::string(kPlyHasColor) + "\n";
  for (const PlyColumn& column : columns.face) add(column);
  for (const PlyColumn& list : columns.lists) {
    text += std::string("property list ") +
            (lengths_fit_bytes(faces, list.stride) ? "uchar" : "uint") +
            " double " + list.name + "\n";
  }
  return text + "end_header\n";
}

/// A number of a colour, its red being the first; the usual colour's where
/// there is none.
std::uint8_t byte_of(double share, std::size_t which) {
  if (std::isnan(share)) {
    constexpr std::uint8_t kOpaque = 255;
    const std::uint8_t usual[] = {kUsualSurface.r, kUsualSurface.g,
                                  kUsualSurface.b, kOpaque};
    return usual[std::min<std::size_t>(which, 3)];
  }
  return static_cast<std::uint8_t>(
      std::floor(std::clamp(share, 0.0, 1.0) * 255 + 0.5));
}

/// A whole number, 0 where there is none.
std::int32_t whole_of(double value) {
  constexpr double kMost = std::numeric_limits<std::int32_t>::max();
  return std::abs(value) <= kMost ? static_cast<std::int32_t>(value) : 0;
}

class TextSink {
 public:
  explicit TextSink(std::string& text) : text_(text) {}
  void points(std::span<const std::string> points, std::size_t i) {
    text_ += points[i];
  }
  void number(double value) {
    char digits[32];
    const auto end = std::to_chars(digits, digits + sizeof digits, value).ptr;
    word(std::isnan(value) ? "nan" : std::string_view(digits, end));
  }
  void integer(std::int64_t value) { word(std::to_string(value)); }
  void byte(std::uint8_t value) { integer(value); }
  void length(std::size_t value, bool) {
    integer(static_cast<std::int64_t>(value));
  }
  void end() {
    text_ += '\n';
    is_first_ = true;
  }
  void begin_after_point() { is_first_ = false; }

 private:
  void word(std::string_view text) {
    if (!is_first_) text_ += ' ';
    is_first_ = false;
    text_ += text;
  }
  std::string& text_;
  bool is_first_ = true;
};

class ByteSink {
 public:
  explicit ByteSink(std::string& bytes) : bytes_(bytes) {}
  void points(std::span<const DoublePoint> points, std::size_t i) {
    for (const double coordinate : points[i]) store(bytes_, coordinate);
  }
  void number(double value) { store(bytes_, value); }
  void integer(std::int64_t value) {
    store(bytes_, static_cast<std::int32_t>(value));
  }
  void byte(std::uint8_t value) { store(bytes_, value); }
  void length(std::size_t value, bool is_byte) {
    if (is_byte) {
      store(bytes_, static_cast<std::uint8_t>(value));
    } else {
      store(bytes_, static_cast<std::uint32_t>(value));
    }
  }
  void end() {}
  void begin_after_point() {}

 private:
  std::string& bytes_;
};

template <class Sink>
void put_value(const PlyColumn& column, std::size_t place, Sink& sink) {
  if (!column.of_face.empty()) return sink.integer(column.of_face[place]);
  const double value = column.values[place * column.stride + column.offset];
  if (column.is_byte) return sink.byte(byte_of(value, column.offset));
  if (column.is_integer) return sink.integer(whole_of(value));
  sink.number(value);
}

template <class Sink>
void put_face(const Faces& faces, std::size_t face, const PlyColumns& columns,
              const std::vector<bool>& short_lists, bool some_lack,
              Sink& sink) {
  const auto corners = faces.corners_of(face);
  sink.length(corners.size(), short_lists[0]);
  for (const VertexId corner : corners) sink.integer(corner);
  if (!faces.colors.empty()) {
    const Rgb& color =
        faces.is_colored(face) ? faces.colors[face] : kUsualSurface;
    for (const std::uint8_t value : {color.r, color.g, color.b})
      sink.byte(value);
  }
  if (some_lack) sink.byte(faces.is_colored(face) ? 1 : 0);
  for (const PlyColumn& column : columns.face) put_value(column, face, sink);
  for (std::size_t i = 0; i < columns.lists.size(); ++i) {
    const PlyColumn& list = columns.lists[i];
    const std::size_t count = corners.size() * list.stride;
    sink.length(count, short_lists[i + 1]);
    const std::size_t first = faces.first_corner[face] * list.stride;
    for (std::size_t k = 0; k < count; ++k) sink.number(list.values[first + k]);
  }
  sink.end();
}

template <class Sink, class Points>
std::string ply_of(const Points& points, const Faces& faces,
                   const Attributes* attributes,
                   std::span<const std::string> textures,
                   std::string_view encoding) {
  const PlyColumns columns =
      attributes ? columns_of(*attributes, faces, textures, points.size())
                 : PlyColumns();
  std::string bytes = ply_header(points.size(), faces, columns, encoding);
  Sink sink(bytes);
  for (std::size_t i = 0; i < points.size(); ++i) {
    sink.points(points, i);
    sink.begin_after_point();
    for (const PlyColumn& column : columns.vertex) put_value(column, i, sink);
    sink.end();
  }
  std::vector<bool> short_lists = {lengths_fit_bytes(faces, 1)};
  for (const PlyColumn& list : columns.lists)
    short_lists.push_back(lengths_fit_bytes(faces, list.stride));
  const bool some_lack = some_lack_colors(faces);
  for (std::size_t face = 0; face < faces.count(); ++face)
    put_face(faces, face, columns, short_lists, some_lack, sink);
  return bytes;
}

}  // namespace

std::optional<std::vector<double>> by_vertex(const Channel& channel,
                                             std::span<const VertexId> corners,
                                             std::size_t vertex_count) {
  std::vector<double> values(vertex_count * channel.width, kNoValue);
  std::vector<bool> is_set(vertex_count);
  const auto same = [](double a, double b) {
    return a == b || (std::isnan(a) && std::isnan(b));
  };
  for (std::size_t c = 0; c < corners.size(); ++c) {
    const auto vertex = static_cast<std::size_t>(corners[c]);
    const auto at = channel.at(c);
    const auto to =
        values.begin() + static_cast<std::ptrdiff_t>(vertex * channel.width);
    if (is_set[vertex]) {
      if (!std::equal(at.begin(), at.end(), to, same)) return std::nullopt;
      continue;
    }
    is_set[vertex] = true;
    std::copy(at.begin(), at.end(), to);
  }
  return values;
}

std::string ply_text(std::span<const std::string> points, const Faces& faces,
                     const Attributes* attributes,
                     std::span<const std::string> textures) {
  return ply_of<TextSink>(points, faces, attributes, textures, "ascii");
}

std::string ply_binary(std::span<const DoublePoint> points, const Faces& faces,
                       const Attributes* attributes,
                       std::span<const std::string> textures) {
  return ply_of<ByteSink>(points, faces, attributes, textures,
                          "binary_little_endian");
}

}  // namespace halfspace::io
