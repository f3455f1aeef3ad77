#include "halfspace/io/write_mesh.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>

#include "base/side_by_side.hpp"
#include "base/text.hpp"
#include "halfspace/io/file.hpp"
#include "halfspace/io/number.hpp"
#include "mesh/format_table.hpp"
#include "polygon/ear_clipping.hpp"

namespace halfspace::io {

namespace {

/// The digits of mantissa / 2^places, the mantissa being odd; nothing where
/// words of 128 bits do not hold what comes up.
std::optional<std::string> short_digits(std::uint64_t mantissa, int places) {
  constexpr int kMost = 96;  // and 30 bits for 9 digits
  if (places < 1 || places > kMost) return std::nullopt;
  __extension__ using Wide = unsigned __int128;
  Wide rest = mantissa;
  std::array<char, 160> text;
  char* end = std::to_chars(text.data(), text.data() + 20,
                            static_cast<std::uint64_t>(rest >> places))
                  .ptr;
  *end++ = '.';
  for (int left = places; left > 0; left -= 9) {
    rest &= (Wide{1} << places) - 1;
    rest *= 1'000'000'000;
    auto nine = static_cast<std::uint32_t>(rest >> places);
    for (int k = 8; k >= 0; --k, nine /= 10)
      end[k] = static_cast<char>('0' + nine % 10);
    end += std::min(left, 9);
  }
  return std::string(text.data(), end);
}

}  // namespace

std::string all_digits(double value) {
  if (value == 0) return "0";
  // Below its last binary digit, 2^-k, there are k decimal ones.
  int exponent = 0;
  const double rest = std::frexp(value, &exponent);
  auto mantissa = static_cast<std::uint64_t>(std::ldexp(std::abs(rest), 53));
  for (exponent -= 53; mantissa % 2 == 0; ++exponent) mantissa /= 2;
  const bool negative = value < 0;
  const int places = std::max(0, -exponent);
  const auto digits = short_digits(mantissa, places);
  std::string text = digits ? *digits : fixed_point(std::abs(value), places);
  // Zeros after the point are an exponent, where they are many.
  const std::size_t first = text.find_first_not_of("0.");
  constexpr std::size_t kMany = 7;
  if (text[0] == '0' && first > kMany) {
    const std::string power = std::to_string(first - 1);
    text = text.substr(first);
    if (text.size() > 1) text.insert(1, ".");
    text += "e-" + power;
  }
  if (negative) text.insert(0, 1, '-');
  return text;
}

namespace {

/// A coordinate written exactly is not longer than this.
constexpr std::size_t kMaxExactLength = 80;

/// The format of the file to write.
Result<const FormatEntry*> output_format(const std::filesystem::path& path) {
  const std::optional<Format> format = format_of(path);
  if (format) return entry_of(*format);
  return Error{ErrorCode::kUnknownFormat,
               path.string() + ": a mesh is written to " + format_extensions()};
}

Error error_at(const std::filesystem::path& path, Error error) {
  error.message = path.string() + ": " + error.message;
  return error;
}

std::string shortest(double value) {
  char digits[32];
  const auto end = std::to_chars(digits, digits + sizeof digits, value).ptr;
  return {digits, end};
}

/// |a - b|, to within an ulp.
double distance(const Number& a, const Number& b) {
  const std::int32_t two = std::min(a.two, b.two);
  const std::int32_t five = std::min(a.five, b.five);
  const auto common = [two, five](const Number& number) {
    return Integer(
        (number.mantissa << static_cast<unsigned>(number.two - two)) *
        pow(Integer(5), static_cast<unsigned>(number.five - five)));
  };
  return to_double({abs(Integer(common(a) - common(b))), two, five});
}

/// `digits` times 10^-places, written with a point.
std::string with_point(std::string digits, std::size_t places) {
  const bool negative = digits[0] == '-';
  if (negative) digits.erase(0, 1);
  if (digits.size() <= places) {
    digits.insert(0, places + 1 - digits.size(), '0');
  }
  if (places > 0) digits.insert(digits.size() - places, ".");
  return (negative ? "-" : "") + digits;
}

/// The number as a decimal, or nothing if that is too long.
std::optional<std::string> exact_decimal(const Number& number) {
  const std::int32_t places = std::max({-number.two, -number.five, 0});
  const auto limit = static_cast<std::int32_t>(kMaxExactLength);
  if (places > limit || number.two > 4 * limit || number.five > 2 * limit) {
    return std::nullopt;
  }
  const Integer scaled =
      (number.mantissa << static_cast<unsigned>(number.two + places)) *
      pow(Integer(5), static_cast<unsigned>(number.five + places));
  std::string text = with_point(scaled.str(), static_cast<std::size_t>(places));
  if (text.size() > kMaxExactLength) return std::nullopt;
  return text;
}

/// What is written, and what that did.
struct Writer {
  MeshContent content;
  ExportReport report;

  void note(double move) {
    ++report.moved;
    report.max_move = std::max(report.max_move, move);
  }

  /// Adds a triangle of these corners of a face.
  void add_triangle(std::size_t face, const std::array<std::size_t, 3>& at) {
    const std::size_t first = content.faces.first_corner[face];
    std::array<std::uint32_t, 3> corners{};
    std::array<VertexId, 3> vertices{};
    for (std::size_t k = 0; k < 3; ++k) {
      corners[k] = static_cast<std::uint32_t>(first + at[k]);
      vertices[k] = content.faces.corners[first + at[k]];
    }
    content.triangles.push_back(vertices);
    content.triangle_corners.push_back(corners);
    content.triangle_faces.push_back(static_cast<std::uint32_t>(face));
  }

  /// Writes the file, and may write others beside it.
  Result<ExportReport> write(const std::filesystem::path& path,
                             const FormatEntry& format, bool beside) {
    std::string materials;
    if (content.attributes != nullptr) {
      if constexpr (kHasImages) {
        if (auto error = place_images(path, format.format, beside))
          return *error;
      }
      if (format.format == Format::kObj && beside)
        materials = mtl_text(*content.attributes, content.textures);
      if (!materials.empty())
        content.library = material_path(path).filename().string();
      report.lost = lost_words(*content.attributes, room_of(format));
    }
    const Result<std::string> bytes = format.encoded(content);
    if (!bytes) return error_at(path, bytes.error());
    if (!materials.empty()) {
      const Result<Done> done = write_file(material_path(path), materials);
      if (!done) return done.error();
    }
    const Result<Done> done = write_file(path, *bytes);
    if (!done) return done.error();
    return report;
  }

 private:
  /// Finds what the file calls the images of its materials, or reads them.
  std::optional<Error> place_images(const std::filesystem::path& path,
                                    Format format, bool beside) {
    const bool is_inside = format == Format::k3mf || format == Format::kGlb ||
                           format == Format::kGltf;
    if (is_inside) {
      content.images = embedded_images(*content.attributes, report.notes);
    } else if (beside && (format == Format::kObj || format == Format::kPly)) {
      auto names = images_beside(path, *content.attributes);
      if (!names) return names.error();
      content.textures = *std::move(names);
    }
    return std::nullopt;
  }
  /// Whether each face that has texture points has an image inside the file.
  bool all_have_images() const {
    const Attributes& attributes = *content.attributes;
    const Channel* points = nullptr;
    for (const Channel& channel : attributes.corners) {
      if (channel.kind == ChannelKind::kTexture) points = &channel;
    }
    if (points == nullptr || attributes.face_materials.empty()) return false;
    for (std::size_t face = 0; face < content.faces.count(); ++face) {
      const std::int32_t material = attributes.face_materials[face];
      const bool has_image =
          material >= 0 &&
          content.images.at(static_cast<std::size_t>(material)) >= 0;
      const std::size_t first = content.faces.first_corner[face];
      if (!has_image && !std::isnan(points->at(first)[0])) return false;
    }
    return true;
  }
  /// What this very file has room for.
  unsigned room_of(const FormatEntry& format) const {
    if constexpr (kHasImages) {
      if (format.format == Format::k3mf && all_have_images())
        return format.room | kTextureRoom;
    }
    if (format.format != Format::kObj) return format.room;
    unsigned room = format.room;
    if (content.library.empty()) room &= ~(kMaterialRoom | kFaceColorRoom);
    for (const Channel& channel : content.attributes->corners) {
      if (channel.kind == ChannelKind::kColor &&
          !by_vertex(channel, content.faces.corners, vertex_count()))
        room &= ~static_cast<unsigned>(kCornerColorRoom);
    }
    return room;
  }
  std::size_t vertex_count() const {
    return std::max(content.texts.size(), content.doubles.size());
  }
};

Number coordinate_number(std::int64_t steps, const Unit& unit) {
  return normalised(steps, unit.exponent, unit.base == 10 ? unit.exponent : 0);
}

/// A vertex as text, exact where that is short.
std::string point_text(const std::array<Number, 3>& point, Writer& writer) {
  std::string text;
  for (const Number& number : point) {
    if (!text.empty()) text += ' ';
    if (auto exact = exact_decimal(number)) {
      text += *exact;
      continue;
    }
    const double value = to_double(number);
    if (!std::isfinite(value)) return "";
    const Number rounded = number_of(value);
    if (rounded != number) writer.note(distance(rounded, number));
    text += shortest(value);
  }
  return text;
}

/// Whether every grid point is a point of doubles: 54 bits of coordinate are at
/// most 2^53, and no bit is beyond what doubles reach.
bool doubles_are_exact(const Unit& unit) {
  return unit.base == 2 && unit.exponent >= -1022 && unit.exponent <= 900;
}

/// The faces, and which have a colour: `has_color` is empty if all have.
Faces faces_of(std::span<const std::uint32_t> first_corner,
               std::span<const VertexId> corners, std::span<const Rgb> colors,
               const std::vector<bool>& has_color) {
  if (has_color.empty()) return {first_corner, corners, colors};
  const bool any =
      std::find(has_color.begin(), has_color.end(), true) != has_color.end();
  return any ? Faces{first_corner, corners, colors, &has_color}
             : Faces{first_corner, corners, {}};
}

/// Cuts the polygons of a scene into triangles.
std::optional<Error> cut_scene(const Scene& scene, Writer& writer) {
  std::vector<GridPoint> points;
  for (std::size_t p = 0; p < scene.polygon_count(); ++p) {
    const auto corners = scene.corners(static_cast<PolygonId>(p));
    if (corners.size() == 3) {
      writer.add_triangle(p, {0, 1, 2});
      continue;
    }
    if (corners.size() > kMaxEarCorners) {
      return Error{ErrorCode::kOutOfRange,
                   "polygon " + std::to_string(p) + " has " +
                       std::to_string(corners.size()) +
                       " corners, too many to cut into triangles",
                   static_cast<std::int64_t>(p)};
    }
    points.clear();
    for (const VertexId corner : corners) {
      points.push_back(scene.point(corner));
    }
    ++writer.report.triangulated;
    for (const auto& triangle : triangulate(points))
      writer.add_triangle(p, triangle);
  }
  return std::nullopt;
}

/// Adds a vertex as doubles, and for STL tells how far floats move it.
void add_doubles(const std::array<Number, 3>& point, const FormatEntry& format,
                 Writer& writer) {
  DoublePoint& doubles = writer.content.doubles.emplace_back();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    doubles[axis] = to_double(point[axis]);
    if (format.coordinates != Coordinates::kFloats) continue;
    const double stored = double{static_cast<float>(doubles[axis])};
    if (!std::isfinite(stored)) continue;  // refused when it is encoded
    const Number number = number_of(stored);
    if (number != point[axis]) writer.note(distance(number, point[axis]));
  }
}

/// Cuts the faces of a mesh into fans.
void cut_mesh(const OutputMesh& mesh, Writer& writer) {
  for (std::size_t f = 0; f + 1 < mesh.first_corner.size(); ++f) {
    const std::size_t first = mesh.first_corner[f];
    const std::size_t end = mesh.first_corner[f + 1];
    for (std::size_t i = 1; first + i + 1 < end; ++i)
      writer.add_triangle(f, {0, i, i + 1});
    if (end - first > 3) ++writer.report.triangulated;
  }
}

bool has_gz(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return extension == ".gz";
}

/// What does not keep to the shape of attributes, if something does not.
std::optional<Error> attribute_fault(const Attributes& attributes,
                                     std::size_t faces, std::size_t corners) {
  const auto is_among = [faces](const std::vector<std::int32_t>& of_face,
                                std::size_t count) {
    return of_face.empty() ||
           (of_face.size() == faces &&
            std::all_of(of_face.begin(), of_face.end(), [&](std::int32_t at) {
              return at >= -1 && at < static_cast<std::int64_t>(count);
            }));
  };
  const auto is_whole = [](const std::vector<Channel>& channels,
                           std::size_t count) {
    return std::all_of(channels.begin(), channels.end(),
                       [count](const Channel& channel) {
                         return channel.width > 0 &&
                                channel.values.size() == count * channel.width;
                       });
  };
  const auto names = [&](const Labels& labels) {
    return is_among(labels.of_face, labels.names.size());
  };
  if (is_among(attributes.face_materials, attributes.materials.size()) &&
      names(attributes.objects) && names(attributes.groups) &&
      is_whole(attributes.corners, corners) &&
      is_whole(attributes.faces, faces)) {
    return std::nullopt;
  }
  return Error{ErrorCode::kBadIndex,
               "the attributes are not those of " + std::to_string(faces) +
                   " faces with " + std::to_string(corners) + " corners"};
}

/// What does not keep to the shape of a mesh, if something does not.
std::optional<Error> shape_fault(const OutputMesh& mesh) {
  const auto& first = mesh.first_corner;
  if (first.empty() || first.front() != 0 ||
      first.back() != mesh.corners.size() ||
      !std::is_sorted(first.begin(), first.end())) {
    return Error{ErrorCode::kBadIndex,
                 "first_corner does not begin with 0, rise and end with the "
                 "number of corners"};
  }
  const std::size_t faces = first.size() - 1;
  for (std::size_t f = 0; f < faces; ++f) {
    if (first[f + 1] - first[f] >= 3) continue;
    return Error{ErrorCode::kTooFewVertices,
                 "face " + std::to_string(f) + " has fewer than 3 corners",
                 static_cast<std::int64_t>(f)};
  }
  if (!mesh.colors.empty() && mesh.colors.size() != faces) {
    return Error{ErrorCode::kBadIndex, std::to_string(faces) + " faces have " +
                                           std::to_string(mesh.colors.size()) +
                                           " colours"};
  }
  if (!mesh.has_color.empty() && mesh.has_color.size() != faces) {
    return Error{ErrorCode::kBadIndex,
                 "has_color has " + std::to_string(mesh.has_color.size()) +
                     " entries, for " + std::to_string(faces) + " faces"};
  }
  for (std::size_t c = 0; c < mesh.corners.size(); ++c) {
    const VertexId vertex = mesh.corners[c];
    if (vertex >= 0 && static_cast<std::size_t>(vertex) < mesh.vertices.size())
      continue;
    return Error{ErrorCode::kBadIndex,
                 "corner " + std::to_string(c) + " is vertex " +
                     std::to_string(vertex) + ", of " +
                     std::to_string(mesh.vertices.size()),
                 static_cast<std::int64_t>(c)};
  }
  return mesh.attributes
             ? attribute_fault(*mesh.attributes, faces, mesh.corners.size())
             : std::nullopt;
}

/// The vertices' coordinates as text.
std::vector<std::string> point_texts(const OutputMesh& mesh) {
  const auto text = mesh.exact_decimals ? all_digits : shortest;
  constexpr std::size_t kBlock = 4096;
  const std::size_t count = mesh.vertices.size();
  std::vector<std::string> texts(count);
  side_by_side((count + kBlock - 1) / kBlock,
               mesh.threads > 0 ? mesh.threads : machine_threads(),
               [&](std::size_t block) {
                 const std::size_t end = std::min(count, (block + 1) * kBlock);
                 for (std::size_t v = block * kBlock; v < end; ++v) {
                   const DoublePoint& point = mesh.vertices[v];
                   std::string line = text(point[0]);
                   for (const double value : {point[1], point[2]}) {
                     line += ' ';
                     line += text(value);
                   }
                   texts[v] = std::move(line);
                 }
               });
  return texts;
}

}  // namespace

std::filesystem::path material_path(const std::filesystem::path& obj) {
  std::filesystem::path path = obj;
  if (has_gz(path)) path.replace_extension();
  return path.replace_extension(".mtl");
}

Result<ExportReport> write_mesh(const std::filesystem::path& path,
                                const OutputMesh& mesh) {
  return write_mesh(path, mesh, true);
}

Result<ExportReport> write_mesh(const std::filesystem::path& path,
                                const OutputMesh& mesh, bool beside) {
  const Result<const FormatEntry*> found = output_format(path);
  if (!found) return found.error();
  if (const auto fault = shape_fault(mesh)) return error_at(path, *fault);
  const FormatEntry& format = **found;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    for (const double value : mesh.vertices[v]) {
      if (std::isfinite(value)) continue;
      return Error{ErrorCode::kNotFinite,
                   path.string() + ": vertex " + std::to_string(v) +
                       " has the coordinate " + std::to_string(value),
                   static_cast<std::int64_t>(v)};
    }
  }
  Writer writer;
  writer.content.faces =
      faces_of(mesh.first_corner, mesh.corners, mesh.colors, mesh.has_color);
  writer.content.attributes = mesh.attributes.get();
  if (format.coordinates != Coordinates::kText) {
    writer.content.doubles = mesh.vertices;
  } else {
    writer.content.texts = point_texts(mesh);
  }
  if (format.has_triangles_only) {
    cut_mesh(mesh, writer);
  }
  if (format.coordinates == Coordinates::kFloats) {
    for (const DoublePoint& point : mesh.vertices) {
      for (const double value : point) {
        const double stored = double{static_cast<float>(value)};
        if (stored != value) writer.note(std::abs(stored - value));
      }
    }
  }
  return writer.write(path, format, beside);
}

Result<ExportReport> write_scene_mesh(const std::filesystem::path& path,
                                      const Scene& scene) {
  return write_scene_mesh(path, scene, nullptr, true, {});
}

Result<ExportReport> write_scene_mesh(const std::filesystem::path& path,
                                      const Scene& scene,
                                      const Attributes* attributes, bool beside,
                                      const std::vector<bool>& has_color) {
  const Result<const FormatEntry*> found = output_format(path);
  if (!found) return found.error();
  const FormatEntry& format = **found;
  const SceneData& data = scene.data();
  Writer writer;
  if (!has_color.empty() && has_color.size() != scene.polygon_count()) {
    return error_at(
        path, {ErrorCode::kBadIndex,
               "has_color has " + std::to_string(has_color.size()) +
                   " entries, for " + std::to_string(scene.polygon_count()) +
                   " polygons"});
  }
  writer.content.faces =
      faces_of(data.first_corner, data.corners, data.colors, has_color);
  writer.content.attributes = attributes;
  if (attributes != nullptr) {
    if (const auto fault = attribute_fault(*attributes, scene.polygon_count(),
                                           data.corners.size()))
      return error_at(path, *fault);
  }
  const bool binary = format.coordinates == Coordinates::kFloats ||
                      (format.coordinates == Coordinates::kTextOrDoubles &&
                       doubles_are_exact(data.unit));
  for (std::size_t v = 0; v < data.vertices.size(); ++v) {
    const GridPoint& p = data.vertices[v];
    const std::array<Number, 3> point = {coordinate_number(p.x, data.unit),
                                         coordinate_number(p.y, data.unit),
                                         coordinate_number(p.z, data.unit)};
    if (binary) {
      add_doubles(point, format, writer);
      continue;
    }
    writer.content.texts.push_back(point_text(point, writer));
    if (writer.content.texts.back().empty()) {
      return Error{ErrorCode::kNotFinite,
                   path.string() + ": vertex " + std::to_string(v) +
                       " has a coordinate that no double holds",
                   static_cast<std::int64_t>(v)};
    }
  }
  if (format.has_triangles_only) {
    if (auto error = cut_scene(scene, writer)) return error_at(path, *error);
  }
  return writer.write(path, format, beside);
}

}  // namespace halfspace::io
